// @ts-check
// Hands on a floor: click, right-click, long press and keys open menus; colleagues are dragged.

import { closeMenu } from "./menu.js";

const LONG = 500; // milliseconds of a long press
const STIR = 6; // pixels after which a press is a drag
const REACH = 1.0; // metres from a node within which a colleague is dropped on it
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/**
 * @param {import("./floor.js").Floor} floor
 * @param {{menu: (name: string, at: {x: number, y: number}) => void,
 *   drop: (name: string, node: string) => void}} hands what is done: a menu is asked for, a waiter dropped
 */
export function handle(floor, hands) {
  const svg = floor.svg;
  /** @type {{name: string, x: number, y: number, id: number, moved: boolean, node: string | null} | null} */
  let press = null;
  /** @type {number | undefined} */
  let timer;
  let handled = false; // the press has opened a menu, or was a drag: its click means nothing

  svg.addEventListener("pointerdown", (event) => {
    handled = false;
    const name = floor.nameAt(event);
    if (!name || event.button !== 0) return;
    press = { name, x: event.clientX, y: event.clientY, id: event.pointerId, moved: false, node: null };
    if (event.pointerType === "touch") {
      timer = window.setTimeout(() => {
        if (press && !press.moved) openAt(press.name, press);
        press = null;
      }, LONG);
    }
  });
  svg.addEventListener("pointermove", (event) => {
    if (!press || event.pointerId !== press.id) return;
    if (!press.moved && Math.hypot(event.clientX - press.x, event.clientY - press.y) < STIR) return;
    clearTimeout(timer);
    if (!press.name.startsWith("waiter ")) return;
    if (!press.moved) {
      press.moved = true;
      svg.setPointerCapture(event.pointerId);
      closeMenu();
    }
    const [x, y] = floor.at(event);
    floor.figures.hold(press.name, x, y);
    aim(nearest(x, y));
  });
  const finish = (/** @type {PointerEvent} */ event) => {
    clearTimeout(timer);
    if (!press || event.pointerId !== press.id) return;
    const { name, moved, node } = press;
    press = null;
    if (!moved) return;
    handled = true;
    letGo();
    if (event.type === "pointerup" && node) hands.drop(name, node);
  };
  svg.addEventListener("pointerup", finish);
  svg.addEventListener("pointercancel", finish);
  svg.addEventListener("click", (event) => {
    const name = floor.nameAt(event);
    if (handled || !name) return;
    openAt(name, { x: event.clientX, y: event.clientY });
  });
  svg.addEventListener("contextmenu", (event) => {
    event.preventDefault();
    clearTimeout(timer);
    const name = floor.nameAt(event);
    if (name && !handled) openAt(name, event.clientX || event.clientY ? { x: event.clientX, y: event.clientY } : middle(name));
  });
  svg.addEventListener("keydown", (event) => {
    const name = floor.nameAt(event);
    if (!name) return;
    if (event.key === "Escape" && press?.moved) {
      press = null;
      letGo();
    } else if (event.key === "Enter" || event.key === " ") openAt(name, middle(name));
    else if (event.key in ARROWS) {
      const [dx, dy] = ARROWS[/** @type {keyof typeof ARROWS} */ (event.key)];
      const to = floor.beside(name, dx, dy);
      if (to) floor.focus(to);
    } else return;
    event.preventDefault();
  });

  /**
   * @param {string} name
   * @param {{x: number, y: number}} at
   */
  function openAt(name, at) {
    handled = true;
    floor.focus(name);
    hands.menu(name, { x: at.x, y: at.y });
    setTimeout(() => (handled = false), 50);
  }

  /** @param {string} name */
  function middle(name) {
    const box = floor.find(name)?.getBoundingClientRect();
    return box ? { x: box.x + box.width / 2, y: box.y + box.height / 2 } : { x: 0, y: 0 };
  }

  function letGo() {
    aim(null);
    floor.figures.release();
  }

  /** @param {string | null} node */
  function aim(node) {
    if (press) press.node = node;
    for (const other of svg.querySelectorAll(".target")) other.classList.remove("target");
    if (node) floor.find(`node ${node}`)?.classList.add("target");
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  function nearest(x, y) {
    let [best, least] = [/** @type {string | null} */ (null), REACH];
    for (const [node, [nx, ny]] of Object.entries(floor.room?.nodes ?? {})) {
      const far = Math.hypot(nx - x, ny - y);
      if (far < least) [best, least] = [node, far];
    }
    return best;
  }
}

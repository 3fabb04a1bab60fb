// @ts-check
// A menu of what can be done with a thing: role menu, by pointer and by keyboard.

import { make } from "./build.js";

/**
 * One thing that can be done; `why` says why it cannot be now.
 * @typedef {{text: string, act: () => void, why?: string | null}} Item
 */

/** @type {(() => void) | null} */
let closeOpen = null;

/** Closes the menu that is open, if one is. */
export function closeMenu() {
  closeOpen?.();
}

/**
 * Opens a menu at a place of the window; the focus goes to its first item, and back when it closes.
 * @param {string} label
 * @param {Item[]} items
 * @param {{x: number, y: number}} at
 * @param {Element | null} origin what has the focus afterwards
 */
export function openMenu(label, items, at, origin) {
  closeMenu();
  const menu = make("div", { role: "menu", "aria-label": label, class: "menu" });
  const entries = items.map((item) => {
    const entry = make("div", {
      role: "menuitem", tabindex: "-1", "aria-disabled": item.why ? "true" : null, title: item.why ?? null,
      onclick: () => choose(item),
    }, item.text);
    menu.append(entry);
    return entry;
  });

  /** @param {Item} item */
  function choose(item) {
    if (item.why) return;
    close(true);
    item.act();
  }

  /** @param {boolean} back */
  function close(back) {
    closeOpen = null;
    menu.remove();
    document.removeEventListener("pointerdown", outside, true);
    window.removeEventListener("blur", away);
    if (back && origin instanceof SVGElement) origin.focus();
    else if (back && origin instanceof HTMLElement) origin.focus();
  }
  const outside = (/** @type {PointerEvent} */ event) => {
    if (!menu.contains(/** @type {Node} */ (event.target))) close(false);
  };
  const away = () => close(false);

  menu.addEventListener("keydown", (event) => {
    const here = entries.indexOf(/** @type {HTMLElement} */ (document.activeElement));
    const last = entries.length - 1;
    const to = { ArrowDown: here === last ? 0 : here + 1, ArrowUp: here <= 0 ? last : here - 1, Home: 0, End: last }[event.key];
    if (to !== undefined) entries[to].focus();
    else if (event.key === "Enter" || event.key === " ") choose(items[here]);
    else if (event.key === "Escape") close(true);
    else if (event.key === "Tab") close(true);
    else if (event.key.length === 1) jump(event.key.toLowerCase(), here);
    else return;
    event.preventDefault();
    event.stopPropagation();
  });

  /**
   * @param {string} letter
   * @param {number} here
   */
  function jump(letter, here) {
    const order = [...entries.keys()].map((i) => (here + 1 + i) % entries.length);
    const found = order.find((i) => items[i].text.toLowerCase().split(" ").some((word) => word.startsWith(letter)));
    if (found !== undefined) entries[found].focus();
  }

  menu.addEventListener("contextmenu", (event) => event.preventDefault());
  (document.getElementById("shell") ?? document.body).append(menu);
  const box = menu.getBoundingClientRect();
  menu.style.left = `${Math.max(4, Math.min(at.x, innerWidth - box.width - 8))}px`;
  menu.style.top = `${Math.max(4, Math.min(at.y, innerHeight - box.height - 8))}px`;
  closeOpen = () => close(false);
  document.addEventListener("pointerdown", outside, true);
  window.addEventListener("blur", away);
  entries[0]?.focus();
}

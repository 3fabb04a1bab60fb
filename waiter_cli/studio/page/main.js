// @ts-check
// The page: three rooms behind tabs. A room registers itself in ROOMS below; all but the first are loaded
// when they are opened.

import { make } from "./build.js";
import { live } from "./live.js";
import { ask } from "./link.js";

/**
 * What every room is given.
 * @typedef {{room: import("./floor.js").RoomDocument & Record<string, any>,
 *   goTo: (name: string) => void, say: (text: string, bad?: boolean) => void, anew: () => void}} Studio
 * `room` is the room document of the layout that is lived in; `goTo` shows another room by its name;
 * `say` tells the person something, politely; `anew` shows the evening that has begun in another layout.
 */

/**
 * A room of the page. `start` is called once, before the room is shown for the first time, with the
 * empty panel that it fills; it returns what is to be called each time the room is shown and left.
 * @typedef {{name: string, start: (panel: HTMLElement, studio: Studio) =>
 *   Promise<{enter?: () => void, leave?: () => void}>}} Room
 */

/** @type {Room[]} */
const ROOMS = [
  live,
  { name: "Layout", start: async (...given) => (await import("./layout.js")).layout.start(...given) },
  { name: "Why", start: async (...given) => (await import("./why.js")).why.start(...given) },
];

/**
 * Builds the page.
 * @param {Promise<any>} styled is done once the styles are there
 */
export async function begin(styled) {
  const room = await ask("room");
  const heading = make("h1", {});
  const told = make("p", { class: "said", role: "status", "aria-label": "message" });
  /** @type {Map<string, {tab: HTMLElement, panel: HTMLElement, started?: Promise<any>, room: Room}>} */
  const shown = new Map();
  let current = "";

  /** @type {Studio} */
  const studio = {
    room,
    goTo: (name) => void open(name),
    anew: () => void again().catch((error) => studio.say(error.message, true)),
    say: (text, bad = false) => {
      told.textContent = text;
      told.classList.toggle("bad", bad);
    },
  };

  /** Builds the first room anew, for another evening. */
  async function again() {
    studio.room = await ask("room");
    title(studio.room.layout);
    const first = /** @type {{panel: HTMLElement, started?: Promise<any>}} */ (shown.get(ROOMS[0].name));
    first.started = undefined;
    first.panel.replaceChildren();
    if (current !== ROOMS[0].name) return;
    current = "";
    await open(ROOMS[0].name);
  }

  /** @param {string} layout */
  function title(layout) {
    document.title = `${layout} – waiter studio`;
    heading.textContent = layout;
  }

  /** @param {string} name */
  async function open(name) {
    const next = shown.get(name);
    if (!next || name === current) return;
    const before = shown.get(current);
    current = name;
    for (const [other, { tab, panel }] of shown) {
      tab.setAttribute("aria-selected", String(other === name));
      tab.setAttribute("tabindex", other === name ? "0" : "-1");
      panel.hidden = other !== name;
      if (other !== name) panel.remove(); // a name on the page is that of one thing
    }
    panels.append(next.panel);
    (await before?.started)?.leave?.();
    next.started ??= next.room.start(next.panel, studio);
    try {
      (await next.started).enter?.();
    } catch (error) {
      next.started = undefined; // it can be opened again
      next.panel.replaceChildren();
      studio.say(`The room ${name} cannot be opened: ${/** @type {Error} */ (error).message}`, true);
    }
  }

  const tabs = make("div", { role: "tablist", "aria-label": "rooms", class: "tabs" });
  const panels = make("div", { class: "panels" });
  for (const each of ROOMS) {
    const id = each.name.toLowerCase();
    const tab = make("button", {
      role: "tab", id: `tab-${id}`, "aria-controls": `panel-${id}`, type: "button",
      onclick: () => void open(each.name),
    }, each.name);
    const panel = make("section", { role: "tabpanel", id: `panel-${id}`, "aria-labelledby": `tab-${id}`, class: "panel" });
    panel.hidden = true;
    tabs.append(tab);
    shown.set(each.name, { tab, panel, room: each });
  }
  tabs.addEventListener("keydown", (event) => {
    const names = ROOMS.map((each) => each.name);
    const way = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    const to = event.key === "Home" ? 0 : event.key === "End" ? names.length - 1
      : way ? (names.indexOf(current) + way + names.length) % names.length : -1;
    if (to < 0) return;
    event.preventDefault();
    void open(names[to]);
    shown.get(names[to])?.tab.focus();
  });
  title(room.layout);
  document.getElementById("shell")?.replaceChildren(
    make("header", { class: "top" }, heading, tabs, told), panels);
  await styled;
  await open(ROOMS[0].name);
  document.body.dataset.ready = "true";
}

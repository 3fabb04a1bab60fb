// @ts-check
// The fields of what is selected on the floor.

import { make } from "./build.js";
import { kindOf } from "./layout_board.js";

/** @typedef {(edits: Record<string, any>[], label: string) => Promise<string>} Do */

/**
 * @param {string} label
 * @param {string | number} value
 * @param {(value: string) => void} changed
 * @param {Record<string, any>} [more]
 */
function field(label, value, changed, more = {}) {
  const input = /** @type {HTMLInputElement} */ (make("input", { value, type: "text", "aria-label": label, ...more }));
  input.addEventListener("change", () => input.value !== String(value) && changed(input.value));
  return make("label", { class: "field" }, make("span", { "aria-hidden": "true" }, label), input);
}

/**
 * @param {string} label
 * @param {number} value
 * @param {(value: number) => void} changed
 * @param {number} [step]
 */
function number(label, value, changed, step = 0.05) {
  const least = step === 1 ? 0 : null;
  const shown = step === 1 ? value : Number(value.toFixed(3));
  return field(label, shown, (text) => text.trim() !== "" && changed(Number(text)), { type: "number", step: step === 1 ? 1 : "any", min: least });
}

/**
 * @param {string} label
 * @param {[string, string][]} options value and words
 * @param {string} value
 * @param {(value: string) => void} changed
 */
function choice(label, options, value, changed) {
  const select = /** @type {HTMLSelectElement} */ (make("select", { "aria-label": label },
    ...options.map(([key, words]) => make("option", { value: key, selected: key === value }, words))));
  select.addEventListener("change", () => changed(select.value));
  return make("label", { class: "field" }, make("span", { "aria-hidden": "true" }, label), select);
}

/** @param {string} label @param {() => void} pressed */
const button = (label, pressed) => make("button", { type: "button", onclick: pressed }, label);

/**
 * What is to be shown for what is selected.
 * @param {string[]} selection
 * @param {any} things `Sketch.document`
 * @param {Do} edit
 * @param {() => void} remove
 * @returns {HTMLElement[]}
 */
export function fieldsFor(selection, things, edit, remove) {
  const remover = button("Delete", remove);
  if (!selection.length || !things) {
    return [make("p", { class: "soft" }, "Select something on the floor to see what it is. Arrow keys move it by 5 cm, with Shift by 50.")];
  }
  if (selection.length > 1) {
    return [make("p", {}, `${selection.length} things: drag one of them, and all move.`), remover];
  }
  const what = selection[0];
  const which = what.slice(kindOf(what).length + 1);
  const make_ = MAKERS[kindOf(what)];
  const title = make("h2", {}, what);
  return [title, ...(make_ ? make_(what, which, things, edit) : []), ...(what === "robot agent" || Object.keys(things.robots).join() === which ? [] : [remover])];
}

/** @param {string} what @param {string} which @param {Do} edit */
const naming = (what, which, edit) => field("Name", which, (name) => void edit([{ do: "rename", what, name }], `rename ${what}`));

/** @param {string} what @param {number[] | null} at @param {Do} edit */
function placing(what, at, edit) {
  if (!at) return [];
  const put = (/** @type {number[]} */ to) => void edit([{ do: "place", what, at: to }], `move ${what}`);
  return [number("x", at[0], (x) => put([x, at[1]])), number("y", at[1], (y) => put([at[0], y]))];
}

/** @param {string} text names with commas or blanks between */
const names = (text) => text.split(/[\s,]+/).filter(Boolean);

/** @type {Record<string, (what: string, which: string, things: any, edit: Do) => HTMLElement[]>} */
const MAKERS = {
  node(what, which, things, edit) {
    const stand = (/** @type {string} */ who) => () => void edit([{ do: "stand", what: who, node: which }], `${who} on ${which}`);
    return [
      naming(what, which, edit), ...placing(what, things.nodes[which], edit),
      ...(things.entrance === which ? [] : [button("Entrance here", stand("entrance"))]),
      ...Object.entries(things.robots).filter(([, node]) => node !== which)
        .map(([name]) => button(name === "agent" ? "Robot starts here" : `${name} starts here`, stand(`robot ${name}`))),
    ];
  },
  table(what, which, things, edit) {
    const table = things.tables[which];
    const set = (/** @type {string} */ key, /** @type {any} */ value) => void edit([{ do: "set", what, key, value }], `${key} of ${which}`);
    return [
      naming(what, which, edit),
      number("Capacity", table.capacity, (value) => set("capacity", value), 1),
      number("Chairs", table.chairs, (value) => set("chairs", value), 1),
      number("Width", table.size[0], (value) => set("size", [value, table.size[1]])),
      number("Depth", table.size[1], (value) => set("size", [table.size[0], value])),
      ...placing(what, table.at, edit),
      field("Reached from", table.nodes.join(", "), (text) => set("nodes", names(text))),
      button("Turn", () => void edit([{ do: "turn", what }], `turn ${which}`)),
    ];
  },
  path(what, which, things, edit) {
    const [a, b] = which.split(" ");
    const found = things.paths.find((/** @type {any[]} */ path) => path[0] === a && path[1] === b);
    const ways = /** @type {[string, string][]} */ ([["", "both ways"], [a, `${a} to ${b} only`], [b, `${b} to ${a} only`]]);
    return [choice("Leads", ways, found?.[2] ? a : "", (from) =>
      void edit([{ do: "one_way", what, from: from || null }], `direction of ${what}`))];
  },
  wall(what, which, things, edit) {
    const ends = things.walls[Number(which) - 1] ?? [];
    return ends.flatMap((/** @type {number[]} */ at, /** @type {number} */ end) => {
      const put = (/** @type {number[]} */ to) => void edit([{ do: "place", what, end, at: to }], `move ${what}`);
      return [number(`x ${end + 1}`, at[0], (x) => put([x, at[1]])), number(`y ${end + 1}`, at[1], (y) => put([at[0], y]))];
    });
  },
  bar(what, which, things, edit) {
    return [field("Reached from", (things.bar ?? []).join(", "), (text) =>
      void edit([{ do: "set", what, key: "nodes", value: names(text) }], "nodes of the bar"))];
  },
  robot(what, which, things, edit) {
    const own = what === "robot agent" ? [] : [naming(what, which, edit)];
    return [...own, standing("Starts on", what, things.robots[which], things, edit)];
  },
  waiter(what, which, things, edit) {
    const own = Object.entries(things.timetable[which] ?? {});
    const send = (/** @type {number} */ step, /** @type {string | null} */ node) =>
      void edit([{ do: "timetable", what, step, node }], `timetable of ${which}`);
    const nodes = Object.keys(things.nodes);
    const step = /** @type {HTMLInputElement} */ (make("input", { type: "number", min: 1, step: 1, value: Math.max(0, ...own.map(([at]) => Number(at))) + 1, "aria-label": "From step" }));
    const to = /** @type {HTMLSelectElement} */ (make("select", { "aria-label": "Stands on node" }, ...nodes.map((name) => make("option", { value: name }, name))));
    return [
      naming(what, which, edit), standing("Stands on", what, things.staff[which], things, edit),
      make("h3", {}, "Timetable"),
      ...own.map(([at, node]) => make("div", { class: "row" }, `from step ${at}: ${node}`,
        make("button", { type: "button", "aria-label": `Remove step ${at}`, onclick: () => send(Number(at), null) }, "Remove"))),
      make("div", { class: "row" }, step, to, button("Add step", () => send(Number(step.value), to.value))),
    ];
  },
};

/**
 * @param {string} label
 * @param {string} what
 * @param {string} node
 * @param {any} things
 * @param {Do} edit
 */
function standing(label, what, node, things, edit) {
  const nodes = /** @type {[string, string][]} */ (Object.keys(things.nodes).map((name) => [name, name]));
  return choice(label, nodes, node, (to) => void edit([{ do: "stand", what, node: to }], `move ${what}`));
}

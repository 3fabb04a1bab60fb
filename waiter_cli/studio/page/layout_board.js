// @ts-check
// The floor on which a restaurant is laid out: what is selected, dragged and added there.

import { Floor } from "./floor.js";
import { Picture } from "./layout_picture.js";
import { GRID, round, snap } from "./layout_snap.js";
import { robotsOf, waysOf } from "./robots.js";
import { shape } from "./shapes.js";

/** @typedef {Record<string, any>} Edit an edit of `waiter_cli/editing/edits.py` */
/** @typedef {[number, number]} Point */

/** Tools that put somebody on a node: the edit, and how one is on it.
 * @type {Record<string, [string, string]>} */
const STANDING = { colleague: ["add_waiter", "stands"], robot: ["add_robot", "starts"] };
const MOVABLE = ["node", "table", "wall", "bar"];
/** @type {Record<string, number[]>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** @param {string} name */
export const kindOf = (name) => name.split(" ")[0];

export class Board {
  /**
   * @param {Element} host
   * @param {{edit: (edits: Edit[], label: string) => Promise<string>, selected: () => void,
   *   say: (text: string, bad?: boolean) => void, tool: (name: string) => void,
   *   measured: (one: Point, other: Point) => void}} told
   */
  constructor(host, told) {
    this.told = told;
    this.floor = new Floor(host, { interactive: true });
    this.picture = new Picture(this.floor);
    /** @type {string[]} */
    this.selection = [];
    this.tool = "";
    /** @type {any} what things are: `Sketch.document` */
    this.things = null;
    /** @type {Point} added to places of the drawing for those of the file */
    this.origin = [0, 0];
    /** @type {number[] | null} */
    this.bounds = null;
    /** @type {Point[]} where the tool at work was used already */
    this.begun = [];
    /** @type {string | null} the node that the tool Path goes on from */
    this.from = null;
    /** @type {Point | null} where the keyboard points */
    this.cross = null;
    /** @type {any} */
    this.drag = null;
    /** @type {string | null} what is selected once it is drawn */
    this.next = null;
    this.route = shape("g", { class: "route", "aria-hidden": "true" });
    this.hints = shape("g", { class: "hints", "aria-hidden": "true" });
    this.floor.layers.above.append(this.route, this.hints);
    const svg = this.floor.svg;
    svg.setAttribute("tabindex", "-1");
    svg.addEventListener("pointerdown", (event) => this.#down(event));
    svg.addEventListener("pointermove", (event) => this.#moved(event));
    svg.addEventListener("pointerup", (event) => void this.#up(event));
    svg.addEventListener("pointercancel", () => this.#drop());
    svg.addEventListener("keydown", (event) => this.#key(event));
    svg.addEventListener("focusin", (event) => {
      const name = this.floor.nameAt(event);
      if (name && !this.drag && !this.selection.includes(name)) this.select([name]);
    });
  }

  // -- what is there ------------------------------------------------------------------------

  /**
   * Draws what the server's `view_of` gave.
   * @param {any} view
   */
  show(view) {
    if (!view.room) return;
    this.things = view.things;
    this.origin = view.origin ?? [0, 0];
    const had = document.activeElement?.getAttribute("data-thing");
    const [a0, a1, b0, b1] = view.room.bounds;
    const old = this.bounds ?? view.room.bounds;
    this.bounds = [Math.min(a0, old[0]), Math.max(a1, old[1]), Math.min(b0, old[2]), Math.max(b1, old[3])];
    this.floor.show({ ...view.room, bounds: this.bounds });
    /** @type {Record<string, any>} */
    const moment = { chairs: {} };
    for (const [name, table] of Object.entries(view.things.tables)) moment.chairs[name] = table.chairs;
    Object.assign(moment, robotsOf(view.things.robots, view.room.nodes));
    for (const [name, node] of Object.entries(view.things.staff)) {
      const at = view.room.nodes[node];
      if (at) moment[`@${name}`] = [at[0] * 100, at[1] * 100, 0, "waiter", 0, "stands", 0];
    }
    this.floor.move(moment);
    for (const [name, thing] of this.floor.things) {
      if (MOVABLE.includes(kindOf(name))) thing.removeAttribute("transform");
    }
    if (this.next && this.floor.find(this.next)) this.selection = [this.next];
    this.next = null;
    this.selection = this.selection.filter((name) => this.floor.find(name));
    this.#mark();
    if (had && document.activeElement === document.body) this.floor.focus(this.selection[0] ?? had);
    this.told.selected();
  }

  /** Shows all of it, and no more. */
  fit() {
    this.bounds = null;
  }

  /**
   * Marks what remarks are about.
   * @param {Set<string>} names
   */
  found(names) {
    for (const [name, thing] of this.floor.things) thing.classList.toggle("found", names.has(name));
  }

  /** @param {string[][]} routes the ways of a plan, by nodes */
  showRoutes(routes) {
    this.route.replaceChildren(...waysOf(routes, this.floor.room?.nodes ?? {}));
  }

  /**
   * @param {string[]} names
   * @param {boolean} [focus]
   */
  select(names, focus = false) {
    this.selection = names.filter((name) => this.floor.find(name));
    this.#mark();
    if (focus && this.selection.length) this.floor.focus(this.selection[0]);
    this.told.selected();
  }

  #mark() {
    for (const [name, thing] of this.floor.things) {
      const chosen = this.selection.includes(name);
      thing.classList.toggle("chosen", chosen);
      if (chosen) thing.setAttribute("aria-pressed", "true");
      else thing.removeAttribute("aria-pressed");
    }
  }

  /**
   * Where a thing is in the drawing.
   * @param {string} name
   * @returns {Point | null}
   */
  placeOf(name) {
    const room = this.floor.room;
    const [kind, which] = name.split(" ");
    if (!room) return null;
    const box = kind === "node" ? room.nodes[which] : kind === "table" ? room.tables[which]
      : kind === "wall" ? room.walls[Number(which) - 1] : kind === "bar" ? room.bar : null;
    return box ? [box[0], box[1]] : null;
  }

  /** Everything that can be moved.
   * @returns {string[]} */
  all() {
    return [...this.floor.things.keys()].filter((name) => MOVABLE.includes(kindOf(name)));
  }

  /** Deletes what is selected. */
  async remove() {
    if (!this.selection.length) return;
    const what = this.selection;
    this.selection = [];
    await this.told.edit([{ do: "delete", what }], `delete ${what.join(", ")}`);
    this.floor.svg.focus();
  }

  /**
   * @param {string[]} names
   * @param {number} dx
   * @param {number} dy
   */
  move(names, dx, dy) {
    const what = names.filter((name) => MOVABLE.includes(kindOf(name)));
    if (!what.length || (!dx && !dy)) return Promise.resolve("");
    /** @type {Record<string, any>} */
    const drawn = {};
    for (const name of what) {
      const box = name === "bar" ? this.floor.room?.bar : this.placeOf(name);
      if (box) drawn[name] = [box[0] + this.origin[0], box[1] + this.origin[1], ...box.slice(2, 4)];
    }
    return this.told.edit([{ do: "move", what, by: [round(dx), round(dy)], drawn }], `move ${what.join(", ")}`);
  }

  // -- tools ----------------------------------------------------------------------------------

  /**
   * Takes up a tool, or lays it down again.
   * @param {string} name `node path table wall bar colleague robot scale`, empty for none
   * @param {boolean} [byKeys] a cross is then moved by arrow keys
   */
  use(name, byKeys = false) {
    this.tool = name;
    this.begun = [];
    this.from = name === "path" && kindOf(this.selection[0] ?? "") === "node" ? this.selection[0].slice(5) : null;
    this.cross = null;
    this.floor.svg.classList.toggle("adding", name !== "");
    if (name && byKeys) {
      const [x0, x1, y0, y1] = this.bounds ?? [0, 1, 0, 1];
      const start = this.placeOf(this.selection[0] ?? "") ?? [(x0 + x1) / 2, (y0 + y1) / 2];
      this.cross = snap(/** @type {Point} */ (start), []).at;
      this.floor.svg.focus();
    }
    this.#hint();
    this.told.tool(name);
  }

  /** @param {Point} at in the drawing @param {string | null} name */
  async #useAt(at, name) {
    const place = this.#inFile(at);
    const node = name && kindOf(name) === "node" ? name.slice(5) : null;
    if (this.tool === "node") await this.#added([{ do: "add_node", at: place }], "add a node");
    if (this.tool === "table") await this.#added([{ do: "add_table", at: place }], "add a table");
    if (this.tool in STANDING) {
      const [add, where] = STANDING[this.tool];
      if (!node) return this.told.say(`Click the node on which the ${this.tool} ${where}.`, true);
      await this.#added([{ do: add, node }], `add a ${this.tool}`);
    }
    if (this.tool === "path") await this.#path(node, place);
    if (["wall", "bar", "scale"].includes(this.tool)) {
      this.begun.push(at);
      if (this.begun.length === 2) {
        const [one, other] = this.begun;
        this.begun = [];
        if (this.tool === "scale") {
          this.use("");
          this.told.measured(one, other);
          return;
        }
        const ends = { from: this.#inFile(one), to: this.#inFile(other) };
        await this.#added([{ do: `add_${this.tool}`, ...ends }], `add a ${this.tool}`);
        if (this.tool === "bar") this.use("");
      }
    }
    this.#hint();
  }

  /** @param {string | null} node @param {Point} place */
  async #path(node, place) {
    const from = this.from;
    if (!from) {
      if (node) this.from = node;
      else this.from = (await this.#added([{ do: "add_node", at: place }], "add a node")).slice(5) || null;
    } else if (node && node !== from) {
      await this.#added([{ do: "add_path", ends: [from, node] }], `join ${from} to ${node}`);
      this.from = node;
    } else if (!node) {
      const added = await this.#added([{ do: "add_node", at: place, joined: from }], `join ${from} to a new node`);
      this.from = added ? added.slice(5) : from;
    }
  }

  /** @param {Edit[]} edits @param {string} label */
  async #added(edits, label) {
    const added = await this.told.edit(edits, label);
    if (added && this.floor.find(added)) this.select([added]);
    else if (added) this.next = added;
    return added;
  }

  /** @param {Point} at @returns {Point} */
  #inFile([x, y]) {
    return [round(x + this.origin[0]), round(y + this.origin[1])];
  }

  /** @param {Point} at @param {string[]} [but] things that do not count @param {boolean} [free] */
  #snapped(at, but = [], free = false) {
    const others = this.all().filter((name) => !but.includes(name)).map((name) => this.placeOf(name));
    return snap(at, /** @type {Point[]} */ (others.filter(Boolean)), free);
  }

  /** @param {Point} at */
  #nodeNear(at, within = 0.3) {
    let best = null;
    for (const [name, [x, y]] of Object.entries(this.floor.room?.nodes ?? {})) {
      const far = Math.hypot(x - at[0], y - at[1]);
      if (far <= within) [best, within] = [`node ${name}`, far];
    }
    return best;
  }

  // -- pointer --------------------------------------------------------------------------------

  /** @param {PointerEvent} event */
  #down(event) {
    if (event.button !== 0) return;
    const name = this.floor.nameAt(event);
    const at = this.floor.at(event);
    event.preventDefault();
    if (this.tool) {
      const place = this.tool === "scale" || event.altKey ? /** @type {Point} */ (at) : this.#snapped(at).at;
      void this.#useAt(place, name ?? this.#nodeNear(at));
      return;
    }
    this.floor.svg.setPointerCapture(event.pointerId);
    const more = event.shiftKey || event.ctrlKey || event.metaKey;
    if (name) {
      const chosen = this.selection.includes(name);
      if (more) this.select(chosen ? this.selection.filter((each) => each !== name) : [...this.selection, name]);
      else if (!chosen) this.select([name]);
      this.drag = { kind: ["robot", "waiter"].includes(kindOf(name)) ? "stand" : "move", name, start: at, by: [0, 0], wasChosen: chosen && !more };
      this.floor.focus(name);
    } else {
      if (!more) this.select([]);
      this.drag = { kind: "box", start: at, kept: more ? this.selection : [] };
      this.floor.svg.focus();
    }
  }

  /** @param {PointerEvent} event */
  #moved(event) {
    const at = this.floor.at(event);
    if (!this.drag) {
      if (this.tool) this.#hint(this.tool === "scale" ? { at, guides: [] } : this.#snapped(at, [], event.altKey));
      return;
    }
    const { kind, start, name } = this.drag;
    const raw = [at[0] - start[0], at[1] - start[1]];
    if (!this.drag.moved && Math.hypot(raw[0], raw[1]) < 0.06) return;
    this.drag.moved = true;
    if (kind === "box") {
      const [x, y] = [Math.min(start[0], at[0]), Math.max(start[1], at[1])];
      const box = { x, y: -y, width: Math.abs(raw[0]), height: Math.abs(raw[1]), class: "marquee" };
      this.hints.replaceChildren(shape("rect", box));
      const inside = this.all().filter((each) => {
        const [px, py] = this.placeOf(each) ?? [Infinity, Infinity];
        return (px - start[0]) * (px - at[0]) <= 0 && (py - start[1]) * (py - at[1]) <= 0;
      });
      this.select([...new Set([...this.drag.kept, ...inside])]);
      return;
    }
    if (kind === "stand") {
      this.floor.find(name)?.setAttribute("transform", `translate(${at[0]} ${-at[1]})`);
      this.drag.to = this.#nodeNear(at, 1.5);
      const spot = this.drag.to ? this.placeOf(this.drag.to) : null;
      this.hints.replaceChildren(...(spot ? [shape("circle", { cx: spot[0], cy: -spot[1], r: 0.32, class: "goal" })] : []));
      return;
    }
    const place = this.placeOf(name);
    if (!place) return;
    const want = /** @type {Point} */ ([place[0] + raw[0], place[1] + raw[1]]);
    const moving = this.selection;
    const rest = this.#snapped(want, moving, event.altKey);
    this.drag.by = [round(rest.at[0] - place[0]), round(rest.at[1] - place[1])];
    this.#preview(moving, this.drag.by);
    this.#hint(rest, false);
  }

  /**
   * Moves things on the page, before anything is written.
   * @param {string[]} names
   * @param {number[]} by
   */
  #preview(names, [dx, dy]) {
    const shift = `translate(${dx} ${-dy})`;
    const nodes = new Set();
    for (const name of names) {
      if (MOVABLE.includes(kindOf(name))) this.floor.find(name)?.setAttribute("transform", shift);
      if (kindOf(name) === "node") nodes.add(name.slice(5));
    }
    const room = this.floor.room;
    for (const [a, b] of nodes.size && room ? room.edges : []) {
      for (const line of this.floor.find(`path ${a} ${b}`)?.children ?? []) {
        [a, b].forEach((end, i) => {
          const [x, y] = room?.nodes[end] ?? [0, 0];
          line.setAttribute(`x${i + 1}`, String(x + (nodes.has(end) ? dx : 0)));
          line.setAttribute(`y${i + 1}`, String(-y - (nodes.has(end) ? dy : 0)));
        });
      }
    }
  }

  /** @param {PointerEvent} event */
  async #up(event) {
    const drag = this.drag;
    this.drag = null;
    this.#hint();
    if (!drag) return;
    if (!drag.moved) {
      if (drag.wasChosen && this.selection.length > 1) this.select([drag.name]);
      return;
    }
    if (drag.kind === "stand" && drag.to) {
      await this.told.edit([{ do: "stand", what: drag.name, node: drag.to.slice(5) }], `move ${drag.name}`);
    } else if (drag.kind === "move") {
      await this.move(this.selection, drag.by[0], drag.by[1]);
    }
    event.preventDefault();
  }

  #drop() {
    if (this.drag?.moved) this.#preview(this.selection, [0, 0]);
    this.drag = null;
    this.#hint();
  }

  // -- keys -----------------------------------------------------------------------------------

  /** @param {KeyboardEvent} event */
  #key(event) {
    const name = this.floor.nameAt(event);
    const arrow = ARROWS[event.key];
    const far = event.shiftKey ? 10 : 1;
    let used = true;
    const acting = arrow || event.key === "Delete" || event.key === "Backspace";
    if (name && !this.selection.length && acting && !event.ctrlKey) this.select([name]);
    if (event.key === "Escape") {
      if (this.tool) this.use("");
      else this.select([]);
    } else if (this.tool && this.cross) {
      if (arrow) {
        this.cross = [round(this.cross[0] + arrow[0] * GRID * far), round(this.cross[1] + arrow[1] * GRID * far)];
        this.#hint();
      } else if (event.key === "Enter" || event.key === " ") void this.#useAt(this.cross, this.#nodeNear(this.cross));
      else used = false;
    } else if (this.tool && name && (event.key === "Enter" || event.key === " ")) {
      void this.#useAt(this.placeOf(name) ?? [0, 0], name);
    } else if (arrow && (event.ctrlKey || event.metaKey)) {
      const next = this.floor.beside(name ?? "", arrow[0], -arrow[1]);
      if (next) {
        if (!event.shiftKey) this.selection = [];
        this.select([...this.selection, next]);
        this.floor.focus(next);
      }
    } else if (arrow && name && ["robot", "waiter"].includes(kindOf(name))) {
      const node = this.things?.robots[name.slice(6)] ?? this.things?.staff[name.slice(7)];
      const next = this.#nodeBeside(node, arrow);
      if (next) void this.told.edit([{ do: "stand", what: name, node: next }], `move ${name}`);
    } else if (arrow && this.selection.length) {
      void this.move(this.selection, arrow[0] * GRID * far, arrow[1] * GRID * far);
    } else if (event.key === "Delete" || event.key === "Backspace") void this.remove();
    else if (event.key.toLowerCase() === "a" && (event.ctrlKey || event.metaKey)) this.select(this.all());
    else if (event.key === "PageDown" || event.key === "PageUp") this.#turn(name, event.key === "PageDown" ? 1 : -1);
    else used = false;
    if (used) {
      event.preventDefault();
      event.stopPropagation();
    }
  }

  /** @param {string | null} name @param {number} way to the next thing, or the one before */
  #turn(name, way) {
    const names = [...this.floor.things.keys()];
    if (!names.length) return;
    const next = names[(names.indexOf(name ?? "") + way + names.length) % names.length];
    this.select([next]);
    this.floor.focus(next);
  }

  /** @param {string} node @param {number[]} arrow */
  #nodeBeside(node, [dx, dy]) {
    const nodes = this.floor.room?.nodes ?? {};
    const here = nodes[node];
    let [best, least] = [/** @type {string | null} */ (null), Infinity];
    for (const [name, at] of Object.entries(nodes)) {
      if (!here || name === node) continue;
      const along = (at[0] - here[0]) * dx + (at[1] - here[1]) * dy;
      const across = Math.abs((at[0] - here[0]) * dy) + Math.abs((at[1] - here[1]) * dx);
      const far = along + 2 * across;
      if (along > 0.02 && across <= 2 * along && far < least) [best, least] = [name, far];
    }
    return best;
  }

  /**
   * Draws the cross, guides and what a tool has begun.
   * @param {{at: Point, guides: {across: boolean, at: number, from: number[]}[]} | null} [rest]
   * @param {boolean} [cross]
   */
  #hint(rest = this.cross ? { at: this.cross, guides: [] } : null, cross = true) {
    const drawn = [];
    const [x0, x1, y0, y1] = this.bounds ?? [0, 0, 0, 0];
    for (const guide of rest?.guides ?? []) {
      const ends = guide.across ? { x1: x0, x2: x1, y1: -guide.at, y2: -guide.at } : { x1: guide.at, x2: guide.at, y1: -y0, y2: -y1 };
      drawn.push(shape("line", { ...ends, class: "guide" }));
    }
    if (rest && cross) {
      const [x, y] = rest.at;
      drawn.push(shape("path", { d: `M${x - 0.2} ${-y}h.4M${x} ${-y - 0.2}v.4`, class: "cross" }));
      const start = this.begun[0] ?? (this.from ? this.placeOf(`node ${this.from}`) : null);
      if (start) drawn.push(shape("line", { x1: start[0], y1: -start[1], x2: x, y2: -y, class: "guide" }));
    }
    for (const [x, y] of this.begun) drawn.push(shape("circle", { cx: x, cy: -y, r: 0.07, class: "pin" }));
    this.hints.replaceChildren(...drawn);
  }
}

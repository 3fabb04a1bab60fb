// @ts-check
// The floor of a restaurant as SVG: what stands still here, who moves in figures.js.
//
// Serves the studio and the replay page. `Floor.show(room)` draws a room document, `Floor.move(moment)`
// puts everybody where a moment has them. Both may be called as often as you like; elements that are
// still there stay (and keep the focus).

import { Figures } from "./figures.js";
import { disc, lettering, shape, slab } from "./shapes.js";

/**
 * What stands in a room, in metres: `room_document` of pictures/html_page.py. A box is
 * [x, y, half width, half height, yaw]; an arrow has three corners, its tip first.
 * @typedef {{layout: string, bounds: number[], nodes: Record<string, number[]>, edges: string[][],
 *   arrows: number[][][], entrance: string, door: number[], waiting: number[][], tables: Record<string, number[]>,
 *   chairs: Record<string, number[][]>, bar: number[] | null, walls: number[][], robot: number,
 *   person: number}} RoomDocument
 */

/** @typedef {import("./moments.js").Moment} Moment */

/** Where the word beside the entrance may stand, in metres from it, and to which side it runs. */
const BESIDE = [[-0.2, 0.2, -1], [0.2, -0.34, 1], [-0.2, -0.34, -1], [0.2, 0.44, 1]];

/** How wide and high that word is at the most, in metres. */
const WORD = [1.2, 0.3];

const LAYERS = ["ground", "edges", "walls", "furniture", "nodes", "figures", "names", "bubbles", "above"];

const STACKED = 6; // pixels between things at one place

export class Floor {
  /**
   * @param {Element} host is filled by the drawing
   * @param {{interactive?: boolean, label?: string, robotName?: string}} [options] with `interactive`
   *   each thing can have the focus and bears its accessible name; without, the floor is one picture
   */
  constructor(host, options = {}) {
    this.interactive = options.interactive ?? false;
    /** Left, low, width and height of the word beside the entrance, in metres. @type {number[]} */
    this.word = [];
    /** @type {RoomDocument | null} */
    this.room = null;
    this.svg = /** @type {SVGSVGElement} */ (
      shape("svg", {
        class: "floor",
        role: this.interactive ? "application" : "img",
        "aria-label": options.label ?? "floor",
        preserveAspectRatio: "xMidYMid meet",
      })
    );
    /** Groups of the drawing, lowest first: `ground edges walls furniture nodes figures names bubbles
     * above`; `above` is for guides and handles of whoever uses the floor.
     * @type {Record<string, SVGElement>} */
    this.layers = {};
    for (const name of LAYERS) {
      this.layers[name] = shape("g", { class: `layer-${name}` });
      this.svg.append(this.layers[name]);
    }
    /** @type {Map<string, SVGElement>} */
    this.things = new Map();
    this.figures = new Figures(this, options.robotName ?? "agent");
    /** Size of letters, in metres. @type {string | null} */
    this.letters = null;
    host.append(this.svg);
    new ResizeObserver(() => this.#fit()).observe(this.svg);
  }

  /**
   * The element of a thing by its accessible name: `node n5`, `table table1`, `path n4 n5`, `bar`,
   * `wall 1`, `robot agent`, `waiter w1`, `party c1`.
   * @param {string} name
   */
  find(name) {
    return this.things.get(name) ?? null;
  }

  /**
   * The accessible name of the thing at which an event happened, null beside all of them.
   * @param {Event} event
   */
  nameAt(event) {
    const element = /** @type {Element | null} */ (event.target);
    return element?.closest("[data-thing]")?.getAttribute("data-thing") ?? null;
  }

  /**
   * The place of a pointer event in metres.
   * @param {{clientX: number, clientY: number}} event
   * @returns {[number, number]}
   */
  at(event) {
    const matrix = this.svg.getScreenCTM();
    if (!matrix) return [0, 0];
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    return [point.x, -point.y];
  }

  /**
   * A group that stands for a thing; it takes the place of one that has that name already.
   * @param {string} name accessible name
   * @param {string} layer
   * @param {string} style class
   * @param {...SVGElement} children
   */
  put(name, layer, style, ...children) {
    let group = this.things.get(name);
    if (!group) {
      group = shape("g", { "data-thing": name });
      if (this.interactive) {
        group.setAttribute("tabindex", "-1");
        group.setAttribute("role", "button");
        group.setAttribute("aria-label", name);
      }
      this.things.set(name, group);
    }
    group.setAttribute("class", `thing ${style}`);
    group.replaceChildren(...children);
    if (group.parentNode !== this.layers[layer]) this.layers[layer].append(group);
    return group;
  }

  /** @param {string} name */
  remove(name) {
    const thing = this.things.get(name);
    thing?.remove();
    this.things.delete(name);
    if (thing?.getAttribute("tabindex") === "0") this.#oneTabStop();
  }

  /**
   * Draws what stands still.
   * @param {RoomDocument} room
   */
  show(room) {
    this.room = room;
    const [x0, x1, y0, y1] = room.bounds;
    const margin = 0.3;
    const box = [x0 - margin, -y1 - margin, x1 - x0 + 2 * margin, y1 - y0 + 2 * margin];
    this.svg.setAttribute("viewBox", box.map((v) => v.toFixed(3)).join(" "));
    const kept = new Set();
    const put = (/** @type {[string, string, string, ...SVGElement[]]} */ ...all) => {
      kept.add(all[0]);
      return this.put(...all);
    };
    this.#drawGround(room);
    for (const [a, b] of room.edges) {
      const [from, to] = [room.nodes[a], room.nodes[b]];
      const line = { x1: from[0], y1: -from[1], x2: to[0], y2: -to[1] };
      const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
      const half = Math.max(0.05, Math.hypot(dx, dy) / 2 - 0.2);
      // A surface: the box of a mere line has no width where it is upright, and cannot be hit.
      const grip = slab((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, half, 0.18, Math.atan2(dy, dx), "grip core");
      put(`path ${a} ${b}`, "edges", "edge", grip, shape("line", { ...line, class: "way" }));
    }
    this.layers.ground.append(...room.arrows.map((corners) =>
      shape("polygon", { points: corners.map(([x, y]) => `${x},${-y}`).join(" "), class: "arrow" })));
    room.walls.forEach(([x, y, hx, hy, yaw], i) => {
      put(`wall ${i + 1}`, "walls", "wall", slab(x, y, hx, hy, yaw, "wall-body", 0.02));
    });
    if (room.bar) {
      const [x, y, hx, hy, yaw] = room.bar;
      put("bar", "furniture", "bar", slab(x, y, hx, hy, yaw, "bar-body"), lettering("bar", x, y, "bar-name"));
    }
    for (const [name, table] of Object.entries(room.tables)) this.#drawTable(put, name, table, room);
    for (const [name, [x, y]] of Object.entries(room.nodes)) {
      const isEntrance = name === room.entrance;
      if (isEntrance) {
        const [dx, dy, side] = besideEntrance(x, y, room.waiting ?? []);
        this.word = [x + dx + Math.min(0, side * WORD[0]), y + dy, ...WORD];
        this.layers.names.replaceChildren(lettering("entrance", x + dx, y + dy, side < 0 ? "entrance-name" : "entrance-name right"));
      }
      put(`node ${name}`, "nodes", isEntrance ? "node entrance" : "node",
        disc(x, y, 0.24, "grip"), disc(x, y, 0.13, "spot core"), lettering(name, x + 0.17, y + 0.18, "node-name"));
    }
    for (const name of [...this.things.keys()]) {
      if (!kept.has(name) && !this.figures.owns(name)) this.remove(name);
    }
    this.#oneTabStop();
    this.#fit();
  }

  /** Letters have the same size on the page, whatever the room's; in a small drawing they shrink a little. */
  #fit() {
    const matrix = this.svg.getScreenCTM();
    if (!matrix?.a) return;
    const pixels = Math.max(11, Math.min(15, matrix.a * 0.22));
    const size = Math.min(0.42, pixels / matrix.a).toFixed(4);
    if (size === this.letters) return;
    this.letters = size;
    this.svg.style.setProperty("--letters", `${size}px`);
    this.figures.fitBubbles(Number(size));
  }

  /** @param {RoomDocument} room */
  #drawGround(room) {
    const [x0, x1, y0, y1] = room.bounds;
    const [cx, cy, hx, hy] = [(x0 + x1) / 2, (y0 + y1) / 2, (x1 - x0) / 2, (y1 - y0) / 2];
    const boards = [];
    for (let y = Math.ceil(y0 / 0.5) * 0.5; y < y1; y += 0.5) {
      boards.push(`M${x0} ${-y}H${x1}`);
    }
    const [dx, dy] = room.door;
    const [l, r] = [Math.max(x0, dx - 0.5), Math.min(x1, dx + 0.5)];
    const [d, u] = [Math.max(y0, dy - 0.38), Math.min(y1, dy + 0.38)];
    this.layers.ground.replaceChildren(
      slab(cx, cy, hx + 0.09, hy + 0.09, 0, "outside", 0.14),
      slab(cx, cy, hx, hy, 0, "boards", 0.08),
      shape("path", { d: boards.join(""), class: "seams" }),
      slab((l + r) / 2, (d + u) / 2, (r - l) / 2, (u - d) / 2, 0, "mat"),
    );
  }

  /**
   * @param {(name: string, layer: string, style: string, ...children: SVGElement[]) => SVGElement} put
   * @param {string} name
   * @param {number[]} table
   * @param {RoomDocument} room
   */
  #drawTable(put, name, [x, y, hx, hy, yaw], room) {
    const chairs = room.chairs[name].map(([cx, cy, turn]) => {
      const back = [cx - 0.17 * Math.cos(turn), cy - 0.17 * Math.sin(turn)];
      return shape("g", { class: "chair" }, slab(cx, cy, 0.19, 0.19, turn, "seat", 0.08),
        slab(back[0], back[1], 0.04, 0.19, turn, "chair-back", 0.03));
    });
    const plates = [[0.16, 0.16], [-0.16, -0.16]].flatMap(([dx, dy]) =>
      [disc(x + dx, y + dy, 0.1, "plate"), disc(x + dx, y + dy, 0.05, "food")]);
    put(`table ${name}`, "furniture", "table", ...chairs, slab(x, y, hx, hy, yaw, "table-top", 0.08),
      slab(x, y, Math.max(hx - 0.07, 0.05), Math.max(hy - 0.07, 0.05), yaw, "cloth", 0.05),
      shape("g", { class: "plates" }, ...plates), lettering(name, x, y, "table-name"));
  }

  /**
   * Writes notes beside tables and nodes, in place of those that stood there.
   * @param {Map<string, string[]>} notes by the thing's own name, such as table1
   */
  note(notes) {
    for (const old of this.svg.querySelectorAll(".note")) old.remove();
    for (const [name, said] of notes) {
      const [x, y, , half] = this.room?.tables[name] ?? this.room?.nodes[name] ?? [];
      if (x === undefined) continue;
      const below = half === undefined ? 0.3 : Math.min(0.25, half - 0.12);
      this.layers.names.append(lettering(said.join(", "), x, y - below, "note"));
    }
  }

  /**
   * Puts everybody where a moment has them.
   * @param {Moment} moment
   */
  move(moment) {
    if (!this.room) return;
    for (const name of Object.keys(this.room.tables)) {
      const group = this.things.get(`table ${name}`);
      if (!group) continue;
      const there = moment.chairs?.[name] ?? Infinity;
      group.querySelectorAll(".chair").forEach((chair, i) => chair.classList.toggle("away", i >= there));
      group.classList.toggle("served", moment.served?.includes(name) ?? false);
    }
    this.figures.move(moment);
  }

  /** Exactly one thing is reached by Tab; arrow keys (`stepFocus`) go on from there. */
  #oneTabStop() {
    if (!this.interactive) return;
    if ([...this.things.values()].some((thing) => thing.getAttribute("tabindex") === "0")) return;
    this.things.values().next().value?.setAttribute("tabindex", "0");
  }

  /**
   * Gives a thing the focus, and makes it the one that Tab comes back to.
   * @param {string} name
   */
  focus(name) {
    const thing = this.things.get(name);
    if (!thing) return;
    for (const other of this.things.values()) {
      if (other.getAttribute("tabindex") === "0") other.setAttribute("tabindex", "-1");
    }
    thing.setAttribute("tabindex", "0");
    thing.focus();
  }

  /**
   * The thing nearest to another one in a direction of the page, null where there is none. Of things at
   * one place, as a waiter and his node, the one drawn over another is above it.
   * @param {string} name
   * @param {number} dx -1, 0 or 1, to the right
   * @param {number} dy -1, 0 or 1, downwards
   */
  beside(name, dx, dy) {
    const middle = (/** @type {Element} */ element) => {
      const box = (element.querySelector(".core") ?? element).getBoundingClientRect();
      return [box.x + box.width / 2, box.y + box.height / 2];
    };
    const here = this.things.get(name);
    if (!here) return null;
    const [x, y] = middle(here);
    const stack = [...this.things.keys()].filter((other) => {
      const [ox, oy] = middle(/** @type {Element} */ (this.things.get(other)));
      return Math.hypot(ox - x, oy - y) < STACKED;
    });
    const next = dy ? stack[stack.indexOf(name) - dy] : undefined;
    if (next) return next;
    let best = null;
    let least = Infinity;
    for (const [other, element] of this.things) {
      if (stack.includes(other)) continue;
      const [ox, oy] = middle(element);
      const along = (ox - x) * dx + (oy - y) * dy;
      const across = Math.abs((ox - x) * dy) + Math.abs((oy - y) * dx);
      if (along < 2 || across > 2 * along) continue;
      const far = along + 2 * across;
      if (far < least) [best, least] = [other, far];
    }
    return best;
  }
}

/**
 * The place of the word beside the entrance, clear of whoever waits there and of their names.
 * @param {number} x
 * @param {number} y
 * @param {number[][]} waiting
 */
function besideEntrance(x, y, waiting) {
  const [wide, high] = WORD;
  const clear = (/** @type {number[]} */ [dx, dy, side]) => waiting.every(([px, py]) => {
    const [left, low] = [x + dx + Math.min(0, side * wide), y + dy];
    return px + 0.35 < left || px - 0.35 > left + wide || py + 0.3 < low || py - 0.5 > low + high;
  });
  return BESIDE.find(clear) ?? BESIDE[0];
}

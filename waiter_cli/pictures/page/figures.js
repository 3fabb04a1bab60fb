// @ts-check
// Who moves on a floor: the robot, guests, colleagues, strangers, and what they say.

import { lettering, shape } from "./shapes.js";

/** @typedef {import("./moments.js").Moment} Moment */

const SHIRTS = 8;
const HAIRS = 4;
const LOADS = ["plate", "jug", "basket"];

export class Figures {
  /**
   * @param {import("./floor.js").Floor} floor
   * @param {string} robotName
   */
  constructor(floor, robotName) {
    this.floor = floor;
    this.robot = `robot ${robotName}`;
    /** The name on the floor of everybody who is there, by the key of the moment.
     * @type {Map<string, string>} */
    this.named = new Map();
    /** @type {Map<string, string>} what was drawn of whom, so that only changes are drawn */
    this.drawn = new Map();
    /** First-listed members of parties, by any member; set by whoever knows them.
     * @type {Record<string, string>} */
    this.parties = {};
  }

  /**
   * Whether a thing of the floor is one of ours.
   * @param {string} name
   */
  owns(name) {
    return name === this.robot || [...this.named.values()].includes(name);
  }

  /** @param {Moment} moment */
  move(moment) {
    const here = new Set(Object.keys(moment));
    for (const [key, name] of [...this.named]) {
      if (!here.has(key)) this.#forget(key, name);
    }
    if (moment.robot) this.#place("robot", this.robot, moment.robot, () => robot(moment.robot[3]), String(moment.robot[3]));
    for (const key of here) {
      if (key[0] === "@") this.#person(key, moment[key]);
    }
    this.#bubbles(moment, here);
  }

  /**
   * @param {string} key
   * @param {any[]} person
   */
  #person(key, person) {
    const [, , , role, number, posture, hand] = person;
    const who = key.slice(1);
    const first = this.parties[who];
    const kind = role === "guest" ? (first === undefined || first === who ? "party" : "guest") : role;
    const looks = `${role} ${number} ${posture} ${hand}`;
    this.#place(key, `${kind} ${who}`, person, () => [...figure(role, number, hand), tag(who)], looks);
  }

  /**
   * @param {string} key
   * @param {string} name
   * @param {any[]} pose
   * @param {() => SVGElement[]} draw
   * @param {string} looks what it is drawn from, but for its place
   */
  #place(key, name, pose, draw, looks) {
    const before = this.named.get(key);
    if (before !== undefined && before !== name) this.#forget(key, before);
    if (this.drawn.get(key) !== looks || !this.floor.find(name)) {
      this.named.set(key, name);
      this.drawn.set(key, looks);
      const group = this.floor.put(name, "figures", `figure ${name.split(" ")[0]}`, ...draw());
      if (name.startsWith("guest ")) group.removeAttribute("tabindex");
    }
    const group = /** @type {SVGElement} */ (this.floor.find(name));
    const [x, y] = [pose[0] / 100, -pose[1] / 100];
    group.setAttribute("transform", `translate(${x.toFixed(3)} ${y.toFixed(3)})`);
    group.querySelector(".turning")?.setAttribute("transform", `rotate(${(-pose[2]).toFixed(1)})`);
  }

  /**
   * @param {string} key
   * @param {string} name
   */
  #forget(key, name) {
    this.floor.remove(name);
    this.named.delete(key);
    this.drawn.delete(key);
  }

  /**
   * @param {Moment} moment
   * @param {Set<string>} here
   */
  #bubbles(moment, here) {
    const layer = this.floor.layers.bubbles;
    const shown = new Map([...layer.children].map((child) => [child.getAttribute("data-speaker"), child]));
    for (const key of here) {
      if (key[0] !== "!") continue;
      const [x, y, text] = moment[key];
      let bubble = shown.get(key);
      shown.delete(key);
      if (!bubble || bubble.textContent !== text) {
        bubble?.remove();
        bubble = speech(key, text);
        layer.append(bubble);
        fit(bubble);
      }
      bubble.setAttribute("transform", `translate(${(x / 100).toFixed(3)} ${(-y / 100 - 0.34).toFixed(3)})`);
    }
    for (const gone of shown.values()) gone.remove();
  }
}

/**
 * @param {number} x
 * @param {number} y
 * @param {number} rx
 * @param {number} ry
 * @param {string} style
 */
function oval(x, y, rx, ry, style) {
  return shape("ellipse", { cx: x, cy: -y, rx, ry, class: style });
}

/** @param {string} load */
function robot(load) {
  const carried = LOADS.includes(load) ? [oval(0.33, 0, 0.09, 0.09, `load ${load}`)] : [];
  return [
    oval(0, 0, 0.4, 0.4, "halo core"),
    shape("g", { class: "turning" }, oval(0, 0, 0.25, 0.25, "robot-rim"), oval(0, 0, 0.205, 0.205, "robot-body"),
      oval(0.33, 0, 0.15, 0.15, "tray"), oval(0.09, 0, 0.06, 0.1, "robot-face"), ...carried),
  ];
}

/**
 * @param {string} role
 * @param {number} number
 * @param {number} hand
 */
function figure(role, number, hand) {
  const shirt = role === "guest" ? `shirt-${number % SHIRTS}` : `shirt-${role}`;
  const parts = [oval(-0.01, 0, 0.13, 0.225, `shirt ${shirt}`)];
  if (hand) parts.push(oval(0.16, 0.2, 0.07, 0.07, "skin"));
  if (role === "waiter") parts.push(oval(0.08, 0, 0.045, 0.05, "collar"));
  parts.push(oval(0.03, 0, 0.105, 0.1, "skin"), oval(-0.015, 0, 0.1, 0.1, `hair-${(number * 7 + 1) % HAIRS}`));
  return [oval(0, 0, 0.3, 0.3, "halo core"), shape("g", { class: "turning" }, ...parts)];
}

/** @param {string} who */
function tag(who) {
  return lettering(who, 0, -0.38, "person-name");
}

/**
 * @param {string} key
 * @param {string} text
 */
function speech(key, text) {
  return shape("g", { class: key === "!robot" ? "bubble robots" : "bubble", "data-speaker": key, "aria-hidden": "true" },
    shape("path", { class: "bubble-body" }), shape("text", { class: "bubble-text", y: -0.26 }, text));
}

/**
 * Draws a bubble round its text.
 * @param {Element} bubble
 */
function fit(bubble) {
  const text = /** @type {SVGTextElement} */ (bubble.lastElementChild);
  const half = Math.max(0.3, text.getBBox().width / 2 + 0.12);
  const round = 0.12;
  bubble.firstElementChild?.setAttribute("d",
    `M0 0L-0.08 -0.12H${-half + round}q${-round} 0 ${-round} ${-round}v-0.12q0 ${-round} ${round} ${-round}` +
    `H${half - round}q${round} 0 ${round} ${round}v0.12q0 ${round} ${-round} ${round}H0.08Z`);
}

// @ts-check
// Who moves on a floor: the robot, guests, colleagues, strangers, and what they say.

import { lettering, shape } from "./shapes.js";

/** @typedef {import("./moments.js").Moment} Moment */

const SHIRTS = 8;
const HAIRS = 4;
/** So many colours of robots `floor.css` has. */
export const ROBOT_COLOURS = 5;
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
    this.letters = 0.24;
    /** @type {Moment} */
    this.last = {};
    /** Who is held by a hand, and stays there. @type {{name: string, x: number, y: number} | null} */
    this.held = null;
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

  /**
   * Holds somebody at a place in metres, wherever moments have them.
   * @param {string} name
   * @param {number} x
   * @param {number} y
   */
  hold(name, x, y) {
    this.held = { name, x, y };
    const group = this.floor.find(name);
    group?.classList.add("dragged");
    group?.setAttribute("transform", `translate(${x.toFixed(3)} ${(-y).toFixed(3)})`);
  }

  /** Lets go of whoever is held. */
  release() {
    if (!this.held) return;
    const group = this.floor.find(this.held.name);
    group?.classList.remove("dragged");
    const key = [...this.named].find(([, name]) => name === this.held?.name)?.[0];
    this.held = null;
    if (key && this.last[key]) this.move(this.last);
  }

  /** @param {number} letters size of letters, in metres */
  fitBubbles(letters) {
    this.letters = letters;
    for (const bubble of this.floor.layers.bubbles.children) fit(bubble, letters);
  }

  /** @param {Moment} moment */
  move(moment) {
    this.last = moment;
    const here = new Set(Object.keys(moment));
    for (const [key, name] of [...this.named]) {
      if (!here.has(key)) this.#forget(key, name);
    }
    if (moment.robot) this.#place("robot", this.robot, moment.robot, () => robot(moment.robot[3]), String(moment.robot[3]));
    for (const key of here) {
      if (key.startsWith("robot ")) {
        const [, , , load, number] = moment[key];
        this.#place(key, key, moment[key], () => [...robot(load, number), tag(key.slice(6), 0.36)], `${load} ${number}`);
      }
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
    if (this.held?.name !== name) group.setAttribute("transform", `translate(${x.toFixed(3)} ${y.toFixed(3)})`);
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
        fit(bubble, this.letters);
      }
      bubble.setAttribute("transform", `translate(${(x / 100).toFixed(3)} ${(-y / 100 - 0.34).toFixed(3)})`);
    }
    for (const gone of shown.values()) gone.remove();
    hush(layer.children, [...here].filter((key) => /^(@|robot)/.test(key)).map((key) => moment[key]), this.floor.word, this.letters);
  }
}

/**
 * Hides bubbles that would cover another one, a word, or somebody else's head or name; robots speak first.
 * @param {Iterable<Element>} bubbles
 * @param {any[][]} people where they are, in centimetres
 * @param {number[]} word left, low, width and height of one that is not to be covered, in metres
 * @param {number} letters size of letters, in metres
 */
function hush(bubbles, people, word, letters) {
  /** @type {number[][]} left, right, low and high of what is in sight */
  const seen = people.map(([x, y]) => [x / 100 - 0.2, x / 100 + 0.2, y / 100 - 0.35, y / 100 + 0.2]);
  if (word.length) seen.push([word[0], word[0] + word[2], word[1], word[1] + word[3]]);
  const robotsFirst = [...bubbles].sort((a, b) => Number(b.classList.contains("robots")) - Number(a.classList.contains("robots")));
  for (const bubble of robotsFirst) {
    const [x, y] = (bubble.getAttribute("transform") ?? "").match(/-?[\d.]+/g)?.map(Number) ?? [0, 0];
    const half = Number(bubble.getAttribute("data-half"));
    const box = [x - half, x + half, -y + 0.1, -y + 2.2 * letters];
    const covered = seen.some(([l, r, d, u]) => box[0] < r && l < box[1] && box[2] < u && d < box[3]);
    bubble.classList.toggle("hushed", covered);
    if (!covered) seen.push(box);
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

/**
 * @param {string} load
 * @param {number} [number] of one of several
 */
function robot(load, number = 0) {
  const carried = LOADS.includes(load) ? [oval(0.33, 0, 0.09, 0.09, `load ${load}`)] : [];
  return [
    oval(0, 0, 0.4, 0.4, `halo core robot-${number % ROBOT_COLOURS}`),
    shape("g", { class: "turning" }, oval(0, 0, 0.25, 0.25, "robot-rim"), oval(0, 0, 0.205, 0.205, `robot-body robot-${number % ROBOT_COLOURS}`),
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

/**
 * A name below a figure, near enough that it stands clear of whoever waits behind.
 * @param {string} who
 * @param {number} [below] metres
 */
function tag(who, below = 0.22) {
  return lettering(who, 0, -below, "person-name");
}

/**
 * @param {string} key
 * @param {string} text
 */
function speech(key, text) {
  return shape("g", { class: /^!robot($| )/.test(key) ? "bubble robots" : "bubble", "data-speaker": key, "aria-hidden": "true" },
    shape("path", { class: "bubble-body" }), shape("text", { class: "bubble-text" }, text));
}

/**
 * Draws a bubble round its text.
 * @param {Element} bubble
 * @param {number} letters size of the letters, in metres
 */
function fit(bubble, letters) {
  const text = /** @type {SVGTextElement} */ (bubble.lastElementChild);
  const [tip, high] = [0.5 * letters, 1.7 * letters];
  const [half, round] = [Math.max(letters, text.getBBox().width / 2 + 0.55 * letters), high / 2.2];
  text.setAttribute("y", String(-tip - high / 2));
  bubble.setAttribute("data-half", half.toFixed(3));
  bubble.firstElementChild?.setAttribute("d",
    `M0 0L${-tip * 0.7} ${-tip}H${-half + round}a${round} ${round} 0 0 1 ${-round} ${-round}V${-tip - high + round}` +
    `a${round} ${round} 0 0 1 ${round} ${-round}H${half - round}a${round} ${round} 0 0 1 ${round} ${round}V${-tip - round}` +
    `a${round} ${round} 0 0 1 ${-round} ${round}H${tip * 0.7}Z`);
}

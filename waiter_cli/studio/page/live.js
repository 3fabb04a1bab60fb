// @ts-check
// The room Live: the restaurant in real time, under a person's hands.

import { make } from "./build.js";
import { deeds, ownDeeds } from "./live_menus.js";
import { ROBOT_COLOURS } from "./figures.js";
import { Floor } from "./floor.js";
import { handle } from "./live_hands.js";
import { ask, Live } from "./link.js";
import { openMenu } from "./menu.js";
import { after, between } from "./moments.js";
import { Past } from "./live_past.js";

const SPEEDS = [0.5, 1, 2, 4, 10, 30, 60];
const MOST_EVENTS = 300;
const KEEPSAKES = [
  ["scenario (YAML)", "scenario.yaml"], ["plan (JSON)", "plan.json"],
  ["replay page (HTML)", "replay.html"], ["journal", "evening.journal"],
];

/** @type {import("./main.js").Room} */
export const live = {
  name: "Live",
  async start(panel, studio) {
    const evening = new Evening(panel, studio);
    await evening.begun;
    return { enter: () => evening.enter() };
  },
};

class Evening {
  /**
   * @param {HTMLElement} panel
   * @param {import("./main.js").Studio} studio
   */
  constructor(panel, studio) {
    this.studio = studio;
    /** @type {Record<string, any>} */
    this.view = { blocked: [], state: {}, robots: [], rows: [], pending: [], goals: [], parties: [], own: { observables: [], fluents: [] } };
    this.me = 0;
    /** @type {import("./moments.js").Moment} */
    this.before = {};
    /** @type {import("./moments.js").Moment} */
    this.now = {};
    this.arrived = 0;
    this.lasts = 50; // milliseconds between moments
    this.time = 0;
    this.drawing = false;
    this.over = false;
    this.shownRows = "";
    this.past = new Past((moment, time) => this.#showPast(moment, time));
    const button = (/** @type {string} */ text, /** @type {() => void} */ act, /** @type {string} */ style = "") =>
      make("button", { type: "button", class: style || null, onclick: act }, text);
    this.guests = /** @type {HTMLInputElement} */ (
      make("input", { type: "number", min: 1, max: 50, value: 1, "aria-label": "Guests", class: "guests" }));
    this.playButton = button("Play", () => this.#play(true));
    this.pauseButton = button("Pause", () => this.#play(false));
    this.speed = /** @type {HTMLSelectElement} */ (make("select", {
      "aria-label": "Speed", onchange: () => this.link.send({ speed: Number(this.speed.value) }),
    }, ...SPEEDS.map((speed) => make("option", { value: speed }, `${speed}×`))));
    const keep = make("button", { type: "button", "aria-haspopup": "menu", onclick: () => this.#keep(keep) }, "Keep");
    this.ownButton = make("button", { type: "button", "aria-haspopup": "menu", hidden: true, onclick: () => this.#tellOwn() }, "Own words");
    const bar = make("div", { class: "bar", role: "toolbar", "aria-label": "evening" },
      make("span", { class: "group" }, button("New guests", () => this.#newGuests(), "main"), this.guests),
      make("span", { class: "group" }, this.playButton, this.pauseButton, button("Step", () => this.#step()), this.speed), this.ownButton, keep);
    this.host = make("div", { class: "floor-host" });
    this.banner = make("p", { class: "banner", role: "alert", hidden: true });
    this.newer = make("p", { class: "newer", role: "status", "aria-label": "layout", hidden: true },
      "The layout was saved with changes. This evening goes on in the one before.",
      button("New evening", () => this.#beginAnew()));
    this.slider = /** @type {HTMLInputElement} */ (make("input", {
      type: "range", "aria-label": "Time", min: 0, max: 1, step: "any", value: 1, oninput: () => this.#seek(Number(this.slider.value)),
    }));
    this.clock = make("output", { class: "clock" }, "0:00");
    this.nowButton = button("Now", () => this.#toNow());
    this.nowButton.hidden = true;
    const time = make("div", { class: "time" }, this.slider, this.clock, this.nowButton);
    this.proof = make("p", { role: "status", "aria-label": "proof", class: "proof" });
    this.plan = make("ol", { "aria-label": "plan", class: "plan", tabindex: "0" });
    this.pending = make("ul", { "aria-label": "pending", class: "pending" });
    this.goals = make("ul", { "aria-label": "goals", class: "goals" });
    this.robots = make("ul", { "aria-label": "robots", class: "goals" });
    this.stories = make("ol", { "aria-label": "diagnosis", class: "stories" });
    this.storiesOf = make("p", { class: "hint" });
    this.events = make("div", { role: "log", "aria-label": "events", class: "events", tabindex: "0" });
    const card = (/** @type {string} */ title, /** @type {string} */ style, /** @type {Node[]} */ ...inside) =>
      make("section", { class: `card ${style}` }, make("h2", {}, title), ...inside);
    this.crew = card("Robots", "crew", this.robots);
    this.holding = make("ul", { "aria-label": "own fluents", class: "pending" });
    this.holds = card("Holds", "holds", this.holding);
    this.waits = card("Waits", "waits", this.pending);
    this.wanted = card("Wanted", "wanted", make("p", { class: "hint" }, "Only this is pursued until it is dropped."), this.goals);
    this.surprise = card("What the robot makes of it", "surprise", this.storiesOf, this.stories);
    panel.classList.add("live");
    panel.append(
      make("div", { class: "stage" }, bar, this.newer, this.banner, this.host, time),
      make("aside", { class: "beside", "aria-label": "the robot's mind" },
        card("Plan", "planned", this.proof, this.plan), this.crew, this.holds, this.waits, this.wanted, this.surprise, card("Events", "log", this.events)));
    this.floor = new Floor(this.host, { interactive: true });
    this.floor.show(studio.room);
    handle(this.floor, {
      menu: (name, at) => this.#menu(name, at),
      drop: (name, node) => this.link.send({ observe: { at: { [name.split(" ")[1]]: node } } }),
    });
    /** @type {(value?: any) => void} */
    let begin = () => {};
    this.begun = new Promise((done) => (begin = done));
    this.link = new Live((told) => this.#hear(told, begin), () => this.#end(begin));
  }

  enter() {
    this.#draw();
  }

  // ---------------------------------------------------------------- what is on the panel

  /**
   * @param {string} name
   * @param {{x: number, y: number}} at
   */
  #menu(name, at) {
    const items = deeds(name, this.view, this.studio.room, (line) => this.#say(line));
    if (items.length) openMenu(name, items, at, this.floor.find(name));
  }

  /** All that can be seen and wished in a domain's own words. */
  #tellOwn() {
    const box = this.ownButton.getBoundingClientRect();
    openMenu("Own words", ownDeeds(this.view.own, (line) => this.#say(line)), { x: box.left, y: box.bottom + 4 }, this.ownButton);
  }

  /** @param {HTMLElement} origin */
  #keep(origin) {
    const box = origin.getBoundingClientRect();
    openMenu("Keep", KEEPSAKES.map(([text, file]) => ({
      text,
      act: () => {
        const link = make("a", { href: `/keep/${file}`, download: file });
        link.click();
      },
    })), { x: box.left, y: box.bottom + 4 }, origin);
  }

  // ---------------------------------------------------------------- what a person does

  /** @param {Record<string, any>} line */
  #say(line) {
    if (this.past.active) this.#toNow();
    this.link.send(line);
  }

  #newGuests() {
    const number = Math.round(Number(this.guests.value));
    if (!(number >= 1 && number <= 50)) {
      this.studio.say("A party has 1 to 50 guests.", true);
      this.guests.focus();
      return;
    }
    this.#say({ guests: number });
  }

  /** @param {boolean} playing */
  #play(playing) {
    if (!this.past.active) {
      this.link.send({ play: playing });
      return;
    }
    this.past.playing = playing;
    this.#showPace();
    if (playing) this.#replay(performance.now());
  }

  #step() {
    if (this.past.active) void this.past.advance(1);
    else this.link.send({ step: 1 });
  }

  /** Ends this evening for one in the layout as it was saved. */
  #beginAnew() {
    ask("anew").catch((error) => this.studio.say([error.message, error.hint].filter(Boolean).join("; "), true));
  }

  // ---------------------------------------------------------------- looking back

  /** @param {number} time */
  #seek(time) {
    if (time >= this.time - 0.05) this.#toNow();
    else void this.past.seek(time).catch((error) => this.studio.say(error.message, true));
  }

  /** @param {number} before */
  #replay(before) {
    requestAnimationFrame(async (now) => {
      if (!this.past.active || !this.past.playing) return;
      const to = this.past.time + ((now - before) / 1000) * Number(this.speed.value);
      if (to >= this.time) {
        this.#toNow();
        return;
      }
      await this.past.seek(to);
      this.#replay(now);
    });
  }

  /**
   * @param {import("./moments.js").Moment} moment
   * @param {number} time
   */
  #showPast(moment, time) {
    this.floor.move(moment);
    this.#showRows(moment.rows ?? [], moment.rows?.findIndex((/** @type {string[]} */ row) => row[1] === "now" || row[1] === "next"));
    this.slider.value = String(time);
    this.clock.textContent = `${clock(time)} of ${clock(this.time)}`;
    this.nowButton.hidden = false;
    this.#showBanner(`Looking back at ${clock(time)}. The evening goes on meanwhile.`, "past");
    this.#showPace();
  }

  #toNow() {
    this.past.leave();
    this.nowButton.hidden = true;
    this.#showBanner("");
    this.#showView();
    this.#showTime();
    this.#draw(true);
  }

  // ---------------------------------------------------------------- what the studio says

  /**
   * @param {any} told
   * @param {(value?: any) => void} begin
   */
  #hear(told, begin) {
    if (told.world) this.#moment(told.world, told.whole, begin);
    else if (told.view) {
      this.view = told.view;
      this.#showView();
    } else if (told.event) this.#event(told.event);
    else if (told.anew) this.#leave();
    else if (told.hello) this.me = told.you;
    else if (told.error) this.studio.say([told.error.message, told.error.hint].filter(Boolean).join("; "), true);
    else if (told.from && told.from !== this.me) this.studio.say("Another page has changed the evening.");
    else if (told.line) this.studio.say("");
  }

  /** Another evening has begun. */
  #leave() {
    this.over = true;
    this.past.leave();
    this.link.socket.close();
    this.studio.anew();
    this.studio.say("A new evening has begun, in the layout as it was saved.");
  }

  /** @param {(value?: any) => void} begin */
  #end(begin) {
    begin();
    if (this.over) return;
    const alive = fetch("/healthz").then((answer) => answer.ok, () => false);
    void alive.then((there) => this.#showBanner(there
      ? "This page is not connected: too many are open, or it did not keep up. Reload it to go on."
      : "The studio has ended; start it again to go on.", "ended"));
  }

  /**
   * @param {import("./moments.js").Change} change
   * @param {boolean | undefined} whole
   * @param {(value?: any) => void} begin
   */
  #moment(change, whole, begin) {
    const now = performance.now();
    this.before = whole ? {} : this.now;
    this.now = whole ? change[1] : after(this.now, change);
    this.lasts = Math.min(120, Math.max(16, now - this.arrived));
    this.arrived = now;
    this.time = change[0];
    if (!this.past.active) {
      this.#showBanner(this.now.banner ?? "");
      this.#showTime();
    } else this.slider.max = String(this.time);
    if (whole) {
      this.floor.move(this.now);
      begin();
    } else if (!this.past.active && !sameThings(this.before, this.now)) this.floor.move(this.glide());
    this.#draw();
  }

  /** Draws until the moment that came last is there. */
  #draw(anew = false) {
    if (anew) this.floor.move(this.now);
    if (this.drawing) return;
    this.drawing = true;
    const frame = (/** @type {number} */ now) => {
      this.drawing = false;
      if (this.past.active) return;
      const part = Math.min(1, (now - this.arrived) / this.lasts);
      this.floor.move(part < 1 ? between(Object.keys(this.before).length ? this.glide() : this.now, this.now, part) : this.now);
      if (part < 1) this.#draw();
    };
    requestAnimationFrame(frame);
  }

  /** The moment from which people glide to the present one: places of before, all else as it is now. */
  glide() {
    const from = { ...this.now };
    for (const key in from) {
      const was = this.before[key];
      if (/^(robot($| )|@)/.test(key) && was) from[key] = [...was.slice(0, 3), ...from[key].slice(3)];
    }
    return from;
  }

  /** @param {{t: number, text: string, bad: boolean}} event */
  #event({ t, text, bad }) {
    const entry = make("button", { type: "button", class: bad ? "bad" : null, onclick: () => this.#seek(t) },
      make("time", {}, clock(t)), ` ${text}`);
    const low = this.events.scrollHeight - this.events.scrollTop - this.events.clientHeight < 40;
    this.events.append(make("div", {}, entry));
    while (this.events.childElementCount > MOST_EVENTS) this.events.firstElementChild?.remove();
    if (low) this.events.scrollTop = this.events.scrollHeight;
  }

  #showView() {
    const { view, floor } = this;
    floor.figures.parties = Object.fromEntries(
      view.parties.flatMap((/** @type {string[]} */ party) => party.map((who) => [who, party[0]])));
    const blocked = new Set(view.blocked.map((/** @type {string[]} */ [a, b]) => `path ${a} ${b}`));
    for (const [name, thing] of floor.things) {
      if (name.startsWith("path ")) thing.classList.toggle("blocked", blocked.has(name));
    }
    if (this.past.active) return;
    floor.move(floor.figures.last);
    if (this.proof.textContent !== view.proof) this.proof.textContent = view.proof;
    this.#showRows(view.rows, view.current ?? -1);
    this.newer.hidden = !view.newer;
    this.#showRobots(view.robots);
    this.#showOwn(view.own);
    this.waits.hidden = !view.pending.length;
    this.pending.replaceChildren(...view.pending.map((/** @type {any} */ wish) =>
      make("li", {}, wish.words, make("span", { class: "why" }, wish.reasons.join("; ")))));
    this.wanted.hidden = !view.goals.length;
    this.goals.replaceChildren(...view.goals.map((/** @type {any} */ goal) =>
      make("li", {}, goal.words, make("button", { type: "button", onclick: () => this.#say({ drop: goal.goal }), "aria-label": `drop: ${goal.words}` }, "drop"))));
    this.surprise.hidden = !view.surprise;
    if (view.surprise) {
      const seen = view.surprise.seen.map((/** @type {string} */ text) => text.replace(" ", " at ")).join(", ");
      this.storiesOf.textContent = `${seen ? `To see ${seen} was unexpected. ` : ""}How it can have come about, the likeliest first (that one is believed):`;
      this.stories.replaceChildren(...view.surprise.stories.map((/** @type {string} */ story) => make("li", {}, story)));
    }
    if (document.activeElement !== this.speed) this.speed.value = String(view.speed);
    this.#showPace();
  }

  /** @param {{observables: any[], fluents: {term: string, about: string[], holds: boolean}[]}} own what holds stands on the floor, too */
  #showOwn({ observables, fluents }) {
    this.ownButton.hidden = !observables.length && !fluents.length;
    const holding = fluents.filter((each) => each.holds);
    this.holds.hidden = !holding.length;
    this.holding.replaceChildren(...holding.map(({ term }) => make("li", {}, term)));
    /** @type {Map<string, string[]>} */
    const notes = new Map();
    for (const { term, about } of holding) {
      const short = about.length === 1 ? term.slice(0, term.indexOf("(")) : term;
      for (const name of about) notes.set(name, [...(notes.get(name) ?? []), short]);
    }
    this.floor.note(notes);
  }

  /** @param {{name: string, out: boolean, doing: string}[]} robots are listed where there are several */
  #showRobots(robots) {
    this.crew.hidden = robots.length < 2;
    const focused = document.activeElement?.getAttribute("aria-label");
    this.robots.replaceChildren(...(this.crew.hidden ? [] : robots).map((robot, number) => {
      const word = robot.out ? "go on" : "stop";
      const line = robot.out ? { back: robot.name } : { observe: { out: robot.name } };
      const does = robot.out ? "stands still" : robot.doing || "waits";
      return make("li", {}, make("span", {}, chip(number), `${robot.name}: ${does}`),
        make("button", { type: "button", onclick: () => this.#say(line), "aria-label": `${word} ${robot.name}` }, word));
    }));
    const again = focused && document.activeElement === document.body ? this.robots.querySelector(`[aria-label="${focused}"]`) : null;
    if (again instanceof HTMLElement) again.focus();
  }

  /**
   * @param {any[][]} rows words and state; of several robots also the number of the one
   * @param {number} current
   */
  #showRows(rows, current) {
    const shown = JSON.stringify([rows, current]);
    if (shown === this.shownRows) return;
    this.shownRows = shown;
    this.plan.replaceChildren(...rows.map(([words, state, number], i) => {
      const acts = i === current || (number !== undefined && state === "now");
      const mark = number === undefined ? [] : [chip(number)];
      return make("li", { class: state, "aria-current": acts ? "step" : null }, ...mark, words);
    }));
    const item = /** @type {HTMLElement | null} */ (this.plan.querySelector("[aria-current]"));
    if (item) this.plan.scrollTop = item.offsetTop - this.plan.offsetTop - this.plan.clientHeight / 3;
  }

  #showPace() {
    const playing = this.past.active ? this.past.playing : this.view.playing;
    this.playButton.setAttribute("aria-pressed", String(playing));
    this.pauseButton.setAttribute("aria-pressed", String(!playing));
  }

  #showTime() {
    this.slider.min = String(Math.floor(this.view.begin ?? 0));
    this.slider.max = String(this.time);
    this.slider.value = String(this.time);
    this.clock.textContent = clock(this.time);
    this.slider.setAttribute("aria-valuetext", clock(this.time));
  }

  /**
   * @param {string} text
   * @param {string} [style]
   */
  #showBanner(text, style = "") {
    if (this.banner.textContent !== text) this.banner.textContent = text;
    this.banner.hidden = !text;
    this.banner.className = `banner ${style}`;
  }
}

/** @param {number} seconds */
function clock(seconds) {
  const whole = Math.floor(seconds);
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  const two = (/** @type {number} */ n) => String(n).padStart(2, "0");
  return h ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`;
}

/**
 * Whether the same people, robots and bubbles are there.
 * @param {Record<string, any>} before
 * @param {Record<string, any>} now
 */
function sameThings(before, now) {
  const keys = Object.keys(now);
  return keys.length === Object.keys(before).length && keys.every((key) => key in before);
}

/** @param {number} number of a robot: a spot of its colour */
const chip = (number) => make("span", { class: `chip robot-${number % ROBOT_COLOURS}`, "aria-hidden": "true" });

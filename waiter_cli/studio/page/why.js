// @ts-check
// The room Why: why a plan is as it is, why there is none, what would help, and what is known.

import { make } from "./build.js";
import { Floor } from "./floor.js";
import { editLayout, layoutText } from "./layout_shared.js";
import { TextPane } from "./layout_text.js";
import { ask, Refused } from "./link.js";
import { waysOf } from "./robots.js";
import { shape } from "./shapes.js";
import { leadersOf, momentOf } from "./why_floor.js";
import { Knowledge } from "./why_knowledge.js";

const PARTIES = [1, 2, 4, 6];

class WhyRoom {
  /**
   * @param {HTMLElement} panel
   * @param {import("./main.js").Studio} studio
   */
  constructor(panel, studio) {
    this.studio = studio;
    this.layout = "";
    this.scenario = "";
    this.enter = 0;
    /** @type {number | null} the change that is tried */
    this.change = null;
    /** @type {any} */
    this.found = null;
    this.step = 0;
    this.turn = 0;
    /** the question after which no earlier one is answered any more */
    this.asking = 0;
    this.typing = 0;
    const host = make("div", { class: "floor-host" });
    this.floor = new Floor(host, { interactive: true });
    this.route = shape("g", { class: "route", "aria-hidden": "true" });
    this.floor.layers.above.append(this.route);
    this.situation = /** @type {HTMLSelectElement} */ (make("select", { "aria-label": "Situation", onchange: () => void this.choose() }));
    this.answer = make("p", { role: "status", "aria-label": "answer", class: "proof" });
    this.slider = /** @type {HTMLInputElement} */ (make("input", { type: "range", min: 0, max: 0, value: 0, "aria-label": "Step of the plan", oninput: () => this.goTo(Number(this.slider.value)) }));
    this.plan = make("ol", { "aria-label": "explained plan", class: "plan steps-to-ask" });
    this.details = make("div", { class: "details" });
    this.foil = make("p", { role: "status", "aria-label": "why not", class: "foil" });
    this.question = /** @type {HTMLInputElement} */ (make("input", { type: "text", "aria-label": "Action", placeholder: "seat(agent,c1,table2)", onkeydown: (/** @type {KeyboardEvent} */ event) => event.key === "Enter" && void this.whyNot(this.question.value) }));
    this.texts = {
      scenario: new TextPane((text) => this.#typed(text), "Scenario YAML"),
      layout: new TextPane(() => {}, "Layout YAML", true),
    };
    this.known = new Knowledge(() => this.asked());
    const step = (/** @type {number} */ by) => () => this.goTo(this.step + by);
    panel.append(make("div", { class: "why-room" },
      make("div", { class: "why-stage" },
        make("div", { class: "row" }, make("label", { class: "field" }, make("span", { "aria-hidden": "true" }, "Situation"), this.situation),
          make("button", { type: "button", onclick: () => this.download() }, "Download scenario")),
        host,
        make("div", { class: "row stepping" }, make("button", { type: "button", onclick: step(-1) }, "Previous step"), this.slider,
          make("button", { type: "button", onclick: step(1) }, "Next step"))),
      make("div", { class: "why-middle" },
        make("section", { class: "card grows", "aria-label": "explanation" }, make("h2", {}, "Why"), this.answer, this.details, this.plan),
        make("section", { class: "card", "aria-label": "question" }, make("h2", {}, "Why not …?"),
          make("div", { class: "row" }, this.question, make("button", { type: "button", onclick: () => void this.whyNot(this.question.value) }, "Ask")), this.foil)),
      make("div", { class: "why-side" }, this.known.element,
        make("section", { class: "card text", "aria-label": "scenario" }, make("h2", {}, "Scenario"), this.texts.scenario.element),
        make("section", { class: "card text", "aria-label": "layout" }, make("h2", {}, "Layout"), this.texts.layout.element))));
  }

  async begin() {
    const { scenarios, opened } = await ask("why_open");
    const parties = PARTIES.map((n) => [`enter ${n}`, n === 1 ? "one guest arrives" : `${n} guests arrive`]);
    const all = [["now", "the evening as it is"], ...scenarios.map((/** @type {string} */ name) => [`scenario ${name}`, name]), ...parties];
    this.situation.append(...all.map(([value, words]) => make("option", { value, selected: value === `scenario ${opened}` }, words)));
    if (!opened) this.situation.value = "enter 1";
    await this.choose();
  }

  /** Takes up the situation that was chosen. */
  async choose() {
    const turn = ++this.turn;
    const [kind, name] = this.situation.value.split(" ");
    const text = kind === "enter" ? "" : kind === "now" ? (await ask("why_now")).text : (await ask("why_scenario", { name: this.situation.value.slice(9) })).text;
    if (turn !== this.turn) return;
    this.enter = kind === "enter" ? Number(name) : 0;
    this.scenario = text;
    this.texts.scenario.show(this.scenario);
    await this.think();
  }

  /** The room is entered again: the layout may be another one by now. */
  async again() {
    if (this.situation.value === "now") await this.choose();
    else if (this.layout && (await layoutText()) !== this.layout) await this.think();
  }

  asked() {
    return { layout: this.layout, scenario: this.scenario, enter: this.enter, change: this.change };
  }

  /** Plans and explains the situation as it is. */
  async think() {
    const turn = ++this.turn;
    this.asking++;
    this.change = null;
    const layout = await layoutText();
    if (turn !== this.turn) return;
    this.layout = layout;
    this.texts.layout.show(this.layout);
    this.foil.textContent = "";
    this.answer.textContent = "Planning and proving …";
    if (!this.found) this.floor.show(this.studio.room);
    try {
      const found = await ask("why_plan", this.asked());
      if (turn === this.turn) this.show(found);
    } catch (error) {
      if (turn !== this.turn || !(error instanceof Refused)) return;
      this.answer.textContent = error.message;
      this.#mark(error.faults.map((/** @type {any} */ each) => ({ ...each, in: each.file === "the scenario" ? "scenario" : "layout" })));
    }
  }

  /**
   * Shows a plan, or why there is none.
   * @param {any} found
   * @param {string} [tried] what was changed for it
   */
  show(found, tried = "") {
    this.found = found;
    this.floor.show(found.room);
    const planned = "steps" in found;
    const steps = planned ? `${found.horizon} ${found.horizon === 1 ? "step" : "steps"}, ${found.metres.toFixed(1)} m${found.minimal ? ", minimal" : ""}` : "";
    this.answer.textContent = planned ? `${tried ? `${capital(tried)}: ` : ""}${steps}` : found.status === "no_plan" ? `No plan of any length exists: ${found.message}.` : `${capital(found.message)}.`;
    const [, robot = "agent"] = /\((\w+)/.exec(found.steps?.[0]?.text ?? "") ?? [];
    this.question.placeholder = `seat(${robot},c1,table2)`;
    this.route.replaceChildren(...waysOf(planned ? found.routes : [], found.room.nodes));
    this.plan.replaceChildren(...(planned ? found.steps : []).map((/** @type {any} */ step) => make("li", {},
      make("button", { type: "button", "data-step": step.step, onclick: () => this.goTo(step.step, true) }, step.words))));
    if (tried) this.details.replaceChildren(make("button", { type: "button", onclick: () => void this.think() }, "Back to what is"));
    else this.#explain(found, planned);
    const causes = (found.conflicts ?? []).flat();
    this.#mark(tried ? [] : [...causes, ...(found.reasons ?? [])].filter((each) => each.line));
    const about = new Set(tried ? [] : causes.flatMap((/** @type {any} */ each) => each.about));
    this.goTo(0);
    for (const [name, thing] of this.floor.things) thing.classList.toggle("cause", about.has(name));
  }

  /** @param {any} found @param {boolean} planned */
  #explain(found, planned) {
    if (planned) {
      this.details.replaceChildren(make("p", { class: "soft" }, "Choose a step to see what else could be done there."));
      return;
    }
    const several = found.conflicts?.length > 1;
    const sets = (found.conflicts ?? []).map((/** @type {any[]} */ causes, /** @type {number} */ i) => make("div", {},
      make("p", {}, several ? `${i + 1}. All of these together leave no plan; something of each set must go:` : causes.length === 1 ? "Without this there is a plan:" : "All of these together leave no plan:"),
      make("ul", { "aria-label": several ? `causes ${i + 1}` : "causes", class: "causes" }, ...causes.map((cause) => make("li", {}, cause.message, " ",
        make("button", { type: "button", "aria-label": `Show: ${cause.message}`, onclick: () => this.#go(cause) }, "Show"))))));
    const changes = (found.changes ?? []).map((/** @type {any} */ change, /** @type {number} */ i) => make("li", {},
      make("span", {}, `${capital(change.message)}: ${change.horizon} ${change.horizon === 1 ? "step" : "steps"}`),
      make("span", { class: "row" },
        make("button", { type: "button", "aria-label": `Try it: ${change.message}`, onclick: () => void this.tryIt(i) }, "Try it"),
        ...(change.keep ? [make("button", { type: "button", "aria-label": `Keep it: ${change.message}`, onclick: () => void this.keep(change) }, "Keep it")] : []))));
    const stories = (found.stories ?? []).map((/** @type {string[]} */ story) => make("li", {}, story.join("; ")));
    this.details.replaceChildren(...sets,
      ...(changes.length ? [make("p", {}, "Any one of these would help:"), make("ul", { "aria-label": "mends", class: "mends" }, ...changes)] : [make("p", {}, "No single change that was tried would help.")]),
      ...(stories.length ? [make("p", {}, "It can have come about like this:"), make("ol", { "aria-label": "stories" }, ...stories)] : []));
  }

  /** @param {any} cause */
  #go(cause) {
    if (cause.about?.[0]) this.floor.focus(cause.about[0]);
    if (cause.line && cause.in) this.texts[/** @type {"scenario" | "layout"} */ (cause.in)].goTo(cause.line);
  }

  /** @param {{in: string, line: number}[]} places */
  #mark(places) {
    for (const which of /** @type {const} */ (["scenario", "layout"])) {
      const lines = places.filter((each) => each.in === which).map((each) => each.line);
      this.texts[which].mark(new Map(lines.map((line) => [line, "bad"])));
      if (lines.length) this.texts[which].goTo(lines[0]);
    }
  }

  /** @param {number} number */
  async tryIt(number) {
    const turn = ++this.turn;
    this.asking++;
    const message = this.found.changes[number].message;
    const found = await ask("why_try", { ...this.asked(), change: number });
    if (turn !== this.turn) return;
    this.change = number;
    this.show(found, message);
  }

  /** @param {any} change */
  async keep(change) {
    if (change.keep.in === "layout") {
      await editLayout(change.keep.edits, change.message);
      this.studio.say("Kept in the layout; the room Layout saves it.");
    } else {
      this.scenario = change.keep.text;
      this.texts.scenario.show(this.scenario);
      this.studio.say("Kept in the scenario; Download scenario gives it to you.");
    }
    await this.think();
  }

  /**
   * @param {number} step is shown on the floor, in the plan and in what is known
   * @param {boolean} [alternatives]
   */
  goTo(step, alternatives = false) {
    const frames = this.found?.frames ?? [];
    if (!frames.length) return;
    this.step = Math.max(0, Math.min(frames.length - 1, step));
    this.slider.max = String(frames.length - 1);
    this.slider.value = String(this.step);
    const frame = frames[this.step];
    this.floor.figures.parties = leadersOf(frame);
    this.floor.move(momentOf(frame, this.found.room));
    for (const button of this.plan.querySelectorAll("button")) {
      const current = Number(button.dataset.step) === this.step;
      if (current) button.parentElement?.setAttribute("aria-current", "step");
      else button.parentElement?.removeAttribute("aria-current");
    }
    void this.known.show(this.step);
    if (alternatives) void this.#alternatives(this.step);
  }

  /** @param {number} step */
  async #alternatives(step) {
    const turn = ++this.asking;
    this.foil.textContent = "";
    const { actions } = await ask("why_else", { ...this.asked(), step });
    if (turn !== this.asking) return;
    const here = this.found.steps.filter((/** @type {any} */ each) => each.step === step);
    const said = here.length ? `Step ${step}: ${here.map((/** @type {any} */ each) => each.words).join("; ")}. ` : "";
    this.details.replaceChildren(
      make("p", {}, said, actions.length ? "What could be done instead:" : "Nothing else could be done here."),
      make("ul", { "aria-label": "alternatives", class: "alternatives" }, ...actions.map((/** @type {any} */ each) =>
        make("li", {}, make("button", { type: "button", onclick: () => void this.whyNot(each.text) }, `why not ${each.text}?`)))));
    if (here.length === 1) void this.whyNot(here[0].text);
  }

  /** @param {string} action */
  async whyNot(action) {
    const turn = ++this.asking;
    this.question.value = action;
    this.foil.textContent = "Asking …";
    try {
      const { words } = await ask("why_not", { ...this.asked(), action });
      if (turn === this.asking) this.foil.textContent = words;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      if (turn !== this.asking) return;
      this.foil.textContent = capital(error.hint ? `${error.message}; ${error.hint}` : error.message);
    }
  }

  /** @param {string} text */
  #typed(text) {
    this.scenario = text;
    clearTimeout(this.typing);
    this.typing = window.setTimeout(() => void this.think(), 300);
  }

  /** Gives the scenario's text to the person. */
  download() {
    const address = URL.createObjectURL(new Blob([this.scenario], { type: "application/yaml" }));
    make("a", { href: address, download: "scenario.yaml" }).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  }
}

/** @param {string} text */
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/** @type {import("./main.js").Room} */
export const why = {
  name: "Why",
  async start(panel, studio) {
    await new Promise((done) => document.head.append(make("link", { rel: "stylesheet", href: "/page/layout.css", onload: done, onerror: done })));
    const room = new WhyRoom(panel, studio);
    await room.begin();
    return { enter: () => void room.again() };
  },
};

// @ts-check
// A pinned scenario: its plan is drawn anew after each edit, beside the one before.

import { make } from "./build.js";
import { ask } from "./link.js";

const PARTIES = [1, 2, 4, 6];

export class PinnedPlan {
  /** @param {any} room the room Layout */
  constructor(room) {
    this.room = room;
    this.choice = /** @type {HTMLSelectElement} */ (make("select", { "aria-label": "Pinned scenario", onchange: () => {
      this.before = null;
      void this.draw();
    } }));
    this.told = make("p", { role: "status", "aria-label": "pinned plan" });
    this.steps = make("ol", { class: "steps", "aria-label": "pinned steps", start: 0 });
    this.element = make("div", { class: "pinned" },
      make("label", { class: "field" }, make("span", { "aria-hidden": "true" }, "Pinned"), this.choice), this.told,
      make("details", {}, make("summary", {}, "Steps"), this.steps));
    /** @type {{horizon: number, metres: number} | null} */
    this.before = null;
    this.turn = 0;
    this.shownTurn = 0;
  }

  /**
   * @param {string[]} scenarios
   * @param {string | null} chosen
   */
  offer(scenarios, chosen) {
    const parties = PARTIES.map((n) => [`enter ${n}`, n === 1 ? "one guest arrives" : `${n} guests arrive`]);
    const all = [["", "nothing"], ...parties, ...scenarios.map((name) => [`scenario ${name}`, name])];
    this.choice.replaceChildren(...all.map(([value, words]) => make("option", { value, selected: value === `scenario ${chosen}` }, words)));
  }

  /** Plans, and shows what came of it. */
  async draw() {
    const turn = ++this.turn;
    const [kind, name] = [this.choice.value.split(" ")[0], this.choice.value.slice(this.choice.value.indexOf(" ") + 1)];
    if (!kind) return this.#show(null);
    const pin = kind === "enter" ? { enter: Number(name) } : { scenario: name };
    const found = await ask("layout_plan", { text: this.room.history.text, pin });
    if (turn !== this.turn) return;
    this.#show(found);
    this.shownTurn = turn;
  }

  /** @param {any} found */
  #show(found) {
    const planned = found && "horizon" in found;
    this.room.board.showRoutes(planned ? found.routes : []);
    this.steps.replaceChildren(...(planned ? found.steps : []).map((/** @type {any} */ step) => make("li", { value: step.step }, step.words)));
    this.steps.parentElement?.toggleAttribute("hidden", !planned);
    if (!found) this.told.textContent = "";
    else if (!planned) this.told.textContent = `No plan: ${found.message}.`;
    else {
      const now = measure(found);
      const same = !this.before || measure(this.before) === now;
      this.told.textContent = `${now}${found.minimal ? ", minimal" : ""}${same ? "" : `; before ${measure(/** @type {any} */ (this.before))}`}`;
      this.before = found;
    }
  }
}

/** @param {{horizon: number, metres: number}} plan */
const measure = ({ horizon, metres }) => `${horizon} ${horizon === 1 ? "step" : "steps"}, ${metres.toFixed(1)} m`;

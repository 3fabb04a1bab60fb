// @ts-check
// What is known at a step: a list that can be searched, each literal with the sentences of its rules.

import { make } from "./build.js";
import { ask, Refused } from "./link.js";

const SIGNS = /** @type {Record<string, string>} */ ({ new: "+", gone: "−", same: " " });
const WORDS = /** @type {Record<string, string>} */ ({ new: "new at this step", gone: "no longer holds", same: "" });

export class Knowledge {
  /** @param {() => Record<string, any>} asked the situation that is asked about */
  constructor(asked) {
    this.asked = asked;
    this.step = 0;
    this.turn = 0;
    const again = () => void this.show(this.step);
    this.search = /** @type {HTMLInputElement} */ (make("input", { type: "search", "aria-label": "Search", placeholder: "a regular expression", oninput: again }));
    this.positive = /** @type {HTMLInputElement} */ (make("input", { type: "checkbox", onchange: again }));
    this.changed = /** @type {HTMLInputElement} */ (make("input", { type: "checkbox", onchange: again }));
    this.told = make("p", { class: "soft", role: "status", "aria-label": "known" });
    this.list = make("ul", { "aria-label": "knowledge", class: "knowledge", tabindex: "0" });
    this.element = make("section", { class: "card grows", "aria-label": "what is known" }, make("h2", {}, "Known at this step"),
      make("div", { class: "row" }, this.search, make("label", {}, this.positive, " Positive only"), make("label", {}, this.changed, " Changed only")),
      this.told, this.list);
  }

  /** @param {number} step */
  async show(step) {
    this.step = step;
    const turn = ++this.turn;
    try {
      const found = await ask("why_known", {
        ...this.asked(), step, grep: this.search.value, positive: this.positive.checked, changed: this.changed.checked,
      });
      if (turn !== this.turn) return;
      this.told.textContent = found.of ? `Step ${step}: ${found.literals.length} of ${found.of} literals` : "Without a plan nothing more is known.";
      this.list.replaceChildren(...found.literals.map((/** @type {any} */ each) => make("li", { class: each.change },
        make("code", {}, make("span", { "aria-hidden": "true" }, SIGNS[each.change]), ` ${each.text}`),
        make("span", { class: "hidden-words" }, WORDS[each.change]),
        ...each.sentences.map((/** @type {string} */ said) => make("span", { class: "why" }, said)))));
    } catch (error) {
      if (turn !== this.turn || !(error instanceof Refused)) return;
      this.told.textContent = error.message;
    }
  }
}

// @ts-check
// What `layout check` says of the text, with mends that are one click away.

import { make } from "./build.js";
import { ask } from "./link.js";

export class FindingList {
  /** @param {any} room the room Layout */
  constructor(room) {
    this.room = room;
    this.list = make("ul", { "aria-label": "findings", class: "findings" });
    this.none = make("p", { class: "soft" }, "Nothing is wrong.");
    this.element = make("div", {}, make("h2", {}, "Check"), this.none, this.list);
    /** @type {HTMLElement[]} */
    this.rows = [];
  }

  /** @param {any} view */
  show(view) {
    this.findings = view.findings;
    this.rows = view.findings.map((/** @type {any} */ each) => make("li", { class: each.grave ? "bad" : "" },
      make("span", {}, each.line ? `${each.line}: ` : "", each.message, each.grave && each.hint ? `; ${each.hint}` : ""),
      make("span", { class: "row" }, make("button", {
        type: "button", "aria-label": `Show: ${each.message}`, onclick: () => this.#go(each),
      }, "Show"))));
    this.list.replaceChildren(...this.rows);
    this.list.hidden = !this.rows.length;
    this.none.hidden = this.rows.length > 0;
    const lines = view.things?.lines ?? {};
    const wrong = new Set(view.findings.filter((/** @type {any} */ each) => each.grave).map((/** @type {any} */ each) => each.line));
    const about = view.findings.map((/** @type {any} */ each) => each.about).filter(Boolean);
    const named = Object.keys(lines).filter((name) => wrong.has(lines[name]));
    this.room.board.found(new Set([...about, ...named]));
  }

  /** Adds the mends, once they are found. */
  async mend() {
    const findings = this.findings;
    if (!findings?.some((/** @type {any} */ each) => !each.grave)) return;
    await new Promise((done) => setTimeout(done, 200));
    if (this.findings !== findings) return;
    const { mends } = await ask("layout_mends", { text: this.room.history.text });
    if (this.findings !== findings) return;
    mends.forEach((/** @type {any} */ mend, /** @type {number} */ i) => {
      if (!mend) return;
      this.rows[i]?.querySelector(".row")?.append(make("button", {
        type: "button", class: "mend", onclick: () => void this.room.edit(mend.edits, mend.label.toLowerCase()),
      }, mend.label));
    });
  }

  /** @param {any} finding */
  #go(finding) {
    if (finding.about) this.room.board.select([finding.about], true);
    if (finding.line) this.room.pane.goTo(finding.line, !finding.about);
  }
}

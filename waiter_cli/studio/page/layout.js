// @ts-check
// The room Layout: the floor and the YAML beside it, each following the other.

import { make } from "./build.js";
import { Board, kindOf } from "./layout_board.js";
import { fieldsFor } from "./layout_fields.js";
import { FindingList } from "./layout_findings.js";
import { History } from "./layout_history.js";
import { PictureBar } from "./layout_picture_bar.js";
import { PinnedPlan } from "./layout_plan.js";
import { ask, askWhatToDo, Refused } from "./layout_ask.js";
import { shared } from "./layout_shared.js";
import { TextPane } from "./layout_text.js";

const TOOLS = ["node", "path", "table", "wall", "bar", "colleague", "robot"];
const EMPTY = "nodes: {}\n\nedges: []\n\ntables: {}\n";

class LayoutRoom {
  /**
   * @param {HTMLElement} panel
   * @param {import("./main.js").Studio} studio
   */
  constructor(panel, studio) {
    this.studio = studio;
    this.panel = panel;
    this.history = new History("");
    this.saved = "";
    /** @type {string | null} */
    this.digest = null;
    /** @type {string | null} why the file is not to be written */
    this.kept = null;
    this.file = "";
    /** @type {any} */
    this.view = null;
    this.turn = 0;
    /** @type {Promise<any>} */
    this.queue = Promise.resolve();
    this.waiting = 0;
    this.typing = 0;
    const host = make("div", { class: "floor-host" });
    this.board = new Board(host, {
      edit: (edits, label) => this.edit(edits, label),
      selected: () => this.#chosen(),
      say: studio.say,
      tool: (name) => this.#toolNow(name),
      measured: (one, other) => this.pictures.measured(one, other),
    });
    this.pane = new TextPane((text) => this.#typed(text));
    this.findings = new FindingList(this);
    this.plan = new PinnedPlan(this);
    this.pictures = new PictureBar(this.board, studio.say);
    this.fields = make("div", { class: "fields", role: "group", "aria-label": "selected" });
    this.state = make("span", { class: "soft", role: "status", "aria-label": "file" });
    /** @type {Record<string, HTMLElement>} */
    this.buttons = {};
    panel.append(make("div", { class: "layout-room" },
      this.#toolbar(), make("div", { class: "layout-floor" }, host, this.plan.element),
      make("div", { class: "layout-side" },
        make("section", { class: "card", "aria-label": "properties" }, this.fields),
        make("section", { class: "card yaml", "aria-label": "text" }, this.pane.element),
        make("section", { class: "card", "aria-label": "check" }, this.findings.element))));
    panel.addEventListener("keydown", (event) => this.#key(event));
    window.addEventListener("beforeunload", (event) => this.history.text !== this.saved && event.preventDefault());
  }

  #toolbar() {
    const tool = (/** @type {string} */ name, /** @type {string} */ words, /** @type {(event: MouseEvent) => void} */ pressed) =>
      (this.buttons[name] = make("button", { type: "button", onclick: pressed }, words));
    const adders = TOOLS.map((name) => {
      const button = tool(name, `Add ${name}`, (event) => this.board.use(this.board.tool === name ? "" : name, event.detail === 0));
      button.setAttribute("aria-pressed", "false");
      return button;
    });
    return make("div", { class: "layout-tools", role: "group", "aria-label": "tools" },
      tool("undo", "Undo", () => this.back()), tool("redo", "Redo", () => this.forth()),
      tool("save", "Save", () => void this.save()), tool("download", "Download", () => this.download()),
      make("span", { class: "gap" }), ...adders, make("span", { class: "gap" }),
      tool("fit", "Fit", () => { this.board.fit(); this.board.show(this.view); }),
      tool("empty", "Empty floor", () => void this.empty()), this.pictures.element, this.state);
  }

  /** Reads the file. */
  async open() {
    const found = await ask("layout_open");
    this.history = new History(found.text);
    [this.saved, this.digest, this.kept] = [found.text, found.digest, found.kept];
    this.file = found.file.split(/[\\/]/).pop();
    this.plan.offer(found.scenarios, found.pinned);
    let view = found;
    if (shared.waiting.length) {
      view = await ask("layout_edit", { text: found.text, edits: shared.waiting.splice(0) });
      this.history.push(view.text, "what was kept");
    }
    this.pane.show(this.history.text);
    this.take(view);
    shared.room = this;
  }

  /**
   * Takes over what the server says of the text.
   * @param {any} view
   */
  take(view) {
    this.view = view;
    this.board.show(view);
    this.findings.show(view);
    this.#mark();
    this.#tell();
    void this.findings.mend();
    void this.plan.draw();
  }

  /**
   * Does edits of the text, after those that are under way; gives the name of what was added.
   * @param {Record<string, any>[]} edits
   * @param {string} label
   * @returns {Promise<string>}
   */
  edit(edits, label) {
    this.waiting++;
    const next = this.queue.then(async () => {
      this.waiting--;
      const turn = ++this.turn;
      try {
        const answer = await ask("layout_edit", { text: this.history.text, edits, quiet: this.waiting > 0 });
        this.history.push(answer.text, label);
        this.pane.show(answer.text);
        this.#tell();
        if (edits.some((each) => each.do === "rename")) this.#renamed(edits);
        if (turn === this.turn && "room" in answer) this.take(answer);
        return answer.added;
      } catch (error) {
        if (!(error instanceof Refused)) throw error;
        this.studio.say(error.hint ? `${error.message}: ${error.hint}` : error.message, true);
        if (this.view) this.board.show(this.view);
        return "";
      }
    });
    this.queue = next.catch(() => "");
    return next;
  }

  /** @param {Record<string, any>[]} edits what is selected keeps being so under its new name */
  #renamed(edits) {
    for (const { what, name } of edits) {
      const named = `${kindOf(what)} ${name}`;
      if (this.board.selection.includes(what)) this.board.next = named;
    }
  }

  /** @param {string} text */
  #typed(text) {
    this.history.push(text, "typing", 1000);
    clearTimeout(this.typing);
    this.typing = window.setTimeout(() => void this.look(), 150);
    this.#tell();
  }

  /** Asks what is to be said of the text as it stands. */
  async look() {
    const turn = ++this.turn;
    const view = await ask("layout_look", { text: this.history.text });
    if (turn === this.turn) this.take(view);
  }

  back() {
    const label = this.history.undo();
    this.studio.say(label ? `Undone: ${label}.` : "There is nothing to undo.");
    this.#jumped();
  }

  forth() {
    const label = this.history.redo();
    this.studio.say(label ? `Done again: ${label}.` : "There is nothing to do again.");
    this.#jumped();
  }

  #jumped() {
    this.pane.show(this.history.text);
    this.#tell();
    void this.look();
  }

  async empty() {
    const name = /^name:.*\r?\n/m.exec(this.history.text)?.[0] ?? "";
    this.history.push(`${name}${name ? "\n" : ""}${EMPTY}`, "empty the floor");
    this.board.fit();
    this.#jumped();
  }

  /** @param {boolean} [anyway] writes over whatever is there */
  async save(anyway = false) {
    await this.queue; // what is under way is saved, too
    const text = this.history.text;
    try {
      this.digest = (await ask("layout_save", { text, digest: anyway ? null : this.digest })).digest;
      this.saved = text;
      this.studio.say(this.view?.valid ? "Saved. A new evening in it can begin in the room Live." : "Saved, with faults in it.", !this.view?.valid);
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      if (error.status === 409) return this.#changedElsewhere(error.message);
      this.studio.say(error.hint ? `${error.message}; ${error.hint}` : error.message, true);
    }
    this.#tell();
  }

  /** @param {string} message */
  async #changedElsewhere(message) {
    const chosen = await askWhatToDo(this.panel, "Changed elsewhere", message, ["Write over it", "Read it anew", "Cancel"]);
    if (chosen === "Write over it") await this.save(true);
    if (chosen === "Read it anew") {
      const found = await ask("layout_open");
      this.history.push(found.text, "read the file anew");
      [this.saved, this.digest] = [found.text, found.digest];
      this.pane.show(found.text);
      this.#tell();
      this.take(found);
    }
  }

  /** Gives the text to the person as a file of their own. */
  download() {
    const address = URL.createObjectURL(new Blob([this.history.text], { type: "application/yaml" }));
    const link = make("a", { href: address, download: `${this.view?.room?.layout || "layout"}.yaml` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  }

  #tell() {
    const changed = this.history.text !== this.saved;
    this.state.textContent = this.kept ? `${this.file}: ${this.kept}` : changed ? `${this.file}: not saved` : `${this.file}: saved`;
    this.buttons.undo.toggleAttribute("disabled", !this.history.done.length);
    this.buttons.redo.toggleAttribute("disabled", !this.history.undone.length);
  }

  #chosen() {
    const had = document.activeElement;
    const label = this.fields.contains(had) ? had?.getAttribute("aria-label") ?? had?.textContent : null;
    this.fields.replaceChildren(...fieldsFor(this.board.selection, this.view?.things,
      (edits, words) => this.edit(edits, words), () => void this.board.remove()));
    if (label) {
      const again = [...this.fields.querySelectorAll("input, select, button")].find((each) =>
        each.getAttribute("aria-label") === label || each.textContent === label);
      /** @type {HTMLElement | undefined} */ (again)?.focus();
    }
    this.#mark();
    const line = this.view?.things?.lines[this.board.selection[0]];
    if (line && document.activeElement !== this.pane.area) this.pane.goTo(line);
  }

  #mark() {
    const marks = new Map();
    for (const each of this.view?.findings ?? []) {
      if (each.line && (each.grave || !marks.has(each.line))) marks.set(each.line, each.grave ? "bad" : "found");
    }
    for (const name of this.board.selection) {
      const line = this.view?.things?.lines[name];
      if (line) marks.set(line, "chosen");
    }
    this.pane.mark(marks);
  }

  /** @param {string} name */
  #toolNow(name) {
    for (const each of TOOLS) this.buttons[each].setAttribute("aria-pressed", String(each === name));
    if (name) this.studio.say(HELP[name] ?? "");
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.key === "Escape" && this.board.tool) this.board.use("");
    if (!event.ctrlKey && !event.metaKey) return;
    const key = event.key.toLowerCase();
    if (key === "s") void this.save();
    else if (key === "y" || (key === "z" && event.shiftKey)) this.forth();
    else if (key === "z") this.back();
    else return;
    event.preventDefault();
  }
}

/** @type {Record<string, string>} */
const HELP = {
  node: "Click where the node is to be. Escape ends.",
  path: "Click one node, then the next; a click beside them makes a new one. Escape ends.",
  table: "Click where the table is to stand. Escape ends.",
  wall: "Click where the wall begins, then where it ends. Escape ends.",
  bar: "Click two opposite corners of the bar.",
  colleague: "Click the node on which the colleague stands.",
  robot: "Click the node on which the robot starts. One robot becomes the first of several.",
  scale: "Click two points of the picture whose distance you know.",
};

/** @type {import("./main.js").Room} */
export const layout = {
  name: "Layout",
  async start(panel, studio) {
    await new Promise((done) => document.head.append(make("link", { rel: "stylesheet", href: "/page/layout.css", onload: done, onerror: done })));
    const room = new LayoutRoom(panel, studio);
    room.queue = room.open();
    await room.queue;
    return {};
  },
};

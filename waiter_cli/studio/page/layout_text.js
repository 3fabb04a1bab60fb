// @ts-check
// The YAML beside the floor: a text with the numbers of its lines, some of them marked. Line breaks of the
// file stay as they are, though a text field knows one kind only.

import { make } from "./build.js";
import { difference } from "./layout_history.js";

/** @param {string} raw */
export function shown(raw) {
  return raw.replace(/\r\n?/g, "\n");
}

/**
 * The file's text after what its shown text has become.
 * @param {string} raw
 * @param {string} after
 */
export function typed(raw, after) {
  const before = shown(raw);
  if (before === raw) return after;
  const { start, gone, come } = difference(before, after);
  const from = place(raw, start);
  const to = place(raw, start + gone.length);
  const line = raw.includes("\r\n") ? "\r\n" : "\r";
  return raw.slice(0, from) + come.replace(/\n/g, line) + raw.slice(to);
}

/**
 * The place in the file's text of a place in the shown one.
 * @param {string} raw
 * @param {number} index
 */
function place(raw, index) {
  let at = 0;
  for (let seen = 0; seen < index; seen++) at += raw[at] === "\r" && raw[at + 1] === "\n" ? 2 : 1;
  return at;
}

export class TextPane {
  /**
   * @param {(text: string) => void} onTyped is called with the file's text as it becomes
   * @param {string} [label] accessible name
   * @param {boolean} [readonly]
   */
  constructor(onTyped, label = "YAML", readonly = false) {
    this.raw = "";
    this.area = /** @type {HTMLTextAreaElement} */ (make("textarea", {
      "aria-label": label, readonly, spellcheck: "false", wrap: "off", autocomplete: "off", autocapitalize: "off",
      oninput: () => {
        this.raw = typed(this.raw, this.area.value);
        this.#number();
        onTyped(this.raw);
      },
      onscroll: () => { this.gutter.scrollTop = this.area.scrollTop; },
    }));
    this.gutter = make("div", { class: "gutter", "aria-hidden": "true" });
    this.element = make("div", { class: "text-pane" }, this.gutter, this.area);
    /** @type {Map<number, string>} */
    this.marks = new Map();
    this.lines = 0;
  }

  /** @param {string} raw the file's text; where the cursor is stays, as well as it can */
  show(raw) {
    this.raw = raw;
    const value = shown(raw);
    if (value === this.area.value) return;
    const { start, gone, come } = difference(this.area.value, value);
    const scroll = this.area.scrollTop;
    const had = document.activeElement === this.area;
    this.area.setRangeText(come, start, start + gone.length, "end");
    if (!had) this.area.setSelectionRange(start, start + come.length);
    this.area.scrollTop = scroll;
    this.#number();
  }

  /** @param {Map<number, string>} marks lines and their class: `bad`, `found` or `chosen` */
  mark(marks) {
    this.marks = marks;
    [...this.gutter.children].forEach((row, i) => { row.className = marks.get(i + 1) ?? ""; });
  }

  /** @param {number} line is selected and scrolled to */
  goTo(line, focus = false) {
    const lines = this.area.value.split("\n");
    const from = lines.slice(0, line - 1).reduce((sum, each) => sum + each.length + 1, 0);
    if (focus) this.area.focus();
    this.area.setSelectionRange(from, from + (lines[line - 1]?.length ?? 0));
    const height = this.area.scrollHeight / Math.max(lines.length, 1);
    const top = (line - 1) * height;
    if (top < this.area.scrollTop || top > this.area.scrollTop + this.area.clientHeight - 2 * height) {
      this.area.scrollTop = Math.max(0, top - this.area.clientHeight / 3);
    }
  }

  #number() {
    const count = this.area.value.split("\n").length;
    if (count !== this.lines) {
      this.lines = count;
      this.gutter.replaceChildren(...Array.from({ length: count }, (_, i) => make("div", {}, String(i + 1))));
      this.mark(this.marks);
    }
    this.gutter.scrollTop = this.area.scrollTop;
  }
}

// @ts-check
// Undo and redo of a text, without limit: each edit is kept as what went and what came.

/** @typedef {{start: number, gone: string, come: string, label: string, time: number}} Step */

/**
 * What is different between two texts, as one stretch.
 * @param {string} before
 * @param {string} after
 */
export function difference(before, after) {
  const least = Math.min(before.length, after.length);
  let start = 0;
  while (start < least && before[start] === after[start]) start++;
  let tail = 0;
  while (tail < least - start && before[before.length - 1 - tail] === after[after.length - 1 - tail]) tail++;
  return { start, gone: before.slice(start, before.length - tail), come: after.slice(start, after.length - tail) };
}

export class History {
  /** @param {string} text */
  constructor(text) {
    this.text = text;
    /** @type {Step[]} */
    this.done = [];
    /** @type {Step[]} */
    this.undone = [];
  }

  /**
   * Goes on to another text. With `within`, an edit of the same label that many milliseconds ago and
   * this one are one.
   * @param {string} text
   * @param {string} label
   * @param {number} [within]
   */
  push(text, label, within = 0) {
    if (text === this.text) return;
    const time = Date.now();
    const last = this.done[this.done.length - 1];
    let before = this.text;
    if (last && within && last.label === label && time - last.time < within) {
      before = replaced(before, last.start, last.come, last.gone);
      this.done.pop();
    }
    this.done.push({ ...difference(before, text), label, time });
    this.undone = [];
    this.text = text;
  }

  /** Takes the last edit back; its label, null where there is none. */
  undo() {
    const step = this.done.pop();
    if (!step) return null;
    this.text = replaced(this.text, step.start, step.come, step.gone);
    this.undone.push(step);
    return step.label;
  }

  /** Does again what was taken back last; its label, null where there is nothing. */
  redo() {
    const step = this.undone.pop();
    if (!step) return null;
    this.text = replaced(this.text, step.start, step.gone, step.come);
    this.done.push({ ...step, time: 0 });
    return step.label;
  }
}

/**
 * @param {string} text
 * @param {number} start
 * @param {string} from
 * @param {string} to
 */
function replaced(text, start, from, to) {
  return text.slice(0, start) + to + text.slice(start + from.length);
}

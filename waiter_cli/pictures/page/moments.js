// @ts-check
// Moments of an evening: changes put together, and what lies between two of them.
//
// `waiter_cli.pictures.moments` makes the changes. Places are centimetres, angles degrees.

/**
 * `robot` is [x, y, yaw, load], or each `robot NAME` [x, y, yaw, load, number]; `@NAME` a person [x, y, yaw, role, number, posture, hand];
 * `!SPEAKER` a bubble [x, y, text]. `rows` are the plan: [words, done | failed | now | next].
 * @typedef {Record<string, any>} Moment
 */

/**
 * [seconds, what changed, keys that are gone]
 * @typedef {[number, Moment, string[]]} Change
 */

/**
 * The moment after a change.
 * @param {Moment} moment
 * @param {Change} change
 * @returns {Moment}
 */
export function after(moment, change) {
  const next = { ...moment, ...change[1] };
  for (const key of change[2]) delete next[key];
  return next;
}

/**
 * A moment between two others: robot and people glide, all else is as in the first.
 * @param {Moment} from
 * @param {Moment} to
 * @param {number} part 0 at the first, 1 at the second
 * @returns {Moment}
 */
export function between(from, to, part) {
  const found = { ...from };
  for (const key in from) {
    if (!/^(robot($| )|@)/.test(key)) continue;
    const [a, b] = [from[key], to[key]];
    if (!b || a === b || Math.hypot(b[0] - a[0], b[1] - a[1]) > 300) continue;
    const turn = ((((b[2] - a[2] + 180) % 360) + 360) % 360) - 180;
    const yaw = a[2] + turn * part;
    found[key] = [a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part, yaw, ...a.slice(3)];
  }
  return found;
}

/** A recording: finds the moment at any time without starting from the beginning. */
export class Reel {
  /** @param {Change[]} changes in the order of time */
  constructor(changes) {
    this.changes = changes;
    /** @type {Moment[]} every hundredth moment, before the change of that number */
    this.whole = [];
    let moment = {};
    changes.forEach((change, i) => {
      if (i % 100 === 0) this.whole.push(moment);
      moment = after(moment, change);
    });
  }

  /**
   * The number of the last change at or before a time, 0 before the first.
   * @param {number} time seconds
   */
  index(time) {
    let [low, high] = [0, this.changes.length - 1];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.changes[middle][0] <= time + 1e-9) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /**
   * The moment at a time.
   * @param {number} time seconds
   * @returns {Moment}
   */
  at(time) {
    if (!this.changes.length) return {};
    const index = this.index(time);
    let moment = this.whole[Math.floor(index / 100)];
    for (let i = index - (index % 100); i <= index; i++) moment = after(moment, this.changes[i]);
    const next = this.changes[index + 1];
    if (!next || next[0] - this.changes[index][0] > 0.5) return moment;
    const part = (time - this.changes[index][0]) / (next[0] - this.changes[index][0] || 1);
    return between(moment, after(moment, next), Math.min(1, Math.max(0, part)));
  }
}

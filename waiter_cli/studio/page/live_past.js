// @ts-check
// Looking back: moments of the evening that have been, shown again at any time and speed.

import { ask } from "./link.js";
import { Reel } from "./moments.js";

export class Past {
  /** @param {(moment: import("./moments.js").Moment, time: number) => void} show */
  constructor(show) {
    this.show = show;
    /** @type {Reel | null} */
    this.reel = null;
    this.time = 0;
    this.playing = false;
    this.active = false;
    this.asked = 0;
  }

  /**
   * Shows the evening as it was at a time.
   * @param {number} time seconds
   */
  async seek(time) {
    this.active = true;
    this.time = time;
    const known = this.reel?.changes;
    if (!known?.length || time < known[0][0] || time > known[known.length - 1][0]) {
      const number = ++this.asked;
      const found = await ask("past", { time });
      if (number !== this.asked) return;
      this.reel = new Reel(found.changes);
    }
    if (this.active && this.reel) this.show(this.reel.at(this.time), this.time);
  }

  /**
   * Goes on for so many seconds.
   * @param {number} seconds
   */
  advance(seconds) {
    return this.seek(this.time + seconds);
  }

  /** Back to what is now. */
  leave() {
    this.active = this.playing = false;
    this.asked++;
    this.reel = null;
  }
}

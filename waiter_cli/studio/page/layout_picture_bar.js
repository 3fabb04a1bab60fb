// @ts-check
// What is done with a floor-plan picture: choose it, scale it, see through it, take it away.

import { make } from "./build.js";

export class PictureBar {
  /**
   * @param {import("./layout_board.js").Board} board
   * @param {(text: string, bad?: boolean) => void} say
   */
  constructor(board, say) {
    this.board = board;
    this.say = say;
    this.file = /** @type {HTMLInputElement} */ (make("input", {
      type: "file", accept: "image/png,image/jpeg", "aria-label": "Floor plan picture", onchange: () => void this.#load(),
    }));
    this.metres = /** @type {HTMLInputElement} */ (make("input", {
      type: "number", min: "0.01", step: "any", "aria-label": "Metres between the points", placeholder: "metres",
      onkeydown: (/** @type {KeyboardEvent} */ event) => event.key === "Enter" && this.#scale(),
    }));
    this.asking = make("span", { class: "row", hidden: true }, this.metres,
      make("button", { type: "button", onclick: () => this.#scale() }, "Set scale"));
    const opacity = /** @type {HTMLInputElement} */ (make("input", {
      type: "range", min: "0.1", max: "1", step: "0.1", value: "0.6", "aria-label": "Opacity of the picture",
      oninput: () => { this.board.picture.opacity = Number(opacity.value); this.board.picture.draw(); },
    }));
    this.more = make("span", { class: "row", hidden: true },
      make("button", { type: "button", onclick: (/** @type {MouseEvent} */ event) => this.board.use("scale", event.detail === 0) }, "Scale picture"),
      opacity, make("button", { type: "button", onclick: () => this.#drop() }, "Remove picture"));
    this.element = make("span", { class: "row picture-bar" }, make("label", { class: "file-choice" }, "Picture…", this.file), this.more, this.asking);
    /** @type {[number, number][]} */
    this.points = [];
  }

  async #load() {
    const file = this.file.files?.[0];
    if (!file) return;
    try {
      await this.board.picture.load(file);
      this.more.hidden = false;
      this.say("Scale picture: click two points of it, then type the metres between them.");
    } catch (error) {
      this.say(error instanceof Error ? error.message : String(error), true);
    }
    this.file.value = "";
  }

  /**
   * Asks for the metres between two points that were clicked.
   * @param {[number, number]} one
   * @param {[number, number]} other
   */
  measured(one, other) {
    this.points = [one, other];
    this.asking.hidden = false;
    this.metres.value = "";
    this.metres.focus();
  }

  #scale() {
    const metres = Number(this.metres.value);
    if (this.points.length === 2 && this.board.picture.scale(this.points[0], this.points[1], metres)) {
      this.asking.hidden = true;
      this.say("The picture is scaled.");
    } else this.say("Type the metres between the two points, more than 0.", true);
  }

  #drop() {
    this.board.picture.drop();
    this.more.hidden = true;
    this.asking.hidden = true;
  }
}

// @ts-check
// A floor-plan picture under the floor, scaled by two points and the metres between them. It stays in the
// browser, and in no file.

import { shape } from "./shapes.js";

export class Picture {
  /** @param {import("./floor.js").Floor} floor */
  constructor(floor) {
    this.floor = floor;
    this.layer = shape("g", { class: "layer-picture", "aria-hidden": "true" });
    floor.svg.insertBefore(this.layer, floor.layers.edges);
    /** @type {{x: number, y: number, width: number, height: number} | null} its lower left corner, metres */
    this.box = null;
    this.opacity = 0.6;
    this.address = "";
  }

  /**
   * Lays a picture under the floor, as wide as the room; raises `Error` where it is none.
   * @param {File} file
   */
  async load(file) {
    if (!["image/png", "image/jpeg"].includes(file.type)) throw new Error(`${file.name} is no PNG or JPEG`);
    const address = URL.createObjectURL(file);
    const image = new Image();
    image.src = address;
    try {
      await image.decode();
    } catch {
      URL.revokeObjectURL(address);
      throw new Error(`${file.name} cannot be read as a picture`);
    }
    this.drop();
    this.address = address;
    const [x0, x1, y0] = this.floor.room?.bounds ?? [0, 10, 0, 8];
    const width = x1 - x0;
    this.box = { x: x0, y: y0, width, height: (width * image.naturalHeight) / image.naturalWidth };
    this.draw();
  }

  /** Takes the picture away. */
  drop() {
    if (this.address) URL.revokeObjectURL(this.address);
    this.address = "";
    this.box = null;
    this.draw();
  }

  /**
   * Makes it larger or smaller until two of its points are so far from each other; the first one stays.
   * @param {[number, number]} one
   * @param {[number, number]} other
   * @param {number} metres
   */
  scale(one, other, metres) {
    const now = Math.hypot(other[0] - one[0], other[1] - one[1]);
    if (!this.box || !(metres > 0) || !(now > 0.001)) return false;
    const factor = metres / now;
    this.box = {
      x: one[0] + (this.box.x - one[0]) * factor, y: one[1] + (this.box.y - one[1]) * factor,
      width: this.box.width * factor, height: this.box.height * factor,
    };
    this.draw();
    return true;
  }

  draw() {
    this.floor.svg.classList.toggle("over-picture", this.box !== null);
    if (!this.box) return this.layer.replaceChildren();
    const { x, y, width, height } = this.box;
    this.layer.replaceChildren(shape("image", {
      href: this.address, x, y: -y - height, width, height, opacity: this.opacity, preserveAspectRatio: "none",
      "data-width": width.toFixed(3), "data-height": height.toFixed(3),
    }));
  }
}

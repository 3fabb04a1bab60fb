// @ts-check
// The room Live.

import { make } from "./build.js";
import { Floor } from "./floor.js";

/** @type {import("./main.js").Room} */
export const live = {
  name: "Live",
  async start(panel, studio) {
    const host = make("div", { class: "floor-host" });
    panel.append(host, make("p", { class: "absent" }, "Nobody moves here yet."));
    const floor = new Floor(host, { interactive: true });
    floor.show(studio.room);
    return {};
  },
};

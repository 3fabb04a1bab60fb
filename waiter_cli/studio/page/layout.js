// @ts-check
// The room Layout.

import { make } from "./build.js";

/** @type {import("./main.js").Room} */
export const layout = {
  name: "Layout",
  async start(panel) {
    panel.append(make("p", { class: "absent" }, "The room Layout is not there yet."));
    return {};
  },
};

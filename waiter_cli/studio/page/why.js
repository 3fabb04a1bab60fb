// @ts-check
// The room Why.

import { make } from "./build.js";

/** @type {import("./main.js").Room} */
export const why = {
  name: "Why",
  async start(panel) {
    panel.append(make("p", { class: "absent" }, "The room Why is not there yet."));
    return {};
  },
};

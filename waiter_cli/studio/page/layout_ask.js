// @ts-check
// Questions of the room Layout: to the server, and to the person.

import { make } from "./build.js";

export { ask, Refused } from "./link.js";

/**
 * Asks the person; the answer is the text of a button, the last one where the question is closed.
 * @param {HTMLElement} host
 * @param {string} title
 * @param {string} message
 * @param {string[]} answers
 * @returns {Promise<string>}
 */
export function askWhatToDo(host, title, message, answers) {
  return new Promise((done) => {
    const dialog = /** @type {HTMLDialogElement} */ (make("dialog", { "aria-label": title, class: "question" },
      make("h2", {}, title), make("p", {}, message)));
    const buttons = answers.map((answer) => make("button", { type: "button", onclick: () => dialog.close(answer) }, answer));
    dialog.append(make("div", { class: "row" }, ...buttons));
    dialog.addEventListener("close", () => {
      dialog.remove();
      done(dialog.returnValue || answers[answers.length - 1]);
    });
    host.append(dialog);
    dialog.showModal();
    buttons[buttons.length - 1].focus();
  });
}

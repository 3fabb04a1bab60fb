// @ts-check
// The layout's text as the rooms Layout and Why share it.

import { ask } from "./link.js";

/** `room` is the room Layout once it was opened; `waiting` are edits that it has to do then.
 * @type {{room: {history: {text: string}, edit: (edits: any[], label: string) => Promise<string>} | null,
 *   waiting: any[], text: string | null}} */
export const shared = { room: null, waiting: [], text: null };

/** The layout's text with all that was done to it. */
export async function layoutText() {
  if (shared.room) return shared.room.history.text;
  shared.text ??= /** @type {string} */ ((await ask("layout_open")).text);
  return shared.text;
}

/**
 * Does edits of the layout's text; they stand in the room Layout, to be undone or saved there.
 * @param {any[]} edits
 * @param {string} label
 */
export async function editLayout(edits, label) {
  if (shared.room) return void (await shared.room.edit(edits, label));
  shared.text = (await ask("layout_edit", { text: await layoutText(), edits, quiet: true })).text;
  shared.waiting.push(...edits);
}

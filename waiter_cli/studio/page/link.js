// @ts-check
// The way to the server: lines and answers over the WebSocket /live, and actions by POST.

/** What the server refused: its words, and the mend where there is one. */
export class Refused extends Error {
  /**
   * @param {string} message
   * @param {string | null} [hint]
   * @param {any[]} [faults] each {message, file, line, column, hint}
   * @param {number} [status] of the answer; 409 where a file was changed elsewhere
   */
  constructor(message, hint = null, faults = [], status = 400) {
    super(message);
    this.hint = hint;
    this.faults = faults;
    this.status = status;
  }
}

/**
 * Asks for an action of `waiter_cli/studio/page_actions.py`; raises `Refused`.
 * @param {string} name
 * @param {Record<string, any>} [given]
 * @returns {Promise<any>}
 */
export async function ask(name, given = {}) {
  const answer = await fetch(`/do/${name}`, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(given),
  });
  const found = await answer.json().catch(() => ({ error: { message: `the studio answered ${answer.status}` } }));
  if (!answer.ok) throw new Refused(found.error.message, found.error.hint, found.error.faults, answer.status);
  return found;
}

/**
 * The evening's socket. `send` a line (an object), `hear` what the studio says: `onsaid` is called with
 * each object, `onend` once the connection is gone.
 */
export class Live {
  /**
   * @param {(told: any) => void} onsaid
   * @param {() => void} onend
   */
  constructor(onsaid, onend) {
    this.socket = new WebSocket(`ws://${location.host}/live`);
    this.socket.addEventListener("message", (event) => onsaid(JSON.parse(event.data)));
    this.socket.addEventListener("close", onend);
  }

  /** @param {Record<string, any>} line */
  send(line) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(line));
  }
}

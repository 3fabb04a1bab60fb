// @ts-check
// Who is where at a step of a plan, as moments of the floor.

import { robotsOf } from "./robots.js";

/**
 * @param {{robots: Record<string, string>, waiters: Record<string, string>, seated: Record<string, string[]>,
 *   led: Record<string, string[]>, waiting: string[][]}} frame
 * @param {import("./floor.js").RoomDocument & {queue?: number[][]}} room `queue` are places to wait at
 * @returns {import("./moments.js").Moment}
 */
export function momentOf(frame, room) {
  /** @type {Record<string, any>} */
  const moment = {};
  const put = (/** @type {string} */ name, /** @type {number[]} */ [x, y, turn = 0], /** @type {string} */ role) => {
    moment[`@${name}`] = [x * 100, y * 100, (turn * 180) / Math.PI, role, Number(name.replace(/\D/g, "")) || 0, "stands", 0];
  };
  Object.assign(moment, robotsOf(frame.robots, room.nodes));
  for (const [name, node] of Object.entries(frame.waiters)) put(name, room.nodes[node], "waiter");
  for (const [table, party] of Object.entries(frame.seated)) {
    party.forEach((name, i) => put(name, room.chairs[table][i] ?? room.tables[table], "guest"));
  }
  for (const [robot, party] of Object.entries(frame.led)) {
    const [x, y] = room.nodes[frame.robots[robot]];
    party.forEach((name, i) => put(name, [x - 0.55 - 0.35 * (i % 3), y - 0.35 * Math.floor(i / 3) - 0.3], "guest"));
  }
  const places = room.queue?.length ? room.queue : [room.nodes[room.entrance]];
  frame.waiting.flat().forEach((name, i) => put(name, places[i % places.length], "guest"));
  return moment;
}

/** First-listed members of parties, by any member.
 * @param {any} frame
 */
export function leadersOf(frame) {
  /** @type {Record<string, string>} */
  const leaders = {};
  for (const party of [...Object.values(frame.seated), ...Object.values(frame.led), ...frame.waiting]) {
    for (const name of /** @type {string[]} */ (party)) leaders[name] = /** @type {string[]} */ (party)[0];
  }
  return leaders;
}

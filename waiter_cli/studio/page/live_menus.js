// @ts-check
// What can be done with each thing on the floor: the items of its menu, each a line of the live loop.

/** @typedef {import("./menu.js").Item} Item */

/**
 * The menu of a thing by its accessible name; empty where nothing can be done.
 * @param {string} name
 * @param {Record<string, any>} view what the studio told last
 * @param {Record<string, any>} room
 * @param {(line: Record<string, any>) => void} send
 * @returns {Item[]}
 */
export function deeds(name, view, room, send) {
  const [kind, ...rest] = name.split(" ");
  const own = kind === "path" || kind === "wall" ? [] : ownDeeds(view.own, send, rest[0]);
  return [...houseDeeds(kind, rest, view, room, send), ...own];
}

/**
 * What a domain of one's own has words for, about one thing or about everything: to be seen, to be wished.
 * @param {{observables: {term: string, about: string[]}[], fluents: {term: string, about: string[], holds: boolean}[]}} own
 * @param {(line: Record<string, any>) => void} send
 * @param {string} [about]
 * @returns {Item[]}
 */
export function ownDeeds(own, send, about) {
  const meant = (/** @type {{about: string[]}} */ each) => about === undefined || each.about.includes(about);
  return [
    ...own.observables.filter(meant).map(({ term }) => ({ text: `seen: ${term}`, act: () => send({ observe: { obs: term } }) })),
    ...own.fluents.filter(meant).map(({ term, holds }) => holds
      ? { text: `wanted: not ${term}`, act: () => send({ goal: { holds_not: term } }) }
      : { text: `wanted: ${term}`, act: () => send({ goal: { holds: term } }) }),
  ];
}

/**
 * @param {string} kind
 * @param {string[]} rest
 * @param {Record<string, any>} view
 * @param {Record<string, any>} room
 * @param {(line: Record<string, any>) => void} send
 * @returns {Item[]}
 */
function houseDeeds(kind, rest, view, room, send) {
  const observe = (/** @type {any} */ seen) => () => send({ observe: seen });
  switch (kind) {
    case "table":
      return tableDeeds(rest[0], view, room, send, observe);
    case "path": {
      const blocked = view.blocked.some((/** @type {string[]} */ edge) => edge[0] === rest[0] && edge[1] === rest[1]);
      return [
        { text: "block", act: () => send({ block: rest }), why: blocked ? "it is blocked already" : null },
        { text: "clear", act: () => send({ clear: rest }), why: blocked ? null : "it is not blocked" },
      ];
    }
    case "bar":
      return Object.keys(room.tables).map((table) => ({
        text: `plate for ${table} is ready`,
        act: observe({ ready: { [table]: "plate" } }),
        why: room.objects.includes("plate") ? null : "there are no plates here",
      }));
    case "waiter":
      return Object.keys(room.nodes).map((node) => ({
        text: `go to ${node}`,
        act: observe({ at: { [rest[0]]: node } }),
        why: whoIsAt(node, view, rest[0]),
      }));
    case "node":
      return Object.keys(view.state.waiters ?? {}).map((who) => ({
        text: `send ${who} here`,
        act: observe({ at: { [who]: rest[0] } }),
        why: whoIsAt(rest[0], view, who),
      }));
    case "robot": {
      const robot = view.robots.find((/** @type {any} */ each) => each.name === rest[0]);
      return robot ? robotDeeds(robot, view.robots.length > 1, send) : [];
    }
    case "party":
      return [{ text: "guests leave", act: observe({ leave: [rest[0]] }) }];
  }
  return [];
}

/**
 * What can happen to a robot; only one of several is ever out.
 * @param {{name: string, out: boolean, at_step: number | null}} robot
 * @param {boolean} several
 * @param {(line: Record<string, any>) => void} send
 * @returns {Item[]}
 */
function robotDeeds({ name, out, at_step }, several, send) {
  const idle = out ? "it stands still" : at_step === null ? "it is at no step" : null;
  const fail = { text: "fail this step", act: () => send({ failed: several ? { [name]: at_step } : at_step }), why: idle };
  return !several ? [fail] : [
    fail,
    { text: "robot is out", act: () => send({ observe: { out: name } }), why: out ? "it stands still already" : null },
    { text: "robot is back", act: () => send({ back: name }), why: out ? null : "it does not stand still" },
  ];
}

/**
 * The parties that follow robots: of one its party, of several who follows which.
 * @param {string[] | Record<string, string[]> | undefined} parties
 * @returns {string[][]}
 */
function led(parties) {
  return Array.isArray(parties) ? [parties] : Object.values(parties ?? {});
}

/**
 * @param {string} node
 * @param {Record<string, any>} view
 * @param {string} who
 */
function whoIsAt(node, view, who) {
  const robot = view.robots.find((/** @type {any} */ each) => each.at === node);
  if (robot) return `${view.robots.length > 1 ? robot.name : "the robot"} is there`;
  const other = Object.entries(view.state.waiters ?? {}).find(([, at]) => at === node);
  if (!other) return null;
  return other[0] === who ? `${who} is there already` : `${other[0]} is there`;
}

/**
 * @param {string} table
 * @param {Record<string, any>} view
 * @param {Record<string, any>} room
 * @param {(line: Record<string, any>) => void} send
 * @param {(seen: any) => () => void} observe
 * @returns {Item[]}
 */
function tableDeeds(table, view, room, send, observe) {
  const guests = view.state.seated?.[table];
  const free = guests ? null : "nobody sits here";
  const stocked = (/** @type {string} */ item) => (room.bar && room.objects.includes(item) ? null : `there is no bar with a ${item}`);
  /** @type {string[][]} */
  const waiting = [...led(view.state.with_agent), ...(view.state.waiting ?? [])];
  const party = waiting.find((each) => each.length <= room.capacity[table]);
  const taken = guests ? "somebody sits here" : !waiting.length ? "nobody waits" : party ? null : `${table} is too small`;
  return [
    { text: "wants the bill", act: observe({ bill: table }) },
    { text: "is ready to order", act: observe({ order: table }), why: room.bar ? free : "there is no bar to order from" },
    { text: "jug is empty", act: observe({ empty: { [table]: "jug" } }), why: stocked("jug") },
    { text: "basket is empty", act: observe({ empty: { [table]: "basket" } }), why: stocked("basket") },
    { text: "guests leave", act: () => send({ observe: { leave: [guests[0]] } }), why: free },
    { text: "seat someone here", act: () => send({ seat: { party: party?.[0], table } }), why: taken },
  ];
}

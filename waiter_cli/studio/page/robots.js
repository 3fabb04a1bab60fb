// @ts-check
// Robots that stand on their nodes, and the ways that plans have them go.

import { ROBOT_COLOURS } from "./figures.js";
import { shape } from "./shapes.js";

/**
 * Robots on their nodes: a single one without a name, each of several with its own.
 * @param {Record<string, string>} robots
 * @param {Record<string, number[]>} nodes
 */
export function robotsOf(robots, nodes) {
  /** @type {Record<string, any>} */
  const moment = {};
  Object.entries(robots).forEach(([name, node], number) => {
    if (!nodes[node]) return;
    const at = [nodes[node][0] * 100, nodes[node][1] * 100, 0, ""];
    if (name === "agent") moment.robot = at;
    else moment[`robot ${name}`] = [...at, number];
  });
  return moment;
}

/**
 * The ways of robots by the nodes that they pass, each in its colour.
 * @param {string[][]} routes
 * @param {Record<string, number[]>} nodes
 */
export function waysOf(routes, nodes) {
  return routes.flatMap((route, number) => {
    const points = route.map((name) => nodes[name]).filter(Boolean).map(([x, y]) => `${x},${-y}`);
    const style = `way-of-plan${routes.length > 1 ? ` robot-${number % ROBOT_COLOURS}` : ""}`;
    return points.length > 1 ? [shape("polyline", { points: points.join(" "), class: style })] : [];
  });
}

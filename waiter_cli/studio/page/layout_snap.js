// @ts-check
// Where what is dragged comes to rest: in line with other things, else on a grid of 5 cm. Metres.

export const GRID = 0.05;
const REACH = 0.1;

/** @param {number} value */
export function onGrid(value) {
  return round(Math.round(value / GRID) * GRID);
}

/** @param {number} value millimetres are the least that is kept */
export function round(value) {
  return Math.round(value * 1000) / 1000 + 0;
}

/**
 * @param {[number, number]} at where the thing would be
 * @param {number[][]} others places of things that stay
 * @param {boolean} [free] snaps to nothing
 * @returns {{at: [number, number], guides: {across: boolean, at: number, from: number[]}[]}} a guide is a
 *   line along x (`across`) or y through `at`, from another thing
 */
export function snap(at, others, free = false) {
  if (free) return { at: [round(at[0]), round(at[1])], guides: [] };
  /** @type {{across: boolean, at: number, from: number[]}[]} */
  const guides = [];
  const found = [0, 1].map((axis) => {
    let best = null;
    for (const other of others) {
      const far = Math.abs(other[axis] - at[axis]);
      const whole = Math.hypot(other[0] - at[0], other[1] - at[1]);
      if (far <= REACH && (!best || far < best.far - 1e-9 || (far < best.far + 1e-9 && whole < best.whole))) {
        best = { far, whole, other };
      }
    }
    if (!best) return onGrid(at[axis]);
    guides.push({ across: axis === 1, at: best.other[axis], from: best.other });
    return round(best.other[axis]);
  });
  return { at: [found[0], found[1]], guides };
}

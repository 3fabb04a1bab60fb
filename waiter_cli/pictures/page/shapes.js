// @ts-check
// Small helpers for SVG elements. Lengths are metres; y grows downwards on the page, so it is negated.

// The namespace of SVG, as whoever reads HTML knows it.
const reader = document.createElement("template");
reader.innerHTML = "<svg></svg>";
const SVG = reader.content.firstElementChild?.namespaceURI ?? null;

/**
 * Makes an SVG element.
 * @param {string} name
 * @param {Record<string, string | number | null | undefined>} [attributes]
 * @param {...(Node | string)} children
 * @returns {SVGElement}
 */
export function shape(name, attributes = {}, ...children) {
  const element = /** @type {SVGElement} */ (document.createElementNS(SVG, name));
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== null && value !== undefined) element.setAttribute(key, String(value));
  }
  element.append(...children);
  return element;
}

/**
 * A rectangle in metres, turned by ``yaw`` radians.
 * @param {number} x
 * @param {number} y
 * @param {number} halfX
 * @param {number} halfY
 * @param {number} yaw
 * @param {string} style class of the element
 * @param {number} [round] radius of its corners
 * @returns {SVGElement}
 */
export function slab(x, y, halfX, halfY, yaw, style, round = 0.06) {
  const turned = yaw ? `rotate(${degrees(-yaw)} ${x} ${-y})` : null;
  const size = { x: x - halfX, y: -y - halfY, width: 2 * halfX, height: 2 * halfY };
  return shape("rect", { ...size, rx: Math.min(round, halfX, halfY), class: style, transform: turned });
}

/**
 * @param {number} x
 * @param {number} y
 * @param {number} r
 * @param {string} style
 */
export function disc(x, y, r, style) {
  return shape("circle", { cx: x, cy: -y, r, class: style });
}

/**
 * A name on the floor, with a halo so that it can be read on anything.
 * @param {string} text
 * @param {number} x
 * @param {number} y
 * @param {string} style
 */
export function lettering(text, x, y, style) {
  return shape("text", { x, y: -y, class: style, "aria-hidden": "true" }, text);
}

/** @param {number} radians */
export function degrees(radians) {
  return (radians * 180) / Math.PI;
}

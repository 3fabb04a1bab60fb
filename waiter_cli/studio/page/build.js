// @ts-check
// Makes elements of the page. Text is always text, never markup.

/**
 * @param {string} name
 * @param {Record<string, any>} [properties] attributes; `on…` are listeners, false and null leave out
 * @param {...(Node | string)} children
 * @returns {HTMLElement}
 */
export function make(name, properties = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else element.setAttribute(key, value === true ? "" : String(value));
  }
  element.append(...children);
  return element;
}

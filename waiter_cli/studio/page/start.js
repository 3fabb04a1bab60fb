// @ts-check
// Trades the token in the address for a cookie, once, and takes it out of the address; then the page
// itself is loaded. A browser that has the cookie may open the same address again.

const STYLES = ["floor.css", "style.css"];
/** What main.js loads one by one is asked for at once. */
const MODULES = [
  "main", "build", "live_menus", "figures", "floor", "live_hands", "link", "live", "menu", "moments", "live_past", "shapes",
];

let why = "The studio cannot be opened from this address.";
let mend = "Open the one that waiter studio printed, with all that follows the #.";
const token = location.hash.slice(1);
if (token) {
  history.replaceState(null, "", "/");
  const answer = await fetch("/token", {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify({ token }),
  });
  if (!answer.ok) {
    const found = await answer.json().catch(() => ({}));
    [why, mend] = [found.error?.message ?? why, found.error?.hint ?? mend];
  }
}
try {
  for (const name of MODULES) link("modulepreload", `/page/${name}.js`);
  const styled = Promise.all(STYLES.map((name) => new Promise((done, failed) => {
    const style = link("stylesheet", `/page/${name}`);
    style.onload = done;
    style.onerror = failed;
  })));
  styled.catch(() => {}); // told of where it is waited for
  const { begin } = await import("/page/main.js");
  await begin(styled);
} catch (error) {
  console.error(error);
  const known = (await fetch("/page/main.js").catch(() => null))?.status !== 401;
  if (known) [why, mend] = ["The page could not be loaded.", "Reload it; if the studio has ended, start it again."];
  const told = document.createElement("p");
  told.setAttribute("role", "alert");
  told.style.margin = "2rem";
  told.textContent = `${why} ${mend}`;
  document.getElementById("shell")?.replaceChildren(told);
}

/**
 * Adds a link to the head of the page.
 * @param {string} rel
 * @param {string} href
 */
function link(rel, href) {
  const made = Object.assign(document.createElement("link"), { rel, href });
  document.head.append(made);
  return made;
}

export {};

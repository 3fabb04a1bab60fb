// @ts-check
// Trades the token in the address for a cookie, once, and takes it out of the address; then the page
// itself is loaded. A browser that has the cookie may open the same address again.

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
  const { begin } = await import("/page/main.js");
  await begin();
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

export {};

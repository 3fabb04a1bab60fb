// @ts-check
// Trades the token in the address for a cookie, once, and takes it out of the address; then the page
// itself is loaded.

const token = location.hash.slice(1);
let admitted = true;
if (token) {
  const answer = await fetch("/token", {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify({ token }),
  });
  admitted = answer.ok;
  history.replaceState(null, "", "/");
}
try {
  if (!admitted) throw new Error("refused");
  const { begin } = await import("/page/main.js");
  await begin();
} catch (error) {
  const shell = document.getElementById("shell");
  const told = document.createElement("p");
  told.setAttribute("role", "alert");
  told.textContent = "The studio cannot be opened from this address. Open the one that waiter studio printed, with all that follows the #.";
  shell?.replaceChildren(told);
  console.error(error);
}

export {};

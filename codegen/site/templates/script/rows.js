// The rows of a table of items. Their details unfold in place: one row by its button, the row of the address, or all rows.

// The details of an item are completed when they are shown for the first time. Each function gets a row group.
const completions = [];

function unfold(row, isOpen) {
  row.classList.toggle("open", isOpen);
  row.querySelector("button.fold")?.setAttribute("aria-expanded", String(isOpen));
  if (!isOpen || row.dataset.complete || row.matches(".of-elements *")) return;
  row.dataset.complete = "yes";
  for (const complete of completions) complete(row);
}

const foldable = [...document.querySelectorAll(".items > tbody")].filter((row) => row.querySelector(":scope > .more"));
for (const row of foldable) {
  const heading = row.rows[0].cells[0];
  const button = element("button", { type: "button", className: "fold", title: "Details" });
  button.setAttribute("aria-expanded", "false");
  button.setAttribute("aria-label", `Details of ${heading.textContent.trim()}`);
  heading.prepend(button);
}

// A click anywhere in a row unfolds it, unless it is on a link or selects text.
document.addEventListener("click", ({ target }) => {
  const line = target.closest(".items > tbody > tr:not(.more)"), row = line?.parentElement;
  if (!line?.querySelector("button.fold") || target.closest("a, code") || !getSelection().isCollapsed) return;
  unfold(row, !row.classList.contains("open"));
});

for (const button of document.querySelectorAll("button.unfold")) {
  button.hidden = foldable.length === 0;
  button.addEventListener("click", () => {
    const isOpen = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(isOpen));
    for (const row of foldable) unfold(row, isOpen);
  });
}

// Unfolds the row of the address, or of the bit or value with the address.
function unfoldTarget() {
  const id = addressOfUrl(), row = (byId(id) ?? byId(withoutPart(id)))?.closest(".items > tbody");
  document.querySelector(".target")?.classList.remove("target");
  if (!row || !foldable.includes(row)) return;
  unfold(row, true);
  const part = byId(id);
  if (!part || part === row) return;
  part.classList.add("target");
  part.scrollIntoView({ block: "center" });
}

// Returns the address of the item that has a bit or value: `0x6041` of `0x6041.bit-3`.
const withoutPart = (address) => address.replace(/\.(bit|value)-[^.]+(\.value-[^.]+)?(\.[0-9]+)?$/, "");
addEventListener("hashchange", unfoldTarget);

// The description moves to the details, where it has more space.
completions.push((row) => {
  const description = row.querySelector(":scope > tr:not(.more) > td > span");
  if (description) row.querySelector(":scope > .more > td").prepend(element("p", { textContent: description.textContent }));
});

completions.push((row) => {
  for (const code of row.querySelectorAll("p > code:only-child")) code.after(" ", copyButton(code));
});

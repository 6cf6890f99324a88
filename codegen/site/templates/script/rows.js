// The rows of a table of items. Their details unfold in place: one row by its button, the row of the address, or all rows.

// The details of a row are completed when they are shown for the first time. Each function gets a row group.
const completions = [];

function unfold(row, isOpen) {
  row.classList.toggle("open", isOpen);
  row.querySelector("button.fold")?.setAttribute("aria-expanded", String(isOpen));
  if (!isOpen || row.dataset.complete) return;
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

// Unfolds the row of the address.
function unfoldTarget() {
  const id = addressOfUrl();
  const [, owner, kind, number] = id.match(/^(.*)\.(bit|value)-([^.]+)$/) ?? [];
  const row = (byId(id) ?? byId(owner))?.closest(".items > tbody");
  if (!row || !foldable.includes(row)) return;
  unfold(row, true);
  const part = byId(id) ? undefined : partOf(row, kind, number);
  part?.classList.add("target");
  part?.scrollIntoView({ block: "center" });
}

// Returns the line of a bit field or the term of a named value.
function partOf(row, kind, number) {
  const numbered = (cell) => cell.textContent.split(" ")[0] === number;
  if (kind === "value") return [...row.querySelectorAll(":scope > .more > td > dl > dt")].find(numbered);
  return [...row.querySelectorAll(".fields > tbody > tr")].find((line) => numbered(line.cells[0]));
}
addEventListener("hashchange", unfoldTarget);

// The description moves to the details, where it has more space.
completions.push((row) => {
  const description = row.querySelector(":scope > tr:not(.more) > td > span");
  if (description) row.querySelector(":scope > .more > td").prepend(element("p", { textContent: description.textContent }));
});

completions.push((row) => {
  for (const code of row.querySelectorAll("p > code:only-child")) code.after(" ", copyButton(code));
});

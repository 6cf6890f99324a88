// The list of devices.
const deviceFilter = byId("devices"), elsewhere = byId("elsewhere");

// Narrow screens show the title of the column before each text.
for (const table of document.querySelectorAll("table.devices")) {
  const titles = [...table.tHead.rows[0].cells].map((cell) => cell.textContent);
  for (const cell of table.querySelectorAll("td")) if (cell.textContent) cell.dataset.title = titles[cell.cellIndex];
}

// Shows the devices that contain all typed words, themselves or in their family, and their number.
deviceFilter?.addEventListener("input", () => {
  const words = plain(deviceFilter.value).split(/\s+/).filter(Boolean);
  let count = 0;
  for (const group of document.querySelectorAll(".devices tbody")) {
    const family = group.querySelector(".family"), rows = [...group.rows].filter((row) => row !== family);
    for (const row of rows) {
      const text = plain(row.textContent + " " + (family?.textContent ?? ""));
      row.hidden = !words.every((word) => text.includes(word));
    }
    const shown = rows.filter((row) => !row.hidden).length;
    group.hidden = shown === 0;
    count += shown;
  }
  byId("shown").textContent = `${count} device${count === 1 ? "" : "s"}${elsewhere ? " on this page" : ""}`;
  showElsewhere(words);
});

// Shows the devices on the other pages of a long list, which the index contains.
function showElsewhere(words) {
  if (!elsewhere) return;
  load();
  const listed = new Set([...document.querySelectorAll(".devices th a")].map((link) => link.href));
  const links = devicesWith(words).filter((link) => !listed.has(link.href)).slice(0, MOST);
  elsewhere.replaceChildren(...links.map((link) => element("li", {}, link)));
  elsewhere.hidden = !links.length;
}

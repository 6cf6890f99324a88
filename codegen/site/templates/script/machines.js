// State machines: a status value shows the state, and the next command to each other state.

// Returns mask and value of a bit pattern such as `xxxx x01x 0111`, as a BigInt each.
function patternOf(text) {
  const digits = text.replace(/\s/g, "");
  if (!/^[01x]+$/.test(digits)) return undefined;
  return { mask: BigInt("0b" + digits.replace(/[01]/g, "1").replace(/x/g, "0")), value: BigInt("0b" + digits.replace(/x/g, "0")), bits: digits.length };
}

const namedRows = (section, kind) => [...section.querySelectorAll(`.${kind} tr[id]`)].map((row) => {
  return { row, name: row.cells[0].querySelector("b").textContent, pattern: patternOf(row.cells[1].textContent) };
});

// Returns the commands of the shortest path to each state. The reactions to a fault, which can start in any state, are no way to a state.
// No path leads through an energized state, or from a state without a fault through a fault state.
function nextSteps(transitions, from, classes) {
  const steps = new Map(), paths = new Map([[from, []]]), isFault = (state) => classes.get(state) === "fault";
  for (const [state, path] of paths) {
    for (const { source, to, command } of transitions) {
      if (source === "any state" && command === "automatic") continue;
      if ((source !== state && source !== "any state") || to === from) continue;
      const next = [...path, command];
      if (!steps.has(to)) steps.set(to, next);
      if (!paths.has(to) && classes.get(to) !== "energized" && (!isFault(to) || isFault(state))) paths.set(to, next);
    }
  }
  return steps;
}

function stateFinder(section) {
  const all = namedRows(section, "of-states"), states = all.filter(({ pattern }) => pattern), commands = namedRows(section, "of-commands");
  const transitions = [...section.querySelectorAll(".of-transitions tbody tr")].map(({ cells }) => {
    return { source: cells[1].textContent, to: cells[2].textContent, command: cells[3].textContent };
  });
  if (!states.length) return;
  const classes = new Map(all.map(({ row, name }) => [name, ["fault", "energized"].find((one) => row.classList.contains(one))]));
  const type = { bits: Math.max(...states.map(({ pattern }) => pattern.bits)) };
  const input = element("input", { type: "text", className: "status", placeholder: "0x… or decimal", ariaLabel: "Status value" });
  const shown = element("output", {}), list = element("ul", { className: "next" });
  const named = (command) => {
    if (command === "automatic") return "wait";
    const pattern = commands.find(({ name }) => name === command)?.pattern;
    return pattern ? `${command} (${hexOf({ bits: pattern.bits }, pattern.value)})` : command;
  };
  const describe = ([state, steps]) => element("li", {}, element("b", { textContent: state }), ": " + steps.map(named).join(", then "));
  input.addEventListener("input", () => {
    const raw = rawFrom(input.value, type);
    input.setAttribute("aria-invalid", String(raw === undefined && input.value !== ""));
    const found = raw === undefined ? undefined : states.find(({ pattern }) => (raw & pattern.mask) === pattern.value);
    for (const { row, name } of states) row.classList.toggle("on", name === found?.name);
    for (const box of section.querySelectorAll(".state")) box.classList.toggle("on", box.querySelector("text").textContent === found?.name);
    shown.textContent = found ? found.name : raw === undefined ? "" : "no state has this value";
    const steps = found ? [...nextSteps(transitions, found.name, classes)] : [];
    list.replaceChildren(...steps.map(describe));
    title.hidden = !steps.length;
  });
  const title = element("p", { textContent: "Commands to each other state. The values have 0 in all bits that do not belong to the command:", hidden: true });
  const label = element("label", {}, "Status value ", input);
  section.querySelector(".behavior").before(element("div", { className: "tools" }, element("p", {}, label, shown), title, list));
}

for (const section of document.querySelectorAll("section.machine")) stateFinder(section);

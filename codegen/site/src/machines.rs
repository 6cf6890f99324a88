//! State machines: a diagram, lists of states, commands and transitions, and what commands do in each state.

use std::cmp::Ordering;
use std::collections::{HashMap, VecDeque};

use super::entry::{self, Doubt};
use super::words::{self, PLAIN};
use lexibus_codegen::facts::{pattern, types};
use lexibus_codegen::ir::{
    Device, ItemRef, Manual, Outcome, Pattern, Procedure, StateMachine, SubjectKind, Transition,
};

/// Size of a state in the diagram, and the room between two.
const WIDTH: u32 = 170;
const HEIGHT: u32 = 36;
const GAP: u32 = 30;
const RISE: u32 = 70;

/// The room on either side, for arrows that lead back.
const SIDE: u32 = 90;

/// The letters of a name that a state has room for.
const LETTERS: usize = 22;

/// Where transitions start that name no state.
pub(super) const ANY_STATE: &str = "any state";

/// A state machine, ready to be written.
#[derive(Debug)]
pub(super) struct Machine {
    pub title: String,
    pub facts: Vec<String>,
    pub doubts: Vec<Doubt>,
    pub diagram: Option<Diagram>,
    /// The state after power-on.
    pub initial: Option<String>,
    pub states: Vec<Named>,
    pub commands: Vec<Named>,
    pub transitions: Vec<TransitionRow>,
    pub matrix: Option<Matrix>,
}

/// A state or a command.
#[derive(Debug)]
pub(super) struct Named {
    pub name: String,
    pub names: Vec<(String, String)>,
    /// `xxxx xxxx x01x 0111`; empty if the state is a value.
    pub bits: String,
    pub facts: String,
}

/// A transition.
#[derive(Debug)]
pub(super) struct TransitionRow {
    pub number: String,
    /// `None` for any state.
    pub from: Option<String>,
    pub to: String,
    pub command: String,
    pub facts: String,
}

impl TransitionRow {
    /// The state that it leaves, in words.
    pub fn source(&self) -> &str {
        self.from.as_deref().unwrap_or(ANY_STATE)
    }
}

/// What commands do in each state.
#[derive(Debug)]
pub(super) struct Matrix {
    pub states: Vec<String>,
    pub rows: Vec<(String, Vec<String>)>,
    pub notes: Vec<String>,
}

/// States as boxes, transitions as arrows.
#[derive(Debug)]
pub(super) struct Diagram {
    pub width: u32,
    pub height: u32,
    pub boxes: Vec<StateBox>,
    pub arrows: Vec<Arrow>,
}

#[derive(Debug)]
pub(super) struct StateBox {
    pub left: u32,
    pub top: u32,
    pub middle: u32,
    pub base: u32,
    pub label: String,
    pub is_initial: bool,
}

#[derive(Debug)]
pub(super) struct Arrow {
    pub path: String,
    pub x: u32,
    pub y: u32,
    pub label: String,
}

/// A procedure: what to do, step by step.
#[derive(Debug)]
pub(super) struct Sequence {
    pub name: String,
    pub facts: Vec<String>,
    pub doubts: Vec<Doubt>,
    pub steps: Vec<String>,
}

/// The state machines and procedures of a device.
#[derive(Debug)]
pub(super) struct Behaviour {
    pub machines: Vec<Machine>,
    pub sequences: Vec<Sequence>,
}

/// The state machines and procedures of a device, if it has any.
pub(super) fn behaviour(device: &Device, manual: &Manual) -> Option<Behaviour> {
    let machines: Vec<_> = device.machines.iter().map(|own| machine(own, device, manual)).collect();
    let sequences: Vec<_> = device.procedures.iter().map(|procedure| sequence(procedure, device, manual)).collect();
    (!machines.is_empty() || !sequences.is_empty()).then_some(Behaviour { machines, sequences })
}

fn machine(own: &StateMachine, device: &Device, manual: &Manual) -> Machine {
    let width = |item: &ItemRef, patterns: &[Pattern]| {
        let item = device.referred(item);
        pattern::width(item.and_then(|item| types::basic(&device.types, item.ty).bits()), patterns)
    };
    let of_status = width(&own.status_item, &own.states);
    let of_control = width(&own.control_item, &own.commands);
    let mut facts = PLAIN.description(own.documentation.as_deref());
    facts.extend((!own.status_item.is_empty()).then(|| format!("{} tells the state.", own.status_item)));
    facts.extend((!own.control_item.is_empty()).then(|| format!("{} takes the commands.", own.control_item)));
    facts.extend(own.initial.as_ref().map(|state| format!("After power-on: {state}.")));
    facts.extend(PLAIN.place(manual, "", own.documentation.as_deref(), &[]));
    Machine {
        title: own.name.to_string(),
        facts,
        doubts: entry::about(&device.doubts, SubjectKind::Machine, &own.name, manual),
        diagram: diagram(own),
        initial: own.initial.as_ref().map(ToString::to_string),
        states: own.states.iter().map(|state| named(state, of_status)).collect(),
        commands: own.commands.iter().map(|command| named(command, of_control)).collect(),
        transitions: own.transitions.iter().enumerate().map(way).collect(),
        matrix: matrix(own),
    }
}

fn named(own: &Pattern, width: u32) -> Named {
    let bits = if own.mask == 0 { String::new() } else { pattern::text(own.mask, own.value, width) };
    Named {
        name: own.name.to_string(),
        names: words::names(&own.names),
        bits,
        facts: PLAIN.description(own.documentation.as_deref()).join(" "),
    }
}

/// By what the list and the diagram call a transition: its number, else its place.
fn number((at, own): (usize, &Transition)) -> String {
    own.number.map_or_else(|| (at + 1).to_string(), |number| number.to_string())
}

fn way((at, own): (usize, &Transition)) -> TransitionRow {
    TransitionRow {
        number: number((at, own)),
        from: own.from.as_ref().map(ToString::to_string),
        to: own.to.to_string(),
        command: own.command.as_ref().map_or_else(|| "by itself".to_owned(), ToString::to_string),
        facts: PLAIN.description(own.documentation.as_deref()).join(" "),
    }
}

fn matrix(machine: &StateMachine) -> Option<Matrix> {
    let first = machine.outcomes.first()?;
    let states: Vec<String> = first.cells.iter().map(|cell| cell.state.to_string()).collect();
    let mut notes: Vec<String> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    let mut rows = Vec::new();
    for row in &machine.outcomes {
        let mut cells = Vec::new();
        for cell in &row.cells {
            let outcomes: Vec<String> = cell.outcomes.iter().map(outcome).collect();
            let text = PLAIN.description(cell.documentation.as_deref()).join(" ");
            let mark = if text.is_empty() {
                String::new()
            } else {
                let at = *places.entry(text).or_insert_with_key(|text| {
                    notes.push(text.clone());
                    notes.len()
                });
                format!(" ({at})")
            };
            cells.push(outcomes.join(" or ") + &mark);
        }
        rows.push((row.name.to_string(), cells));
    }
    Some(Matrix { states, rows, notes })
}

fn outcome(own: &Outcome) -> String {
    match own {
        Outcome::Unchanged => "stays".to_owned(),
        Outcome::Refused => "–".to_owned(),
        Outcome::States(to) => format!("→ {}", to.join(" → ")),
    }
}

/// The diagram; `None` without a transition between states.
fn diagram(machine: &StateMachine) -> Option<Diagram> {
    let place = |name: &str| machine.states.iter().position(|state| state.name == name);
    // Transitions from any state leave one more box, after those of the states.
    let any = machine.states.len();
    let from = |way: &Transition| way.from.as_ref().map_or(Some(any), |name| place(name));
    // Several transitions from one state to another are one arrow.
    let mut ways: Vec<(usize, usize, String)> = Vec::new();
    for (at, way) in machine.transitions.iter().enumerate() {
        let (Some(from), Some(to)) = (from(way), place(&way.to)) else { continue };
        let number = number((at, way));
        match ways.iter_mut().find(|known| (known.0, known.1) == (from, to)) {
            Some((.., label)) if label.split(", ").any(|known| known == number) => {}
            Some((.., label)) => *label += &format!(", {number}"),
            None => ways.push((from, to, number)),
        }
    }
    if ways.is_empty() {
        return None;
    }
    let first = machine.initial.as_ref().and_then(|name| place(name)).unwrap_or(ways.first()?.0);
    let mut ranks = ranks(any + 1, first, &ways);
    // That box is above the first state that it leads to.
    if let Some(to) = ways.iter().filter(|(from, ..)| *from == any).map(|(_, to, _)| ranks[*to]).min() {
        ranks[any] = to.saturating_sub(1);
    }
    let used = |at: usize| ways.iter().any(|(from, to, _)| *from == at || *to == at);
    let mut rows: Vec<Vec<usize>> = Vec::new();
    for (at, rank) in ranks.iter().enumerate().filter(|(at, _)| used(*at)) {
        while rows.len() <= *rank {
            rows.push(Vec::new());
        }
        rows[*rank].push(at);
    }
    let widest = rows.iter().map(Vec::len).max().unwrap_or(1) as u32;
    let width = widest * (WIDTH + GAP) + 2 * SIDE;
    let mut boxes = vec![None; any + 1];
    for (rank, row) in rows.iter().enumerate() {
        let taken = row.len() as u32 * (WIDTH + GAP);
        let start = SIDE + (width.saturating_sub(2 * SIDE).saturating_sub(taken)) / 2;
        for (column, at) in row.iter().enumerate() {
            boxes[*at] = Some((start + column as u32 * (WIDTH + GAP), 8 + rank as u32 * (HEIGHT + RISE)));
        }
    }
    let arrows = ways
        .iter()
        .enumerate()
        .filter_map(|(number, (from, to, label))| Some(arrow(boxes[*from]?, boxes[*to]?, number as u32, label)));
    let arrows = arrows.collect();
    let state_box = |(at, place): (usize, &Option<(u32, u32)>)| {
        let (left, top) = (*place)?;
        let label =
            machine.states.get(at).map_or_else(|| ANY_STATE.to_owned(), |state| words::cut(&state.name, LETTERS));
        Some(StateBox {
            left,
            top,
            middle: left + WIDTH / 2,
            base: top + 23,
            label,
            is_initial: at == first && at < any,
        })
    };
    let height = rows.len() as u32 * (HEIGHT + RISE) - RISE + 40;
    Some(Diagram { width, height, boxes: boxes.iter().enumerate().filter_map(state_box).collect(), arrows })
}

/// How many transitions each state is from the first one. States that it doesn't lead to come behind: first those that no other
/// state leads to.
fn ranks(count: usize, first: usize, ways: &[(usize, usize, String)]) -> Vec<usize> {
    let mut ranks = vec![None; count];
    let mut last = follow(first, 0, ways, &mut ranks);
    let leads_to = |at: usize| ways.iter().any(|(from, to, _)| *to == at && *from != at);
    let starts: Vec<usize> = (0..count).filter(|at| ranks[*at].is_none() && !leads_to(*at)).collect();
    let rank = last + 1;
    for at in starts {
        last = last.max(follow(at, rank, ways, &mut ranks));
    }
    // States that only lead to one another.
    for at in 0..count {
        if ranks[at].is_none() {
            last = follow(at, last + 1, ways, &mut ranks);
        }
    }
    ranks.into_iter().flatten().collect()
}

/// Ranks a state and those that follow it. Returns the last rank of them.
fn follow(at: usize, rank: usize, ways: &[(usize, usize, String)], ranks: &mut [Option<usize>]) -> usize {
    let mut queue = VecDeque::from([(at, rank)]);
    ranks[at] = Some(rank);
    let mut last = rank;
    while let Some((at, rank)) = queue.pop_front() {
        last = rank;
        for (_, to, _) in ways.iter().filter(|(from, ..)| *from == at) {
            if ranks[*to].is_none() {
                ranks[*to] = Some(rank + 1);
                queue.push_back((*to, rank + 1));
            }
        }
    }
    last
}

/// A curve from one state to another, its number beside it. Those that lead down leave at the bottom, those that lead back at the
/// side that is nearer to the end, and those within a row pass below it.
fn arrow((x, y): (u32, u32), (to_x, to_y): (u32, u32), number: u32, label: &str) -> Arrow {
    let shift = number % 5 * 12;
    let (from_x, end_x) = (x + WIDTH / 2 - 24 + shift, to_x + WIDTH / 2 - 24 + shift);
    let middle_x = (from_x + end_x) / 2 + 4;
    let (path, x, y) = match to_y.cmp(&y) {
        Ordering::Greater => {
            let (start, end) = (y + HEIGHT, to_y);
            let middle = (start + end) / 2;
            (format!("M{from_x} {start}C{from_x} {middle} {end_x} {middle} {end_x} {end}"), middle_x, middle)
        }
        Ordering::Equal if to_x != x => {
            let (bottom, below) = (y + HEIGHT, y + HEIGHT + 26);
            (format!("M{from_x} {bottom}C{from_x} {below} {end_x} {below} {end_x} {bottom}"), middle_x, below - 6)
        }
        _ => {
            let is_left = x < to_x;
            let (side, to_side) = if is_left { (x, to_x) } else { (x + WIDTH, to_x + WIDTH) };
            let (start, end) = (y + 8 + shift / 3, to_y + 8 + shift / 3);
            let out = match is_left {
                true => side.min(to_side).saturating_sub(GAP + shift),
                false => side.max(to_side) + GAP + shift,
            };
            // A curve comes three quarters of the way to the points that it is drawn towards.
            let beside = (side + to_side + 6 * out) / 8;
            let middle = (start + end) / 2 + number % 3 * 12;
            (format!("M{side} {start}C{out} {start} {out} {end} {to_side} {end}"), beside, middle)
        }
    };
    Arrow { path, x, y, label: label.to_owned() }
}

fn sequence(procedure: &Procedure, device: &Device, manual: &Manual) -> Sequence {
    let mut facts = PLAIN.description(procedure.documentation.as_deref());
    if !procedure.arguments.is_empty() {
        let arguments: Vec<&str> = procedure.arguments.iter().map(|argument| argument.as_str()).collect();
        facts.push(format!("Given: {}.", arguments.join(", ")));
    }
    facts.extend(PLAIN.place(manual, "", procedure.documentation.as_deref(), &procedure.names));
    let doubts = entry::about(&device.doubts, SubjectKind::Procedure, &procedure.name, manual);
    let steps = procedure.steps.iter().map(|step| PLAIN.step(step)).collect();
    Sequence { name: procedure.name.to_string(), facts, doubts, steps }
}

#[cfg(test)]
mod tests {
    use super::ranks;

    #[test]
    fn states_come_below_those_that_lead_to_them() {
        let ways = |pairs: &[(usize, usize)]| -> Vec<_> {
            pairs.iter().map(|&(from, to)| (from, to, String::new())).collect()
        };
        assert_eq!(ranks(4, 0, &ways(&[(0, 1), (1, 2), (2, 0)])), [0, 1, 2, 3]);
        assert_eq!(
            ranks(5, 0, &ways(&[(1, 3), (2, 3), (3, 0), (4, 4)])),
            [0, 1, 1, 2, 1],
            "nothing leads to 1, 2 and 4"
        );
        assert_eq!(ranks(3, 0, &ways(&[(1, 2), (2, 1)])), [0, 1, 2], "a circle begins at its first state");
    }
}

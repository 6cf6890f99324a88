//! State machines: a diagram, lists of states, commands and transitions, and the effects of commands in each state.

use std::cmp::Ordering;
use std::collections::{HashMap, VecDeque};

use super::entry::{self, Doubt};
use super::words::{self, PLAIN};
use lexibus_codegen::facts::{pattern, types};
use lexibus_codegen::ir::{
    Device, ItemRef, Manual, Outcome, Pattern, Procedure, StateMachine, SubjectKind, Transition,
};

/// Width of a state's box in the diagram, in pixels.
const WIDTH: u32 = 170;
const HEIGHT: u32 = 36;
const GAP: u32 = 30;
const RISE: u32 = 70;

/// Margin on both sides of the diagram, for arrows to earlier states.
const SIDE: u32 = 90;

/// Maximum number of letters in a state's box.
const LETTERS: usize = 22;

/// Name of the source state of transitions from any state.
pub(super) const ANY_STATE: &str = "any state";

/// A state machine, as a page shows it.
#[derive(Debug)]
pub(super) struct Machine {
    pub title: String,
    pub facts: Vec<String>,
    pub doubts: Vec<Doubt>,
    pub diagram: Option<Diagram>,
    /// Name of the state after power-on.
    pub initial: Option<String>,
    pub states: Vec<Named>,
    pub commands: Vec<Named>,
    pub transitions: Vec<TransitionRow>,
    pub matrix: Option<Matrix>,
}

/// A state or a command in a list.
#[derive(Debug)]
pub(super) struct Named {
    pub name: String,
    pub names: Vec<(String, String)>,
    /// Bit pattern, such as `xxxx xxxx x01x 0111`; empty if a value represents the state.
    pub bits: String,
    pub facts: String,
}

/// A transition in the list of transitions.
#[derive(Debug)]
pub(super) struct TransitionRow {
    pub number: String,
    /// Name of the source state; `None` means any state.
    pub from: Option<String>,
    pub to: String,
    pub command: String,
    pub facts: String,
}

impl TransitionRow {
    /// Returns the name of the source state, or the name for any state.
    pub fn source(&self) -> &str {
        self.from.as_deref().unwrap_or(ANY_STATE)
    }
}

/// A table of the effects of each command in each state.
#[derive(Debug)]
pub(super) struct Matrix {
    pub states: Vec<String>,
    pub rows: Vec<(String, Vec<String>)>,
    pub notes: Vec<String>,
}

/// A diagram in which states are boxes and transitions are arrows.
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

/// A procedure with its steps.
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

/// Returns the state machines and procedures of a device, or `None` if it has neither.
pub(super) fn behaviour(device: &Device, manual: &Manual) -> Option<Behaviour> {
    let machines: Vec<_> = device.machines.iter().map(|each| machine(each, device, manual)).collect();
    let sequences: Vec<_> = device.procedures.iter().map(|procedure| sequence(procedure, device, manual)).collect();
    (!machines.is_empty() || !sequences.is_empty()).then_some(Behaviour { machines, sequences })
}

fn machine(machine: &StateMachine, device: &Device, manual: &Manual) -> Machine {
    let width = |item: &ItemRef, patterns: &[Pattern]| {
        let item = device.referred(item);
        pattern::width(item.and_then(|item| types::basic(&device.types, item.ty).bits()), patterns)
    };
    let of_status = width(&machine.status_item, &machine.states);
    let of_control = width(&machine.control_item, &machine.commands);
    let mut facts = PLAIN.description(machine.documentation.as_deref());
    facts.extend((!machine.status_item.is_empty()).then(|| format!("{} tells the state.", machine.status_item)));
    facts.extend((!machine.control_item.is_empty()).then(|| format!("{} takes the commands.", machine.control_item)));
    facts.extend(machine.initial.as_ref().map(|state| format!("After power-on: {state}.")));
    facts.extend(PLAIN.manual_entry(manual, "", machine.documentation.as_deref(), &[]));
    Machine {
        title: machine.name.to_string(),
        facts,
        doubts: entry::about(&device.doubts, SubjectKind::Machine, &machine.name, manual),
        diagram: diagram(machine),
        initial: machine.initial.as_ref().map(ToString::to_string),
        states: machine.states.iter().map(|state| named(state, of_status)).collect(),
        commands: machine.commands.iter().map(|command| named(command, of_control)).collect(),
        transitions: machine.transitions.iter().enumerate().map(|(at, each)| transition_row(at, each)).collect(),
        matrix: matrix(machine),
    }
}

fn named(pattern: &Pattern, width: u32) -> Named {
    let bits = if pattern.mask == 0 { String::new() } else { pattern::text(pattern.mask, pattern.value, width) };
    Named {
        name: pattern.name.to_string(),
        names: words::names(&pattern.names),
        bits,
        facts: PLAIN.description(pattern.documentation.as_deref()).join(" "),
    }
}

/// Returns the label of a transition in the list and diagram: its number, or its position if it has no number.
fn number(position: usize, transition: &Transition) -> String {
    transition.number.map_or_else(|| (position + 1).to_string(), |number| number.to_string())
}

fn transition_row(position: usize, transition: &Transition) -> TransitionRow {
    TransitionRow {
        number: number(position, transition),
        from: transition.from.as_ref().map(ToString::to_string),
        to: transition.to.to_string(),
        command: transition.command.as_ref().map_or_else(|| "by itself".to_owned(), ToString::to_string),
        facts: PLAIN.description(transition.documentation.as_deref()).join(" "),
    }
}

fn matrix(machine: &StateMachine) -> Option<Matrix> {
    let first = machine.outcomes.first()?;
    let states: Vec<String> = first.cells.iter().map(|cell| cell.state.to_string()).collect();
    let mut notes: Vec<String> = Vec::new();
    let mut note_numbers: HashMap<String, usize> = HashMap::new();
    let mut rows = Vec::new();
    for row in &machine.outcomes {
        let mut cells = Vec::new();
        for cell in &row.cells {
            let outcomes: Vec<String> = cell.outcomes.iter().map(outcome).collect();
            let text = PLAIN.description(cell.documentation.as_deref()).join(" ");
            let mark = if text.is_empty() {
                String::new()
            } else {
                let at = *note_numbers.entry(text).or_insert_with_key(|text| {
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

fn outcome(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Unchanged => "stays".to_owned(),
        Outcome::Refused => "–".to_owned(),
        Outcome::States(to) => format!("→ {}", to.join(" → ")),
    }
}

/// Returns the diagram of a state machine, or `None` if there is no transition between states.
fn diagram(machine: &StateMachine) -> Option<Diagram> {
    let position = |name: &str| machine.states.iter().position(|state| state.name == name);
    // An additional box represents any state. The position of this box follows the positions of the states.
    let any = machine.states.len();
    let from = |transition: &Transition| transition.from.as_ref().map_or(Some(any), |name| position(name));
    // One arrow represents all transitions between the same two states.
    let mut edges: Vec<(usize, usize, String)> = Vec::new();
    for (at, transition) in machine.transitions.iter().enumerate() {
        let (Some(from), Some(to)) = (from(transition), position(&transition.to)) else { continue };
        let number = number(at, transition);
        match edges.iter_mut().find(|known| (known.0, known.1) == (from, to)) {
            Some((.., label)) if label.split(", ").any(|known| known == number) => {}
            Some((.., label)) => *label += &format!(", {number}"),
            None => edges.push((from, to, number)),
        }
    }
    if edges.is_empty() {
        return None;
    }
    let first = machine.initial.as_ref().and_then(|name| position(name)).unwrap_or(edges.first()?.0);
    let mut ranks = ranks(any + 1, first, &edges);
    // Place the box for any state one row above the first state that it leads to.
    if let Some(to) = edges.iter().filter(|(from, ..)| *from == any).map(|(_, to, _)| ranks[*to]).min() {
        ranks[any] = to.saturating_sub(1);
    }
    let used = |at: usize| edges.iter().any(|(from, to, _)| *from == at || *to == at);
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
        let width_of_row = row.len() as u32 * (WIDTH + GAP);
        let start = SIDE + (width.saturating_sub(2 * SIDE).saturating_sub(width_of_row)) / 2;
        for (column, at) in row.iter().enumerate() {
            boxes[*at] = Some((start + column as u32 * (WIDTH + GAP), 8 + rank as u32 * (HEIGHT + RISE)));
        }
    }
    let arrows = edges
        .iter()
        .enumerate()
        .filter_map(|(number, (from, to, label))| Some(arrow(boxes[*from]?, boxes[*to]?, number as u32, label)));
    let arrows = arrows.collect();
    let state_box = |(at, corner): (usize, &Option<(u32, u32)>)| {
        let (left, top) = (*corner)?;
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

/// Returns the rank of each state: the number of transitions from the first state. Unreachable states have higher ranks, starting
/// with states that no transition leads to.
fn ranks(count: usize, first: usize, edges: &[(usize, usize, String)]) -> Vec<usize> {
    let mut ranks = vec![None; count];
    let mut last = follow(first, 0, edges, &mut ranks);
    let leads_to = |at: usize| edges.iter().any(|(from, to, _)| *to == at && *from != at);
    let starts: Vec<usize> = (0..count).filter(|at| ranks[*at].is_none() && !leads_to(*at)).collect();
    let rank = last + 1;
    for at in starts {
        last = last.max(follow(at, rank, edges, &mut ranks));
    }
    // The remaining states can only be reached from each other.
    for at in 0..count {
        if ranks[at].is_none() {
            last = follow(at, last + 1, edges, &mut ranks);
        }
    }
    ranks.into_iter().flatten().collect()
}

/// Sets the ranks of a state and of the states that it leads to. Returns the highest rank.
fn follow(at: usize, rank: usize, edges: &[(usize, usize, String)], ranks: &mut [Option<usize>]) -> usize {
    let mut queue = VecDeque::from([(at, rank)]);
    ranks[at] = Some(rank);
    let mut last = rank;
    while let Some((at, rank)) = queue.pop_front() {
        last = rank;
        for (_, to, _) in edges.iter().filter(|(from, ..)| *from == at) {
            if ranks[*to].is_none() {
                ranks[*to] = Some(rank + 1);
                queue.push_back((*to, rank + 1));
            }
        }
    }
    last
}

/// Returns a curve between two states and its label. A downward arrow starts at the bottom of its state. An upward
/// arrow starts at the side that is closer to its target. An arrow within a row runs below the row.
fn arrow(from: (u32, u32), to: (u32, u32), number: u32, label: &str) -> Arrow {
    let ((x, y), (to_x, to_y)) = (from, to);
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
            // A Bézier curve reaches three quarters of the distance to its control points.
            let curve_x = (side + to_side + 6 * out) / 8;
            let middle = (start + end) / 2 + number % 3 * 12;
            (format!("M{side} {start}C{out} {start} {out} {end} {to_side} {end}"), curve_x, middle)
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
    facts.extend(PLAIN.manual_entry(manual, "", procedure.documentation.as_deref(), &procedure.names));
    let doubts = entry::about(&device.doubts, SubjectKind::Procedure, &procedure.name, manual);
    let steps = procedure.steps.iter().map(|step| PLAIN.step(step)).collect();
    Sequence { name: procedure.name.to_string(), facts, doubts, steps }
}

#[cfg(test)]
mod tests {
    use super::ranks;

    #[test]
    fn states_are_below_their_predecessors() {
        let edges = |pairs: &[(usize, usize)]| -> Vec<_> {
            pairs.iter().map(|&(from, to)| (from, to, String::new())).collect()
        };
        assert_eq!(ranks(4, 0, &edges(&[(0, 1), (1, 2), (2, 0)])), [0, 1, 2, 3]);
        assert_eq!(
            ranks(5, 0, &edges(&[(1, 3), (2, 3), (3, 0), (4, 4)])),
            [0, 1, 1, 2, 1],
            "no transition leads to 1, 2 and 4"
        );
        assert_eq!(ranks(3, 0, &edges(&[(1, 2), (2, 1)])), [0, 1, 2], "a cycle begins at its first state");
    }
}

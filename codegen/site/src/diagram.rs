//! Draws state machines. The states are in one column, and arrows between neighbors are straight. Each other arrow has
//! a lane next to the column. At any height, a lane contains only one arrow. The lane is on the left if the arrow leads
//! down, and on the right if it leads up or back to the same state. So no two arrows overlap. The label of an arrow is
//! on the outer side of its lane. If there is space, no arrow of an outer lane crosses the label.

mod lanes;

use std::collections::VecDeque;

use super::words::readable;
use lanes::{Lanes, Ports};
use lexibus_codegen::ir::{StateMachine, StateRef, Transition};

/// Minimum width of a state's box in pixels.
const WIDTH: u32 = 220;

/// Height of a line of text in a box in pixels, and free space above and below the lines.
const LINE: u32 = 17;
const PADDING: u32 = 10;

/// Minimum distance from one box to the next, and the step by which it grows until the labels on lanes have space.
const GAP: u32 = 48;
const GAP_STEP: u32 = 12;

/// Maximum distance from one box to the next.
const MOST_GAP: u32 = 240;

/// Distance between two lanes, and minimum distance between the column and the first lane.
const LANE: u32 = 30;

/// Width of a letter in pixels.
const LETTER: u32 = 7;

/// Horizontal distance of a straight arrow from the middle of the column.
const ASIDE: u32 = 30;

/// Free space next to the label of a straight arrow in pixels.
const LABEL_GAP: u32 = 16;

/// Name of the source state of transitions from any state.
pub(super) const ANY_STATE: &str = "any state";

/// A diagram in which states are boxes and transitions are arrows.
#[derive(Debug)]
pub(super) struct Diagram {
    pub width: u32,
    pub height: u32,
    /// Size of each box.
    pub box_width: u32,
    pub box_height: u32,
    pub boxes: Vec<StateBox>,
    pub arrows: Vec<Arrow>,
}

/// The box of a state.
#[derive(Debug)]
pub(super) struct StateBox {
    pub left: u32,
    pub top: u32,
    pub name: String,
    /// Pattern of the status bits in this state; empty if the state has no bit pattern.
    pub pattern: String,
    pub is_initial: bool,
}

/// An arrow for all transitions with the same source state and the same target state.
#[derive(Debug)]
pub(super) struct Arrow {
    pub path: String,
    /// Position of the label.
    pub x: u32,
    pub y: u32,
    /// CSS class of the label: `start` or `end` for the text next to a straight arrow, `lane` for the text along a lane.
    pub side: &'static str,
    /// Numbers of the transitions and names of their commands.
    pub label: String,
}

/// All transitions from one state to another. `from` and `to` are the positions of the states.
#[derive(Debug)]
struct Edge {
    from: usize,
    to: usize,
    numbers: Vec<String>,
    commands: Vec<String>,
}

/// The states and edges of a diagram, and the sizes that do not depend on the distance between the boxes.
struct Plan<'m> {
    machine: &'m StateMachine,
    /// Bits of each state.
    patterns: &'m [String],
    edges: Vec<Edge>,
    /// Row of each state, and of the pseudo-state "any state" after the last state.
    rows: Vec<Option<usize>>,
    first: usize,
    box_width: u32,
    box_height: u32,
}

/// Returns the diagram of a state machine, or `None` if there is no transition between states. `patterns` contains the bit pattern
/// of each state.
pub(super) fn diagram(machine: &StateMachine, patterns: &[String]) -> Option<Diagram> {
    let plan = Plan::new(machine, patterns)?;
    let gaps = (GAP..MOST_GAP).step_by(GAP_STEP as usize);
    let labeled = gaps.map(|gap| plan.drawn(gap)).find(|(_, is_complete)| *is_complete);
    Some(labeled.unwrap_or_else(|| plan.drawn(MOST_GAP)).0)
}

impl<'m> Plan<'m> {
    fn new(machine: &'m StateMachine, patterns: &'m [String]) -> Option<Self> {
        let edges = edges(machine);
        let any = machine.states.len();
        let initial = machine.initial.as_ref().and_then(position);
        let first = initial.unwrap_or(edges.first()?.from);
        let rows = rows(any, first, &edges);
        let is_drawn = |at: usize| rows.get(at).is_some_and(Option::is_some);
        let names = machine.states.iter().map(|state| readable(&state.name));
        let texts = names.enumerate().chain(patterns.iter().cloned().enumerate()).filter(|(at, _)| is_drawn(*at));
        let longest = texts.map(|(_, text)| text.chars().count() as u32).max().unwrap_or_default();
        let has_patterns = (0..).zip(patterns).any(|(at, pattern)| is_drawn(at) && !pattern.is_empty());
        let box_height = 2 * PADDING + if has_patterns { 2 } else { 1 } * LINE;
        Some(Plan { machine, patterns, edges, rows, first, box_width: WIDTH.max((longest + 2) * LETTER), box_height })
    }

    /// Returns the diagram with this distance between the boxes, and whether all labels have space.
    fn drawn(&self, gap: u32) -> (Diagram, bool) {
        let (edges, rows, pitch) = (&self.edges, &self.rows, gap + self.box_height);
        let top = |row: usize| 8 + row as u32 * pitch;
        let lanes = [Edge::leads_down, Edge::leads_up].map(|on_side| Lanes::new(edges, rows, pitch, on_side));
        let gaps = [Edge::is_below, Edge::is_above].map(|is_beside| self.gap(is_beside));
        let [left, right] = [0, 1].map(|side| gaps[side] + LANE * lanes[side].count());
        let boxes = self.boxes(left, top);
        let longest = lanes.iter().map(|lanes| lanes.longest_label(edges)).max().unwrap_or_default();
        let height = (top(boxes.len()) - gap + 8).max(longest);
        let ports = Ports::new(edges, rows, &lanes, self.box_height);
        let ends = |at: usize| {
            let edge: &Edge = &edges[at];
            let row = |state: usize| top(rows[state].unwrap_or_default());
            [row(edge.from) + ports.offset(at, 0), row(edge.to) + ports.offset(at, 1)]
        };
        let mut is_complete = true;
        let mut arrow = |(at, edge): (usize, &Edge)| {
            let (from, to) = (rows[edge.from]?, rows[edge.to]?);
            let Some(side) = lanes.iter().position(|lanes| lanes.number(at).is_some()) else {
                return Some(edge.straight(left + self.box_width / 2, [top(from), top(to)], self.box_height));
            };
            let distance = gaps[side] + LANE * lanes[side].number(at)?;
            let (y, has_space) = lanes[side].label(at, edge.label_length(), ends, top, height);
            is_complete &= has_space;
            Some(match side {
                0 => edge.on_lane([left - distance, left], ends(at), (left - distance - 7, y)),
                _ => {
                    let edge_x = left + self.box_width;
                    edge.on_lane([edge_x + distance, edge_x], ends(at), (edge_x + distance + 16, y))
                }
            })
        };
        let arrows = edges.iter().enumerate().filter_map(&mut arrow).collect();
        let (box_width, box_height) = (self.box_width, self.box_height);
        (Diagram { width: left + box_width + right, height, box_width, box_height, boxes, arrows }, is_complete)
    }

    fn boxes(&self, left: u32, top: impl Fn(usize) -> u32) -> Vec<StateBox> {
        let state = |at: usize| self.machine.states.get(at);
        let one = |(at, row): (usize, &Option<usize>)| {
            Some(StateBox {
                left,
                top: top((*row)?),
                name: state(at).map_or_else(|| ANY_STATE.to_owned(), |state| readable(&state.name)),
                pattern: self.patterns.get(at).cloned().unwrap_or_default(),
                is_initial: at == self.first && state(at).is_some(),
            })
        };
        self.rows.iter().enumerate().filter_map(one).collect()
    }

    /// Returns the distance between the column and the first lane of a side. If the label of a straight arrow extends
    /// beyond the column, the distance leaves space for the label.
    fn gap(&self, is_beside: impl Fn(&Edge, &[Option<usize>]) -> bool) -> u32 {
        let labels = self.edges.iter().filter(|edge| is_beside(edge, &self.rows)).map(Edge::label_length);
        let inside = self.box_width / 2 - ASIDE;
        labels.max().map_or(LANE, |length| LANE.max((length + LABEL_GAP).saturating_sub(inside)))
    }
}

impl StateBox {
    /// Returns the vertical position of the name in a box of this height.
    pub fn name_y(&self, height: &u32) -> u32 {
        height / 2 + 5 - if self.pattern.is_empty() { 0 } else { LINE / 2 }
    }

    /// Returns the vertical position of the bit pattern in a box of this height.
    pub fn pattern_y(&self, height: &u32) -> u32 {
        self.name_y(height) + LINE
    }
}

/// Returns the label of a transition in the list and diagram: its number, or its position if it has no number.
pub(super) fn number(position: usize, transition: &Transition) -> String {
    transition.number.map_or_else(|| (position + 1).to_string(), |number| number.to_string())
}

fn position(state: &StateRef) -> Option<usize> {
    Some(state.id?.0 as usize)
}

/// Returns the edges between states. The pseudo-state "any state" has the position after the last state.
fn edges(machine: &StateMachine) -> Vec<Edge> {
    let from = |transition: &Transition| match &transition.from {
        Some(state) => position(state),
        None => Some(machine.states.len()),
    };
    let mut edges: Vec<Edge> = Vec::new();
    for (at, transition) in machine.transitions.iter().enumerate() {
        let (Some(from), Some(to)) = (from(transition), position(&transition.to)) else { continue };
        let known = edges.iter().position(|edge| (edge.from, edge.to) == (from, to));
        let edge = known.unwrap_or_else(|| {
            edges.push(Edge { from, to, numbers: Vec::new(), commands: Vec::new() });
            edges.len() - 1
        });
        let number = number(at, transition);
        if !edges[edge].numbers.contains(&number) {
            edges[edge].numbers.push(number);
        }
        let command = transition.command.iter().map(|command| readable(command));
        let command = command.filter(|command| !edges[edge].commands.contains(command)).collect::<Vec<_>>();
        edges[edge].commands.extend(command);
    }
    edges
}

impl Edge {
    /// Returns the rows of the two states if the edge needs a lane because the states are not neighbors.
    fn on_rows(&self, rows: &[Option<usize>]) -> Option<(usize, usize)> {
        let (from, to) = (rows[self.from]?, rows[self.to]?);
        (from.abs_diff(to) != 1).then_some((from, to))
    }

    /// Returns whether the edge is a straight arrow down, whose label is on the left.
    fn is_below(&self, rows: &[Option<usize>]) -> bool {
        self.on_rows(rows).is_none() && rows[self.from] < rows[self.to]
    }

    /// Returns whether the edge is a straight arrow up, whose label is on the right.
    fn is_above(&self, rows: &[Option<usize>]) -> bool {
        self.on_rows(rows).is_none() && rows[self.from] > rows[self.to]
    }

    fn leads_down(&self, rows: &[Option<usize>]) -> Option<(usize, usize)> {
        self.on_rows(rows).filter(|(from, to)| from < to)
    }

    fn leads_up(&self, rows: &[Option<usize>]) -> Option<(usize, usize)> {
        self.on_rows(rows).filter(|(from, to)| from >= to)
    }

    /// Returns the arrow on a lane at `x`. The arrow starts and ends at the horizontal position `edge_x`. `label` is
    /// the position of its label.
    fn on_lane(&self, [x, edge_x]: [u32; 2], [start, end]: [u32; 2], label: (u32, u32)) -> Arrow {
        let path = format!("M{edge_x} {start}H{x}V{end}H{edge_x}");
        Arrow { path, x: label.0, y: label.1, side: "lane", label: self.label() }
    }

    /// Returns the numbers of the transitions and the names of their commands.
    fn label(&self) -> String {
        [self.numbers.join(", "), self.commands.join(", ")].join(" ").trim().to_owned()
    }

    /// Returns the approximate length of the label in pixels.
    fn label_length(&self) -> u32 {
        self.label().chars().count() as u32 * LETTER
    }

    fn straight(&self, middle: u32, [from, to]: [u32; 2], height: u32) -> Arrow {
        let label = self.label();
        let (x, start, end, side) = match from < to {
            true => (middle - ASIDE, from + height, to, "end"),
            false => (middle + ASIDE, from, to + height, "start"),
        };
        let text = if side == "end" { x - 6 } else { x + 6 };
        Arrow { path: format!("M{x} {start}V{end}"), x: text, y: u32::midpoint(start, end) + 4, side, label }
    }
}

/// Returns the row of each state that has an arrow. States are sorted by their ranks.
fn rows(any: usize, first: usize, edges: &[Edge]) -> Vec<Option<usize>> {
    let pairs: Vec<(usize, usize)> = edges.iter().map(|edge| (edge.from, edge.to)).collect();
    let ranks = ranks(any + 1, first, &pairs);
    let mut order: Vec<usize> = (0..=any).filter(|at| pairs.iter().any(|(from, to)| from == at || to == at)).collect();
    // The pseudo-state "any state" is directly above the first state that it leads to.
    let target = pairs.iter().filter(|(from, _)| *from == any).map(|(_, to)| (ranks[*to], *to)).min();
    let key = |at: &usize| match target {
        Some((rank, to)) if *at == any => (rank, to, 0),
        _ => (ranks[*at], *at, 1),
    };
    order.sort_by_key(key);
    let mut rows = vec![None; any + 1];
    order.into_iter().enumerate().for_each(|(row, at)| rows[at] = Some(row));
    rows
}

/// Returns the rank of each state: the minimum number of transitions from the first state. Unreachable states have
/// higher ranks, starting with states that no transition leads to.
fn ranks(count: usize, first: usize, edges: &[(usize, usize)]) -> Vec<usize> {
    let mut ranks = vec![None; count];
    let mut last = follow(first, 0, edges, &mut ranks);
    let leads_to = |at: usize| edges.iter().any(|(from, to)| *to == at && *from != at);
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
fn follow(at: usize, rank: usize, edges: &[(usize, usize)], ranks: &mut [Option<usize>]) -> usize {
    let mut queue = VecDeque::from([(at, rank)]);
    ranks[at] = Some(rank);
    let mut last = rank;
    while let Some((at, rank)) = queue.pop_front() {
        last = rank;
        for (_, to) in edges.iter().filter(|(from, _)| *from == at) {
            if ranks[*to].is_none() {
                ranks[*to] = Some(rank + 1);
                queue.push_back((*to, rank + 1));
            }
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_are_below_their_predecessors() {
        assert_eq!(ranks(4, 0, &[(0, 1), (1, 2), (2, 0)]), [0, 1, 2, 3]);
        assert_eq!(
            ranks(5, 0, &[(1, 3), (2, 3), (3, 0), (4, 4)]),
            [0, 1, 1, 2, 1],
            "no transition leads to 1, 2 and 4"
        );
        assert_eq!(ranks(3, 0, &[(1, 2), (2, 1)]), [0, 1, 2], "a cycle begins at its first state");
    }
}

//! Draws state machines. The states are in one column, and arrows between neighbors are straight. Each other arrow has a separate lane
//! next to the column. The lane is on the left if the arrow leads down, and on the right if it leads up. So no two arrows overlap.

use std::collections::VecDeque;

use super::words::readable;
use lexibus_codegen::ir::{StateMachine, Transition};

/// Width and height of a state's box in pixels, and distance from one box to the next.
pub(super) const WIDTH: u32 = 220;
pub(super) const HEIGHT: u32 = 36;
const PITCH: u32 = 84;

/// Distance between two lanes, and between the column and the first lane.
const LANE: u32 = 38;

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
    pub boxes: Vec<StateBox>,
    pub arrows: Vec<Arrow>,
}

/// The box of a state.
#[derive(Debug)]
pub(super) struct StateBox {
    pub left: u32,
    pub top: u32,
    pub name: String,
    pub is_initial: bool,
}

/// An arrow for all transitions between the same two states.
#[derive(Debug)]
pub(super) struct Arrow {
    pub path: String,
    /// Position of the label.
    pub x: u32,
    pub y: u32,
    /// CSS class of the label: `start` or `end` for the text next to a straight arrow, `lane` for the text along a lane, on its left.
    pub side: &'static str,
    /// Numbers of the transitions and names of their commands.
    pub label: String,
}

/// The transitions between the same two states, by the positions of the states.
#[derive(Debug)]
struct Edge {
    from: usize,
    to: usize,
    numbers: Vec<String>,
    commands: Vec<String>,
}

/// Returns the diagram of a state machine, or `None` if there is no transition between states.
pub(super) fn diagram(machine: &StateMachine) -> Option<Diagram> {
    let edges = edges(machine);
    let any = machine.states.len();
    let initial = machine.initial.as_ref().and_then(|name| position(machine, name));
    let first = initial.unwrap_or(edges.first()?.from);
    let rows = rows(any, first, &edges);
    let lanes = [lanes(&edges, &rows, Edge::leads_down), lanes(&edges, &rows, Edge::leads_up)];
    let gaps = [Edge::is_below, Edge::is_above].map(|is_beside| gap(&edges, &rows, is_beside));
    let count = |side: usize| lanes[side].iter().flatten().max().map_or(0, |lane| lane + 1);
    let [left, right] = [0, 1].map(|side| gaps[side] + LANE * count(side));
    let name = |at: usize| machine.states.get(at).map_or_else(|| ANY_STATE.to_owned(), |state| readable(&state.name));
    let top = |row: usize| 8 + row as u32 * PITCH;
    let boxes = rows.iter().enumerate().filter_map(|(at, row)| {
        Some(StateBox { left, top: top((*row)?), name: name(at), is_initial: at == first && at < any })
    });
    let boxes: Vec<StateBox> = boxes.collect();
    let height = top(boxes.len()) - PITCH + HEIGHT + 8;
    let ports = Ports::new(&edges, &rows, &lanes);
    let arrow = |(at, edge): (usize, &Edge)| {
        let (from, to) = (rows[edge.from]?, rows[edge.to]?);
        let lane = lanes[0][at].map(|lane| (left - gaps[0] - LANE * lane, left));
        let lane = lane.or_else(|| lanes[1][at].map(|lane| (left + WIDTH + gaps[1] + LANE * lane, left + WIDTH)));
        Some(match lane {
            Some((x, edge_x)) => {
                let [start, end] = [(from, 0), (to, 1)].map(|(row, end)| top(row) + ports.offset(at, end));
                edge.on_lane(x, edge_x, [start, end], height)
            }
            None => edge.straight(left + WIDTH / 2, top(from), top(to)),
        })
    };
    let arrows = edges.iter().enumerate().filter_map(arrow).collect();
    Some(Diagram { width: left + WIDTH + right, height, boxes, arrows })
}

/// Returns the label of a transition in the list and diagram: its number, or its position if it has no number.
pub(super) fn number(position: usize, transition: &Transition) -> String {
    transition.number.map_or_else(|| (position + 1).to_string(), |number| number.to_string())
}

fn position(machine: &StateMachine, name: &str) -> Option<usize> {
    machine.states.iter().position(|state| state.name == name)
}

/// Returns the edges between states. The pseudo-state "any state" has the position after the last state.
fn edges(machine: &StateMachine) -> Vec<Edge> {
    let from = |transition: &Transition| match &transition.from {
        Some(name) => position(machine, name),
        None => Some(machine.states.len()),
    };
    let mut edges: Vec<Edge> = Vec::new();
    for (at, transition) in machine.transitions.iter().enumerate() {
        let (Some(from), Some(to)) = (from(transition), position(machine, &transition.to)) else { continue };
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
    /// Returns the rows of the two states if the edge needs a lane: if they are not neighbors.
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

    /// Returns the arrow on a lane. Its label is turned and stays within the height of the diagram.
    fn on_lane(&self, x: u32, edge_x: u32, [start, end]: [u32; 2], height: u32) -> Arrow {
        let path = format!("M{edge_x} {start}H{x}V{end}H{edge_x}");
        let half = self.label_length() / 2;
        let y = u32::midpoint(start, end).min(height.saturating_sub(half)).max(half);
        Arrow { path, x: x - 5, y, side: "lane", label: self.label() }
    }

    /// Returns the numbers of the transitions and the names of their commands.
    fn label(&self) -> String {
        [self.numbers.join(", "), self.commands.join(", ")].join(" ").trim().to_owned()
    }

    /// Returns the approximate length of the label in pixels.
    fn label_length(&self) -> u32 {
        self.label().chars().count() as u32 * LETTER
    }

    fn straight(&self, middle: u32, from: u32, to: u32) -> Arrow {
        let label = self.label();
        let (x, start, end, side) = match from < to {
            true => (middle - ASIDE, from + HEIGHT, to, "end"),
            false => (middle + ASIDE, from, to + HEIGHT, "start"),
        };
        let text = if side == "end" { x - 6 } else { x + 6 };
        Arrow { path: format!("M{x} {start}V{end}"), x: text, y: u32::midpoint(start, end) + 4, side, label }
    }
}

/// Returns the distance between the column and the first lane of a side. Labels of straight arrows can be wider than half of the
/// column.
fn gap(edges: &[Edge], rows: &[Option<usize>], is_beside: impl Fn(&Edge, &[Option<usize>]) -> bool) -> u32 {
    let labels = edges.iter().filter(|edge| is_beside(edge, rows)).map(Edge::label_length);
    labels.max().map_or(LANE, |length| LANE.max((length + LABEL_GAP).saturating_sub(WIDTH / 2 - ASIDE)))
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

/// Returns the lane of each edge that needs one on this side. The first lane is next to the column. Shorter edges have nearer lanes.
/// A label that is longer than its edge also takes the rows next to the edge.
fn lanes(
    edges: &[Edge],
    rows: &[Option<usize>],
    on_side: impl Fn(&Edge, &[Option<usize>]) -> Option<(usize, usize)>,
) -> Vec<Option<u32>> {
    let mut needed: Vec<(usize, usize, usize)> = Vec::new();
    for (at, edge) in edges.iter().enumerate() {
        needed.extend(on_side(edge, rows).map(|(from, to)| {
            let (top, bottom) = (from.min(to), from.max(to));
            let beyond = edge.label_length().div_ceil(PITCH).saturating_sub((bottom - top) as u32).div_ceil(2) as usize;
            (top.saturating_sub(beyond), bottom + beyond, at)
        }));
    }
    needed.sort_by_key(|(top, bottom, at)| (bottom - top, *at));
    let mut lanes = vec![None; edges.len()];
    let mut taken: Vec<Vec<(usize, usize)>> = Vec::new();
    for (top, bottom, at) in needed {
        let is_free = |lane: &Vec<(usize, usize)>| lane.iter().all(|(other, end)| *end < top || bottom < *other);
        let lane = taken.iter().position(is_free).unwrap_or_else(|| {
            taken.push(Vec::new());
            taken.len() - 1
        });
        taken[lane].push((top, bottom));
        lanes[at] = u32::try_from(lane).ok();
    }
    lanes
}

/// The points at which arrows on lanes meet the boxes.
struct Ports {
    /// Vertical distance from the top of the box, for both ends of each edge.
    offsets: Vec<[u32; 2]>,
}

impl Ports {
    fn new(edges: &[Edge], rows: &[Option<usize>], lanes: &[Vec<Option<u32>>; 2]) -> Self {
        let mut offsets = vec![[0; 2]; edges.len()];
        for lanes in lanes {
            for state in 0..rows.len() {
                // Lanes that lead up are above those that lead down. Of the lanes that lead up, the nearest is the
                // highest. Of the lanes that lead down, the nearest is the lowest. Arrows therefore do not cross near
                // the box.
                let mut ports: Vec<(bool, i64, usize, usize)> = Vec::new();
                for (at, edge) in edges.iter().enumerate() {
                    let Some(lane) = lanes[at].map(i64::from) else { continue };
                    for (end, (own, other)) in [(edge.from, edge.to), (edge.to, edge.from)].into_iter().enumerate() {
                        if own == state {
                            let leads_down = rows[other] > rows[own] || own == other && end == 1;
                            ports.push((leads_down, if leads_down { -lane } else { lane }, at, end));
                        }
                    }
                }
                ports.sort_unstable();
                let count = ports.len() as u32;
                for (place, (_, _, at, end)) in (1..).zip(ports) {
                    offsets[at][end] = place * HEIGHT / (count + 1);
                }
            }
        }
        Ports { offsets }
    }

    fn offset(&self, edge: usize, end: usize) -> u32 {
        self.offsets[edge][end]
    }
}

/// Returns the rank of each state: the number of transitions from the first state. Unreachable states have higher ranks, starting
/// with states that no transition leads to.
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

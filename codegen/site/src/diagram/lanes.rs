//! Lanes: the vertical lines of arrows next to the column of states. This module determines the lane of each arrow, the
//! points at which the arrow meets the boxes, and the position of the label.

use super::Edge;

/// Minimum vertical distance in pixels between the label of a lane and an arrow that crosses the lane.
const CLEAR: u32 = 4;

/// The lanes on one side of the column.
pub(super) struct Lanes {
    of_edges: Vec<Option<Lane>>,
}

/// The lane of an edge.
#[derive(Clone, Copy)]
struct Lane {
    /// Position of the lane. The first lane is next to the column.
    number: u32,
    /// First and last row that the edge occupies in the lane. No other edge has the same lane in these rows.
    rows: (usize, usize),
}

impl Lanes {
    /// Assigns a lane to each edge on this side. Shorter edges get lanes nearer to the column. If a label is longer
    /// than its edge, the edge also occupies rows above and below. `pitch` is the distance between two rows in pixels.
    pub fn new(
        edges: &[Edge],
        rows: &[Option<usize>],
        pitch: u32,
        on_side: impl Fn(&Edge, &[Option<usize>]) -> Option<(usize, usize)>,
    ) -> Self {
        let mut needed: Vec<(usize, usize, usize)> = Vec::new();
        for (at, edge) in edges.iter().enumerate() {
            needed.extend(on_side(edge, rows).map(|(from, to)| {
                let (top, bottom) = (from.min(to), from.max(to));
                let length = edge.label_length().div_ceil(pitch);
                let beyond = length.saturating_sub((bottom - top) as u32).div_ceil(2) as usize;
                (top.saturating_sub(beyond), bottom + beyond, at)
            }));
        }
        needed.sort_by_key(|(top, bottom, at)| (bottom - top, *at));
        let mut of_edges = vec![None; edges.len()];
        let mut lanes: Vec<Vec<(usize, usize)>> = Vec::new();
        for (top, bottom, at) in needed {
            let is_free = |lane: &Vec<(usize, usize)>| lane.iter().all(|(other, end)| *end < top || bottom < *other);
            let lane = lanes.iter().position(is_free).unwrap_or_else(|| {
                lanes.push(Vec::new());
                lanes.len() - 1
            });
            lanes[lane].push((top, bottom));
            of_edges[at] = Some(Lane { number: lane as u32, rows: (top, bottom) });
        }
        Lanes { of_edges }
    }

    /// Returns the number of lanes.
    pub fn count(&self) -> u32 {
        self.of_edges.iter().flatten().map(|lane| lane.number + 1).max().unwrap_or_default()
    }

    /// Returns the number of an edge's lane, or `None` if the edge has no lane on this side.
    pub fn number(&self, edge: usize) -> Option<u32> {
        self.of_edges[edge].map(|lane| lane.number)
    }

    /// Returns the length of the longest label on a lane in pixels.
    pub fn longest_label(&self, edges: &[Edge]) -> u32 {
        let used = self.of_edges.iter().zip(edges).filter(|(lane, _)| lane.is_some());
        used.map(|(_, edge)| edge.label_length()).max().unwrap_or_default()
    }

    /// Returns the vertical position of the middle of an edge's label, and true if no arrow crosses the label there.
    /// The label is `length` pixels long. Only arrows on lanes further out can cross the label. `ends` returns the
    /// vertical positions of the two ends of an edge. `top` returns the vertical position of the top of a row.
    pub fn label(
        &self,
        edge: usize,
        length: u32,
        ends: impl Fn(usize) -> [u32; 2],
        top: impl Fn(usize) -> u32,
        height: u32,
    ) -> (u32, bool) {
        let [start, end] = ends(edge);
        let (middle, half) = (u32::midpoint(start, end), length.div_ceil(2));
        let Some(lane) = self.of_edges[edge] else { return (middle, false) };
        let (low, high) = (top(lane.rows.0).min(height), top(lane.rows.1 + 1).min(height));
        let outer =
            self.of_edges.iter().enumerate().filter(|(_, other)| other.is_some_and(|other| other.number > lane.number));
        let mut crossings: Vec<u32> = outer.flat_map(|(at, _)| ends(at)).filter(|y| (low..=high).contains(y)).collect();
        crossings.sort_unstable();
        let edges = [low.saturating_sub(CLEAR), high + CLEAR];
        let starts = edges[..1].iter().chain(&crossings);
        let spaces = starts.zip(crossings.iter().chain(&edges[1..]));
        let middles = spaces.filter_map(|(above, below)| {
            let (first, last) = (above + CLEAR + half, below.checked_sub(CLEAR + half)?);
            (first <= last).then(|| middle.clamp(first, last))
        });
        match middles.min_by_key(|y| y.abs_diff(middle)) {
            Some(y) => (y, true),
            None => (middle.min(height.saturating_sub(half)).max(half), false),
        }
    }
}

/// The points at which arrows on lanes meet the boxes.
pub(super) struct Ports {
    /// Vertical distance from the top of the box, for both ends of each edge.
    offsets: Vec<[u32; 2]>,
}

impl Ports {
    pub fn new(edges: &[Edge], rows: &[Option<usize>], lanes: &[Lanes; 2], box_height: u32) -> Self {
        let mut offsets = vec![[0; 2]; edges.len()];
        for lanes in lanes {
            for state in 0..rows.len() {
                // Lanes that lead up are above those that lead down. Of the lanes that lead up, the nearest is the
                // highest. Of the lanes that lead down, the nearest is the lowest. Arrows therefore do not cross near
                // the box.
                let mut ports: Vec<(bool, i64, usize, usize)> = Vec::new();
                for (at, edge) in edges.iter().enumerate() {
                    let Some(lane) = lanes.number(at).map(i64::from) else { continue };
                    for (end, (this, other)) in [(edge.from, edge.to), (edge.to, edge.from)].into_iter().enumerate() {
                        if this == state {
                            let leads_down = rows[other] > rows[this] || this == other && end == 1;
                            ports.push((leads_down, if leads_down { -lane } else { lane }, at, end));
                        }
                    }
                }
                ports.sort_unstable();
                let count = ports.len() as u32;
                for (place, (_, _, at, end)) in (1..).zip(ports) {
                    offsets[at][end] = place * box_height / (count + 1);
                }
            }
        }
        Ports { offsets }
    }

    pub fn offset(&self, edge: usize, end: usize) -> u32 {
        self.offsets[edge][end]
    }
}

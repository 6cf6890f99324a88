//! Order in which the data types of a file are converted.

use crate::limits;

/// Order of data types: each type comes after the types that it refers to. Types for which no such order exists come last.
#[derive(Default)]
pub struct Order {
    /// Positions of the data types.
    pub sequence: Vec<usize>,
    /// For each data type, whether it contains itself, is nested too deeply, or refers to such a type.
    endless: Vec<bool>,
}

impl Order {
    /// Orders `count` data types. `parts` returns the positions of the data types to which the type at a position refers.
    pub fn new<P: Iterator<Item = usize>>(count: usize, parts: impl Fn(usize) -> P) -> Self {
        let (mut waiting, mut depth) = (vec![0usize; count], vec![0usize; count]);
        let mut users: Vec<Vec<u32>> = vec![Vec::new(); count];
        for (at, open) in waiting.iter_mut().enumerate() {
            for part in parts(at) {
                *open += 1;
                users[part].push(at as u32);
            }
        }
        let mut sequence: Vec<usize> = (0..count).filter(|&at| waiting[at] == 0).collect();
        let mut next = 0;
        while let Some(&at) = sequence.get(next) {
            next += 1;
            for user in users[at].iter().map(|&user| user as usize) {
                depth[user] = depth[user].max(depth[at] + 1);
                waiting[user] -= 1;
                if waiting[user] == 0 {
                    sequence.push(user);
                }
            }
        }
        let endless = (0..count).map(|at| waiting[at] > 0 || depth[at] > limits::MAX_XML_DEPTH).collect();
        sequence.extend((0..count).filter(|&at| waiting[at] > 0));
        Order { sequence, endless }
    }

    /// Returns whether the data type at `at` contains itself, is nested too deeply, or refers to such a type.
    pub fn is_endless(&self, at: usize) -> bool {
        self.endless[at]
    }
}

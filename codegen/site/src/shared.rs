//! Notes that several entries of an object have in common: ambiguities and diagnostics. The object shows each of them once.

use std::collections::{HashMap, HashSet};
use std::hash::Hash;

use super::diagnostics::ShownDiagnostic;
use super::entry::{Doubt, Row};

/// An ambiguity that several entries of an object have in common.
#[derive(Debug)]
pub(super) struct SharedDoubt {
    pub doubt: Doubt,
    /// Positions of the entries in the section.
    entries: Vec<usize>,
}

impl SharedDoubt {
    /// Returns the entries that have the ambiguity. `rows` are the rows of the section.
    pub fn rows<'r>(&self, rows: &'r [Row]) -> Vec<&'r Row> {
        self.entries.iter().filter_map(|at| rows.get(*at)).collect()
    }
}

/// Removes from the rows of an object each ambiguity that several rows have, and returns these ambiguities.
pub(super) fn doubts(rows: &mut [Row]) -> Vec<SharedDoubt> {
    let shared = take(rows, |row| &mut row.doubts, Doubt::clone);
    shared.into_iter().map(|(doubt, entries)| SharedDoubt { doubt, entries }).collect()
}

/// Moves diagnostics from the rows of an object to the object if several rows have them. Diagnostics that the object
/// already shows are removed from the rows.
pub(super) fn diagnostics(rows: &mut [Row], of_object: &mut Vec<ShownDiagnostic>) {
    let key = |shown: &ShownDiagnostic| (shown.position.clone(), shown.text.clone());
    let known: HashSet<_> = of_object.iter().map(key).collect();
    rows.iter_mut().for_each(|row| row.diagnostics.retain(|shown| !known.contains(&key(shown))));
    of_object.extend(take(rows, |row| &mut row.diagnostics, key).into_iter().map(|(shown, _)| shown));
}

/// Removes from the rows each note that several rows have, and returns these notes with the positions of the rows. The
/// notes are in the order of their first occurrence. `list` returns the notes of a row. Notes with equal keys are the
/// same.
fn take<T, K: Eq + Hash>(
    rows: &mut [Row],
    list: impl Fn(&mut Row) -> &mut Vec<T>,
    key: impl Fn(&T) -> K,
) -> Vec<(T, Vec<usize>)> {
    let mut notes: Vec<(T, Vec<usize>)> = Vec::new();
    let mut known = HashMap::new();
    for (at, row) in rows.iter_mut().enumerate() {
        for note in std::mem::take(list(row)) {
            let position = *known.entry(key(&note)).or_insert(notes.len());
            match notes.get_mut(position) {
                Some((_, entries)) if entries.last() == Some(&at) => {}
                Some((_, entries)) => entries.push(at),
                None => notes.push((note, vec![at])),
            }
        }
    }
    let (shared, single): (Vec<_>, Vec<_>) = notes.into_iter().partition(|(_, entries)| entries.len() > 1);
    for (note, entries) in single {
        if let Some(row) = entries.first().and_then(|at| rows.get_mut(*at)) {
            list(row).push(note);
        }
    }
    shared
}

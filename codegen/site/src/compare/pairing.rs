//! Pairs the elements of two descriptions.

use std::collections::HashMap;
use std::hash::Hash;

/// An element of the old description with its counterpart in the new description. One of the two elements can be missing.
pub(super) type Pair<'a, T> = (Option<&'a T>, Option<&'a T>);

/// Pairs elements in the order of the old list. Added elements follow at the end.
///
/// First, elements with the same name and position are paired. The remaining elements are paired by unique name, then
/// by position. An empty name or position does not pair elements in these two steps.
pub(super) fn pairs<'a, T>(
    old: &'a [T],
    new: &'a [T],
    name: impl Fn(&T) -> String,
    position: impl Fn(&T) -> String,
) -> Vec<Pair<'a, T>> {
    let keys = |list: &[T]| {
        list.iter().map(|element| Key { name: name(element), position: position(element) }).collect::<Vec<_>>()
    };
    let matching = Matching::of(&keys(old), &keys(new));
    let paired = old.iter().zip(&matching.new_of_old).map(|(one, other)| (Some(one), other.map(|at| &new[at])));
    let added = new.iter().zip(&matching.is_new_paired).filter(|(_, is_paired)| !**is_paired);
    paired.chain(added.map(|(one, _)| (None, Some(one)))).collect()
}

/// The texts that pair an element: its name and position.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Key {
    pub name: String,
    pub position: String,
}

/// The paired elements of two lists.
pub(super) struct Matching {
    /// Position in the new list for each element of the old list.
    pub new_of_old: Vec<Option<usize>>,
    /// For each element of the new list, true if the element is paired with an element of the old list.
    pub is_new_paired: Vec<bool>,
}

impl Matching {
    /// Pairs the elements with these keys.
    pub fn of(old: &[Key], new: &[Key]) -> Self {
        let mut matching = Matching { new_of_old: vec![None; old.len()], is_new_paired: vec![false; new.len()] };
        matching.stage(old, new, Some, true);
        matching.stage(old, new, |key| Some(&key.name).filter(|name| !name.is_empty()), false);
        matching.stage(old, new, |key| Some(&key.position).filter(|position| !position.is_empty()), true);
        matching
    }
    /// Pairs elements with equal keys in list order. Keys that occur several times are ignored unless `is_repeatable`
    /// is set.
    fn stage<'k, Q: Hash + Eq + 'k>(
        &mut self,
        old: &'k [Key],
        new: &'k [Key],
        key: impl Fn(&'k Key) -> Option<&'k Q>,
        is_repeatable: bool,
    ) {
        let mut left: HashMap<&Q, Vec<usize>> = HashMap::new();
        for (position, one) in new.iter().enumerate().rev().filter(|(position, _)| !self.is_new_paired[*position]) {
            if let Some(key) = key(one) {
                left.entry(key).or_default().push(position);
            }
        }
        let unpaired: Vec<(usize, &'k Q)> = (0..old.len())
            .filter(|&position| self.new_of_old[position].is_none())
            .filter_map(|position| Some((position, key(&old[position])?)))
            .collect();
        let mut count: HashMap<&Q, usize> = HashMap::new();
        unpaired.iter().for_each(|(_, key)| *count.entry(key).or_default() += 1);
        for (at, key) in unpaired {
            let Some(positions) = left.get_mut(key) else { continue };
            if is_repeatable || count[key] == 1 && positions.len() == 1 {
                self.new_of_old[at] = positions.pop();
                self.new_of_old[at].into_iter().for_each(|position| self.is_new_paired[position] = true);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the pairs of two lists of texts. The letters of a text are its name, and the digits are its position.
    fn paired(old: &[&str], new: &[&str]) -> Vec<(String, String)> {
        let part =
            |text: &&str, condition: fn(char) -> bool| text.chars().filter(|letter| condition(*letter)).collect();
        let name = |text: &&str| part(text, |letter| letter.is_alphabetic());
        let position = |text: &&str| part(text, |letter| letter.is_numeric());
        let all = pairs(old, new, name, position);
        let shown = |value: Option<&&str>| value.map(|value| (*value).to_owned()).unwrap_or_default();
        all.into_iter().map(|(old, new)| (shown(old), shown(new))).collect()
    }

    #[track_caller]
    fn is(old: &[&str], new: &[&str], expected: &[(&str, &str)]) {
        let expected: Vec<_> = expected.iter().map(|(old, new)| ((*old).to_owned(), (*new).to_owned())).collect();
        assert_eq!(paired(old, new), expected);
    }

    #[test]
    fn elements_are_paired_by_name_and_then_by_position() {
        is(&["a1", "b2"], &["a1", "b2"], &[("a1", "a1"), ("b2", "b2")]);
        is(&["a1", "b2"], &["a2", "b1"], &[("a1", "a2"), ("b2", "b1")]);
        is(&["a1"], &["b1", "a2"], &[("a1", "a2"), ("", "b1")]);
        is(&["a1"], &["b1"], &[("a1", "b1")]);
        is(&["a1"], &["b2"], &[("a1", ""), ("", "b2")]);
        is(&["1", "2"], &["2", "3"], &[("1", ""), ("2", "2"), ("", "3")]);
    }

    #[test]
    fn shared_names_count_with_their_position_only() {
        is(&["a1", "a2"], &["a2", "a3"], &[("a1", "a3"), ("a2", "a2")]);
        is(&["a1", "a2", "a3"], &["a4", "a2"], &[("a1", ""), ("a2", "a2"), ("a3", ""), ("", "a4")]);
        is(&["a1", "a1"], &["a1", "a1"], &[("a1", "a1"), ("a1", "a1")]);
    }
}

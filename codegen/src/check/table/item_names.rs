//! Reports words that are almost the name of an item. Manuals often spell a register differently in its row and in the text.

use std::collections::{BTreeMap, BTreeSet};

use crate::check::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{stated, texts, Device};
use crate::limits;
use crate::text::{brief, edit_distance};

/// Lengths in characters of the names and words that are compared. Shorter words are not compared, because they are too
/// similar to each other.
const LETTERS: std::ops::RangeInclusive<usize> = 6..=48;

/// Minimum number of item names with a prefix. A prefix is a capital letter that is followed by a lower-case letter, such as `R` in
/// `Rspeed`. At least nine tenths of all item names must begin with the prefix.
const CONVENTION: usize = 4;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let device = context.device;
    let names = Names::new(device);
    if names.like_identifiers.is_empty() || !diagnostics.wants(&codes::MENTIONED_OBJECT) {
        return;
    }
    let (mut known, mut reported) = (BTreeMap::new(), BTreeSet::new());
    for text in texts::all(device) {
        for word in text.words.split(|c: char| !c.is_alphanumeric() && c != '_') {
            if known.len() > limits::MAX_SEARCHED_WORDS {
                return;
            }
            let suggestion = *known.entry(word).or_insert_with(|| names.suggestion(word));
            let Some(suggestion) = suggestion.filter(|_| reported.insert((text.span, word))) else { continue };
            let of = if text.of.is_empty() { String::new() } else { format!(" of `{}`", brief(text.of)) };
            let message = format!("a text{of} mentions `{}`, but no item has this name", brief(word));
            let found = codes::MENTIONED_OBJECT.at(text.span, message);
            diagnostics.push(found.help(format!("did you mean `{}`?", brief(suggestion))));
        }
    }
}

/// Names in a table: items, groups, types, procedures and messages.
struct Names<'a> {
    all: BTreeSet<String>,
    /// Names of items and groups that are recognizable as identifiers, such as `targetSpeed`, because they cannot be
    /// words of a language.
    like_identifiers: Vec<&'a str>,
}

impl<'a> Names<'a> {
    fn new(device: &'a Device) -> Self {
        let items = device.items().map(|item| item.name.as_str());
        let of_items = || items.clone().chain(device.groups.iter().map(|group| group.name.as_str()));
        // Words that are names of types, procedures or messages are not reported as misspelled item names.
        let others = stated::types(&device.types).map(|(_, definition)| definition.name.as_str());
        let others = others.chain(device.procedures.iter().map(|procedure| procedure.name.as_str()));
        let all = of_items().chain(others.chain(device.messages.iter().map(|message| message.name.as_str())));
        let single =
            |name: &&str| name.len() <= 2 * LETTERS.end() && name.chars().all(|c| c.is_alphanumeric() || c == '_');
        let prefix = prefix(items.clone().filter(single));
        let is_like = |name: &&str| prefix.is_some_and(|prefix| has_prefix(name, prefix)) || is_composed(name);
        let like_identifiers = of_items().filter(single).filter(is_like).take(limits::MAX_SEARCHED_NAMES).collect();
        Names { all: all.map(str::to_lowercase).collect(), like_identifiers }
    }

    /// Returns the name of an item or group that a misspelled word probably means.
    fn suggestion(&self, word: &str) -> Option<&'a str> {
        let letters = word.chars().count();
        let lower = word.to_lowercase();
        if !LETTERS.contains(&letters) || self.all.contains(&lower) {
            return None;
        }
        // Texts refer to the registers `Rdefinp0` to `Rdefinp15` as `Rdefinp` or `Rdefinpx`. A plural is not a
        // misspelling.
        let stem = lower.trim_end_matches(['x', 'n', 's']);
        let of_a_family = self.all.range(stem.to_owned()..).next().is_some_and(|name| name.starts_with(stem));
        if of_a_family || self.all.contains(stem) {
            return None;
        }
        let limit = (letters / 5).clamp(1, 3);
        let near = self.like_identifiers.iter().filter(|name| similar_case(name, word));
        let near = near.filter(|name| name.chars().count().abs_diff(letters) <= limit);
        let best = near.map(|name| (edit_distance(&name.to_lowercase(), &lower), *name)).min()?;
        let differs_in_letters = without_digits(best.1) != without_digits(&lower);
        (best.0 <= limit && differs_in_letters).then_some(best.1)
    }
}

/// Returns the capital letter that is the prefix of most item names (see [`CONVENTION`]), or `None` if there is no such prefix.
fn prefix<'n>(names: impl Iterator<Item = &'n str>) -> Option<char> {
    let (mut count, mut by_letter) = (0, BTreeMap::new());
    for name in names {
        count += 1;
        if let Some(first) = name.chars().next().filter(|&first| has_prefix(name, first)) {
            *by_letter.entry(first).or_insert(0) += 1;
        }
    }
    let (best, with_best) = by_letter.into_iter().max_by_key(|(_, count): &(char, usize)| *count)?;
    (best.is_uppercase() && with_best >= CONVENTION && with_best * 10 >= count * 9).then_some(best)
}

fn has_prefix(name: &str, prefix: char) -> bool {
    let mut letters = name.chars();
    letters.next() == Some(prefix) && letters.next().is_some_and(char::is_lowercase)
}

/// Returns whether a name consists of several words: `target_speed` or `targetSpeed`, but not `Speed`.
fn is_composed(name: &str) -> bool {
    let pairs = name.chars().zip(name.chars().skip(1));
    name.trim_matches('_').contains('_') || pairs.clone().any(|(one, next)| one.is_lowercase() && next.is_uppercase())
}

/// Returns whether a name and a word begin with the same letter, and have the same total number of underscores and
/// capitals.
fn similar_case(name: &str, word: &str) -> bool {
    let shape = |text: &str| text.chars().filter(|c| *c == '_' || c.is_uppercase()).count();
    name.chars().next() == word.chars().next() && shape(name) == shape(word)
}

fn without_digits(text: &str) -> String {
    text.chars().filter(|c| !c.is_ascii_digit()).flat_map(char::to_lowercase).collect()
}

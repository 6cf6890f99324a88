//! Stores facts by element and name, and finds the differences between the facts of two readers.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// The facts of an element. Missing facts are not listed.
pub type Facts = BTreeMap<String, String>;

/// The elements of a file by name.
pub type Elements = BTreeMap<String, Facts>;

/// A fact that two readers read differently, or a fact or element that only one reader has.
#[derive(Clone, Copy, Debug)]
pub struct Difference<'a> {
    /// Name of the element.
    pub element: &'a str,
    /// Name of the fact. `None` means that one of the readers lacks the whole element.
    pub fact: Option<&'a str>,
    /// Value from the independent reader.
    pub peer: Option<&'a str>,
    /// Value from Lexibus.
    pub ours: Option<&'a str>,
}

impl fmt::Display for Difference<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = |value: Option<&str>| value.map_or_else(|| "nothing".to_owned(), |value| format!("{value:?}"));
        let (peer, ours) = (shown(self.peer), shown(self.ours));
        write!(f, "{} {}: the peer has {peer}, Lexibus has {ours}", self.element, self.fact.unwrap_or("(the element)"))
    }
}

/// Adds a fact unless it is empty.
pub fn put(facts: &mut Facts, name: &str, value: impl Into<String>) {
    let value = value.into();
    if !value.is_empty() {
        facts.insert(name.to_owned(), value);
    }
}

/// Adds a fact if its value is `Some` and not empty.
pub fn put_some(facts: &mut Facts, name: &str, value: Option<impl ToString>) {
    if let Some(value) = value {
        put(facts, name, value.to_string());
    }
}

/// Adds a number unless it is 0, which means no value.
pub fn put_number(facts: &mut Facts, name: &str, number: impl Into<i64>) {
    put_some(facts, name, Some(number.into()).filter(|&number| number != 0));
}

/// Adds a flag if it is set.
pub fn put_flag(facts: &mut Facts, name: &str, flag: bool) {
    put(facts, name, if flag { "yes" } else { "" });
}

/// Formats a real number with all digits, in the notation of the scripts.
pub fn real(value: f64) -> String {
    format!("{value:.16e}")
}

/// Compares the facts of two readers in both directions. Returns the number of compared elements and facts.
pub fn compare<'a>(peer: &'a Elements, ours: &'a Elements, mut differs: impl FnMut(Difference<'a>)) -> usize {
    let mut count = 0;
    let names: BTreeSet<&String> = peer.keys().chain(ours.keys()).collect();
    for element in names {
        count += 1;
        match (peer.get(element), ours.get(element)) {
            (Some(peer), Some(ours)) => count += facts(element, peer, ours, &mut differs),
            (peer, ours) => {
                let there = |facts: Option<&Facts>| facts.map(|_| "it is there");
                differs(Difference { element, fact: None, peer: there(peer), ours: there(ours) });
            }
        }
    }
    count
}

fn facts<'a>(element: &'a str, peer: &'a Facts, ours: &'a Facts, differs: &mut impl FnMut(Difference<'a>)) -> usize {
    let names: BTreeSet<&String> = peer.keys().chain(ours.keys()).collect();
    for fact in &names {
        let (peer, ours) = (peer.get(*fact).map(String::as_str), ours.get(*fact).map(String::as_str));
        if peer != ours {
            differs(Difference { element, fact: Some(fact), peer, ours });
        }
    }
    names.len()
}

//! Facts by name, by element, and where two readings of them differ.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// The facts of one element; what a source doesn't say is no fact.
pub type Facts = BTreeMap<String, String>;

/// The elements of one file.
pub type Elements = BTreeMap<String, Facts>;

/// A fact that two readers have otherwise, or one of them not at all.
#[derive(Clone, Copy, Debug)]
pub struct Difference<'a> {
    /// The element.
    pub element: &'a str,
    /// The fact; none where one of the two doesn't have the element at all.
    pub fact: Option<&'a str>,
    /// What the independent reader says.
    pub peer: Option<&'a str>,
    /// What Lexibus says.
    pub own: Option<&'a str>,
}

impl fmt::Display for Difference<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let said = |value: Option<&str>| value.map_or_else(|| "nothing".to_owned(), |value| format!("{value:?}"));
        let (peer, own) = (said(self.peer), said(self.own));
        write!(f, "{} {}: the peer says {peer}, Lexibus {own}", self.element, self.fact.unwrap_or("(the element)"))
    }
}

/// Adds a fact, unless there is nothing to say.
pub fn put(facts: &mut Facts, name: &str, value: impl Into<String>) {
    let value = value.into();
    if !value.is_empty() {
        facts.insert(name.to_owned(), value);
    }
}

/// The same for what may be missing.
pub fn put_some(facts: &mut Facts, name: &str, value: Option<impl ToString>) {
    if let Some(value) = value {
        put(facts, name, value.to_string());
    }
}

/// A number of which 0 is the same as none.
pub fn put_number(facts: &mut Facts, name: &str, number: impl Into<i64>) {
    put_some(facts, name, Some(number.into()).filter(|&number| number != 0));
}

/// A flag: it is a fact where it is set.
pub fn put_flag(facts: &mut Facts, name: &str, flag: bool) {
    put(facts, name, if flag { "yes" } else { "" });
}

/// A real number with all of its digits, as the scripts write it.
pub fn real(value: f64) -> String {
    format!("{value:.16e}")
}

/// Holds two readings against each other in both directions; gives how many facts were compared.
pub fn compare<'a>(peer: &'a Elements, own: &'a Elements, mut differs: impl FnMut(Difference<'a>)) -> usize {
    let mut count = 0;
    let names: BTreeSet<&String> = peer.keys().chain(own.keys()).collect();
    for element in names {
        count += 1;
        match (peer.get(element), own.get(element)) {
            (Some(peer), Some(own)) => count += facts(element, peer, own, &mut differs),
            (peer, own) => {
                let there = |facts: Option<&Facts>| facts.map(|_| "it is there");
                differs(Difference { element, fact: None, peer: there(peer), own: there(own) });
            }
        }
    }
    count
}

fn facts<'a>(element: &'a str, peer: &'a Facts, own: &'a Facts, differs: &mut impl FnMut(Difference<'a>)) -> usize {
    let names: BTreeSet<&String> = peer.keys().chain(own.keys()).collect();
    for fact in &names {
        let (peer, own) = (peer.get(*fact).map(String::as_str), own.get(*fact).map(String::as_str));
        if peer != own {
            differs(Difference { element, fact: Some(fact), peer, own });
        }
    }
    names.len()
}

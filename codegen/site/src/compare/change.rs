//! A change between two descriptions, and its effects on programs, frames and the behavior of the device.

use std::fmt;

use lexibus_codegen::text::printable;
use serde::Serialize;

/// The effect of a change on one aspect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// The change does not affect this aspect.
    #[default]
    Unaffected,
    /// Programs and data that were valid for the old description are also valid for the new one and have the same
    /// meaning.
    Compatible,
    /// Programs or data that were valid for the old description are invalid for the new one or have a different
    /// meaning.
    Breaking,
}

/// The effects of a change on the three aspects: Rust code, communication and behavior.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize)]
pub struct Judgment {
    /// Effect on Rust code that uses the old description: whether the code still compiles and has the same meaning.
    pub api: Effect,
    /// Effect on the bytes on the bus: addresses, layouts, encodings and frames.
    pub wire: Effect,
    /// Effect on the behavior of the device: range, default value, storage, conditions, side effects and availability.
    pub behavior: Effect,
}

impl Judgment {
    /// No effect, as for changes to texts and to facts about the file.
    pub const NONE: Judgment = Judgment::new(Effect::Unaffected, Effect::Unaffected, Effect::Unaffected);
    /// Breaks Rust code only.
    pub const API: Judgment = Judgment::new(Effect::Breaking, Effect::Unaffected, Effect::Unaffected);
    /// Breaks the communication only.
    pub const WIRE: Judgment = Judgment::new(Effect::Unaffected, Effect::Breaking, Effect::Unaffected);
    /// Breaks the behavior only.
    pub const BEHAVIOR: Judgment = Judgment::new(Effect::Unaffected, Effect::Unaffected, Effect::Breaking);
    /// Breaks Rust code and the communication, but not the behavior.
    pub const API_AND_WIRE: Judgment = Judgment::new(Effect::Breaking, Effect::Breaking, Effect::Unaffected);
    /// Breaks Rust code and the behavior, but not the communication.
    pub const API_AND_BEHAVIOR: Judgment = Judgment::new(Effect::Breaking, Effect::Unaffected, Effect::Breaking);
    /// Adds an element to the Rust code.
    pub const API_COMPATIBLE: Judgment = Judgment::new(Effect::Compatible, Effect::Unaffected, Effect::Unaffected);
    /// Adds an element to the Rust code and to the communication.
    pub const ADDITION: Judgment = Judgment::new(Effect::Compatible, Effect::Compatible, Effect::Unaffected);
    /// Adds an element to the communication.
    pub const WIRE_COMPATIBLE: Judgment = Judgment::new(Effect::Unaffected, Effect::Compatible, Effect::Unaffected);
    /// Changes the behavior without making any previous use invalid.
    pub const BEHAVIOR_COMPATIBLE: Judgment = Judgment::new(Effect::Unaffected, Effect::Unaffected, Effect::Compatible);

    /// Creates a judgment from the effects on the three aspects.
    pub const fn new(api: Effect, wire: Effect, behavior: Effect) -> Self {
        Judgment { api, wire, behavior }
    }

    /// Returns whether the change breaks Rust code or the communication.
    pub fn is_breaking(self) -> bool {
        self.api == Effect::Breaking || self.wire == Effect::Breaking
    }

    /// Returns the class of the change. The worst effect determines the class.
    pub fn class(self) -> Class {
        match [self.api, self.wire, self.behavior].into_iter().max() {
            _ if self.is_breaking() => Class::Breaking,
            Some(Effect::Breaking) => Class::Behavior,
            Some(Effect::Compatible) => Class::Compatible,
            _ => Class::None,
        }
    }

    /// Returns the names of the aspects that have this effect, for reports.
    fn aspects(self, effect: Effect) -> String {
        let all = [("api", self.api), ("wire", self.wire), ("behavior", self.behavior)];
        all.into_iter().filter(|(_, other)| *other == effect).map(|(name, _)| name).collect::<Vec<_>>().join(", ")
    }
}

impl fmt::Display for Judgment {
    /// Writes a text such as `breaks api, wire`, `compatible` or `no effect`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.class() {
            Class::Breaking | Class::Behavior => write!(f, "breaks {}", self.aspects(Effect::Breaking)),
            Class::Compatible => f.write_str("compatible"),
            Class::None => f.write_str("no effect"),
        }
    }
}

/// The class of a change, determined by its worst effect. Reports list the classes in the order of the variants.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// The change breaks Rust code or the communication.
    Breaking,
    /// The change breaks only the behavior.
    Behavior,
    /// The change is compatible.
    Compatible,
    /// The change has no effect.
    None,
}

/// A difference between two descriptions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Change {
    /// Name of the changed device, module or submodule. Empty for the device if both descriptions have a single device,
    /// and for data that all devices share.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub owner: String,
    /// Address and name of the changed element.
    pub element: String,
    /// Name of the changed fact, such as `access`, `type`, `range` or `layout`. `added` and `removed` concern the whole element.
    pub fact: &'static str,
    /// Old value of the fact; empty if there is none.
    pub old: String,
    /// New value of the fact; empty if there is none.
    pub new: String,
    /// Effects of the change.
    #[serde(flatten)]
    pub judgment: Judgment,
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Change { owner, element, fact, old, new, judgment } = self;
        let (old, new) = excerpts(old, new);
        // Make control characters printable, because the texts come from descriptions and may be shown in a terminal.
        let [owner, element, old, new] = [owner, element, &old, &new].map(|text| printable(text));
        let of = if owner.is_empty() { String::new() } else { format!("{owner}: ") };
        write!(f, "{judgment}: {of}{element}")?;
        match (old.is_empty(), new.is_empty()) {
            (true, true) => write!(f, ": {fact}"),
            (true, false) => write!(f, ": {fact}, {new}"),
            (false, true) => write!(f, ": {fact}, was {old}"),
            (false, false) => write!(f, ": {fact} {old}, now {new}"),
        }
    }
}

/// Shortens two long texts. Each result begins at the first word that differs.
fn excerpts(old: &str, new: &str) -> (String, String) {
    /// Maximum length of texts that are not shortened.
    const LONG: usize = 240;
    /// Maximum length of a shortened text.
    const SHOWN: usize = 80;
    if old.chars().count().max(new.chars().count()) <= LONG {
        return (old.to_owned(), new.to_owned());
    }
    let equal = old.char_indices().zip(new.chars()).take_while(|((_, one), other)| one == other);
    let same = equal.last().map_or(0, |((at, letter), _)| at + letter.len_utf8());
    let start = old[..same].rfind(' ').map_or(0, |at| at + 1);
    let excerpt = |text: &str| {
        let rest = text.get(start..).unwrap_or_default();
        let cut: String = rest.chars().take(SHOWN).collect();
        let before = if start > 0 && !text.is_empty() { "… " } else { "" };
        let after = if cut.len() < rest.len() { " …" } else { "" };
        format!("{before}{cut}{after}")
    };
    (excerpt(old), excerpt(new))
}

/// The total number of changes, and the number of changes with each effect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Total number of changes.
    pub changes: usize,
    /// Number of changes that break Rust code.
    pub api: usize,
    /// Number of changes that break the communication.
    pub wire: usize,
    /// Number of changes that break the behavior.
    pub behavior: usize,
    /// Number of changes that are compatible.
    pub compatible: usize,
    /// Number of changes without an effect.
    pub none: usize,
}

impl Summary {
    /// Counts the changes with each effect. A change with several breaking effects is counted for each of them. Only a
    /// change without breaking effects is counted as compatible or as a change without an effect.
    pub fn of(changes: &[Change]) -> Self {
        let count =
            |condition: &dyn Fn(Judgment) -> bool| changes.iter().filter(|change| condition(change.judgment)).count();
        Summary {
            changes: changes.len(),
            api: count(&|judgment| judgment.api == Effect::Breaking),
            wire: count(&|judgment| judgment.wire == Effect::Breaking),
            behavior: count(&|judgment| judgment.behavior == Effect::Breaking),
            compatible: count(&|judgment| judgment.class() == Class::Compatible),
            none: count(&|judgment| judgment.class() == Class::None),
        }
    }
}

impl fmt::Display for Summary {
    /// Writes a text such as `3 changes; breaking: api 1, wire 2, behavior 0; compatible: 1; no effect: 0`, or `no
    /// changes`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Summary { changes, api, wire, behavior, compatible, none } = self;
        let count = match changes {
            0 => return f.write_str("no changes"),
            1 => "1 change".to_owned(),
            _ => format!("{changes} changes"),
        };
        let breaking = format!("breaking: api {api}, wire {wire}, behavior {behavior}");
        write!(f, "{count}; {breaking}; compatible: {compatible}; no effect: {none}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_named_by_its_worst_effects() {
        let text = |judgment: Judgment| judgment.to_string();
        assert_eq!(text(Judgment::API_AND_WIRE), "breaks api, wire");
        assert_eq!(text(Judgment { behavior: Effect::Breaking, ..Judgment::WIRE }), "breaks wire, behavior");
        assert_eq!(text(Judgment { behavior: Effect::Breaking, ..Judgment::ADDITION }), "breaks behavior");
        assert_eq!(text(Judgment::BEHAVIOR_COMPATIBLE), "compatible");
        assert_eq!(text(Judgment::NONE), "no effect");
        let classes = [Judgment::WIRE, Judgment::BEHAVIOR, Judgment::ADDITION, Judgment::NONE].map(Judgment::class);
        assert!(classes.is_sorted());
    }

    #[test]
    fn long_texts_are_shown_from_the_word_in_which_they_differ() {
        let same = "word ".repeat(60);
        let (old, new) = excerpts(&format!("{same}sheep here"), &format!("{same}ship {same}"));
        assert_eq!(old, "… sheep here");
        assert!(new.starts_with("… ship word") && new.ends_with(" …") && new.chars().count() < 90, "{new}");
        let (old, new) = excerpts("", &format!("Ü{same}"));
        assert!(old.is_empty() && new.starts_with("Üword"));
        assert_eq!(excerpts("short", "text"), ("short".to_owned(), "text".to_owned()));
    }

    #[test]
    fn every_judgment_is_counted() {
        let change = |judgment| Change {
            owner: String::new(),
            element: String::new(),
            fact: "fact",
            old: String::new(),
            new: String::new(),
            judgment,
        };
        let changes = [Judgment::API_AND_WIRE, Judgment::BEHAVIOR, Judgment::ADDITION, Judgment::NONE].map(change);
        let text = Summary::of(&changes).to_string();
        assert_eq!(text, "4 changes; breaking: api 1, wire 1, behavior 1; compatible: 1; no effect: 1");
        assert_eq!(Summary::of(&[]).to_string(), "no changes");
    }
}

//! Options of an export, which supply facts that a format requires and a source may not have.

use std::fmt;

use lexibus_codegen::text::similar;

use super::note::Export;
use super::xml::Xml;

/// A fact that the format requires and that neither the source nor the options contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MissingFact {
    /// Key of the option that supplies the fact.
    pub key: &'static str,
    /// Description of the fact.
    pub what: &'static str,
}

/// The reason why the export writes no file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The source contains nothing that the format can express.
    Nothing,
    /// Facts that the format requires are neither in the source nor in the options.
    Missing(Vec<MissingFact>),
    /// The content is too long for the EEPROM.
    TooLong {
        /// Length of the content in bytes.
        needed: usize,
        /// Size of the EEPROM in bytes.
        size: usize,
    },
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::Nothing => f.write_str("the description contains nothing that the format can express"),
            Refusal::Missing(facts) => {
                f.write_str("the format requires facts that the description does not contain; set")?;
                for (fact, comma) in facts.iter().zip(std::iter::once(" ").chain(std::iter::repeat(", "))) {
                    write!(f, "{comma}`{}` ({})", fact.key, fact.what.trim_end_matches('.'))?;
                }
                Ok(())
            }
            Refusal::TooLong { needed, size } => {
                write!(f, "the content has {needed} bytes, but the EEPROM has only {size}; set `eeprom-size`")
            }
        }
    }
}

impl std::error::Error for Refusal {}

/// Collects missing facts during an export.
pub(super) struct MissingFacts {
    facts: Vec<MissingFact>,
    /// Keys and descriptions of the options of the format.
    keys: &'static [(&'static str, &'static str)],
}

impl MissingFacts {
    pub(super) fn new(keys: &'static [(&'static str, &'static str)]) -> Self {
        MissingFacts { facts: Vec::new(), keys }
    }

    /// Returns `found`. If `found` is `None`, records the missing fact and returns a default, so that one refusal lists
    /// all missing facts.
    pub(super) fn require<T: Default>(&mut self, found: Option<T>, key: &'static str) -> T {
        found.unwrap_or_else(|| {
            let what = self.keys.iter().find(|(known, _)| *known == key).map_or("", |(_, what)| what);
            if !self.facts.iter().any(|fact| fact.key == key) {
                self.facts.push(MissingFact { key, what });
            }
            T::default()
        })
    }

    /// Returns the exported document, or a refusal if facts are missing.
    pub(super) fn finish(self, xml: Xml) -> Result<Export, Refusal> {
        self.check().map(|()| xml.finish())
    }

    /// Returns a refusal if facts are missing.
    pub(super) fn check(self) -> Result<(), Refusal> {
        match self.facts.is_empty() {
            true => Ok(()),
            false => Err(Refusal::Missing(self.facts)),
        }
    }
}

/// A type that the value of an option can have.
pub(super) trait OptionValue: Sized {
    /// Description of the valid values, for messages.
    const WHAT: &'static str;

    fn parse(text: &str) -> Option<Self>;
}

impl OptionValue for u32 {
    const WHAT: &'static str = "a number of up to 32 bits, decimal or hexadecimal with `0x`";

    fn parse(text: &str) -> Option<Self> {
        let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("#x"));
        digits.map_or_else(|| text.parse().ok(), |digits| u32::from_str_radix(digits, 16).ok())
    }
}

impl OptionValue for u16 {
    const WHAT: &'static str = "a number of up to 16 bits, decimal or hexadecimal with `0x`";

    fn parse(text: &str) -> Option<Self> {
        <u32 as OptionValue>::parse(text).and_then(|value| value.try_into().ok())
    }
}

impl OptionValue for String {
    const WHAT: &'static str = "a text that is not empty";

    fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        (!text.is_empty()).then(|| text.to_owned())
    }
}

impl OptionValue for bool {
    const WHAT: &'static str = "`true` or `false`";

    fn parse(text: &str) -> Option<Self> {
        text.parse().ok()
    }
}

/// Parses the text of the option `key`.
pub(super) fn parsed<T: OptionValue>(key: &str, text: &str) -> Result<Option<T>, String> {
    T::parse(text).map(Some).ok_or_else(|| format!("`{key}` must be {}, not `{text}`", T::WHAT))
}

/// Returns the error for an unknown key.
pub(super) fn unknown(key: &str, known: &[(&str, &str)]) -> String {
    let keys: Vec<&str> = known.iter().map(|(key, _)| *key).collect();
    let suggestion = similar(key, keys.iter().copied());
    let suggestion = suggestion.map(|known| format!("did you mean `{known}`? ")).unwrap_or_default();
    format!("unknown option `{key}` of this format; {suggestion}the options are {}", keys.join(", "))
}

/// Declares options with their keys, and a type that records which options an export reads.
macro_rules! options {
    ($(#[$attribute:meta])* pub struct $name:ident, $tracked:ident {
        $(#[doc = $doc:literal] $field:ident: $ty:ty = $key:literal,)+
    }) => {
        $(#[$attribute])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $name {
            $(#[doc = $doc] pub $field: Option<$ty>,)+
        }

        impl $name {
            /// The key and description of each option.
            pub const KEYS: &'static [(&'static str, &'static str)] = &[$(($key, $doc.trim_ascii())),+];

            /// Sets the option with this key. Returns an error if the key is unknown or the value is invalid.
            pub fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
                match key {
                    $($key => self.$field = $crate::options::parsed(key, value)?,)+
                    _ => {
                        return Err($crate::options::unknown(key, Self::KEYS));
                    }
                }
                Ok(())
            }
        }

        /// The options, and the keys that an export has read.
        pub(super) struct $tracked<'o> {
            options: &'o $name,
            keys: std::cell::RefCell<std::collections::HashSet<&'static str>>,
        }

        impl<'o> $tracked<'o> {
            pub(super) fn new(options: &'o $name) -> Self {
                $tracked { options, keys: Default::default() }
            }

            $(#[doc = $doc]
            pub(super) fn $field(&self) -> Option<$ty> {
                self.keys.borrow_mut().insert($key);
                self.options.$field.clone()
            })+

            /// Adds a note for each option that is set and was not read.
            pub(super) fn note_unused(&self, notes: &mut $crate::note::Notes) {
                let keys = self.keys.borrow();
                $(if self.options.$field.is_some() && !keys.contains($key) {
                    notes.add($crate::note::NoteKind::GivenFact, $crate::note::Subject::Named($key));
                })+
            }
        }
    };
}
pub(super) use options;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_and_refusals() {
        assert_eq!(parsed::<u32>("a", "0x1F"), Ok(Some(31)));
        assert_eq!(parsed::<u16>("a", "70000").map_err(|text| text.contains("`a` must be a number")), Err(true));
        assert!(parsed::<String>("a", " ").is_err() && parsed::<bool>("a", "yes").is_err());
        let mut missing = MissingFacts::new(&[("two", "The second.")]);
        assert_eq!(missing.require(Some(1u32), "one"), 1);
        assert_eq!(missing.require(None::<u32>, "two"), 0);
        let refusal = missing.finish(Xml::new()).expect_err("one is missing");
        assert_eq!(
            refusal.to_string(),
            "the format requires facts that the description does not contain; set `two` (The second)"
        );
    }
}

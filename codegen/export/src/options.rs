//! Facts that a format wants and a source may not have: they come from whoever exports.

use std::fmt;

use super::note::Note;

/// A fact that the format wants and nobody gave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MissingFact {
    /// The key of the option that gives it.
    pub key: &'static str,
    /// What it is.
    pub what: &'static str,
}

/// Why there is no file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The source describes nothing that the format could hold.
    Nothing,
    /// Facts that the format wants are neither in the source nor in the options.
    Missing(Vec<MissingFact>),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::Nothing => f.write_str("it describes nothing that the format can hold"),
            Refusal::Missing(facts) => {
                f.write_str("the format wants what the source doesn't say; give")?;
                for (fact, comma) in facts.iter().zip(std::iter::once(" ").chain(std::iter::repeat(", "))) {
                    write!(f, "{comma}`{}` ({})", fact.key, fact.what.trim_end_matches('.'))?;
                }
                Ok(())
            }
        }
    }
}

impl std::error::Error for Refusal {}

/// The facts that are missing so far.
#[derive(Default)]
pub(super) struct Wanted(Vec<MissingFact>);

impl Wanted {
    /// `found`, or what stands in for it while the others are looked for.
    pub(super) fn want<T: Default>(&mut self, found: Option<T>, key: &'static str, keys: &[(&str, &'static str)]) -> T {
        found.unwrap_or_else(|| {
            let what = keys.iter().find(|(own, _)| *own == key).map_or("", |(_, what)| what);
            if !self.0.iter().any(|fact| fact.key == key) {
                self.0.push(MissingFact { key, what });
            }
            T::default()
        })
    }

    pub(super) fn finish(self, text: String, notes: Vec<Note>) -> Result<super::Export, Refusal> {
        if self.0.is_empty() {
            Ok(super::Export { text, notes })
        } else {
            Err(Refusal::Missing(self.0))
        }
    }
}

/// A value of an option.
pub(super) trait OptionValue: Sized {
    /// What a value has to be.
    const WHAT: &'static str;

    fn parse(text: &str) -> Option<Self>;
}

impl OptionValue for u32 {
    const WHAT: &'static str = "a number of up to 32 bits, decimal or behind `0x`";

    fn parse(text: &str) -> Option<Self> {
        let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("#x"));
        digits.map_or_else(|| text.parse().ok(), |digits| u32::from_str_radix(digits, 16).ok())
    }
}

impl OptionValue for u16 {
    const WHAT: &'static str = "a number of up to 16 bits, decimal or behind `0x`";

    fn parse(text: &str) -> Option<Self> {
        <u32 as OptionValue>::parse(text).and_then(|value| value.try_into().ok())
    }
}

impl OptionValue for String {
    const WHAT: &'static str = "a text that isn't empty";

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

/// Sets an option by its text.
pub(super) fn parsed<T: OptionValue>(key: &str, text: &str) -> Result<Option<T>, String> {
    T::parse(text).map(Some).ok_or_else(|| format!("`{key}` is {}, not `{text}`", T::WHAT))
}

/// Options that have a key each; beside them what notes which of them a file asked for.
macro_rules! options {
    ($(#[$attribute:meta])* pub struct $name:ident, $asked:ident {
        $(#[doc = $doc:literal] $field:ident: $ty:ty = $key:literal,)+
    }) => {
        $(#[$attribute])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $name {
            $(#[doc = $doc] pub $field: Option<$ty>,)+
        }

        impl $name {
            /// The key of every option, and what it is.
            pub const KEYS: &'static [(&'static str, &'static str)] = &[$(($key, $doc.trim_ascii())),+];

            /// Sets the option with this key; an error says what is wrong with the key or the value.
            pub fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
                match key {
                    $($key => self.$field = $crate::options::parsed(key, value)?,)+
                    _ => {
                        let keys: Vec<&str> = Self::KEYS.iter().map(|(key, _)| *key).collect();
                        return Err(format!("there is no `{key}` in this format; there are {}", keys.join(", ")));
                    }
                }
                Ok(())
            }
        }

        /// The options, and those of them that were asked for.
        pub(super) struct $asked<'o> {
            options: &'o $name,
            keys: std::cell::RefCell<std::collections::HashSet<&'static str>>,
        }

        impl<'o> $asked<'o> {
            pub(super) fn new(options: &'o $name) -> Self {
                $asked { options, keys: Default::default() }
            }

            $(#[doc = $doc]
            pub(super) fn $field(&self) -> Option<$ty> {
                self.keys.borrow_mut().insert($key);
                self.options.$field.clone()
            })+

            /// Notes the options that are given and that nothing asked for.
            pub(super) fn note_others(&self, notes: &mut $crate::note::Notes) {
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
        assert_eq!(parsed::<u16>("a", "70000").map_err(|text| text.contains("`a` is a number")), Err(true));
        assert!(parsed::<String>("a", " ").is_err() && parsed::<bool>("a", "yes").is_err());
        let mut wanted = Wanted::default();
        assert_eq!(wanted.want(Some(1u32), "one", &[]), 1);
        assert_eq!(wanted.want(None::<u32>, "two", &[("two", "The second.")]), 0);
        let refusal = wanted.finish(String::new(), Vec::new()).expect_err("one is missing");
        assert_eq!(refusal.to_string(), "the format wants what the source doesn't say; give `two` (The second)");
    }
}

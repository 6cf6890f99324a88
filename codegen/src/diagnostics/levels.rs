//! Lenient and strict mode, and the level of each code as a user sets it.

use std::collections::BTreeMap;
use std::fmt;

use super::codes::{self, Class, Code};
use super::Severity;

/// What becomes of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// Not reported.
    Allow,
    /// Reported as a warning.
    Warn,
    /// Reported as an error.
    Deny,
}

/// The levels in force for one compilation.
///
/// A level set for a code wins over the mode; of several settings of one code the last wins. `warnings` names every
/// code that would otherwise be a warning.
#[derive(Clone, Debug, Default)]
pub struct Levels {
    strict: bool,
    warnings: Option<Level>,
    by_code: BTreeMap<&'static str, Level>,
}

/// A code that doesn't exist was named in a level setting.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownCode {
    /// What was named.
    pub name: String,
    /// The most similar code that exists.
    pub suggestion: Option<&'static str>,
}

impl fmt::Display for UnknownCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "there is no diagnostic code `{}`", self.name)?;
        if let Some(suggestion) = self.suggestion {
            write!(f, "; did you mean `{suggestion}`?")?;
        }
        Ok(())
    }
}

impl std::error::Error for UnknownCode {}

impl Levels {
    /// Repairs are warnings.
    pub fn lenient() -> Self {
        Levels::default()
    }

    /// Repairs are errors.
    pub fn strict() -> Self {
        Levels { strict: true, ..Levels::default() }
    }

    /// Sets the level of a code, named by its identifier (`EDS020`), its name (`octal-number`), or of all `warnings`.
    ///
    /// An error that left nothing to work with ([`Class::Error`]) stays an error whatever its level.
    ///
    /// # Errors
    ///
    /// When no code has that name.
    pub fn set(&mut self, name: &str, level: Level) -> Result<(), UnknownCode> {
        if name == "warnings" {
            self.warnings = Some(level);
            return Ok(());
        }
        match codes::find(name) {
            Some(code) => {
                self.by_code.insert(code.id, level);
                Ok(())
            }
            None => Err(UnknownCode { name: name.into(), suggestion: codes::similar(name) }),
        }
    }

    /// Whether a user set a level of this code by its name, at which it is reported.
    pub(super) fn asks_for(&self, code: &Code) -> bool {
        self.by_code.get(code.id).is_some_and(|level| *level != Level::Allow)
    }

    /// The severity of findings of this kind; `None` when they aren't reported.
    pub fn severity(&self, code: &'static Code) -> Option<Severity> {
        if code.class == Class::Error {
            return Some(Severity::Error);
        }
        let level = match self.by_code.get(code.id) {
            Some(&level) => level,
            None if self.strict && code.class == Class::Repair => Level::Deny,
            None => match (code.default, self.warnings) {
                (Level::Warn, Some(level)) => level,
                (default, _) => default,
            },
        };
        match level {
            Level::Allow => None,
            Level::Warn => Some(Severity::Warning),
            Level::Deny => Some(Severity::Error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repair_is_an_error_in_strict_mode_unless_its_code_is_set() {
        let mut levels = Levels::strict();
        assert_eq!(levels.severity(&codes::OCTAL_NUMBER), Some(Severity::Error));
        levels.set("octal-number", Level::Warn).unwrap();
        assert_eq!(levels.severity(&codes::OCTAL_NUMBER), Some(Severity::Warning));
        levels.set("EDS020", Level::Allow).unwrap();
        assert_eq!(levels.severity(&codes::OCTAL_NUMBER), None);
    }

    #[test]
    fn warnings_names_what_would_be_a_warning_and_errors_stay_errors() {
        let mut levels = Levels::lenient();
        levels.set("warnings", Level::Deny).unwrap();
        assert_eq!(levels.severity(&codes::SUB0_MISMATCH), Some(Severity::Error));
        assert_eq!(levels.severity(&codes::UNKNOWN_KEY), None);
        levels.set("EDS001", Level::Allow).unwrap();
        assert_eq!(levels.severity(&codes::ETHERNET_IP_EDS), Some(Severity::Error));
    }

    #[test]
    fn an_unknown_code_comes_with_a_suggestion() {
        let error = Levels::lenient().set("octal-numer", Level::Deny).unwrap_err();
        assert_eq!(error.to_string(), "there is no diagnostic code `octal-numer`; did you mean `octal-number`?");
    }
}

//! Lenient and strict mode, and the levels that the user sets for codes.

use std::collections::BTreeMap;
use std::fmt;

use super::codes::{self, Class, Code};
use super::Severity;

/// The level of a diagnostic code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// Diagnostics with the code are not reported.
    Allow,
    /// Diagnostics with the code are reported as warnings.
    Warn,
    /// Diagnostics with the code are reported as errors.
    Deny,
}

/// Levels of all codes in one compilation.
///
/// The level of a code takes precedence over the mode. If a level is set twice, the last setting applies. The name
/// `warnings` means all codes that are warnings by default. Codes whose level is set individually are excluded, and so are
/// repairs in strict mode.
#[derive(Clone, Debug, Default)]
pub struct Levels {
    strict: bool,
    warnings: Option<Level>,
    by_code: BTreeMap<&'static str, Level>,
}

/// Error if a level is set for a code that does not exist.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownCode {
    /// Name for which no code exists.
    pub name: String,
    /// Most similar identifier or name of an existing code; `None` if none is similar enough.
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
    /// Creates the levels of lenient mode, in which repairs are warnings.
    pub fn lenient() -> Self {
        Levels::default()
    }

    /// Creates the levels of strict mode, in which repairs are errors.
    pub fn strict() -> Self {
        Levels { strict: true, ..Levels::default() }
    }

    /// Sets the level of a code by identifier (`EDS020`) or name (`octal-number`), or of all `warnings`.
    ///
    /// A code of [`Class::Error`] is an error at any level.
    ///
    /// # Errors
    ///
    /// Fails if `name` is neither `warnings` nor the identifier or name of a code.
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

    /// Returns whether the user set a level for this code, other than [`Level::Allow`].
    pub(super) fn asks_for(&self, code: &Code) -> bool {
        self.by_code.get(code.id).is_some_and(|level| *level != Level::Allow)
    }

    /// Returns the severity of a code, or `None` if the code is not reported.
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
    fn warnings_means_all_default_warnings_and_errors_remain_errors() {
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

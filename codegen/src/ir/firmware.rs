//! Comparison of firmware versions and of availability.

use std::cmp::Ordering;

use super::{Availability, CompactString};
use crate::text::glob;

/// Returns the numbers of a version without trailing zeros: `6.27` is later than `6.3`, and `6` is `6.0`. Returns `None` if the
/// version does not consist of numbers separated by points.
pub(crate) fn version(text: &str) -> Option<Vec<u32>> {
    let mut numbers = text.split('.').map(|part| part.parse().ok()).collect::<Option<Vec<u32>>>()?;
    while numbers.len() > 1 && numbers.last() == Some(&0) {
        numbers.pop();
    }
    Some(numbers)
}

/// Compares two versions. Returns `None` if a version is missing or does not consist of numbers separated by points.
pub(crate) fn compare(one: Option<&str>, other: Option<&str>) -> Option<Ordering> {
    Some(version(one?)?.cmp(&version(other?)?))
}

/// Returns whether two elements never exist together, because they have no model or no firmware version in common.
pub(crate) fn apart(one: Option<&Availability>, other: Option<&Availability>) -> bool {
    let (Some(one), Some(other)) = (one, other) else { return false };
    let before = |first: &Availability, second: &Availability| {
        compare(first.until.as_deref(), second.since.as_deref()).is_some_and(|order| order != Ordering::Greater)
    };
    let shared =
        |pattern: &CompactString| other.models.iter().any(|other| glob(pattern, other) || glob(other, pattern));
    let models = !one.models.is_empty() && !other.models.is_empty() && !one.models.iter().any(shared);
    models || before(one, other) || before(other, one)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_compare_as_numbers() {
        assert!(version("6.27") > version("6.3") && version("10") > version("9.99") && version("6") == version("6.0"));
        for text in ["Fw710", "6,15", "", "6.", "v6"] {
            assert_eq!(version(text), None, "{text}");
        }
    }

    #[test]
    fn elements_of_other_versions_or_models_never_exist_together() {
        let window = |since: Option<&str>, until: Option<&str>, models: &[&str]| Availability {
            since: since.map(Into::into),
            until: until.map(Into::into),
            models: models.iter().map(|&model| model.into()).collect(),
            ..Availability::default()
        };
        let old = window(None, Some("6.15"), &[]);
        assert!(apart(Some(&old), Some(&window(Some("6.15"), None, &[]))));
        assert!(!apart(Some(&old), Some(&window(Some("6.3"), None, &[]))));
        assert!(!apart(Some(&old), None));
        assert!(apart(Some(&window(None, None, &["SMD22*"])), Some(&window(None, None, &["BMD*"]))));
        assert!(!apart(Some(&window(None, None, &["SMD*"])), Some(&window(None, None, &["SMD2204"]))));
    }
}

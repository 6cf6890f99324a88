//! Names in a DBC file.

use std::collections::HashSet;

/// Maximum length of a name. A longer name is shortened, and an attribute contains its long form.
const MAX_NAME: usize = 32;

/// Maximum length of a name in an attribute.
const MAX_LONG_NAME: usize = 128;

/// Name of the master.
pub(super) const MASTER: &str = "master";

/// Names that are not available: the name of the master, and keywords of DBC.
const RESERVED: [&str; 3] = [MASTER, "FILTER", "VERSION"];

/// A name in two forms: short (at most [`MAX_NAME`] characters) and long (at most [`MAX_LONG_NAME`] characters). Both forms are equal
/// if the long form has at most [`MAX_NAME`] characters.
pub(super) struct Name {
    pub short: String,
    pub long: String,
}

/// Names that are in use, short and long ones.
#[derive(Default)]
pub(super) struct Names(HashSet<String>);

impl Names {
    /// Returns the name for a text: ASCII letters, digits and `_`. A name that is reserved or already in use gets a number.
    /// The numbers of the long form and of the short form can differ.
    pub fn unique(&mut self, text: &str) -> Name {
        let whole = identifier(text);
        let long = self.free(&whole, MAX_LONG_NAME);
        let short = if long.len() > MAX_NAME { self.free(&whole, MAX_NAME) } else { long.clone() };
        Name { short, long }
    }

    /// Returns a name with at most `longest` characters that is not reserved and not in use yet.
    fn free(&mut self, name: &str, longest: usize) -> String {
        let mut free: String = name.chars().take(longest).collect();
        let mut number = 2;
        while RESERVED.contains(&free.as_str()) || !self.0.insert(free.clone()) {
            let suffix = format!("_{number}");
            free = name.chars().take(longest - suffix.len()).collect::<String>() + &suffix;
            number += 1;
        }
        free
    }
}

/// Converts a text to a DBC identifier.
fn identifier(text: &str) -> String {
    let mut name = String::new();
    for letter in text.chars() {
        match letter.is_ascii_alphanumeric() {
            true => name.push(letter),
            false if !name.ends_with('_') && !name.is_empty() => name.push('_'),
            false => {}
        }
    }
    let name = name.trim_end_matches('_').to_owned();
    match name.chars().next() {
        None => "_".to_owned(),
        Some(first) if first.is_ascii_digit() => format!("_{name}"),
        Some(_) => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_are_unique_and_short() {
        let mut names = Names::default();
        assert_eq!(names.unique("Target velocity (rpm)").short, "Target_velocity_rpm");
        assert_eq!(names.unique("Target velocity, rpm").short, "Target_velocity_rpm_2");
        assert_eq!(names.unique("1st").short, "_1st");
        assert_eq!(names.unique("°").short, "_");
        assert_eq!(names.unique("master").short, "master_2");
        assert_eq!(names.unique("FILTER").short, "FILTER_2");
        let long = names.unique("A very long name of a parameter of a drive");
        assert_eq!((long.short.len(), long.long.as_str()), (32, "A_very_long_name_of_a_parameter_of_a_drive"));
    }

    #[test]
    fn long_names_are_unique_too() {
        let mut names = Names::default();
        let texts = ["A very long name of a parameter of a drive", "A very long name of a parameter of a motor"];
        let found = [texts[0], texts[0], texts[1]].map(|text| names.unique(text));
        let both = found.each_ref().map(|name| (name.short.as_str(), name.long.as_str()));
        let expected = [
            ("A_very_long_name_of_a_parameter_", "A_very_long_name_of_a_parameter_of_a_drive"),
            ("A_very_long_name_of_a_paramete_2", "A_very_long_name_of_a_parameter_of_a_drive_2"),
            ("A_very_long_name_of_a_paramete_3", "A_very_long_name_of_a_parameter_of_a_motor"),
        ];
        assert_eq!(both, expected);
        let [one, other] = [1, 2].map(|_| names.unique(&"x".repeat(200)));
        assert_eq!((one.long.len(), other.long.len(), other.long.ends_with("x_2")), (128, 128, true));
    }
}

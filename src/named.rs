//! Conversion between the values of generated enumerations and their names.

use core::error;
use core::fmt;
use core::str::FromStr;

use crate::enumeration::Enumeration;
use crate::value::Value;

/// An enumeration whose values have names. Generated enumerations implement this trait.
///
/// ```
/// use lexibus::{display_name, parse_name, Enumeration, Named};
///
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// enum Mode {
///     Off,
///     Unknown(u8),
/// }
/// # impl Enumeration for Mode {
/// #     type Base = u8;
/// #     fn from_native(native: u8) -> Self { if native == 0 { Mode::Off } else { Mode::Unknown(native) } }
/// #     fn native(self) -> u8 { if let Mode::Unknown(other) = self { other } else { 0 } }
/// # }
///
/// impl Named for Mode {
///     const NAMES: &'static [(Self, &'static str)] = &[(Mode::Off, "off")];
/// }
///
/// impl std::fmt::Display for Mode {
///     fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
///         display_name(*self, f)
///     }
/// }
///
/// assert_eq!((Mode::Off.to_string(), Mode::Unknown(7).to_string()), ("off".into(), "7".into()));
/// assert_eq!((parse_name("Off"), parse_name("7")), (Ok(Mode::Off), Ok(Mode::Unknown(7))));
/// assert!(parse_name::<Mode>("on").is_err());
/// ```
pub trait Named: Enumeration {
    /// The named values and their names in the device description, in the order of the description.
    const NAMES: &'static [(Self, &'static str)];
}

/// The text is neither the name of a value nor an integer that the type can represent. For states and commands, only
/// names are valid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct UnknownName;

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the text is not a value of this type")
    }
}

impl error::Error for UnknownName {}

/// Writes the name of a value, or its integer in decimal if the value has no name. Generated code calls this function.
///
/// # Errors
///
/// Returns the errors of the formatter.
pub fn display_name<E: Named>(value: E, f: &mut fmt::Formatter<'_>) -> fmt::Result
where
    <E::Base as Value>::Native: PartialEq + fmt::Display,
{
    let raw = value.native();
    match E::NAMES.iter().find(|(named, name)| named.native() == raw && !name.is_empty()) {
        Some((_, name)) => f.pad(name),
        None => fmt::Display::fmt(&raw, f),
    }
}

/// Returns the value with this name. If several values have the name, the function returns the first. The comparison
/// ignores the case of ASCII letters and treats underscores as spaces. Generated states and commands call this
/// function.
///
/// # Errors
///
/// Returns [`UnknownName`] if no value has the name.
pub fn find_name<T: Copy>(names: &[(T, &str)], text: &str) -> Result<T, UnknownName> {
    fn letters(text: &str) -> impl Iterator<Item = u8> + '_ {
        text.bytes().map(|byte| if byte == b'_' { b' ' } else { byte.to_ascii_lowercase() })
    }
    let found = names.iter().find(|(_, name)| !name.is_empty() && letters(name).eq(letters(text)));
    found.map(|(value, _)| *value).ok_or(UnknownName)
}

/// Parses the name of a value, as [`find_name`] does, or a decimal integer. Generated code calls this function. If
/// several values have the name, the function returns the first.
///
/// # Errors
///
/// Returns [`UnknownName`] if `text` is neither the name of a value nor an integer that the type can represent.
pub fn parse_name<E: Named>(text: &str) -> Result<E, UnknownName>
where
    <E::Base as Value>::Native: PartialEq + FromStr,
{
    if let Ok(value) = find_name(E::NAMES, text) {
        return Ok(value);
    }
    let raw = text.parse().map_err(|_| UnknownName)?;
    // An enumeration without the variant `Unknown` ignores the bits beyond its width.
    Some(E::from_native(raw)).filter(|value| value.native() == raw).ok_or(UnknownName)
}

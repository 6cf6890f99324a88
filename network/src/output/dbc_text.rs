//! Texts in a DBC file: strings without escapes, in Windows-1252, which is the encoding of DBC files.

use encoding_rs::WINDOWS_1252;

/// Spellings of characters that Windows-1252 does not have, and of the backslash.
const SPELLINGS: [(&str, &str); 21] = [
    ("\u{2126}Ω", "Ohm"),
    ("μ", "µ"),
    ("\u{212B}", "Å"),
    ("\u{212A}", "K"),
    ("℃", "°C"),
    ("℉", "°F"),
    ("\u{2010}\u{2011}\u{2212}", "-"),
    ("⋅∙", "·"),
    ("∕⁄", "/"),
    ("′", "'"),
    ("″", "''"),
    ("≤", "<="),
    ("≥", ">="),
    ("≠", "!="),
    ("≈", "~"),
    ("→", "->"),
    ("←", "<-"),
    ("∞", "inf"),
    ("Δ\u{2206}", "Delta"),
    ("\u{200B}\u{FEFF}", ""),
    // DBC strings have no escape for a backslash.
    ("\\", "/"),
];

/// Superscript digits and signs.
const EXPONENTS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻";

/// Subscript digits and signs.
const INDICES: &str = "₀₁₂₃₄₅₆₇₈₉₊₋";

/// The digits and signs of the lists above as normal characters, in the same order.
const ON_LINE: &str = "0123456789+-";

/// Returns a text as the content of a DBC string, without the enclosing quotation marks. Windows-1252 lacks some characters.
/// These are spelled with other characters (`min⁻¹`: `min^-1`, `Ω`: `Ohm`), left out, or replaced with `?`. Quotation marks,
/// backslashes, whitespace and control characters are replaced.
pub(super) fn text(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let exponent = rest.find(|letter| !EXPONENTS.contains(letter)).unwrap_or(rest.len());
        if exponent > 0 {
            out += &of_exponent(&rest[..exponent]);
            rest = &rest[exponent..];
        } else {
            out += &of_letter(first);
            rest = &rest[first.len_utf8()..];
        }
    }
    out
}

/// Returns an exponent unchanged if Windows-1252 has all of its characters. Otherwise, returns `^` and the normal
/// characters.
fn of_exponent(exponent: &str) -> String {
    match exponent.chars().all(exists) {
        true => exponent.to_owned(),
        false => exponent
            .chars()
            .filter_map(|letter| on_line(EXPONENTS, letter))
            .fold("^".to_owned(), |text, letter| text + letter),
    }
}

fn of_letter(letter: char) -> String {
    if let Some((_, spelling)) = SPELLINGS.iter().find(|(letters, _)| letters.contains(letter)) {
        return (*spelling).to_owned();
    }
    match letter {
        '"' => "'".to_owned(),
        _ if letter.is_whitespace() || letter.is_control() => " ".to_owned(),
        _ if exists(letter) => letter.to_string(),
        _ => on_line(INDICES, letter).unwrap_or("?").to_owned(),
    }
}

/// Returns the normal character for a character of `list`, or `None` if the list does not contain the character.
fn on_line(list: &str, letter: char) -> Option<&'static str> {
    let at = list.chars().position(|other| other == letter)?;
    ON_LINE.get(at..=at)
}

/// Returns whether Windows-1252 contains this character.
fn exists(letter: char) -> bool {
    let (_, _, is_missing) = WINDOWS_1252.encode(letter.encode_utf8(&mut [0; 4]));
    !is_missing
}

/// Returns a file in Windows-1252. All strings of the file must be ASCII, or results of [`text`].
pub(super) fn encoded(file: &str) -> Vec<u8> {
    WINDOWS_1252.encode(file).0.into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_of_windows_1252_are_kept() {
        let kept = "µm, °C, m/s², mm³, Größe, € 5 – 7 …";
        assert_eq!(text(kept), kept);
        assert_eq!(encoded("µ°²€"), [0xB5, 0xB0, 0xB2, 0x80]);
    }

    #[test]
    fn other_characters_are_spelled() {
        assert_eq!(text("min⁻¹"), "min^-1");
        assert_eq!(text("10⁻³ kΩ, 10⁶, m²s⁻²"), "10^-3 kOhm, 10^6, m²s^-2");
        assert_eq!(text("μm, R₁₂ ≤ 5\u{202F}\u{2126}"), "µm, R12 <= 5 Ohm");
        assert_eq!(text("温度"), "??");
        assert_eq!(text("\"a\"\r\nC:\\b\\\u{81}"), "'a'  C:/b/ ");
        assert!(text(&(0..0x3000).filter_map(char::from_u32).collect::<String>()).chars().all(exists));
    }
}

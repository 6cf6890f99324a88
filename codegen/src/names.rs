//! The namer: gives every element a Rust identifier that is unique in its scope, legal, and stable.
//!
//! An item has one name in generated code: its constant, its accessor, its entry of `mappable` and the field of a PDO that maps it are called
//! alike, after the name of the object in the dictionary. What a PDO calls an entry counts only if the dictionary doesn't have the object.
//!
//! Identifiers are the source's names in Rust's case. Of elements with equal names each gets its address as a suffix, so
//! that neither the order of anything nor a further element with that name changes an identifier that had one before.

use std::borrow::Cow;
use std::collections::HashMap;
use std::collections::HashSet;

use crate::limits::MAX_IDENTIFIER;

/// How a scope's identifiers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// `target_position`: methods, fields and modules.
    Snake,
    /// `TargetPosition`: types.
    Pascal,
}

/// An element that wants a name.
#[derive(Clone, Debug)]
pub struct Wish<'a> {
    /// What the source calls it.
    pub name: &'a str,
    /// What to call it where the source has no usable name, such as `object_6040`.
    pub fallback: String,
    /// What tells it from others of its name, such as `6040`; unique in the scope.
    pub suffix: String,
}

impl<'a> Wish<'a> {
    /// Of an element that `suffix` tells from others, and that goes by it and its kind where it has no usable name.
    pub fn new(name: &'a str, kind: &str, suffix: impl ToString) -> Self {
        let suffix = suffix.to_string();
        Wish { name, fallback: format!("{kind} {suffix}"), suffix }
    }
}

/// Wishes for elements of a kind that nothing but their position tells apart, which is counted from 0.
pub fn numbered<'a>(names: impl IntoIterator<Item = &'a str>, kind: &str) -> Vec<Wish<'a>> {
    names.into_iter().enumerate().map(|(position, name)| Wish::new(name, kind, position)).collect()
}

/// Identifiers for all of `wishes`, in their order; none of them is in `reserved`. Longer names are cut at a word.
pub fn unique(wishes: &[Wish<'_>], reserved: &[&str], case: Case) -> Vec<String> {
    unique_up_to(wishes, reserved, case, MAX_IDENTIFIER)
}

/// The same, with names cut to `length` characters before they get a suffix.
pub fn unique_up_to(wishes: &[Wish<'_>], reserved: &[&str], case: Case, length: usize) -> Vec<String> {
    let plain: Vec<String> = wishes.iter().map(|wish| plain(wish, case, length)).collect();
    distinct(&plain, wishes.iter().map(|wish| wish.suffix.as_str()), reserved, case)
}

/// The identifier of an element that is alone in its scope.
pub fn identifier(wish: &Wish<'_>, case: Case) -> String {
    plain(wish, case, MAX_IDENTIFIER)
}

/// The identifier of an element outside of its owner: that of the owner in front of its own. A long one is cut at a word.
pub fn joined(owner: &str, name: &str) -> String {
    let mut joined = prefixed(&format!("{owner}_"), name);
    cut(&mut joined, MAX_IDENTIFIER);
    joined
}

/// Tells equal identifiers apart by their suffixes; none of the results is in `reserved`.
pub fn distinct<'s>(
    plain: &[String],
    suffixes: impl Iterator<Item = &'s str>,
    reserved: &[&str],
    case: Case,
) -> Vec<String> {
    let mut count: HashMap<&str, usize> = HashMap::with_capacity(plain.len());
    for name in plain {
        *count.entry(name).or_default() += 1;
    }
    let is_reserved = |name: &str| reserved.contains(&name);
    // Names that are unique by themselves come first, so that a suffixed one never takes their place.
    let mut taken: HashSet<String> =
        plain.iter().filter(|name| count[name.as_str()] == 1 && !is_reserved(name)).cloned().collect();
    let mut names = Vec::with_capacity(plain.len());
    // The last number behind a name that two suffixes didn't make unique.
    let mut numbers: HashMap<String, u32> = HashMap::new();
    for (suffix, name) in suffixes.zip(plain) {
        if count[name.as_str()] == 1 && !is_reserved(name) {
            names.push(name.clone());
            continue;
        }
        let suffix = address(suffix);
        let once = join(name, &suffix, case);
        let mut take = |candidate: &str| !is_reserved(candidate) && taken.insert(candidate.to_owned());
        if take(&once) {
            names.push(once);
            continue;
        }
        let twice = join(&once, &suffix, case);
        if take(&twice) {
            names.push(twice);
            continue;
        }
        let number = numbers.entry(twice.clone()).or_insert(2);
        names.push(loop {
            *number += 1;
            let candidate = join(&twice, &number.to_string(), case);
            if take(&candidate) {
                break candidate;
            }
        });
    }
    names
}

fn plain(wish: &Wish<'_>, case: Case, length: usize) -> String {
    let words = words(wish.name);
    // A fallback is an address, which is no text to find words in. Whoever has none wants no name then.
    let parts = wish.fallback.split(' ').filter(|part| !part.is_empty());
    let words = if words.is_empty() { parts.map(|part| address(part).to_ascii_lowercase()).collect() } else { words };
    let mut name = write(&words, case);
    cut(&mut name, length);
    name
}

/// Cuts a long name, at a word where one ends in the second half, so that the rest still reads as a name.
fn cut(name: &mut String, length: usize) {
    if name.len() > length {
        let end = name[..length].rfind('_').filter(|&end| end > length / 2).unwrap_or(length);
        name.truncate(end);
    }
}

/// An address as a part of an identifier: as it is, or where it names something else its words. It is never empty.
fn address(text: &str) -> Cow<'_, str> {
    let is_plain = text.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
    if is_plain && text.contains(|letter: char| letter != '_') {
        return text.into();
    }
    let words = words(text);
    if words.is_empty() {
        "other".into()
    } else {
        words.join("_").into()
    }
}

fn join(name: &str, suffix: &str, case: Case) -> String {
    match case {
        Case::Snake => format!("{}_{}", name.trim_end_matches('_'), suffix.to_ascii_lowercase()),
        Case::Pascal => {
            let is_digit = |letter: char| letter.is_ascii_digit();
            // Only between digits is it no camel case without.
            let separator = if name.ends_with(is_digit) && suffix.starts_with(is_digit) { "_" } else { "" };
            format!("{name}{separator}{suffix}")
        }
    }
}

fn write(words: &[String], case: Case) -> String {
    let mut name = String::new();
    for word in words {
        match case {
            Case::Snake => {
                if !name.is_empty() {
                    name.push('_');
                }
                name.push_str(word);
            }
            Case::Pascal => {
                // Two numbers side by side must not become another number.
                let digits =
                    name.ends_with(|c: char| c.is_ascii_digit()) && word.starts_with(|c: char| c.is_ascii_digit());
                if digits {
                    name.push('_');
                }
                let mut letters = word.chars();
                name.extend(letters.next().map(|first| first.to_ascii_uppercase()));
                name.push_str(letters.as_str());
            }
        }
        if name.len() >= MAX_IDENTIFIER {
            break;
        }
    }
    if name.starts_with(|c: char| c.is_ascii_digit()) {
        name.insert(0, '_');
    }
    name
}

/// The words of a name in lower-case ASCII: split at everything that is no letter or digit, and where the case changes.
fn words(name: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word = String::new();
    let mut previous = Kind::Other;
    let mut letters = name.chars().peekable();
    while let Some(letter) = letters.next() {
        let kind = Kind::of(letter);
        let next = letters.peek().map_or(Kind::Other, |&next| Kind::of(next));
        let starts = match (previous, kind) {
            (_, Kind::Other) => true,
            (Kind::Lower | Kind::Digit, Kind::Upper) => true,
            // The last capital of an abbreviation starts the next word: `PDOMapping`, but not `RxPDOs`.
            (Kind::Upper, Kind::Upper) => next == Kind::Lower && !is_plural(letters.clone()),
            _ => false,
        };
        if starts && !word.is_empty() {
            words.push(std::mem::take(&mut word));
        }
        match kind {
            Kind::Other => spell(letter, &mut words),
            _ => push_ascii(letter, &mut word),
        }
        previous = kind;
    }
    if !word.is_empty() {
        words.push(word);
    }
    for word in &mut words {
        word.truncate(MAX_IDENTIFIER);
    }
    words
}

/// Whether what is left of a word is the `s` of several.
fn is_plural(mut rest: impl Iterator<Item = char>) -> bool {
    rest.next() == Some('s') && rest.next().is_none_or(|behind| Kind::of(behind) != Kind::Lower)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Lower,
    Upper,
    Digit,
    Other,
}

impl Kind {
    fn of(letter: char) -> Self {
        match letter {
            'a'..='z' => Kind::Lower,
            'A'..='Z' => Kind::Upper,
            '0'..='9' => Kind::Digit,
            _ if transliteration(letter).is_empty() => Kind::Other,
            _ if letter.is_uppercase() => Kind::Upper,
            _ => Kind::Lower,
        }
    }
}

fn push_ascii(letter: char, word: &mut String) {
    if letter.is_ascii() {
        word.push(letter.to_ascii_lowercase());
    } else {
        word.push_str(transliteration(letter));
    }
}

/// Signs that carry a meaning become a word; all others only separate words.
fn spell(sign: char, words: &mut Vec<String>) {
    let word = match sign {
        '%' => "percent",
        '°' => "deg",
        'Ω' | '\u{2126}' => "ohm",
        '²' => "2",
        '³' => "3",
        '€' => "eur",
        _ => return,
    };
    words.push(word.to_owned());
}

/// ASCII letters for a letter of a European language or a prefix of a unit; empty for any other.
fn transliteration(letter: char) -> &'static str {
    match letter {
        'ä' | 'Ä' | 'æ' | 'Æ' => "ae",
        'ö' | 'Ö' | 'ø' | 'Ø' | 'œ' | 'Œ' => "oe",
        'ü' | 'Ü' => "ue",
        'ß' => "ss",
        'å' | 'Å' | 'à' | 'À' | 'á' | 'Á' | 'â' | 'Â' | 'ã' | 'Ã' | 'ą' | 'Ą' => "a",
        'ç' | 'Ç' | 'č' | 'Č' | 'ć' | 'Ć' => "c",
        'è' | 'È' | 'é' | 'É' | 'ê' | 'Ê' | 'ë' | 'Ë' | 'ę' | 'Ę' | 'ě' | 'Ě' => "e",
        'ì' | 'Ì' | 'í' | 'Í' | 'î' | 'Î' | 'ï' | 'Ï' => "i",
        'ł' | 'Ł' => "l",
        'ñ' | 'Ñ' | 'ń' | 'Ń' => "n",
        'ò' | 'Ò' | 'ó' | 'Ó' | 'ô' | 'Ô' | 'õ' | 'Õ' => "o",
        'ř' | 'Ř' => "r",
        'š' | 'Š' | 'ś' | 'Ś' => "s",
        'ù' | 'Ù' | 'ú' | 'Ú' | 'û' | 'Û' | 'ů' | 'Ů' => "u",
        'ý' | 'Ý' => "y",
        'ž' | 'Ž' | 'ź' | 'Ź' | 'ż' | 'Ż' => "z",
        'µ' | 'μ' => "u",
        'α' => "alpha",
        'β' => "beta",
        'Δ' | 'δ' => "delta",
        'φ' => "phi",
        'ω' => "omega",
        _ => "",
    }
}

/// `name` behind a prefix that is a word of its own, such as `set_`: without what keywords, and names that start with a digit, have in
/// front.
pub fn prefixed(prefix: &str, name: &str) -> String {
    format!("{prefix}{}", name.trim_start_matches("r#").trim_start_matches('_'))
}

/// `name` as it has to be written where an identifier is wanted: raw where it is a keyword of any edition.
pub fn escaped(name: &str) -> String {
    const KEYWORDS: [&str; 48] = [
        "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "do", "dyn", "else", "enum",
        "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod",
        "move", "mut", "override", "priv", "pub", "ref", "return", "static", "struct", "trait", "true", "try", "type",
        "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
    ];
    match name {
        "self" | "super" | "crate" | "Self" | "_" => format!("{name}_"),
        _ if KEYWORDS.contains(&name) => format!("r#{name}"),
        _ => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn snake(name: &str) -> String {
        write(&words(name), Case::Snake)
    }

    #[test]
    fn names_become_words() {
        assert_eq!(snake("Target Position"), "target_position");
        assert_eq!(snake("PDOMapping"), "pdo_mapping");
        assert_eq!(snake("NrOfObjects"), "nr_of_objects");
        assert_eq!(
            (snake("NrOfRxPDOs"), snake("IDsOfIOs"), snake("PDOsize")),
            ("nr_of_rx_pdos".into(), "ids_of_ios".into(), "pd_osize".into())
        );
        assert_eq!(snake("RPDO1"), "rpdo1");
        assert_eq!(snake("Gerätetemperatur [°C] 50%"), "geraetetemperatur_deg_c_50_percent");
        assert_eq!(snake("2nd encoder"), "_2nd_encoder");
        assert_eq!(snake("µs/rev"), "us_rev");
        assert_eq!(snake("type"), "type");
        assert_eq!(snake("日本"), "");
        assert_eq!(write(&words("Vector Step 50 06"), Case::Pascal), "VectorStep50_06");
        assert!(snake(&"very ".repeat(100)).len() <= MAX_IDENTIFIER + 5);
        assert_eq!(snake(&"x".repeat(300)).len(), MAX_IDENTIFIER);
    }

    #[test]
    fn names_that_suffixes_dont_tell_apart_are_counted() {
        let names = names(&[("a", "1"), ("a", "1"), ("a", "1"), ("a_1_1_3", "x"), ("a", "1"), ("a", "2")]);
        assert_eq!(names, ["a_1", "a_1_1", "a_1_1_4", "a_1_1_3", "a_1_1_5", "a_2"]);
        let many = vec![("a", "1"); 20_000];
        assert!(self::names(&many).iter().all(|name| name.len() < 16), "none grows with their number");
    }

    fn names(wanted: &[(&str, &str)]) -> Vec<String> {
        let wishes: Vec<Wish<'_>> = wanted.iter().map(|&(name, suffix)| Wish::new(name, "object", suffix)).collect();
        unique(&wishes, &["new"], Case::Snake)
    }

    #[test]
    fn equal_names_all_get_their_address() {
        assert_eq!(names(&[("A", "2000"), ("b", "2001"), ("a", "2002")]), ["a_2000", "b", "a_2002"]);
        assert_eq!(names(&[("", "2000"), ("?!", "200A"), ("new", "2002")]), ["object_2000", "object_200a", "new_2002"]);
    }

    #[test]
    fn a_suffixed_name_never_takes_one_that_is_there() {
        let got = names(&[("a 2000", "1000"), ("a", "2000"), ("a", "2001")]);
        assert_eq!(got, ["a_2000", "a_2000_2000", "a_2001"]);
    }

    #[test]
    fn suffixes_of_any_text_are_parts_of_identifiers() {
        let got = names(&[("a", "Chapter/Speed_64"), ("a", "\u{65e5}"), ("", "\u{df}_2"), ("new", "__"), ("new", "")]);
        assert_eq!(got, ["a_chapter_speed_64", "a_other", "object_ss_2", "new_other", "new_other_other"]);
        let wishes = [Wish::new("A 2", "object", "U64"), Wish::new("a2", "object", "7")];
        assert_eq!(unique(&wishes, &[], Case::Pascal), ["A2U64", "A2_7"], "camel case has lines between digits only");
    }

    #[test]
    fn prefixes_stand_in_front_of_words() {
        let got = ["speed", "_2nd", "r#type"].map(|name| prefixed("set_", name));
        assert_eq!(got, ["set_speed", "set_2nd", "set_type"]);
    }

    #[test]
    fn keywords_are_raw() {
        assert_eq!(escaped("type"), "r#type");
        assert_eq!(escaped("self"), "self_");
        assert_eq!(escaped("union"), "union");
        assert_eq!(escaped("position"), "position");
    }
}

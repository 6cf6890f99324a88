//! The namer: gives every element a Rust identifier that is valid, stable, and unique in its scope.
//!
//! An item has one name in generated code. Its constant, its accessor, its entry in `mappable`, and each PDO field that maps it
//! have the name of the object in the dictionary. The name in the PDO is used only if the dictionary does not contain the object.
//!
//! Identifiers are the names of the description, converted to the case that Rust uses. If several elements have the same name, each
//! gets a suffix: its address, or its position if it has no address. With addresses, the order of elements does not affect
//! identifiers. A new element then changes only the identifiers of elements with the same name.

use crate::collections::HashSet;
use crate::collections::{HashMap, HashMapExt};
use std::borrow::Cow;

use crate::limits::MAX_IDENTIFIER;

/// The case of the identifiers in a scope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// Snake case for methods, fields and modules: `target_position`.
    Snake,
    /// Pascal case for types: `TargetPosition`.
    Pascal,
}

/// An element that needs an identifier.
#[derive(Clone, Debug)]
pub struct NameRequest<'a> {
    /// Name of the element in the description.
    pub name: &'a str,
    /// Name such as `object 6040`, which is used if the name in the description has no words.
    pub fallback: String,
    /// Suffix, such as `6040`, that distinguishes the element from others with the same name. No other element in the scope has
    /// the same suffix.
    pub suffix: String,
}

impl<'a> NameRequest<'a> {
    /// Creates the name request of an element. The fallback name consists of `kind` and `suffix`.
    pub fn new(name: &'a str, kind: &str, suffix: impl ToString) -> Self {
        let suffix = suffix.to_string();
        NameRequest { name, fallback: format!("{kind} {suffix}"), suffix }
    }
}

/// Returns name requests for elements of one kind. The suffix of an element is its position, counted from 0.
pub fn numbered<'a>(names: impl IntoIterator<Item = &'a str>, kind: &str) -> Vec<NameRequest<'a>> {
    names.into_iter().enumerate().map(|(position, name)| NameRequest::new(name, kind, position)).collect()
}

/// Returns unique identifiers for `name_requests`, in the same order. None of the identifiers is in `reserved`. Names with more
/// than [`MAX_IDENTIFIER`] characters are cut, if possible at the end of a word.
pub fn unique<'a>(
    name_requests: impl IntoIterator<Item = NameRequest<'a>>,
    reserved: &[&str],
    case: Case,
) -> Vec<String> {
    unique_up_to(name_requests, reserved, case, MAX_IDENTIFIER)
}

/// Returns unique identifiers like [`unique`], with names cut to `length` characters before they get a suffix.
pub fn unique_up_to<'a>(
    name_requests: impl IntoIterator<Item = NameRequest<'a>>,
    reserved: &[&str],
    case: Case,
    length: usize,
) -> Vec<String> {
    let name_requests = name_requests.into_iter();
    let (plain, suffixes): (Vec<String>, Vec<String>) =
        name_requests.map(|name_request| (plain(&name_request, case, length), name_request.suffix)).unzip();
    distinct(&plain, suffixes.iter().map(String::as_str), reserved, case)
}

/// Returns the identifier of an element that is the only one in its scope.
pub fn identifier(name_request: &NameRequest<'_>, case: Case) -> String {
    plain(name_request, case, MAX_IDENTIFIER)
}

/// Returns the identifier of an element outside of its owner: the owner's name followed by the element's name. A long identifier is
/// cut, if possible at the end of a word.
pub fn joined(owner: &str, name: &str) -> String {
    let mut joined = prefixed(&format!("{owner}_"), name);
    cut(&mut joined, MAX_IDENTIFIER);
    joined
}

/// Makes equal and reserved identifiers unique: appends the suffix of the element, if necessary a second time. If the result is
/// still not unique, also appends a number. None of the resulting identifiers is in `reserved`.
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
    // Names that are already unique are reserved first, so that no suffixed name can equal one of them.
    let mut used: HashSet<String> =
        plain.iter().filter(|name| count[name.as_str()] == 1 && !is_reserved(name)).cloned().collect();
    let mut names = Vec::with_capacity(plain.len());
    // For each name that is not unique even with its suffix: the last number that was appended.
    let mut numbers: HashMap<String, u32> = HashMap::default();
    for (suffix, name) in suffixes.zip(plain) {
        if count[name.as_str()] == 1 && !is_reserved(name) {
            names.push(name.clone());
            continue;
        }
        let suffix = address(suffix);
        let once = join(name, &suffix, case);
        let mut claim = |candidate: &str| !is_reserved(candidate) && used.insert(candidate.to_owned());
        if claim(&once) {
            names.push(once);
            continue;
        }
        let twice = join(&once, &suffix, case);
        if claim(&twice) {
            names.push(twice);
            continue;
        }
        let number = numbers.entry(twice.clone()).or_insert(2);
        names.push(loop {
            *number += 1;
            let candidate = join(&twice, &number.to_string(), case);
            if claim(&candidate) {
                break candidate;
            }
        });
    }
    names
}

fn plain(name_request: &NameRequest<'_>, case: Case, length: usize) -> String {
    let words = words(name_request.name);
    // Parts of an address are not split into words. Only an element that needs no name may have an empty fallback name.
    let parts = name_request.fallback.split(' ').filter(|part| !part.is_empty());
    let words = if words.is_empty() { parts.map(|part| address(part).to_ascii_lowercase()).collect() } else { words };
    let mut name = write(&words, case);
    cut(&mut name, length);
    name
}

/// Cuts a name to at most `length` characters. If the second half of these characters contains an underscore, the name ends before
/// the last underscore.
fn cut(name: &mut String, length: usize) {
    if name.len() > length {
        let end = name[..length].rfind('_').filter(|&end| end > length / 2).unwrap_or(length);
        name.truncate(end);
    }
}

/// Returns an address as a part of an identifier: the unchanged address if it is valid, otherwise its words, or `other` if it has
/// no words. The result is never empty.
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
            // In Pascal case, a separator is needed only between two digits.
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
                // An underscore keeps two adjacent numbers from becoming one number.
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

/// Returns the words of a name in lower-case ASCII. A word ends at each character that is neither letter nor digit, and before a
/// capital that follows a lower-case letter or a digit. The last capital of an abbreviation starts a new word if a lower-case
/// letter other than a plural `s` follows. For example, `PDOMapping` and `RxPDOs` have two words each.
fn words(name: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word = String::new();
    let mut previous = CharacterClass::Other;
    let mut letters = name.chars().peekable();
    while let Some(letter) = letters.next() {
        let class = CharacterClass::of(letter);
        let next = letters.peek().map_or(CharacterClass::Other, |&next| CharacterClass::of(next));
        let starts = match (previous, class) {
            (_, CharacterClass::Other) => true,
            (CharacterClass::Lower | CharacterClass::Digit, CharacterClass::Upper) => true,
            // The last capital of an abbreviation starts the next word: `PDOMapping`, but not `RxPDOs`.
            (CharacterClass::Upper, CharacterClass::Upper) => {
                next == CharacterClass::Lower && !is_plural(letters.clone())
            }
            _ => false,
        };
        if starts && !word.is_empty() {
            words.push(std::mem::take(&mut word));
        }
        match class {
            CharacterClass::Other => spell(letter, &mut words),
            _ => push_ascii(letter, &mut word),
        }
        previous = class;
    }
    if !word.is_empty() {
        words.push(word);
    }
    for word in &mut words {
        word.truncate(MAX_IDENTIFIER);
    }
    words
}

/// Returns whether the rest of a word is the plural `s` of an abbreviation.
fn is_plural(mut rest: impl Iterator<Item = char>) -> bool {
    rest.next() == Some('s')
        && rest.next().is_none_or(|following| CharacterClass::of(following) != CharacterClass::Lower)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum CharacterClass {
    Lower,
    Upper,
    Digit,
    Other,
}

impl CharacterClass {
    fn of(letter: char) -> Self {
        match letter {
            'a'..='z' => CharacterClass::Lower,
            'A'..='Z' => CharacterClass::Upper,
            '0'..='9' => CharacterClass::Digit,
            _ if transliteration(letter).is_empty() => CharacterClass::Other,
            _ if letter.is_uppercase() => CharacterClass::Upper,
            _ => CharacterClass::Lower,
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

/// Adds the word for a sign that has a meaning, such as `%` or `°`. All other signs only separate words.
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

/// Returns ASCII letters for accented Latin letters, and for Greek letters that are common in symbols and units. Returns an empty
/// text for any other character.
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

/// Returns `name` with a prefix that is a separate word, such as `set_`. The raw prefix of keywords and the underscore
/// before a digit are removed.
pub fn prefixed(prefix: &str, name: &str) -> String {
    format!("{prefix}{}", name.trim_start_matches("r#").trim_start_matches('_'))
}

/// Returns `name` as a valid identifier. A keyword of any Rust edition becomes a raw identifier, except `self`, `Self`, `super` and
/// `crate`. These keywords and `_` get an underscore as a suffix.
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
    fn names_with_equal_suffixes_are_numbered() {
        let names = names(&[("a", "1"), ("a", "1"), ("a", "1"), ("a_1_1_3", "x"), ("a", "1"), ("a", "2")]);
        assert_eq!(names, ["a_1", "a_1_1", "a_1_1_4", "a_1_1_3", "a_1_1_5", "a_2"]);
        let many = vec![("a", "1"); 20_000];
        assert!(self::names(&many).iter().all(|name| name.len() < 16), "no name grows with the number of elements");
    }

    fn names(pairs: &[(&str, &str)]) -> Vec<String> {
        let name_requests: Vec<NameRequest<'_>> =
            pairs.iter().map(|&(name, suffix)| NameRequest::new(name, "object", suffix)).collect();
        unique(name_requests, &["new"], Case::Snake)
    }

    #[test]
    fn equal_names_all_get_their_address() {
        assert_eq!(names(&[("A", "2000"), ("b", "2001"), ("a", "2002")]), ["a_2000", "b", "a_2002"]);
        assert_eq!(names(&[("", "2000"), ("?!", "200A"), ("new", "2002")]), ["object_2000", "object_200a", "new_2002"]);
    }

    #[test]
    fn a_suffixed_name_never_equals_an_existing_one() {
        let got = names(&[("a 2000", "1000"), ("a", "2000"), ("a", "2001")]);
        assert_eq!(got, ["a_2000", "a_2000_2000", "a_2001"]);
    }

    #[test]
    fn suffixes_of_any_text_are_parts_of_identifiers() {
        let got = names(&[("a", "Chapter/Speed_64"), ("a", "\u{65e5}"), ("", "\u{df}_2"), ("new", "__"), ("new", "")]);
        assert_eq!(got, ["a_chapter_speed_64", "a_other", "object_ss_2", "new_other", "new_other_other"]);
        let name_requests = [NameRequest::new("A 2", "object", "U64"), NameRequest::new("a2", "object", "7")];
        assert_eq!(
            unique(name_requests, &[], Case::Pascal),
            ["A2U64", "A2_7"],
            "camel case has underscores only between digits"
        );
    }

    #[test]
    fn prefixes_precede_words() {
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

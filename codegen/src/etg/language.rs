//! Languages: the Windows LCIDs of ETG.2000 and the BCP 47 tags of the IR.

use compact_str::{format_compact, CompactString};

/// LCID of the language that a text without the attribute LcId has.
pub const ENGLISH: u32 = 1033;

/// LCIDs and the corresponding BCP 47 tags. For a tag without a region, the first entry of the language applies, except for `zh`
/// and `pt` (see [`lcid`]).
const LANGUAGES: [(u32, &str); 23] = [
    (1028, "zh-TW"),
    (1029, "cs-CZ"),
    (1030, "da-DK"),
    (1031, "de-DE"),
    (1033, "en-US"),
    (3082, "es-ES"),
    (1034, "es-ES"),
    (1035, "fi-FI"),
    (1036, "fr-FR"),
    (1038, "hu-HU"),
    (1040, "it-IT"),
    (1041, "ja-JP"),
    (1042, "ko-KR"),
    (1043, "nl-NL"),
    (1044, "nb-NO"),
    (1045, "pl-PL"),
    (1046, "pt-BR"),
    (1049, "ru-RU"),
    (1053, "sv-SE"),
    (1055, "tr-TR"),
    (2052, "zh-CN"),
    (2057, "en-GB"),
    (2070, "pt-PT"),
];

/// Returns the rank of a language for the choice of an element's main name. The name with the lowest rank is the main
/// name: English (1033), then a name without a language (no LCID, or LCID 0 or 1), then other languages.
pub fn rank(lcid: Option<u32>) -> u8 {
    match lcid {
        Some(ENGLISH) => 0,
        None | Some(0 | 1) => 1,
        Some(_) => 2,
    }
}

/// Returns the BCP 47 tag of a language, or a text such as `lcid:1081` if the tag is not known.
pub fn tag(lcid: Option<u32>) -> CompactString {
    let lcid = lcid.unwrap_or(ENGLISH);
    match LANGUAGES.iter().find(|(number, _)| *number == lcid) {
        Some((_, tag)) => CompactString::const_new(tag),
        None => format_compact!("lcid:{lcid}"),
    }
}

/// Returns the LCID of a known BCP 47 tag, or the number in a text such as `lcid:1081`. For a tag without a region, returns the
/// LCID of the first entry of the language, except for `zh` and `pt`.
pub fn lcid(tag: &str) -> Option<u32> {
    if let Some(number) = tag.strip_prefix("lcid:") {
        return number.parse().ok();
    }
    let exact = LANGUAGES.iter().find(|(_, other)| other.eq_ignore_ascii_case(tag));
    let of_language = |other: &str| other.split('-').next().is_some_and(|language| language.eq_ignore_ascii_case(tag));
    // Chinese without a region means simplified characters, and Portuguese without a region means Portugal.
    let region = match tag {
        "zh" => return Some(2052),
        "pt" => return Some(2070),
        _ => LANGUAGES.iter().find(|(_, other)| of_language(other)),
    };
    exact.or(region).map(|&(number, _)| number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_and_numbers() {
        for (number, _) in LANGUAGES.iter().filter(|(number, _)| *number != 1034) {
            assert_eq!(lcid(&tag(Some(*number))), Some(*number));
        }
        assert_eq!(lcid("de"), Some(1031));
        assert_eq!(lcid("IT"), Some(1040));
        assert_eq!(lcid("en"), Some(1033));
        assert_eq!(lcid(&tag(Some(7))), Some(7));
        assert_eq!(lcid("tlh"), None);
    }
}

//! Languages: the LcId of Windows that ETG.2000 uses, and the tags of BCP 47 that the IR has.

use compact_str::{format_compact, CompactString};

use super::number;

/// The language of a text without LcId.
const ENGLISH: u32 = 1033;

/// The number of a language; `None` for text that is none.
pub(super) fn number(text: &str) -> Option<u32> {
    number::parse(text).and_then(|number| u32::try_from(number.value).ok())
}

/// How well a text serves as the name: 1033, then one that says no language, then any.
pub(super) fn rank(lcid: Option<u32>) -> u8 {
    match lcid {
        Some(ENGLISH) => 0,
        None | Some(0 | 1) => 1,
        Some(_) => 2,
    }
}

/// The tag of a language.
pub(super) fn tag(lcid: Option<u32>) -> CompactString {
    let tag = match lcid.unwrap_or(ENGLISH) {
        1028 => "zh-TW",
        1029 => "cs-CZ",
        1030 => "da-DK",
        1031 => "de-DE",
        1033 => "en-US",
        1034 | 3082 => "es-ES",
        1035 => "fi-FI",
        1036 => "fr-FR",
        1038 => "hu-HU",
        1040 => "it-IT",
        1041 => "ja-JP",
        1042 => "ko-KR",
        1043 => "nl-NL",
        1044 => "nb-NO",
        1045 => "pl-PL",
        1046 => "pt-BR",
        1049 => "ru-RU",
        1053 => "sv-SE",
        1055 => "tr-TR",
        2052 => "zh-CN",
        2057 => "en-GB",
        2070 => "pt-PT",
        other => return format_compact!("lcid:{other}"),
    };
    CompactString::const_new(tag)
}

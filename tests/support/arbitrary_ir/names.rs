//! Random names and texts: ordinary names, and names that conflict with Rust, with generated code, or with each other.

use std::sync::Arc;

use lexibus_codegen::ir::{
    Bus, Buses, CiteUnit, CompactString, Documentation, Doubt, Doubts, Extension, Extensions, Fact, FactOrigin,
    FactOrigins, LocalText, Manual, ManualSection, OverlayOrigin, Rule, Severity, Texts,
};
use lexibus_codegen::source::Origin;

use super::bytes::Bytes;

/// Ordinary names. The list is short, so that elements often have the same name and references often resolve.
const ORDINARY: [&str; 12] = [
    "Speed",
    "target position",
    "Statusword",
    "Controlword",
    "Mode",
    "Value",
    "Number",
    "Speed 2",
    "Chapter/Speed",
    "a name that goes on and on and on, and says nothing, nothing at all, for ever and ever",
    "Velocity [m/s²]",
    "Maximum of the torque, in 0.1 %",
];

/// Unusual names: keywords, names in the prelude and in generated code, names of methods, and invalid names.
const ODD: [&str; 142] = [
    "",
    " ",
    "_",
    "__",
    "?!",
    "2nd",
    "2",
    "22 33",
    "0x10",
    "1.5",
    "日本",
    "ß",
    "Größe",
    "Ωµ°",
    "\u{202e}x",
    "a\nb",
    "\r\n",
    "\"",
    "\\",
    "x\n[1018]\nParameterName=y",
    "]]>",
    "-->",
    "</Name>",
    "..",
    "../../x",
    "CON",
    "'",
    "*/",
    "/*",
    "//",
    "{}",
    "{0}",
    "#[",
    "]]",
    "`",
    "<b>",
    "«x»",
    "¦",
    "¬",
    "‡",
    "»",
    "«",
    "type",
    "self",
    "Self",
    "super",
    "crate",
    "fn",
    "match",
    "async",
    "gen",
    "union",
    "true",
    "dyn",
    "box",
    "static",
    "Some",
    "None",
    "Ok",
    "Err",
    "Option",
    "Result",
    "Default",
    "Debug",
    "Clone",
    "Copy",
    "PartialEq",
    "String",
    "Box",
    "Vec",
    "From",
    "Into",
    "Iterator",
    "Send",
    "Sized",
    "Drop",
    "Fn",
    "Unknown",
    "Item",
    "u8",
    "u16",
    "i64",
    "u128",
    "f32",
    "bool",
    "str",
    "char",
    "usize",
    "rt",
    "core",
    "std",
    "lexibus",
    "types",
    "objects",
    "pdo",
    "codes",
    "windows",
    "procedures",
    "messages",
    "machine",
    "models",
    "mappable",
    "remappable",
    "values",
    "modules",
    "new",
    "New",
    "from_raw",
    "raw",
    "get",
    "read",
    "write",
    "clone",
    "into",
    "into_client",
    "client",
    "axis",
    "on",
    "next",
    "drop",
    "eq",
    "not",
    "default",
    "fmt",
    "From Raw",
    "is_set",
    "to_u8",
    "as is",
    "from here",
    "with_speed",
    "state",
    "with_command",
    "C",
    "S",
    "X",
    "value",
    "word",
    "data",
    "to",
    "from",
    "own",
    "station",
];

/// Ordinary texts, and texts that would end a comment or string if they were not escaped.
const TEXTS: [&str; 14] = [
    "It turns.",
    "",
    "*/ } fn broken() {",
    "\" } ; \\",
    "{} {0} {{ %s",
    "one\ntwo\n\nthree",
    "\r\n/// [link](https://example.com) [Speed] [`Speed`]: `code",
    "| a | table |\n|---|---|",
    "<script>alert(1)</script> & \u{202e}reversed\u{0}",
    "«¦» ¬ ‡",
    "# Heading\n- list\n  1. more\n```\nunclosed",
    "    indented",
    "\\",
    "日本 äöü Ω 100 %",
];

const LANGUAGES: [&str; 3] = ["de", "ja", "zh-\""];

/// Returns a name from short lists, so that other elements often have the same name.
pub fn name(b: &mut Bytes<'_>) -> CompactString {
    match b.within(0..=9) {
        0..=4 => b.pick(&ORDINARY).into(),
        5..=8 => b.pick(&ODD).into(),
        _ => CompactString::from(format!("{} {}", b.pick(&ODD), b.within(0..=3))),
    }
}

/// Returns one of the given names, or any other name.
pub fn of(b: &mut Bytes<'_>, given: &[CompactString]) -> CompactString {
    if given.is_empty() || b.one_in(12) {
        name(b)
    } else {
        b.pick(given)
    }
}

pub fn text(b: &mut Bytes<'_>) -> CompactString {
    b.pick(&TEXTS).into()
}

/// Returns a unit symbol.
pub fn unit(b: &mut Bytes<'_>) -> CompactString {
    b.pick(&["rpm", "mm/s²", "%", "", "0.1 A", "\"", "°C", "in use", "{}", "1"]).into()
}

/// Returns the name of one of the two items of a window, or rarely any other name.
pub fn of_window(b: &mut Bytes<'_>) -> CompactString {
    if b.one_in(40) {
        name(b)
    } else {
        b.pick(&["Window's number", "Window's value"]).into()
    }
}

/// Returns a firmware version.
pub fn version(b: &mut Bytes<'_>) -> CompactString {
    b.pick(&["1.0", "2.10", "", "V3\"", "*/"]).into()
}

/// Returns the path of a file.
pub fn path(b: &mut Bytes<'_>) -> CompactString {
    b.pick(&["drive.eds", "", "../../x", "/etc/x", "C:\\x\"", "x\n[1018]"]).into()
}

/// Returns the name of a device model, or a pattern for such names.
pub fn model(b: &mut Bytes<'_>) -> CompactString {
    b.pick(&["A1", "B*", "*", "type", "", "Some"]).into()
}

pub fn buses(b: &mut Bytes<'_>) -> Buses {
    b.list(2, |b| b.pick(&Bus::ALL)).into()
}

pub fn texts(b: &mut Bytes<'_>) -> Texts {
    b.few(6, 2, |b| LocalText { language: b.pick(&LANGUAGES).into(), text: text(b) }).into()
}

fn fact_origin(b: &mut Bytes<'_>) -> FactOrigin {
    match b.within(0..=4) {
        0 => b.pick(&[FactOrigin::Stated, FactOrigin::PrintedName]),
        1 => FactOrigin::Overlay(Box::new(OverlayOrigin {
            file: name(b),
            line: b.within(0..=9),
            replaces: b.any(),
            why: name(b),
        })),
        2 => {
            FactOrigin::Rule(b.pick(&[Rule::UnstatedAccess, Rule::AnnouncedPdo, Rule::MappedObject, Rule::MissingKey]))
        }
        _ => FactOrigin::Standard(text(b)),
    }
}

/// Returns origins of facts that are not in the device description.
pub fn origins(b: &mut Bytes<'_>) -> FactOrigins {
    FactOrigins(b.few(4, 3, |b| (b.pick(&Fact::ALL), fact_origin(b))).into_iter().collect())
}

/// Returns the origin of a definition that is not in the device description.
pub fn stated_by(b: &mut Bytes<'_>) -> Option<Box<FactOrigin>> {
    b.maybe(8, fact_origin).map(Box::new)
}

pub fn documentation(b: &mut Bytes<'_>) -> Option<Arc<Documentation>> {
    b.maybe(4, |b| {
        let cite = b.maybe(2, text);
        Arc::new(Documentation {
            text: text(b).into(),
            translations: texts(b),
            cite,
            text_from: b.maybe(6, fact_origin).map(Box::new),
        })
    })
}

pub fn doubts(b: &mut Bytes<'_>) -> Doubts {
    b.few(12, 2, |b| {
        let [says, chosen, why] = [text(b), text(b), text(b)].map(String::from);
        let part = b.maybe(6, text).unwrap_or_default();
        let severity = b.pick(&[Severity::Hazard, Severity::Value, Severity::Print]);
        Doubt { says, chosen, why, origin: Origin::default(), cite: b.maybe(2, text), severity, part }
    })
    .into()
}

pub fn manual(b: &mut Bytes<'_>) -> Manual {
    let mut sections = b.few(2, 3, |b| ManualSection { start: b.within(0..=60), title: text(b) });
    sections.sort_by_key(|section| section.start);
    Manual {
        title: text(b),
        edition: text(b),
        language: b.pick(&LANGUAGES).into(),
        counts: b.pick(&[None, Some(CiteUnit::Page), Some(CiteUnit::Line)]),
        documentation: text(b).into(),
        sections,
    }
}

pub fn extensions(b: &mut Bytes<'_>) -> Extensions {
    b.few(16, 2, |b| Extension { key: name(b), value: text(b), span: Default::default() }).into()
}

/// Returns XML attributes that the IR keeps by name and text. The names are valid and unique.
pub fn attributes(b: &mut Bytes<'_>) -> Vec<(CompactString, CompactString)> {
    let mut list = b.few(8, 2, |b| (b.pick(&["SubstituteLength", "type", "_1", "Größe", "x-y.z"]).into(), text(b)));
    list.sort();
    list.dedup_by(|one: &mut (CompactString, _), other| one.0 == other.0);
    list
}

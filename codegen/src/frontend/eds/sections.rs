//! Classifies sections by their names (CiA 306, "section names").

use crate::frontend::canopen::number::hexadecimal;

/// Kind of a section, which the name of the section determines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SectionKind {
    FileInfo,
    DeviceInfo,
    DummyUsage,
    Comments,
    List(List),
    Commissioning,
    SupportedModules,
    ConnectedModules,
    DynamicChannels,
    /// Object section `[xxxx]`.
    Object(u16),
    /// Sub-index section `[xxxxsubN]`.
    Sub(u16, u8),
    /// Section `[xxxxName]`, `[xxxxValue]` or `[xxxxDenotation]`, which lists the names, values or denotations of the
    /// sub-indices of a compact object.
    Refinement(u16, Refinement),
    /// Object links section `[xxxxObjectLinks]`.
    Links(u16),
    /// Module section `[M<n>…]`.
    Module(u32, ModulePart),
    Unknown,
}

/// Kind of an object list: mandatory, optional or manufacturer-specific objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum List {
    Mandatory,
    Optional,
    Manufacturer,
}

/// Fact that a section lists for the sub-indices of a compact object: names, values or denotations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refinement {
    Name,
    Value,
    Denotation,
}

/// Part of a module's description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ModulePart {
    Info,
    Comments,
    FixedObjects,
    FixedObject(u16),
    FixedSub(u16, u8),
    SubExtends,
    SubExtension(u16),
}

const NAMED: [(&str, SectionKind); 12] = [
    ("FileInfo", SectionKind::FileInfo),
    ("DeviceInfo", SectionKind::DeviceInfo),
    ("DummyUsage", SectionKind::DummyUsage),
    ("Comments", SectionKind::Comments),
    ("MandatoryObjects", SectionKind::List(List::Mandatory)),
    ("OptionalObjects", SectionKind::List(List::Optional)),
    ("ManufacturerObjects", SectionKind::List(List::Manufacturer)),
    // CiA 306 misspells `DeviceCommissioning` as `DeviceComissioning`. The reader accepts both spellings.
    ("DeviceComissioning", SectionKind::Commissioning),
    ("DeviceCommissioning", SectionKind::Commissioning),
    ("SupportedModules", SectionKind::SupportedModules),
    ("ConnectedModules", SectionKind::ConnectedModules),
    ("DynamicChannels", SectionKind::DynamicChannels),
];

impl SectionKind {
    /// Returns the section name for a kind of section that occurs at most once, or an empty string for any other kind.
    pub(super) fn name(self) -> &'static str {
        NAMED.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }
}

/// Returns the kind of the section `name`, and whether the name conforms to the grammar.
pub(super) fn classify(name: &str) -> (SectionKind, bool) {
    if let Some(kind) = canonical(name.as_bytes()) {
        return (kind, true);
    }
    if let Some(found) = classify_object(name) {
        return found;
    }
    if let Some((_, kind)) = NAMED.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)) {
        return (*kind, true);
    }
    if let Some(found) = classify_module(name) {
        return found;
    }
    (SectionKind::Unknown, true)
}

/// Returns the kind of a section of an object or sub-index whose name is spelled as most files spell it.
fn canonical(name: &[u8]) -> Option<SectionKind> {
    let (index, rest) = name.split_at_checked(4)?;
    let index = hexadecimal(index)? as u16;
    match rest {
        [] => Some(SectionKind::Object(index)),
        [b's', b'u', b'b', sub @ ..] if matches!(sub, [_] | [b'1'..=b'9' | b'A'..=b'F', _]) => {
            Some(SectionKind::Sub(index, hexadecimal(sub)? as u8))
        }
        _ => None,
    }
}

fn classify_object(name: &str) -> Option<(SectionKind, bool)> {
    let (digits, prefixed) = match name.get(..2) {
        Some("0x" | "0X") => (&name[2..], true),
        _ => (name, false),
    };
    let (mut index, mut length) = (0, 0);
    while let Some(digit) = digits.as_bytes().get(length).and_then(|&byte| char::from(byte).to_digit(16)) {
        (index, length) = (index << 4 | digit, length + 1);
    }
    // The letters `De` of `Denotation` are hexadecimal digits, too.
    if length == 6 && digits[4..].eq_ignore_ascii_case("Denotation") {
        (index, length) = (index >> 8, 4);
    }
    // At most eight digits are read as an index, because some files write leading zeros. Names such as `[DeviceInfo]`
    // also start with hexadecimal digits, and are recognized by the text after these digits.
    if length == 0 || length > 8 {
        return None;
    }
    let index = u16::try_from(index).ok()?;
    let legal = length == 4 && !prefixed;
    let rest = &digits[length..];
    if rest.is_empty() {
        return Some((SectionKind::Object(index), legal));
    }
    let word = rest.trim_start();
    if let Some(number) = strip_prefix_ignore_case(word, "sub") {
        let number = number.trim_start();
        let sub = hex_u8(number)?;
        let canonical = number.len() == 1 || !number.starts_with('0');
        return Some((SectionKind::Sub(index, sub), legal && canonical && rest.len() == 3 + number.len()));
    }
    let kind = match () {
        _ if word.eq_ignore_ascii_case("Name") => SectionKind::Refinement(index, Refinement::Name),
        _ if word.eq_ignore_ascii_case("Value") => SectionKind::Refinement(index, Refinement::Value),
        _ if word.eq_ignore_ascii_case("Denotation") => SectionKind::Refinement(index, Refinement::Denotation),
        _ if word.eq_ignore_ascii_case("ObjectLinks") => SectionKind::Links(index),
        _ => return None,
    };
    Some((kind, legal && word.len() == rest.len()))
}

fn classify_module(name: &str) -> Option<(SectionKind, bool)> {
    let rest = strip_prefix_ignore_case(name, "M")?;
    let length = rest.bytes().take_while(u8::is_ascii_digit).count();
    let number: u32 = rest.get(..length)?.parse().ok()?;
    let canonical = !rest.starts_with('0');
    let word = &rest[length..];
    let (part, legal) = match () {
        _ if word.eq_ignore_ascii_case("ModuleInfo") => (ModulePart::Info, true),
        _ if word.eq_ignore_ascii_case("Comments") => (ModulePart::Comments, true),
        _ if word.eq_ignore_ascii_case("FixedObjects") => (ModulePart::FixedObjects, true),
        _ if word.eq_ignore_ascii_case("SubExtends") => (ModulePart::SubExtends, true),
        _ => {
            let (is_extension, object) = match strip_prefix_ignore_case(word, "SubExt") {
                Some(object) => (true, object),
                None => (false, strip_prefix_ignore_case(word, "Fixed")?),
            };
            match (is_extension, classify_object(object)?) {
                (true, (SectionKind::Object(index), legal)) => (ModulePart::SubExtension(index), legal),
                (false, (SectionKind::Object(index), legal)) => (ModulePart::FixedObject(index), legal),
                (false, (SectionKind::Sub(index, sub), legal)) => (ModulePart::FixedSub(index, sub), legal),
                _ => return None,
            }
        }
    };
    Some((SectionKind::Module(number, part), legal && canonical))
}

fn hex_u8(digits: &str) -> Option<u8> {
    // `from_str_radix` also accepts a plus sign.
    (!digits.starts_with('+')).then(|| u8::from_str_radix(digits, 16).ok()).flatten()
}

fn strip_prefix_ignore_case<'a>(text: &'a str, prefix: &str) -> Option<&'a str> {
    let head = text.get(..prefix.len())?;
    head.eq_ignore_ascii_case(prefix).then(|| &text[prefix.len()..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_and_their_refinements() {
        assert_eq!(classify("1A00"), (SectionKind::Object(0x1A00), true));
        assert_eq!(classify("200a"), (SectionKind::Object(0x200A), true));
        assert_eq!(classify("A0"), (SectionKind::Object(0xA0), false));
        assert_eq!(classify("0x2000"), (SectionKind::Object(0x2000), false));
        for name in ["1018sub1", "1018Sub1", "1018SUB1"] {
            assert_eq!(classify(name), (SectionKind::Sub(0x1018, 1), true));
        }
        assert_eq!(classify("2000subFF"), (SectionKind::Sub(0x2000, 0xFF), true));
        assert_eq!(classify("02000"), (SectionKind::Object(0x2000), false));
        assert_eq!(classify("02000sub1"), (SectionKind::Sub(0x2000, 1), false));
        for name in ["2000sub01", "1003sub00", "2000 sub1", "A0sub1"] {
            assert!(!classify(name).1, "{name}");
        }
        assert_eq!(classify("2000Value"), (SectionKind::Refinement(0x2000, Refinement::Value), true));
        assert_eq!(classify("2000Denotation"), (SectionKind::Refinement(0x2000, Refinement::Denotation), true));
        assert_eq!(classify("2000 name"), (SectionKind::Refinement(0x2000, Refinement::Name), false));
        assert_eq!(classify("2000objectlinks"), (SectionKind::Links(0x2000), true));
    }

    #[test]
    fn other_sections() {
        assert_eq!(classify("deviceinfo"), (SectionKind::DeviceInfo, true));
        assert_eq!(classify("DeviceComissioning"), classify("DeviceCommissioning"));
        assert_eq!(classify("M1SubExt6000"), (SectionKind::Module(1, ModulePart::SubExtension(0x6000)), true));
        assert_eq!(classify("M12Fixed1A00sub1"), (SectionKind::Module(12, ModulePart::FixedSub(0x1A00, 1)), true));
        assert_eq!(classify("M01ModuleInfo"), (SectionKind::Module(1, ModulePart::Info), false));
        for name in ["File", "Params", "", "2000sub100", "2000subx", "20000", "M", "Mx", "MComments", "M1Fixed", "ü"] {
            assert_eq!(classify(name).0, SectionKind::Unknown, "{name}");
        }
    }
}

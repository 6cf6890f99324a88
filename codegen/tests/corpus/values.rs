//! Tests that the compiler does not lose or change a value of any corpus file without a diagnostic.
//!
//! The test reads each file again line by line, without the code under test (`corpus_support`). The test checks each entry of a
//! section about an object. The IR must have the same value, an extension must keep the text, or there must be a diagnostic on
//! that line. Conversely, the file must contain each value of an item.

use crate::corpus_support;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Debug;

use corpus_support::number::{self, Number};
use corpus_support::reading::{cut, Fact, Part, Reading, Section};
use corpus_support::{files, lane, lines};
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::ir::{Access, Configured, Device, Extension, Group, Item, Mappable, ObjectCode, Type, Value};
use lexibus_codegen::source::Source;

/// Codes of diagnostics about values that are unreadable, or that the compiler reads differently from this test.
const ABOUT_THE_VALUE: [&str; 16] = [
    "EDS014", "EDS015", "EDS016", "EDS022", "EDS023", "EDS024", "EDS027", "EDS028", "EDS029", "EDS030", "EDS032",
    "EDS033", "EDS037", "EDS047", "EDS064", "EDS067",
];

/// Codes of diagnostics about items without a data type. The compiler makes items without a data type read-only.
const NO_DATA_TYPE: [&str; 2] = ["EDS035", "EDS065"];

/// Codes of diagnostics about a wrong number of sub-indices.
const ABOUT_THE_COUNT: [&str; 3] = ["EDS046", "EDS048", "EDS066"];

/// Returns options without profiles, because the facts that profiles add are not in the file.
fn as_it_stands() -> Options {
    Options { no_profiles: true, ..Options::default() }
}

/// Results of comparing files with their compilations.
#[derive(Default)]
struct Tally {
    /// Number of values that are equal in the file and in the IR, by key.
    same: BTreeMap<String, usize>,
    /// Number of equal values in items that CompactSubObj implies.
    compact: usize,
    /// Number of values that are kept as an extension, by key.
    kept: BTreeMap<String, usize>,
    /// Number of values about which there is a diagnostic, by the code of the diagnostic.
    reported: BTreeMap<String, usize>,
    /// Number of empty values, including the number 0 if it means no value.
    empty: usize,
    /// Lost or changed values, each with its line and description.
    lost: Vec<String>,
}

impl Tally {
    fn add(&mut self, other: Tally, file: &str) {
        for (into, from) in
            [(&mut self.same, other.same), (&mut self.kept, other.kept), (&mut self.reported, other.reported)]
        {
            from.into_iter().for_each(|(key, count)| *into.entry(key).or_default() += count);
        }
        self.compact += other.compact;
        self.empty += other.empty;
        self.lost.extend(other.lost.into_iter().map(|lost| format!("{file}:{lost}")));
    }
}

/// An item, or an object with sub-indices, together with the section that describes it.
#[derive(Clone, Copy)]
struct Target<'a> {
    section: &'a Section,
    group: &'a Group,
    item: Option<&'a Item>,
    /// Extensions, which keep values for which the IR has no field.
    extensions: &'a [Extension],
    /// The type in the section, if any.
    ty: Option<Type>,
    /// Whether CompactSubObj implies the item.
    compact: bool,
    /// Whether the section describes the object itself.
    is_object: bool,
    /// Whether the section was already compared with another item of the object. If so, the facts about the object are
    /// not compared again.
    again: bool,
}

/// A file as read by the compiler and by this test, with the results of comparing both.
struct Comparison<'a> {
    device: &'a Device,
    reading: &'a Reading,
    /// Codes of the diagnostics on each line.
    codes: BTreeMap<u32, Vec<&'static str>>,
    tally: Tally,
}

/// Compares a compilation with the text of its file.
fn compare(text: &str, compilation: &Compilation) -> Tally {
    let device = &compilation.catalog.as_ref().expect("a device").devices[0];
    let starts: Vec<usize> = lines(text).into_iter().map(|(start, _)| start).collect();
    let mut codes: BTreeMap<u32, Vec<&'static str>> = BTreeMap::new();
    for found in compilation.diagnostics.list().iter().filter(|found| !found.span.is_empty()) {
        let line = starts.partition_point(|&start| start <= found.span.start as usize);
        codes.entry(line as u32).or_default().push(found.code.id);
    }
    let reading = Reading::of(text);
    let mut comparison = Comparison { device, reading: &reading, codes, tally: Tally::default() };
    comparison.items_are_those_of_the_file();
    for ((index, part), section) in &reading.sections {
        comparison.repetitions(section);
        match part {
            Part::Object => comparison.object(*index, section),
            Part::Sub(sub) => comparison.sub(*index, *sub, section),
            Part::Name | Part::Value | Part::Denotation => comparison.refinement(*index, *part, section),
            Part::Links => {}
        }
    }
    comparison.tally
}

/// Methods that compare the sections of an object and its sub-indices with the items that the sections describe.
impl Comparison<'_> {
    /// E27, E28: sections and entries that are overridden must be reported.
    fn repetitions(&mut self, section: &Section) {
        for &line in section.headers.iter().skip(1) {
            self.reported_or_lost(line, &["EDS007"], "the repeated section is not reported");
        }
        for fact in section.facts.values().flat_map(|facts| facts.iter().skip(1)) {
            // EDS056 means that neither of two repeated keys describes a sub-index, and that both are kept.
            self.reported_or_lost(fact.line, &["EDS008", "EDS056"], "the repeated key is not reported");
        }
    }

    /// Checks that the IR contains exactly the items that the file describes or that CompactSubObj implies.
    fn items_are_those_of_the_file(&mut self) {
        let mut expected = BTreeSet::new();
        for ((index, part), section) in &self.reading.sections {
            match part {
                Part::Sub(sub) => _ = expected.insert((*index, *sub)),
                Part::Object if compact_count(section) > 0 => _ = expected.insert((*index, 0)),
                _ => {}
            }
            if *part == Part::Object {
                expected.extend(items_of(self.reading, *index, section).into_iter().map(|sub| (*index, sub)));
            }
        }
        let groups = self.device.groups.iter().filter(|group| group.origin.line > 0);
        let found: BTreeSet<_> = groups.flat_map(|group| &group.items).filter_map(Item::object).collect();
        for (index, sub) in expected.symmetric_difference(&found) {
            self.lose(0, format!("0x{index:04X}:{sub:02X} is in one of the file and the IR"));
        }
    }

    fn object(&mut self, index: u16, section: &Section) {
        let device = self.device;
        let Some(group) = device.object(index) else { return self.lose(section.headers[0], "no such object") };
        let compact = compact_count(section) > 0;
        let base = Target {
            section,
            group,
            item: None,
            extensions: &group.extensions,
            ty: type_of(section),
            compact,
            is_object: true,
            again: false,
        };
        let actual = items_of(self.reading, index, section);
        for &sub in &actual {
            let Some(item) = group.sub(sub) else { continue };
            let name = if compact { format!("{}{sub}", group.name) } else { group.name.to_string() };
            if item.name != name && !self.refines(index, sub, Part::Name) {
                self.lose(section.headers[0], format!("{:?} is the name of sub-index {sub}", item.name));
            }
            self.target(Target { item: Some(item), again: sub != actual[0], ..base });
        }
        if actual.is_empty() {
            self.target(base);
        }
        if compact && !self.reading.subs(index).contains(&0) {
            self.compact_sub_0(group, section);
        }
    }

    /// Compares the sub-index 0 that CompactSubObj implies (E43).
    fn compact_sub_0(&mut self, group: &Group, section: &Section) {
        let count = Value::Int(compact_count(section));
        let as_expected = |item: &Item| {
            let facts = (item.name.as_str(), item.ty, item.access, item.default.as_ref());
            facts == ("NrOfObjects", Type::Unsigned(8), Access::ReadOnly, Some(&count))
        };
        if !group.sub(0).is_some_and(as_expected) {
            self.lose(section.headers[0], "CompactSubObj does not imply this sub-index 0");
        }
    }

    fn sub(&mut self, index: u16, sub: u8, section: &Section) {
        let device = self.device;
        let found = device.object(index).and_then(|group| Some((group, group.sub(sub)?)));
        let Some((group, item)) = found else { return self.lose(section.headers[0], "no such sub-index") };
        if self.reading.get(index, Part::Object).is_none() {
            self.orphan(index, sub, section);
        }
        self.target(Target {
            section,
            group,
            item: Some(item),
            extensions: &item.extensions,
            ty: type_of(section),
            compact: false,
            is_object: false,
            again: false,
        });
    }

    /// E33: sections of sub-indices without the section of their object must be reported once per object.
    fn orphan(&mut self, index: u16, sub: u8, section: &Section) {
        if self.reading.subs(index).first() == Some(&sub) {
            self.reported_or_lost(section.headers[0], &["EDS040"], "the missing object is not reported");
        }
    }

    /// Compares the entries of `[xxxxName]`, `[xxxxValue]` and `[xxxxDenotation]` (E44).
    fn refinement(&mut self, index: u16, part: Part, section: &Section) {
        let device = self.device;
        let Some(group) = device.object(index) else {
            return self.reported_or_lost(section.headers[0], &["EDS056"], "the section refines a missing object");
        };
        for fact in section.facts.values().filter_map(|facts| facts.last()) {
            let item = fact.key.parse().ok().and_then(|sub| group.sub(sub));
            let Some(item) = item else {
                if !fact.key.eq_ignore_ascii_case("NrOfEntries") {
                    self.reported_or_lost(fact.line, &["EDS056"], "the entry refines a missing sub-index");
                }
                continue;
            };
            let configured = item.configured.as_deref().cloned().unwrap_or_default();
            match part {
                Part::Name => self.hold(fact, &item.name.as_str(), Some(&fact.value.as_str())),
                Part::Value => self.hold(fact, &configured.value, expected(&fact.value, item.ty, false).as_ref()),
                _ => self.hold(fact, &configured.denotation.as_deref(), Some(&Some(fact.value.as_str()))),
            }
        }
    }

    /// Returns whether `[xxxxName]` or a similar section has an entry for this sub-index.
    fn refines(&self, index: u16, sub: u8, part: Part) -> bool {
        self.reading.get(index, part).is_some_and(|section| section.facts.contains_key(&sub.to_string()))
    }
}

/// Returns the line where the compiler reports a missing key: the line of the empty entry, or the line of the header if there is no
/// such entry.
fn line_of(section: &Section, key: &str) -> u32 {
    section.get(key).map_or(section.headers[0], |fact| fact.line)
}

/// Returns the number of sub-indices that CompactSubObj implies.
fn compact_count(section: &Section) -> i128 {
    section.number("compactsubobj").unwrap_or(0).clamp(0, 254)
}

/// Returns the sub-indices of items that the section of the object describes.
fn items_of(reading: &Reading, index: u16, section: &Section) -> Vec<u8> {
    let (subs, count) = (reading.subs(index), compact_count(section));
    if count > 0 {
        return (1..=count as u8).filter(|sub| !subs.contains(sub)).collect();
    }
    let code = section.number("objecttype").unwrap_or(7);
    let is_value = match subs.is_empty() {
        true => !matches!(code, 6 | 8 | 9),
        // E42: a VAR with sub-indices is treated as a RECORD. The section of a VAR with a data type describes sub-index 0.
        false => code == 7 && section.text("datatype").is_some() && !subs.contains(&0),
    };
    if is_value {
        vec![0]
    } else {
        Vec::new()
    }
}

/// Returns the type in a section (CiA 301, table of data types). Without DataType, returns DOMAIN if ObjectType is 2, and otherwise
/// `None`.
fn type_of(section: &Section) -> Option<Type> {
    if section.text("datatype").is_none() {
        return (section.number("objecttype") == Some(2)).then_some(Type::Domain);
    }
    let code = u32::try_from(section.number("datatype")?).ok()?;
    Some(match code {
        0x01 => Type::Boolean,
        0x02..=0x04 => Type::Integer(8 << (code - 2)),
        0x05..=0x07 => Type::Unsigned(8 << (code - 5)),
        0x08 => Type::Real32,
        0x09 => Type::VisibleString(None),
        0x0A => Type::OctetString(None),
        0x0B => Type::UnicodeString(None),
        0x0C => Type::TimeOfDay,
        0x0D => Type::TimeDifference,
        0x0F => Type::Domain,
        0x10 => Type::Integer(24),
        0x11 => Type::Real64,
        0x12..=0x15 => Type::Integer(40 + 8 * (code - 0x12) as u8),
        0x16 => Type::Unsigned(24),
        0x18..=0x1B => Type::Unsigned(40 + 8 * (code - 0x18) as u8),
        _ => Type::Opaque(Some(code)),
    })
}

/// Methods that compare single entries of a section.
impl Comparison<'_> {
    /// Compares all entries of a section with the item, and checks that the item has no other values.
    fn target(&mut self, target: Target<'_>) {
        for (key, facts) in &target.section.facts {
            let Some(fact) = facts.last() else { continue };
            if fact.value.is_empty() && is_keyword(key) {
                self.tally.empty += 1;
                continue;
            }
            self.entry(key, fact, target);
            self.comment(key, fact, target);
        }
        if let Some(item) = target.item {
            self.nothing_is_invented(item, target);
        }
    }

    fn entry(&mut self, key: &str, fact: &Fact, target: Target<'_>) {
        let text = cut(&fact.value).0;
        let of_the_object = !is_keyword(key) || OF_THE_OBJECT.contains(&key);
        match (key, target.item) {
            _ if target.again && of_the_object => {}
            ("parametername", _) if target.is_object => self.hold_name(fact, &target.group.name, target),
            ("parametername", Some(item)) => self.hold_name(fact, &item.name, target),
            ("objecttype", _) => self.object_type(fact, text, target),
            ("subnumber", _) if target.is_object => self.sub_number(fact, text, target),
            ("compactsubobj", _) if target.is_object => {
                self.hold(fact, &compact_count(target.section), number::plain(text).as_ref());
            }
            ("objflags", _) => {
                let flags = target.item.map_or(target.group.flags, |item| item.flags);
                self.hold_in(target, fact, &i128::from(flags), number::plain(text).as_ref());
            }
            _ if of_the_object => self.extension(fact, target),
            (_, None) => self.extension(fact, target),
            (_, Some(item)) => self.of_a_value(key, fact, item, target),
        }
    }

    fn of_a_value(&mut self, key: &str, fact: &Fact, item: &Item, target: Target<'_>) {
        let text = cut(&fact.value).0;
        let ty = target.ty.unwrap_or(Type::Opaque(None));
        let configured = item.configured.as_deref().cloned().unwrap_or_default();
        let whole = Some(fact.value.as_str());
        match key {
            "datatype" => self.hold_in(target, fact, &item.ty, target.ty.as_ref()),
            "accesstype" => self.access(fact, item, target),
            "pdomapping" => self.hold_in(target, fact, &item.mappable, mappable(text, item.access).as_ref()),
            "defaultvalue" => self.value(target, fact, &item.default, ty, false),
            "lowlimit" => self.value(target, fact, &item.limits.low, ty, true),
            "highlimit" => self.value(target, fact, &item.limits.high, ty, true),
            "parametervalue" => self.value(target, fact, &configured.value, ty, false),
            "denotation" => self.hold_in(target, fact, &configured.denotation.as_deref(), Some(&whole)),
            "uploadfile" => self.hold_in(target, fact, &configured.upload_file.as_deref(), Some(&whole)),
            "downloadfile" => self.hold_in(target, fact, &configured.download_file.as_deref(), Some(&whole)),
            _ => self.lose(fact.line, format!("nothing compares {key}")),
        }
    }

    fn value(&mut self, target: Target<'_>, fact: &Fact, ours: &Option<Value>, ty: Type, limit: bool) {
        self.hold_in(target, fact, ours, expected(&fact.value, ty, limit).as_ref());
    }

    /// Compares the object type. A sub-index must be a VAR or a DOMAIN; any other type must be reported.
    fn object_type(&mut self, fact: &Fact, text: &str, target: Target<'_>) {
        let code = number::plain(text).and_then(ObjectCode::from_number);
        if target.is_object {
            return self.hold_in(target, fact, &target.group.object_code(), Some(&code).filter(|code| code.is_some()));
        }
        let allowed = code.filter(|code| matches!(code, ObjectCode::Var | ObjectCode::Domain));
        self.hold(fact, &code, Some(&allowed).filter(|allowed| allowed.is_some()));
    }

    /// Compares SubNumber with the number of described sub-indices. Sub-index 0xFF is not counted. An object with a single
    /// value has no SubNumber.
    fn sub_number(&mut self, fact: &Fact, text: &str, target: Target<'_>) {
        if target.item.is_some() && !target.compact && target.group.items.len() == 1 {
            return self.extension(fact, target);
        }
        let described =
            target.group.items.iter().filter(|item| item.object().is_some_and(|(_, sub)| sub != 0xFF)).count();
        if number::plain(text) == Some(described as i128) || target.compact && number::plain(text) == Some(0) {
            *self.tally.same.entry("subnumber".into()).or_default() += 1;
        } else {
            self.reported_or_lost(fact.line, &ABOUT_THE_COUNT, "SubNumber is not the number of sub-indices");
        }
    }

    /// Compares the access rights. An item without a data type or access type is read-only.
    fn access(&mut self, fact: &Fact, item: &Item, target: Target<'_>) {
        let text = cut(&fact.value).0.to_ascii_lowercase();
        let repaired = item.access == Access::ReadOnly && text != "ro";
        match self.code_on(line_of(target.section, "datatype"), &NO_DATA_TYPE).filter(|_| repaired) {
            Some(code) => self.report(code),
            None => self.hold_in(target, fact, &item.access.name(), Some(&text.as_str())),
        }
    }

    fn hold_name(&mut self, fact: &Fact, name: &str, target: Target<'_>) {
        self.hold_in(target, fact, &name, Some(&fact.value.as_str()));
    }

    /// Checks that an extension keeps an entry for which the IR has no field. An entry with the value 0 can be dropped if 0
    /// means the same as a missing entry.
    fn extension(&mut self, fact: &Fact, target: Target<'_>) {
        let key = fact.key.to_ascii_lowercase();
        let says_nothing = matches!(key.as_str(), "subnumber" | "compactsubobj" | "pdomapping");
        let same = |kept: &Extension| kept.key == fact.key.as_str() && kept.value == fact.value.as_str();
        if target.extensions.iter().any(same) {
            *self.tally.kept.entry(key).or_default() += 1;
        } else if says_nothing && number::plain(cut(&fact.value).0) == Some(0) {
            self.tally.empty += 1;
        } else {
            self.lose(fact.line, format!("{}={} is not kept", fact.key, fact.value));
        }
    }

    /// E20, E21: checks that an extension keeps the comment after a value. Names and free texts contain no comments.
    fn comment(&mut self, key: &str, fact: &Fact, target: Target<'_>) {
        let fixed = match key {
            "defaultvalue" | "lowlimit" | "highlimit" | "parametervalue" => target.ty.is_some_and(|ty| !is_free(ty)),
            "parametername" | "denotation" | "uploadfile" | "downloadfile" => false,
            _ => is_keyword(key),
        };
        let comment = cut(&fact.value).1.get(1..).unwrap_or("").trim();
        if !fixed || comment.is_empty() {
            return;
        }
        let kept = |kept: &Extension| kept.value.contains(comment);
        let extensions = target.item.map_or(&[][..], |item| &item.extensions);
        if target.extensions.iter().chain(extensions).chain(&target.group.extensions).any(kept) {
            *self.tally.kept.entry("comment".into()).or_default() += 1;
        } else {
            self.lose(fact.line, format!("the comment {comment:?} is not kept"));
        }
    }

    /// Checks that the section contains all values of the item, and that the compiler reports a missing AccessType or DataType.
    fn nothing_is_invented(&mut self, item: &Item, target: Target<'_>) {
        let (index, sub) = item.object().expect("an object");
        let header = target.section.headers[0];
        let has = |key| target.section.text(key).is_some();
        let configured = item.configured.as_deref().cloned().unwrap_or_default();
        let refined = self.refines(index, sub, Part::Value) || self.refines(index, sub, Part::Denotation);
        let from_nowhere = [
            ("a default", item.default.is_some() && !has("defaultvalue")),
            ("a lower limit", item.limits.low.is_some() && !has("lowlimit")),
            ("an upper limit", item.limits.high.is_some() && !has("highlimit")),
            ("a value", configured.value.is_some() && !has("parametervalue") && !refined),
            ("a configuration", configured != Configured::default() && !has_configuration(target.section) && !refined),
            ("flags", item.flags != 0 && !has("objflags")),
            ("a mapping", item.mappable.any() && !has("pdomapping")),
        ];
        for (what, _) in from_nowhere.into_iter().filter(|(_, wrong)| *wrong) {
            self.lose(header, format!("sub-index {sub} has {what} from nowhere"));
        }
        let code = target.section.number("objecttype");
        if !has("accesstype") && !matches!(code, Some(0 | 2 | 5 | 6)) {
            let line = line_of(target.section, "accesstype");
            self.reported_or_lost(line, &["EDS034"], "the missing AccessType is not reported");
        }
        if !has("datatype") && !matches!(code, Some(0 | 2 | 5 | 6)) {
            let line = line_of(target.section, "datatype");
            self.reported_or_lost(line, &NO_DATA_TYPE, "the missing DataType is not reported");
        }
    }
}

/// Methods that count the results of comparisons.
impl Comparison<'_> {
    fn lose(&mut self, line: u32, what: impl Into<String>) {
        self.tally.lost.push(format!("{line}: {}", what.into()));
    }

    fn report(&mut self, code: &str) {
        *self.tally.reported.entry(code.to_owned()).or_default() += 1;
    }

    fn reported_or_lost(&mut self, line: u32, codes: &[&'static str], what: &str) {
        match self.code_on(line, codes) {
            Some(code) => self.report(code),
            None => self.lose(line, what),
        }
    }

    /// Returns the first of `codes` that is reported on `line`.
    fn code_on(&self, line: u32, codes: &[&'static str]) -> Option<&'static str> {
        self.codes.get(&line)?.iter().copied().find(|code| codes.contains(code))
    }

    /// Compares the value in the IR with the value on the line, and counts the result. `theirs` is `None` if the value on the
    /// line is invalid.
    fn hold<T: PartialEq + Debug>(&mut self, fact: &Fact, ours: &T, theirs: Option<&T>) {
        if theirs == Some(ours) {
            *self.tally.same.entry(fact.key.to_ascii_lowercase()).or_default() += 1;
        } else if let Some(code) = self.code_on(fact.line, &ABOUT_THE_VALUE) {
            self.report(code);
        } else {
            self.lose(fact.line, format!("{}={} became {ours:?}, not {theirs:?}", fact.key, fact.value));
        }
    }

    /// Compares and counts a value in the same way as `hold`. Values that CompactSubObj implies are counted separately,
    /// because one line describes many of them.
    fn hold_in<T: PartialEq + Debug>(&mut self, target: Target<'_>, fact: &Fact, ours: &T, theirs: Option<&T>) {
        match target.compact && target.item.is_some() && theirs == Some(ours) {
            true => self.tally.compact += 1,
            false => self.hold(fact, ours, theirs),
        }
    }
}

/// Returns whether CiA 306 defines the key for the section of an object or a sub-index.
fn is_keyword(key: &str) -> bool {
    let others = ["objflags", "datatype", "accesstype", "pdomapping", "defaultvalue", "lowlimit", "highlimit"];
    OF_THE_OBJECT.contains(&key) || others.contains(&key) || CONFIGURATION.contains(&key)
}

/// Keys that describe an object and not its value.
const OF_THE_OBJECT: [&str; 4] = ["parametername", "objecttype", "subnumber", "compactsubobj"];

const CONFIGURATION: [&str; 4] = ["parametervalue", "denotation", "uploadfile", "downloadfile"];

fn has_configuration(section: &Section) -> bool {
    CONFIGURATION.iter().any(|key| section.get(key).is_some_and(|fact| !fact.value.is_empty()))
}

/// Returns whether values of the type are texts or are stored as texts. Such a text includes the rest of its line.
fn is_free(ty: Type) -> bool {
    let is_text = matches!(ty, Type::VisibleString(_) | Type::UnicodeString(_));
    is_text || matches!(ty, Type::Domain | Type::Opaque(_) | Type::Named(_))
}

/// Parses a text as a value of type `ty`. Returns `None` if the text is invalid, and `Some(None)` if it is empty.
fn expected(text: &str, ty: Type, limit: bool) -> Option<Option<Value>> {
    let actual = if is_free(ty) { text } else { cut(text).0 };
    if actual.is_empty() {
        return Some(None);
    }
    let value = match ty {
        Type::VisibleString(_) | Type::UnicodeString(_) => Value::Text(actual.into()),
        _ if is_free(ty) => Value::Raw(actual.into()),
        Type::Boolean if actual.eq_ignore_ascii_case("true") => Value::Bool(true),
        Type::Boolean if actual.eq_ignore_ascii_case("false") => Value::Bool(false),
        Type::Boolean => match number::plain(actual)? {
            value @ (0 | 1) => Value::Bool(value == 1),
            value => Value::Int(value),
        },
        Type::Real32 | Type::Real64 if actual.contains('$') => match number::number(actual)? {
            Number::NodeId(offset) => Value::NodeId(offset),
            Number::Plain(_) => return None,
        },
        Type::Real32 => Value::Real(number::real(actual, 32)?),
        Type::Real64 => Value::Real(number::real(actual, 64)?),
        Type::OctetString(_) => Value::Bytes(number::octets(actual)?),
        Type::TimeOfDay | Type::TimeDifference => time(number::plain(actual)?).unwrap_or(Value::Raw(actual.into())),
        _ => match number::number(actual)? {
            Number::NodeId(offset) => Value::NodeId(offset),
            Number::Plain(value) if limit => Value::Int(e07_limit(value, actual, ty)),
            Number::Plain(value) => Value::Int(value),
        },
    };
    Some(Some(value))
}

/// E07: converts the limit of a signed type, which may be written as a bit pattern.
fn e07_limit(value: i128, text: &str, ty: Type) -> i128 {
    let Type::Integer(bits) = ty else { return value };
    let is_pattern = number::hex_digits(text).is_some() && value >> (bits - 1) == 1;
    if is_pattern {
        value - (1 << bits)
    } else {
        value
    }
}

/// Parses the 48 bits of a time: milliseconds in the lower 28 bits, 4 unused bits, and days in the upper 16 bits.
fn time(bits: i128) -> Option<Value> {
    let (milliseconds, days) = (bits & 0xFFFF_FFFF, bits >> 32);
    let fits = (0..=0xFFFF).contains(&days) && milliseconds < 1 << 28;
    fits.then_some(Value::Time { milliseconds: milliseconds as u32, days: days as u16 })
}

/// Parses a PDOMapping text for an item with the access rights `access`.
fn mappable(text: &str, access: Access) -> Option<Mappable> {
    let flag = match text.to_ascii_lowercase().as_str() {
        "true" => true,
        "false" => false,
        text => number::plain(text).filter(|value| (0..=1).contains(value))? == 1,
    };
    let written = matches!(access.name(), "wo" | "rw" | "rww");
    let read = matches!(access.name(), "ro" | "rw" | "rwr" | "const");
    Some(Mappable { rpdo: flag && written, tpdo: flag && read })
}

/// Compiles a text and compares the result with the text.
fn compared(name: &str, text: &str) -> Tally {
    compare(text, &check(Source::new(name, text.as_bytes().to_vec()), &as_it_stands()))
}

#[test]
fn no_value_is_lost_or_changed_without_a_diagnostic() {
    let Some(files) = files() else { return };
    let mut all = Tally::default();
    for file in files.iter().filter(|file| !file.is_xml()) {
        let compilation = check(Source::new(file.name.as_str(), file.bytes.clone()), &as_it_stands());
        if compilation.catalog.is_some() {
            all.add(compare(&file.text(), &compilation), &file.name);
        }
    }
    let (same, reported): (usize, usize) = (all.same.values().sum(), all.reported.values().sum());
    eprintln!("{same} values are equal: {:?}", all.same);
    eprintln!("{} values of sub-indices that follow from CompactSubObj are equal", all.compact);
    eprintln!("kept unchanged: {:?}", all.kept);
    eprintln!("{reported} are reported: {:?}; {} are empty", all.reported, all.empty);
    none_lost(&all);
    assert!(
        same > lane::at_least(330_000) && all.compact > lane::at_least(100_000),
        "only {same} and {} values were compared",
        all.compact
    );
    for (key, least) in
        [("defaultvalue", 38_000), ("accesstype", 54_000), ("parametername", 60_000), ("lowlimit", 5_500)]
    {
        assert!(all.same[key] > lane::at_least(least), "only {} times {key}", all.same[key]);
    }
    assert!(reported < 500, "{reported} reported values are more than real files have");
}

fn none_lost(tally: &Tally) {
    let shown = tally.lost.iter().take(40).map(|lost| format!("\n{lost}")).collect::<String>();
    assert!(tally.lost.is_empty(), "{} values are lost or changed without a diagnostic:{shown}", tally.lost.len());
}

/// Notations of values: the notations that occur in the corpus, and unusual notations.
#[rustfmt::skip]
const SPELLINGS: [&str; 60] = [
    "0", "1", "2", "7", "00", "001", "012", "018", "00000005", "-1", "-0", "-012", "0x0", "0X1a", "0xff",
    "0xFFFFFFFF", "0x80000000", "0x8000000000000000", "0xFFFFFFFFFFFFFFFF", "0x3FC00000", "0x3FF8000000000000",
    "0x02", "-0x77359400", "65536", "4294967296", "18446744073709551615", "-8388608",
    "99999999999999999999999999999999999999999999", "1.5", "1,5", "0.0", "-3.402823E+38", "1e3", "1e999", "nan",
    "inf", "true", "FALSE", "yes", "$NODEID", "$NODEID+0x180", "$nodeid + 5", "0x80+$NODEID", "$NODEID+1+2",
    "$NODEID-1", "$MY_NODE_ID+0x200", "10h", "FFh", "10UL", "01a105", "01 a1 05", "0x01a105", "0x123", "abc", "@ABCD",
    "\"abc\"", "5 ; five", "0x3ED ; a # b", "7 # seven", "rw",
];

/// Tests all notations with all types, for each kind of value of an object. The test does not need the corpus.
#[test]
fn every_spelling_of_every_type_is_read_or_reported() {
    let mut text = String::from("[DeviceInfo]\nProductName=x\n");
    let mut index = 0x2000;
    for ty in 0..=0x24 {
        for spelling in SPELLINGS {
            text += &format!(
                "[{index:04X}]\nParameterName={spelling}\nDataType={ty:#06x}\nAccessType=rw\nPDOMapping={spelling}\n"
            );
            for key in ["DefaultValue", "LowLimit", "HighLimit", "ParameterValue", "ObjFlags", "Denotation", "Unit"] {
                text += &format!("{key}={spelling}\n");
            }
            index += 1;
        }
    }
    let tally = compared("x.eds", &text);
    none_lost(&tally);
    let (same, reported): (usize, usize) = (tally.same.values().sum(), tally.reported.values().sum());
    eprintln!("{same} are equal, {reported} are reported: {:?}", tally.reported);
    assert!(
        same > lane::at_least(10_000) && reported > lane::at_least(3_000),
        "only {same} are equal and {reported} reported"
    );
}

/// Tests the comparison itself. The comparison must detect a difference if the compiler gets a changed text.
#[test]
fn whatever_is_lost_or_changed_is_seen() {
    let text = "[DeviceInfo]\nProductName=x\n[2000]\nParameterName=Speed\nObjectType=7\nDataType=0x0004\n\
                AccessType=rw\nDefaultValue=5 ; five\nLowLimit=-0x10\nHighLimit=0x20\nPDOMapping=1\nUnit=rpm\nParameterValue=7\n\
                [2001]\nParameterName=List\nObjectType=9\nSubNumber=2\n[2001sub0]\nParameterName=Count\nDataType=5\n\
                AccessType=const\nDefaultValue=1\n[2001sub1]\nParameterName=First\nDataType=9\nAccessType=ro\n\
                DefaultValue=a ; b\n[2002]\nParameterName=Compact\nObjectType=8\nDataType=6\nAccessType=rww\n\
                CompactSubObj=3\nDefaultValue=$NODEID+9\n[2002Name]\nNrOfEntries=1\n2=Second\n[2002Value]\n\
                NrOfEntries=1\n3=0x99\n";
    none_lost(&compared("x.dcf", text));
    let compilation = check(Source::new("x.dcf", text.as_bytes().to_vec()), &as_it_stands());
    for (from, to) in [
        ("=Speed", "=Sped"),
        ("ObjectType=7", "ObjectType=2"),
        ("0x0004", "0x0007"),
        ("=rw\n", "=ro\n"),
        ("=5 ;", "=6 ;"),
        ("=5 ; five", "=5 ; six"),
        ("DefaultValue=5 ; five\n", "\n"),
        ("=-0x10", "=0x10"),
        ("LowLimit=-0x10\n", "\n"),
        ("=0x20", "=20"),
        ("PDOMapping=1", "PDOMapping=0"),
        ("PDOMapping=1\n", "\n"),
        ("Unit=rpm", "Unit=rps"),
        ("Unit", "Uni"),
        ("=7\n[2001]", "=8\n[2001]"),
        ("[2001]", "[2003]"),
        ("SubNumber=2", "SubNumber=3"),
        ("[2001sub1]", "[2001sub2]"),
        ("AccessType=ro\n", "\n"),
        ("a ; b", "a"),
        ("CompactSubObj=3", "CompactSubObj=4"),
        ("$NODEID+9", "$NODEID+8"),
        ("2=Second", "3=Second"),
        ("=0x99", "=0x98"),
        ("[2002Value]", "[2002Name]"),
    ] {
        let other = text.replacen(from, to, 1);
        assert!(
            other != text && !compare(&other, &compilation).lost.is_empty(),
            "the comparison does not detect {to:?} instead of {from:?}"
        );
    }
}

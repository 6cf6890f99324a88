//! Tests that the compiler does not panic on damaged corpus files, on random combinations of EDS and XML words, or on
//! random text.
//!
//! Each input is compiled to Rust, exported and summarized, and its diagnostics are rendered. A fixed seed makes all runs
//! test the same inputs. `PROPTEST_RNG_SEED` and `PROPTEST_CASES` select other inputs:
//!
//! ```text
//! PROPTEST_CASES=100000 PROPTEST_RNG_SEED=7 cargo test --release -p lexibus-cli --test corpus_mutations
//! ```

#[path = "../../../codegen/tests/corpus_support/mod.rs"]
mod corpus_support;
#[path = "../exercise/mod.rs"]
mod exercise;
mod tables;

use std::cell::Cell;
use std::fmt::Debug;

use corpus_support::{all_files, lane, whole, File};
use exercise::exercise;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{select, subsequence, Index};
use proptest::test_runner::{RngSeed, TestError, TestRunner};

/// Minimum number of cases. With fewer cases, the share of inputs that reach the back end would vary too much.
const FEWEST: u32 = 40;

/// Returns a configuration with the given number of cases. A debug build runs a sixth of the cases. In the fast lane,
/// the number is divided by four. `PROPTEST_CASES` overrides the number.
fn config(cases: u32) -> ProptestConfig {
    let mut config = ProptestConfig { failure_persistence: None, max_shrink_iters: 3000, ..ProptestConfig::default() };
    if std::env::var_os("PROPTEST_CASES").is_none() {
        let part = if cfg!(debug_assertions) { 6 } else { 1 } * if lane::is_full() { 1 } else { 4 };
        config.cases = cases.div_ceil(part).max(FEWEST);
    }
    if std::env::var_os("PROPTEST_RNG_SEED").is_none() {
        config.rng_seed = RngSeed::Fixed(0x1018);
    }
    config
}

/// Runs `exercise` on the inputs that `make` creates. Prints the smallest input that fails.
///
/// At least `usable` percent of the inputs must reach the back end, so that the test exercises it.
fn hold<T: Debug + Clone>(
    cases: u32,
    usable: u32,
    strategy: impl Strategy<Value = T>,
    make: impl Fn(&T) -> (String, Vec<u8>),
) {
    let (all, reached) = (Cell::new(0), Cell::new(0));
    let outcome = TestRunner::new(config(cases)).run(&strategy, |value| {
        let (name, bytes) = make(&value);
        all.set(all.get() + 1);
        reached.set(reached.get() + u32::from(exercise(&name, &bytes)));
        Ok(())
    });
    if let Err(TestError::Fail(reason, value)) = outcome {
        let (name, bytes) = make(&value);
        panic!("{reason}\n{value:?}\n{name}: b\"{}\"", bytes.escape_ascii());
    }
    outcome.expect("no input was discarded");
    let (all, reached) = (all.get(), reached.get());
    eprintln!("{reached} of {all} inputs reach the back end");
    assert!(reached * 100 >= usable * all, "only {reached} of {all} inputs reach the back end");
}

/// A change to a file.
#[derive(Clone, Debug)]
enum Edit {
    Flip(Index, u8),
    Delete(Index, usize),
    Repeat(Index, usize),
    Insert(Index, &'static str),
    /// Replaces the value of the next entry or attribute after the position.
    Value(Index, &'static str),
    /// Replaces the text of the next XML element that has a text.
    Text(Index, &'static str),
    DeleteElement(Index),
    RepeatElement(Index),
    /// Moves the next XML element before another element.
    MoveElement(Index, Index),
    DeleteLine(Index),
    RepeatLine(Index),
    SwapLines(Index, Index),
    /// Inserts a part of another file.
    Splice(Index, Index, Index, usize),
    Truncate(Index),
}

fn edit() -> impl Strategy<Value = Edit> {
    let at = any::<Index>;
    prop_oneof![
        2 => (at(), 1..=255u8).prop_map(|(at, mask)| Edit::Flip(at, mask)),
        1 => (at(), 1..60usize).prop_map(|(at, length)| Edit::Delete(at, length)),
        1 => (at(), 1..60usize).prop_map(|(at, length)| Edit::Repeat(at, length)),
        2 => (at(), select(WORDS)).prop_map(|(at, word)| Edit::Insert(at, word)),
        6 => (at(), select(WORDS)).prop_map(|(at, word)| Edit::Value(at, word)),
        1 => at().prop_map(Edit::DeleteLine),
        1 => at().prop_map(Edit::RepeatLine),
        1 => (at(), at()).prop_map(|(one, other)| Edit::SwapLines(one, other)),
        1 => (at(), at(), at(), 1..600usize).prop_map(|(at, file, from, length)| Edit::Splice(at, file, from, length)),
        1 => at().prop_map(Edit::Truncate),
    ]
}

/// Valid and invalid words for values, keys, headers and elements.
#[rustfmt::skip]
const WORDS: &[&str] = &[
    "", "0", "1", "-1", "7", "8", "9", "254", "255", "256", "65535", "012", "018", "0x", "0x0", "0x7", "0xFFFF",
    "0x10000", "0xFFFFFFFF", "0x100000000", "-0x80000000", "0x8000000000000000", "18446744073709551615",
    "-9223372036854775808", "99999999999999999999999999999999999999", "1.5", "1,5", "1e999", "-0.0", "nan",
    "0x7FC00000", "$NODEID", "$NODEID+0x180", "0x80+$NODEID", "$NODEID+99999999999999999999999999999999999999", "$X",
    "0x60400010", "0x604100FF", "0x00050008", "0x1A000120", "0xFFFFFFFE", "ro", "rw", "rww", "const", "readWrite",
    "true", "\"", "\"a\"", "a\\", "\\\"", "*/", "/*", "//!", "///", "{}", "{{", "r#\"", "'", "`", "${x}", "%s", "#",
    " # x", ";", "; x", " ", "\t", "=", "==", "[", "]", "[]", "[2000]", "\n[2000]\n", "\n[2000sub0]\n",
    "\n[2000subFF]\n", "\n[1A00sub1]\n", "\n[2000Name]\n1=x\n", "\n[2000Value]\n9=x\n",
    "\n[M1SubExt2000]\nCount=0;2\n", "\nCompactSubObj=254\n", "\nSubNumber=3\n", "\nObjectType=9\n",
    "\nCompactPDO=0x17\n", "\nNrOfTXPDO=512\n", "\n../x.dcf\n", "self", "crate", "fn", "async", "_", "Self", "1st",
    "Gerät µ°", "日本", "\u{202e}", "\u{feff}", "\u{1b}[31m", "\0", "\r", "\n", "\u{1a}", "é", "\u{301}", "ß", "İ", "<",
    ">", "</", "/>", "<!--", "-->", "<![CDATA[", "]]>", "<?x?>", "&", "&amp;", "&#0;", "&#x10FFFF;", "&lt;!", "&x;",
    "<!DOCTYPE a [<!ENTITY x \"y\">]>", "UID_1", "FFFF", "1A00", "0001", "2000", "#x0", "#x1600",
    "#xFFFFFFFF", "#x", "BOOL", "DINT", "BIT3", "BITARR8", "STRING(5)", "STRING(99999999)", "ARRAY [0..254] OF BYTE",
    "ARRAY [0..99999999] OF ARRAY", "Unsigned16", "Float32", "Bit", "BitArea", "OctetString", "F_MessageTrailer4Byte",
    "0..4 7", "-5..5", "1..65535", "0..99999999", "0x00,0x01", "DependOnSlot", "TR", "MBoxOut", "Outputs", "PS",
];

/// A file or an excerpt of a file, with the changes to apply.
#[derive(Clone, Debug)]
struct Recipe {
    file: Index,
    from: Index,
    edits: Vec<Edit>,
}

fn recipe() -> impl Strategy<Value = Recipe> {
    (any::<Index>(), any::<Index>(), vec(edit(), 1..12)).prop_map(|(file, from, edits)| Recipe { file, from, edits })
}

/// Returns an excerpt of an EDS: its header and some objects.
fn excerpt(bytes: &[u8], from: &Index) -> Vec<u8> {
    const HEADER: usize = 700;
    const OBJECTS: usize = 6_000;
    if bytes.len() <= HEADER + OBJECTS {
        return bytes.to_vec();
    }
    let mut excerpt = bytes[..HEADER].to_vec();
    let start = HEADER + from.index(bytes.len() - HEADER);
    let start = start + bytes[start..].windows(2).position(|pair| pair == b"\n[").unwrap_or(0);
    excerpt.extend_from_slice(&bytes[start..bytes.len().min(start + OBJECTS)]);
    excerpt
}

fn apply(bytes: &mut Vec<u8>, edit: &Edit, files: &[File]) {
    let position = |at: &Index, bytes: &[u8]| at.index(bytes.len() + 1);
    match edit {
        Edit::Flip(at, mask) => {
            let at = at.index(bytes.len().max(1));
            bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= mask);
        }
        Edit::Delete(at, length) => {
            let start = position(at, bytes);
            bytes.drain(start..bytes.len().min(start + length));
        }
        Edit::Repeat(at, length) => {
            let start = position(at, bytes);
            let part = bytes[start..bytes.len().min(start + length)].to_vec();
            bytes.splice(start..start, part);
        }
        Edit::Insert(at, word) => {
            let start = position(at, bytes);
            bytes.splice(start..start, word.bytes());
        }
        Edit::Value(at, word) => {
            let start = position(at, bytes);
            let value = value_after(bytes, start);
            bytes.splice(value, word.bytes());
        }
        Edit::Text(at, word) => {
            let start = position(at, bytes);
            let text = text_after(bytes, start);
            if !text.is_empty() {
                bytes.splice(text, word.bytes());
            }
        }
        Edit::DeleteElement(at) => drop(bytes.drain(element_after(bytes, position(at, bytes)))),
        Edit::RepeatElement(at) => {
            let element = element_after(bytes, position(at, bytes));
            let part = bytes[element.clone()].to_vec();
            bytes.splice(element.start..element.start, part);
        }
        Edit::MoveElement(at, to) => {
            let element = element_after(bytes, position(at, bytes));
            let to = element_after(bytes, position(to, bytes)).start;
            if to <= element.start || to >= element.end {
                let part = bytes[element.clone()].to_vec();
                let to = if to >= element.end { to - part.len() } else { to };
                bytes.drain(element);
                bytes.splice(to..to, part);
            }
        }
        Edit::DeleteLine(at) => drop(bytes.drain(line_at(bytes, position(at, bytes)))),
        Edit::RepeatLine(at) => {
            let line = line_at(bytes, position(at, bytes));
            let part = bytes[line.clone()].to_vec();
            bytes.splice(line.start..line.start, part);
        }
        Edit::SwapLines(one, other) => {
            let [mut one, mut other] = [one, other].map(|at| line_at(bytes, position(at, bytes)));
            if one.start > other.start {
                std::mem::swap(&mut one, &mut other);
            }
            if one.end <= other.start {
                bytes[one.start..other.end].rotate_left(other.start - one.start);
            }
        }
        Edit::Splice(at, file, from, length) => {
            let other = &files[file.index(files.len())].bytes;
            let start = position(at, bytes);
            let from = from.index(other.len() + 1);
            bytes.splice(start..start, other[from..other.len().min(from + length)].iter().copied());
        }
        Edit::Truncate(at) => bytes.truncate(position(at, bytes)),
    }
}

/// Returns the range of the line at a position. The range includes the line end.
fn line_at(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    let start = bytes[..at].iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
    let end = bytes[at..].iter().position(|&byte| byte == b'\n').map_or(bytes.len(), |end| at + end + 1);
    start..end
}

/// Finds the next entry or attribute after a position, and returns the range of its value.
fn value_after(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    let Some(equals) = bytes[at..].iter().position(|&byte| byte == b'=') else { return at..at };
    let start = at + equals + 1;
    let (start, ends): (usize, &[u8]) =
        if bytes.get(start) == Some(&b'"') { (start + 1, b"\"") } else { (start, b"\r\n") };
    let length = bytes[start..].iter().position(|byte| ends.contains(byte)).unwrap_or(bytes.len() - start);
    start..start + length
}

/// Returns the range of the next text between XML tags after a position. Texts that contain only whitespace are
/// skipped.
fn text_after(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    let mut start = at;
    while let Some(end) = bytes[start..].iter().position(|&byte| byte == b'>') {
        start += end + 1;
        let length = bytes[start..].iter().position(|&byte| byte == b'<').unwrap_or(0);
        if bytes[start..start + length].iter().any(|byte| !byte.is_ascii_whitespace()) {
            return start..start + length;
        }
    }
    at..at
}

/// Returns the range of the next XML element after a position. Elements that contain most of a file, such as the root
/// element, are skipped.
fn element_after(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    /// Maximum size of an element. A larger element would contain most of a file.
    const LARGEST: usize = 20_000;
    let is_tag = |at: usize| bytes[at] == b'<' && bytes.get(at + 1).is_some_and(u8::is_ascii_alphabetic);
    let is_start = |at: usize| is_tag(at) && !in_comment(bytes, at);
    let starts = (at..bytes.len()).filter(|&at| is_start(at)).take(20);
    let mut elements = starts.filter_map(|start| Some(start..end_of_element(&bytes[start..])? + start));
    elements.find(|element| element.len() < LARGEST).unwrap_or(at..at)
}

/// Returns whether a position is inside an XML comment.
fn in_comment(bytes: &[u8], at: usize) -> bool {
    let last = |mark: &[u8]| bytes[..at].windows(mark.len()).rposition(|part| part == mark);
    last(b"<!--").is_some_and(|start| last(b"-->").is_none_or(|end| end < start))
}

/// Returns the end position of the element that starts at the first byte.
fn end_of_element(bytes: &[u8]) -> Option<usize> {
    let (mut at, mut depth) = (0, 0);
    loop {
        at += bytes.get(at..)?.iter().position(|&byte| byte == b'<')?;
        let mark: &[u8] = if bytes[at..].starts_with(b"<!--") { b"-->" } else { b">" };
        let end = at + bytes[at..].windows(mark.len()).position(|part| part == mark)? + mark.len();
        match bytes[at + 1] {
            b'!' | b'?' => {}
            b'/' => depth -= 1,
            _ if bytes[end - 2] == b'/' => {}
            _ => depth += 1,
        }
        at = end;
        if depth <= 0 {
            return Some(at);
        }
    }
}

fn of_kind(xml: bool) -> Option<Vec<File>> {
    const LARGEST_XML: usize = 150_000;
    let mut files = whole("eds")?;
    files.retain(|file| file.is_xml() == xml && (!xml || file.bytes.len() <= LARGEST_XML));
    Some(files)
}

#[test]
fn damaged_eds_files() {
    let Some(files) = of_kind(false) else { return };
    hold(1500, 90, recipe(), |recipe| {
        let file = &files[recipe.file.index(files.len())];
        let mut bytes = excerpt(&file.bytes, &recipe.from);
        recipe.edits.iter().for_each(|edit| apply(&mut bytes, edit, &files));
        (file.name.clone(), bytes)
    });
}

#[test]
fn damaged_xml_files() {
    let Some(files) = of_kind(true) else { return };
    hold(250, 5, recipe(), |recipe| {
        let file = &files[recipe.file.index(files.len())];
        let mut bytes = file.bytes.clone();
        recipe.edits.iter().for_each(|edit| apply(&mut bytes, edit, &files));
        (file.name.clone(), bytes)
    });
}

/// Tests XML files with changed values. The XML stays well-formed, so that the test reaches the code after the XML
/// parser.
#[test]
fn xml_files_with_other_values() {
    let Some(files) = of_kind(true) else { return };
    let harmless: Vec<&str> = WORDS.iter().copied().filter(|word| !word.contains(['<', '"', '&', '\0'])).collect();
    let values = vec((any::<Index>(), select(harmless)), 1..25);
    hold(250, 70, (any::<Index>(), values), |(file, values)| {
        let file = &files[file.index(files.len())];
        let mut bytes = file.bytes.clone();
        for (at, word) in values {
            apply(&mut bytes, &Edit::Value(*at, word), &files);
        }
        (file.name.clone(), bytes)
    });
}

/// Generates changes that keep XML well-formed: changed values, and removed, repeated or moved elements.
fn regular_edit() -> impl Strategy<Value = Edit> {
    let harmless: Vec<&str> = WORDS.iter().copied().filter(|word| !word.contains(['<', '"', '&', '\0'])).collect();
    let at = any::<Index>;
    prop_oneof![
        2 => (at(), select(harmless.clone())).prop_map(|(at, word)| Edit::Value(at, word)),
        4 => (at(), select(harmless)).prop_map(|(at, word)| Edit::Text(at, word)),
        1 => at().prop_map(Edit::DeleteElement),
        1 => at().prop_map(Edit::RepeatElement),
        2 => (at(), at()).prop_map(|(at, to)| Edit::MoveElement(at, to)),
    ]
}

/// Returns the corpus files of a format, except files that are too large to be processed many times.
fn small_files(format: &str) -> Option<Vec<File>> {
    const LARGEST: usize = 120_000;
    let mut files = whole(format)?;
    files.retain(|file| file.bytes.len() <= LARGEST);
    Some(files)
}

fn damaged(format: &str) {
    let Some(files) = small_files(format) else { return };
    hold(250, 5, recipe(), |recipe| {
        let file = &files[recipe.file.index(files.len())];
        let mut bytes = file.bytes.clone();
        recipe.edits.iter().for_each(|edit| apply(&mut bytes, edit, &files));
        (file.name.clone(), bytes)
    });
}

fn rearranged(format: &str) {
    let Some(files) = small_files(format) else { return };
    hold(400, 60, (any::<Index>(), vec(regular_edit(), 1..25)), |(file, edits)| {
        let file = &files[file.index(files.len())];
        let mut bytes = file.bytes.clone();
        edits.iter().for_each(|edit| apply(&mut bytes, edit, &files));
        (file.name.clone(), bytes)
    });
}

#[test]
fn damaged_esi_files() {
    damaged("esi");
}

#[test]
fn damaged_gsdml_files() {
    damaged("gsdml");
}

#[test]
fn rearranged_esi_files() {
    rearranged("esi");
}

#[test]
fn rearranged_gsdml_files() {
    rearranged("gsdml");
}

#[test]
fn truncated_files() {
    let Some(files) = whole("eds") else { return };
    hold(500, 70, (any::<Index>(), any::<Index>()), |(file, at)| {
        let file = &files[file.index(files.len())];
        let longest = file.bytes.len().min(30_000);
        (file.name.clone(), file.bytes[..at.index(longest + 1)].to_vec())
    });
}

#[test]
fn files_that_start_as_one_and_end_as_another() {
    let Some(files) = whole("eds") else { return };
    let part = || (any::<Index>(), any::<Index>(), 0..6_000usize);
    hold(500, 80, vec(part(), 2..4), |parts| {
        let name = files[parts[0].0.index(files.len())].name.clone();
        let mut bytes = Vec::new();
        for (position, (file, from, length)) in parts.iter().enumerate() {
            let other = &files[file.index(files.len())].bytes;
            let from = if position == 0 { 0 } else { from.index(other.len() + 1) };
            bytes.extend_from_slice(&other[from..other.len().min(from + length)]);
        }
        (name, bytes)
    });
}

/// Generates a file name with the extension of a format or without an extension.
fn name() -> impl Strategy<Value = &'static str> {
    select(&["x.eds", "x.dcf", "x.xdd", "x.xdc", "", "x"][..])
}

#[test]
fn noise() {
    let noise = prop_oneof![vec(any::<u8>(), 0..600), any::<String>().prop_map(String::into_bytes)];
    hold(1500, 0, (name(), noise), |(name, bytes)| ((*name).to_owned(), bytes.clone()));
}

const KEYS: &str = "\
    ParameterName ObjectType DataType AccessType DefaultValue LowLimit HighLimit PDOMapping SubNumber CompactSubObj \
    ObjFlags ParameterValue Denotation NrOfEntries 1 2 SupportedObjects NrOfRXPDO NrOfTXPDO CompactPDO Granularity \
    GroupMessaging Dummy0005 ProductName VendorNumber NodeID Lines Line1 Count ObjExtend NrOfSeg Type1 PPOffset1 \
    BaudRate_10 EDSVersion Unit";

const SECTIONS: &str = "\
    FileInfo DeviceInfo DummyUsage Comments MandatoryObjects OptionalObjects ManufacturerObjects DeviceComissioning \
    SupportedModules ConnectedModules DynamicChannels Tools 1000 1018 1018sub0 1018sub1 1400 1400sub1 1600 1600sub0 \
    1600sub1 1600sub2 1800 1A00 1A00sub0 1A00sub1 1F80 2000 2000sub0 2000sub1 2000subFF 2000Name 2000Value \
    2000Denotation 2000ObjectLinks 6040 6041 6060 607A A0 00A0 0005 M1ModuleInfo M1FixedObjects M1Fixed2000 \
    M1Fixed2000sub1 M1SubExtends M1SubExt2000 M1Comments x";

/// Selects a word from a list that is separated by spaces.
fn one_of(list: &'static str) -> impl Strategy<Value = &'static str> + Clone {
    select(list.split(' ').collect::<Vec<_>>())
}

/// Tests texts that consist of EDS section headers, entries and values, and of lines with random text, in random order.
#[test]
fn texts_of_the_words_of_an_eds() {
    let line = prop_oneof![
        3 => one_of(SECTIONS).prop_map(|name| format!("[{name}]\n")),
        8 => (one_of(KEYS), select(WORDS)).prop_map(|(key, value)| format!("{key}={value}\n")),
        1 => select(WORDS).prop_map(str::to_owned),
        1 => "\\PC{0,20}".prop_map(|text| text + "\n"),
    ];
    hold(1500, 80, (name(), vec(line, 0..120)), |(name, lines)| ((*name).to_owned(), lines.concat().into_bytes()));
}

const ELEMENTS: &str = "\
    ISO15745ProfileContainer ISO15745Profile ProfileHeader ProfileBody DeviceIdentity vendorName vendorID \
    DeviceManager DeviceFunction ApplicationProcess dataTypeList struct varDeclaration array subrange enum enumValue \
    derived BOOL UINT DINT STRING dataTypeIDRef parameterList parameter label description labelRef allowedValues \
    value range minValue maxValue defaultValue unit property templateList parameterTemplate allowedValuesTemplate \
    ApplicationLayers CANopenObjectList CANopenObject CANopenSubObject dummyUsage dummy dynamicChannels \
    dynamicChannel moduleManagement interfaceList TransportLayers PhysicalLayer baudRate supportedBaudRate \
    NetworkManagement CANopenGeneralFeatures CANopenMasterFeatures deviceCommissioning identity x";

const ATTRIBUTES: &str = "\
    index subIndex name objectType dataType accessType defaultValue actualValue lowLimit highLimit PDOmapping \
    objFlags uniqueIDRef uniqueID subNumber value lang access size lowerLimit upperLimit entry nodeID granularity \
    nrOfRxPDO xsi:type xmlns templateIDRef multiplier denotation";

fn escape(word: &str) -> String {
    word.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

/// Generates an XML element with attributes, text and children.
fn element() -> impl Strategy<Value = String> {
    // Repeated attributes would make the XML ill-formed.
    let attributes = (subsequence(ATTRIBUTES.split(' ').collect::<Vec<_>>(), 0..6), vec(select(WORDS), 6));
    let open = (one_of(ELEMENTS), attributes).prop_map(|(name, (keys, values))| {
        let written = keys.iter().zip(&values).map(|(key, value)| format!(" {key}=\"{}\"", escape(value)));
        (name, written.collect::<String>())
    });
    let leaf = (open.clone(), select(WORDS)).prop_map(|((name, attributes), text)| match text {
        "" => format!("<{name}{attributes}/>"),
        text => format!("<{name}{attributes}>{}</{name}>", escape(text)),
    });
    leaf.prop_recursive(6, 60, 8, move |inner| {
        (open.clone(), vec(inner, 0..8))
            .prop_map(|((name, attributes), children)| format!("<{name}{attributes}>{}</{name}>\n", children.concat()))
    })
}

#[test]
fn trees_of_the_elements_of_an_xdd() {
    const HEAD: &str =
        "<ISO15745ProfileContainer><ISO15745Profile><ProfileBody xsi:type=\"ProfileBody_Device_CANopen\">";
    const MIDDLE: &str = "</ProfileBody></ISO15745Profile><ISO15745Profile><ProfileBody \
                          xsi:type=\"ProfileBody_CommunicationNetwork_CANopen\"><ApplicationLayers><CANopenObjectList>";
    const TAIL: &str =
        "</CANopenObjectList></ApplicationLayers></ProfileBody></ISO15745Profile></ISO15745ProfileContainer>";
    hold(800, 95, (name(), vec(element(), 0..4), vec(element(), 0..4)), |(name, device, network)| {
        let text = format!("{HEAD}{}{MIDDLE}{}{TAIL}", device.concat(), network.concat());
        ((*name).to_owned(), text.into_bytes())
    });
}

#[test]
fn texts_of_the_words_of_an_xdd() {
    let part = prop_oneof![
        4 => (one_of(ELEMENTS), one_of(ATTRIBUTES), select(WORDS), select(&["/>", ">", "", ">\n", "/>\n"][..]))
            .prop_map(|(element, attribute, word, end)| format!("<{element} {attribute}=\"{word}\"{end}")),
        2 => one_of(ELEMENTS).prop_map(|element| format!("</{element}>")),
        1 => select(WORDS).prop_map(str::to_owned),
        1 => element(),
    ];
    hold(1000, 0, (name(), vec(part, 0..40)), |(name, parts)| {
        let text = format!("<ISO15745ProfileContainer>{}</ISO15745ProfileContainer>", parts.concat());
        ((*name).to_owned(), text.into_bytes())
    });
}

/// The output must not depend on hash seeds or memory addresses, which differ between threads.
#[test]
fn two_runs_give_the_same_bytes() {
    let Some(files) = all_files() else { return };
    let made = |file: &File| {
        let options = Options::default();
        let compilation = check(Source::new(file.name.as_str(), file.bytes.clone()), &options);
        let found: Vec<String> = compilation.diagnostics.list().iter().map(|one| compilation.one_line(one)).collect();
        let dump = compilation.catalog.as_ref().map(|catalog| serde_json::to_string(catalog).expect("JSON"));
        let text = compilation.rust(&options.rust).unwrap_or_default() + &dump.unwrap_or_default();
        (text, found)
    };
    let mut bytes = 0;
    for file in &files {
        let [one, other] = std::thread::scope(|scope| {
            [(); 2].map(|()| scope.spawn(|| made(file))).map(|run| run.join().expect("no panic"))
        });
        assert_eq!(one.1, other.1, "{}: different diagnostics", file.name);
        let differing = one.0.lines().zip(other.0.lines()).zip(1..).find(|((one, other), _)| one != other);
        assert_eq!(differing, None, "{}: the second output differs, starting at this line", file.name);
        assert_eq!(one.0.len(), other.0.len(), "{}", file.name);
        bytes += one.0.len();
    }
    assert!(bytes > lane::at_least(10_000_000), "only {bytes} bytes were emitted");
}

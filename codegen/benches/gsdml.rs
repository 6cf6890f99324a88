//! From the bytes of a GSDML file to checked IR, against a bare event loop of `quick-xml` over the same bytes that takes the
//! position of each event and does nothing else.
//!
//! The input is made here: a drive with 50,000 parameters, value lists and texts in five languages. `cargo bench -p
//! lexibus-codegen --bench gsdml` prints the ratio of the two, also for the corpus where it is there; then the single
//! measurements. The most that `read_and_check` has allocated, less what `ir` has, is the memory that reading takes beside
//! the IR.

use std::fmt::Write;
use std::path::Path;
use std::time::{Duration, Instant};

use divan::counter::BytesCount;
use divan::{AllocProfiler, Bencher};
use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::source::Source;
use quick_xml::events::Event;
use quick_xml::Reader;

/// Tells how much each measurement has allocated at most.
#[global_allocator]
static ALLOCATOR: AllocProfiler = AllocProfiler::system();

/// Number of parameters.
const PARAMETERS: usize = 50_000;

/// Parameters of a record.
const OF_A_RECORD: usize = 20;

/// Submodules, each of which has its share of the records.
const SUBMODULES: usize = 100;

const LANGUAGES: [&str; 5] = ["de", "fr", "it", "es", "zh"];

/// Texts of parameters; several parameters share one.
const TEXTS: usize = 12_000;

const VALUE_ITEMS: usize = 400;

fn main() {
    let text = description();
    report("made by the bench", std::slice::from_ref(&text));
    if let Some(files) = corpus() {
        report("corpus", &files);
    }
    divan::main();
}

/// Prints both times and their ratio, and the memory.
fn report(name: &str, files: &[Vec<u8>]) {
    let length: usize = files.iter().map(Vec::len).sum();
    let repetitions = (200_000_000 / length.max(1)).clamp(5, 50);
    let (mut bare, mut attributes, mut full) = (Duration::MAX, Duration::MAX, Duration::MAX);
    // In turn, and the least of each, so that both have the same luck.
    for _ in 0..repetitions {
        bare = bare.min(time(|| files.iter().map(|file| events(file)).sum::<usize>()));
        attributes = attributes.min(time(|| files.iter().map(|file| attributes_of(file)).sum::<usize>()));
        let copies = files.to_vec();
        full = full.min(time(|| copies.into_iter().map(check).collect::<Vec<_>>()));
    }
    let speed = |time: Duration| length as f64 / 1e6 / time.as_secs_f64();
    let ratio = |time: Duration| time.as_secs_f64() / full.as_secs_f64();
    println!("{name}: {:.1} MB", length as f64 / 1e6);
    println!("  bytes to checked IR                    {:6.1} MB/s", speed(full));
    println!("  events with positions                  {:6.1} MB/s, ratio {:.2}", speed(bare), ratio(bare));
    println!("  the same, and names of the attributes  {:6.1} MB/s, ratio {:.2}", speed(attributes), ratio(attributes));
}

fn time<T>(work: impl FnOnce() -> T) -> Duration {
    let start = Instant::now();
    let result = divan::black_box(work());
    let elapsed = start.elapsed();
    drop(result);
    elapsed
}

fn check(bytes: Vec<u8>) -> Compilation {
    compile::check(Source::new("bench.xml", bytes), &Options::default())
}

/// All events of a file, with the position of each.
fn events(bytes: &[u8]) -> usize {
    let mut reader = Reader::from_reader(bytes);
    let mut sum = 0;
    loop {
        match reader.read_event().expect("well-formed XML") {
            Event::Eof => return sum,
            event => {
                divan::black_box(&event);
                sum += reader.buffer_position() as usize;
            }
        }
    }
}

/// The same, and the attributes of every tag, undecoded: GSDML says next to nothing but by attributes.
fn attributes_of(bytes: &[u8]) -> usize {
    let mut reader = Reader::from_reader(bytes);
    let mut sum = 0;
    loop {
        match reader.read_event().expect("well-formed XML") {
            Event::Eof => return sum,
            Event::Start(tag) | Event::Empty(tag) => {
                sum += tag.attributes().map(|attribute| attribute.expect("an attribute").value.len()).sum::<usize>();
                sum += reader.buffer_position() as usize;
            }
            event => {
                divan::black_box(&event);
                sum += reader.buffer_position() as usize;
            }
        }
    }
}

fn corpus() -> Option<Vec<Vec<u8>>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/corpus/gsdml");
    let entries = std::fs::read_dir(folder).ok()?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let files = paths.filter(|path| path.extension().is_some_and(|extension| extension == "xml"));
    // Two files aren't well formed. All are compared as UTF-8, which is what `quick-xml` reads.
    let checked = files.filter_map(|path| std::fs::read(path).ok()).map(check);
    let checked = checked.filter(|compilation| compilation.catalog.is_some());
    Some(checked.filter_map(|compilation| Some(compilation.sources.first()?.text().as_bytes().to_vec())).collect())
}

#[divan::bench]
fn events_with_positions(bencher: Bencher<'_, '_>) {
    let text = description();
    bencher.counter(BytesCount::new(text.len())).bench(|| events(divan::black_box(&text)));
}

/// Bytes to IR, as the source has it.
#[divan::bench]
fn read(bencher: Bencher<'_, '_>) {
    let text = description();
    bencher
        .counter(BytesCount::new(text.len()))
        .with_inputs(|| text.clone())
        .bench_values(|bytes| compile::read(Source::new("bench.xml", bytes), &Options::default()));
}

/// Bytes to checked IR.
#[divan::bench]
fn read_and_check(bencher: Bencher<'_, '_>) {
    let text = description();
    bencher.counter(BytesCount::new(text.len())).with_inputs(|| text.clone()).bench_values(check);
}

/// A copy of the IR and of nothing else.
#[divan::bench]
fn ir(bencher: Bencher<'_, '_>) {
    let compilation = check(description());
    bencher.bench(|| compilation.catalog.clone());
}

/// The description of a drive, in the words and with the proportions of real ones.
fn description() -> Vec<u8> {
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n");
    text += "<ISO15745Profile xmlns=\"http://www.profibus.com/GSDML/2003/11/DeviceProfile\">\n  <ProfileBody>\n";
    text += "    <DeviceIdentity VendorID=\"0x0FFF\" DeviceID=\"0x0001\">\n      <InfoText TextId=\"TXT_0\"/>\n";
    text += "      <VendorName Value=\"Bench\"/>\n    </DeviceIdentity>\n    <ApplicationProcess>\n";
    device(&mut text);
    text += "      <ModuleList>\n";
    for number in 0..SUBMODULES {
        module(&mut text, number);
    }
    text += "      </ModuleList>\n      <ValueList>\n";
    for number in 0..VALUE_ITEMS {
        value_item(&mut text, number);
    }
    text += "      </ValueList>\n      <ExternalTextList>\n";
    texts(&mut text, "PrimaryLanguage", "");
    for language in LANGUAGES {
        texts(&mut text, "Language", language);
    }
    text += "      </ExternalTextList>\n    </ApplicationProcess>\n  </ProfileBody>\n</ISO15745Profile>\n";
    text.into_bytes()
}

fn device(text: &mut String) {
    text.push_str("      <DeviceAccessPointList>\n        <DeviceAccessPointItem ID=\"DAP_1\" ");
    text.push_str(
        "ModuleIdentNumber=\"0x00000001\" PNIO_Version=\"V2.35\" PhysicalSlots=\"0..200\" FixedInSlots=\"0\" ",
    );
    text.push_str("MinDeviceInterval=\"32\" DNS_CompatibleName=\"bench\" ObjectUUID_LocalIndex=\"1\">\n");
    text.push_str(
        "          <ModuleInfo>\n            <Name TextId=\"TXT_1\"/>\n            <InfoText TextId=\"TXT_2\"/>\n",
    );
    text.push_str("          </ModuleInfo>\n          <UseableModules>\n");
    for number in 0..SUBMODULES {
        let _ =
            writeln!(text, "            <ModuleItemRef ModuleItemTarget=\"MOD_{number}\" AllowedInSlots=\"1..200\"/>");
    }
    text.push_str("          </UseableModules>\n        </DeviceAccessPointItem>\n      </DeviceAccessPointList>\n");
}

fn module(text: &mut String, number: usize) {
    let _ = writeln!(text, "        <ModuleItem ID=\"MOD_{number}\" ModuleIdentNumber=\"0x{:08X}\">", 0x100 + number);
    let _ = writeln!(text, "          <ModuleInfo>\n            <Name TextId=\"TXT_{number}\"/>");
    text.push_str(
        "            <InfoText TextId=\"TXT_2\"/>\n          </ModuleInfo>\n          <VirtualSubmoduleList>\n",
    );
    let _ = write!(text, "            <VirtualSubmoduleItem ID=\"SUB_{number}\" SubmoduleIdentNumber=\"0x00000001\" ");
    text.push_str("API=\"14848\" MayIssueProcessAlarm=\"false\">\n              <IOData>\n");
    for (direction, words) in [("Input", 12), ("Output", 10)] {
        let _ = writeln!(text, "                <{direction} Consistency=\"All items consistency\">");
        for word in 0..words {
            let _ =
                write!(text, "                  <DataItem DataType=\"Unsigned16\" TextId=\"TXT_{}\"", word + number);
            text.push_str(if word == 0 { " UseAsBits=\"true\">\n" } else { "/>\n" });
            if word == 0 {
                for bit in 0..16 {
                    let _ =
                        writeln!(text, "                    <BitDataItem BitOffset=\"{bit}\" TextId=\"TXT_{bit}\"/>");
                }
                text.push_str("                  </DataItem>\n");
            }
        }
        let _ = writeln!(text, "                </{direction}>");
    }
    text.push_str("              </IOData>\n              <RecordDataList>\n");
    let of_a_submodule = PARAMETERS / SUBMODULES / OF_A_RECORD;
    for record in 0..of_a_submodule {
        parameters(text, number * of_a_submodule + record, record);
    }
    text.push_str("              </RecordDataList>\n            </VirtualSubmoduleItem>\n");
    text.push_str("          </VirtualSubmoduleList>\n        </ModuleItem>\n");
}

fn parameters(text: &mut String, record: usize, index: usize) {
    let length = OF_A_RECORD * 4;
    let _ = writeln!(text, "                <ParameterRecordDataItem Index=\"{index}\" Length=\"{length}\">");
    let _ = writeln!(text, "                  <Name TextId=\"TXT_{}\"/>", record % TEXTS);
    for position in 0..OF_A_RECORD {
        let number = record * OF_A_RECORD + position;
        let (name, offset, value) = (number % TEXTS, position * 4, number % VALUE_ITEMS);
        let _ = write!(text, "                  <Ref ID=\"P{number}\" ByteOffset=\"{offset}\" TextId=\"TXT_{name}\" ");
        let rest = match position % 5 {
            0 => format!(
                "DataType=\"Unsigned8\" DefaultValue=\"1\" AllowedValues=\"0..7\" ValueItemTarget=\"VAL_{value}\""
            ),
            1 => "DataType=\"Integer16\" DefaultValue=\"-100\" AllowedValues=\"-32768..32767\"".to_owned(),
            2 => "DataType=\"Float32\" DefaultValue=\"1.5\" AllowedValues=\"-1000.0..1000.0\"".to_owned(),
            3 => "DataType=\"Bit\" BitOffset=\"3\" DefaultValue=\"0\" AllowedValues=\"0..1\"".to_owned(),
            _ => "DataType=\"Unsigned32\" DefaultValue=\"4000\" AllowedValues=\"0..4000000000\"".to_owned(),
        };
        let _ = writeln!(text, "{rest} Changeable=\"true\" Visible=\"true\"/>");
    }
    text.push_str("                </ParameterRecordDataItem>\n");
}

fn value_item(text: &mut String, number: usize) {
    let _ = writeln!(text, "        <ValueItem ID=\"VAL_{number}\">\n          <Assignments>");
    for value in 0..8 {
        let _ = writeln!(text, "            <Assign TextId=\"TXT_{}\" Content=\"{value}\"/>", number * 8 + value);
    }
    text.push_str("          </Assignments>\n        </ValueItem>\n");
}

fn texts(text: &mut String, element: &str, language: &str) {
    let attribute = if language.is_empty() { String::new() } else { format!(" xml:lang=\"{language}\"") };
    let _ = writeln!(text, "        <{element}{attribute}>");
    for number in 0..TEXTS {
        let name = format!("Speed controller: limit {number} of the set-point {language}");
        let _ = writeln!(text, "          <Text TextId=\"TXT_{number}\" Value=\"{name}\"/>");
    }
    let _ = writeln!(text, "        </{element}>");
}

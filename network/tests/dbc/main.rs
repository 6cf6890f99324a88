//! Decodes random frames with `cantools` and the exported DBC, and compares the physical values with the values computed
//! from the device descriptions.
//!
//! The expected values are computed from the mapping, types and scales of the objects. In the full lane, a second test compares `cantools`
//! with the generated Rust. If the corpus or a Python with `cantools` is missing, a test that needs it prints a
//! message and passes. If the Python that `LEXIBUS_PYTHON` names lacks `cantools`, the tests fail.

#[path = "../../../codegen/tests/corpus_support/mod.rs"]
mod corpus_support;
#[path = "../generated/mod.rs"]
mod generated;
mod names;
#[path = "../dcfgen/random.rs"]
mod random;
mod unpacked;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use corpus_support::{files_of, folder_of, lane, python};
use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::facts::types;
use lexibus_codegen::ir::{Direction, Item, Scale, Type};
use lexibus_codegen::source::Source;
use lexibus_network::compile::{compile, Compilation};
use lexibus_network::model::{MappedObject, Network, NetworkNode, NetworkPdo};
use lexibus_network::output::dbc;
use random::Random;
use serde::Deserialize;

/// Result of `decode.py` for one network.
#[derive(Debug, Deserialize)]
struct Verdict {
    compared: usize,
    differences: Vec<String>,
}

/// Returns the number of random frames for each PDO.
fn frames() -> usize {
    if lane::is_full() {
        10_000
    } else {
        50
    }
}

/// Returns the physical value of an item from its bits in a frame.
fn physical(node: &NetworkNode, item: &Item, bits: u64, length: u32) -> String {
    let ty = types::basic(&node.device().types, item.object_type());
    let raw = match ty {
        Type::Real32 if length == 32 => return format!("{:e}", f64::from(f32::from_bits(bits as u32))),
        Type::Real64 if length == 64 => return format!("{:e}", f64::from_bits(bits)),
        Type::Integer(_) if length < 64 && bits >> (length - 1) != 0 => i128::from(bits) - (1 << length),
        Type::Integer(_) => i128::from(bits as i64),
        _ => i128::from(bits),
    };
    match item.quantity.as_ref().and_then(|quantity| quantity.scale.as_ref()) {
        Some(Scale::Linear { factor, offset }) => format!("{:e}", raw as f64 * factor + offset),
        _ => raw.to_string(),
    }
}

/// Returns the physical values of the mapped objects in a frame, each after a semicolon.
fn expected(node: &NetworkNode, pdo: &NetworkPdo, word: u64) -> String {
    let mut text = String::new();
    for (start, entry) in signals(node, pdo) {
        let length = u32::from(entry.bits);
        let bits = word >> start & u64::MAX >> (64 - length);
        let item = node.item((entry.index, entry.sub_index)).expect("an item");
        let _ = write!(text, ";{}", physical(node, item, bits, length));
    }
    text
}

/// Returns the mapped objects that the DBC contains, each with its bit offset.
fn signals<'p>(node: &NetworkNode, pdo: &'p NetworkPdo) -> Vec<(u32, &'p MappedObject)> {
    let mut start = 0;
    let with_start = |entry: &'p MappedObject| {
        start += u32::from(entry.bits);
        (start - u32::from(entry.bits), entry)
    };
    let is_known = |(_, entry): &(u32, &MappedObject)| {
        entry.index >= 0x1000 && node.item((entry.index, entry.sub_index)).is_some()
    };
    pdo.entries.iter().map(with_start).filter(is_known).collect()
}

/// Returns the enabled PDOs with 1 to 64 bits, one for each CAN-ID. A TPDO takes precedence over an RPDO with the same CAN-ID.
fn pdos(network: &Network) -> Vec<(&NetworkNode, &NetworkPdo)> {
    let all = network.pdos(Direction::Transmit).chain(network.pdos(Direction::Receive));
    let mut known = std::collections::HashSet::new();
    all.filter(|(_, pdo)| (1..=64).contains(&pdo.bits()) && known.insert(pdo.can_id())).collect()
}

/// A compiled network, and the folder with its DBC and frames.
pub struct Sample {
    compilation: Compilation,
    folder: PathBuf,
}

impl Sample {
    /// Compiles a network and writes its DBC. Returns `None` if the file cannot be compiled, if no enabled PDO has data, or if a PDO
    /// has more than 64 bits.
    fn new(root: &Path, source: Source) -> Option<Self> {
        let compilation = compile(source, Levels::lenient());
        let network = compilation.network.as_ref()?;
        // `cantools` rejects messages with more than 64 bits.
        let is_valid = network.nodes.iter().flat_map(|node| &node.pdos).all(|pdo| pdo.bits() <= 64);
        if pdos(network).is_empty() || !is_valid {
            return None;
        }
        let folder = root.join(std::fs::read_dir(root).expect("a folder").count().to_string());
        std::fs::create_dir_all(&folder).expect("a folder");
        std::fs::write(folder.join("network.dbc"), dbc(network)).expect("a file");
        Some(Sample { compilation, folder })
    }

    fn network(&self) -> &Network {
        self.compilation.network.as_ref().expect("a network")
    }

    /// Writes random frames of all PDOs to `frames.txt`. Each line contains the CAN-ID, the data, and the result of `values`.
    fn write_frames(&self, random: &mut Random, values: Values<'_>) {
        let mut text = String::new();
        for (node, pdo) in pdos(self.network()) {
            for _ in 0..frames() {
                let data = random.next().to_le_bytes();
                let bytes: String = data[..pdo.bytes() as usize].iter().map(|byte| format!("{byte:02x}")).collect();
                let _ = writeln!(text, "{};{bytes}{}", pdo.can_id(), values(node, pdo, u64::from_le_bytes(data)));
            }
        }
        std::fs::write(self.folder.join("frames.txt"), text).expect("a file");
    }
}

/// Function that returns the values in a frame, each after a semicolon.
type Values<'v> = &'v dyn Fn(&NetworkNode, &NetworkPdo, u64) -> String;

/// Returns up to 50 samples. Each sample is a network with one device of the corpus.
fn samples(name: &str, corpus: &Path) -> Vec<Sample> {
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&root);
    std::fs::create_dir_all(&root).expect("a folder");
    let files = files_of("eds").expect("the corpus").into_iter();
    let sample = |file: corpus_support::File| {
        let text = format!("[master]\nid = 127\n[nodes]\nnode = {{ id = 5, device = {:?} }}\n", file.name);
        Sample::new(&root, Source::new("network.toml", text.into_bytes()).in_folder(corpus))
    };
    files.filter_map(sample).take(50).collect()
}

/// Decodes the frames of all samples with `cantools`, and asserts that the results are the values in `frames.txt`. Returns
/// the number of values.
fn compare(python: &Path, samples: &[Sample]) -> usize {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/dbc/decode.py");
    let folders = samples.iter().map(|sample| &sample.folder);
    let output = Command::new(python).arg(script).args(folders).output().expect("Python runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let verdicts: Vec<Verdict> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(verdicts.len(), samples.len());
    let differences: Vec<&String> = verdicts.iter().flat_map(|verdict| &verdict.differences).collect();
    assert!(differences.is_empty(), "{differences:#?}");
    let compared = verdicts.iter().map(|verdict| verdict.compared).sum();
    eprintln!("{} files, {compared} values", samples.len());
    compared
}

#[test]
fn cantools_decodes_the_same_values() {
    let (Some(python), Some(corpus)) = (python::with(&["cantools"]), folder_of("eds")) else { return };
    let samples = samples("dbc", &corpus);
    assert!(samples.len() >= if lane::is_full() { 50 } else { 5 }, "only {} files", samples.len());
    let mut random = Random(30);
    samples.iter().for_each(|sample| sample.write_frames(&mut random, &expected));
    assert!(compare(&python, &samples) > 0);
}

//! Decodes random frames with `cantools` and the exported DBC, and compares the physical values with those of the device descriptions.
//!
//! The expected values are computed from the mapping words, types and scales of the objects. If there is no corpus or no Python with
//! `cantools`, the test prints a message and passes.

#[path = "../../../codegen/tests/corpus_support/mod.rs"]
mod corpus_support;
mod names;
#[path = "../dcfgen/random.rs"]
mod random;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use corpus_support::{files_of, folder_of, lane, python};
use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::facts::types;
use lexibus_codegen::ir::{Direction, Item, Scale, Type};
use lexibus_codegen::source::Source;
use lexibus_network::compile::compile;
use lexibus_network::model::{Network, NetworkNode, NetworkPdo};
use lexibus_network::output::dbc;
use random::Random;
use serde::Deserialize;

/// The result for one network.
#[derive(Debug, Deserialize)]
struct Verdict {
    compared: usize,
    differences: Vec<String>,
}

/// Number of frames of each PDO.
fn frames() -> usize {
    if lane::is_full() {
        10_000
    } else {
        50
    }
}

/// Returns the physical value of the bits of an item.
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

/// Writes random frames of a PDO with their physical values.
fn write(text: &mut String, node: &NetworkNode, pdo: &NetworkPdo, random: &mut Random) {
    for _ in 0..frames() {
        let data = random.next().to_le_bytes();
        let word = u64::from_le_bytes(data);
        let bytes: String = data[..pdo.bytes() as usize].iter().map(|byte| format!("{byte:02x}")).collect();
        let _ = write!(text, "{};{bytes}", pdo.can_id());
        let mut start = 0;
        for entry in &pdo.entries {
            let length = u32::from(entry.bits);
            let bits = word >> start & u64::MAX >> (64 - length);
            if let Some(item) = node.item((entry.index, entry.sub_index)).filter(|_| entry.index >= 0x1000) {
                let _ = write!(text, ";{}", physical(node, item, bits, length));
            }
            start += length;
        }
        text.push('\n');
    }
}

/// Returns the PDOs of a network that the DBC contains, and that a frame can hold.
fn pdos(network: &Network) -> Vec<(&NetworkNode, &NetworkPdo)> {
    let all = network.pdos(Direction::Transmit).chain(network.pdos(Direction::Receive));
    let mut known = std::collections::HashSet::new();
    all.filter(|(_, pdo)| (1..=64).contains(&pdo.bits()) && known.insert(pdo.can_id())).collect()
}

#[test]
fn cantools_decodes_the_same_values() {
    let (Some(python), Some(corpus)) = (python::with(&["cantools"]), folder_of("eds")) else { return };
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("dbc");
    let _ = std::fs::remove_dir_all(&root);
    let (mut random, mut folders): (Random, Vec<PathBuf>) = (Random(30), Vec::new());
    for file in files_of("eds").expect("the corpus") {
        let text = format!("[master]\nid = 127\n[nodes]\nnode = {{ id = 5, device = {:?} }}\n", file.name);
        let source = Source::new("network.toml", text.into_bytes()).in_folder(&corpus);
        let compilation = compile(source, Levels::lenient());
        let Some(network) = &compilation.network else { continue };
        let pdos = pdos(network);
        // `cantools` rejects messages that are longer than a frame.
        let is_valid = network.nodes.iter().flat_map(|node| &node.pdos).all(|pdo| pdo.bits() <= 64);
        if pdos.is_empty() || !is_valid || folders.len() == 50 {
            continue;
        }
        let folder = root.join(folders.len().to_string());
        std::fs::create_dir_all(&folder).expect("a folder");
        let mut text = String::new();
        pdos.iter().for_each(|(node, pdo)| write(&mut text, node, pdo, &mut random));
        std::fs::write(folder.join("network.dbc"), dbc(network)).expect("a file");
        std::fs::write(folder.join("frames.txt"), text).expect("a file");
        folders.push(folder);
    }
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/dbc/decode.py");
    let output = Command::new(&python).arg(script).args(&folders).output().expect("Python runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let verdicts: Vec<Verdict> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let compared: usize = verdicts.iter().map(|verdict| verdict.compared).sum();
    eprintln!("{} files, {compared} values", verdicts.len());
    assert!(verdicts.len() >= if lane::is_full() { 50 } else { 5 } && compared > 0, "only {} files", verdicts.len());
    let differences: Vec<&String> = verdicts.iter().flat_map(|verdict| &verdict.differences).collect();
    assert!(differences.is_empty(), "{differences:#?}");
}

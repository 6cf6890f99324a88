//! Functions that compile networks, change device descriptions, and read output files.

// Some tests use only a part of this module.
#![allow(dead_code)]

use std::path::{Path, PathBuf};

use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::source::Source;
use lexibus_network::compile::{compile, Compilation};
use lexibus_network::model::{Network, NetworkNode};

/// An entry of a concise DCF: index, sub-index and bytes.
pub type Entry = (u16, u8, Vec<u8>);

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Returns the text of a file of the example network.
pub fn example_file(name: &str) -> String {
    std::fs::read_to_string(root().join("examples/network").join(name)).expect("a file of the example")
}

/// Returns the entries of a concise DCF.
pub fn entries(mut bytes: &[u8]) -> Vec<Entry> {
    let mut take = |length: usize| {
        let (part, rest) = bytes.split_at(length);
        bytes = rest;
        part.to_vec()
    };
    let number = |bytes: &[u8]| bytes.iter().rev().fold(0usize, |number, byte| number << 8 | usize::from(*byte));
    let count = number(&take(4));
    let mut entry = || {
        let (index, sub_index, length) = (number(&take(2)) as u16, take(1)[0], number(&take(4)));
        (index, sub_index, take(length))
    };
    let list = (0..count).map(|_| entry()).collect();
    assert!(bytes.is_empty());
    list
}

/// Writes files to an empty folder, and compiles the last of these files.
pub fn compiled(name: &str, files: &[(&str, String)]) -> Compilation {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("eds")).expect("a folder");
    for (name, text) in files {
        std::fs::write(folder.join(name), text).expect("a file");
    }
    let (name, _) = files.last().expect("a file");
    compile(Source::read(&folder.join(name)).expect("a file"), Levels::lenient())
}

/// Returns the codes and messages of all diagnostics.
pub fn messages(compilation: &Compilation) -> Vec<String> {
    let found = compilation.diagnostics.list().iter();
    found.map(|found| format!("{} {}", found.code.id, found.message)).collect()
}

/// Returns the network, and panics if there are diagnostics.
pub fn valid(compilation: &Compilation) -> &Network {
    assert_eq!(messages(compilation), Vec::<String>::new());
    compilation.network.as_ref().expect("a network")
}

/// Returns the node with this name.
pub fn node<'n>(network: &'n Network, name: &str) -> &'n NetworkNode {
    network.nodes.iter().find(|node| node.name.value == name).expect("a node")
}

/// Returns the values that a node's concise DCF writes to an object, in the order of the writes.
pub fn written(node: &NetworkNode, object: (u16, u8)) -> Vec<u64> {
    let number = |bytes: &[u8]| bytes.iter().rev().fold(0u64, |number, byte| number << 8 | u64::from(*byte));
    node.writes.iter().filter(|write| write.object == object).map(|write| number(&write.bytes)).collect()
}

/// Returns the text of a description with a configured value added to the object of a section, such as `1016sub1`.
pub fn configured(eds: &str, section: &str, value: &str) -> String {
    let (before, rest) = eds.split_once(&format!("[{section}]")).expect("an object of the description");
    format!("{before}[{section}]\nParameterValue={value}{rest}")
}

/// Returns the text of a description with an additional UNSIGNED32 object. `index` is hexadecimal, such as `1006`.
pub fn with_object(eds: &str, index: &str, value: &str) -> String {
    let (before, rest) = eds.split_once("[OptionalObjects]\r\nSupportedObjects=").expect("optional objects");
    let (count, rest) = rest.split_once("\r\n").expect("a line");
    let count = count.parse::<usize>().expect("a number") + 1;
    format!(
        "{before}[OptionalObjects]\r\nSupportedObjects={count}\r\n{count}=0x{index}\r\n{rest}\r\n[{index}]\r\n\
         ParameterName=Object {index}\r\nObjectType=0x7\r\nDataType=0x0007\r\nAccessType=rw\r\nDefaultValue={value}\r\nPDOMapping=0\r\n"
    )
}

/// Returns the text of a drive's description with TPDO 5 instead of TPDO 2.
pub fn with_tpdo_5(eds: &str) -> String {
    let names = [("[1801", "[1804"), ("[1A01", "[1A04"), ("=0x1801", "=0x1804"), ("=0x1A01", "=0x1A04")];
    names.into_iter().fold(eds.to_owned(), |eds, (old, new)| eds.replace(old, new))
}

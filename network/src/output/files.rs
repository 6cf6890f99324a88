//! The list of all output files.

use lexibus_codegen::RustOptions;

use super::{concise, dbc, dcf, master_dcf, master_writes, rust, segment_json, segment_rust};
use crate::model::Network;

/// An output file.
#[derive(Debug)]
pub struct OutputFile {
    /// Path of the file, relative to the output folder.
    pub name: String,
    /// Content of the file.
    pub content: Vec<u8>,
}

impl OutputFile {
    fn new(name: impl Into<String>, content: impl Into<Vec<u8>>) -> Self {
        OutputFile { name: name.into(), content: content.into() }
    }
}

/// Returns all output files of a network: those of the CANopen network, and `segment.json` and `segment.rs` for an EtherCAT segment.
pub fn files(network: &Network) -> Vec<OutputFile> {
    let mut files = if network.is_only_segment() { Vec::new() } else { canopen_files(network) };
    if let Some(segment) = &network.segment {
        files.push(OutputFile::new("segment.json", segment_json(segment)));
        files.push(OutputFile::new("segment.rs", segment_rust(segment)));
    }
    files
}

/// Returns the output files of the CANopen network. Each node has a DCF and a Rust module, and a concise DCF if values are
/// written to it. A master has a DCF, and a concise DCF if it writes values to itself. The network has a DBC and a Rust
/// module.
fn canopen_files(network: &Network) -> Vec<OutputFile> {
    let mut files = Vec::new();
    for node in &network.nodes {
        let stem = node.file_stem();
        if !node.writes.is_empty() {
            let entries = node.writes.iter().map(|write| (write.object, write.bytes.as_slice()));
            files.push(OutputFile::new(format!("{stem}.bin"), concise(entries)));
        }
        files.extend(dcf(network, node).map(|text| OutputFile::new(format!("{stem}.dcf"), text)));
    }
    if let Some(text) = master_dcf(network) {
        files.push(OutputFile::new("master.dcf", text));
    }
    let writes = master_writes(network);
    if !writes.is_empty() {
        let values: Vec<_> = writes.iter().map(|(object, value)| (*object, value.to_le_bytes())).collect();
        let entries = values.iter().map(|(object, bytes)| (*object, bytes.as_slice()));
        files.push(OutputFile::new("master.bin", concise(entries)));
    }
    files.push(OutputFile::new("network.dbc", dbc(network)));
    files.extend(rust(network, &RustOptions::default()).into_iter().map(|(name, text)| OutputFile::new(name, text)));
    files
}

//! Recognizes the format of a network file, and reads it.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::source::{FileId, Source};

use super::{bus_yml, cpj, network_toml};
use crate::declared::DeclaredNetwork;
use crate::syntax::{parse_toml, parse_yaml, Content, Entry, Node, SyntaxError};

/// Format of a network file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `network.toml` of Lexibus.
    Toml,
    /// `bus.yml` of Lely's `dcfgen` and of ros2_canopen.
    BusYml,
    /// `.cpj` of CiA 306-3.
    Cpj,
}

impl Format {
    /// Returns the format for the extension of a file name: `.toml`, `.yml`, `.yaml` or `.cpj`.
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, ending) = name.rsplit_once('.')?;
        match ending.to_ascii_lowercase().as_str() {
            "toml" => Some(Format::Toml),
            "yml" | "yaml" => Some(Format::BusYml),
            "cpj" => Some(Format::Cpj),
            _ => None,
        }
    }
}

/// Returns whether a file is a network file. A TOML file is one if it has the key `nodes` or `segment`; any other file, if
/// it has the extension of a format of network files.
pub fn is_network(source: &Source) -> bool {
    match Format::of_name(source.name()) {
        Some(Format::Toml) => parse_toml(source, FileId(0)).is_ok_and(|root| has_devices(&root)),
        format => format.is_some(),
    }
}

fn has_devices(root: &Node) -> bool {
    let is_list = |entry: &Entry| ["nodes", "segment"].contains(&entry.key.value.as_str());
    matches!(&root.content, Content::Table(entries) if entries.iter().any(is_list))
}

/// Reads a network file. Reports an unknown extension or a syntax error, and then returns `None`.
pub fn read(source: &Source, file: FileId, diagnostics: &mut Diagnostics) -> Option<DeclaredNetwork> {
    let Some(format) = Format::of_name(source.name()) else {
        let message = "the file is not a network file";
        let found = Diagnostic::new(&codes::NETWORK_SYNTAX, lexibus_codegen::source::Span::new(file, 0, 0), message);
        diagnostics.push(found.help("use a file with the extension .toml, .yml, .yaml or .cpj"));
        return None;
    };
    let tree = |parsed: Result<Node, SyntaxError>, diagnostics: &mut Diagnostics| match parsed {
        Ok(root) => Some(root),
        Err(error) => {
            diagnostics.push(Diagnostic::new(&codes::NETWORK_SYNTAX, error.span, error.message));
            None
        }
    };
    match format {
        Format::Toml => {
            let root = tree(parse_toml(source, file), diagnostics)?;
            Some(network_toml::read(&root, diagnostics))
        }
        Format::BusYml => {
            let root = tree(parse_yaml(source, file), diagnostics)?;
            Some(bus_yml::read(&root, diagnostics))
        }
        Format::Cpj => Some(cpj::read(source, file, diagnostics)),
    }
}

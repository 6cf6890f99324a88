//! `lexibus scan`.

use std::io::Write as _;
use std::time::Duration;

use lexibus_codegen::compile::Options;
use lexibus_codegen::number::hex32;
use lexibus_codegen::source::Source;
use lexibus_codegen::text::{count_of, printable};
use lexibus_device::scan::{scan, Fit, FoundNode};
use lexibus_device::{Description, Network};
use serde::Serialize;

use crate::args::{Scan, ScanFormat};
use crate::{inputs, Failure};

/// A node on the bus, with the names of the description files that fit it.
#[derive(Serialize)]
struct Line<'n> {
    #[serde(flatten)]
    node: &'n FoundNode,
    files: Vec<&'n str>,
}

pub(super) fn run(arguments: &Scan) -> Result<bool, Failure> {
    let descriptions = descriptions(arguments)?;
    let mut port = arguments.bus.open_port()?;
    let nodes = scan(&mut port, Duration::from_millis(arguments.timeout.into()))?;
    let mut out = std::io::stdout().lock();
    for node in &nodes {
        let fitting = fitting(node, &descriptions);
        match arguments.format {
            ScanFormat::Text => writeln!(out, "{}", printable(&text(node, &fitting)))?,
            ScanFormat::Json => {
                let files = fitting.iter().map(|(_, description)| description.file_name()).collect();
                let line = serde_json::to_string(&Line { node, files }).map_err(std::io::Error::other)?;
                writeln!(out, "{line}")?;
            }
        }
    }
    if arguments.format == ScanFormat::Text {
        writeln!(out, "{}", count_of(nodes.len(), "node"))?;
    }
    Ok(true)
}

/// Reads the descriptions of CANopen devices in the given files and folders. Other files are skipped.
fn descriptions(arguments: &Scan) -> Result<Vec<Description>, Failure> {
    let files = inputs::files(&arguments.descriptions)?;
    let sources = files.iter().filter_map(|path| Source::read(path).ok());
    let options = Options::default();
    Ok(sources.filter_map(|source| Description::compile(source, Network::CanOpen, &options).ok()).collect())
}

/// Returns the descriptions that fit a node, starting with the best fit.
fn fitting<'d>(node: &FoundNode, descriptions: &'d [Description]) -> Vec<(Fit, &'d Description)> {
    let fits = descriptions.iter().filter_map(|description| Some((node.fit(description)?, description)));
    let mut fits: Vec<_> = fits.collect();
    fits.sort_by_key(|(fit, _)| std::cmp::Reverse(*fit));
    fits
}

fn text(node: &FoundNode, fitting: &[(Fit, &Description)]) -> String {
    let number = |number: Option<u32>| number.map_or_else(|| "unknown".to_owned(), hex32);
    let mut text = format!("node {}", node.node_id);
    if let Some(name) = &node.name {
        text += &format!(" {name}");
    }
    text += &format!(
        ": vendor {}, product {}, revision {}, serial number {}",
        number(node.vendor_id),
        number(node.product_code),
        number(node.revision_number),
        number(node.serial_number)
    );
    if let Some(state) = &node.state {
        text += &format!(", state {state}");
    }
    for (fit, description) in fitting {
        let note = if *fit == Fit::Product { " (other or unknown revision)" } else { "" };
        text += &format!("; {}{note}", description.file_name());
    }
    text
}

//! List of front ends, and the function that reads a file with one of them.

use std::path::PathBuf;

use super::detect;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Catalog, Format};
use crate::source::{FileId, References, Source, Span};

/// Result of reading a description file.
pub(crate) struct Description {
    /// Format of the file; `None` if it was not recognized.
    pub format: Option<Format>,
    /// Devices and modules; `None` if the file cannot be used.
    pub catalog: Option<Catalog>,
    /// Referenced files that were read.
    pub others: Vec<Source>,
    /// Paths of referenced files that do not exist.
    pub missing: Vec<PathBuf>,
}

/// Input of a front end.
// Each front end uses only some of the fields, so some fields are unused if a feature is disabled.
#[cfg_attr(not(all(feature = "eds", feature = "esi", feature = "table")), allow(dead_code))]
struct Input<'s> {
    source: &'s Source,
    file: FileId,
    /// Further names of `$NODEID` in formulas.
    node_id_aliases: &'s [String],
    /// Name of each option of a register table, with the chosen value.
    choices: &'s [(String, String)],
    /// Access to the files to which the source refers.
    references: References<'s>,
}

type Read = fn(&mut Input<'_>, &mut Diagnostics) -> Option<Catalog>;

/// Front end of a format: its cargo feature and its functions.
struct FrontEnd {
    /// Returns the format of a source, or `None` if the front end cannot read the source.
    recognize: fn(&Source) -> Option<Format>,
    /// Cargo feature that enables the front end.
    feature: &'static str,
    /// Reader of the front end; `None` if the feature is disabled.
    read: Option<Read>,
}

/// Expands to the reader of a front end, or to `None` if its feature is disabled.
macro_rules! with_feature {
    ($feature:literal, $read:expr) => {{
        #[cfg(feature = $feature)]
        let read: Option<Read> = Some($read);
        #[cfg(not(feature = $feature))]
        let read: Option<Read> = None;
        read
    }};
}

/// All front ends. The first front end that recognizes a file reads the file.
const FRONT_ENDS: &[FrontEnd] = &[
    FrontEnd {
        recognize: detect::table,
        feature: "table",
        read: with_feature!("table", |input, diagnostics| {
            super::table::read(input.source, input.file, input.choices, diagnostics)
        }),
    },
    FrontEnd {
        recognize: detect::gsdml,
        feature: "gsdml",
        read: with_feature!("gsdml", |input, diagnostics| super::gsdml::read(input.source, input.file, diagnostics)),
    },
    FrontEnd {
        recognize: detect::xdd,
        feature: "xdd",
        read: with_feature!("xdd", |input, diagnostics| {
            super::xdd::read(input.source, input.file, input.node_id_aliases, diagnostics)
        }),
    },
    FrontEnd {
        recognize: detect::esi,
        feature: "esi",
        read: with_feature!("esi", |input, diagnostics| {
            super::esi::read(input.source, input.file, &mut input.references, diagnostics)
        }),
    },
    FrontEnd {
        recognize: detect::eds,
        feature: "eds",
        read: with_feature!("eds", |input, diagnostics| {
            super::eds::read(input.source, input.file, input.node_id_aliases, diagnostics)
        }),
    },
];

/// Returns the format of `source`.
///
/// # Errors
///
/// Returns one diagnostic if the file is an EtherNet/IP EDS, an unknown XML document, or another file that Lexibus
/// cannot read.
pub fn format(source: &Source, file: FileId) -> Result<Format, Box<Diagnostic>> {
    recognized(source, file).map(|(format, _)| format)
}

fn recognized(source: &Source, file: FileId) -> Result<(Format, &'static FrontEnd), Box<Diagnostic>> {
    let found = FRONT_ENDS.iter().find_map(|front_end| Some(((front_end.recognize)(source)?, front_end)));
    found.ok_or_else(|| Box::new(detect::unknown(source, file)))
}

/// Reads a file with the front end of its format. `node_id_aliases` are further names of `$NODEID`. `choices` contains
/// the name and the chosen value of each option of a register table.
pub(crate) fn read(
    source: &Source,
    node_id_aliases: &[String],
    choices: &[(String, String)],
    diagnostics: &mut Diagnostics,
) -> Description {
    let file = FileId(0);
    let (format, front_end) = match recognized(source, file) {
        Ok(recognized) => recognized,
        Err(diagnostic) => {
            diagnostics.push(*diagnostic);
            return Description { format: None, catalog: None, others: Vec::new(), missing: Vec::new() };
        }
    };
    let mut input = Input { source, file, node_id_aliases, choices, references: References::new(source) };
    let catalog = match front_end.read {
        Some(read) => read(&mut input, diagnostics),
        None => {
            diagnostics.push(without_feature(front_end.feature, "this format", file));
            None
        }
    };
    // A file in the EDS format is a DCF if it has a commissioning section.
    let mut devices = catalog.iter().flat_map(|catalog| &catalog.devices);
    let is_configuration = format == Format::Eds && devices.any(|device| device.commissioning.is_some());
    let (others, missing) = input.references.into_files();
    Description { format: Some(if is_configuration { Format::Dcf } else { format }), catalog, others, missing }
}

/// An overlay that was read. The function applies the overlay to those devices or modules of a catalog that the overlay selects.
pub type Overlay<'s> = Box<dyn Fn(&mut Catalog, &mut Diagnostics) + 's>;

/// Reads an overlay. Returns `None` if it cannot be used.
pub(crate) fn read_overlay<'s>(source: &'s Source, file: FileId, diagnostics: &mut Diagnostics) -> Option<Overlay<'s>> {
    #[cfg(feature = "table")]
    return super::table::overlay::read(source, file, diagnostics);
    #[cfg(not(feature = "table"))]
    {
        let _ = source;
        diagnostics.push(without_feature("table", "overlays", file));
        None
    }
}

/// Returns the error for a file whose front end is disabled. `what` names the kind of files that the feature reads.
pub(crate) fn without_feature(feature: &str, what: &str, file: FileId) -> Diagnostic {
    let message = format!("`lexibus-codegen` was built without the feature `{feature}`, which reads {what}");
    let help = format!("add it to the dependency: `lexibus-codegen = {{ …, features = [\"{feature}\"] }}`");
    codes::UNKNOWN_FORMAT.at(Span::new(file, 0, 0), message).help(help)
}

//! From a file to the front end of its format.

use std::path::PathBuf;

#[cfg(feature = "eds")]
use super::eds;
#[cfg(feature = "esi")]
use super::esi;
#[cfg(feature = "gsdml")]
use super::gsdml;
#[cfg(feature = "xdd")]
use super::xdd;
use super::{detect, table};
use crate::diagnostics::Diagnostics;
use crate::ir::{Catalog, Format};
use crate::source::{FileId, References, Source};

/// What a file describes.
pub(crate) struct Description {
    /// The format; `None` if it was not recognized.
    pub format: Option<Format>,
    /// What it describes; `None` if it can't be used at all.
    pub catalog: Option<Catalog>,
    /// Files that it refers to.
    pub others: Vec<Source>,
    /// Where files were looked for that don't exist.
    pub missing: Vec<PathBuf>,
}

/// Reads a file by the front end of its format. `node_id_aliases` are further names of `$NODEID`, `choices` those of the options of a
/// register table.
pub(crate) fn read(
    source: &Source,
    node_id_aliases: &[String],
    choices: &[(String, String)],
    diagnostics: &mut Diagnostics,
) -> Description {
    #[cfg(not(any(feature = "eds", feature = "xdd")))]
    let _ = node_id_aliases;
    let file = FileId(0);
    let format = match detect::format(source, file) {
        Ok(format) => format,
        Err(diagnostic) => {
            diagnostics.push(*diagnostic);
            return Description { format: None, catalog: None, others: Vec::new(), missing: Vec::new() };
        }
    };
    #[cfg_attr(not(feature = "esi"), allow(unused_mut))]
    let mut references = References::new(source);
    let catalog = match format {
        #[cfg(feature = "eds")]
        Format::Eds | Format::Dcf => eds::read(source, file, node_id_aliases, diagnostics),
        #[cfg(feature = "xdd")]
        Format::Xdd => xdd::read(source, file, node_id_aliases, diagnostics),
        #[cfg(feature = "esi")]
        Format::Esi => esi::read(source, file, &mut references, diagnostics),
        #[cfg(feature = "gsdml")]
        Format::Gsdml => gsdml::read(source, file, diagnostics),
        Format::Table => table::read(source, file, choices, diagnostics),
        #[cfg(not(all(feature = "eds", feature = "xdd", feature = "esi", feature = "gsdml")))]
        _ => {
            diagnostics.push(detect::without_feature(format, file));
            None
        }
    };
    // A DCF differs from an EDS by the commissioning of the device, not by its file name.
    let mut devices = catalog.iter().flat_map(|catalog| &catalog.devices);
    let is_configuration = format == Format::Eds && devices.any(|device| device.commissioning.is_some());
    let (others, missing) = references.into_files();
    Description { format: Some(if is_configuration { Format::Dcf } else { format }), catalog, others, missing }
}

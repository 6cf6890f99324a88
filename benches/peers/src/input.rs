//! Inputs of the measurements: generated files, or files from the user.

use std::path::{Path, PathBuf};

use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::ir::Format;
use lexibus_codegen::source::Source;

#[path = "../../../codegen/benches/inputs/eds.rs"]
mod eds;
#[path = "../../../codegen/benches/inputs/esi.rs"]
mod esi;
#[path = "../../../codegen/benches/inputs/gsdml.rs"]
mod gsdml;
#[path = "../../../codegen/benches/inputs/table.rs"]
pub mod table;

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum InputFormat {
    Eds,
    Esi,
    Gsdml,
    Table,
}

/// A description in memory. The description is also saved as a file, because some readers require a file.
pub struct Input {
    pub title: String,
    pub kind: InputFormat,
    pub bytes: Vec<u8>,
    pub path: PathBuf,
}

impl Input {
    fn new(folder: &Path, title: &str, kind: InputFormat, bytes: Vec<u8>) -> Self {
        let extension = match kind {
            InputFormat::Eds => "eds",
            InputFormat::Esi | InputFormat::Gsdml => "xml",
            InputFormat::Table => "toml",
        };
        let path = folder.join(format!("{title}.{extension}"));
        std::fs::write(&path, &bytes).expect("a folder that can be written to");
        Input { title: title.to_owned(), kind, bytes, path }
    }

    /// Reads an input from a file. Returns `None` if the file is unreadable or its format is not part of the
    /// comparison.
    pub fn of_file(path: &Path) -> Option<Self> {
        let bytes = std::fs::read(path).ok()?;
        let name = path.file_name()?.to_string_lossy().into_owned();
        let kind = match compile::check(Source::new(name.as_str(), bytes.clone()), &Options::default()).format? {
            Format::Eds | Format::Dcf => InputFormat::Eds,
            Format::Esi => InputFormat::Esi,
            Format::Gsdml => InputFormat::Gsdml,
            _ => return None,
        };
        Some(Input { title: name, kind, bytes, path: path.to_owned() })
    }

    pub fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// Returns three inputs for each format except register tables. The small input has about 36 entries, and the typical
/// input has about 1,000. The very large input has 15 MB (EDS) or 30 MB (ESI and GSDML).
pub fn of_three_sizes(folder: &Path) -> Vec<Input> {
    let eds = |title: &str, records| Input::new(folder, title, InputFormat::Eds, eds::eds(records).into_bytes());
    let esi = |title: &str, devices, shape| {
        Input::new(folder, title, InputFormat::Esi, esi::esi(devices, shape).into_bytes())
    };
    let gsdml = |title: &str, submodules, records| {
        Input::new(folder, title, InputFormat::Gsdml, gsdml::gsdml(submodules, records))
    };
    vec![
        eds("EDS, small, 36 entries", 4),
        eds("EDS, typical, 990 entries", 110),
        eds("EDS, huge, 10,000 records of 8", 10_000),
        esi("ESI, small, 37 entries", 1, esi::SMALL),
        esi("ESI, typical, 4 devices of 256 entries", 4, esi::DRIVE),
        esi("ESI, huge, 175 devices of 256 entries", 175, esi::DRIVE),
        gsdml("GSDML, small, 40 parameters", 1, 2),
        gsdml("GSDML, typical, 1,000 parameters", 2, gsdml::DRIVE),
        gsdml("GSDML, huge, 90,000 parameters", 180, gsdml::DRIVE),
    ]
}

/// Returns a generated description in the format `kind`. `size` is the multiple of the smallest size.
pub fn growing(kind: InputFormat, size: usize) -> Vec<u8> {
    match kind {
        InputFormat::Eds => eds::growing(size),
        InputFormat::Esi => esi::growing(size),
        InputFormat::Gsdml => gsdml::growing(size),
        InputFormat::Table => table::growing(size),
    }
}

/// Returns an ESI with one device. The size of the dictionary is proportional to `size`.
pub fn growing_device(size: usize) -> Vec<u8> {
    esi::esi(1, esi::Shape { records: 8 * size, single: 8 * size }).into_bytes()
}

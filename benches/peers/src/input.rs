//! What is read: made by the generators of the compiler's benches, or files of one's own.

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
pub enum Kind {
    Eds,
    Esi,
    Gsdml,
    Table,
}

/// A description in memory, and in a file for those that read nothing else.
pub struct Input {
    pub title: String,
    pub kind: Kind,
    pub bytes: Vec<u8>,
    pub path: PathBuf,
}

impl Input {
    fn new(folder: &Path, title: &str, kind: Kind, bytes: Vec<u8>) -> Self {
        let extension = match kind {
            Kind::Eds => "eds",
            Kind::Esi | Kind::Gsdml => "xml",
            Kind::Table => "toml",
        };
        let path = folder.join(format!("{title}.{extension}"));
        std::fs::write(&path, &bytes).expect("a folder that can be written to");
        Input { title: title.to_owned(), kind, bytes, path }
    }

    /// One of the user's files, if it is of a kind that is compared here.
    pub fn of_file(path: &Path) -> Option<Self> {
        let bytes = std::fs::read(path).ok()?;
        let name = path.file_name()?.to_string_lossy().into_owned();
        let kind = match compile::check(Source::new(name.as_str(), bytes.clone()), &Options::default()).format? {
            Format::Eds | Format::Dcf => Kind::Eds,
            Format::Esi => Kind::Esi,
            Format::Gsdml => Kind::Gsdml,
            _ => return None,
        };
        Some(Input { title: name, kind, bytes, path: path.to_owned() })
    }

    pub fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// Small, typical and huge ones: some 36, 1,000 and as many entries as 15 MB of EDS and 30 MB of ESI and GSDML have.
pub fn of_three_sizes(folder: &Path) -> Vec<Input> {
    let eds = |title: &str, records| Input::new(folder, title, Kind::Eds, eds::eds(records).into_bytes());
    let esi = |title: &str, devices, shape| Input::new(folder, title, Kind::Esi, esi::esi(devices, shape).into_bytes());
    let gsdml =
        |title: &str, submodules, records| Input::new(folder, title, Kind::Gsdml, gsdml::gsdml(submodules, records));
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

/// The same description at 1, 10, 100 and 1,000 times the size, for each way in which one grows.
pub fn growing(kind: Kind, size: usize) -> Vec<u8> {
    match kind {
        Kind::Eds => eds::growing(size),
        Kind::Esi => esi::growing(size),
        Kind::Gsdml => gsdml::growing(size),
        Kind::Table => table::growing(size),
    }
}

/// An ESI of one device alone, whose dictionary grows.
pub fn growing_device(size: usize) -> Vec<u8> {
    esi::esi(1, esi::Shape { records: 8 * size, single: 8 * size }).into_bytes()
}

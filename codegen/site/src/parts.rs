//! The data that the pages of a device show.

use super::area::Area;
use super::assumptions::{AmbiguitySources, Ranked};
use super::code_references;
use super::codes::Codes;
use super::machines;
use super::overview::{Contents, Overview};
use super::process::{self, ProcessPart};
use super::protocol::Protocol;
use super::references::{self, Targets};
use super::slots::Slots;
use lexibus_codegen::facts::referrers::Referrers;
use lexibus_codegen::ir::Device;

/// The data that the pages of a device show, with the file names of the pages.
pub(super) struct Parts {
    pub overview: Overview,
    pub areas: Vec<Area>,
    pub data: ProcessPart,
    pub process: Option<String>,
    pub protocol: Option<(String, Protocol)>,
    pub behavior: Option<(String, machines::Behavior)>,
    /// File, title and tables of each page of codes.
    pub codes: Vec<(String, String, Vec<Codes>)>,
}

impl Parts {
    /// Returns the ambiguities of a device whose first page is `first`, sorted by severity.
    pub fn assumptions<'p>(&'p self, first: &'p str) -> Vec<Ranked<'p>> {
        let sources = AmbiguitySources {
            overview: (first, &self.overview.doubts),
            areas: &self.areas,
            process: self.process.as_deref().map(|file| (file, self.data.frames.as_slice())),
            protocol: page(&self.protocol),
            behavior: page(&self.behavior),
            codes: &self.codes,
        };
        sources.ranked()
    }

    /// Adds the links between the elements.
    pub fn link(&mut self, device: &Device) {
        let pages = references::Pages {
            areas: &self.areas,
            frames: (self.process.as_deref(), &self.data.frames),
            behavior: page(&self.behavior),
            protocol: page(&self.protocol),
        };
        let (targets, referrers) = (Targets::new(device, &pages), Referrers::new(device));
        let pages_of_codes = self.codes.iter_mut().map(|(file, _, tables)| (file.as_str(), tables));
        let codes = code_references::link(&targets, pages_of_codes);
        for row in self.areas.iter_mut().flat_map(|area| &mut area.sections).flat_map(|section| &mut section.rows) {
            row.relations = targets.relations(row.id, &referrers);
            row.relations.extend(codes.of(row.id));
        }
        for entry in self.data.frames.iter_mut().flat_map(|frame| &mut frame.entries) {
            entry.target = targets.item(entry.item).map(|link| link.target.clone()).unwrap_or_default();
        }
        if let Some((_, behavior)) = &mut self.behavior {
            targets.link(behavior);
        }
    }

    /// Returns the table of contents for the overview of the device.
    pub fn contents(&self, slots: Slots) -> Contents {
        let of_frame =
            |(file, frame): (&String, &process::Frame)| (format!("{file}#{}", frame.anchor), frame.title.clone());
        let frames = self.process.iter().flat_map(|file| self.data.frames.iter().map(move |frame| (file, frame)));
        Contents {
            areas: self.areas.iter().map(|area| (area.file.clone(), area.title.clone(), area.count())).collect(),
            frames: frames.map(of_frame).collect(),
            slots,
        }
    }
}

/// Returns the file and the content of an optional page.
fn page<T>(page: &Option<(String, T)>) -> Option<(&str, &T)> {
    page.as_ref().map(|(file, content)| (file.as_str(), content))
}

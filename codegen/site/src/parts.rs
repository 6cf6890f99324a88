//! The data that the pages of a device show.

use super::area::Area;
use super::codes::Codes;
use super::machines;
use super::overview::{Contents, Overview};
use super::process::{self, ProcessPart};
use super::protocol::Protocol;
use super::slots::Slots;

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

//! The formats of documentation.

use super::html::Html;
use super::markdown::Markdown;
use super::pages::Pages;

/// The format of a documentation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Pages that open from disk, with drawings and a search.
    #[default]
    Html,
    /// Pages for repositories and for `mdBook`, with a `SUMMARY.md`.
    Markdown,
}

impl Format {
    /// Returns the path of the first page of a site, which lists the devices.
    pub fn first_page(self) -> String {
        format!("{}{}", self.pages().front(), self.pages().ending())
    }

    pub(super) fn pages(self) -> &'static dyn Pages {
        match self {
            Format::Html => &Html,
            Format::Markdown => &Markdown,
        }
    }
}

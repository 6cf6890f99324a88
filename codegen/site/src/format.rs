//! The output formats of the documentation.

use super::html::Html;
use super::markdown::Markdown;
use super::pages::Pages;

/// An output format of the documentation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// HTML pages that a browser opens from disk, with drawings and a search.
    #[default]
    Html,
    /// Markdown pages for repositories and `mdBook`, with a `SUMMARY.md`.
    Markdown,
}

impl Format {
    /// Returns the path of the first page of a site. This page lists the devices.
    pub fn first_page(self) -> String {
        let name = match self {
            Format::Html => "index.html",
            // Repository hosts such as GitHub display a file with this name for a folder. Only the top folder uses this name, because
            // `mdBook` renames such files and breaks links to them.
            Format::Markdown => "README.md",
        };
        name.to_owned()
    }

    pub(super) fn pages(self) -> &'static dyn Pages {
        match self {
            Format::Html => &Html,
            Format::Markdown => &Markdown,
        }
    }
}

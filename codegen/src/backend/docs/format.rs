//! What a format of documentation has to write: a text for each kind of page.

use std::collections::HashMap;

use super::area::Area;
use super::codes::Codes;
use super::findings::Finding;
use super::html::Html;
use super::machines::{Machine, Sequence};
use super::markdown::Markdown;
use super::modules::ModuleModel;
use super::overview::{Contents, Overview};
use super::process::{Frame, SyncManager};
use super::protocol::Protocol;
use super::Page;

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
    pub(super) fn pages(self) -> &'static dyn Pages {
        match self {
            Format::Html => &Html,
            Format::Markdown => &Markdown,
        }
    }
}

/// What each page of a catalogue has around it.
#[derive(Debug)]
pub(super) struct Frameset {
    /// The catalogue, or the device of it.
    pub title: String,
    /// Files and titles of the pages.
    pub links: Vec<(String, String)>,
    /// The places of the files among them.
    places: HashMap<String, usize>,
    /// Languages of names.
    pub languages: Vec<String>,
}

/// Pages of which all are linked on each.
const ALL_LINKED: usize = 200;

/// Of more, so many before and behind a page are, and the first one.
const NEAR_LINKED: usize = 20;

impl Frameset {
    pub fn new(title: String, links: Vec<(String, String)>, languages: Vec<String>) -> Self {
        let places = links.iter().enumerate().map(|(at, (file, _))| (file.clone(), at)).collect();
        Frameset { title, links, places, languages }
    }

    /// The pages that a page has links to: with all of very many, a site would grow with the square of their number.
    pub fn near(&self, file: &str) -> impl Iterator<Item = &(String, String)> {
        let all = &self.links;
        let at = self.places.get(file).copied().unwrap_or(0);
        let near = match all.len() {
            0..=ALL_LINKED => 0..all.len(),
            count => at.saturating_sub(NEAR_LINKED)..(at + NEAR_LINKED + 1).min(count),
        };
        let first = all.iter().take(usize::from(near.start > 0));
        first.chain(all.get(near).into_iter().flatten())
    }
}

/// A page in its catalogue.
#[derive(Clone, Copy, Debug)]
pub(super) struct Around<'p> {
    pub set: &'p Frameset,
    /// The name of its file.
    pub file: &'p str,
}

/// The pages of a catalogue, as lists of contents have them.
#[derive(Debug, Default)]
pub(super) struct Catalogue {
    pub title: String,
    /// Its folder, with a `/` behind it.
    pub folder: String,
    pub devices: Vec<Listed>,
    /// Pages that all its devices share: files and titles.
    pub shared: Vec<(String, String)>,
}

/// A device in the list of all.
#[derive(Clone, Debug)]
pub(super) struct Listed {
    pub title: String,
    pub vendor: String,
    /// Its first page.
    pub path: String,
    /// Its further pages: files and titles.
    pub pages: Vec<(String, String)>,
}

impl Catalogue {
    /// The devices, their first pages as seen from the folder of the site.
    pub fn in_site(&self) -> impl Iterator<Item = Listed> + '_ {
        self.devices.iter().map(|own| Listed { path: format!("{}{}", self.folder, own.path), ..own.clone() })
    }
}

/// A list of devices.
#[derive(Clone, Copy, Debug)]
pub(super) struct List<'p> {
    pub devices: &'p [Listed],
    /// The way to the folder of the site.
    pub root: &'p str,
    /// The folder of the index, where that isn't the page's.
    pub index: &'p str,
}

/// Writes pages.
pub(super) trait Pages {
    /// How names of files end, with the dot.
    fn ending(&self) -> &'static str;
    /// The name of the first page of all, without ending.
    fn front(&self) -> &'static str;

    fn overview(&self, around: Around<'_>, own: &Overview, contents: &Contents) -> String;
    fn area(&self, around: Around<'_>, own: &Area) -> String;
    fn process(&self, around: Around<'_>, frames: &[Frame], sync_managers: &[SyncManager]) -> String;
    fn protocol(&self, around: Around<'_>, own: &Protocol) -> String;
    fn codes(&self, around: Around<'_>, tables: &[Codes]) -> String;
    fn machines(&self, around: Around<'_>, machines: &[Machine], sequences: &[Sequence]) -> String;
    fn modules(&self, around: Around<'_>, modules: &[ModuleModel]) -> String;
    fn findings(&self, around: Around<'_>, findings: &[Finding]) -> String;
    fn list(&self, around: Around<'_>, list: List<'_>) -> String;

    /// What the pages of one catalogue share, beside them.
    fn of_catalog(&self, search: &dyn Fn() -> String) -> Vec<Page>;
    /// What all pages share. `search` is the index of all, where a catalogue's isn't enough.
    fn of_site(&self, catalogs: &[Catalogue], search: Option<&dyn Fn() -> String>) -> Vec<Page>;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_pages_those_nearby_are_linked() {
        let pages = |count: usize| (0..count).map(|at| (at.to_string(), at.to_string())).collect();
        let of = |count, file: &str| {
            let set = Frameset::new(String::new(), pages(count), Vec::new());
            set.near(file).map(|(file, _)| file.parse::<usize>().unwrap()).collect::<Vec<_>>()
        };
        assert_eq!(of(ALL_LINKED, "7"), (0..ALL_LINKED).collect::<Vec<_>>());
        let expected: Vec<usize> = [0].into_iter().chain(480..=520).collect();
        assert_eq!(of(1000, "500"), expected);
        assert_eq!(of(1000, "999").len(), 1 + NEAR_LINKED + 1);
        assert_eq!(of(1000, "0"), (0..=NEAR_LINKED).collect::<Vec<_>>());
        assert_eq!(of(1000, "no page of these"), of(1000, "0"));
        assert_eq!(of(0, "0"), [0; 0]);
    }
}

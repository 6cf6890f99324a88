//! Changes between adjacent revisions of a device, and between two descriptions that the user chooses. The revisions can be in one
//! description or in two.

use std::collections::HashSet;
use std::rc::Rc;

use super::addresses::{Addresses, DeviceKey};
use super::compare::{compare, compare_devices, Change, Summary};
use super::pages::{Content, Frameset, Pages};
use super::Page;
use lexibus_codegen::ir::{Catalog, Device};
use lexibus_codegen::number::hex32;

/// The previous revision of a device, and the numbers of both revisions.
#[derive(Debug)]
pub(super) struct Previous {
    key: DeviceKey,
    /// Revision numbers, as hexadecimal numbers.
    pub old: String,
    pub new: String,
}

impl Previous {
    pub fn of(addresses: &Addresses, device: &Device) -> Option<Self> {
        let (old, key) = addresses.previous(device)?;
        let new = device.identity.revision_number.map(hex32).unwrap_or_default();
        Some(Previous { key: key.clone(), old: hex32(*old), new })
    }

    pub fn title(&self) -> String {
        format!("Changes since revision {}", self.old)
    }
}

/// The changes from one revision or description to another, as a page shows them.
#[derive(Debug)]
pub(super) struct Comparison {
    pub title: String,
    /// Names of the old and the new revision or description.
    pub old: String,
    pub new: String,
    pub changes: Vec<Change>,
    pub summary: Summary,
}

impl Comparison {
    /// Compares two descriptions.
    pub fn of_catalogs(old: (&str, &Catalog), new: (&str, &Catalog)) -> Self {
        let changes = compare(old.1, new.1);
        let (old, new) = (old.0.to_owned(), new.0.to_owned());
        Comparison { title: format!("{old} → {new}"), old, new, summary: Summary::of(&changes), changes }
    }

    /// Returns whether the title contains the names of both sides, so that the page does not repeat them.
    pub fn title_has_names(&self) -> bool {
        self.title == format!("{} → {}", self.old, self.new)
    }
}

/// A page of changes that is written when both descriptions are known.
#[derive(Debug)]
pub(super) struct Changes {
    pub previous: Previous,
    pub key: DeviceKey,
    pub frame: Rc<Frameset>,
    pub folder: String,
    pub file: String,
}

/// Catalogs whose devices have revisions in descriptions that were not added yet, and the pages that wait for these descriptions.
#[derive(Debug, Default)]
pub(super) struct Revisions {
    added: HashSet<String>,
    kept: Vec<(String, Catalog)>,
    waiting: Vec<Changes>,
}

impl Revisions {
    /// Adds a catalog and its pages of changes. Returns the pages whose two descriptions are known now.
    pub fn add(
        &mut self,
        name: &str,
        catalog: &Catalog,
        changes: Vec<Changes>,
        addresses: &Addresses,
        format: &dyn Pages,
    ) -> Vec<Page> {
        self.added.insert(name.to_owned());
        let mut pages = Vec::new();
        for changes in std::mem::take(&mut self.waiting).into_iter().chain(changes) {
            let find = |key: &DeviceKey| {
                let kept = self.kept.iter().find(|(kept, _)| *kept == key.0).map(|(_, catalog)| catalog);
                let catalog = if key.0 == name { catalog } else { kept? };
                Some((catalog, catalog.devices.get(key.1)?))
            };
            match find(&changes.previous.key).zip(find(&changes.key)) {
                Some((old, new)) => pages.push(changes.page(format, old, new)),
                None => self.waiting.push(changes),
            }
        }
        let is_needed = |catalog: &Catalog| addresses.partners(catalog).any(|partner| !self.added.contains(partner));
        self.kept.retain(|(_, catalog)| is_needed(catalog));
        if is_needed(catalog) {
            self.kept.push((name.to_owned(), catalog.clone()));
        }
        pages
    }
}

impl Changes {
    fn page(&self, format: &dyn Pages, old: (&Catalog, &Device), new: (&Catalog, &Device)) -> Page {
        let changes = compare_devices(old.0, old.1, new.0, new.1);
        let (old, new) = (format!("Revision {}", self.previous.old), self.previous.new.clone());
        let title = self.previous.title();
        let comparison = Comparison { title, old, new, summary: Summary::of(&changes), changes };
        let text = format.page(&self.frame, &self.file, Content::Changes { comparison: &comparison });
        Page { path: format!("{}/{}", self.folder, self.file), text }
    }
}

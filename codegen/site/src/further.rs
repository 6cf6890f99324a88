//! Pages of CANopen networks and EtherCAT segments, which do not belong to a device.

use super::addresses::folder_name;
use super::indexing;
use super::listed::Listed;
use super::network::Network;
use super::pages::{Content, Frameset, Pages};
use super::search::Entry;
use super::segment::{Segment, SubDevice};
use super::{Page, Site};

/// The page of a CANopen network or EtherCAT segment.
struct Further<'p> {
    /// Folder of all pages of this kind, relative to the site's folder.
    folder: &'static str,
    /// Kind of the page in the search.
    kind: &'static str,
    /// Name of the network or segment, which determines the file name.
    name: &'p str,
    title: String,
    /// Anchor, number and name of each part of the page.
    parts: Vec<(String, String, &'p str)>,
}

impl Further<'_> {
    fn file(&self, format: &dyn Pages) -> String {
        format!("{}{}", page_name(self.name), format.ending())
    }

    fn text(&self, format: &dyn Pages, content: Content<'_>) -> String {
        let file = self.file(format);
        format.page(&Frameset::alone(&self.title, &file, &self.title), &file, content)
    }
}

/// Returns the file name of the page of a network or segment, without extension. Names that differ only in case or punctuation can
/// have the same file name.
#[must_use]
pub fn page_name(name: &str) -> String {
    folder_name(name)
}

impl Site {
    /// Returns the page of a network, with links to the pages of its nodes. Before calling this function, add the catalogs of the
    /// nodes to the site. The list of devices links to this page.
    pub fn network(&mut self, network: &Network) -> Page {
        let devices: Vec<Option<&Listed>> = network.nodes.iter().map(|node| self.device_of(&node.catalog)).collect();
        let parts = network.nodes.iter();
        let parts = parts.map(|node| (format!("node-{}", node.id), node.number(), node.name.as_str()));
        let (title, parts) = (network.title(), parts.collect());
        let page = Further { folder: "_networks", kind: "network", name: &network.name, title, parts };
        let text = page.text(self.format.pages(), Content::Network { network, devices: &devices });
        self.further(&page, text)
    }

    /// Returns the page of a segment, with links to the pages of its devices. Before calling this function, add the catalogs of the
    /// devices to the site. The list of devices links to this page.
    pub fn segment(&mut self, segment: &Segment) -> Page {
        let device = |subdevice: &SubDevice| self.device_of(&subdevice.catalog);
        let devices: Vec<Option<&Listed>> = segment.subdevices.iter().map(device).collect();
        let parts = segment.subdevices.iter();
        let parts =
            parts.map(|one| (format!("subdevice-{}", one.position), one.position.to_string(), one.name.as_str()));
        let (title, parts) = (segment.title(), parts.collect());
        let page = Further { folder: "_segments", kind: "segment", name: &segment.name, title, parts };
        let text = page.text(self.format.pages(), Content::Segment { segment, devices: &devices });
        self.further(&page, text)
    }

    /// Adds the page of a network or segment to the search, and to the pages to which the list of devices links.
    fn further(&mut self, page: &Further<'_>, text: String) -> Page {
        let Further { folder, kind, title, parts, .. } = page;
        let file = page.file(self.format.pages());
        self.index.device(title, "", "", folder);
        self.index.page(&file, kind);
        let words: Vec<&str> = parts.iter().map(|(.., name)| *name).collect();
        self.index.entry(&Entry { words: &words.join(" "), ..indexing::entry("", "", title) });
        for (anchor, number, name) in parts {
            self.index.entry(&indexing::entry(anchor, number, name));
        }
        let path = format!("{folder}/{file}");
        self.further.push((path.clone(), title.clone()));
        Page { text, path }
    }

    /// Returns the first device of a catalog.
    fn device_of(&self, catalog: &str) -> Option<&Listed> {
        self.catalogs.iter().flat_map(|listed| &listed.devices).find(|device| device.file == catalog)
    }
}

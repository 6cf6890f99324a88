//! Pages of CANopen networks and EtherCAT segments, which do not belong to a device.

use super::addresses::folder_name;
use super::indexing;
use super::listed::Listed;
use super::network::{self, Network};
use super::pages::{Content, Frameset};
use super::search::Entry;
use super::segment::{self, Segment, SubDevice};
use super::{Page, Site};

/// The page of a CANopen network or EtherCAT segment.
struct Further<'p> {
    /// Folder of all pages of this kind, relative to the site's folder.
    folder: &'static str,
    /// Kind of the page in the search.
    kind: &'static str,
    /// Name of the network or segment, which determines the file name.
    name: &'p str,
    title: &'p str,
    /// Anchor, number and name of each part of the page.
    parts: Vec<[&'p str; 3]>,
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
        let shown = network::Shown::new(network, &devices);
        let parts = shown.nodes.iter().map(|node| [node.anchor.as_str(), &node.id, &node.name]).collect();
        let title = &shown.title;
        let page = Further { folder: "_networks", kind: "network", name: &network.name, title, parts };
        self.further(&page, Content::Network { network: &shown })
    }

    /// Returns the page of a segment, with links to the pages of its devices. Before calling this function, add the catalogs of the
    /// devices to the site. The list of devices links to this page.
    pub fn segment(&mut self, segment: &Segment) -> Page {
        let device = |subdevice: &SubDevice| self.device_of(&subdevice.catalog);
        let devices: Vec<Option<&Listed>> = segment.subdevices.iter().map(device).collect();
        let shown = segment::Shown::new(segment, &devices);
        let parts = shown.subdevices.iter().map(|one| [one.anchor.as_str(), &one.position, &one.name]).collect();
        let title = &shown.title;
        let page = Further { folder: "_segments", kind: "segment", name: &segment.name, title, parts };
        self.further(&page, Content::Segment { segment: &shown })
    }

    /// Returns the page of a network or segment. Adds it to the search, and to the pages to which the list of devices links.
    fn further(&mut self, page: &Further<'_>, content: Content<'_>) -> Page {
        let Further { folder, kind, name, title, parts } = page;
        let format = self.format.pages();
        let file = format!("{}{}", page_name(name), format.ending());
        self.index.device(title, "", "", folder);
        self.index.page(&file, kind);
        let words: Vec<&str> = parts.iter().map(|[.., name]| *name).collect();
        self.index.entry(&Entry { words: &words.join(" "), ..indexing::entry("", "", title) });
        for [anchor, number, name] in parts {
            self.index.entry(&indexing::entry(anchor, number, name));
        }
        let path = format!("{folder}/{file}");
        self.further.push((path.clone(), (*title).to_owned()));
        let frame = Frameset::alone(title, &file, title);
        Page { text: format.page(&frame, &file, content), path }
    }

    /// Returns the first device of a catalog.
    fn device_of(&self, catalog: &str) -> Option<&Listed> {
        self.catalogs.iter().flat_map(|listed| &listed.devices).find(|device| device.file == catalog)
    }
}

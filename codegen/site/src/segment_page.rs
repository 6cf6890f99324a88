//! The page of an EtherCAT segment.

use super::addresses::folder_name;
use super::indexing;
use super::pages::{Content, Frameset, Listed};
use super::search::Entry;
use super::segment::{Segment, Shown, ShownSubDevice, SubDevice};
use super::{Page, Site};

/// Folder of the pages of segments, relative to the site's folder.
const FOLDER: &str = "_segments";

impl Site {
    /// Returns the page of a segment, with links to the pages of its devices. Before calling this function, add the catalogs of the
    /// devices to the site. The list of devices links to this page.
    pub fn segment(&mut self, segment: &Segment) -> Page {
        let format = self.format.pages();
        let shown = |subdevice: &SubDevice| ShownSubDevice::new(subdevice, self.device_of(&subdevice.catalog));
        let shown = Shown {
            title: format!("EtherCAT segment {}", segment.name),
            summary: segment.summary.clone(),
            subdevices: segment.subdevices.iter().map(shown).collect(),
        };
        let file = format!("{}{}", folder_name(&segment.name), format.ending());
        self.index.device(&shown.title, "", "", FOLDER);
        self.index.page(&file, "segment");
        let words: Vec<&str> = segment.subdevices.iter().map(|subdevice| subdevice.name.as_str()).collect();
        self.index.entry(&Entry { words: &words.join(" "), ..indexing::entry("", "", &shown.title) });
        for subdevice in &shown.subdevices {
            let position = subdevice.position.to_string();
            self.index.entry(&indexing::entry(&subdevice.anchor, &position, &subdevice.name));
        }
        let path = format!("{FOLDER}/{file}");
        self.further.push((path.clone(), shown.title.clone()));
        let frame = Frameset { title: shown.title.clone(), root: "..", ..Frameset::default() };
        Page { text: format.page(&frame, &path, Content::Segment(&shown)), path }
    }
}

impl ShownSubDevice {
    fn new(subdevice: &SubDevice, device: Option<&Listed>) -> Self {
        ShownSubDevice {
            anchor: format!("subdevice-{}", subdevice.position),
            name: subdevice.name.clone(),
            position: subdevice.position,
            device: device.map(|device| device.title.clone()).unwrap_or_default(),
            target: device.map(|device| device.path_from("..")).unwrap_or_default(),
            facts: subdevice.facts.join(" "),
            tables: subdevice.tables.iter().filter(|table| !table.rows.is_empty()).cloned().collect(),
        }
    }
}

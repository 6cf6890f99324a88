//! Data of the page of an EtherCAT segment: the SubDevices in the order of the bus, with their settings.

use super::listed::Listed;

/// An EtherCAT segment.
#[derive(Clone, Debug, Default)]
pub struct Segment {
    /// Name of the segment. Each segment of a site must have a unique [page name](super::page_name).
    pub name: String,
    /// Number of SubDevices and length of the process data as a sentence.
    pub summary: String,
    /// SubDevices in the order of their positions on the bus.
    pub subdevices: Vec<SubDevice>,
}

/// A SubDevice of a segment.
#[derive(Clone, Debug, Default)]
pub struct SubDevice {
    /// Name of the SubDevice.
    pub name: String,
    /// Position on the bus, counted from 0.
    pub position: u16,
    /// Name under which the catalog with the device was added to the site.
    pub catalog: String,
    /// Facts about identity, alias and distributed clocks, as sentences.
    pub facts: Vec<String>,
    /// Settings. Tables without rows are not shown.
    pub tables: Vec<Table>,
}

/// Settings of a SubDevice as a table.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Title of the table.
    pub title: &'static str,
    /// Titles of the columns.
    pub columns: &'static [&'static str],
    /// Cells of each row, one for each column.
    pub rows: Vec<Vec<String>>,
}

/// The segment, as the templates show it.
#[derive(Debug)]
pub(super) struct Shown {
    pub title: String,
    pub summary: String,
    pub subdevices: Vec<ShownSubDevice>,
}

#[derive(Debug)]
pub(super) struct ShownSubDevice {
    pub anchor: String,
    pub name: String,
    pub position: String,
    pub device: String,
    /// Path of the first page of the device. Empty if the site does not contain the device.
    pub target: String,
    pub facts: String,
    pub tables: Vec<Table>,
}

impl Shown {
    pub fn new(segment: &Segment, devices: &[Option<&Listed>]) -> Self {
        let subdevice = |(subdevice, device): (&SubDevice, &Option<&Listed>)| ShownSubDevice::new(subdevice, *device);
        Shown {
            title: format!("EtherCAT segment {}", segment.name),
            summary: segment.summary.clone(),
            subdevices: segment.subdevices.iter().zip(devices).map(subdevice).collect(),
        }
    }
}

impl ShownSubDevice {
    fn new(subdevice: &SubDevice, device: Option<&Listed>) -> Self {
        ShownSubDevice {
            anchor: format!("subdevice-{}", subdevice.position),
            name: subdevice.name.clone(),
            position: subdevice.position.to_string(),
            device: device.map(|device| device.title.clone()).unwrap_or_default(),
            target: device.map(|device| device.path_from("..")).unwrap_or_default(),
            facts: subdevice.facts.join(" "),
            tables: subdevice.tables.iter().filter(|table| !table.rows.is_empty()).cloned().collect(),
        }
    }
}

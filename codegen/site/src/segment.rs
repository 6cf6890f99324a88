//! An EtherCAT segment, as its page shows it: its SubDevices in the order of the bus, and the settings of each.

/// An EtherCAT segment.
#[derive(Clone, Debug, Default)]
pub struct Segment {
    /// Name of the segment. Each segment of a site must have a different name.
    pub name: String,
    /// Number of SubDevices, cycle time and length of the process data as a sentence.
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
    pub position: u16,
    pub device: String,
    /// Path of the first page of the device. Empty if the site does not contain the device.
    pub target: String,
    pub facts: String,
    pub tables: Vec<Table>,
}

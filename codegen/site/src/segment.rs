//! Data of the page of an EtherCAT segment: the SubDevices in the order of the bus, with their settings.

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

impl Segment {
    pub(super) fn title(&self) -> String {
        format!("EtherCAT segment {}", self.name)
    }
}

impl SubDevice {
    pub(super) fn shown_tables(&self) -> impl Iterator<Item = &Table> {
        self.tables.iter().filter(|table| !table.rows.is_empty())
    }
}

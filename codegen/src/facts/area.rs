//! Areas of a device: chapters of registers and ranges of objects.

use crate::ir::{Group, GroupKind};

/// Returns the title of a group's area: its chapter, process image, record or range of objects.
pub fn title(group: &Group) -> String {
    match &group.kind {
        GroupKind::Object { index, .. } => objects(*index).to_owned(),
        GroupKind::Chapter => group.name.to_string(),
        GroupKind::Image { .. } => format!("Image {}", group.name),
        GroupKind::Record(_) => format!("Record {}", group.name),
    }
}

/// Returns the title of the range of objects that contains an index (CiA 301, 7.4.1).
pub fn objects(index: u16) -> &'static str {
    match index {
        0x0000..=0x0FFF => "Data types",
        0x1000..=0x1FFF => "Communication objects",
        0x2000..=0x5FFF => "Manufacturer objects",
        0x6000..=0x9FFF => "Profile objects",
        0xA000..=0xBFFF => "Interface objects",
        _ => "Further objects",
    }
}

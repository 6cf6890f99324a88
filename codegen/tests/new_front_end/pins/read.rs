//! Reads the lines of a PINS file.

use super::object::object;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Catalog, Device, Group};
use crate::source::{FileId, Origin, Source, Span};

/// Reads the device that `source` describes.
pub fn read(source: &Source, file: FileId, diagnostics: &mut Diagnostics) -> Option<Catalog> {
    let mut device = Device { canopen: Some(Box::default()), ..Device::default() };
    let mut start = 0;
    for line in source.text().split_inclusive('\n') {
        let span = Span::new(file, start, start + line.trim_end().len() as u32);
        start += line.len() as u32;
        let origin = Origin { span, line: source.position(span.start).line };
        match line.split_whitespace().collect::<Vec<_>>().as_slice() {
            [] => {}
            ["device", name] => device.name = (*name).into(),
            words => match object(words, origin) {
                Some(object) => device.groups.push(object),
                None => diagnostics.push(Diagnostic::new(&codes::UNKNOWN_FORMAT, span, "this line is no object")),
            },
        }
    }
    device.groups.sort_by_key(Group::index);
    Some(Catalog::of_device(device, Vec::new()))
}

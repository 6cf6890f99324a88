//! Records the positions of the objects in a file. The objects are read later, in the order of their indices.

use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::Read;
use crate::source::Origin;
use crate::syntax::xml::Tag;

/// Index of each object and its position in the file, in the order of the file.
#[derive(Default)]
pub(super) struct ObjectList(pub Vec<(u16, Origin)>);

impl ObjectList {
    /// Reads the indices and positions of the objects in a `CANopenObjectList` element, and skips their content.
    pub fn read<'a>(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        // These attributes contain counts of objects, which are redundant.
        reader.attributes(parent, ["mandatoryObjects", "optionalObjects", "manufacturerObjects"])?;
        while let Some(tag) = reader.child(parent)? {
            match tag.name {
                "CANopenObject" => {
                    let given = reader.peek(&tag, "index")?;
                    match reader.hex(&given, 0xFFFF, "index") {
                        Some(index) => self.0.push((index as u16, reader.origin(&tag))),
                        None => missing_index(reader, &tag, "this object has no index"),
                    }
                }
                "CANopenSubObject" => missing_index(reader, &tag, "this sub-object is outside of an object"),
                _ => reader.unknown(&tag)?,
            }
        }
        Ok(())
    }
}

pub(super) fn missing_index(reader: &mut Reader<'_, '_>, tag: &Tag<'_>, message: &str) {
    reader.report(&codes::MISSING_INDEX, tag.span, message, "left out");
}

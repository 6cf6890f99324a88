//! Records the positions of the objects in a file. The objects are read later, in the order of their indices.

use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::Read;
use crate::source::Origin;
use crate::syntax::xml::Tag;

/// Index of each object and its position in the file, in the order of the file.
pub(super) type Positions = Vec<(u16, Origin)>;

/// Reads the indices and positions of the objects in a `CANopenObjectList` element, and skips their content.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, positions: &mut Positions) -> Read<()> {
    // These attributes contain counts of objects, which are redundant.
    reader.attributes(parent, ["mandatoryObjects", "optionalObjects", "manufacturerObjects"])?;
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "CANopenObject" => {
                let given = reader.peek(&tag, "index")?;
                match reader.hex(&given, 0xFFFF, "index") {
                    Some(index) => positions.push((index as u16, reader.origin(&tag))),
                    None => missing_index(reader, &tag, "this object has no index"),
                }
            }
            "CANopenSubObject" => missing_index(reader, &tag, "this sub-object is outside of an object"),
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(())
}

pub(super) fn missing_index(reader: &mut Reader<'_, '_>, tag: &Tag<'_>, message: &str) {
    reader.report(&codes::MISSING_INDEX, tag.span, message, "left out");
}

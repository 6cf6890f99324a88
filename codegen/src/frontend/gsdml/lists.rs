//! Reads the list of graphics and the list of categories.

use super::links::ElementKind;
use super::reader::Reader;
use crate::frontend::xml::Read;
use crate::ir::{Catalog, CompactString, Extension, Family, Graphic, LocalText};
use crate::syntax::xml::Tag;

/// Reads a `GraphicsList` element.
pub(super) fn graphics<'a>(reader: &mut Reader<'a, '_>, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
    reader.each(list, "GraphicItem", |reader, tag| {
        let [id, file] = reader.attributes(tag, ["ID", "GraphicFile"])?;
        reader.register(tag, ElementKind::Graphic, &id, catalog.graphics.len());
        catalog.graphics.push(Graphic { id: id.compact(), file: file.compact() });
        reader.each(tag, "Embedded", drawing)
    })
}

/// Stores the XML text of an embedded drawing as an extension.
fn drawing<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<()> {
    reader.skip(tag)?;
    let range = tag.span.start as usize..reader.cursor.offset() as usize;
    let value = reader.cursor.text().get(range).unwrap_or("").into();
    reader.extensions.push(Extension { key: "GraphicItem/Embedded".into(), value, span: tag.span });
    Ok(())
}

/// Reads a `CategoryList` element.
pub(super) fn categories<'a>(reader: &mut Reader<'a, '_>, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
    reader.each(list, "CategoryItem", |reader, tag| {
        let origin = reader.origin(tag);
        let [id, text] = reader.attributes(tag, ["ID", "TextId"])?;
        reader.register(tag, ElementKind::Category, &id, catalog.families.len());
        let name = reader.name(tag, text);
        let mut family = Family { id: id.compact(), name, origin, ..Family::default() };
        reader.each(tag, "InfoText", |reader, tag| {
            let text = reader.text_reference(tag)?;
            family.descriptions.push(LocalText { language: CompactString::default(), text });
            Ok(())
        })?;
        catalog.families.push(family);
        Ok(())
    })
}

//! Reads the PDOs of a device or module, including PDOs that refer to a template.

use super::pdo::{self, Content, Reference};
use super::reader::{Esi, Reader};
use super::templates::Template;
use crate::diagnostics::{codes, Diagnostics};
use crate::frontend::xml::{Given, Read};
use crate::ir::{Direction, Pdo, PdoEntry, ProcessData, Type};
use crate::syntax::xml::Tag;
use crate::text::brief;

/// PDOs of a device or module. The types of the PDO entries are resolved after the dictionary is read.
#[derive(Default)]
pub(super) struct Pdos<'a> {
    pub list: Vec<Pdo>,
    /// Type name of each PDO entry, in the order of the PDOs and their entries.
    types: Vec<Given<'a>>,
}

impl<'a> Pdos<'a> {
    /// Reads an `RxPdo` or `TxPdo` element.
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        let direction = if parent.name == "RxPdo" { Direction::Receive } else { Direction::Transmit };
        let (origin, start) = (reader.origin(parent), reader.extensions.len());
        let mut pdo = Pdo { origin, ..Pdo::new(direction, 0) };
        let reference = pdo::attributes(reader, parent, &mut pdo)?;
        let channel = reference.as_ref().map_or(0, |reference| reference.channel);
        let mut content = pdo::content(reader, parent, &mut pdo, channel)?;
        let has_template = match &reference {
            Some(reference) => complete(reader, reference, &mut pdo, &mut content)?,
            None => true,
        };
        let Content { index, names, types } = content;
        let numbered = Pdo::new(direction, index.unwrap_or(0));
        (pdo.mapping_index, pdo.number) = (numbered.mapping_index, numbered.number);
        (pdo.name, pdo.names) = (names.name(), names.others());
        pdo.extensions = reader.extensions_since(start);
        // A missing template was already reported.
        if has_template {
            check(reader, parent, &pdo, index.is_some());
        }
        // Most PDOs have few entries, and an ESI has thousands of PDOs.
        pdo.entries.shrink_to_fit();
        self.types.extend(types);
        self.list.push(pdo);
        Ok(())
    }

    /// Stores the PDOs in `data`, RxPDOs first. `resolve` returns the type of a PDO entry.
    pub fn finish(self, data: &mut ProcessData, mut resolve: impl FnMut(&Given<'a>, &PdoEntry) -> Type) {
        let mut list = self.list;
        let entries = list.iter_mut().flat_map(|pdo| &mut pdo.entries);
        for (entry, ty) in entries.zip(&self.types) {
            entry.ty = resolve(ty, entry);
        }
        list.sort_by_key(|pdo| pdo.direction == Direction::Transmit);
        list.shrink_to_fit();
        data.pdos = list;
    }
}

fn check(reader: &mut Reader<'_, '_>, tag: &Tag<'_>, pdo: &Pdo, has_index: bool) {
    if !has_index {
        let message = format!("this {} has no index", tag.name);
        reader.report(&codes::PDO_WITHOUT_INDEX, tag.span, message, "the PDO cannot be assigned to a sync manager");
    }
    if pdo.name.is_empty() {
        let message = format!("this {} has no name", tag.name);
        reader.report(&codes::UNNAMED_PDO, tag.span, message, "the index is used instead of a name");
    }
}

/// Completes a PDO with facts from its template. Reports the reference and returns false if the file does not contain
/// the template.
fn complete<'a>(
    reader: &mut Reader<'a, '_>,
    reference: &Reference<'a>,
    pdo: &mut Pdo,
    content: &mut Content<'a>,
) -> Read<bool> {
    let Some(template) = reader.format.templates.get(&reference.name.text) else {
        let message = format!("the file has no PDO template with the RefName `{}`", brief(&reference.name.text));
        let label = "the PDO has no index and no entries";
        reader.report(&codes::PDO_WITHOUT_INDEX, reference.name.span, message, label);
        reader.note("Pdo@Ref", &reference.name);
        reader.note("Pdo@Chn", &reference.channel_given);
        return Ok(false);
    };
    if !reader.derive(template.cost, reference.name.span) {
        return Ok(true);
    }
    let (given, given_content) = instance(reader, template, pdo.direction, reference.channel)?;
    content.index = content.index.or(given_content.index);
    if pdo.entries.is_empty() {
        pdo.entries = given.entries;
        content.types = given_content.types;
    }
    if content.names.is_empty() {
        content.names = given_content.names;
    }
    pdo.fixed |= given.fixed;
    pdo.mandatory |= given.mandatory;
    pdo.sync_manager = pdo.sync_manager.or(given.sync_manager);
    pdo.sync_unit = pdo.sync_unit.or(given.sync_unit);
    pdo.order = pdo.order.or(given.order);
    pdo.sra_parameter = pdo.sra_parameter.or(given.sra_parameter);
    pdo.excludes.extend(given.excludes);
    pdo.excluded_sync_managers.extend(given.excluded_sync_managers);
    Ok(true)
}

/// Reads a template for one channel.
fn instance<'a>(
    reader: &mut Reader<'a, '_>,
    template: &Template,
    direction: Direction,
    channel: u16,
) -> Read<(Pdo, Content<'a>)> {
    let mut repeated = Diagnostics::default();
    let diagnostics = if template.used.replace(true) { &mut repeated } else { &mut *reader.diagnostics };
    let templates = reader.format.templates;
    let format = Esi { budget: &mut *reader.format.budget, templates };
    let mut inner = Reader::new(templates.cursor(template), diagnostics, format);
    let tag: Tag<'a> = inner.cursor.root()?;
    let mut pdo = Pdo { origin: template.origin, ..Pdo::new(direction, 0) };
    pdo::attributes(&mut inner, &tag, &mut pdo)?;
    let content = pdo::content(&mut inner, &tag, &mut pdo, channel)?;
    let mut extensions = inner.extensions;
    reader.extensions.append(&mut extensions);
    Ok((pdo, content))
}

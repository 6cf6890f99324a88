//! PDO templates of old files: a `Pdo` of `Descriptions/Pdos` has a `RefName`, and PDOs of devices name it in `Ref`.
//!
//! `Chn` is the channel of the PDO, counted from 0. `ChnFac` is what an index or sub-index of the template grows by with each
//! channel. A template is read again for each PDO that names it, because its numbers depend on the channel.

use std::borrow::Cow;
use std::cell::Cell;
use std::collections::HashMap;

use super::pdo::{self, Content};
use super::reader::{note, shortened, Given, Read, Reader};
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{Direction, Pdo};
use crate::source::{FileId, Origin, Span};
use crate::syntax::xml::{Cursor, Error, Event, Tag};

/// The templates of a file by name.
#[derive(Default)]
pub(super) struct Templates<'a> {
    text: &'a str,
    by_name: HashMap<Cow<'a, str>, Template>,
}

struct Template {
    origin: Origin,
    /// Entries and bytes, which each use copies.
    cost: (usize, usize),
    /// Whether its diagnostics are reported already.
    used: Cell<bool>,
}

impl<'a> Templates<'a> {
    /// Finds the templates of a file, which may follow the devices that name them. Faults are reported when the file is read.
    pub fn of(text: &'a str, file: FileId) -> Self {
        let mut templates = Templates { text, by_name: HashMap::new() };
        // New files have none.
        if memchr::memmem::find(text.as_bytes(), b"RefName").is_some() {
            let _ = templates.find(file);
        }
        templates
    }

    fn find(&mut self, file: FileId) -> Result<(), Error> {
        let mut cursor = Cursor::new(self.text, file);
        while let Some(event) = cursor.read()? {
            let Event::Start(tag) = event else { continue };
            let Some(name) = (tag.name == "Pdo").then(|| tag.attribute("RefName")).transpose()?.flatten() else {
                continue;
            };
            let origin = cursor.origin(&tag);
            let mut entries = 0;
            while let Some(child) = cursor.child(&tag)? {
                entries += usize::from(child.name == "Entry");
            }
            let cost = (entries, (cursor.offset() - tag.span.start) as usize);
            let name = name.value(&mut Diagnostics::default());
            self.by_name.entry(name).or_insert(Template { origin, cost, used: Cell::new(false) });
        }
        Ok(())
    }
}

/// What a PDO names: a template and a channel.
pub(super) struct Reference<'a> {
    pub name: Given<'a>,
    pub channel: u16,
    pub channel_given: Given<'a>,
}

/// Completes a PDO with its template. Returns whether the file has the template; reports it if not.
pub(super) fn complete<'a>(
    reader: &mut Reader<'a, '_>,
    reference: &Reference<'a>,
    pdo: &mut Pdo,
    content: &mut Content<'a>,
) -> Read<bool> {
    let Some(template) = reader.templates.by_name.get(reference.name.text.as_ref()) else {
        let message = format!("the file has no PDO template `{}`", shortened(&reference.name.text));
        let label = "the PDO has no index and no entries";
        reader.report(&codes::PDO_WITHOUT_INDEX, reference.name.span, message, label);
        note("Pdo@Ref", &reference.name, &mut pdo.extensions);
        note("Pdo@Chn", &reference.channel_given, &mut pdo.extensions);
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
    pdo.excludes.extend(given.excludes);
    pdo.excluded_sync_managers.extend(given.excluded_sync_managers);
    pdo.extensions.extend(given.extensions);
    Ok(true)
}

/// Reads a template for a channel.
fn instance<'a>(
    reader: &mut Reader<'a, '_>,
    template: &Template,
    direction: Direction,
    channel: u16,
) -> Read<(Pdo, Content<'a>)> {
    let mut unheard = Diagnostics::default();
    let mut reader = Reader {
        cursor: Cursor::resume(reader.templates.text, template.origin),
        diagnostics: if template.used.replace(true) { &mut unheard } else { &mut *reader.diagnostics },
        budget: &mut *reader.budget,
        templates: reader.templates,
    };
    let tag: Tag<'a> = reader.cursor.root()?;
    let mut pdo = Pdo { origin: template.origin, ..Pdo::new(direction, 0) };
    pdo::attributes(&mut reader, &tag, &mut pdo)?;
    let content = pdo::content(&mut reader, &tag, &mut pdo, channel)?;
    Ok((pdo, content))
}

/// A number of a template for a channel: `base + factor * channel`.
pub(super) fn of_channel<T: TryFrom<i64>>(
    reader: &mut Reader<'_, '_>,
    base: Option<u16>,
    factor: &Given<'_>,
    channel: u16,
    span: Span,
) -> Option<T> {
    let base = i64::from(base?);
    let factor = reader.int::<i32>(factor, "factor of channels").unwrap_or(0);
    let number = base + i64::from(factor) * i64::from(channel);
    let value = T::try_from(number).ok();
    if value.is_none() {
        let message = format!("the number of channel {channel} is {number}, which is too large or negative");
        reader.report(&codes::ESI_VALUE, span, message, "left out");
    }
    value
}

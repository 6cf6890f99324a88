//! PDO templates of old files. A `Pdo` in `Descriptions/Pdos` has a `RefName`, and PDOs of devices refer to it with
//! `Ref`.
//!
//! `Chn` is the channel of the PDO, counted from 0. `ChnFac` is the increment of an index or sub-index per channel. A
//! template is read again for each PDO that refers to it, because its indices and sub-indices depend on the channel.

use std::borrow::Cow;
use std::cell::Cell;

use super::budget::Cost;
use crate::collections::HashMap;
use crate::diagnostics::Diagnostics;
use crate::source::{FileId, Origin};
use crate::syntax::xml::{Cursor, Error, Event};

/// Templates of a file by name.
#[derive(Default)]
pub(super) struct Templates<'a> {
    text: &'a str,
    by_name: HashMap<Cow<'a, str>, Template>,
}

pub(super) struct Template {
    pub origin: Origin,
    /// Number of entries and bytes that are copied for each reference to the template.
    pub cost: Cost,
    /// True if the diagnostics of the template were already reported.
    pub used: Cell<bool>,
}

impl<'a> Templates<'a> {
    /// Finds the templates of a file before the file is read, because a template may come after the devices that use it. Ignores
    /// syntax errors, which the main reader reports.
    pub fn of(text: &'a str, file: FileId) -> Self {
        let mut templates = Templates { text, by_name: HashMap::default() };
        // Newer files have no templates, so a fast text search avoids a second parse of these files.
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
            let mut items = 0;
            while let Some(child) = cursor.child(&tag)? {
                items += usize::from(child.name == "Entry");
            }
            let cost = Cost { items, bytes: (cursor.offset() - tag.span.start) as usize };
            let name = name.value(&mut Diagnostics::default());
            self.by_name.entry(name).or_insert(Template { origin, cost, used: Cell::new(false) });
        }
        Ok(())
    }

    /// Returns the template called `name`.
    pub fn get(&self, name: &str) -> Option<&Template> {
        self.by_name.get(name)
    }

    /// Returns a cursor at the start of a template.
    pub fn cursor(&self, template: &Template) -> Cursor<'a> {
        Cursor::resume(self.text, template.origin)
    }
}

//! Builds books and reads their pages.

use std::path::Path;
use std::sync::{Arc, Mutex};

use mdbook_driver::MDBook;
use mdbook_driver::config::Config;
use tracing::field::{Field, Visit};
use tracing::span::{Attributes, Id, Record};
use tracing::{Event, Level, Metadata, Subscriber};

/// Collects the warnings of mdBook.
#[derive(Clone, Default)]
struct Warnings(Arc<Mutex<Vec<String>>>);

impl Subscriber for Warnings {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        *metadata.level() <= Level::WARN
    }

    fn new_span(&self, _: &Attributes<'_>) -> Id {
        Id::from_u64(1)
    }

    fn record(&self, _: &Id, _: &Record<'_>) {}

    fn record_follows_from(&self, _: &Id, _: &Id) {}

    fn event(&self, event: &Event<'_>) {
        let mut message = Message::default();
        event.record(&mut message);
        if let Ok(mut list) = self.0.lock() {
            list.push(message.0);
        }
    }

    fn enter(&self, _: &Id) {}

    fn exit(&self, _: &Id) {}
}

/// Formats the fields of an event on one line.
#[derive(Default)]
struct Message(String);

impl Visit for Message {
    fn record_debug(&mut self, _: &Field, value: &dyn std::fmt::Debug) {
        self.0 += &format!("{value:?} ");
    }
}

/// Builds the book whose files are in the folder `root`.
///
/// # Panics
///
/// If mdBook fails or reports a warning.
pub fn build_into(root: &Path, config: Config) {
    let warnings = Warnings::default();
    tracing::subscriber::with_default(warnings.clone(), || {
        MDBook::load_with_config(root, config).and_then(|book| book.build()).expect("the book is built");
    });
    let list = warnings.0.lock().expect("the warnings");
    assert!(list.is_empty(), "{list:#?}");
}

/// Returns the values of an attribute in a page.
pub fn attributes<'p>(page: &'p str, name: &str) -> Vec<&'p str> {
    let start = format!(" {name}=\"");
    page.split(&start).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

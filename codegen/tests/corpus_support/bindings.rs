//! Tests the bindings of files in the corpus. Equal bindings are tested only once.

use std::borrow::Cow;
use std::collections::HashSet;
use std::sync::Mutex;

use lexibus_codegen::backend::rust;
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::ir::{Catalog, Device, Format};
use lexibus_codegen::source::Source;

use super::{lane, File};

/// Returns the bindings without their header, which contains the name and the digest of the input file.
pub fn body(text: &str) -> &str {
    text.split_once("\n\n").map_or(text, |(_, body)| body)
}

/// Splits the catalog of a file into catalogs with one device each, except for GSDML. Many files contain the same
/// devices, and generating code for a single device needs little memory.
pub fn catalogs(compilation: &Compilation) -> Box<dyn Iterator<Item = Cow<'_, Catalog>> + '_> {
    let Some(catalog) = compilation.usable() else {
        return Box::new(std::iter::empty());
    };
    if catalog.devices.len() <= 1 || compilation.format == Some(Format::Gsdml) {
        return Box::new(std::iter::once(Cow::Borrowed(catalog)));
    }
    // In the fast lane, compile only the first device of a file, because its other devices are similar.
    let count = if lane::is_full() { catalog.devices.len() } else { 1 };
    Box::new(catalog.devices.iter().take(count).map(|device: &Device| {
        let (files, devices) = (catalog.files.clone(), vec![device.clone()]);
        let modules = catalog.modules.clone();
        Cow::Owned(Catalog { files, devices, modules, ..Catalog::default() })
    }))
}

/// Calls `test` with the bindings of all `files`, using all processors. Returns the number of different bindings.
///
/// # Panics
///
/// Panics if `test` fails or a file is rejected without a diagnostic. The message contains the first failures.
pub fn each(files: Vec<File>, options: &Options, test: impl Fn(&str, &str) -> Result<(), String> + Sync) -> usize {
    let (seen, failures) = (Mutex::new(HashSet::new()), Mutex::new(Vec::new()));
    on_all_processors(files, |File { name, bytes }| {
        let compilation = check(Source::new(name.as_str(), bytes), options);
        let texts = catalogs(&compilation).filter_map(|catalog| rust::emit_catalog(&catalog, &options.rust));
        let texts: Vec<String> = texts.collect();
        let nothing_to_say = texts.is_empty() && !compilation.diagnostics.has_errors();
        assert!(!nothing_to_say || is_silent(&compilation), "{name}: rejected without a diagnostic");
        for text in texts {
            let is_new = seen.lock().expect("the seen texts").insert(body(&text).to_owned());
            if !is_new {
                continue;
            }
            if let Err(message) = test(&name, &text) {
                failures.lock().expect("the failures").push(message);
            }
        }
    });
    let failures = failures.into_inner().expect("the failures");
    assert!(failures.is_empty(), "{} fail:\n{}", failures.len(), failures[..failures.len().min(20)].join("\n\n"));
    seen.into_inner().expect("the seen texts").len()
}

/// Calls `work` for each element of `all`, using all processors.
///
/// # Panics
///
/// Panics if `work` panics.
pub fn on_all_processors<T: Send>(all: Vec<T>, work: impl Fn(T) + Sync) {
    let queue = Mutex::new(all.into_iter());
    let one_by_one = || {
        while let Some(entry) = { queue.lock().expect("the queue").next() } {
            work(entry);
        }
    };
    std::thread::scope(|scope| {
        (0..std::thread::available_parallelism().map_or(1, usize::from)).for_each(|_| {
            scope.spawn(one_by_one);
        });
    });
}

/// Returns whether a file describes neither devices nor modules, such as a file that contains only diagnosis texts.
fn is_silent(compilation: &Compilation) -> bool {
    let catalog = compilation.catalog.as_ref();
    catalog.is_some_and(|catalog| catalog.devices.is_empty() && catalog.modules.is_empty())
}

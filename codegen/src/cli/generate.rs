//! `lexibus generate`: bindings to files, to standard output, or compared with what is checked in.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::args::Generate;
use super::inputs;
use super::report::Reporter;
use super::Failure;
use crate::backend::rust;
use crate::builder::write_if_changed;
use crate::compile::{self, Compilation};

pub(super) fn run(generate: &Generate) -> Result<bool, Failure> {
    let options = generate.inputs.options()?;
    let rust_options = generate.rust_options();
    let mut reporter = Reporter::new(&generate.inputs, false);
    let mut target = Target::new(generate)?;
    inputs::each(&generate.inputs, &options, |input, compilation| {
        reporter.report(&compilation)?;
        match compilation.rust(&rust_options) {
            Some(text) => target.put(input, &compilation, &text, &mut reporter),
            // Its errors were told; among many files, one without a device was found rather than asked for.
            None if !compilation.is_usable() || target.many => Ok(()),
            None => {
                reporter.error(&format!("{}: {}", input.display(), compile::NOTHING_TO_GENERATE));
                Ok(())
            }
        }
    })?;
    reporter.finish()
}

/// Where the output goes.
struct Target<'g> {
    generate: &'g Generate,
    is_folder: bool,
    /// Whether there are several inputs, or folders of them.
    many: bool,
    /// Names given so far, with the input that got each.
    names: BTreeMap<PathBuf, PathBuf>,
}

impl<'g> Target<'g> {
    fn new(generate: &'g Generate) -> Result<Self, Failure> {
        let many = generate.inputs.paths.len() > 1 || generate.inputs.paths.iter().any(|path| path.is_dir());
        let names_folder = |out: &PathBuf| out.is_dir() || out.as_os_str().to_string_lossy().ends_with(['/', '\\']);
        let is_folder = generate.out.as_ref().is_some_and(|out| many || names_folder(out));
        if many && generate.out.as_ref().is_some_and(|out| out.is_file()) {
            return Err(Failure::Usage("several inputs need a folder to write to, and --out is a file".into()));
        }
        if many && generate.out.is_none() {
            return Err(Failure::Usage("several inputs need a folder to write to: name one with --out".into()));
        }
        let folder = generate.out.as_deref().and_then(|out| if is_folder { Some(out) } else { out.parent() });
        if let Some(out) = folder.filter(|out| !generate.check && !out.as_os_str().is_empty()) {
            std::fs::create_dir_all(out)
                .map_err(|error| Failure::Usage(format!("can't make the folder {}: {error}", out.display())))?;
        }
        Ok(Target { generate, is_folder, many, names: BTreeMap::new() })
    }

    fn put(
        &mut self,
        input: &Path,
        compilation: &Compilation,
        text: &str,
        reporter: &mut Reporter,
    ) -> Result<(), Failure> {
        let Some(out) = &self.generate.out else {
            std::io::stdout().lock().write_all(text.as_bytes())?;
            return Ok(());
        };
        let path = if self.is_folder { self.file_in(out, input, compilation) } else { out.clone() };
        if self.generate.check {
            check(&path, text, reporter);
        } else if let Err(error) = write_if_changed(&path, text) {
            reporter.error(&format!("can't write {}: {error}", path.display()));
        }
        Ok(())
    }

    /// `<stem>.rs` of the input in Rust's case; two inputs of one name are told apart by a number.
    fn file_in(&mut self, folder: &Path, input: &Path, compilation: &Compilation) -> PathBuf {
        let stem = input.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let name = rust::file_name(&stem).or_else(|| {
            let catalog = compilation.catalog.as_ref()?;
            Some(rust::module_name(catalog.devices.first()?, catalog.files.first()?))
        });
        let name = name.unwrap_or_else(|| "device".to_owned());
        let mut path = folder.join(format!("{name}.rs"));
        let mut number = 2;
        while self.names.contains_key(&path) {
            path = folder.join(format!("{name}_{number}.rs"));
            number += 1;
        }
        self.names.insert(path.clone(), input.to_owned());
        path
    }
}

fn check(path: &Path, text: &str, reporter: &mut Reporter) {
    match std::fs::read(path) {
        Ok(bytes) if bytes == text.as_bytes() => {}
        Ok(_) => reporter.error(&format!("{} is stale: generate it again without --check", path.display())),
        Err(error) => reporter.error(&format!("{} can't be compared: {error}", path.display())),
    }
}

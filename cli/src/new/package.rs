//! `lexibus new --crate`: creates a drive crate from a device description. Does not report warnings if the description
//! has no errors, because the build script of the crate reports them.

use std::path::{Component, Path, PathBuf};

use askama::Template;
use lexibus_codegen::compile::{self, Compilation, Options, NOTHING_TO_GENERATE};
use lexibus_codegen::ir::{Catalog, Device};
use lexibus_codegen::selection::Selection;

use super::files::Files;
use super::layout::{self, At};
use super::text::literal;
use super::{objects, profinet};
use crate::args::{New, Printing};
use crate::files::read;
use crate::report::Reporter;
use crate::{shell, Failure};

/// Names that a crate must not have: names that Cargo rejects, and names that the crate, its example or its tests use
/// for something else.
const RESERVED: [&str; 13] = [
    "test",
    "core",
    "std",
    "alloc",
    "proc_macro",
    "build",
    "examples",
    "deps",
    "self",
    "lexibus",
    "lexibus_codegen",
    "objects",
    "support",
];

#[derive(Template)]
#[template(path = "crate/Cargo.toml.txt", escape = "none")]
struct Manifest<'m> {
    name: &'m str,
    description: String,
    format: &'static str,
    is_in_workspace: bool,
}

#[derive(Template)]
#[template(path = "crate/build.rs.txt", escape = "none")]
struct BuildScript {
    file: String,
    device: Option<String>,
    /// Whether to generate the table of all entries, which the simulated device needs.
    has_table: bool,
}

impl BuildScript {
    /// Returns the code of the build script that calls `Builder`.
    fn builder(&self) -> String {
        // Assign a long file name to a variable first, so that the calls fit on a line.
        let (start, file) = match self.file.chars().count() > 40 {
            true if self.file.chars().count() > 77 => {
                (format!("let description =\n        {};\n    ", self.file), "description")
            }
            true => (format!("let description = {};\n    ", self.file), "description"),
            false => (String::new(), self.file.as_str()),
        };
        let compile = format!("compile_as({file}, \"bindings.rs\")");
        let table = self.has_table.then(|| "table(Presence::Always)".to_owned());
        let device = self.device.as_deref().map(|device| layout::call(At(8, ""), "device", &[device], ""));
        let calls: Vec<String> = table.into_iter().chain(device).chain([compile]).collect();
        let calls: Vec<&str> = calls.iter().map(String::as_str).collect();
        start + &layout::chain(At(4, ""), "Builder::new()", &calls, "")
    }
}

/// A device description, and data that all files of a new crate use.
pub(super) struct Package<'p> {
    /// Name of the library in Rust.
    pub library: String,
    /// Name of the device.
    pub title: String,
    pub catalog: &'p Catalog,
}

pub(super) fn run(new: &New, name: &str, description: &Path) -> Result<bool, Failure> {
    check_name(name)?;
    let folder = new.out.clone().unwrap_or_else(|| PathBuf::from(name));
    Files::check(&folder)?;
    let source = read(description)?;
    let devices = new.device.iter().cloned().collect();
    let options = Options { select: Selection { devices, ..Selection::default() }, ..Options::default() };
    let compilation = compile::check(source, &options);
    let Some((catalog, format)) = compilation.usable().zip(compilation.format) else {
        let mut reporter = Reporter::with(&Printing::NEW, false)?;
        reporter.report(&compilation)?;
        return reporter.finish();
    };
    let device = only_device(catalog, description)?;
    let package = Package { library: name.replace('-', "_"), title: title(device, name), catalog };
    let mut files = Files::default();
    match format.is_of_profinet() {
        true if new.bus.is_some() => {
            return Err(Failure::Usage("the file describes a device on PROFINET: leave out --bus".into()));
        }
        true => profinet::write(&package, &mut files)?,
        false => objects::write(&package, device, new.bus, &mut files)?,
    }
    let file = copy_sources(&compilation, &mut files)?;
    let manifest = Manifest {
        name,
        description: literal(&format!("Driver for {}", package.title)),
        format: if device.messages.is_empty() { format.feature() } else { "messages" },
        is_in_workspace: is_in_workspace(&folder),
    };
    files.text("Cargo.toml", render(&manifest)?);
    let device = new.device.as_ref().map(|device| literal(&device.to_string()));
    files.text("build.rs", render(&BuildScript { file, device, has_table: !format.is_of_profinet() })?);
    files.create(&folder)?;
    let (shown, argument) = (folder.display(), shell::argument(&folder.to_string_lossy()));
    crate::say(&format!("{shown}: created a drive crate. Try it with: cd {argument} && cargo run --example simulated"));
    Ok(true)
}

/// Returns the text of a file from its template.
pub(super) fn render(template: &impl Template) -> Result<String, Failure> {
    template.render().map_err(|error| Failure::Failed(format!("cannot write a file of the crate: {error}")))
}

/// Returns an error if the crate name is invalid. A valid name begins with an ASCII letter, and consists of ASCII
/// letters, digits, `-` and `_`. It is neither one of [`RESERVED`] nor a Rust keyword.
fn check_name(name: &str) -> Result<(), Failure> {
    let is_word = name.starts_with(|first: char| first.is_ascii_alphabetic())
        && name.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '-' || letter == '_');
    let library = name.replace('-', "_");
    let is_reserved = RESERVED.contains(&library.as_str()) || lexibus_codegen::names::escaped(&library) != library;
    match (is_word, is_reserved) {
        (true, false) => Ok(()),
        (true, true) => Err(Failure::Usage(format!("`{name}` is a reserved name: choose another name for the crate"))),
        (false, _) => Err(Failure::Usage(format!(
            "`{name}` is not a name of a crate: start with an ASCII letter, and use letters, digits, `-` and `_`"
        ))),
    }
}

/// Returns the device of the catalog. Returns an error unless the catalog has exactly one device.
fn only_device<'c>(catalog: &'c Catalog, description: &Path) -> Result<&'c Device, Failure> {
    let file = description.display();
    match catalog.devices.as_slice() {
        [device] => Ok(device),
        [] => Err(Failure::Usage(format!("{file}: {NOTHING_TO_GENERATE}"))),
        devices => Err(Failure::Usage(format!(
            "{file} describes {} devices: choose one with --device. `lexibus info {}` lists them",
            devices.len(),
            shell::argument(&description.to_string_lossy())
        ))),
    }
}

fn title(device: &Device, name: &str) -> String {
    let identity = &device.identity;
    let device = if device.name.is_empty() { &identity.order_code } else { &device.name };
    match (device.is_empty(), identity.vendor_name.is_empty()) {
        (true, _) => name.to_owned(),
        (false, true) => device.to_string(),
        (false, false) => format!("{} {device}", identity.vendor_name),
    }
}

/// Adds copies of all description files. Their paths relative to the main file stay the same. Returns the name of the
/// main file as a string literal. Returns an error if a file is outside of the main file's folder, or if
/// [`Files::copy`] rejects a file.
fn copy_sources(compilation: &Compilation, files: &mut Files) -> Result<String, Failure> {
    let Some(main) = compilation.sources.first() else { return Ok(literal("")) };
    let folder = main.folder().map(|folder| folder.to_string_lossy().into_owned()).unwrap_or_default();
    for source in &compilation.sources {
        let path = relative(source.name(), &folder).ok_or_else(|| {
            Failure::Usage(format!("{} is not in the folder of the description: move the file there", source.name()))
        })?;
        files.copy(path, source.bytes().to_vec())?;
    }
    Ok(literal(&relative(main.name(), &folder).unwrap_or_default()))
}

/// Returns the path of a file relative to a folder, with `/` between its parts. Returns `None` if the file is not in
/// the folder.
fn relative(file: &str, folder: &str) -> Option<String> {
    let inside = Path::new(file).strip_prefix(folder).ok()?;
    let part = |part: Component<'_>| match part {
        Component::Normal(part) => Some(part.to_string_lossy().into_owned()),
        _ => None,
    };
    let parts: Vec<String> = inside.components().map(part).collect::<Option<_>>()?;
    Some(parts.join("/")).filter(|path| !path.is_empty())
}

/// Returns whether a folder above `folder` is the root of a Cargo workspace.
fn is_in_workspace(folder: &Path) -> bool {
    let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
    folder.ancestors().skip(1).any(|folder| {
        let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).unwrap_or_default();
        manifest.parse::<toml::Table>().is_ok_and(|manifest| manifest.contains_key("workspace"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_manifest_of_a_workspace_is_found() {
        let root = std::env::temp_dir().join(format!("lexibus-new-workspace-{}", std::process::id()));
        std::fs::create_dir_all(root.join("a")).expect("a folder");
        for (manifest, expected) in [
            ("[workspace]\nmembers = []", true),
            ("  [ workspace ] # x", true),
            ("[workspace.package]\nedition = \"2021\"", true),
            ("workspace = { members = [] }", true),
            ("[package]\nname = \"a\"\nworkspace = \"..\"", false),
            ("[package]\ndescription = \"\"\"\n[workspace]\n\"\"\"", false),
            ("no TOML", false),
        ] {
            std::fs::write(root.join("Cargo.toml"), manifest).expect("a manifest");
            assert_eq!(is_in_workspace(&root.join("a/crate")), expected, "{manifest}");
        }
        std::fs::remove_dir_all(root).expect("a folder");
    }

    #[test]
    fn paths_stay_in_the_folder_of_the_description() {
        assert_eq!(relative("a/main.xml", "a").as_deref(), Some("main.xml"));
        assert_eq!(relative("a/Dicts/./dict.xml", "a").as_deref(), Some("Dicts/dict.xml"));
        assert_eq!(relative("main.xml", "").as_deref(), Some("main.xml"));
        for outside in ["b/main.xml", "a/../b.xml", "a", "ab/main.xml"] {
            assert_eq!(relative(outside, "a"), None, "{outside}");
        }
    }

    #[test]
    fn reserved_names_are_refused() {
        for name in ["support", "objects", "lexibus-codegen", "match"] {
            assert!(check_name(name).is_err(), "{name}");
        }
        assert!(check_name("support-x").is_ok());
    }
}

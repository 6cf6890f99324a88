//! Reads the device descriptions of nodes and SubDevices.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics, Severity};
use lexibus_codegen::facts::pdo::buses;
use lexibus_codegen::ir::{Bus, Catalog, Device};
use lexibus_codegen::selection::Selection;
use lexibus_codegen::source::{Source, Span};

use crate::syntax::At;

/// The description of a device. Several nodes or SubDevices can share it.
#[derive(Debug)]
pub struct Description {
    /// File of the description.
    pub source: Source,
    /// Options with which the description is compiled.
    pub options: Options,
    /// The catalog with one device.
    catalog: Catalog,
}

impl Description {
    /// Returns the catalog of the description.
    pub fn catalog(&self) -> &Catalog {
        &self.catalog
    }

    /// Returns the device.
    pub fn device(&self) -> &Device {
        &self.catalog.devices[0]
    }

    /// Returns the catalog without the facts that profiles add.
    pub fn without_profiles(&self) -> Option<Catalog> {
        let options = Options { no_profiles: true, ..self.options.clone() };
        compile::check(self.source.clone(), &options).catalog
    }
}

/// The keys of a section that name a device description.
pub(crate) struct DeviceReference<'d> {
    /// Title of the section for diagnostics: ``the node `axis1` ``.
    pub title: String,
    /// Location of the section's name.
    pub span: Span,
    /// Path of the device description.
    pub device: Option<&'d At<String>>,
    /// Name, order code or product code of the device, if the description contains several devices.
    pub model: Option<&'d At<String>>,
    /// Folders that are searched for the device description before the folder of the network file.
    pub folders: &'d [At<String>],
    /// Paths of overlays.
    pub overlays: &'d [At<String>],
}

/// Path of the description, paths of overlays, and model.
type Key = (PathBuf, Vec<PathBuf>, String);

/// Reads each combination of a description, its overlays and a model once.
pub(crate) struct Descriptions<'s> {
    network: &'s Source,
    bus: Bus,
    read: HashMap<Key, Option<Rc<Description>>>,
}

impl<'s> Descriptions<'s> {
    /// Creates a reader of the descriptions for devices on a bus.
    pub fn new(network: &'s Source, bus: Bus) -> Self {
        Descriptions { network, bus, read: HashMap::new() }
    }

    /// Returns the description of a device. If several devices have the same description, overlays and model, reports an unusable
    /// description only once.
    pub fn of(&mut self, reference: &DeviceReference<'_>, diagnostics: &mut Diagnostics) -> Option<Rc<Description>> {
        let Some(device) = reference.device else {
            let message = format!("{} has no device description", reference.title);
            let found = Diagnostic::new(&codes::DESCRIPTION_NOT_FOUND, reference.span, message);
            diagnostics.push(found.help(match self.bus {
                Bus::EtherCat => "add the path of an ESI or register table",
                _ => "add the path of an EDS, DCF, XDD, XDC or register table",
            }));
            return None;
        };
        let path = self.find(device, reference.folders, diagnostics)?;
        let overlays: Option<Vec<PathBuf>> =
            reference.overlays.iter().map(|overlay| self.find(overlay, &[], diagnostics)).collect();
        let model = reference.model.map_or(String::new(), |model| model.value.clone());
        let key = (path, overlays?, model);
        if let Some(known) = self.read.get(&key) {
            return known.clone();
        }
        let found = self.compile(device, &key, diagnostics).map(Rc::new);
        self.read.insert(key, found.clone());
        found
    }

    fn compile(&self, device: &At<String>, key: &Key, diagnostics: &mut Diagnostics) -> Option<Description> {
        let (path, overlays, model) = key;
        let mut unreadable = |error: std::io::Error| {
            let message = format!("the description cannot be read: {error}");
            diagnostics.push(Diagnostic::new(&codes::DESCRIPTION_UNUSABLE, device.span, message));
        };
        let source = self.open(path).map_err(&mut unreadable).ok()?;
        let overlays =
            overlays.iter().map(|path| self.open(path)).collect::<Result<_, _>>().map_err(unreadable).ok()?;
        let devices = if model.is_empty() { Vec::new() } else { model.parse().into_iter().collect() };
        let select = Selection { devices, ..Selection::default() };
        let options = Options { overlays, select, ..Options::default() };
        let compilation = compile::check(source.clone(), &options);
        match usable(&compilation, &options.overlays, self.bus) {
            Ok(()) => Some(Description { source, options, catalog: compilation.catalog? }),
            Err(fault) => {
                let found = Diagnostic::new(&codes::DESCRIPTION_UNUSABLE, device.span, fault.message).help(fault.help);
                diagnostics.push(fault.notes.into_iter().fold(found, Diagnostic::note));
                None
            }
        }
    }

    /// Opens a file. If the path starts with the folder of the network file, the source's name spells this folder as the
    /// name of the network file does.
    fn open(&self, path: &Path) -> std::io::Result<Source> {
        let source = Source::read(path)?;
        let shown = match path.strip_prefix(self.folder()) {
            Ok(relative) => Path::new(self.network.name()).parent().unwrap_or(Path::new("")).join(relative),
            Err(_) => path.to_owned(),
        };
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        Ok(Source::new(shown.to_string_lossy(), source.bytes().into_owned()).in_folder(folder))
    }

    fn folder(&self) -> &Path {
        self.network.folder().unwrap_or(Path::new(""))
    }

    /// Searches for a file in `folders` and then in the folder of the network file. Returns the path of the file, or reports
    /// that it is not found.
    fn find(&self, name: &At<String>, folders: &[At<String>], diagnostics: &mut Diagnostics) -> Option<PathBuf> {
        let mut unknown = Vec::new();
        let name_path = expanded(name, &mut unknown);
        let mut paths: Vec<PathBuf> =
            folders.iter().map(|folder| expanded(folder, &mut unknown).join(&name_path)).collect();
        paths.push(name_path);
        let paths: Vec<PathBuf> = paths.iter().map(|path| self.folder().join(path)).collect();
        if let Some(path) = paths.iter().find(|path| path.is_file()) {
            return Some(path.clone());
        }
        let message = format!("the file `{}` is not found", name.value);
        let mut found = Diagnostic::new(&codes::DESCRIPTION_NOT_FOUND, name.span, message)
            .label("the path is relative to the folder of the network file");
        if let Some(other) = similar_file(&name.value, &paths) {
            found = found.help(format!("write `{other}`"));
        }
        for variable in unknown {
            found = found.note(format!("the environment variable `{variable}` is not set"));
        }
        for folder in folders {
            found = found.note_at(folder.span, "Lexibus also searches this folder");
        }
        diagnostics.push(found);
        None
    }
}

/// Replaces the file name in `name` with a similar one that exists in the folder of one of `paths`. Returns `None` if there
/// is no such file.
fn similar_file(name: &str, paths: &[PathBuf]) -> Option<String> {
    let similar = |path: &PathBuf| {
        let entries = std::fs::read_dir(path.parent()?).ok()?;
        let mut names: Vec<String> =
            entries.filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned())).collect();
        names.sort();
        let wanted = path.file_name()?.to_string_lossy().into_owned();
        let similar = lexibus_codegen::text::similar(&wanted, names.iter().map(String::as_str))?;
        Some(Path::new(name).with_file_name(similar).to_string_lossy().into_owned())
    };
    paths.iter().find_map(similar)
}

/// Replaces `\` with `/` in a path, and expands `$NAME` and `${NAME}`. Removes `@BUS_CONFIG_PATH@`, the folder of the network file,
/// from the start of the path. Adds the names of unset variables to `unknown`.
pub(crate) fn expanded(path: &str, unknown: &mut Vec<String>) -> PathBuf {
    let path = path.replace('\\', "/");
    let path = path.strip_prefix("@BUS_CONFIG_PATH@").map_or(path.as_str(), |rest| rest.trim_start_matches('/'));
    PathBuf::from(expand(path, &|name| std::env::var(name).ok(), unknown))
}

/// Replaces environment variables in a text. Unset variables remain in the text, and their names are added to `unknown`.
fn expand(text: &str, variable: &dyn Fn(&str) -> Option<String>, unknown: &mut Vec<String>) -> String {
    let mut expanded = String::new();
    let mut rest = text;
    while let Some(at) = rest.find('$') {
        expanded += &rest[..at];
        let after = &rest[at + 1..];
        let is_name = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
        let (name, length) = match after.strip_prefix('{').and_then(|braced| braced.split_once('}')) {
            Some((name, _)) => (name, name.len() + 2),
            None => {
                let length = after.find(|letter| !is_name(letter)).unwrap_or(after.len());
                (&after[..length], length)
            }
        };
        match variable(name).filter(|_| !name.is_empty()) {
            Some(value) => expanded += &value,
            None => {
                unknown.push(name.to_owned());
                expanded += &rest[at..at + 1 + length];
            }
        }
        rest = &after[length..];
    }
    expanded + rest
}

/// The reason why a description cannot be used.
struct Fault {
    message: String,
    help: String,
    notes: Vec<String>,
}

fn usable(compilation: &Compilation, overlays: &[Source], bus: Bus) -> Result<(), Fault> {
    let name = compilation.sources[0].name();
    let overlays = overlays.iter().map(|overlay| format!(" --overlay {}", overlay.name()));
    let overlays: String = overlays.collect();
    let devices = compilation.catalog.as_ref().map_or(&[][..], |catalog| &catalog.devices);
    if !compilation.is_usable() {
        let errors = compilation.diagnostics.list().iter().filter(|found| found.severity == Severity::Error);
        return Err(Fault {
            message: format!("the description `{name}` has errors"),
            help: format!("correct the errors; `lexibus check {name}{overlays}` prints all diagnostics"),
            notes: errors.take(3).map(|found| compilation.one_line(found)).collect(),
        });
    }
    let fault = |message: String, help: &str| Err(Fault { message, help: help.to_owned(), notes: Vec::new() });
    let help = match bus {
        Bus::EtherCat => "use the description of an EtherCAT device",
        _ => "use the description of a CANopen device",
    };
    match devices {
        [device] => match unsupported(device, bus) {
            None => Ok(()),
            Some(reason) => fault(format!("the device in `{name}` {reason}"), help),
        },
        [] => fault(format!("`{name}` describes no device"), help),
        several => Err(Fault {
            message: format!("`{name}` describes {} devices", several.len()),
            help: "choose a device with `model`".to_owned(),
            notes: several.iter().take(5).map(|device| format!("`{}` is a device", device.name)).collect(),
        }),
    }
}

/// Returns the reason why a device cannot be used on `bus`, or `None` if it can.
fn unsupported(device: &Device, bus: Bus) -> Option<&'static str> {
    match bus {
        Bus::EtherCat if device.ethercat.is_none() => Some("has no EtherCAT settings"),
        Bus::EtherCat => None,
        _ if buses(device).canopen && device.items().any(|item| item.object().is_some()) => None,
        _ => Some("has no CANopen objects"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn environment_variables_are_replaced() {
        let value = |name: &str| (name == "HOME").then(|| "/home/a".to_owned());
        let mut unknown = Vec::new();
        assert_eq!(expand("${HOME}/x.eds", &value, &mut unknown), "/home/a/x.eds");
        assert_eq!(expand("$HOME/x", &value, &mut unknown), "/home/a/x");
        assert_eq!(expand("a$", &value, &mut unknown), "a$");
        assert_eq!(expand("$OTHER/x", &value, &mut unknown), "$OTHER/x");
        assert_eq!(unknown, ["", "OTHER"]);
    }
}

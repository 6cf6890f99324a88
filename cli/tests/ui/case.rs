//! Reads a test case: its folder, its settings, and its expected files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::diagnostics::{Level, Levels};
use lexibus_codegen::selection::Selection;
use lexibus_codegen::source::Source;
use serde::Deserialize;
use similar::TextDiff;

/// Name of the file with the settings of a test case.
const SETTINGS: &str = "case.toml";
/// Extensions of network files in a test case for networks. `network.toml` is also a network file.
const NETWORK_FILES: [&str; 3] = ["yml", "cpj", "xml"];
/// Name of the file with the expected diagnostics. The file is absent if none are expected.
const DIAGNOSTICS: &str = "diagnostics";

/// The settings in `case.toml`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// One sentence that states the rule that the case tests.
    pub about: String,
    /// Files to compile in this order. By default, these are all files of the folder, except settings, overlays and
    /// expected files. In a test case for networks, these are only the network files. For `diff`, the inputs are the
    /// old and the new file.
    inputs: Vec<String>,
    strict: bool,
    allow: Vec<String>,
    warn: Vec<String>,
    deny: Vec<String>,
    node_id_alias: Vec<String>,
    option: Vec<String>,
    device: Vec<String>,
    module: Vec<String>,
    objects: Vec<String>,
    overlays: Vec<String>,
    no_profiles: bool,
    /// Whether only the original form of the input is compiled, and not forms with other line ends, encodings and byte
    /// order marks.
    pub one_form: bool,
    /// For each output, the parts to compare; an empty list means the whole output. See `part.rs`.
    pub rust: Option<Vec<String>>,
    pub info: Option<Vec<String>>,
    pub dump: Option<Vec<String>>,
    pub eds: Option<Vec<String>>,
    pub dcf: Option<Vec<String>>,
    pub esi: Option<Vec<String>>,
    pub gsdml: Option<Vec<String>>,
    pub markdown: Option<Vec<String>>,
    /// Whether `lexibus diff` compares the two inputs.
    pub diff: bool,
    /// Whether the inputs are network files, whose descriptions are other files of the folder.
    pub network: bool,
    /// Calls of `lexibus` whose output is compared. A line `cat FILE` shows a file, and a line `cp FROM TO` copies a
    /// file. If there are calls, all other outputs are omitted.
    pub commands: Vec<String>,
    /// Columns of a register list in the form `field=column`, as for `--map`.
    pub map: Vec<String>,
    /// Parts of the register table that is imported from the input, a CSV file.
    pub table: Option<Vec<String>>,
    /// Whether an exported EDS or DCF contains REAL values as IEEE 754 bit patterns, as with `--real hex`.
    pub real_hex: bool,
    /// Additional facts for an export in the form `key = "value"`, as for `--set`.
    pub set: BTreeMap<String, String>,
}

/// A test case.
pub struct Case {
    pub folder: PathBuf,
    pub settings: Settings,
}

impl Case {
    /// Reads the settings of the test case in `folder`.
    pub fn open(folder: PathBuf) -> Self {
        let path = folder.join(SETTINGS);
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let settings: Settings = toml::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert!(!settings.about.is_empty(), "{}: `about` is missing", path.display());
        Case { folder, settings }
    }

    /// Returns the name of the test case: `area/case`.
    pub fn name(&self) -> String {
        let parts: Vec<_> =
            self.folder.components().rev().take(2).map(|part| part.as_os_str().to_string_lossy()).collect();
        format!("{}/{}", parts[1], parts[0])
    }

    /// Returns the folder name of the test case.
    pub fn folder_name(&self) -> String {
        self.name().split_once('/').expect("an area and a case").1.to_owned()
    }

    /// Returns the files to compile in their order.
    pub fn inputs(&self) -> Vec<Source> {
        let mut names = self.settings.inputs.clone();
        if names.is_empty() {
            let is_other =
                |name: &String| *name == SETTINGS || is_expected(name) || self.settings.overlays.contains(name);
            names = self.file_names().into_iter().filter(|name| !is_other(name)).collect();
            if self.settings.network {
                names.retain(|name| {
                    NETWORK_FILES.contains(&name.rsplit('.').next().unwrap_or_default()) || name == "network.toml"
                });
            }
        }
        assert!(!names.is_empty(), "{}: no input", self.name());
        names.iter().map(|name| self.source(name)).collect()
    }

    fn source(&self, name: &str) -> Source {
        let bytes =
            std::fs::read(self.folder.join(name)).unwrap_or_else(|error| panic!("{}/{name}: {error}", self.name()));
        Source::new(name, bytes).in_folder(&self.folder)
    }

    /// Returns a source with the name of an input, the given bytes, and the folder of the test case.
    pub fn source_of(&self, name: &str, bytes: Vec<u8>) -> Source {
        Source::new(name, bytes).in_folder(&self.folder)
    }

    /// Returns the compiler options from the settings.
    pub fn options(&self) -> Options {
        let settings = &self.settings;
        Options {
            levels: self.levels(),
            node_id_aliases: settings.node_id_alias.clone(),
            choices: settings.option.iter().map(|text| compile::choice(text).expect("NAME=CHOICE")).collect(),
            select: self.selection(),
            overlays: settings.overlays.iter().map(|name| self.source(name)).collect(),
            no_profiles: settings.no_profiles,
            ..Options::default()
        }
    }

    /// Returns the diagnostic levels from the settings.
    pub fn levels(&self) -> Levels {
        let settings = &self.settings;
        let mut levels = if settings.strict { Levels::strict() } else { Levels::lenient() };
        for (codes, level) in
            [(&settings.allow, Level::Allow), (&settings.warn, Level::Warn), (&settings.deny, Level::Deny)]
        {
            for code in codes {
                levels.set(code, level).unwrap_or_else(|error| panic!("{}: {error}", self.name()));
            }
        }
        levels
    }

    fn selection(&self) -> Selection {
        let settings = &self.settings;
        Selection {
            devices: settings.device.iter().map(|text| text.parse().expect("a selection")).collect(),
            modules: settings.module.iter().map(|text| text.as_str().into()).collect(),
            objects: settings.objects.iter().map(|text| text.parse().expect("a selection")).collect(),
            pdos: false,
        }
    }

    /// Compares the expected files with the actual outputs.
    ///
    /// # Errors
    ///
    /// If they differ, returns the differences line by line, and the command that accepts the new output.
    pub fn compare(&self, actual: &Outputs) -> Result<(), String> {
        let mut message = String::new();
        for name in self.expected_names().iter().filter(|name| !actual.contains_key(*name)) {
            message += &format!("{}/{name} exists, but the case has no such output\n", self.name());
        }
        for (name, text) in actual {
            let expected = std::fs::read_to_string(self.folder.join(name)).unwrap_or_default();
            if expected != *text {
                let (expected_name, actual_name) = (format!("{}/{name}", self.name()), "actual".to_owned());
                let diff = TextDiff::from_lines(&expected, text);
                message += &diff.unified_diff().header(&expected_name, &actual_name).to_string();
            }
        }
        if message.is_empty() {
            return Ok(());
        }
        let filter = self.folder_name();
        Err(format!("{message}to accept: LEXIBUS_BLESS=1 cargo test -p lexibus-cli --test ui {filter}"))
    }

    /// Writes the expected files and removes obsolete ones.
    ///
    /// # Errors
    ///
    /// Returns an error if a file cannot be written.
    pub fn write_expected(&self, actual: &Outputs) -> std::io::Result<()> {
        for name in self.expected_names().iter().filter(|name| !actual.contains_key(*name)) {
            std::fs::remove_file(self.folder.join(name))?;
        }
        for (name, text) in actual {
            std::fs::write(self.folder.join(name), text)?;
        }
        Ok(())
    }

    /// Returns the names of the expected files that exist.
    fn expected_names(&self) -> Vec<String> {
        self.file_names().into_iter().filter(|name| is_expected(name)).collect()
    }

    fn file_names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.folder).expect("the folder of a case");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("a file of a case").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// Returns the expected diagnostics.
    pub fn expected_diagnostics(&self) -> String {
        std::fs::read_to_string(self.folder.join(DIAGNOSTICS)).unwrap_or_default()
    }
}

/// Names and texts of the output files of a test case.
pub type Outputs = BTreeMap<String, String>;

/// Returns whether a file of a test case is an expected output.
fn is_expected(name: &str) -> bool {
    name == DIAGNOSTICS || name.starts_with("output.")
}

/// Adds the output file of diagnostics unless `text` is empty.
pub fn put_diagnostics(outputs: &mut Outputs, text: String) {
    if !text.is_empty() {
        outputs.insert(DIAGNOSTICS.to_owned(), text);
    }
}

/// Returns the extension of a file name.
pub fn ending(name: &str) -> &str {
    Path::new(name).extension().and_then(|ending| ending.to_str()).unwrap_or_default()
}

//! The entry point for `build.rs`.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::backend::rust::{emit_catalog, write_catalog, Presence, RustOptions};
use crate::compile::{self, Compilation, Options};
use crate::diagnostics::{render, Level, Levels, Severity, UnknownCode};
use crate::ir::Catalog;
use crate::output::Writer;
use crate::selection::SelectionError;
use crate::source::Source;

/// Generates Rust from device descriptions in a build script.
///
/// ```no_run
/// // build.rs
/// fn main() -> Result<(), lexibus_codegen::BuildError> {
///     lexibus_codegen::Builder::new().compile("drive.eds")
/// }
/// ```
///
/// ```ignore
/// // src/lib.rs
/// pub mod drive {
///     include!(concat!(env!("OUT_DIR"), "/drive.rs"));
/// }
/// ```
///
/// The output file is written only if its content changes. Cargo runs the script again if the description changes, and
/// shows the warnings about the description.
#[derive(Clone, Debug, Default)]
pub struct Builder {
    options: Options,
    strict: bool,
    levels: Vec<(String, Level)>,
    devices: Vec<String>,
    objects: Vec<String>,
    overlays: Vec<PathBuf>,
    out_dir: Option<PathBuf>,
    quiet: bool,
}

impl Builder {
    /// Creates a builder with the default options: lenient mode, accessors and PDOs, no table.
    pub fn new() -> Self {
        Builder::default()
    }

    /// Turns every repair of the input into an error, unless a level is set for the diagnostic code of the repair.
    pub fn strict(mut self) -> Self {
        self.strict = true;
        self
    }

    /// Suppresses the diagnostics with a code, which is given by its identifier (`EDS020`) or name (`octal-number`).
    /// The name `warnings` means all codes that are warnings by default, except codes with their own level and, in
    /// strict mode, repairs. Errors cannot be suppressed.
    pub fn allow(self, code: impl Into<String>) -> Self {
        self.level(code, Level::Allow)
    }

    /// Reports the diagnostics with a code as warnings. Errors remain errors. The code is given as in
    /// [`allow`](Self::allow).
    pub fn warn(self, code: impl Into<String>) -> Self {
        self.level(code, Level::Warn)
    }

    /// Reports the diagnostics with a code as errors. The code is given as in [`allow`](Self::allow).
    pub fn deny(self, code: impl Into<String>) -> Self {
        self.level(code, Level::Deny)
    }

    fn level(mut self, code: impl Into<String>, level: Level) -> Self {
        self.levels.push((code.into(), level));
        self
    }

    /// Adds another name for `$NODEID` in formulas.
    pub fn node_id_alias(mut self, name: impl Into<String>) -> Self {
        self.options.node_id_aliases.push(name.into());
        self
    }

    /// Selects devices by name, order code, identifier or product code, and optionally by revision: `"EL3004"`,
    /// `"0x0BBC3052@0x00110000"`, `"EL3004@latest"`.
    ///
    /// Each call adds a filter. Without a call, all devices are selected.
    pub fn device(mut self, filter: impl Into<String>) -> Self {
        self.devices.push(filter.into());
        self
    }

    /// Selects modules by name, order code, identifier or ident number.
    ///
    /// Each call adds a filter. Without a call, all modules of the selected devices are selected.
    pub fn module(mut self, filter: impl AsRef<str>) -> Self {
        self.options.select.modules.push(filter.as_ref().into());
        self
    }

    /// Selects objects by index or range: `"0x6040"` or `"0x6000..0x67FF"`.
    ///
    /// Each call adds objects. Without a call, all objects are selected.
    pub fn objects(mut self, filter: impl Into<String>) -> Self {
        self.objects.push(filter.into());
        self
    }

    /// Sets an option of a register table. An option is a choice that the manual of the device leaves open.
    pub fn option(mut self, name: impl Into<String>, choice: impl Into<String>) -> Self {
        self.options.choices.push((name.into(), choice.into()));
        self
    }

    /// Adds an overlay: a table that corrects and completes the description. Overlays are applied in the order of the calls.
    ///
    /// Relative paths are relative to the folder of the crate, like the path of the input file.
    pub fn overlay(mut self, path: impl Into<PathBuf>) -> Self {
        self.overlays.push(path.into());
        self
    }

    /// Sets whether profiles (CiA 301, CiA 402, CoE, PROFIdrive) complete the objects of devices that follow them. The
    /// default is `true`.
    ///
    /// Profiles add units, descriptions, and the names of bits and values.
    pub fn profiles(mut self, profiles: bool) -> Self {
        self.options.no_profiles = !profiles;
        self
    }

    /// Sets the name of the generated device type. By default, the name is derived from the order code of an EtherCAT
    /// device, the name of the device, or the file name.
    pub fn device_name(mut self, name: impl Into<String>) -> Self {
        self.options.rust.device_name = Some(name.into());
        self
    }

    /// Sets the path of the runtime crate. The default is `::lexibus`.
    pub fn runtime(mut self, path: impl Into<String>) -> Self {
        self.options.rust.runtime = path.into();
        self
    }

    /// Sets whether an accessor method is generated for each entry. Generated code without accessors compiles in a third of
    /// the time that code with accessors needs.
    pub fn accessors(mut self, accessors: bool) -> Self {
        self.options.rust.accessors = accessors;
        self
    }

    /// Sets whether a struct is generated for each PDO.
    pub fn pdos(mut self, pdos: bool) -> Self {
        self.options.rust.pdos = pdos;
        self
    }

    /// Sets whether the output contains a static table of all entries, for tools: always, never, or only if a cargo feature is
    /// enabled.
    pub fn table(mut self, table: Presence) -> Self {
        self.options.rust.table = table;
        self
    }

    /// Sets all options of the generated Rust code.
    pub fn rust_options(mut self, options: RustOptions) -> Self {
        self.options.rust = options;
        self
    }

    /// Sets the output directory. The default is `OUT_DIR`.
    pub fn out_dir(mut self, directory: impl Into<PathBuf>) -> Self {
        self.out_dir = Some(directory.into());
        self
    }

    /// Suppresses the output for cargo. Use this method in programs that are not build scripts.
    pub fn quiet(mut self) -> Self {
        self.quiet = true;
        self
    }

    /// Compiles `input` to `<stem>.rs` in the output directory.
    ///
    /// Relative paths are relative to the folder of the crate, because cargo runs build scripts there.
    ///
    /// # Errors
    ///
    /// Fails if the input or an overlay cannot be read, the input has errors, or there is nothing to generate. Also
    /// fails if a level is set for an unknown code, a filter is invalid, no output directory is set (with
    /// [`out_dir`](Self::out_dir) or as `OUT_DIR`), or the output cannot be written.
    pub fn compile(&self, input: impl AsRef<Path>) -> Result<(), BuildError> {
        self.compile_to(input, None)
    }

    /// Compiles `input` to the file `name` in the output directory.
    ///
    /// # Errors
    ///
    /// Fails in the same cases as [`Builder::compile`].
    pub fn compile_as(&self, input: impl AsRef<Path>, name: &str) -> Result<(), BuildError> {
        self.compile_to(input, Some(name))
    }

    fn compile_to(&self, input: impl AsRef<Path>, name: Option<&str>) -> Result<(), BuildError> {
        let input = input.as_ref();
        let stem = input.file_stem().map_or_else(|| "device".into(), |stem| stem.to_string_lossy());
        let name = name.map_or_else(|| format!("{stem}.rs"), str::to_owned);
        let catalog = self.check(input)?;
        let directory = match &self.out_dir {
            Some(directory) => directory.clone(),
            None => std::env::var_os("OUT_DIR").map(PathBuf::from).ok_or(BuildError::NoOutDir)?,
        };
        let path = directory.join(name);
        let mut writer = Writer::new(&path);
        if !write_catalog(&catalog, &self.options.rust, &mut |part| writer.push(part.as_bytes())) {
            return Err(BuildError::Empty { path: input.into() });
        }
        writer.finish().map_err(|error| BuildError::Write { path: path.clone(), error })
    }

    /// Returns the Rust code for `input`.
    ///
    /// # Errors
    ///
    /// Fails if the input or an overlay cannot be read, the input has errors, or there is nothing to generate. Also
    /// fails if a level is set for an unknown code, or a filter is invalid.
    pub fn generate(&self, input: impl AsRef<Path>) -> Result<String, BuildError> {
        let input = input.as_ref();
        let text = emit_catalog(&self.check(input)?, &self.options.rust);
        text.ok_or_else(|| BuildError::Empty { path: input.into() })
    }

    /// Reads and checks `input`. Reports the warnings and the files that were read to Cargo.
    fn check(&self, input: &Path) -> Result<Catalog, BuildError> {
        self.tell_cargo(format_args!("cargo::rerun-if-changed={}", input.display()));
        let options = self.options()?;
        let source = Source::read(input).map_err(|error| BuildError::Read { path: input.into(), error })?;
        let compilation = compile::check(source, &options);
        for other in compilation.sources.iter().skip(1) {
            self.tell_cargo(format_args!("cargo::rerun-if-changed={}", other.name()));
        }
        // Cargo has to run the build script again as soon as one of the missing files exists.
        for path in &compilation.missing {
            self.tell_cargo(format_args!("cargo::rerun-if-changed={}", path.display()));
        }
        self.report(&compilation);
        let errors = errors(&compilation);
        compilation.into_usable().ok_or(BuildError::Input(errors))
    }

    fn options(&self) -> Result<Options, BuildError> {
        let mut levels = if self.strict { Levels::strict() } else { Levels::lenient() };
        for (code, level) in &self.levels {
            levels.set(code, *level).map_err(BuildError::UnknownCode)?;
        }
        let mut options = Options { levels, ..self.options.clone() };
        for text in &self.devices {
            options.select.devices.push(text.parse().map_err(BuildError::Selection)?);
        }
        for text in &self.objects {
            options.select.objects.push(text.parse().map_err(BuildError::Selection)?);
        }
        for path in &self.overlays {
            let read = Source::read(path).map_err(|error| BuildError::Read { path: path.clone(), error });
            options.overlays.push(read?);
        }
        Ok(options)
    }

    fn report(&self, compilation: &Compilation) {
        let warnings = compilation.diagnostics.list().iter().filter(|d| d.severity == Severity::Warning);
        for warning in warnings {
            self.tell_cargo(format_args!("cargo::warning={}", compilation.one_line(warning)));
        }
    }

    fn tell_cargo(&self, line: fmt::Arguments<'_>) {
        if !self.quiet {
            println!("{line}");
        }
    }
}

fn errors(compilation: &Compilation) -> String {
    let errors = compilation.diagnostics.list().iter().filter(|d| d.severity == Severity::Error);
    let shown = errors.map(|error| render::terminal::render(error, &compilation.sources, false));
    shown.collect::<Vec<_>>().join("\n\n")
}

/// Error of [`Builder::compile`], [`Builder::compile_as`] or [`Builder::generate`].
///
/// `Debug` prints the same text as `Display`, because Rust shows the `Debug` text if the `main` function of a build
/// script returns the error.
pub enum BuildError {
    /// The input or an overlay cannot be read.
    Read {
        /// Path of the input or overlay.
        path: PathBuf,
        /// Error of the operating system.
        error: std::io::Error,
    },
    /// The output cannot be written.
    Write {
        /// Path of the output.
        path: PathBuf,
        /// Error of the operating system.
        error: std::io::Error,
    },
    /// The compiler reported errors in the input. The text contains the rendered errors.
    Input(String),
    /// The input describes no device or module for which code is generated.
    Empty {
        /// Path of the input.
        path: PathBuf,
    },
    /// A level is set for an unknown code.
    UnknownCode(UnknownCode),
    /// A filter for devices or objects is invalid.
    Selection(SelectionError),
    /// `OUT_DIR` is not set, and the caller set no output directory.
    NoOutDir,
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BuildError::Read { path, error } => write!(f, "cannot read {}: {error}", path.display()),
            BuildError::Write { path, error } => write!(f, "cannot write {}: {error}", path.display()),
            BuildError::Input(text) => write!(f, "the device description has errors\n\n{text}"),
            BuildError::Empty { path } => write!(f, "{}: {}", path.display(), compile::NOTHING_TO_GENERATE),
            BuildError::UnknownCode(error) => write!(f, "{error}"),
            BuildError::Selection(error) => write!(f, "{error}"),
            BuildError::NoOutDir => f.write_str("OUT_DIR is not set: call `out_dir` if this is not a build script"),
        }
    }
}

impl fmt::Debug for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for BuildError {}

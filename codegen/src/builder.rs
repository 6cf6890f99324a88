//! The entry point for `build.rs`.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::backend::rust::{Presence, RustOptions};
use crate::compile::{self, Compilation, Options};
use crate::diagnostics::{render, Level, Levels, Severity, UnknownCode};
use crate::output::write_if_changed;
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
/// The output is written only where its bytes change. Cargo is told to run the script again when the description
/// changes, and shows every warning about it.
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
    /// A builder with the defaults: lenient, accessors and PDOs, no table.
    pub fn new() -> Self {
        Builder::default()
    }

    /// Turns every repair of the input into an error.
    pub fn strict(mut self) -> Self {
        self.strict = true;
        self
    }

    /// Sets the level of a diagnostic code, named `EDS020`, `octal-number`, or `warnings` for all of them.
    pub fn level(mut self, code: impl Into<String>, level: Level) -> Self {
        self.levels.push((code.into(), level));
        self
    }

    /// Another name that formulas use for `$NODEID`.
    pub fn node_id_alias(mut self, name: impl Into<String>) -> Self {
        self.options.node_id_aliases.push(name.into());
        self
    }

    /// Takes one of several devices, by name, order code or product code, and by revision: `"EL3004"`,
    /// `"0x0BBC3052@0x00110000"`, `"EL3004@latest"`. May be called several times; without it, all devices are taken.
    pub fn device(mut self, filter: impl Into<String>) -> Self {
        self.devices.push(filter.into());
        self
    }

    /// Takes one of the modules that can be plugged in, by name, identifier or ident number. May be called several
    /// times; without it, all modules are taken that fit into a device.
    pub fn module(mut self, filter: impl AsRef<str>) -> Self {
        self.options.select.modules.push(filter.as_ref().into());
        self
    }

    /// Takes the objects of this index or range, `"0x6040"` or `"0x6000..0x67FF"`. May be called several times; without
    /// it, all objects are taken.
    pub fn objects(mut self, filter: impl Into<String>) -> Self {
        self.objects.push(filter.into());
        self
    }

    /// Chooses what the manual of a register table leaves open. May be called several times.
    pub fn option(mut self, name: impl Into<String>, choice: impl Into<String>) -> Self {
        self.options.choices.push((name.into(), choice.into()));
        self
    }

    /// Applies an overlay: a table that corrects the description and adds what it can't carry. May be called several times;
    /// they are applied in this order.
    ///
    /// A path that isn't absolute is relative to the folder of the crate, as that of the input is.
    pub fn overlay(mut self, path: impl Into<PathBuf>) -> Self {
        self.overlays.push(path.into());
        self
    }

    /// Whether profiles (CiA 301, CiA 402, CoE, PROFIdrive) add names of bits and values, units and words to the objects of
    /// devices that follow them. They do by default.
    pub fn profiles(mut self, profiles: bool) -> Self {
        self.options.no_profiles = !profiles;
        self
    }

    /// The name of the device's type; from the name of the product by default.
    pub fn device_name(mut self, name: impl Into<String>) -> Self {
        self.options.rust.device_name = Some(name.into());
        self
    }

    /// The path of the runtime crate, where it isn't called `lexibus`.
    pub fn runtime(mut self, path: impl Into<String>) -> Self {
        self.options.rust.runtime = path.into();
        self
    }

    /// Whether there is an accessor method for every entry. Handles alone compile in a third of the time.
    pub fn accessors(mut self, accessors: bool) -> Self {
        self.options.rust.accessors = accessors;
        self
    }

    /// Whether there is a struct for every PDO.
    pub fn pdos(mut self, pdos: bool) -> Self {
        self.options.rust.pdos = pdos;
        self
    }

    /// Whether there is a static table of all entries, for tools.
    pub fn table(mut self, table: Presence) -> Self {
        self.options.rust.table = table;
        self
    }

    /// Everything that can be chosen about the generated Rust.
    pub fn rust_options(mut self, options: RustOptions) -> Self {
        self.options.rust = options;
        self
    }

    /// Where the output goes; `OUT_DIR` by default.
    pub fn out_dir(mut self, directory: impl Into<PathBuf>) -> Self {
        self.out_dir = Some(directory.into());
        self
    }

    /// Prints nothing for cargo. For callers that aren't build scripts.
    pub fn quiet(mut self) -> Self {
        self.quiet = true;
        self
    }

    /// Compiles `input` to `<stem>.rs` in the output directory.
    ///
    /// A path that isn't absolute is relative to the folder of the crate, where cargo runs build scripts.
    ///
    /// # Errors
    ///
    /// When the input can't be read or has errors, a level names no code, or the output can't be written.
    pub fn compile(&self, input: impl AsRef<Path>) -> Result<(), BuildError> {
        self.compile_to(input, None)
    }

    /// Compiles `input` to the file `name` in the output directory.
    ///
    /// # Errors
    ///
    /// As [`Builder::compile`].
    pub fn compile_as(&self, input: impl AsRef<Path>, name: &str) -> Result<(), BuildError> {
        self.compile_to(input, Some(name))
    }

    fn compile_to(&self, input: impl AsRef<Path>, name: Option<&str>) -> Result<(), BuildError> {
        let input = input.as_ref();
        let stem = input.file_stem().map_or_else(|| "device".into(), |stem| stem.to_string_lossy());
        let name = name.map_or_else(|| format!("{stem}.rs"), str::to_owned);
        let text = self.generate(input)?;
        let directory = match &self.out_dir {
            Some(directory) => directory.clone(),
            None => std::env::var_os("OUT_DIR").map(PathBuf::from).ok_or(BuildError::NoOutDir)?,
        };
        let path = directory.join(name);
        write_if_changed(&path, &text).map_err(|error| BuildError::Write { path, error })
    }

    /// The Rust that `input` compiles to.
    ///
    /// # Errors
    ///
    /// When the input can't be read or has errors, or a level names no code.
    pub fn generate(&self, input: impl AsRef<Path>) -> Result<String, BuildError> {
        let input = input.as_ref();
        self.tell_cargo(format_args!("cargo::rerun-if-changed={}", input.display()));
        let options = self.options()?;
        let source = Source::read(input).map_err(|error| BuildError::Read { path: input.into(), error })?;
        let compilation = compile::check(source, &options);
        for other in compilation.sources.iter().skip(1) {
            self.tell_cargo(format_args!("cargo::rerun-if-changed={}", other.name()));
        }
        // Once they are there, the description says more.
        for path in &compilation.missing {
            self.tell_cargo(format_args!("cargo::rerun-if-changed={}", path.display()));
        }
        self.report(&compilation);
        compilation.rust(&options.rust).ok_or_else(|| BuildError::Input(errors(&compilation)))
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
    if compilation.is_usable() {
        let name = compilation.sources.first().map_or("the file", |source| source.name());
        return format!("{name}: {}", compile::NOTHING_TO_GENERATE);
    }
    let errors = compilation.diagnostics.list().iter().filter(|d| d.severity == Severity::Error);
    let shown = errors.map(|error| render::terminal::render(error, &compilation.sources, false));
    shown.collect::<Vec<_>>().join("\n\n")
}

/// Why nothing was generated.
///
/// `Debug` prints the same text as `Display`, for it is what a build script's `main` shows.
pub enum BuildError {
    /// The input can't be read.
    Read {
        /// The input.
        path: PathBuf,
        /// What the operating system says.
        error: std::io::Error,
    },
    /// The output can't be written.
    Write {
        /// The output.
        path: PathBuf,
        /// What the operating system says.
        error: std::io::Error,
    },
    /// The input has errors: the rendered diagnostics.
    Input(String),
    /// A level was set for a code that doesn't exist.
    UnknownCode(UnknownCode),
    /// A text that was to select devices or objects can't.
    Selection(SelectionError),
    /// There is no `OUT_DIR`, and no other output directory was named.
    NoOutDir,
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BuildError::Read { path, error } => write!(f, "can't read {}: {error}", path.display()),
            BuildError::Write { path, error } => write!(f, "can't write {}: {error}", path.display()),
            BuildError::Input(text) => write!(f, "the device description has errors\n\n{text}"),
            BuildError::UnknownCode(error) => write!(f, "{error}"),
            BuildError::Selection(error) => write!(f, "{error}"),
            BuildError::NoOutDir => {
                f.write_str("OUT_DIR isn't set: outside of a build script, name an output directory with `out_dir`")
            }
        }
    }
}

impl fmt::Debug for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for BuildError {}

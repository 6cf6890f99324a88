//! Runs rustc (or clippy, if it is installed) and rustdoc on generated code.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::OnceLock;

/// Compiles `bindings` as a module of a `no_std` crate. All warnings are errors.
///
/// # Errors
///
/// Returns the output of the compiler.
#[allow(dead_code)] // Not every test program calls this function.
pub fn compile(name: &str, bindings: &str) -> Result<(), String> {
    compile_with(compiler(), "2021", name, bindings)
}

/// Compiles `bindings` like [`compile`], but without clippy.
///
/// # Errors
///
/// Returns the output of the compiler.
#[allow(dead_code)]
pub fn compile_by_rustc(name: &str, bindings: &str) -> Result<(), String> {
    compile_with(Command::new("rustc"), "2021", name, bindings)
}

/// Compiles `bindings` like [`compile`], but in the given edition of Rust.
///
/// # Errors
///
/// Returns the output of the compiler.
#[allow(dead_code)] // Not every test program calls this function.
pub fn compile_in(edition: &str, name: &str, bindings: &str) -> Result<(), String> {
    compile_with(compiler(), edition, name, bindings)
}

fn compile_with(command: Command, edition: &str, name: &str, bindings: &str) -> Result<(), String> {
    let stem = stem();
    let (module, root) = (stem.with_extension("module.rs"), stem.with_extension("rs"));
    let lints = "#![no_std]\n#![deny(warnings, missing_docs, clippy::all)]\n//! Bindings.\n/// The device.\n";
    std::fs::write(&module, bindings).expect("a temporary file");
    std::fs::write(&root, format!("{lints}pub mod device {{\n    include!({module:?});\n}}\n"))
        .expect("a temporary file");
    let result = metadata(command, edition, &stem, &root);
    for path in [&module, &root, &stem.with_extension("rmeta")] {
        let _ = std::fs::remove_file(path);
    }
    result.map_err(|text| format!("{name} does not compile:\n{}", start(&text)))
}

/// Compiles named modules as one crate, which is faster than one crate per module. The modules' `cfg` attributes may name the
/// feature `optional`, which is disabled.
///
/// # Errors
///
/// Returns the output of the compiler.
#[allow(dead_code)]
pub fn compile_modules(modules: &[(String, String)]) -> Result<(), String> {
    let stem = stem();
    let root = stem.with_extension("rs");
    let mut text = String::from("#![no_std]\n#![deny(warnings, missing_docs, clippy::all)]\n//! Bindings.\n");
    let mut files = vec![root.clone(), stem.with_extension("rmeta")];
    for (name, bindings) in modules {
        let module = stem.with_extension(format!("{name}.rs"));
        std::fs::write(&module, bindings).expect("a temporary file");
        text += &format!("/// One.\npub mod {name} {{\n    include!({module:?});\n}}\n");
        files.push(module);
    }
    std::fs::write(&root, text).expect("a temporary file");
    let mut command = compiler();
    command.args(["--check-cfg", "cfg(feature, values(\"optional\"))"]);
    let result = metadata(command, "2021", &stem, &root);
    // If the compilation fails, keep the files for inspection.
    for path in files.iter().filter(|_| result.is_ok()) {
        let _ = std::fs::remove_file(path);
    }
    result
}

/// Checks named modules as one crate that depends on serde and defmt. The feature `optional` of the crate is enabled.
///
/// # Errors
///
/// Returns the output of Cargo.
#[allow(dead_code)]
pub fn check_with_traits(modules: &[(String, String)]) -> Result<(), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("with-traits");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("src")).expect("a folder for temporary files");
    let manifest = format!(
        "[package]\nname = \"with-traits\"\nversion = \"0.0.0\"\nedition = \"2021\"\n[workspace]\n\
         [features]\ndefault = [\"optional\"]\noptional = []\n[dependencies]\n\
         lexibus = {{ path = {root:?}, features = [\"serde\", \"defmt\"] }}\n\
         serde = {{ version = \"1\", default-features = false, features = [\"derive\"] }}\ndefmt = \"1\"\n"
    );
    std::fs::write(folder.join("Cargo.toml"), manifest).expect("a manifest");
    // Use the dependency versions of the workspace, so that nothing is downloaded.
    std::fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).expect("the workspace's Cargo.lock");
    let mut text = String::from("#![no_std]\n#![deny(warnings)]\n//! Bindings.\n");
    for (name, bindings) in modules {
        std::fs::write(folder.join("src").join(name).with_extension("rs"), bindings).expect("a module");
        text += &format!("/// One.\npub mod {name};\n");
    }
    std::fs::write(folder.join("src/lib.rs"), text).expect("a crate root");
    let output = Command::new(env!("CARGO"))
        .args(["check", "--quiet"])
        .current_dir(&folder)
        // Share the target folder with the drive crates of other tests, because they have the same dependencies.
        .env("CARGO_TARGET_DIR", folder.with_file_name("drive-crate"))
        .output()
        .expect("cargo runs");
    output.status.success().then_some(()).ok_or_else(|| start(&String::from_utf8_lossy(&output.stderr)))
}

/// Compiles a crate up to its metadata, without generating machine code.
fn metadata(mut command: Command, edition: &str, stem: &Path, root: &Path) -> Result<(), String> {
    let output = command
        .args(["--edition", edition, "--crate-type", "lib", "--emit", "metadata", "--crate-name", "bindings", "-o"])
        .arg(stem.with_extension("rmeta"))
        .arg("--extern")
        .arg(format!("lexibus={}", runtime().display()))
        .arg(root)
        .output()
        .expect("the compiler runs");
    if output.status.success() {
        return Ok(());
    }
    Err(String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Runs rustdoc on `bindings`, which become nested modules of a crate. All warnings of rustdoc, for example about
/// broken, ambiguous or private links, are errors.
///
/// # Errors
///
/// Returns the output of rustdoc.
#[allow(dead_code)] // Not every test program calls this function.
pub fn document(name: &str, bindings: &[&str]) -> Result<(), String> {
    documented(name, bindings, |_| ())
}

/// Runs rustdoc on `bindings` and returns a page. `path` is relative to the page of the module.
///
/// # Errors
///
/// Returns the output of rustdoc, or the error if the page cannot be read.
#[allow(dead_code)]
pub fn page(name: &str, bindings: &str, path: &str) -> Result<String, String> {
    let read = |folder: &Path| std::fs::read_to_string(folder.join("bindings/outer_0/device").join(path));
    documented(name, &[bindings], read)?.map_err(|error| format!("{path}: {error}"))
}

/// Runs rustdoc and passes the path of the documentation folder to `read`.
fn documented<T>(name: &str, bindings: &[&str], read: impl FnOnce(&Path) -> T) -> Result<T, String> {
    let stem = stem();
    let (folder, root) = (stem.with_extension("doc"), stem.with_extension("rs"));
    let mut text = String::from("#![no_std]\n#![deny(warnings)]\n//! Bindings.\n");
    let mut files = vec![root.clone()];
    for (at, bindings) in bindings.iter().enumerate() {
        let module = stem.with_extension(format!("module_{at}.rs"));
        std::fs::write(&module, bindings).expect("a temporary file");
        let content = format!("/// The device.\npub mod device {{\ninclude!({module:?});\n}}\n");
        text += &format!("/// One.\npub mod outer_{at} {{\n{content}}}\n");
        files.push(module);
    }
    std::fs::write(&root, text).expect("a temporary file");
    let output = Command::new("rustdoc")
        .args(["--edition", "2021", "--crate-type", "lib", "--crate-name", "bindings", "-o"])
        .arg(&folder)
        .arg("--extern")
        .arg(format!("lexibus={}", runtime().display()))
        .arg(&root)
        .output()
        .expect("rustdoc runs");
    let result = output.status.success().then(|| read(&folder));
    for path in &files {
        let _ = std::fs::remove_file(path);
    }
    let _ = std::fs::remove_dir_all(&folder);
    let text = String::from_utf8_lossy(&output.stderr);
    result.ok_or_else(|| format!("{name} cannot be documented:\n{}", start(&text)))
}

/// Compiles `text` as a program that uses the runtime, and runs the program.
///
/// # Errors
///
/// Returns the output of the compiler or the program.
#[allow(dead_code)]
pub fn run(name: &str, text: &str) -> Result<(), String> {
    let stem = stem();
    let (root, program) = (stem.with_extension("rs"), stem.with_extension("program"));
    std::fs::write(&root, text).expect("a temporary file");
    let compiled = Command::new("rustc")
        .args(["--edition", "2021", "--crate-name", "program", "-C", "debug-assertions", "--cap-lints", "allow", "-o"])
        .arg(&program)
        .arg("--extern")
        .arg(format!("lexibus={}", library().display()))
        .arg(&root)
        .output()
        .expect("rustc runs");
    let ran = compiled.status.success().then(|| Command::new(&program).output().expect("the program runs"));
    let _ = std::fs::remove_file(&root);
    let _ = std::fs::remove_file(&program);
    let output = ran.unwrap_or(compiled);
    if output.status.success() {
        return Ok(());
    }
    let text = String::from_utf8_lossy(&output.stderr);
    Err(format!("{name}:\n{}", start(&text)))
}

/// Returns the first 40 lines of a compiler's output.
fn start(text: &str) -> String {
    text.lines().take(40).collect::<Vec<_>>().join("\n")
}

/// Returns a unique prefix for names of temporary files.
fn stem() -> PathBuf {
    static NUMBER: AtomicUsize = AtomicUsize::new(0);
    let number = NUMBER.fetch_add(1, Ordering::Relaxed);
    folder().join(format!("{}_{number}", std::process::id()))
}

fn folder() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("generated-code");
        std::fs::create_dir_all(&folder).expect("a folder for temporary files");
        folder
    })
}

/// Returns the command for clippy's driver, or for rustc if clippy is not installed. The driver is rustc with additional
/// lints; it needs the libraries of its toolchain.
fn compiler() -> Command {
    static PROGRAM: OnceLock<(PathBuf, PathBuf)> = OnceLock::new();
    let (program, libraries) = PROGRAM.get_or_init(|| {
        let output = Command::new("rustc").args(["--print", "sysroot"]).output().expect("rustc runs");
        let sysroot = PathBuf::from(String::from_utf8_lossy(&output.stdout).trim());
        let clippy = sysroot.join("bin/clippy-driver");
        if clippy.is_file() {
            return (clippy, sysroot.join("lib"));
        }
        eprintln!("clippy is not installed: only rustc checks generated code");
        (sysroot.join("bin/rustc"), sysroot.join("lib"))
    });
    let mut command = Command::new(program);
    command.env("LD_LIBRARY_PATH", libraries);
    command
}

/// Returns the path of the runtime's metadata file. The first call builds the file.
fn runtime() -> &'static Path {
    static RUNTIME: OnceLock<PathBuf> = OnceLock::new();
    RUNTIME.get_or_init(|| build_runtime("rmeta", "metadata"))
}

/// Returns the path of the runtime library with which programs are linked. The first call builds the library.
fn library() -> &'static Path {
    static LIBRARY: OnceLock<PathBuf> = OnceLock::new();
    LIBRARY.get_or_init(|| build_runtime("rlib", "link"))
}

fn build_runtime(extension: &str, emit: &str) -> PathBuf {
    let path = folder().join(format!("liblexibus-{}.{extension}", std::process::id()));
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src/lib.rs");
    let status = Command::new("rustc")
        .args(["--edition", "2021", "--crate-type", "lib", "--emit", emit, "--crate-name", "lexibus", "-o"])
        .arg(&path)
        .arg(&source)
        .args(["--cap-lints", "allow", "-C", "debug-assertions"])
        .status()
        .expect("rustc runs");
    assert!(status.success(), "the runtime does not compile");
    path
}

//! Measures `cargo check` of crates with generated code. The times do not include compiling the dependencies.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use crate::generate::{device_driver, lexibus, svd2rust, REGISTERS};
use crate::measure::{in_turns, Contestant};
use crate::registers::registers;
use crate::report::{Line, Table};

/// A crate with generated code.
struct Crate {
    name: &'static str,
    label: &'static str,
    /// Content of the manifest section `[dependencies]`.
    dependencies: String,
    code: Result<String, String>,
    target: Option<f64>,
}

pub fn compare(folder: &Path) -> Table {
    let made: Vec<_> = crates().into_iter().map(|one| (write(folder, &one), one)).collect();
    let contestant = |(path, one): &(PathBuf, Crate)| {
        let (path, code) = (path.clone(), one.code.clone().map(|_| ()));
        Contestant::with_clock(one.label, move |times| code.clone().and_then(|()| checks(&path, times)))
    };
    let mut contestants: Vec<_> = made.iter().map(contestant).collect();
    let outcomes = in_turns(&mut contestants);
    let line =
        |((_, one), outcome): (&(PathBuf, Crate), _)| Line { name: one.label.to_owned(), outcome, target: one.target };
    let lines = made.iter().zip(outcomes).map(line).collect();
    Table { title: format!("cargo check of {REGISTERS} registers of 6 fields"), bytes: None, lines }
}

fn crates() -> Vec<Crate> {
    let input = registers(REGISTERS);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().expect("the repository");
    let runtime = format!("lexibus = {{ path = {root:?} }}");
    vec![
        Crate {
            name: "with-lexibus",
            label: "Lexibus (at most 1,500 ms)",
            dependencies: runtime.clone(),
            code: lexibus(&input).map(|code| format!("#![no_std]\npub mod device {{\n{code}\n}}\n")),
            target: None,
        },
        Crate {
            name: "empty",
            label: "a crate with nothing in it",
            dependencies: runtime,
            code: Ok("#![no_std]\n".to_owned()),
            target: None,
        },
        Crate {
            name: "with-svd2rust",
            label: "svd2rust 0.37",
            dependencies: "vcell = \"0.1.3\"".to_owned(),
            code: svd2rust(&input),
            // The required ratio is 2.4: a check of this generator's crate takes 3.6 s, and the goal for Lexibus is 1.5
            // s.
            target: Some(2.4),
        },
        Crate {
            name: "with-device-driver",
            label: "device-driver 2.2",
            dependencies: "device-driver = \"=2.2.0\"".to_owned(),
            code: device_driver(&input).map(|code| format!("#![no_std]\n{code}")),
            target: None,
        },
    ]
}

fn write(folder: &Path, one: &Crate) -> PathBuf {
    let path = folder.join(one.name);
    let manifest = format!(
        "[package]\nname = \"{}\"\nversion = \"0.0.0\"\nedition = \"2021\"\n\n[features]\ncritical-section = []\nrt = []\n\n\
         [dependencies]\n{}\n\n[workspace]\n",
        one.name, one.dependencies
    );
    fs::create_dir_all(path.join("src")).expect("a folder");
    fs::write(path.join("Cargo.toml"), manifest).expect("a manifest");
    fs::write(path.join("src/lib.rs"), one.code.as_deref().unwrap_or_default()).expect("a source");
    path
}

/// Returns the total time of `times` runs of `cargo check`, without the time for compiling the dependencies.
fn checks(path: &Path, times: u32) -> Result<Duration, String> {
    (0..times).map(|_| check(path)).sum()
}

fn check(path: &Path) -> Result<Duration, String> {
    let source = fs::File::options().append(true).open(path.join("src/lib.rs")).map_err(|error| error.to_string())?;
    source.set_modified(std::time::SystemTime::now()).map_err(|error| error.to_string())?;
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["check", "--quiet", "--manifest-path"]).arg(path.join("Cargo.toml"));
    cargo
        .env("CARGO_TARGET_DIR", path.join("target"))
        .env("CARGO_INCREMENTAL", "0")
        .env("RUSTFLAGS", "--cap-lints=allow");
    let start = Instant::now();
    let output = cargo.output().map_err(|error| error.to_string())?;
    let elapsed = start.elapsed();
    match output.status.success() {
        true => Ok(elapsed),
        false => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
    }
}

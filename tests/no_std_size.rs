//! Tests that unused code is not part of a binary, and that the default build has no dependencies. Uses the programs in
//! `examples/no_std`.

#[path = "support/lane.rs"]
mod lane;

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use object::{Object, ObjectSection, ObjectSymbol, SectionKind};

/// Size of code and data of the program with generated code, in bytes, with Rust 1.95. `examples/no_std/README.md`
/// contains the same number.
const RECORDED: usize = 451;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Builds the programs. Returns the folder of their binaries, or `None` if the system is not Linux on x86-64.
fn build() -> Option<PathBuf> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        println!("skipped: the programs of examples/no_std are for Linux on x86-64");
        return None;
    }
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("no-std");
    let output = Command::new(env!("CARGO"))
        .args(["build", "--quiet", "--release", "--locked", "--offline"])
        .current_dir(root().join("examples/no_std"))
        .env("CARGO_TARGET_DIR", &target)
        .env_remove("RUSTFLAGS")
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(target.join("release"))
}

/// Sizes and content of a program's loaded sections, and the names of its symbols.
struct Program {
    code: usize,
    data: usize,
    loaded: Vec<u8>,
    symbols: Vec<String>,
}

fn read(binary: &Path) -> Program {
    let bytes = std::fs::read(binary).expect("a binary");
    let file = object::File::parse(&*bytes).expect("an object file");
    let mut program = Program { code: 0, data: 0, loaded: Vec::new(), symbols: Vec::new() };
    for section in file.sections() {
        // Ignore unwinding tables, which a linker script for a microcontroller discards.
        if section.name().is_ok_and(|name| name.starts_with(".eh_frame")) {
            continue;
        }
        let content = section.data().expect("a section");
        match section.kind() {
            SectionKind::Text => program.code += content.len(),
            SectionKind::Data | SectionKind::ReadOnlyData | SectionKind::ReadOnlyString => {
                program.data += content.len()
            }
            SectionKind::UninitializedData => program.data += section.size() as usize,
            _ => continue,
        }
        program.loaded.extend_from_slice(content);
    }
    let names = file.symbols().filter_map(|symbol| Some(symbol.name().ok()?.to_owned()));
    program.symbols = names.filter(|name| !name.is_empty()).collect();
    program
}

/// Returns the string literals of at least five bytes in the bindings, such as names of registers, units, and texts of codes.
fn texts(bindings: &str) -> BTreeSet<&str> {
    let code = bindings.lines().filter(|line| !line.trim_start().starts_with("//"));
    code.flat_map(|line| line.split('"').skip(1).step_by(2)).filter(|text| text.len() >= 5).collect()
}

/// Runs a program with the replies of a drive. Returns its exit code and output.
fn run(binary: &Path, replies: &[u8]) -> (Option<i32>, Vec<u8>) {
    let mut child =
        Command::new(binary).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("the program starts");
    child.stdin.take().expect("its input").write_all(replies).expect("room for the replies");
    let output = child.wait_with_output().expect("the program ends");
    (output.status.code(), output.stdout)
}

#[test]
fn what_is_not_used_leaves_nothing() {
    if lane::skips("an optimized build without an operating system") {
        return;
    }
    let Some(folder) = build() else { return };
    let (generated, by_hand) = (read(&folder.join("generated")), read(&folder.join("by_hand")));
    println!("           code  data");
    println!("generated {:5} {:5}", generated.code, generated.data);
    println!("by hand   {:5} {:5}", by_hand.code, by_hand.data);

    let bindings = std::fs::read_to_string(root().join("generated/src/vector_step.rs")).expect("the bindings");
    let texts = texts(&bindings);
    assert!(texts.len() > 585 && texts.contains("Target position"), "{}", texts.len());
    for text in texts {
        let found = generated.loaded.windows(text.len()).any(|window| window == text.as_bytes());
        assert!(!found, "`{text}` is in the binary");
    }
    // A table of the 585 registers would need thousands of bytes. The size may grow by 5 %.
    let size = generated.code + generated.data;
    assert!(size * 100 <= RECORDED * 105, "{size} bytes instead of {RECORDED}");
    assert!(generated.data <= by_hand.data, "{} bytes of data", generated.data);
    for name in &generated.symbols {
        assert!(!name.contains("5alloc"), "{name} belongs to the allocator");
        assert!(!name.contains("core3fmt"), "{name} formats texts");
    }
    let functions = generated.symbols.iter().filter(|name| name.contains("lexibus_drives"));
    assert!(functions.clone().count() <= 3, "{:?}", functions.collect::<Vec<_>>());
}

#[test]
fn both_programs_send_the_same_frames() {
    if lane::skips("an optimized build without an operating system") {
        return;
    }
    let Some(folder) = build() else { return };
    let done = [0x60, 0, 0, 0, 0, 0, 0, 0];
    let statusword = [0x4B, 0x41, 0x60, 0, 0x37, 0x02, 0, 0];
    let replies = [done, done, statusword].concat();
    let frames = [
        [0x2F, 0x60, 0x60, 0, 1, 0, 0, 0],
        [0x23, 0x7A, 0x60, 0, 0xA0, 0x86, 0x01, 0],
        [0x40, 0x41, 0x60, 0, 0, 0, 0, 0],
    ]
    .concat();
    for name in ["generated", "by_hand"] {
        assert_eq!(run(&folder.join(name), &replies), (Some(0), frames.clone()), "{name}");
        // After an SDO abort, the program must end with exit code 2 and send no further request.
        let refused = [0x80, 0x60, 0x60, 0, 0, 0, 2, 6];
        assert_eq!(run(&folder.join(name), &refused), (Some(2), frames[..8].to_vec()), "{name}");
    }
}

#[test]
fn the_default_build_has_no_dependency() {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--package", "lexibus", "--edges", "normal,build", "--target", "all", "--prefix", "none"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    let tree = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(tree.lines().count(), 1, "{tree}");
    assert!(tree.starts_with("lexibus v"), "{tree}");
}

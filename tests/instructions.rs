//! Tests that generated code executes no more instructions than handwritten code when it packs, unpacks and accesses
//! values. [`TOLERATED`] lists the exceptions.
//!
//! `valgrind --tool=callgrind` counts the instructions of the function pairs in `benches/instructions`, in a release
//! build. The counts are exact and reproducible. `LEXIBUS_LANE=full cargo test --test instructions -- --nocapture`
//! prints the counts. The command also prints the code size of each function if `nm` reports the size.

#[path = "support/lane.rs"]
mod lane;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Pairs of functions whose counts may differ: value, operation, and allowed number of additional instructions per call.
const TOLERATED: [(&str, &str, f64); 4] = [
    // The generated code stores bytes 4 and 5 of the first PDO with two instructions. LLVM shifts both bytes out of a
    // larger loaded word instead of loading the field.
    ("several_pdos", "pack", 1.0),
    // The buffer for values has 8 bytes for all types. Values and errors are returned in the same location, which costs
    // a jump instruction. In addition, a CPU register for the error is saved and restored.
    ("objects", "read", 4.0),
    // The error of an item names the item, so generated code checks the result of the client. Handwritten code passes
    // the result to the caller.
    ("objects", "write", 5.0),
    // The reason for "write" also applies. In addition, the value is converted to an enumeration that names most of its values.
    ("objects", "write_mode", 9.0),
];

/// For each function: the number of calls, and the instructions of all calls. The instructions of called functions are
/// included.
type Costs = HashMap<String, (u64, u64)>;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Builds the binary that calls all function pairs.
fn build() -> PathBuf {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("instructions");
    let output = Command::new(env!("CARGO"))
        .args(["build", "--quiet", "--release", "-p", "lexibus-instructions"])
        .current_dir(root())
        .env("CARGO_TARGET_DIR", &target)
        // Turn off incremental compilation, because it splits the crate into more codegen units, and functions are not inlined
        // across codegen units.
        .env("CARGO_INCREMENTAL", "0")
        .env_remove("RUSTFLAGS")
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    target.join("release/lexibus-instructions")
}

/// Runs the binary under `valgrind`. Returns the names of the pairs (`case action`) and the costs of all functions.
fn count(binary: &Path) -> (Vec<(String, String)>, Costs) {
    let profile = Path::new(env!("CARGO_TARGET_TMPDIR")).join("callgrind.out");
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--compress-strings=no", "--compress-pos=no", "--demangle=no"])
        .arg(format!("--callgrind-out-file={}", profile.display()))
        .arg(binary)
        .output()
        .expect("valgrind runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let names = String::from_utf8(output.stdout).expect("names");
    let pairs = names.lines().filter_map(|line| line.split_once(' ')).map(|(a, b)| (a.into(), b.into())).collect();
    (pairs, costs(&std::fs::read_to_string(profile).expect("a profile")))
}

/// Parses the function calls in a profile. `cfn=` names the called function, and `calls=` is the number of calls from
/// one position. The next line ends with their cost.
fn costs(profile: &str) -> Costs {
    let mut costs = Costs::new();
    let (mut function, mut lines) = ("", profile.lines());
    while let Some(line) = lines.next() {
        if let Some(name) = line.strip_prefix("cfn=") {
            function = name;
        } else if let Some(calls) = line.strip_prefix("calls=") {
            let number = |text: Option<&str>| text.and_then(|text| text.parse::<u64>().ok()).expect("a number");
            let (calls, _) = calls.split_once(' ').expect("a count and a position");
            let cost = costs.entry(function.to_owned()).or_default();
            cost.0 += number(Some(calls));
            cost.1 += number(lines.next().and_then(|line| line.split_once(' ')).map(|(_, cost)| cost));
        }
    }
    costs
}

/// Returns the number of instructions per call of a function. Mangled names contain the names of the modules, each
/// preceded by its length.
fn cost(costs: &Costs, case: &str, action: &str, side: &str) -> f64 {
    let path: String = [case, action, side].iter().map(|name| format!("{}{name}", name.len())).collect();
    let found: Vec<_> = costs.iter().filter(|(name, _)| name.contains(&path)).collect();
    let [(_, (calls, instructions))] = found[..] else { panic!("{path} should be one function: {found:?}") };
    assert_eq!(*calls, 100, "{path} has been merged with another function, or inlined");
    *instructions as f64 / *calls as f64
}

/// Returns the code sizes of all functions in bytes, by mangled name.
fn sizes(binary: &Path) -> HashMap<String, u64> {
    let Ok(output) = Command::new("nm").arg("--print-size").arg(binary).output() else { return HashMap::new() };
    let row = |line: &str| {
        let [_, size, _, name] = line.split(' ').collect::<Vec<_>>()[..] else { return None };
        Some((name.to_owned(), u64::from_str_radix(size, 16).ok()?))
    };
    String::from_utf8_lossy(&output.stdout).lines().filter_map(row).collect()
}

/// Returns the code size in bytes of one function in a pair.
fn size(sizes: &HashMap<String, u64>, case: &str, action: &str, side: &str) -> u64 {
    let path: String = [case, action, side].iter().map(|name| format!("{}{name}", name.len())).collect();
    sizes.iter().filter(|(name, _)| name.contains(&path)).map(|(_, size)| size).sum()
}

#[test]
fn generated_code_costs_what_a_person_would_write() {
    if lane::skips("counting instructions of an optimized build") {
        return;
    }
    if !cfg!(target_arch = "x86_64") || Command::new("valgrind").arg("--version").output().is_err() {
        println!("skipped: instructions are counted on x86-64 with `valgrind`, which isn't here");
        return;
    }
    let binary = build();
    let (pairs, costs) = count(&binary);
    let sizes = sizes(&binary);
    assert!(pairs.len() >= 40, "{}", pairs.len());
    let mut worse = Vec::new();
    for (case, action) in &pairs {
        let (ours, hand) = (cost(&costs, case, action, "ours"), cost(&costs, case, action, "hand"));
        let [own_size, hand_size] = ["ours", "hand"].map(|side| size(&sizes, case, action, side));
        println!(
            "{case:22} {action:10} {ours:7.2} by hand {hand:7.2}, {own_size:4} bytes of code, by hand {hand_size:4}"
        );
        let tolerated = TOLERATED.iter().find(|one| (one.0, one.1) == (case, action)).map_or(0.0, |one| one.2);
        if ours > hand + tolerated {
            worse.push(format!("{case} {action}: {ours} instead of {hand}"));
        }
    }
    assert!(worse.is_empty(), "instructions per call: {worse:#?}");
}

#[test]
fn reads_a_profile() {
    let profile = "fn=main\n10 3\ncfn=a\ncalls=2 40\n12 20\ncfn=b\ncalls=1 50\n13 5\ncfn=a\ncalls=1 40\n14 10\n";
    let costs = costs(profile);
    assert_eq!((costs["a"], costs["b"]), ((3, 30), (1, 5)));
}

//! Compares the output of Lexibus with that of Lely's `dcfgen`, for random networks of corpus devices and for `bus.yml` files of the corpus.
//!
//! Concise DCFs are compared byte for byte, and DCFs of the master value by value. The tests fail if a difference has no known reason.
//! If the corpus or a Python with `dcf-tools` is missing, the tests print a message and pass. The tests fail if the Python that
//! `LEXIBUS_PYTHON` names lacks `dcf-tools`.

#[path = "../../../codegen/tests/corpus_support/mod.rs"]
mod corpus_support;
mod networks;
mod random;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use corpus_support::{files_of, folder_of, lane, python};
use lexibus_codegen::diagnostics::{Level, Levels};
use lexibus_codegen::ir::Direction;
use lexibus_codegen::source::Source;
use lexibus_network::compile::{compile, Compilation};
use lexibus_network::model::{Network, NetworkNode, NetworkPdo, NO_RTR};
use lexibus_network::output::files;
use lexibus_network::values::Values;
use networks::{network, Model};
use random::Random;
use serde::Deserialize;

/// Result of `compare.py` for one network.
#[derive(Debug, Deserialize)]
struct Verdict {
    error: String,
    differences: Vec<String>,
}

/// Runs the Python script at a path relative to the crate. Returns the values in its output, one for each argument.
fn run<T: for<'d> Deserialize<'d>>(python: &Path, script: &str, arguments: &[PathBuf]) -> Vec<T> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join(script);
    let output = Command::new(python).args(["-W", "ignore"]).arg(script).args(arguments).output().expect("Python runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let values: Vec<T> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(values.len(), arguments.len());
    values
}

/// Result of `check.py` for an EDS: whether dcf-tools accepts the file.
#[derive(Debug, Deserialize)]
struct Accepted {
    strict: bool,
}

/// Returns the devices of the corpus that both dcf-tools and Lexibus accept, or `None` if there is no corpus.
fn models(python: &Path) -> Option<Vec<Model>> {
    let folder = folder_of("eds")?;
    let files: Vec<_> =
        files_of("eds")?.into_iter().filter(|file| file.name.to_lowercase().ends_with(".eds")).collect();
    let paths: Vec<PathBuf> = files.iter().map(|file| folder.join(&file.name)).collect();
    let accepted: Vec<Accepted> = run(python, "../codegen/export/tests/corpus_exports/check.py", &paths);
    let pairs = files.into_iter().zip(accepted).filter(|(_, accepted)| accepted.strict);
    Some(pairs.filter_map(|(file, _)| Model::new(file.name, file.bytes)).collect())
}

/// Compiles `bus.yml` in a folder.
fn compiled(folder: &Path) -> Compilation {
    // `dcfgen` does not check these rules, or only warns about violations.
    let mut levels = Levels::lenient();
    for code in ["NET013", "NET014", "NET016", "NET017", "NET019", "NET020", "NET021", "NET022", "NET023"] {
        levels.set(code, Level::Allow).expect("a code");
    }
    compile(Source::read(&folder.join("bus.yml")).expect("a file"), levels)
}

/// Compiles the network in a folder, and writes its output files. If the network has errors, returns all diagnostics instead.
fn build(folder: &Path) -> Vec<String> {
    let compilation = compiled(folder);
    let out = folder.join("lexibus");
    std::fs::create_dir_all(&out).expect("a folder");
    if let Some(network) = compilation.usable() {
        for file in files(network).into_iter().filter(|file| !file.name.ends_with(".rs")) {
            std::fs::write(out.join(file.name), file.content).expect("a file");
        }
        return Vec::new();
    }
    compilation.diagnostics.list().iter().map(|found| format!("{} {}", found.code.id, found.message)).collect()
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    folder
}

/// Returns the known reason for a difference, or `None` if there is none.
fn reason(difference: &str, network: &Network) -> Option<&'static str> {
    if let Some(pdo) = difference.strip_prefix("dcfgen only: ") {
        return reason_of_pdo(pdo, network);
    }
    if difference.starts_with("master.dcf 0x1028:") && difference.ends_with("dcfgen (7, 'rw', 0)") {
        return Some(
            "0x1014 has no default value: dcfgen expects EMCY with CAN-ID 0, Lexibus with the default of CiA 301",
        );
    }
    if let Some((object, values)) = difference.split_once(": lexibus ") {
        let number = |text: &str| text.rsplit_once(", ")?.1.trim_end_matches(')').parse::<u32>().ok();
        let (ours, theirs) = values.split_once(", dcfgen ")?;
        let is_flag = number(ours)? == number(theirs)? | NO_RTR;
        return (object.contains("TPDO") && object.ends_with("communication:1") && is_flag).then_some(RTR);
    }
    let (name, entries) = difference.split_once(".bin: ")?;
    let node = network.nodes.iter().find(|node| node.name.value == name)?;
    let entries: Vec<Entry> = entries.split("; ").map(Entry::read).collect::<Option<_>>()?;
    let reasons: Vec<&str> = entries.iter().map(|entry| entry.reason(&entries, node)).collect::<Option<_>>()?;
    reasons.into_iter().max()
}

const RTR: &str = "dcfgen removes bit 30 of the description from an automatic COB-ID, Lexibus keeps it";

const ZERO: &str = "the object has no default value: dcfgen assumes that it is 0, Lexibus writes 0";

/// An entry of a concise DCF that only one program writes: `only lexibus 0x1017:0 = 0000`.
#[derive(Debug, PartialEq)]
struct Entry {
    is_ours: bool,
    object: (u16, u8),
    value: u64,
}

impl Entry {
    fn read(text: &str) -> Option<Self> {
        let (who, rest) = text.strip_prefix("only ")?.split_once(' ')?;
        let (object, value) = rest.split_once(" = ")?;
        let (index, sub_index) = object.split_once(':')?;
        let index = u16::from_str_radix(index.trim_start_matches("0x"), 16).ok()?;
        let value = u64::from_str_radix(value, 16).ok()?.swap_bytes() >> (64 - 4 * value.len());
        Some(Entry { is_ours: who == "lexibus", object: (index, sub_index.parse().ok()?), value })
    }

    /// Returns the reason why only one program writes the entry, or `None` if the reason is unknown.
    fn reason(&self, entries: &[Entry], node: &NetworkNode) -> Option<&'static str> {
        let other = Entry { is_ours: !self.is_ours, value: self.value ^ u64::from(NO_RTR), ..*self };
        // Lexibus does not write a value that the description states.
        let is_described = || !self.is_ours && initial(node, self.object) == Some(other.value.into());
        let is_automatic = matches!(self.object, (0x1800..=0x19FF, 1));
        let is_flag = (self.value & u64::from(NO_RTR) != 0) == self.is_ours;
        if is_automatic && is_flag && (entries.contains(&other) || is_described()) {
            return Some(RTR);
        }
        let is_zero = self.is_ours && self.value == 0;
        (is_zero && node.item(self.object).is_some_and(|item| item.initial().is_none())).then_some(ZERO)
    }
}

/// Returns the value that an object has in the description of a node.
fn initial(node: &NetworkNode, object: (u16, u8)) -> Option<i128> {
    Values { writes: &[], ..node.values() }.get(object)
}

/// Returns the reason why only the master of `dcfgen` exchanges a PDO, such as `RPDO 3 of node 92`.
fn reason_of_pdo(pdo: &str, network: &Network) -> Option<&'static str> {
    let (title, id) = pdo.split_once(" of node ")?;
    let node = network.nodes.iter().find(|node| node.id.to_string() == id)?;
    let pdo = node.pdos.iter().find(|pdo| pdo.title() == title)?;
    if !pdo.is_enabled {
        return Some("the PDO is disabled, but dcfgen lets the master exchange it");
    }
    if pdo.direction == Direction::Transmit {
        return None;
    }
    if !network.is_sent_by_master(pdo.can_id()) {
        return Some("a node sends the RPDO of another node, but dcfgen lets the master send it, too");
    }
    let is_same =
        |(_, other): &(&NetworkNode, &NetworkPdo)| other.can_id() == pdo.can_id() && other.bytes() == pdo.bytes();
    (network.pdos(Direction::Receive).filter(is_same).count() > 1)
        .then_some("two RPDOs have one COB-ID and one length, but dcfgen lets the master send two PDOs")
}

/// Asserts that each difference has a reason, and prints the number of differences for each reason.
fn judge(names: &[String], folders: &[PathBuf], verdicts: &[Verdict]) {
    let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
    let mut unexplained = Vec::new();
    for ((name, folder), verdict) in names.iter().zip(folders).zip(verdicts) {
        if verdict.differences.is_empty() {
            continue;
        }
        let network = compiled(folder).network.expect("a network");
        for difference in &verdict.differences {
            match reason(difference, &network) {
                Some(reason) => *reasons.entry(reason).or_default() += 1,
                None => unexplained.push(format!("{name}: {difference}")),
            }
        }
    }
    for (reason, count) in reasons {
        eprintln!("{count} differences: {reason}");
    }
    assert!(unexplained.is_empty(), "{} differences without a reason:\n{}", unexplained.len(), unexplained.join("\n"));
}

#[test]
fn random_networks_of_the_corpus_are_equal() {
    let Some(python) = python::with(&["dcfgen.cli"]) else { return };
    let Some(models) = models(&python) else { return };
    assert!(models.len() >= lane::at_least(70), "dcfgen accepts only {} files", models.len());
    let root = folder("dcfgen-random");
    let corpus = folder_of("eds").expect("the corpus");
    let mut random = Random(30);
    let (mut names, mut folders, mut rejected) = (Vec::new(), Vec::new(), Vec::new());
    for number in 0..if lane::is_full() { 220 } else { 6 } {
        let folder = root.join(number.to_string());
        std::fs::create_dir(&folder).expect("a folder");
        let (text, used) = network(&models, &mut random);
        std::fs::write(folder.join("bus.yml"), text).expect("a file");
        for model in used {
            std::fs::copy(corpus.join(&model.file), folder.join(&model.file)).expect("a file of the corpus");
        }
        let errors = build(&folder);
        if errors.is_empty() {
            names.push(number.to_string());
            folders.push(folder);
        } else {
            rejected.push(format!("{number}: {}", errors.join("; ")));
        }
    }
    let verdicts: Vec<Verdict> = run(&python, "tests/dcfgen/compare.py", &folders);
    let accepted = verdicts.iter().filter(|verdict| verdict.error.is_empty()).count();
    eprintln!("{} models; {} networks, {accepted} accepted by dcfgen", models.len(), folders.len() + rejected.len());
    for (name, verdict) in names.iter().zip(&verdicts).filter(|(_, verdict)| !verdict.error.is_empty()) {
        eprintln!("dcfgen rejects {name}: {}", verdict.error);
    }
    judge(&names, &folders, &verdicts);
    assert!(rejected.is_empty(), "Lexibus rejects {} networks:\n{}", rejected.len(), rejected.join("\n"));
    assert!(accepted >= if lane::is_full() { 200 } else { 5 }, "dcfgen accepts only {accepted} networks");
}

#[test]
fn bus_yml_files_of_the_corpus_are_equal() {
    let (Some(python), Some(corpus)) = (python::with(&["dcfgen.cli"]), folder_of("network")) else { return };
    let root = folder("dcfgen-files");
    let (mut names, mut folders) = (Vec::new(), Vec::new());
    for name in ["canopen_system", "cia402", "cia402_lifecycle", "robot_control", "simple"] {
        let folder = root.join(name);
        std::fs::create_dir(&folder).expect("a folder");
        for entry in std::fs::read_dir(corpus.join("ros2_canopen").join(name)).expect("a folder of the corpus") {
            let path = entry.expect("a file").path();
            std::fs::copy(&path, folder.join(path.file_name().expect("a name"))).expect("a file of the corpus");
        }
        // Replace the placeholder `@BUS_CONFIG_PATH@` with a path, as the build of ros2_canopen does before it runs
        // `dcfgen`. That build also resolves the sections `defaults` and `nodes`.
        let text = std::fs::read_to_string(folder.join("bus.yml")).expect("a file");
        std::fs::write(folder.join("bus.yml"), text.replace("@BUS_CONFIG_PATH@", ".")).expect("a file");
        assert_eq!(build(&folder), Vec::<String>::new(), "{name}");
        names.push(name.to_owned());
        folders.push(folder);
    }
    let verdicts: Vec<Verdict> = run(&python, "tests/dcfgen/compare.py", &folders);
    let rejected: Vec<&String> =
        names.iter().zip(&verdicts).filter(|(_, v)| !v.error.is_empty()).map(|(n, _)| n).collect();
    assert_eq!(rejected, ["cia402"], "dcfgen does not know the sections `defaults` and `nodes`");
    judge(&names, &folders, &verdicts);
}

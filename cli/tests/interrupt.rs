//! Tests Ctrl-C while `docs`, `generate`, `export` and `new` write files: each file must be complete or absent, and no
//! temporary file may remain.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// Number of input files. With this number, the commands run long enough to be interrupted between two files.
const INPUTS: usize = 60;

/// Commands that write to a folder, without the arguments for inputs and output.
const COMMANDS: [&[&str]; 3] = [&["docs"], &["generate"], &["export", "--format", "eds"]];

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("interrupt").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    folder
}

fn start(command: &[&str], inputs: &Path, out: &Path) -> Child {
    Command::new(env!("CARGO_BIN_EXE_lexibus"))
        .args(command)
        .args(["-A", "warnings"])
        .arg(inputs)
        .arg("--out")
        .arg(out)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("lexibus starts")
}

/// Returns the content of all files in a folder and its subfolders.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if let Ok(content) = std::fs::read(&path) {
                found.insert(path.strip_prefix(folder).expect("a path in the folder").to_owned(), content);
            }
        }
    }
    found
}

#[test]
fn an_interruption_leaves_complete_files_only() {
    let inputs = folder("inputs");
    let description = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries/demo-drive.eds");
    for number in 0..INPUTS {
        std::fs::copy(&description, inputs.join(format!("drive-{number:02}.eds"))).expect("a copy");
    }
    for command in COMMANDS {
        let whole = folder("whole");
        assert!(start(command, &inputs, &whole).wait().expect("lexibus ends").success());
        let expected = files(&whole);
        let mut interrupted = 0;
        // Wait for more files in each round, so that the signals arrive at different moments.
        for round in 1..=4 {
            let out = folder("interrupted");
            let mut child = start(command, &inputs, &out);
            while files(&out).len() < round && child.try_wait().expect("a status").is_none() {
                std::thread::sleep(Duration::from_micros(200));
            }
            let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
            assert!(sent.is_ok(), "`kill` runs");
            let status = child.wait().expect("lexibus ends");
            let found = files(&out);
            for (path, content) in &found {
                assert!(expected.get(path) == Some(content), "{command:?}: {} is incomplete", path.display());
            }
            // The command may have ended before the signal.
            assert!(status.success() || status.code() == Some(130), "{command:?}: {status}");
            interrupted += usize::from(status.code() == Some(130) && found.len() < expected.len());
        }
        assert!(interrupted > 0, "{command:?}: no signal arrived while the command wrote files");
    }
}

#[test]
fn an_interruption_leaves_no_part_of_a_crate() {
    let description = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries/demo-drive.eds");
    let start = |out: &Path| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lexibus"));
        command.args(["new", "--crate", "drive", "--from"]).arg(&description).arg("--out").arg(out.join("drive"));
        command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("lexibus starts")
    };
    let whole = folder("whole-crate");
    let begin = std::time::Instant::now();
    assert!(start(&whole).wait().expect("lexibus ends").success());
    let time = begin.elapsed();
    let expected = files(&whole);
    // Send the signals at different moments, distributed over the whole run.
    const ROUNDS: u32 = 24;
    for round in 0..ROUNDS {
        let out = folder("interrupted-crate");
        let mut child = start(&out);
        std::thread::sleep(time * round / ROUNDS);
        let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).stderr(Stdio::null()).status();
        assert!(sent.is_ok(), "`kill` runs");
        child.wait().expect("lexibus ends");
        let found = files(&out);
        assert!(found.is_empty() || found == expected, "{:?}", found.keys());
        let entries = std::fs::read_dir(&out).expect("a folder").count();
        assert_eq!(entries, usize::from(!found.is_empty()), "an empty folder remains");
    }
}

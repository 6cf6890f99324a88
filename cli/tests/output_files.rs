//! Tests how output files are written. Regular files must be complete or unchanged. Pipes and devices must be valid
//! outputs. Folders with files of other programs must not change.
#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

const DEMO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../dictionaries/demo-drive.eds");

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("output-files").join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a folder for temporary files");
    path
}

/// Runs a shell command. `$LEXIBUS` is the path of the program. The command is stopped after a minute, because it might
/// otherwise wait for a pipe forever.
fn shell(folder: &Path, script: &str) -> Output {
    let mut child = Command::new("sh")
        .args(["-c", script])
        .current_dir(folder)
        .env("LEXIBUS", env!("CARGO_BIN_EXE_lexibus"))
        .env("DEMO", DEMO)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the shell runs");
    let (started, mut stdout) = (Instant::now(), child.stdout.take().expect("a pipe"));
    let reader = std::thread::spawn(move || {
        let mut text = Vec::new();
        let _ = std::io::Read::read_to_end(&mut stdout, &mut text);
        text
    });
    while child.try_wait().expect("the state of the shell").is_none() {
        if started.elapsed() > Duration::from_secs(60) {
            child.kill().expect("the shell ends");
            panic!("`{script}` does not end");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    let output = child.wait_with_output().expect("the shell ends");
    Output { stdout: reader.join().expect("its output"), ..output }
}

fn error(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn a_pipe_and_a_device_are_written_to() {
    let folder = folder("pipe");
    let plain = shell(&folder, "$LEXIBUS generate $DEMO");
    assert!(plain.status.success() && !plain.stdout.is_empty());
    let piped = shell(&folder, "$LEXIBUS generate $DEMO --out /dev/stdout | cat");
    assert!(piped.stdout == plain.stdout, "{}", error(&piped));
    let named = shell(&folder, "mkfifo p; cat p & $LEXIBUS generate $DEMO --out p; wait");
    assert!(named.stdout == plain.stdout, "{}", error(&named));
    if Path::new("/dev/full").exists() {
        for command in ["generate", "export --format eds", "diff $DEMO"] {
            let full = shell(&folder, &format!("$LEXIBUS {command} $DEMO --out /dev/full"));
            assert!(!full.status.success() && error(&full).contains("cannot write /dev/full"), "{}", error(&full));
        }
        let checked = shell(&folder, "$LEXIBUS generate $DEMO --out /dev/full --check");
        assert!(
            error(&checked).contains("/dev/full cannot be compared: it is not a regular file"),
            "{}",
            error(&checked)
        );
    }
}

#[test]
fn a_pipe_is_no_input() {
    let folder = folder("input");
    let checked = shell(&folder, "mkfifo p.eds; $LEXIBUS check p.eds");
    assert_eq!(checked.status.code(), Some(1));
    assert!(error(&checked).contains("cannot read the file: it is not a regular file"), "{}", error(&checked));
    // A search of a folder must skip the pipe, because a search reads only regular files.
    let searched = shell(&folder, "cp $DEMO .; $LEXIBUS check .");
    assert!(error(&searched).contains("1 file"), "{}", error(&searched));
}

#[test]
fn a_full_disk_leaves_the_old_file() {
    let folder = folder("full");
    // The old file begins like the new one, so this part of it is copied first.
    let generated = shell(&folder, "exec $LEXIBUS generate $DEMO");
    let old = String::from_utf8_lossy(&generated.stdout[..generated.stdout.len() / 2]).into_owned();
    std::fs::write(folder.join("drive.rs"), &old).expect("a file");
    // Limit the file size to one block, and ignore the signal for exceeding the limit.
    let output = shell(&folder, "trap '' XFSZ; ulimit -f 1; exec $LEXIBUS generate $DEMO --out drive.rs");
    assert_eq!(output.status.code(), Some(1), "{}", error(&output));
    assert!(error(&output).contains("cannot write drive.rs"), "{}", error(&output));
    assert_eq!(std::fs::read_to_string(folder.join("drive.rs")).expect("the file"), old);
    assert_eq!(std::fs::read_dir(&folder).expect("the folder").count(), 1, "no temporary file remains");
}

/// A command that cannot write its output has the exit code 1, and prints no hint about the arguments.
#[test]
fn output_that_cannot_be_written_is_no_wrong_argument() {
    let folder = folder("unwritable");
    std::fs::write(folder.join("taken"), "a file, and no folder").expect("a file");
    std::fs::write(folder.join("list.csv"), "Name,Address,Type,Access\na,1,u16,ro\n").expect("a file");
    std::fs::copy(DEMO, folder.join("demo.eds")).expect("a description");
    for command in [
        "generate $DEMO --out taken/x.rs",
        "generate $DEMO demo.eds --out taken/x/",
        "export --format eds $DEMO --out taken/x.eds",
        "docs $DEMO --out taken/x",
        "docs $DEMO --out taken",
        "diff $DEMO $DEMO --out taken/x",
        "check $DEMO --baseline taken/x --write-baseline",
        "new x --out taken/x.toml",
        "new --crate x --from $DEMO --out taken/x",
        "import list.csv --out taken/x.toml",
    ] {
        let output = shell(&folder, &format!("$LEXIBUS {command}"));
        let text = error(&output);
        assert_eq!(output.status.code(), Some(1), "{command}: {text}");
        assert!(text.contains("cannot") && text.contains("taken") && !text.contains("--help"), "{command}: {text}");
    }
}

#[test]
fn pages_are_not_written_to_a_foreign_folder() {
    let folder = folder("docs");
    std::fs::write(folder.join("notes.txt"), "mine").expect("a file");
    for format in ["html", "markdown"] {
        let output = shell(&folder, &format!("$LEXIBUS docs $DEMO --format {format} --out ."));
        assert_eq!(output.status.code(), Some(1));
        let message =
            "has files that `lexibus docs` did not write, such as notes.txt: choose an empty folder with --out";
        assert!(error(&output).contains(message), "{}", error(&output));
        assert_eq!(std::fs::read_dir(&folder).expect("the folder").count(), 1);
    }
    // The output folder may contain hidden files. A second call must replace the pages of the first call.
    let script = "mkdir site; touch site/.gitkeep; $LEXIBUS docs $DEMO --out site && $LEXIBUS docs $DEMO --out site";
    let output = shell(&folder, script);
    assert!(output.status.success(), "{}", error(&output));
}

/// Pages of networks can have the same file name if the names of the networks differ only in case or punctuation.
#[test]
fn the_page_of_a_network_does_not_replace_another() {
    let folder = folder("networks");
    let network = |name: &str| format!("[network]\nname = \"{name}\"\n[master]\nid = 1\n[nodes]\n");
    std::fs::write(folder.join("a.toml"), network("Line 1")).expect("a file");
    std::fs::write(folder.join("b.toml"), network("line-1")).expect("a file");
    let output = shell(&folder, "$LEXIBUS docs a.toml b.toml --out site");
    assert_eq!(output.status.code(), Some(1));
    let expected = "b.toml: the network `line-1` would have the same page as the network `Line 1`; change `name`";
    assert!(error(&output).contains(expected), "{}", error(&output));
}

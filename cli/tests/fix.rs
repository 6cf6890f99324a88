//! Tests `lexibus fix` on files of the corpus: afterward, no fix is left, and only the bytes that the fixes replace
//! have changed.

// Include the whole support module, because reading the sample of corpus files needs its other parts.
#[path = "../../codegen/tests/corpus_support/mod.rs"]
mod corpus_support;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use corpus_support::lane;
use serde_json::Value;

/// A folder for temporary files, outside of the repository, because the files of the corpus must not be copied into it.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lexibus-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).expect("a folder for temporary files");
        Folder(path)
    }

    fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, bytes).expect("a temporary file");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn lexibus(arguments: &[&str], path: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lexibus")).args(arguments).arg(path).output().expect("lexibus runs")
}

/// Returns the diagnostics of all files in a folder.
fn diagnostics(folder: &Path) -> Vec<Value> {
    let output = lexibus(&["check", "--message-format", "json"], folder);
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    text.lines().map(|line| serde_json::from_str(line).expect("a JSON line")).collect()
}

/// Returns the number of diagnostics by file and code.
fn counts(diagnostics: &[Value]) -> BTreeMap<(String, String), usize> {
    let mut counts = BTreeMap::new();
    for line in diagnostics {
        let text = |key: &str| line[key].as_str().unwrap_or_default().to_owned();
        *counts.entry((text("file"), text("code"))).or_default() += 1;
    }
    counts
}

fn count_of(bytes: &[u8], wanted: u8) -> usize {
    bytes.iter().filter(|&&byte| byte == wanted).count()
}

#[test]
fn no_fix_is_left_in_the_sample() {
    let mut files = Vec::new();
    for format in ["eds", "esi", "gsdml"] {
        let Some(of_format) = corpus_support::files_of(format) else { return };
        files.extend(of_format);
    }
    let folder = Folder::new("fix-corpus");
    for file in &files {
        folder.file(&file.name, &file.bytes);
    }
    let before = diagnostics(&folder.0);
    let has_fix = |line: &&Value| line["fix"].is_string();
    let wanted = before.iter().filter(has_fix).count();
    assert!(wanted >= lane::at_least(1000), "only {wanted} fixes in {} files", files.len());

    let dry = lexibus(&["fix", "--dry-run"], &folder.0);
    assert!(String::from_utf8_lossy(&dry.stdout).contains("\n@@ "), "{}", String::from_utf8_lossy(&dry.stderr));
    for file in &files {
        assert!(std::fs::read(folder.0.join(&file.name)).expect("a file") == file.bytes, "{} was written", file.name);
    }

    let fixed = lexibus(&["fix"], &folder.0);
    let after = diagnostics(&folder.0);
    let left: Vec<&Value> = after.iter().filter(has_fix).collect();
    assert!(left.is_empty(), "{left:#?}\n{}", String::from_utf8_lossy(&fixed.stderr));
    let (old, new) = (counts(&before), counts(&after));
    let added: Vec<_> = new.iter().filter(|(key, count)| old.get(*key).is_none_or(|old| old < *count)).collect();
    assert!(added.is_empty(), "{added:#?}");
    for file in &files {
        compare(&folder, &file.name, &file.bytes);
    }
}

/// Checks that the backup of a fixed file has the original bytes. Checks that the fixes have not changed the byte order
/// mark, the numbers of CR and LF, or bytes that are not ASCII. An unchanged file must have no backup.
fn compare(folder: &Folder, name: &str, old: &[u8]) {
    let new = std::fs::read(folder.0.join(name)).expect("a file");
    let backup = std::fs::read(folder.0.join(format!("{name}.bak")));
    if new == old {
        assert!(backup.is_err(), "{name} has a backup, but no fix");
        return;
    }
    assert!(backup.expect("a backup") == old, "{name}: the backup differs");
    for end in [b'\r', b'\n'] {
        assert_eq!(count_of(&new, end), count_of(old, end), "{name}: line ends");
    }
    let is_mark = |bytes: &[u8]| bytes.starts_with(b"\xef\xbb\xbf");
    assert_eq!(is_mark(&new), is_mark(old), "{name}: byte order mark");
    // Fixes contain only ASCII, so the bytes that are not ASCII must stay the same.
    let others = |bytes: &[u8]| bytes.iter().copied().filter(|byte| !byte.is_ascii()).collect::<Vec<u8>>();
    let is_ascii = others(&new) == others(old);
    assert!(is_ascii, "{name}: bytes that are not ASCII");
}

const QUIRKY: &str =
    "[DeviceInfo]\r\nProductName=Ger\u{e4}t\r\n[ManufacturerObjects]\r\nSupportedObjects=1\r\n1=0x2000\r\n\
                      [2000]\r\nParameterName=Gain\r\nDataType=0x0006\r\nAccessType=rw\r\nDefaultValue=012\r\n";

/// Returns the quirky description in Windows-1252, with `value` in place of `012`.
fn latin(value: &str) -> Vec<u8> {
    QUIRKY.replace("012", value).chars().map(|letter| letter as u8).collect()
}

#[test]
fn encoding_and_line_ends_stay() {
    let folder = Folder::new("fix-encoding");
    let path = folder.file("a.eds", &latin("012"));
    let utf16 = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
    let wide = folder.file("b.eds", &utf16(&format!("\u{feff}{QUIRKY}")));
    assert!(lexibus(&["fix"], &folder.0).status.success());
    assert!(std::fs::read(&path).expect("a file") == latin("10"));
    assert!(std::fs::read(&wide).expect("a file") == utf16(&format!("\u{feff}{}", QUIRKY.replace("012", "10"))));
}

#[test]
fn backups_are_not_replaced() {
    let folder = Folder::new("fix-backup");
    let path = folder.file("a.eds", &latin("012"));
    let backup = folder.file("a.eds.bak", b"older");
    let refused = lexibus(&["fix"], &path);
    assert_eq!(refused.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("a.eds.bak exists already"));
    assert!(std::fs::read(&path).expect("a file") == latin("012"), "the file is unchanged");
    assert!(lexibus(&["fix", "--no-backup"], &path).status.success());
    assert!(std::fs::read(&path).expect("a file") == latin("10"));
    assert_eq!(std::fs::read(&backup).expect("a backup"), b"older");
}

#[test]
#[cfg(unix)]
fn permissions_and_links_stay() {
    use std::os::unix::fs::{symlink, PermissionsExt};
    let folder = Folder::new("fix-links");
    let path = folder.file("a.eds", &latin("012"));
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o600)).expect("permissions");
    let link = folder.0.join("link.eds");
    symlink("a.eds", &link).expect("a link");
    // The folder contains the file and a link to it, and the file must be fixed only once.
    let fixed = lexibus(&["fix"], &folder.0);
    assert!(fixed.status.success(), "{}", String::from_utf8_lossy(&fixed.stderr));
    assert!(link.is_symlink() && std::fs::read(&path).expect("a file") == latin("10"));
    for name in ["a.eds", "a.eds.bak"] {
        let mode = std::fs::metadata(folder.0.join(name)).expect("a file").permissions().mode();
        assert_eq!(mode & 0o777, 0o600, "{name}");
    }
}

#[test]
fn a_folder_that_cannot_be_written_leaves_the_file_complete() {
    let folder = Folder::new("fix-failure");
    let path = folder.file("a.eds", &latin("012"));
    // A folder with the name of the backup makes the backup fail, so the file must not change.
    std::fs::create_dir(folder.0.join("a.eds.bak")).expect("a folder");
    assert_eq!(lexibus(&["fix"], &path).status.code(), Some(1));
    assert!(std::fs::read(&path).expect("a file") == latin("012"));
    assert_eq!(std::fs::read_dir(&folder.0).expect("a folder").count(), 2, "no temporary file is left");
}

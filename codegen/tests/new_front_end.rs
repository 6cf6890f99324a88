//! Tests that a new front end needs changes in only four files outside its folder. The test follows the steps of the
//! chapter "A new front end" in a copy of this crate. Then it reads a file of the new format.

#[path = "../../tests/support/lane.rs"]
mod lane;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A line in a file of this crate, and the text to insert after it.
struct Step {
    file: &'static str,
    after: &'static str,
    insert: &'static str,
}

const STEPS: [Step; 8] = [
    // Declare the feature.
    Step { file: "Cargo.toml", after: "xml = []\n", insert: "pins = []\n" },
    // Add the format.
    Step {
        file: "src/ir/format.rs",
        after: "    /// PROFINET device description (GSDML).\n    Gsdml,\n",
        insert: "    /// One line per object.\n    Pins,\n",
    },
    Step { file: "src/ir/format.rs", after: "const ALL: &'static [Format] =\n        &[", insert: "Format::Pins, " },
    Step { file: "src/ir/format.rs", after: "const OF_VENDORS: &'static [Format] = &[", insert: "Format::Pins, " },
    Step {
        file: "src/ir/format.rs",
        after: "            Format::Gsdml => \"gsdml\",\n",
        insert: "            Format::Pins => \"pins\",\n",
    },
    Step {
        file: "src/ir/format.rs",
        after: "            Format::Xdd => &[\"xdd\", \"xdc\", \"xpd\"],\n",
        insert: "            Format::Pins => &[\"pins\"],\n",
    },
    // Add the folder.
    Step { file: "src/frontend/mod.rs", after: "mod read;\n", insert: "#[cfg(feature = \"pins\")]\npub mod pins;\n" },
    // Recognize and read files of the format.
    Step {
        file: "src/frontend/read.rs",
        after: "const FRONT_ENDS: &[FrontEnd] = &[\n",
        insert: "    FrontEnd {
        recognize: |source| source.text().starts_with(\"device \").then_some(Format::Pins),
        feature: \"pins\",
        read: with_feature!(\"pins\", |input, diagnostics| super::pins::read(input.source, input.file, diagnostics)),
    },\n",
    },
];

/// Copies a folder with its subfolders.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let (path, name) = entry.map(|entry| (entry.path(), entry.file_name())).unwrap();
        if path.is_dir() {
            copy(&path, &to.join(name));
        } else {
            fs::copy(&path, to.join(name)).unwrap();
        }
    }
}

/// Returns the text from the mark `from`, including the mark, up to the mark `to`.
fn between<'t>(text: &'t str, from: &str, to: &str) -> &'t str {
    let start = text.find(from).unwrap_or_else(|| panic!("no {from:?}"));
    &text[start..start + text[start..].find(to).unwrap_or_else(|| panic!("no {to:?}"))]
}

/// Copies this crate to a separate workspace, without its tests.
fn copy_of_crate(folder: &Path) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let copied = folder.join("codegen");
    let _ = fs::remove_dir_all(&copied);
    for part in ["src", "schema"] {
        copy(&root.join(part), &copied.join(part));
    }
    fs::copy(root.join("README.md"), copied.join("README.md")).unwrap();
    let manifest = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    fs::write(copied.join("Cargo.toml"), between(&manifest, "[package]", "[dev-dependencies]")).unwrap();
    let workspace = fs::read_to_string(root.join("../Cargo.toml")).unwrap();
    let inherited = between(&workspace, "[workspace.package]", "\n[package]");
    fs::write(
        folder.join("Cargo.toml"),
        format!("[workspace]\nmembers = [\"codegen\"]\nresolver = \"2\"\n\n{inherited}"),
    )
    .unwrap();
    fs::copy(root.join("../Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    copied
}

fn follow(step: &Step, copied: &Path) {
    let path = copied.join(step.file);
    let text = fs::read_to_string(&path).unwrap();
    assert_eq!(text.matches(step.after).count(), 1, "{:?} in {}", step.after, step.file);
    fs::write(path, text.replace(step.after, &format!("{}{}", step.after, step.insert))).unwrap();
}

#[test]
fn a_new_front_end_changes_four_files() {
    let files: BTreeSet<&str> = STEPS.iter().map(|step| step.file).collect();
    assert_eq!(files.len(), 4);
    if lane::skips("the build of a copy with a new front end") {
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("new-front-end");
    let copied = copy_of_crate(&folder);
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/new_front_end");
    copy(&sources.join("pins"), &copied.join("src/frontend/pins"));
    fs::create_dir(copied.join("tests")).unwrap();
    fs::copy(sources.join("reads_pins.rs"), copied.join("tests/reads_pins.rs")).unwrap();
    STEPS.iter().for_each(|step| follow(step, &copied));
    for features in ["pins", "eds"] {
        let output = Command::new(env!("CARGO"))
            .args(["test", "--offline", "--no-default-features", "--features", features, "--test", "reads_pins"])
            .current_dir(&copied)
            .env("CARGO_TARGET_DIR", folder.join("target"))
            .env("RUSTFLAGS", "-D warnings")
            .output()
            .unwrap();
        let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
        assert!(output.status.success(), "{}{}", text(&output.stdout), text(&output.stderr));
    }
}

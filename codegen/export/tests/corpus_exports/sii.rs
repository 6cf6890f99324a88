//! Exports the EEPROM content of all EtherCAT slaves of the corpus. A Python program reads each image and compares it with
//! the ESI. The program shares no code with the exporter.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::corpus_support::round_trip::{options, source};
use crate::corpus_support::{files_of, folder_of, lane, python};
use lexibus_codegen::compile::read;
use lexibus_codegen::ir::Device;
use lexibus_export::sii::{export, Image, Options, Refusal};
use serde_json::{json, Value};

/// Bytes for devices without ConfigData.
const CONFIG_DATA: &str = "050603446400";

/// An image that was written to a file.
struct Exported {
    file: String,
    /// Position of the device in the file.
    device: usize,
    image: PathBuf,
    notes: Vec<&'static str>,
}

/// Exports a device. Adds the facts that the device lacks to `options`.
fn image(device: &Device, options: &mut Options) -> Result<Image, Refusal> {
    let mut result = export(device, options);
    if let Err(Refusal::Missing(facts)) = &result {
        for fact in facts {
            let value = if fact.key == "config-data" { CONFIG_DATA } else { "0" };
            options.set(fact.key, value).expect("an option");
        }
        result = export(device, options);
    }
    if let Err(Refusal::TooLong { needed, .. }) = result {
        options.set("eeprom-size", &needed.next_power_of_two().to_string()).expect("an option");
        result = export(device, options);
    }
    result
}

/// Writes the images of all devices to a folder.
fn exported(folder: &Path) -> Option<Vec<Exported>> {
    let mut all = Vec::new();
    for file in files_of("esi")? {
        let Some(catalog) = read(source(&file), &options()).catalog else { continue };
        for (position, device) in catalog.devices.iter().enumerate() {
            let mut options = Options::default();
            let Image { bytes, notes } = match image(device, &mut options) {
                Ok(image) => image,
                Err(Refusal::Nothing) => continue,
                Err(refusal) => panic!("{}: {}: {refusal}", file.name, device.name),
            };
            let path = folder.join(format!("{}.bin", all.len()));
            std::fs::write(&path, bytes).expect("a temporary file");
            let mut notes: Vec<&str> = notes.iter().map(|note| note.kind.name()).collect();
            notes.extend(options.eeprom_size.map(|_| "eeprom-size"));
            all.push(Exported { file: file.name.clone(), device: position, image: path, notes });
        }
    }
    Some(all)
}

/// Returns, for each image, the differences that the Python program finds, or `None` if Python cannot read the ESI.
fn differences(python: &Path, all: &[Exported]) -> Vec<Option<Vec<String>>> {
    let corpus = folder_of("esi").expect("the corpus");
    let requests = all.iter().map(|one| {
        let path = corpus.join(&one.file);
        json!({ "esi": path, "device": one.device, "image": one.image, "notes": one.notes }).to_string() + "\n"
    });
    let requests: String = requests.collect();
    let mut program = Command::new(python)
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus_exports/sii.py"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("Python starts");
    let mut input = program.stdin.take().expect("a pipe");
    let writer = std::thread::spawn(move || input.write_all(requests.as_bytes()));
    let output = program.wait_with_output().expect("Python ends");
    writer.join().expect("a thread").expect("the requests are read");
    assert!(output.status.success(), "Python failed");
    let lines = std::str::from_utf8(&output.stdout).expect("UTF-8").lines();
    let answers = lines.map(|line| serde_json::from_str::<Value>(line).expect("JSON"));
    answers.map(|answer| serde_json::from_value(answer).expect("a list of texts")).collect()
}

#[test]
fn images_contain_the_facts_of_their_esi() {
    let Some(python) = python::with(&["xml.etree"]) else { return };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("sii");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    let Some(all) = exported(&folder) else { return };
    let (mut notes, mut unread, mut wrong) = (BTreeMap::new(), 0, Vec::new());
    let found = differences(&python, &all);
    assert_eq!(found.len(), all.len());
    for (one, found) in all.iter().zip(found) {
        one.notes.iter().for_each(|note| *notes.entry(*note).or_insert(0) += 1);
        match found {
            Some(found) => wrong.extend(found.iter().map(|text| format!("{} #{}: {text}", one.file, one.device))),
            None => unread += 1,
        }
    }
    eprintln!("{} images, {unread} of files that Python cannot read; devices with notes: {notes:?}", all.len());
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong[..wrong.len().min(60)].join("\n"));
    // Two files, which describe 11 devices in total, are not well-formed.
    assert!(all.len() > lane::at_least(360) && unread <= 11, "only {} images, {unread} unread", all.len());
}

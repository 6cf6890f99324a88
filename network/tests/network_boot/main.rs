//! Boots simulated nodes with the generated Rust, and compares the values that each node receives with the node's concise DCF.

#[path = "../generated/mod.rs"]
mod generated;
#[path = "../support/mod.rs"]
mod support;

use std::path::Path;

use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::source::Source;
use lexibus_codegen::{Presence, RustOptions};
use lexibus_network::compile::{compile, Compilation};
use lexibus_network::output::{files, rust};
use support::entries;

/// A network whose values are not sorted by the phases of a configuration. It contains a command (0x6040) and objects that are
/// written several times.
const NETWORK: &str = r#"
[network]
bit_rate = 500
[master]
id = 127
heartbeat = 100
sync_period = 10_000

[nodes.axis]
id = 1
device = "axis.dcf"
heartbeat = 100
heartbeat_consumer = true
store = true
[nodes.axis.parameters]
"0x6081" = 3000
"0x6040" = 6
"0x607A" = -5
"0x1005" = 0x80
[nodes.axis.rpdo.1]
transmission = 1
map = ["0x6040", "0x60FF"]
[nodes.axis.tpdo.1]
map = ["0x6041", "0x606C"]
[nodes.axis.tpdo.2]
enabled = false

[nodes.other]
id = 2
device = "drive.eds"
[nodes.other.rpdo.2]
cob_id = "axis.tpdo1"
map = ["0x607A"]

[nodes]
bare = { id = 3, device = "bare.eds" }
exact = { id = 4, device = "versions.eds", manufacturer_hardware_version = "rev B", manufacturer_software_version = "1.4.2" }
newer = { id = 5, device = "versions.eds", manufacturer_hardware_version = "rev \"C\"", manufacturer_software_version = "1.4.2" }
older = { id = 6, device = "versions.eds", manufacturer_software_version = "1.4" }
"#;

fn example(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/network").join(name);
    std::fs::read_to_string(path).expect("the example")
}

/// Replaces a part of a text, and panics if the text does not contain the part.
fn replaced(text: &str, part: &str, by: &str) -> String {
    assert!(text.contains(part), "{part}");
    text.replace(part, by)
}

fn compiled() -> Compilation {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("network-of-boot");
    std::fs::create_dir_all(&folder).expect("a folder");
    let drive = example("drive.eds").replace("\r\n", "\n");
    let of = "[6083]\nParameterName=";
    let axis = replaced(&drive, of, &of.replace('\n', "\nParameterValue=77\n"));
    // A device whose object 0x1018 contains only the vendor-ID.
    let identity = drive.find("[1018]").expect("an object")..drive.find("[1020]").expect("an object");
    let part = &drive[identity.clone()];
    let part = part[..part.find("[1018sub2]").expect("a product code")].to_owned();
    let part = replaced(&part, "SubNumber=5", "SubNumber=2").replace("DefaultValue=4", "DefaultValue=1");
    let bare = drive[..identity.start].to_owned() + &part + &drive[identity.end..];
    let version = |index, name, text| {
        format!("\n[{index}]\nParameterName={name}\nObjectType=7\nDataType=9\nAccessType=const\nDefaultValue={text}\n")
    };
    let versions = version("1009", "Hardware version", "rev B") + &version("100A", "Software version", "1.4.2");
    let list = replaced(&drive, "SupportedObjects=28\n", "SupportedObjects=30\n29=0x1009\n30=0x100A\n");
    for (name, text) in
        [("axis.dcf", axis), ("drive.eds", drive), ("bare.eds", bare), ("versions.eds", list + &versions)]
    {
        std::fs::write(folder.join(name), text).expect("a file");
    }
    let source = Source::new("network.toml", NETWORK.as_bytes().to_vec()).in_folder(&folder);
    compile(source, Levels::lenient())
}

#[test]
fn nodes_receive_the_values_of_their_concise_dcf() {
    let compilation = compiled();
    let network = compilation.usable().unwrap_or_else(|| panic!("{:?}", compilation.diagnostics.list()));
    let options = RustOptions { table: Presence::Always, ..RustOptions::default() };
    let mut program = rust(network, &options);
    program.push(("main.rs".to_owned(), include_str!("program.rs").to_owned()));
    let output = generated::run("network-boot", &program, &[]);
    let files = files(network);
    let result = |node: &str| output.lines().rfind(|line| line.starts_with(&format!("{node} "))).expect("a result");
    assert_eq!(result("newer"), "newer Err(HardwareVersion { expected: \"rev \\\"C\\\"\", actual: \"rev B\" })");
    assert_eq!(result("older"), "older Err(SoftwareVersion { expected: \"1.4\", actual: \"1.4.2\" })");
    for node in ["axis", "other", "bare", "exact"] {
        let concise = files.iter().find(|file| file.name == format!("{node}.bin"));
        let expected = concise.map_or(Vec::new(), |file| entries(&file.content));
        let expected: Vec<String> =
            expected.iter().map(|(index, sub_index, bytes)| format!("{node} {index} {sub_index} {bytes:?}")).collect();
        // `axis` stores its configuration, so `boot` then writes the date of the configuration to 0x1020 (4128).
        let dates: &[&str] = if node == "axis" { &["axis 4128 1", "axis 4128 2"] } else { &[] };
        let received: Vec<&str> = output.lines().filter(|line| line.starts_with(&format!("{node} "))).collect();
        let (result, received) = received.split_last().expect("a result");
        assert!(result.starts_with(&format!("{node} Ok(")), "{result}");
        let (received, date) = received.split_at(received.len() - dates.len());
        assert_eq!(received, expected);
        let date: Vec<&str> = date.iter().map(|line| line.rsplit_once(" [").expect("bytes").0).collect();
        assert_eq!(date, dates);
    }
    assert!(entries(&files.iter().find(|file| file.name == "axis.bin").expect("a file").content).len() > 12);
}

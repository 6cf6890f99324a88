//! Tests drive crates that `lexibus new --crate` creates outside of the workspace. Each crate must be formatted, its
//! tests must pass, and its example must run.

#[path = "../../tests/support/lane.rs"]
mod lane;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A lift whose state machine is not that of CiA 402. An automatic transition follows the first command.
const LIFT: &str = r#"lexibus = 1

[device]
name = "Lift"
vendor = "Example"
buses = ["modbus"]

[spaces.holding]
modbus = { table = "holding", first = 0 }

[[chapters]]
title = "Operation"
space = "holding"

[chapters.registers]
status  = { reg = 0, type = "u16", access = "ro" }
control = { reg = 1, type = "u16", access = "rw" }
height  = { reg = 2, type = "u16", access = "ro", unit = "mm", max = 2500 }
speed   = { reg = 3, type = "u16", access = "rw", unit = "mm/s", min = 10, max = 500, default = 200 }

[machines.lift]
status = "status"
control = "control"

[machines.lift.states]
off = { mask = 0x7, value = 0 }
starting = { mask = 0x7, value = 1 }
ready = { mask = 0x7, value = 2 }
moving = { mask = 0x7, value = 3 }

[machines.lift.commands]
start = { mask = 0x3, value = 1 }
go = { mask = 0x3, value = 2 }
stop = { mask = 0x3, value = 0 }

[[machines.lift.transitions]]
from = "off"
to = "starting"
command = "start"

[[machines.lift.transitions]]
from = "starting"
to = "ready"

[[machines.lift.transitions]]
from = "ready"
to = "moving"
command = "go"

[[machines.lift.transitions]]
from = "moving"
to = "off"
command = "stop"
"#;

/// A press whose last state is an alarm. The press can enter the alarm without a command. The command `test_alarm` also
/// leads to the alarm, and is on the shortest path from `off` to `ready`.
const PRESS: &str = r#"lexibus = 1

[device]
name = "Press"
vendor = "Example"
buses = ["modbus"]

[spaces.holding]
modbus = { table = "holding", first = 0 }

[[chapters]]
title = "Operation"
space = "holding"

[chapters.registers]
status  = { reg = 0, type = "u16", access = "ro" }
control = { reg = 1, type = "u16", access = "rw" }

[machines.press]
status = "status"
control = "control"
faults = ["alarm"]

[machines.press.states]
off = { mask = 0x7, value = 0 }
warming = { mask = 0x7, value = 1 }
warm = { mask = 0x7, value = 2 }
ready = { mask = 0x7, value = 3 }
operating = { mask = 0x7, value = 4 }
alarm = { mask = 0x7, value = 5 }

[machines.press.commands]
stop = { mask = 0x7, value = 0 }
heat = { mask = 0x7, value = 1 }
release = { mask = 0x7, value = 2 }
start = { mask = 0x7, value = 3 }
test_alarm = { mask = 0x7, value = 4 }
reset = { mask = 0x7, value = 5 }

[[machines.press.transitions]]
from = ["off", "operating"]
to = "alarm"
command = "test_alarm"

[[machines.press.transitions]]
from = ["ready", "operating"]
to = "alarm"

[[machines.press.transitions]]
from = "alarm"
to = "ready"
command = "reset"

[[machines.press.transitions]]
from = "off"
to = "warming"
command = "heat"

[[machines.press.transitions]]
from = "warming"
to = "warm"

[[machines.press.transitions]]
from = "warm"
to = "ready"
command = "release"

[[machines.press.transitions]]
from = "ready"
to = "operating"
command = "start"

[[machines.press.transitions]]
from = ["ready", "operating"]
to = "off"
command = "stop"
"#;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn temporary() -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
}

fn text(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

/// Runs Cargo in `folder`, and shares the build folder with other tests that build crates outside of the workspace.
fn cargo(folder: &Path, arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(folder)
        .env("CARGO_TARGET_DIR", temporary().join("drive-crate"))
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{arguments:?}: {}", text(&output));
    text(&output)
}

/// Creates the crate `name` from a description. The crate uses the packages of this workspace instead of those in the
/// Git repository.
fn create(name: &str, description: &Path, options: &[&str]) -> PathBuf {
    let folder = temporary().join(name);
    let _ = std::fs::remove_dir_all(&folder);
    let created = Command::new(env!("CARGO_BIN_EXE_lexibus"))
        .args(["new", "--crate", name, "--from"])
        .arg(description)
        .args(options)
        .arg("--out")
        .arg(&folder)
        .output()
        .expect("lexibus runs");
    assert!(created.status.success(), "{}", text(&created));
    let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).expect("the manifest");
    let git = "{ git = \"https://github.com/lexibus/lexibus\" }";
    let mut local = manifest.replace(
        &format!("lexibus-codegen = {git}"),
        &format!("lexibus-codegen = {{ path = {:?} }}", root().join("codegen")),
    );
    local = local.replace(&format!("lexibus = {git}"), &format!("lexibus = {{ path = {:?} }}", root()));
    assert!(!local.contains("git ="), "{local}");
    std::fs::write(folder.join("Cargo.toml"), local).expect("a manifest");
    // An empty `rustfmt.toml` selects the default settings instead of those of this workspace.
    std::fs::write(folder.join("rustfmt.toml"), "").expect("settings");
    std::fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).expect("the workspace's Cargo.lock");
    folder
}

/// Tests a crate. Exactly `tests` tests must pass, and the example of the crate must print all `lines`.
fn try_out(folder: &Path, tests: usize, lines: &[&str]) {
    cargo(folder, &["fmt", "--check"]);
    let tested = cargo(folder, &["test", "--offline", "--quiet", "--test", "simulated"]);
    assert!(tested.contains(&format!("{tests} passed")), "{tested}");
    let printed = cargo(folder, &["run", "--offline", "--quiet", "--example", "simulated"]);
    for line in lines {
        assert!(printed.lines().any(|printed| printed == *line), "{line:?}: {printed}");
    }
}

#[test]
fn an_eds_becomes_a_crate_that_moves_a_drive() {
    let folder = create("new-eds", &root().join("dictionaries/demo-drive.eds"), &[]);
    try_out(&folder, 2, &["state: OperationEnabled", "position: 100"]);
}

#[test]
fn an_esi_becomes_a_crate_that_enables_a_drive() {
    if lane::skips("a crate from an ESI file") {
        return;
    }
    let folder = create("new-esi", &root().join("examples/support/servo.esi.xml"), &["--device", "Demo Servo@latest"]);
    try_out(&folder, 2, &["state: OperationEnabled"]);
}

#[test]
fn a_gsdml_becomes_a_crate_that_exchanges_data() {
    if lane::skips("a crate from a GSDML file") {
        return;
    }
    let folder = create("new-gsdml", &root().join("examples/servo.gsdml.xml"), &[]);
    try_out(&folder, 2, &["slot 1, subslot 0x0002: submodule 0x00000001", "start-up records: 1"]);
}

#[test]
fn a_table_becomes_a_crate_on_each_of_its_buses() {
    if lane::skips("crates from register tables") {
        return;
    }
    let table = root().join("dictionaries/eco.toml");
    let folder = create("new-table", &table, &["--bus", "canopen"]);
    try_out(&folder, 2, &["state: OperationEnabled"]);
    // The drive has no objects of CiA 402 on Modbus.
    let folder = create("new-table", &table, &["--bus", "modbus"]);
    try_out(&folder, 1, &[]);
}

#[test]
fn a_table_becomes_a_crate_with_its_own_state_machine() {
    if lane::skips("a crate from a register table") {
        return;
    }
    let table = temporary().join("lift.toml");
    std::fs::write(&table, LIFT).expect("a table");
    let folder = create("new-lift", &table, &[]);
    try_out(&folder, 3, &["state: Moving", "height (unit mm): 0", "speed (unit mm/s): 200"]);
}

#[test]
fn enable_leads_to_the_operating_state_and_through_no_fault_state() {
    let table = temporary().join("press.toml");
    std::fs::write(&table, PRESS).expect("a table");
    let folder = create("new-press", &table, &[]);
    let library = std::fs::read_to_string(folder.join("src/lib.rs")).expect("the library");
    assert!(library.contains("let target = State::Operating;"), "{library}");
    if lane::skips("the crate of a press") {
        return;
    }
    let test = folder.join("tests/simulated.rs");
    let text = std::fs::read_to_string(&test).expect("the tests");
    std::fs::write(&test, text + ALARM_TEST).expect("a test");
    try_out(&folder, 3, &["state: Operating"]);
}

/// The press must not receive the command that tests the alarm.
const ALARM_TEST: &str = r#"
#[test]
fn no_command_causes_an_alarm() -> Result<(), Box<dyn Error>> {
    let sent = std::sync::Arc::new(std::sync::Mutex::new(Vec::new()));
    let mut device = support::device()?;
    let list = sent.clone();
    device.on_write(objects::CONTROL, move |_, control| {
        let mut list = list.lock().expect("the list");
        list.push(StateWord::bits(control));
        Ok(())
    })?;
    Driver::new(device.client::<Modbus>()).enable(Duration::from_secs(5))?;
    assert_eq!(*sent.lock().expect("the list"), [1, 2, 3]);
    Ok(())
}
"#;

#[test]
fn without_an_operating_state_there_is_no_enable() {
    let table = temporary().join("nameless.toml");
    let nameless = PRESS.replace("operating", "phase");
    let without_path = PRESS.replace("to = \"operating\"", "to = \"ready\"");
    let faulty = PRESS.replace("[\"alarm\"]", "[\"alarm\", \"operating\"]");
    for (text, reason) in [
        (without_path, "no commands lead from `Off` to `Operating` without a fault"),
        (faulty, "no state without a fault has"),
        (nameless, "no state without a fault has a name such as"),
    ] {
        std::fs::write(&table, text).expect("a table");
        let folder = create("new-nameless", &table, &[]);
        cargo(&folder, &["fmt", "--check"]);
        let library = std::fs::read_to_string(folder.join("src/lib.rs")).expect("the library");
        assert!(library.contains(reason) && !library.contains("fn enable"), "{reason}: {library}");
    }
    if !lane::skips("a crate without an operating state") {
        try_out(&temporary().join("new-nameless"), 1, &[]);
    }
}

/// Returns a GSDML file with two access points. "Coupler A" has a fixed module in slot 1. The first two modules with
/// data do not fit: one is allowed only in slot 1, and one has too much data. "Drive" is the first module that fits,
/// and its submodules with data must be plugged.
fn couplers() -> String {
    let names = ["Coupler A", "Coupler B", "Power", "Late", "Big", "Drive", "Settings", "Telegram", "Small", "Value"];
    let info = |name: &str| format!("<ModuleInfo><Name TextId=\"{name}\"/><InfoText TextId=\"{name}\"/></ModuleInfo>");
    let point = |id: &str, ident: u32, name: &str, uses: &str| {
        format!(
            "<DeviceAccessPointItem ID=\"{id}\" PNIO_Version=\"V2.35\" PhysicalSlots=\"0..3\" FixedInSlots=\"0\" \
             ModuleIdentNumber=\"0x{ident:08X}\" MinDeviceInterval=\"32\" DNS_CompatibleName=\"coupler\">{}\
             <IOConfigData MaxInputLength=\"20\" MaxOutputLength=\"20\"/><UseableModules>{uses}</UseableModules>\
             </DeviceAccessPointItem>",
            info(name)
        )
    };
    let usage = |module: &str, slots: &str| format!("<ModuleItemRef ModuleItemTarget=\"{module}\" {slots}/>");
    let first = [
        usage("Power", "FixedInSlots=\"1\""),
        usage("Late", "UsedInSlots=\"1\""),
        usage("Big", "AllowedInSlots=\"2..3\""),
        usage("Drive", "AllowedInSlots=\"3\""),
    ];
    let points = [
        point("DAP1", 1, "Coupler A", &first.concat()),
        point("DAP2", 2, "Coupler B", &usage("Small", "AllowedInSlots=\"2\"")),
    ];
    let data = |ty: &str, length: &str| {
        format!("<IOData><Input><DataItem DataType=\"{ty}\" {length} TextId=\"Value\"/></Input></IOData>")
    };
    let module = |name: &str, ident: u32, subslots: &str, uses: &str, data: &str| {
        format!(
            "<ModuleItem ID=\"{name}\" ModuleIdentNumber=\"0x{ident:08X}\"{subslots}>{0}{uses}<VirtualSubmoduleList>\
             <VirtualSubmoduleItem ID=\"V{ident}\" SubmoduleIdentNumber=\"0x{ident:08X}\">{data}{0}</VirtualSubmoduleItem>\
             </VirtualSubmoduleList></ModuleItem>",
            info(name)
        )
    };
    let word = data("Unsigned16", "");
    let uses = "<UseableSubmodules><SubmoduleItemRef SubmoduleItemTarget=\"Settings\" AllowedInSubslots=\"2..4\"/>\
                <SubmoduleItemRef SubmoduleItemTarget=\"Telegram\" AllowedInSubslots=\"3..4\"/></UseableSubmodules>";
    let modules = [
        module("Power", 0x10, "", "", "<IOData/>"),
        module("Late", 0x11, "", "", &word),
        module("Big", 0x12, "", "", &data("OctetString", "Length=\"50\"")),
        module("Drive", 0x13, " PhysicalSubslots=\"1..4\"", uses, "<IOData/>"),
        module("Small", 0x14, "", "", &word),
    ];
    let submodule = |name: &str, ident: u32, data: &str| {
        format!(
            "<SubmoduleItem ID=\"{name}\" SubmoduleIdentNumber=\"0x{ident:08X}\">{data}{}</SubmoduleItem>",
            info(name)
        )
    };
    let submodules = [submodule("Settings", 0x20, "<IOData/>"), submodule("Telegram", 0x21, &word)];
    let texts: String = names.iter().map(|name| format!("<Text TextId=\"{name}\" Value=\"{name}\"/>")).collect();
    format!(
        "<ISO15745Profile xmlns=\"http://www.profibus.com/GSDML/2003/11/DeviceProfile\"><ProfileBody>\
         <DeviceIdentity VendorID=\"0x1234\" DeviceID=\"0x5678\"><InfoText TextId=\"Value\"/><VendorName Value=\"Example\"/>\
         </DeviceIdentity><DeviceFunction><Family MainFamily=\"I/O\" ProductFamily=\"Example\"/></DeviceFunction>\
         <ApplicationProcess><DeviceAccessPointList>{}</DeviceAccessPointList><ModuleList>{}</ModuleList>\
         <SubmoduleList>{}</SubmoduleList><ExternalTextList><PrimaryLanguage>{texts}</PrimaryLanguage></ExternalTextList>\
         </ApplicationProcess></ProfileBody></ISO15745Profile>",
        points.concat(),
        modules.concat(),
        submodules.concat()
    )
}

#[test]
fn modules_and_submodules_are_plugged_only_where_they_fit() {
    let file = temporary().join("couplers.gsdml.xml");
    std::fs::write(&file, couplers()).expect("a description");
    let first = ["plan.plug(3, &bindings::modules::drive::MODULE)?;", "plan.plug_submodule("];
    let second = ["plan.plug(2, &bindings::modules::small::MODULE)?;"];
    let cases = [("Coupler A", &first[..], "slot 3, subslot 0x0003: submodule 0x00000021"), ("Coupler B", &second, "")];
    for (device, plugged, line) in cases {
        let folder = create("new-coupler", &file, &["--device", device]);
        cargo(&folder, &["fmt", "--check"]);
        let library = std::fs::read_to_string(folder.join("src/lib.rs")).expect("the library");
        assert_eq!(library.matches("plan.plug").count(), plugged.len(), "{library}");
        assert!(plugged.iter().all(|call| library.contains(call)), "{library}");
        if !lane::skips("the crates of couplers") {
            try_out(&folder, 2, if line.is_empty() { &[] } else { std::slice::from_ref(&line) });
        }
    }
}

/// Returns a table whose names have `length` letters.
fn with_names_of(length: usize) -> String {
    let name = |start: &str, word: &str| format!("{start}_{}", word.repeat(length))[..length].to_owned();
    [
        ("status", "status_word"),
        ("control", "control_word"),
        ("height", "height_of_the_cabin"),
        ("speed", "speed_of_the_cabin"),
        ("off", "switched_off"),
        ("starting", "starting_up"),
        ("ready", "ready_to_move"),
        ("moving", "moving_up"),
        ("start", "start_now"),
        ("go", "go_on"),
        ("stop", "stop_now"),
    ]
    .iter()
    .fold(LIFT.to_owned(), |table, (word, long)| {
        let long = name(word, &format!("{long}_"));
        let long = long.trim_end_matches('_');
        let table = table.replace(&format!("\"{word}\""), &format!("\"{long}\""));
        let lines =
            table.lines().map(|line| match line.strip_prefix(word).filter(|rest| rest.trim_start().starts_with('=')) {
                Some(rest) if !rest.trim_start_matches(" = ").starts_with('"') => format!("{long}{rest}"),
                _ => line.to_owned(),
            });
        lines.collect::<Vec<_>>().join("\n")
    })
}

/// Checks only the format of the files, because compiling each crate would take too long.
#[test]
fn crates_with_long_names_are_formatted() {
    let table = temporary().join("long-names.toml");
    let mut lengths = std::collections::BTreeSet::new();
    for length in (12..=66).step_by(3) {
        std::fs::write(&table, with_names_of(length)).expect("a table");
        let folder = create("new-long", &table, &[]);
        cargo(&folder, &["fmt", "--check"]);
        let library = std::fs::read_to_string(folder.join("src/lib.rs")).expect("the library");
        lengths.extend(library.lines().filter(|line| line.contains("pub fn")).map(str::len));
    }
    assert!(lengths.range(90..=100).next().is_some(), "no line is nearly full: {lengths:?}");
    for length in (10..=90).step_by(4) {
        let description = temporary().join(format!("{}.eds", "d".repeat(length)));
        let name = "Following error time out of the axis, of the motor and of the brake in the cabin of the lift";
        let eds = format!(
            "[DeviceInfo]\nProductName=Lift\n[2000]\nParameterName={}\nDataType=0x0006\nAccessType=rw\nDefaultValue=1\n",
            &name[..length].trim_end()
        );
        std::fs::write(&description, eds).expect("a description");
        cargo(&create("new-long", &description, &[]), &["fmt", "--check"]);
        cargo(&create("new-long", &description, &["--device", "Lift"]), &["fmt", "--check"]);
    }
}

/// The description refers to a dictionary in a subfolder. The build of the crate must find this dictionary.
#[test]
fn a_crate_contains_the_files_to_which_its_description_refers() {
    let folder = temporary().join("new-references");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("Dicts")).expect("a folder");
    let device = "<EtherCATInfo><Vendor><Id>#x1</Id><Name>Maker</Name></Vendor><Descriptions><Devices>\
        <Device Physics=\"YY\"><Type ProductCode=\"#x1\" RevisionNo=\"#x1\">T1</Type><Name>Terminal</Name>\
        <Mailbox><CoE/></Mailbox><Profile><DictionaryFile>Dicts\\dict.xml</DictionaryFile></Profile></Device></Devices>\
        </Descriptions></EtherCATInfo>";
    let dictionary = "<EtherCATDict><Dictionary><DataTypes><DataType><Name>UINT</Name><BitSize>16</BitSize></DataType>\
        </DataTypes><Objects><Object><Index>#x2000</Index><Name>Speed</Name><Type>UINT</Type><BitSize>16</BitSize>\
        <Flags><Access>rw</Access></Flags></Object></Objects></Dictionary></EtherCATDict>";
    std::fs::write(folder.join("main.xml"), device).expect("a description");
    std::fs::write(folder.join("Dicts/dict.xml"), dictionary).expect("a dictionary");
    let made = create("new-with-dictionary", &folder.join("main.xml"), &[]);
    assert_eq!(std::fs::read_to_string(made.join("Dicts/dict.xml")).expect("the copy"), dictionary);
    let library = std::fs::read_to_string(made.join("src/lib.rs")).expect("the library");
    assert!(library.contains("pub fn speed(&mut self)"), "{library}");
    // Check that the copied files describe the same device as the originals.
    let info = |folder: &Path| {
        let info = Command::new(env!("CARGO_BIN_EXE_lexibus")).args(["info", "main.xml"]).current_dir(folder).output();
        text(&info.expect("lexibus runs"))
    };
    assert!(info(&made).contains("1 objects, 1 entries"), "{}", info(&made));
    assert_eq!(info(&made), info(&folder));
}

//! Tests which states, items and values the compiler chooses for the program of a new drive crate.

use lexibus_codegen::backend::rust::{program, NoTarget, Program};
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;

/// Returns the elements for a program that accesses the device of a register table.
fn program_of(table: String) -> Program {
    let compilation = check(Source::new("table.toml", table.into_bytes()), &Options::default());
    let catalog = compilation.catalog.as_ref().expect("a catalog");
    program(&catalog.devices[0], &catalog.files[0], None).expect("a program")
}

/// Returns a table with a state machine. Each state has a number as its value. A transition has the form `FROM >COMMAND TO`, or
/// `FROM > TO` if it is automatic.
fn with_machine(keys: &str, states: &[&str], transitions: &[&str]) -> String {
    let mut table = format!(
        "lexibus = 1\n[device]\nname = \"D\"\nbuses = [\"modbus\"]\n[spaces.holding]\nmodbus = {{ table = \"holding\", first = 0 }}\n\
         [[chapters]]\ntitle = \"Operation\"\nspace = \"holding\"\n[chapters.registers]\n\
         status = {{ reg = 0, type = \"u16\", access = \"ro\" }}\ncontrol = {{ reg = 1, type = \"u16\", access = \"rw\" }}\n\
         [machines.m]\nstatus = \"status\"\ncontrol = \"control\"\n{keys}\n[machines.m.states]\n"
    );
    for (value, state) in states.iter().enumerate() {
        table += &format!("\"{state}\" = {{ mask = 0xF, value = {value} }}\n");
    }
    table += "[machines.m.commands]\n";
    for (value, command) in ["up", "down", "trip", "reset"].iter().enumerate() {
        table += &format!("{command} = {{ mask = 0x3, value = {value} }}\n");
    }
    for transition in transitions {
        let [from, command, to] = transition.splitn(3, ' ').collect::<Vec<_>>()[..] else { panic!("{transition}") };
        let from = if from == "*" { String::new() } else { format!("from = \"{from}\"\n") };
        let command = command.strip_prefix('>').filter(|command| !command.is_empty());
        let command = command.map(|command| format!("command = \"{command}\"\n")).unwrap_or_default();
        table += &format!("[[machines.m.transitions]]\n{from}to = \"{to}\"\n{command}");
    }
    table
}

/// Returns the state after power-on and the operating state, or the reason why the program has no target state.
fn initial_and_target(keys: &str, states: &[&str], transitions: &[&str]) -> Result<[String; 2], NoTarget> {
    let machine = program_of(with_machine(keys, states, transitions)).machine.expect("a machine");
    machine.map(|machine| [machine.simulation.expect("a simulation").initial, machine.target])
}

fn no_path(from: &str, to: &str) -> Result<[String; 2], NoTarget> {
    Err(NoTarget::Path(from.to_owned(), to.to_owned()))
}

fn path(from: &str, to: &str) -> Result<[String; 2], NoTarget> {
    Ok([from.to_owned(), to.to_owned()])
}

#[test]
fn the_target_is_the_operating_state() {
    let chain = ["off >up ready", "ready >up operating", "operating >down halted", "operating > alarm"];
    let states = ["off", "ready", "operating", "halted", "alarm"];
    let faults = "faults = [\"alarm\"]";
    // The states "halted" and "alarm" are farther from the state after power-on.
    assert_eq!(initial_and_target(faults, &states, &chain), path("Off", "Operating"));
    // The order of the states does not matter.
    assert_eq!(
        initial_and_target(faults, &["operating", "alarm", "off", "ready", "halted"], &chain),
        path("Off", "Operating")
    );
    // The state without motion ("Enabled") takes precedence over the state with motion ("running").
    let drive = ["off >up Enabled", "Enabled >up running"];
    assert_eq!(initial_and_target("", &["off", "running", "Enabled"], &drive), path("Off", "Enabled"));
    // The automatic transition out of the operating state does not belong to the path.
    let once = ["off >up operating", "operating > off"];
    assert_eq!(initial_and_target("", &["off", "operating"], &once), path("Off", "Operating"));
    assert_eq!(initial_and_target("", &["off", "on"], &["off >up on"]), Err(NoTarget::Name));
    assert_eq!(
        initial_and_target("faults = [\"running\"]", &["off", "running"], &["off >up running"]),
        Err(NoTarget::Name)
    );
}

#[test]
fn the_path_enters_no_fault_state() {
    let states = ["off", "warming", "warm", "operating", "alarm"];
    let faults = "faults = [\"alarm\"]";
    let through = |step: &'static str| initial_and_target(faults, &states, &[step, "alarm >reset operating"]);
    assert_eq!(through("off >trip alarm"), no_path("Off", "Operating"));
    assert_eq!(through("off > alarm"), no_path("Off", "Operating"));
    assert_eq!(through("* >trip alarm"), no_path("Off", "Operating"));
    // A state is also a fault state if an automatic transition leads to it from any state.
    assert_eq!(
        initial_and_target("", &states, &["* > alarm", "off >trip alarm", "alarm >reset operating"]),
        no_path("Off", "Operating")
    );
    // If the device is in a fault state after power-on, the path leads out of this state.
    let initial = "faults = [\"alarm\"]\ninitial = \"alarm\"";
    assert_eq!(
        initial_and_target(initial, &states, &["alarm >reset off", "off >up operating"]),
        path("Alarm", "Operating")
    );
}

/// The simulated device makes the automatic transitions for which a program waits, and no others.
#[test]
fn a_simulated_device_changes_its_state_like_the_real_one() {
    let states = ["off", "warming", "warm", "operating", "stopping", "alarm"];
    let transitions = [
        "off > warming",
        "warming > warm",
        "warm >up operating",
        "warm > off",
        "operating > alarm",
        "operating >down stopping",
        "stopping > warm",
        "warm >trip alarm",
        "alarm >reset off",
    ];
    let table = with_machine("faults = [\"alarm\"]", &states, &transitions);
    let machine = program_of(table).machine.expect("a machine").expect("a target");
    let simulation = machine.simulation.expect("a simulation");
    assert_eq!(simulation.initial, "Warm");
    let moves = |from: &str| {
        let moves = simulation.transitions.iter().filter(|(before, ..)| before == from);
        moves.map(|(_, command, to)| format!("{command} {to}")).collect::<Vec<_>>()
    };
    assert_eq!(moves("Warm"), ["Up Operating", "Trip Alarm"]);
    assert_eq!(moves("Operating"), ["Down Warm"]);
    assert_eq!(moves("Alarm"), ["Reset Warm"]);
}

/// Chooses the items of a program for a device with these rows. Returns the item that the program reads, with its
/// sample value, and the item that it writes, with its value.
fn samples(rows: &[&str]) -> [Option<(String, i128)>; 2] {
    let rows = rows.join("\n");
    let table = format!(
        "lexibus = 1\n[device]\nname = \"D\"\nbuses = [\"modbus\"]\n[spaces.holding]\nmodbus = {{ table = \"holding\", first = 0 }}\n\
         [[chapters]]\ntitle = \"Operation\"\nspace = \"holding\"\ndefaults = {{ unit = \"mm\", type = \"i16\" }}\n[chapters.registers]\n\
         {rows}\nother = {{ reg = 9, type = \"u16\", access = \"ro\" }}\n"
    );
    let program = program_of(table);
    let written = program.write.map(|(item, value)| (item.name, value));
    [program.read.map(|item| (item.name, item.sample)), written]
}

#[test]
fn values_that_a_program_reads_are_possible() {
    let read = |row: &str| samples(&[row])[0].clone().expect("a value");
    for (row, sample) in [
        ("height = { reg = 1, access = \"ro\" }", 1),
        ("height = { reg = 1, access = \"ro\", max = -3 }", -3),
        ("height = { reg = 1, access = \"ro\", min = 50, max = 60 }", 50),
        ("height = { reg = 1, access = \"ro\", min = 50, max = 60, allowed = [\"52..58\"] }", 52),
        ("height = { reg = 1, access = \"ro\", allowed = [0, 5] }", 0),
    ] {
        assert_eq!(read(row), ("height".to_owned(), sample), "{row}");
    }
    // The program reads another item, because no value of this type is within the limits.
    assert_eq!(read("height = { reg = 1, access = \"ro\", min = 40000, max = 50000 }").0, "other");
    assert_eq!(read("height = { reg = 1, access = \"ro\", min = 4, max = 3 }").0, "other");
}

#[test]
fn a_program_moves_to_a_possible_position() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../dictionaries/demo-drive.eds");
    let eds = std::fs::read_to_string(file).expect("the description").replace("\r\n", "\n");
    for (low, high, target) in
        [(-1_000_000, 1_000_000, Some(100)), (-5, 50, Some(1)), (200, 300, Some(200)), (5, 4, None)]
    {
        let limits = format!("LowLimit={low}\nHighLimit={high}");
        let limited = eds.replacen("LowLimit=-1000000\nHighLimit=1000000", &limits, 1);
        let compilation = check(Source::new("drive.eds", limited.into_bytes()), &Options::default());
        let catalog = compilation.catalog.as_ref().expect("a catalog");
        let program = program(&catalog.devices[0], &catalog.files[0], None).expect("a program");
        assert_eq!(program.cia402.and_then(|cia402| cia402.target), target, "{limits}");
    }
}

#[test]
fn values_that_a_program_writes_are_possible() {
    let possible = "speed = { reg = 2, access = \"rw\", min = 1, max = 9, default = 7 }";
    let written = |row: &str| samples(&[row, possible])[1].clone();
    let speed = Some(("speed".to_owned(), 7));
    assert_eq!(
        written("ramp = { reg = 1, access = \"rw\", min = 1, max = 9, default = 2 }"),
        Some(("ramp".to_owned(), 2))
    );
    assert_eq!(
        written("ramp = { reg = 1, access = \"rw\", allowed = [2, 4], default = 2 }"),
        Some(("ramp".to_owned(), 2))
    );
    for row in [
        "ramp = { reg = 1, access = \"rw\", min = 1, max = 9, default = 10 }",
        "ramp = { reg = 1, access = \"rw\", allowed = [2, 4], default = 3 }",
        "ramp = { reg = 1, access = \"rw\", writable = [2, 4], default = 3 }",
        "ramp = { reg = 1, access = \"rw\", default = 40000 }",
        "ramp = { reg = 1, access = \"ro\", default = 2 }",
    ] {
        assert_eq!(written(row), speed, "{row}");
    }
}

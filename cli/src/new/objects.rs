//! The files of a crate for a device with objects or registers.

use askama::Template;
use lexibus_codegen::backend::rust::{self, Program, ProgramItem, ProgramMachine, Simulation};
use lexibus_codegen::ir::{self, Device};

use super::files::Files;
use super::layout::{self, At};
use super::package::{render, Package};
use super::text::{doc, printed};
use crate::args::Bus;
use crate::Failure;

/// Names of the functions that a driver can have in addition to the functions for its items.
const METHODS: [&str; 5] = ["new", "bindings", "enable", "move_to", "set_mode"];

#[derive(Template)]
#[template(path = "crate/objects_lib.rs.txt", escape = "none")]
struct Library<'l> {
    title: String,
    driver: &'l str,
    bus: &'l BusNames,
    machine: Option<&'l Machine<'l>>,
    /// Reason why the driver does not enable a device with a state machine; otherwise, `None`.
    not_enabled: Option<String>,
    /// Method of the bindings that returns the operations of CiA 402.
    motion: Option<&'l str>,
    /// Expression that sets the mode of operation.
    set_mode: String,
    is_positioning: bool,
    items: &'l [Item],
    /// Imports from the runtime.
    runtime_import: String,
}

#[derive(Template)]
#[template(path = "crate/objects_example.rs.txt", escape = "none")]
struct Example<'e> {
    library: &'e str,
    bus: &'e BusNames,
    machine: Option<&'e Machine<'e>>,
    /// Position, as a raw value, to which the program moves the axis.
    target: Option<i128>,
    /// Statement that reads the actual position.
    position: Option<String>,
    items: &'e [Item],
}

#[derive(Template)]
#[template(path = "crate/objects_support.rs.txt", escape = "none")]
struct Support<'s> {
    library: &'s str,
    machine: Option<&'s Machine<'s>>,
    simulation: Option<&'s Simulation>,
    /// Import of the command type under the name `Command`.
    commands_import: String,
}

#[derive(Template)]
#[template(path = "crate/objects_test.rs.txt", escape = "none")]
struct Test<'t> {
    library: &'t str,
    bus: &'t BusNames,
    machine: Option<&'t Machine<'t>>,
    items: &'t [Item],
    /// Imports from the runtime.
    runtime_import: String,
}

/// Names of a bus in texts and in code.
struct BusNames {
    title: &'static str,
    type_name: &'static str,
    /// A client of the bus.
    client: &'static str,
    /// Cargo feature of the runtime that enables the client.
    feature: &'static str,
}

const CANOPEN: BusNames = BusNames {
    title: "CANopen",
    type_name: "CanOpen",
    client: "`lexibus::clients::canopen::Node`",
    feature: "canopen",
};
const COE: BusNames =
    BusNames { title: "EtherCAT", type_name: "CoE", client: "`lexibus::clients::ethercat::Sdo`", feature: "ethercat" };
const MODBUS: BusNames = BusNames {
    title: "Modbus",
    type_name: "Modbus",
    client: "`lexibus::clients::modbus::ModbusClient`",
    feature: "modbus",
};

/// Rust identifiers of a state machine.
struct Machine<'m> {
    walk: &'m str,
    target: &'m str,
    status: &'m str,
    /// Import of the state type under the name `State`.
    states_import: String,
}

/// An item that the driver reads or writes.
struct Item {
    method: String,
    verb: &'static str,
    title: String,
    /// Call that accesses the value.
    access: String,
    /// A space and the unit in parentheses, or an empty text.
    unit: String,
    constant: String,
    native: &'static str,
    value: i128,
    is_write: bool,
    /// Argument of `println`.
    printed: String,
}

pub(super) fn write(package: &Package, device: &Device, bus: Option<Bus>, files: &mut Files) -> Result<(), Failure> {
    let file = package.catalog.files.first();
    let asked = bus.map(bus_of);
    let program = file.and_then(|file| rust::program(device, file, asked)).ok_or_else(|| no_program(asked))?;
    let bus = match program.bus {
        ir::Bus::EtherCat => &COE,
        ir::Bus::Modbus => &MODBUS,
        _ => &CANOPEN,
    };
    let (found, not_enabled) = match &program.machine {
        Some(Ok(machine)) => (Some(machine), None),
        Some(Err(reason)) => (None, Some(reason.to_string())),
        None => (None, None),
    };
    let machine = found.map(Machine::new);
    let machine = machine.as_ref();
    let cia402 = program.cia402.as_ref();
    let is_positioning = cia402.is_some_and(|cia402| cia402.positioning);
    let items = items(&program);
    let (library, driver) = (package.library.as_str(), program.driver.as_str());
    let motion = cia402.map(|cia402| cia402.method.as_str());
    let position = cia402.and_then(|cia402| cia402.position.as_deref()).map(|call| {
        let calls: Vec<&str> = ["bindings()"].into_iter().chain(call.split('.')).chain(["read()?"]).collect();
        layout::chain(At(4, "let position = "), "driver", &calls, ";")
    });
    let set_mode = chain(&format!("{}()", motion.unwrap_or_default()), "set_mode(mode, deadline)");
    let simulation = found.and_then(|machine| machine.simulation.as_ref());
    let commands_import = simulation.map_or_else(String::new, |simulation| import(&simulation.commands, "Command"));
    let title = doc(&package.title);
    let of_machine = |names: &[&'static str]| machine.map_or(Vec::new(), |_| names.to_vec());
    let access = if items.is_empty() { &[][..] } else { &["AccessError"] };
    let runtime_import = imports([access, &["Client", bus.type_name], &of_machine(&["WalkError"])].concat());
    let lib = Library {
        title,
        driver,
        bus,
        machine,
        not_enabled,
        motion,
        set_mode,
        is_positioning,
        items: &items,
        runtime_import,
    };
    files.text("src/lib.rs", render(&lib)?);
    let target = cia402.filter(|cia402| cia402.positioning).and_then(|cia402| cia402.target);
    let example = Example { library, bus, machine, target, position, items: &items };
    files.text("examples/simulated.rs", render(&example)?);
    files.text("tests/support/mod.rs", render(&Support { library, machine, simulation, commands_import })?);
    let runtime_import = imports([&[bus.type_name][..], &of_machine(&["MachineState", "StateWord"])].concat());
    files.text("tests/simulated.rs", render(&Test { library, bus, machine, items: &items, runtime_import })?);
    Ok(())
}

fn bus_of(bus: Bus) -> ir::Bus {
    match bus {
        Bus::Modbus => ir::Bus::Modbus,
        Bus::Canopen => ir::Bus::CanOpen,
        Bus::Ethercat => ir::Bus::EtherCat,
    }
}

fn no_program(bus: Option<ir::Bus>) -> Failure {
    Failure::Usage(match bus {
        Some(bus) => format!("the device has no number that a client of the bus `{bus}` can access"),
        None => "the device has no number that a client of CANopen, EtherCAT or Modbus can access".to_owned(),
    })
}

/// Returns the list of imported names in the order of `rustfmt`.
fn imports(mut names: Vec<&str>) -> String {
    names.sort_unstable();
    match names.as_slice() {
        [name] => (*name).to_owned(),
        names => format!("{{{}}}", names.join(", ")),
    }
}

/// Returns a chain of calls in a method of the driver.
fn chain(call: &str, last: &str) -> String {
    let calls: Vec<&str> = ["bindings"].into_iter().chain(call.split('.')).chain([last]).collect();
    layout::chain(At(8, ""), "self", &calls, "")
}

/// Returns the name of a type for an import from the bindings, renamed to `name` if necessary.
fn import(ty: &str, name: &str) -> String {
    if ty == name {
        ty.to_owned()
    } else {
        format!("{ty} as {name}")
    }
}

impl<'m> Machine<'m> {
    fn new(machine: &'m ProgramMachine) -> Self {
        let ProgramMachine { walk, states, target, status, .. } = machine;
        Machine { walk, target, status, states_import: import(states, "State") }
    }

    /// Returns the expression that brings the state machine to the target state.
    fn enable(&self) -> String {
        let walk = format!("{}(target, deadline)", self.walk);
        layout::chain(At(8, ""), "self", &["bindings", &walk], "")
    }

    /// Returns the statement that checks that the state is the target state.
    fn check(&self) -> String {
        let target = format!("Some(State::{})", self.target);
        layout::call(At(4, ""), "assert_eq!", &["state", &target], ";")
    }

    fn get_status(&self) -> String {
        layout::call(At(4, "let status = "), "device.get", &[self.status], "?;")
    }
}

impl Support<'_> {
    fn initialize(&self, simulation: &Simulation) -> String {
        let state = format!("State::{}", simulation.initial);
        layout::call(At(4, ""), "set_state", &["&mut device", &state], "?;")
    }

    fn transition(&self, transition: &(String, String, String)) -> String {
        let (from, command, to) = transition;
        let [from, command, to] = [format!("State::{from}"), format!("Command::{command}"), format!("State::{to}")];
        layout::call(At(4, ""), "", &[&from, &command, &to], ",")
    }

    fn get_status(&self, simulation: &Simulation) -> String {
        layout::call(At(8, "let status = "), "device.get", &[&simulation.status], "?;")
    }

    fn set_status(&self, simulation: &Simulation) -> String {
        layout::call(At(4, ""), "device.set", &[&simulation.status, "status"], "")
    }
}

impl Item {
    /// Returns the signature of the driver's method for this item.
    fn signature(&self) -> String {
        let (value, result) = if self.is_write { (Some(self.native), "()") } else { (None, self.native) };
        layout::method(&self.method, value, &format!("Result<{result}, AccessError<C::Error>>"))
    }

    /// Returns the statement that reads the value through the driver.
    fn read(&self) -> String {
        layout::chain(At(4, "let value = "), "driver", &[&format!("{}()?", self.method)], ";")
    }

    /// Returns the statement that writes the value through the driver.
    fn write(&self) -> String {
        layout::chain(At(4, ""), "driver", &[&format!("{}({})?", self.method, self.value)], ";")
    }

    /// Returns the statement that sets the value in the simulated device.
    fn set(&self) -> String {
        layout::call(At(4, ""), "device.set", &[&self.constant, &self.value.to_string()], "?;")
    }

    /// Returns the statement that checks the value in the simulated device.
    fn check(&self) -> String {
        let get = format!("device.get({})?", self.constant);
        layout::call(At(4, ""), "assert_eq!", &[&get, &self.value.to_string()], ";")
    }

    fn print(&self) -> String {
        layout::call(At(4, ""), "println!", &[&self.printed], ";")
    }
}

/// Returns the items that the driver reads and writes.
fn items(program: &Program) -> Vec<Item> {
    let read = program.read.as_ref().map(|read| item(read, read.sample, false));
    let write = program.write.as_ref().map(|(write, value)| item(write, *value, true));
    read.into_iter().chain(write).collect()
}

fn item(item: &ProgramItem, value: i128, is_write: bool) -> Item {
    let call = item.call.as_str();
    let name = call.trim_end_matches("()").rsplit('.').next().unwrap_or_default().trim_start_matches("r#");
    let prefix = if is_write { "set_" } else { "" };
    let suffix = if !is_write && METHODS.contains(&name) { "_value" } else { "" };
    let unit = if item.unit.is_empty() { String::new() } else { format!(" ({})", item.unit) };
    let shown = if is_write { value.to_string() } else { "{value}".to_owned() };
    let plain = format!("{prefix}{name}{suffix}");
    Item {
        method: lexibus_codegen::names::escaped(&plain),
        verb: if is_write { "Writes" } else { "Reads" },
        title: doc(&item.name),
        access: chain(call, if is_write { "write(value)" } else { "read()" }),
        unit: doc(&unit),
        constant: item.constant.clone(),
        native: item.native,
        value,
        is_write,
        printed: printed(&format!("{}{unit}", item.name), &shown),
    }
}

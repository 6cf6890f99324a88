//! Methods of the device that lead a state machine to a state.

use super::code::Doc;
use super::constants::{accesses, bound, Constant, Constants};
use super::docs;
use super::machine::MachineModel;
use super::method_names::{reserved, unused_name};
use super::naming::machines::NamedMachine;
use crate::ir::{ItemRef, StateMachine};
use crate::names::{self, Case, NameRequest};

/// A method that leads a state machine to a state, ready to be printed.
pub(super) struct WalkModel {
    pub method: String,
    pub docs: Vec<String>,
    /// Position of the state machine in the list of all named state machines.
    pub machine: usize,
    /// Name of the Rust enum that contains the states.
    pub states: String,
    /// Variant of the state "Operation enabled" of CiA 402, if the machine has it.
    pub energized: Option<String>,
    /// Path of the constant of the status item.
    pub status: String,
    /// Path of the constant of the control item.
    pub control: String,
    /// True if a client can read the control item.
    pub reads_control: bool,
    /// Path of the constant of the item that contains the error code.
    pub code: Option<String>,
    /// Trait bounds of the location types.
    pub bounds: Vec<Doc>,
}

/// Returns the methods for the machines with transitions that a program can trigger or wait for. `machines` are the
/// machines of the context, ready to be printed.
pub(super) fn models(constants: &Constants<'_, '_>, machines: &[MachineModel]) -> Vec<WalkModel> {
    let all = constants.context.names.types.machines.iter().zip(machines).enumerate();
    let named = all.filter(|(_, (_, model))| model.has_transitions());
    let count = named.clone().count();
    let mut used: Vec<String> = reserved().map(str::to_owned).collect();
    used.extend(constants.objects.iter().map(|object| object.name.clone()));
    let lower = |(position, (named, model)): (usize, (&NamedMachine<'_>, &MachineModel))| {
        let name = if count == 1 { "walk".to_owned() } else { format!("walk {}", named.machine.name) };
        let request = NameRequest { name: &name, fallback: "walk".to_owned(), suffix: String::new() };
        let name = names::identifier(&request, Case::Snake);
        let method = unused_name(|name| used.contains(name), name);
        used.extend([method.clone(), format!("{method}_async")]);
        let walk = walk(constants, named, model.energized.clone(), method)?;
        Some(WalkModel { machine: position, ..walk })
    };
    named.filter_map(lower).collect()
}

/// Creates the method of a state machine. Returns `None` if the status item or the control item has no suitable constant
/// (see [`word`]). Also returns `None` if a client cannot read the status item or cannot write the control item.
fn walk(
    constants: &Constants<'_, '_>,
    named: &NamedMachine<'_>,
    energized: Option<String>,
    method: String,
) -> Option<WalkModel> {
    let machine = named.machine;
    let (status, control) = (word(constants, &machine.status_item)?, word(constants, &machine.control_item)?);
    if !status.is_readable() || !control.is_writable() {
        return None;
    }
    let reads_control = control.is_readable();
    let accesses =
        accesses([(status.location.as_str(), (true, false)), (control.location.as_str(), (reads_control, true))]);
    // Use the error code only if its item has the same location type as an item that the method reads. Otherwise, the
    // error code would restrict the buses of the method.
    let code =
        constants.error_code().filter(|code| accesses.get(code.location.as_str()).is_some_and(|access| access.0));
    let bounds = accesses.iter().map(|(location, access)| bound(location, "C::Bus", *access)).collect();
    let error_code = code.as_ref().map(|code| constants.link(code)).unwrap_or_default();
    let (status_link, control_link) = (constants.link(&status), constants.link(&control));
    let other_bits = if reads_control { "do not change" } else { "are 0" };
    let docs = documentation(machine, &status_link, &control_link, other_bits, &error_code);
    Some(WalkModel {
        method,
        docs,
        machine: 0,
        states: named.states.clone(),
        energized,
        status: status.path,
        control: control.path,
        reads_control,
        code: code.map(|code| code.path),
        bounds,
    })
}

/// Returns the constant of a status item or control item. Returns `None` if the item is not an integer of 8, 16 or 32 bits, or
/// if it has a unit or a scale.
fn word<'c>(constants: &'c Constants<'_, '_>, reference: &ItemRef) -> Option<Constant<'c>> {
    constants.integer(&|model| Some(model.id) == reference.id).filter(|constant| !constant.is_quantity)
}

/// Returns the documentation of the method. `status`, `control` and `code` are links to the status item, the control
/// item and the item that contains the error code. `other_bits` states whether the other bits of the control item keep their
/// values or are 0. If no item contains the error code, `code` is empty.
fn documentation(machine: &StateMachine, status: &str, control: &str, other_bits: &str, code: &str) -> Vec<String> {
    let mut lines = vec![
        format!("Leads the state machine \"{}\" to the state `target`.", docs::escape(&machine.name)),
        String::new(),
        format!(
            "The method reads {status}, writes the commands to {control} and waits for transitions of the device. The method \
             first resets a fault that is already active. Other bits of {control} {other_bits}. Use [`rt::Walker`] instead if \
             the device receives {control} in process data."
        ),
        String::new(),
        "# Errors".to_owned(),
        String::new(),
    ];
    let code = if code.is_empty() { String::new() } else { format!(" and the error code from {code}") };
    lines.push(format!(
        "Returns an error if an access fails, a fault occurs on the way (the error contains the state{code}), no command leads to \
         the state, or the device does not reach the state within the time `deadline`."
    ));
    lines
}

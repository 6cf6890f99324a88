//! Names of state machines: types of states and commands, and the bit field methods for reading and writing them.

use crate::ir::StateMachine;
use crate::names::{self, Case, NameRequest};

/// A state machine and its names.
pub(in crate::backend::rust) struct NamedMachine<'a> {
    pub machine: &'a StateMachine,
    /// Name of the state type.
    pub states: String,
    /// Name of the command type.
    pub commands: String,
    /// Name of the bit field method that returns the state.
    pub getter: String,
    /// Name of the bit field function that creates the bit field from a state.
    pub constructor: String,
    /// Name of the bit field method that returns the command.
    pub command_getter: String,
    /// Name of the bit field method that returns a copy with the given command.
    pub command_setter: String,
}

/// Returns the preferred names for the types of states and commands. The names are `State` and `Command` if the device
/// has one machine and no other type with these names.
pub(super) fn type_names(machines: &[StateMachine], is_used: &dyn Fn(&str) -> bool) -> Vec<[String; 2]> {
    let is_simple = |name: &str| machines.len() == 1 && !is_used(name);
    let name = |machine: &StateMachine, simple: &str, kind: &str| match is_simple(simple) {
        true => simple.to_owned(),
        false => format!("{} {kind}", machine.name),
    };
    machines.iter().map(|machine| [name(machine, "State", "state"), name(machine, "Command", "command")]).collect()
}

/// Returns the machines with the names of their types and methods.
pub(super) fn names<'a>(
    machines: &'a [StateMachine],
    types: &mut impl Iterator<Item = String>,
) -> Vec<NamedMachine<'a>> {
    let type_names = type_names(machines, &|_| false);
    let name_request = |name| NameRequest { name, fallback: "machine".to_owned(), suffix: "machine".to_owned() };
    let name_requests = type_names.iter().flatten().map(|name| name_request(name));
    let mut methods = names::unique(name_requests, &[], Case::Snake).into_iter();
    let mut method = || methods.next().unwrap_or_default();
    let mut ty = || types.next().unwrap_or_default();
    let named = machines.iter().map(|machine| {
        let (getter, command_getter) = (method(), method());
        let constructor = names::prefixed("from_", &getter);
        let command_setter = names::prefixed("with_", &command_getter);
        NamedMachine { machine, states: ty(), commands: ty(), getter, constructor, command_getter, command_setter }
    });
    named.collect()
}

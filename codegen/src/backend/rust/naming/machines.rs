//! The names of state machines: the types of their states and commands, and the methods of bit fields that read and write them.

use crate::ir::StateMachine;
use crate::names::{self, Case, Wish};

/// A state machine and its names.
pub(in crate::backend::rust) struct NamedMachine<'a> {
    pub machine: &'a StateMachine,
    /// The type of its states.
    pub states: String,
    /// The type of its commands.
    pub commands: String,
    /// The method of a bit field that gives the state.
    pub getter: String,
    /// The method of a bit field that gives the command, and the one that takes it.
    pub command_getter: String,
    pub command_setter: String,
}

/// What the types of states and of commands are to be called: simply so, where there is one machine and no other type of
/// that name.
pub(super) fn wished(machines: &[StateMachine], is_used: &dyn Fn(&str) -> bool) -> Vec<[String; 2]> {
    let is_simple = |name: &str| machines.len() == 1 && !is_used(name);
    let name = |machine: &StateMachine, simple: &str, kind: &str| match is_simple(simple) {
        true => simple.to_owned(),
        false => format!("{} {kind}", machine.name),
    };
    machines.iter().map(|own| [name(own, "State", "state"), name(own, "Command", "command")]).collect()
}

/// The machines, whose types have these names.
pub(super) fn names<'a>(
    machines: &'a [StateMachine],
    types: &mut impl Iterator<Item = String>,
) -> Vec<NamedMachine<'a>> {
    let wished = wished(machines, &|_| false);
    let wish = |name| Wish { name, fallback: "machine".to_owned(), suffix: "machine".to_owned() };
    let wishes: Vec<Wish<'_>> = wished.iter().flatten().map(|name| wish(name)).collect();
    let mut methods = names::unique(&wishes, &[], Case::Snake).into_iter();
    let mut method = || methods.next().unwrap_or_default();
    let mut ty = || types.next().unwrap_or_default();
    let named = machines.iter().map(|machine| {
        let (getter, command_getter) = (method(), method());
        let command_setter = names::prefixed("with_", &command_getter);
        NamedMachine { machine, states: ty(), commands: ty(), getter, command_getter, command_setter }
    });
    named.collect()
}

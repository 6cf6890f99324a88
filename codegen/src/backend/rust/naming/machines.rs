//! The names of state machines: the types of their states and commands, and the methods of bit fields that read and write them.

use crate::ir::StateMachine;
use crate::names::{self, Case, Wish};

/// What the types of states and of commands are to be called: simply so, where there is one machine and no other type of
/// that name.
pub(in crate::backend::rust) fn names(machines: &[StateMachine], is_taken: &dyn Fn(&str) -> bool) -> Vec<[String; 2]> {
    let is_simple = |name: &str| machines.len() == 1 && !is_taken(name);
    let name = |machine: &StateMachine, simple: &str, kind: &str| match is_simple(simple) {
        true => simple.to_owned(),
        false => format!("{} {kind}", machine.name),
    };
    machines.iter().map(|own| [name(own, "State", "state"), name(own, "Command", "command")]).collect()
}

/// The methods that bit fields get, those of commands without their `with_`.
pub(in crate::backend::rust) fn methods(machines: &[StateMachine]) -> Vec<[String; 2]> {
    let names = names(machines, &|_| false);
    let wishes: Vec<Wish<'_>> = names
        .iter()
        .flatten()
        .map(|name| Wish { name, fallback: "machine".to_owned(), suffix: "machine".to_owned() })
        .collect();
    let mut methods = names::unique(&wishes, &[], Case::Snake).into_iter();
    machines.iter().map(|_| [methods.next().unwrap_or_default(), methods.next().unwrap_or_default()]).collect()
}

/// The method that gives a command, by its name in [`methods`].
pub(in crate::backend::rust) fn setter(command: &str) -> String {
    names::prefixed("with_", command)
}

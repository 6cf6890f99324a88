//! States with a special meaning in state machines.

use crate::ir::{StateMachine, Transition};

/// Returns the names of the fault states. An automatic transition from any state is a reaction to a fault, so its target and the
/// states that follow the target automatically are fault states. The states that the source lists as fault states are added
/// without their successors, because a device can leave a fault state automatically.
pub fn fault_states(machine: &StateMachine) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    loop {
        let is_entered = |transition: &&Transition| {
            let from = transition.from.as_deref();
            transition.command.is_none()
                && from.is_none_or(|from| names.contains(&from))
                && !names.contains(&transition.to.as_str())
        };
        let Some(transition) = machine.transitions.iter().find(is_entered) else { break };
        names.push(&transition.to);
    }
    for fault in &machine.faults {
        if !names.contains(&fault.as_str()) {
            names.push(fault);
        }
    }
    names
}

/// Returns whether a state is "Operation enabled" of CiA 402, in which the drive is energized.
pub fn is_energized(state: &str) -> bool {
    state.replace('_', " ").eq_ignore_ascii_case("operation enabled")
}

//! States with a special meaning in state machines.

use crate::ir::{StateMachine, StateRef, Transition};

/// Returns the fault states. An automatic transition from any state is a reaction to a fault. Its target and the states that follow
/// the target automatically are therefore fault states. The states that the source lists as fault states are added without their
/// successors, because a device can leave a fault state automatically.
pub fn fault_states(machine: &StateMachine) -> Vec<&StateRef> {
    let mut faults: Vec<&StateRef> = Vec::new();
    loop {
        let is_entered = |transition: &&Transition| {
            let from = transition.from.as_ref();
            transition.command.is_none()
                && from.is_none_or(|from| faults.contains(&from))
                && !faults.contains(&&transition.to)
        };
        let Some(transition) = machine.transitions.iter().find(is_entered) else { break };
        faults.push(&transition.to);
    }
    for fault in &machine.faults {
        if !faults.contains(&fault) {
            faults.push(fault);
        }
    }
    faults
}

/// Returns whether a state is "Operation enabled" of CiA 402, in which the drive is energized.
pub fn is_energized(state: &str) -> bool {
    state.replace('_', " ").eq_ignore_ascii_case("operation enabled")
}

//! The behavior of a simulated state machine: the transitions that follow each command.

use super::machine::MachineModel;
use super::naming::machines::NamedMachine;
use super::walk::WalkModel;
use crate::ir::Transition;

/// Behavior of a simulated device with a state machine. States and commands are the names of variants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Simulation {
    /// Path of the constant of the status item.
    pub status: String,
    /// Path of the constant of the control item.
    pub control: String,
    /// Type of the commands, in the module `types`.
    pub commands: String,
    /// State after power-on.
    pub initial: String,
    /// Transitions that a command causes: the state before, the command, and the state after all automatic transitions.
    pub transitions: Vec<(String, String, String)>,
}

impl Simulation {
    /// Returns the state that needs the most commands after power-on.
    pub(super) fn farthest(&self) -> String {
        let mut reached = vec![self.initial.as_str()];
        let mut at = 0;
        while let Some(state) = reached.get(at) {
            let next: Vec<&str> = self
                .transitions
                .iter()
                .filter(|(from, _, to)| from == state && !reached.contains(&to.as_str()))
                .map(|(.., to)| to.as_str())
                .collect();
            for state in next {
                if !reached.contains(&state) {
                    reached.push(state);
                }
            }
            at += 1;
        }
        reached.last().map_or_else(String::new, |state| (*state).to_owned())
    }
}

/// Returns the behavior of a state machine. Returns `None` if the states or commands of the machine are no bit patterns.
pub(super) fn of(named: &NamedMachine<'_>, model: &MachineModel, walk: &WalkModel) -> Option<Simulation> {
    let machine = named.machine;
    let (states, commands) = (model.states.as_ref()?, model.commands.as_ref()?);
    let (state_names, command_names) = (states.by_name(), commands.by_name());
    let state = |name: &str| state_names.get(name).cloned();
    let settled = |name| settled(&machine.transitions, name);
    let first = machine.initial.as_deref().or_else(|| machine.states.first().map(|state| state.name.as_str()))?;
    let mut transitions = Vec::new();
    for transition in machine.transitions.iter() {
        let Some(command) = transition.command.as_ref().and_then(|name| command_names.get(name.as_str())) else {
            continue;
        };
        let Some(to) = state(settled(&transition.to)) else { continue };
        let from: Vec<String> = match &transition.from {
            Some(from) => state(from).into_iter().collect(),
            None => states.patterns.iter().map(|pattern| pattern.name.clone()).collect(),
        };
        transitions.extend(from.into_iter().map(|from| (from, command.clone(), to.clone())));
    }
    Some(Simulation {
        status: walk.status.clone(),
        control: walk.control.clone(),
        commands: commands.name.clone(),
        initial: state(settled(first))?,
        transitions,
    })
}

/// Returns the state in which the device is after the automatic transitions from `state`.
fn settled<'t>(transitions: &'t [Transition], state: &'t str) -> &'t str {
    let mut state = state;
    // A cycle of automatic transitions ends after as many steps as there are transitions.
    for _ in transitions {
        let automatic =
            |transition: &&Transition| transition.command.is_none() && transition.from.as_deref() == Some(state);
        match transitions.iter().find(automatic) {
            Some(transition) => state = &transition.to,
            None => break,
        }
    }
    state
}

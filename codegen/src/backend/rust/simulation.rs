//! The behavior of a simulated state machine: the transitions that follow each command.

use super::machine::{MachineModel, StepModel};
use super::target::Path;
use super::walk::WalkModel;

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

/// Returns the behavior of a state machine. The simulated device makes a transition without a command only on the
/// shortest path to the target state. It makes no such transition from a state in which a command leads closer to the
/// target. Returns `None` if the machine has no commands that are bit patterns.
pub(super) fn of(model: &MachineModel, walk: &WalkModel, path: &Path<'_>) -> Option<Simulation> {
    let transition =
        |step: &StepModel| Some((step.from.clone(), step.command.clone()?, path.settled(&step.to).to_owned()));
    Some(Simulation {
        status: walk.status.clone(),
        control: walk.control.clone(),
        commands: model.commands.as_ref()?.name.clone(),
        initial: path.settled(path.initial).to_owned(),
        transitions: model.steps.iter().filter_map(transition).collect(),
    })
}

//! The state to which a new program leads a state machine, and the path of the device to this state.

use std::fmt;

use super::machine::{MachineModel, StepModel};
use crate::collections::HashMap;
use crate::ir::StateMachine;

/// Names of states in which a device operates, in order of preference: states without motion come first. The state
/// "operation enabled" of CiA 402 takes precedence over all of them.
const OPERATING: [&str; 7] = ["enabled", "operational", "operating", "operation", "in operation", "running", "moving"];

/// Maximum number of transitions that the runtime takes into account (`src/machine.rs`).
const MAX_TRANSITIONS: usize = 128;

/// Reason why a new program does not lead a state machine to its operating state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoTarget {
    /// The compiler recognizes no state by its name as an operating state. Fault states are not considered.
    Name,
    /// No sequence of commands leads from the first state to the second one without entering a fault state. The texts
    /// are names of variants.
    Path(String, String),
}

impl fmt::Display for NoTarget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoTarget::Name => {
                write!(f, "no state without a fault has a name such as \"operation enabled\"")?;
                OPERATING.iter().try_for_each(|name| write!(f, ", \"{name}\""))
            }
            NoTarget::Path(from, to) => write!(f, "no commands lead from `{from}` to `{to}` without a fault"),
        }
    }
}

/// A path to the operating state. The path enters no fault state, and is the path that a `Walker` of the runtime takes.
/// States are names of variants.
pub(super) struct Path<'m> {
    /// State after power-on.
    pub initial: &'m str,
    pub target: &'m str,
    steps: Vec<&'m StepModel>,
    /// Number of transitions from each state to the target.
    distances: HashMap<&'m str, usize>,
}

impl<'m> Path<'m> {
    /// Returns the path to the operating state of a machine.
    pub(super) fn to_operation(machine: &StateMachine, model: &'m MachineModel) -> Result<Self, NoTarget> {
        let states = model.states.as_ref().ok_or(NoTarget::Name)?;
        let is_fault = |variant: &str| model.faults.iter().any(|fault| fault == variant);
        let healthy = || states.patterns.iter().filter(|state| !is_fault(&state.name));
        let by_name = |name: &&str| healthy().find(|state| state.title.eq_ignore_ascii_case(name));
        let named = || OPERATING.iter().find_map(by_name).map(|state| state.name.as_str());
        let energized = model.energized.as_deref().filter(|state| !is_fault(state));
        let target = energized.or_else(named).ok_or(NoTarget::Name)?;
        let stated = machine.initial.as_ref().and_then(|state| states.state(state));
        let first = || healthy().map(|state| state.name.as_str()).find(|state| *state != target);
        let initial = stated.or_else(first).unwrap_or(target);
        let enters_fault = |step: &StepModel| is_fault(&step.to) && !is_fault(&step.from);
        let steps: Vec<_> = model.steps.iter().take(MAX_TRANSITIONS).filter(|step| !enters_fault(step)).collect();
        let path = Path { initial, target, distances: distances(&steps, target), steps };
        match path.distances.contains_key(initial) {
            true => Ok(path),
            false => Err(NoTarget::Path(initial.to_owned(), target.to_owned())),
        }
    }

    /// Returns the state that the device reaches from `state` by automatic transitions on its path to the target. The
    /// device stays in the first state in which it needs a command.
    pub(super) fn settled(&self, state: &'m str) -> &'m str {
        let mut state = state;
        // The loop ends, because each transition reduces the distance to the target.
        while let Some(next) = self.automatic(state) {
            state = next;
        }
        state
    }

    fn automatic(&self, state: &str) -> Option<&'m str> {
        let distance = self.distances.get(state)?;
        let is_next = |step: &&&'m StepModel| {
            step.from == state && self.distances.get(step.to.as_str()).is_some_and(|to| to + 1 == *distance)
        };
        let mut next = self.steps.iter().filter(is_next);
        // The walker prefers commands.
        match next.clone().any(|step| step.command.is_some()) {
            true => None,
            false => next.next().map(|step| step.to.as_str()),
        }
    }
}

/// Returns the number of transitions from each state to the target. States without a path to the target are left out.
fn distances<'m>(steps: &[&'m StepModel], target: &'m str) -> HashMap<&'m str, usize> {
    let mut distances = HashMap::from_iter([(target, 0)]);
    for distance in 1..=steps.len() {
        let is_before = |step: &&&StepModel| distances.get(step.to.as_str()) == Some(&(distance - 1));
        let before: Vec<&str> = steps.iter().filter(is_before).map(|step| step.from.as_str()).collect();
        for state in before {
            distances.entry(state).or_insert(distance);
        }
    }
    distances
}

//! State machines: the shortest path from one state to another, and the commands that move a device along this path.

mod walk;
mod walker;
mod word;

pub use walk::{Machine, WalkError};
pub use walker::{MachineState, Stopped, Walked, Walker};
pub use word::StateWord;

/// A transition of a device's state machine. States are represented by numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transition<C> {
    from: u8,
    to: u8,
    command: Option<C>,
}

impl<C> Transition<C> {
    /// Creates a transition that `command` triggers, or an automatic transition if `command` is `None`.
    #[must_use]
    pub const fn new(from: u8, to: u8, command: Option<C>) -> Self {
        Self { from, to, command }
    }
}

/// Next step on the path of a device to a target state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step<C> {
    /// The device is already in the target state.
    Reached,
    /// Send this command to the device.
    Command(C),
    /// Wait until the device changes its state automatically.
    Wait,
    /// No allowed path leads to the target state; see [`toward`](Self::toward).
    Unreachable,
}

/// Maximum number of transitions. Further transitions are ignored. The compiler has the same limit
/// (`codegen/src/backend/rust/target.rs`).
const MAX_TRANSITIONS: usize = 128;

impl<C: Copy> Step<C> {
    /// Returns the first step of the shortest path from `state` to `target`.
    ///
    /// The path enters an energized state only if this state is the target. A transition from a state without a fault
    /// to a fault state is part of the path only if the fault state is the target. If several paths have the same
    /// length, a path that starts with a command is preferred.
    #[must_use]
    pub fn toward<S: MachineState<Command = C>>(state: S, target: S) -> Self
    where
        C: 'static,
    {
        Self::on_path(S::TRANSITIONS, S::FAULTS, S::ENERGIZED, state.number(), target.number())
    }

    fn on_path(transitions: &[Transition<C>], faults: &[u8], energized: &[u8], state: u8, target: u8) -> Self {
        if state == target {
            return Step::Reached;
        }
        let transitions = transitions.get(..MAX_TRANSITIONS).unwrap_or(transitions);
        // Bit set of the transitions from which the target can be reached in at most the current number of steps.
        let mut leads: u128 = 0;
        loop {
            let mut more = leads;
            for (at, transition) in transitions.iter().enumerate() {
                let goes_on =
                    |(next, other): (usize, &Transition<C>)| leads >> next & 1 == 1 && transition.to == other.from;
                let enters_fault = faults.contains(&transition.to) && !faults.contains(&transition.from);
                let is_avoided = enters_fault || energized.contains(&transition.to);
                if transition.to == target || (!is_avoided && transitions.iter().enumerate().any(goes_on)) {
                    more |= 1 << at;
                }
            }
            if more == leads {
                return Step::Unreachable;
            }
            leads = more;
            let first = transitions
                .iter()
                .enumerate()
                .filter(|(at, transition)| leads >> at & 1 == 1 && transition.from == state);
            let mut waits = false;
            for (_, transition) in first {
                match transition.command {
                    Some(command) => return Step::Command(command),
                    None => waits = true,
                }
            }
            if waits {
                return Step::Wait;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// State 0 changes to state 1 automatically. The commands `u`, `U`, `d` and `D` lead from one of the states 1 to 3
    /// to another. The command `r` changes state 4 to state 0. No transition leads to state 4.
    const TRANSITIONS: &[Transition<char>] = &[
        Transition::new(0, 1, None),
        Transition::new(1, 2, Some('u')),
        Transition::new(2, 3, Some('U')),
        Transition::new(3, 1, Some('d')),
        Transition::new(3, 2, Some('D')),
        Transition::new(4, 0, Some('r')),
    ];

    #[test]
    fn the_shortest_way() {
        let toward = |state, target| Step::on_path(TRANSITIONS, &[], &[], state, target);
        assert_eq!(toward(2, 2), Step::Reached);
        assert_eq!(toward(1, 3), Step::Command('u'));
        assert_eq!(toward(2, 3), Step::Command('U'));
        assert_eq!(toward(3, 1), Step::Command('d'));
        assert_eq!(toward(2, 1), Step::Command('U'));
        assert_eq!(toward(0, 3), Step::Wait);
        assert_eq!(toward(4, 3), Step::Command('r'));
        assert_eq!(toward(1, 4), Step::Unreachable);
        assert_eq!(toward(1, 0), Step::Unreachable);
    }

    #[test]
    fn a_command_before_waiting() {
        let both = [Transition::new(0, 1, None), Transition::new(0, 1, Some('c'))];
        assert_eq!(Step::on_path(&both, &[], &[], 0, 1), Step::Command('c'));
        assert_eq!(Step::<char>::on_path(&[], &[], &[], 0, 1), Step::Unreachable);
    }

    #[test]
    fn no_path_through_a_fault() {
        let all =
            [Transition::new(0, 9, Some('x')), Transition::new(9, 2, Some('r')), Transition::new(0, 1, Some('u'))];
        assert_eq!(Step::on_path(&all, &[9], &[], 0, 2), Step::Unreachable);
        assert_eq!(Step::on_path(&all, &[9], &[], 0, 9), Step::Command('x'));
        assert_eq!(Step::on_path(&all, &[9], &[], 9, 2), Step::Command('r'));
    }
}

//! Reactions of a device to a message in each state.

/// A reaction to a message. `S` is the type of the device's states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome<S: 'static> {
    /// The device refuses the message.
    Refused,
    /// The device executes the message and stays in its state.
    Unchanged,
    /// The device enters the first state of this list, and then automatically enters the other states in order.
    States(&'static [S]),
}

/// The possible reactions to a message in one state.
#[derive(Clone, Copy, Debug)]
pub struct StateOutcomes<S: 'static> {
    state: S,
    outcomes: &'static [Outcome<S>],
}

impl<S> StateOutcomes<S> {
    /// Creates the reactions for `state`. `outcomes` is empty if the device description doesn't specify the reactions.
    #[must_use]
    pub const fn new(state: S, outcomes: &'static [Outcome<S>]) -> Self {
        Self { state, outcomes }
    }
}

/// The possible reactions to a message in each state of a device. Generated messages provide this table as a constant.
///
/// ```
/// use lexibus::message::{Outcome, Outcomes, StateOutcomes};
///
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// enum State {
///     Alarm,
///     Stopped,
///     Jogging,
/// }
///
/// const JOG: Outcomes<State> = Outcomes::new(&[
///     StateOutcomes::new(State::Alarm, &[Outcome::Refused]),
///     StateOutcomes::new(State::Stopped, &[Outcome::States(&[State::Jogging])]),
///     StateOutcomes::new(State::Jogging, &[Outcome::Unchanged, Outcome::Refused]),
/// ]);
///
/// assert_eq!(JOG.accepts(State::Alarm), Some(false));
/// assert_eq!(JOG.accepts(State::Stopped), Some(true));
/// // In this state, the reaction also depends on other conditions.
/// assert_eq!((JOG.accepts(State::Jogging), JOG.of(State::Jogging).len()), (None, 2));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Outcomes<S: 'static>(&'static [StateOutcomes<S>]);

impl<S> Outcomes<S> {
    /// Creates the table of the reactions to one message, with one element per state.
    #[must_use]
    pub const fn new(states: &'static [StateOutcomes<S>]) -> Self {
        Self(states)
    }
}

impl<S: PartialEq> Outcomes<S> {
    /// Returns the possible reactions in `state`, or an empty slice if the device description doesn't specify the
    /// reactions.
    #[must_use]
    pub fn of(&self, state: S) -> &'static [Outcome<S>] {
        self.0.iter().find(|row| row.state == state).map_or(&[], |row| row.outcomes)
    }

    /// Returns whether the device accepts the message in `state`. Returns `None` if the device description doesn't
    /// specify the reaction, or if the reaction depends on other conditions.
    #[must_use]
    pub fn accepts(&self, state: S) -> Option<bool> {
        let outcomes = self.of(state);
        let first = *outcomes.first()? != Outcome::Refused;
        outcomes.iter().all(|outcome| (*outcome != Outcome::Refused) == first).then_some(first)
    }
}

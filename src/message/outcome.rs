//! What a device does with a message in each of its states.

/// What happens to a message. `S` is the type of the device's states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome<S: 'static> {
    /// The device refuses it.
    Refused,
    /// It is carried out, and the state stays.
    Unchanged,
    /// It leads to the first of these states, which leads by itself to the next.
    States(&'static [S]),
}

/// What happens to a message in one state: one of these.
#[derive(Clone, Copy, Debug)]
pub struct StateOutcomes<S: 'static> {
    state: S,
    outcomes: &'static [Outcome<S>],
}

impl<S> StateOutcomes<S> {
    /// What happens in `state`; nothing where the description doesn't say.
    #[must_use]
    pub const fn new(state: S, outcomes: &'static [Outcome<S>]) -> Self {
        Self { state, outcomes }
    }
}

/// What happens to a message in each state of a device: the message's row in the table of commands and states. A constant of
/// generated messages.
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
/// // What a device does there depends on more than the state.
/// assert_eq!((JOG.accepts(State::Jogging), JOG.of(State::Jogging).len()), (None, 2));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Outcomes<S: 'static>(&'static [StateOutcomes<S>]);

impl<S> Outcomes<S> {
    /// A row of the table of commands and states.
    #[must_use]
    pub const fn new(states: &'static [StateOutcomes<S>]) -> Self {
        Self(states)
    }
}

impl<S: PartialEq> Outcomes<S> {
    /// What happens in `state`: one of these. Nothing where the description doesn't say.
    #[must_use]
    pub fn of(&self, state: S) -> &'static [Outcome<S>] {
        self.0.iter().find(|row| row.state == state).map_or(&[], |row| row.outcomes)
    }

    /// Whether the device accepts the message in `state`; `None` where the description doesn't say, or it depends.
    #[must_use]
    pub fn accepts(&self, state: S) -> Option<bool> {
        let outcomes = self.of(state);
        let first = *outcomes.first()? != Outcome::Refused;
        outcomes.iter().all(|outcome| (*outcome != Outcome::Refused) == first).then_some(first)
    }
}

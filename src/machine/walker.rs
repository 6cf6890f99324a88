//! Moves a state machine to a target state through cyclic process data, one control word per cycle.

use core::fmt;
use core::time::Duration;

use super::word::StateWord;
use super::{Step, Transition};

/// A state of a device's state machine, which the status word encodes. Generated code implements this trait.
pub trait MachineState: Copy + 'static {
    /// Type of the commands, which the control word encodes.
    type Command: Copy + 'static;

    /// Transitions that a command triggers, and automatic transitions for which a program can wait.
    const TRANSITIONS: &'static [Transition<Self::Command>];

    /// Numbers of the states that the device enters because of a fault.
    const FAULTS: &'static [u8];

    /// Numbers of the states in which the machine is energized, such as "Operation enabled" of CiA 402. A walker enters
    /// such a state only if the state is its target.
    const ENERGIZED: &'static [u8] = &[];

    /// Returns the state that the bits of a status word encode, or `None` if they match no state.
    fn of_status(bits: u32) -> Option<Self>;

    /// Returns the number that represents the state in [`TRANSITIONS`](Self::TRANSITIONS).
    fn number(self) -> u8;

    /// Returns the name of the state in the device description.
    fn name(self) -> &'static str;

    /// Returns the mask and the value of a command's bits in the control word.
    fn pattern(command: Self::Command) -> (u32, u32);

    /// Returns whether the device enters the state because of a fault.
    fn is_fault(self) -> bool {
        Self::FAULTS.contains(&self.number())
    }
}

/// Moves a state machine to a target state through cyclic process data. In each cycle, the walker computes the next
/// control word from the status word of the device.
///
/// - A command that needs a rising edge, such as a fault reset, works even if its bit is already set. In this case, the
///   walker clears the bit for one cycle before it sends the command.
/// - The walker waits for automatic transitions of the device.
/// - The walker resets a fault that is active at the start. A fault that occurs later stops the walker.
/// - The walker chooses no transition from a state without a fault to a fault state, unless the fault state is the
///   target.
/// - The walker enters an energized state, such as "Operation enabled", only if the state is its target.
/// - In the target state, the walker replaces a command that leads to another state with a command that leads to the
///   target state, if there is one.
/// - A device that leaves the target state without a command stops the walker. To continue, create a new walker.
/// - The walker doesn't change bits of the control word that belong to no command.
///
/// ```
/// # use lexibus::{MachineState, Transition, Walker};
/// # #[derive(Clone, Copy, Debug, PartialEq)]
/// # enum State { Off, On, Fault }
/// # impl MachineState for State {
/// #     type Command = (u32, u32);
/// #     const TRANSITIONS: &'static [Transition<(u32, u32)>] =
/// #         &[Transition::new(0, 1, Some((0x81, 1))), Transition::new(2, 0, Some((0x80, 0x80)))];
/// #     const FAULTS: &'static [u8] = &[2];
/// #     fn of_status(bits: u32) -> Option<Self> { [Some(State::Off), Some(State::On), Some(State::Fault), None][bits as usize & 3] }
/// #     fn number(self) -> u8 { self as u8 }
/// #     fn name(self) -> &'static str { "" }
/// #     fn pattern(command: (u32, u32)) -> (u32, u32) { command }
/// # }
/// let mut walker = Walker::new(State::On);
/// // The device is in the state "fault", and the reset bit 7 is still set.
/// assert_eq!(walker.cycle(2_u16, 0x0280_u16)?.control, 0x0200);
/// assert_eq!(walker.cycle(2_u16, 0x0200_u16)?.control, 0x0280);
/// // Now it is in the state "off".
/// assert_eq!(walker.cycle(0_u16, 0x0280_u16)?.control, 0x0201);
/// assert!(walker.cycle(1_u16, 0x0201_u16)?.is_reached);
/// // A fault that occurs on the way is an error.
/// assert!(walker.cycle(2_u16, 0x0201_u16).is_err());
/// # Ok::<(), lexibus::Stopped<State>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Walker<S> {
    target: S,
    /// Number of the state in which the walker last sent a command, and pattern of this command.
    sent: Option<(u8, (u32, u32))>,
    /// True if the device has been in a state that is neither a fault state nor a state in which the walker waits.
    was_healthy: bool,
    /// True if the device is in the target state, and the walker has not changed the control word in this state.
    was_reached: bool,
    deadline: Option<Deadline>,
}

/// Limit of the time in which the device must reach the target state.
#[derive(Clone, Copy, Debug)]
struct Deadline {
    clock: fn() -> Duration,
    limit: Duration,
    /// Time of the first cycle.
    start: Option<Duration>,
}

impl Deadline {
    /// Returns whether the limit has passed since the first call.
    fn is_over(&mut self) -> bool {
        let now = (self.clock)();
        now.saturating_sub(*self.start.get_or_insert(now)) >= self.limit
    }
}

/// Result of a cycle of a [`Walker`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Walked<W> {
    /// Control word to send in this cycle.
    pub control: W,
    /// True if the device is in the target state, and the walker has not changed the control word in this cycle.
    pub is_reached: bool,
}

/// Reason why a [`Walker`] cannot continue. The current control word of the device can still contain a command, so the
/// program must decide which control word is safe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stopped<S> {
    /// A new fault occurred, or a fault that was active at the start could not be reset before the deadline.
    Fault {
        /// State of the device.
        state: S,
        /// Error code of the device, from [`with_code`](Stopped::with_code).
        code: Option<u16>,
    },
    /// No path that a [`Walker`] may use leads from this state to the target state.
    Unreachable(S),
    /// The device left the target state without a command. Contains the state of the device.
    Left(S),
    /// The device was not in the target state at the deadline.
    Deadline {
        /// State of the device, or `None` if its status word matches no state.
        state: Option<S>,
        /// Status word of the device.
        status: u32,
    },
}

impl<S> Stopped<S> {
    /// Adds the error code of the device to a fault. `code` is the value of 0x603F or of 0x1003:01; its low 16 bits are
    /// the error code. Read the value from process data, or with an access to the object.
    ///
    /// ```
    /// # use lexibus::{MachineState, Stopped, Walker};
    /// # fn run<S: MachineState>(walker: &mut Walker<S>, status: u16, error_code: u16) -> Result<u16, Stopped<S>> {
    /// let walked = walker.cycle(status, 0_u16).map_err(|stopped| stopped.with_code(error_code))?;
    /// # Ok(walked.control)
    /// # }
    /// ```
    #[must_use]
    pub fn with_code(self, code: impl StateWord) -> Self {
        match self {
            Self::Fault { state, .. } => Self::Fault { state, code: Some(code.bits() as u16) },
            other => other,
        }
    }

    /// Returns whether the reason is a [`Fault`](Self::Fault).
    pub const fn is_fault(&self) -> bool {
        matches!(self, Self::Fault { .. })
    }
}

impl<S: MachineState> fmt::Display for Stopped<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fault { state, code } => {
                write!(f, "a fault occurred: the device is in the state \"{}\"", state.name())?;
                code.map_or(Ok(()), |code| write!(f, ", error code 0x{code:04X}"))
            }
            Self::Unreachable(state) => {
                write!(f, "no command leads from the state \"{}\" to the target state", state.name())
            }
            Self::Left(state) => {
                write!(f, "the device left the target state, and is in the state \"{}\"", state.name())
            }
            Self::Deadline { state: Some(state), .. } => {
                write!(f, "timeout: the device is still in the state \"{}\"", state.name())
            }
            Self::Deadline { state: None, status } => {
                write!(f, "timeout: the status word 0x{status:04X} matches no state")
            }
        }
    }
}

impl<S: MachineState + fmt::Debug> core::error::Error for Stopped<S> {}

impl<S: MachineState> Walker<S> {
    /// Creates a walker with the target state `target`.
    #[must_use]
    pub const fn new(target: S) -> Self {
        Self { target, sent: None, was_healthy: false, was_reached: false, deadline: None }
    }

    /// Returns the walker with a deadline, measured from the first cycle with the clock of the standard library.
    #[cfg(feature = "std")]
    #[must_use]
    pub fn with_deadline(self, deadline: Duration) -> Self {
        self.with_clock(|| crate::clock::Clock::now(&mut crate::clock::DefaultClock).unwrap_or_default(), deadline)
    }

    /// Returns the walker with a deadline, measured from the first cycle with `clock`: a function that returns the time
    /// since a fixed moment.
    #[must_use]
    pub const fn with_clock(self, clock: fn() -> Duration, deadline: Duration) -> Self {
        Self { deadline: Some(Deadline { clock, limit: deadline, start: None }), ..self }
    }

    /// Returns whether the walker has sent a command.
    pub(super) const fn has_sent(&self) -> bool {
        self.sent.is_some()
    }

    /// Returns the control word for the next cycle. `control` is the current control word of the device.
    ///
    /// # Errors
    ///
    /// Returns [`Stopped`] if a new fault occurred, if no allowed path leads to the target state, if the device left
    /// the target state, or if the deadline passed before the device reached the target state.
    pub fn cycle<W: StateWord>(&mut self, status: impl StateWord, control: W) -> Result<Walked<W>, Stopped<S>> {
        let status = status.bits();
        let walked = self.bits(status, control.bits())?;
        let is_late = self.deadline.as_mut().is_some_and(Deadline::is_over);
        if is_late && !walked.is_reached && !self.was_reached {
            return Err(late(status));
        }
        Ok(Walked { control: W::from_bits(walked.control), is_reached: walked.is_reached })
    }

    fn bits(&mut self, status: u32, control: u32) -> Result<Walked<u32>, Stopped<S>> {
        let unchanged = Walked { control, is_reached: false };
        // A status word without a state occurs while the device starts.
        let Some(state) = S::of_status(status) else { return Ok(unchanged) };
        if state.is_fault() && self.was_healthy && state.number() != self.target.number() {
            return Err(Stopped::Fault { state, code: None });
        }
        if self.was_reached && state.number() != self.target.number() {
            return Err(Stopped::Left(state));
        }
        let step = Step::toward(state, self.target);
        // A status word of 0, which a process image contains before the first cycle, can encode a state of the start-up.
        self.was_healthy |= !state.is_fault() && !matches!(step, Step::Wait);
        match step {
            Step::Reached => {
                let held = hold(state, control);
                self.was_reached = held == control;
                Ok(Walked { control: held, is_reached: self.was_reached })
            }
            Step::Wait => Ok(unchanged),
            Step::Unreachable => Err(Stopped::Unreachable(state)),
            Step::Command(command) => Ok(Walked { control: self.send(state, command, control), ..unchanged }),
        }
    }

    /// Returns the control word that contains a command. If the current control word already contains the command,
    /// clears the bits that only this command sets. The next cycle then sends a rising edge.
    fn send(&mut self, state: S, command: S::Command, control: u32) -> u32 {
        let (mask, value) = S::pattern(command);
        let sent = Some((state.number(), (mask, value)));
        let is_new = self.sent != sent;
        self.sent = sent;
        let others = control & !used::<S>();
        if is_new && control == others | value {
            return others | (value & !exclusive::<S>(mask, value));
        }
        others | value
    }
}

/// Returns the reason why a device with this status word was not in its target state at the deadline.
pub(super) fn late<S: MachineState>(status: u32) -> Stopped<S> {
    match S::of_status(status) {
        Some(state) if state.is_fault() => Stopped::Fault { state, code: None },
        state => Stopped::Deadline { state, status },
    }
}

/// Returns the command patterns of all transitions that `is_it` accepts.
fn patterns<S: MachineState>(is_it: impl Fn(&Transition<S::Command>) -> bool) -> impl Iterator<Item = (u32, u32)> {
    let transitions = S::TRANSITIONS.iter().filter(move |transition| is_it(transition));
    transitions.filter_map(|transition| transition.command).map(S::pattern)
}

/// Returns the mask of all bits of the control word that belong to commands.
fn used<S: MachineState>() -> u32 {
    patterns::<S>(|_| true).fold(0, |bits, (mask, _)| bits | mask)
}

/// Returns the control word for a device that is in the target state. Replaces a command that leads to another state
/// with a command that leads to the target state, if there is one.
fn hold<S: MachineState>(state: S, control: u32) -> u32 {
    let number = state.number();
    let leads_away = |control: u32| {
        let mut leaving = patterns::<S>(|transition| transition.from == number && transition.to != number);
        leaving.any(|(mask, value)| control & mask == value)
    };
    if !leads_away(control) {
        return control;
    }
    let entering = patterns::<S>(|transition| transition.to == number);
    let mut words = entering.map(|(_, value)| control & !used::<S>() | value);
    words.find(|word| !leads_away(*word)).unwrap_or(control)
}

/// Returns the bits that only the command with this pattern sets.
fn exclusive<S: MachineState>(mask: u32, value: u32) -> u32 {
    let others =
        patterns::<S>(|_| true).filter(|pattern| *pattern != (mask, value)).fold(0, |bits, (_, value)| bits | value);
    value & !others
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;
    use std::vec::Vec;

    /// The states of CiA 402 that these tests need.
    #[derive(Clone, Copy, Debug, PartialEq)]
    enum State {
        Starting,
        Disabled,
        Ready,
        Enabled,
        Reaction,
        Fault,
    }

    const STATUS: [u32; 6] = [0x00, 0x40, 0x21, 0x27, 0x0F, 0x08];
    const SHUTDOWN: (u32, u32) = (0x87, 0x06);
    const ENABLE: (u32, u32) = (0x8F, 0x0F);
    const RESET: (u32, u32) = (0x80, 0x80);

    impl MachineState for State {
        type Command = (u32, u32);
        const TRANSITIONS: &'static [Transition<(u32, u32)>] = &[
            Transition::new(0, 1, None),
            Transition::new(1, 2, Some(SHUTDOWN)),
            Transition::new(2, 3, Some(ENABLE)),
            Transition::new(4, 5, None),
            Transition::new(5, 1, Some(RESET)),
        ];
        const FAULTS: &'static [u8] = &[4, 5];

        fn of_status(bits: u32) -> Option<Self> {
            use State::{Disabled, Enabled, Fault, Reaction, Ready, Starting};
            let all = [Starting, Disabled, Ready, Enabled, Reaction, Fault];
            all.into_iter().zip(STATUS).find(|(_, status)| *status == bits & 0x6F).map(|(state, _)| state)
        }

        fn number(self) -> u8 {
            self as u8
        }

        fn name(self) -> &'static str {
            "a state"
        }

        fn pattern(command: (u32, u32)) -> (u32, u32) {
            command
        }
    }

    /// Returns the control words that a walker sends, beginning with `control`, while the device passes through these
    /// states.
    fn controls(control: u16, states: &[State]) -> Vec<u16> {
        let (mut walker, mut control) = (Walker::new(State::Enabled), control);
        let sent = states.iter().map(|state| {
            control = walker.cycle(STATUS[*state as usize] as u16, control).expect("a path").control;
            control
        });
        sent.collect()
    }

    #[test]
    fn a_healthy_device() {
        use State::{Disabled, Enabled, Ready, Starting};
        let states = [Starting, Disabled, Disabled, Ready, Ready, Enabled];
        assert_eq!(controls(0x0100, &states), [0x0100, 0x0106, 0x0106, 0x010F, 0x010F, 0x010F]);
    }

    #[test]
    fn a_fault_at_the_start_is_reset_with_an_edge() {
        use State::{Disabled, Enabled, Fault, Reaction, Ready};
        let states = [Reaction, Fault, Fault, Fault, Disabled, Ready, Enabled];
        assert_eq!(controls(0, &states), [0, 0x80, 0x80, 0x80, 0x06, 0x0F, 0x0F]);
        // The reset bit is already set: a level would fail forever.
        assert_eq!(controls(0x80, &states), [0x80, 0, 0x80, 0x80, 0x06, 0x0F, 0x0F]);
        // Bits of other commands are cleared with each command.
        assert_eq!(controls(0x8F, &states), [0x8F, 0x80, 0x80, 0x80, 0x06, 0x0F, 0x0F]);
    }

    #[test]
    fn a_command_that_the_control_word_already_contains() {
        use State::{Enabled, Ready};
        assert_eq!(controls(0x0F, &[Ready, Ready, Ready, Enabled]), [0x06, 0x0F, 0x0F, 0x0F]);
    }

    #[test]
    fn a_fault_on_the_way_stops() {
        let mut walker = Walker::new(State::Enabled);
        assert_eq!(walker.cycle(0x21_u16, 0x06_u16), Ok(Walked { control: 0x0F, is_reached: false }));
        let stopped = walker.cycle(0x0F_u16, 0x0F_u16).unwrap_err();
        assert_eq!(stopped, Stopped::Fault { state: State::Reaction, code: None });
        assert_eq!(stopped.to_string(), "a fault occurred: the device is in the state \"a state\"");
        let text = stopped.with_code(0x0102_8611_u32).to_string();
        assert_eq!(text, "a fault occurred: the device is in the state \"a state\", error code 0x8611");
        assert_eq!(Walker::new(State::Fault).cycle(0x21_u16, 0_u16), Err(Stopped::Unreachable(State::Ready)));
    }

    #[test]
    fn the_target_state_is_held() {
        // The drive is ready, but the control word still enables it.
        let mut walker = Walker::new(State::Ready);
        assert_eq!(walker.cycle(0x21_u16, 0x010F_u16), Ok(Walked { control: 0x0106, is_reached: false }));
        assert_eq!(walker.cycle(0x21_u16, 0x0106_u16), Ok(Walked { control: 0x0106, is_reached: true }));
        // Afterwards, another state stops the walker, so that it never enables the drive again.
        assert_eq!(walker.cycle(0x40_u16, 0x0106_u16), Err(Stopped::Left(State::Disabled)));
    }

    #[test]
    fn a_walker_gives_up_at_its_deadline() {
        use core::sync::atomic::{AtomicU64, Ordering};
        static TIME: AtomicU64 = AtomicU64::new(7);
        let clock = || Duration::from_millis(TIME.load(Ordering::Relaxed));
        let run = |states: &[State]| {
            let mut walker = Walker::new(State::Enabled).with_clock(clock, Duration::from_millis(30));
            let mut control = 0_u16;
            for state in states {
                control = walker.cycle(STATUS[*state as usize] as u16, control)?.control;
                TIME.fetch_add(10, Ordering::Relaxed);
            }
            Ok(())
        };
        use State::{Disabled, Enabled, Fault, Ready};
        let late = Err(Stopped::Deadline { state: Some(Ready), status: 0x21 });
        assert_eq!(run(&[Disabled, Ready, Ready, Ready]), late);
        assert_eq!(run(&[Fault, Fault, Fault, Fault]), Err(Stopped::Fault { state: Fault, code: None }));
        assert_eq!(
            run(&[Disabled, Ready, Enabled, Enabled, Enabled, Enabled]),
            Ok(()),
            "the target is reached in time"
        );
        assert_eq!(run(&[Disabled, Ready, Ready, Enabled]), Ok(()), "at the deadline");
        let text = Stopped::<State>::Deadline { state: None, status: 0x2F }.to_string();
        assert_eq!(text, "timeout: the status word 0x002F matches no state");
    }

    #[test]
    fn energized_states_are_only_targets() {
        let both =
            [Transition::new(3, 1, Some('e')), Transition::new(1, 0, Some('d')), Transition::new(3, 2, Some('v'))];
        let all = [both[0], both[1], both[2], Transition::new(2, 4, Some('s')), Transition::new(4, 0, Some('t'))];
        assert_eq!(Step::on_path(&all, &[], &[], 3, 0), Step::Command('e'));
        assert_eq!(Step::on_path(&all, &[], &[1], 3, 0), Step::Command('v'));
        assert_eq!(Step::on_path(&all, &[], &[1], 3, 1), Step::Command('e'));
        assert_eq!(Step::on_path(&both, &[], &[1], 3, 0), Step::Unreachable);
    }

    /// The command `t` leads to the fault state 4, which the device also enters without a command. The commands `h`,
    /// `r`, `R` and `Q` lead from the state 0 to the state 2. A shorter path leads through the fault.
    #[test]
    fn fault_states_are_no_path() {
        let all = [
            Transition::new(0, 4, Some('t')),
            Transition::new(3, 4, None),
            Transition::new(4, 5, None),
            Transition::new(5, 2, Some('x')),
            Transition::new(0, 1, Some('h')),
            Transition::new(1, 6, Some('r')),
            Transition::new(6, 7, Some('R')),
            Transition::new(7, 2, Some('Q')),
            Transition::new(2, 3, Some('s')),
        ];
        let toward = |state, target| Step::on_path(&all, &[4, 5], &[], state, target);
        assert_eq!(toward(0, 2), Step::Command('h'));
        // The device does not wait for a fault.
        assert_eq!(toward(3, 2), Step::Unreachable);
        // A fault that is already active is reset.
        assert_eq!((toward(4, 3), toward(5, 3)), (Step::Wait, Step::Command('x')));
        assert_eq!((toward(0, 4), toward(3, 4)), (Step::Command('t'), Step::Wait));
    }

    /// A machine with a command that triggers a fault.
    #[derive(Clone, Copy, Debug, PartialEq)]
    enum Tested {
        Idle,
        Failed,
    }

    impl MachineState for Tested {
        type Command = (u32, u32);
        const TRANSITIONS: &'static [Transition<(u32, u32)>] = &[Transition::new(0, 1, Some((1, 1)))];
        const FAULTS: &'static [u8] = &[1];
        fn of_status(bits: u32) -> Option<Self> {
            [Self::Idle, Self::Failed].get(bits as usize).copied()
        }
        fn number(self) -> u8 {
            self as u8
        }
        fn name(self) -> &'static str {
            ""
        }
        fn pattern(command: (u32, u32)) -> (u32, u32) {
            command
        }
    }

    #[test]
    fn a_fault_state_can_be_the_target() {
        let mut walker = Walker::new(Tested::Failed);
        assert_eq!(walker.cycle(0_u16, 0_u16), Ok(Walked { control: 1, is_reached: false }));
        assert_eq!(walker.cycle(1_u16, 1_u16), Ok(Walked { control: 1, is_reached: true }));
    }

    #[test]
    fn a_fault_after_the_start_up_is_reset() {
        let mut walker = Walker::new(State::Enabled);
        // The process image is 0 before the first cycle.
        assert_eq!(walker.cycle(0_u16, 0_u16), Ok(Walked { control: 0, is_reached: false }));
        assert_eq!(walker.cycle(0x08_u16, 0_u16), Ok(Walked { control: 0x80, is_reached: false }));
    }

    #[test]
    fn no_state() {
        let mut walker = Walker::new(State::Enabled);
        assert_eq!(walker.cycle(0x2F_u32, 5_u8), Ok(Walked { control: 5, is_reached: false }));
    }
}

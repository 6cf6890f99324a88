//! Simulated drives: the behavior of CiA 402 for the axes of a device.

mod device;
mod fault;
mod homing;
mod modes;
mod motion;
mod objects;
mod set_points;
mod state;
mod status;

use self::homing::Homing;
use self::motion::Motion;
use self::objects::Objects;
use self::set_points::SetPoints;
use self::state::{State, Stop};

/// Bit "fault reset" of the controlword.
const FAULT_RESET: u16 = 1 << 7;
/// Bit "halt" of the controlword.
const HALT: u16 = 1 << 8;

/// A drive of one axis. The drive reads and writes the objects of the axis by index.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Drive {
    /// Number of the axis. The first axis has number 1.
    axis: u8,
    state: State,
    /// Last controlword.
    control: u16,
    /// Active mode of operation.
    mode: i64,
    /// Ramp on which the axis stops if the operation isn't enabled.
    stop: Stop,
    motion: Motion,
    set_points: SetPoints,
    homing: Homing,
    /// Torque demand in the mode "profile torque", in 0.1 % of the rated torque.
    torque: f64,
    /// True if the cause of the fault persists, so that the fault cannot be reset.
    has_cause: bool,
    /// Actual position (0x6064) that the drive has written.
    published: Option<i64>,
}

impl Drive {
    /// Creates a drive after power-on.
    fn new(axis: u8, objects: &mut Objects<'_>) -> Self {
        let mut drive = Self {
            axis,
            state: State::NotReadyToSwitchOn,
            control: objects.word(0x6040),
            mode: 0,
            stop: Stop::Coast,
            motion: Motion::default(),
            set_points: SetPoints::default(),
            homing: Homing::default(),
            torque: 0.0,
            has_cause: false,
            published: None,
        };
        drive.adopt_position(objects);
        drive.publish(objects);
        drive
    }

    /// Executes one step of the simulation.
    fn advance(&mut self, objects: &mut Objects<'_>) {
        self.follow_mode(objects);
        self.control(objects);
        self.motion.begin();
        if self.state == State::OperationEnabled {
            self.operate(objects);
        } else {
            self.slow_down(self.stop, objects);
        }
        self.finish(objects);
        self.publish(objects);
    }

    /// Reacts to a write by a client or in process data.
    fn react(&mut self, objects: &mut Objects<'_>) {
        self.control(objects);
        self.publish(objects);
    }

    /// Adopts the actual position (0x6064) if the test has changed it.
    fn adopt_position(&mut self, objects: &Objects<'_>) {
        let position = objects.number(0x6064);
        if let Some(position) = position.filter(|_| position != self.published) {
            self.motion.place(position as f64);
            self.published = Some(position);
        }
    }

    /// Activates the requested mode (0x6060) if the drive supports it.
    fn follow_mode(&mut self, objects: &Objects<'_>) {
        let mode = objects.number(0x6060).unwrap_or(0);
        if mode != self.mode && modes::is_supported(mode, objects) {
            self.mode = mode;
            self.abandon();
        }
    }

    /// Adopts the actual position if the test has changed it, and executes the controlword: performs at most one state
    /// transition, or evaluates the bits of the active mode.
    fn control(&mut self, objects: &mut Objects<'_>) {
        self.adopt_position(objects);
        let word = objects.word(0x6040);
        let (rising, falling) = (word & !self.control, self.control & !word);
        self.control = word;
        if self.state == State::Fault {
            if rising & FAULT_RESET != 0 && !self.has_cause {
                self.reset_fault(objects);
            }
            return;
        }
        let may_resume = objects.option(0x605A) >= 5;
        match self.state.after(word, may_resume) {
            Some(next) => self.enter(next, objects),
            None if self.state == State::OperationEnabled => self.command_mode(rising, falling, objects),
            None => {}
        }
    }

    /// Enters a state, and selects the ramp on which the axis stops in this state.
    fn enter(&mut self, next: State, objects: &Objects<'_>) {
        let from_operation = self.state == State::OperationEnabled;
        self.stop = match next {
            State::QuickStopActive => Stop::of_option(objects.option(0x605A)),
            State::FaultReactionActive => Stop::of_option(objects.option(0x605E)),
            State::SwitchedOn if from_operation => Stop::of_option(objects.option(0x605C)),
            State::ReadyToSwitchOn if from_operation => Stop::of_option(objects.option(0x605B)),
            State::SwitchOnDisabled => Stop::Coast,
            _ => self.stop,
        };
        self.state = next;
        self.abandon();
    }

    /// Discards the set-points, the torque demand and the cyclic target position, and aborts homing.
    fn abandon(&mut self) {
        self.torque = 0.0;
        self.set_points = SetPoints::default();
        self.homing.abort();
        self.motion.hold();
    }

    /// Executes the automatic transitions.
    fn finish(&mut self, objects: &Objects<'_>) {
        let is_stopped = self.stop == Stop::Coast || self.motion.is_still();
        match self.state {
            State::NotReadyToSwitchOn => self.enter(State::SwitchOnDisabled, objects),
            State::FaultReactionActive if is_stopped => self.state = State::Fault,
            State::QuickStopActive if is_stopped && objects.option(0x605A) < 5 => {
                self.enter(State::SwitchOnDisabled, objects);
            }
            _ => {}
        }
    }
}

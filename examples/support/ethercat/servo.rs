//! The application of the demo servo: the state machine of CiA 402, and a position that follows its target at once.

use std::collections::VecDeque;

use lexibus::Entry;

use super::objects::{Dictionary, Table};

const CONTROLWORD: u16 = 0x6040;
const STATUSWORD: u16 = 0x6041;
const POSITION: u16 = 0x6064;
const VELOCITY: u16 = 0x606C;
const TARGET_POSITION: u16 = 0x607A;
const TARGET_VELOCITY: u16 = 0x60FF;
const ENCODER_OFFSET: u16 = 0x2012;

/// The error code of a sensor (IEC 61800-7-201).
const SENSOR_FAULT: u16 = 0x7300;

/// The states of CiA 402 that this drive has.
#[derive(Clone, Copy, PartialEq)]
enum State {
    SwitchOnDisabled,
    ReadyToSwitchOn,
    SwitchedOn,
    OperationEnabled,
    Fault,
}

/// The demo servo.
pub struct Servo {
    pub objects: Table,
    state: State,
    emergencies: VecDeque<[u8; 8]>,
    last_controlword: i64,
}

impl Servo {
    /// A servo that was just switched on.
    pub fn new(entries: &'static [Entry]) -> Self {
        let objects = Table::new(entries);
        Self { objects, state: State::SwitchOnDisabled, emergencies: VecDeque::new(), last_controlword: 0 }
    }

    /// A fault: the drive stops, and tells so.
    pub fn trip(&mut self, code: u16) {
        self.state = State::Fault;
        let [low, high] = code.to_le_bytes();
        self.emergencies.push_back([low, high, 0x21, 0, 0, 0, 0, 0]);
        self.show();
    }

    fn show(&mut self) {
        let bits = match self.state {
            State::SwitchOnDisabled => 0x40,
            State::ReadyToSwitchOn => 0x21,
            State::SwitchedOn => 0x23,
            State::OperationEnabled => 0x27,
            State::Fault => 0x08,
        };
        self.objects.set(STATUSWORD, 0, 0x0210 | bits);
    }

    fn obey(&mut self) {
        let word = self.objects.get(CONTROLWORD, 0);
        let reset = word & 0x80 != 0 && self.last_controlword & 0x80 == 0;
        self.last_controlword = word;
        self.state = match (self.state, word & 0x0F) {
            (State::Fault, _) if reset => State::SwitchOnDisabled,
            (State::Fault, _) => State::Fault,
            (_, command) if command & 0x02 == 0 || command & 0x04 == 0 => State::SwitchOnDisabled,
            (_, 0x06 | 0x0E) => State::ReadyToSwitchOn,
            (State::SwitchOnDisabled, _) => State::SwitchOnDisabled,
            (_, 0x07) => State::SwitchedOn,
            (State::ReadyToSwitchOn, 0x0F) => State::SwitchedOn,
            _ => State::OperationEnabled,
        };
    }
}

impl Dictionary for Servo {
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32> {
        self.objects.read(index, sub_index)
    }

    fn write(&mut self, index: u16, sub_index: u8, data: &[u8]) -> Result<(), u32> {
        self.objects.write(index, sub_index, data)?;
        if index == ENCODER_OFFSET && self.state == State::OperationEnabled {
            // The position jumps under the controller.
            self.trip(SENSOR_FAULT);
        }
        Ok(())
    }

    fn cycle(&mut self, operational: bool) {
        if operational {
            self.obey();
        }
        self.show();
        if self.state == State::OperationEnabled {
            self.objects.set(POSITION, 0, self.objects.get(TARGET_POSITION, 0));
            self.objects.set(VELOCITY, 0, self.objects.get(TARGET_VELOCITY, 0));
        }
    }

    fn emergency(&mut self) -> Option<[u8; 8]> {
        self.emergencies.pop_front()
    }
}

//! The application of the demo servo: the CiA 402 state machine. The position reaches its target immediately.

use lexibus::sim::{Device, ItemAddress};
use lexibus::{AbortCode, Emergency, Object};

use super::objects::Dictionary;
// Each program that simulates the servo defines these bindings in its module `servo`.
use crate::servo::types::{Controlword, Statusword};
use crate::servo::{objects, ENTRIES};

/// Error code of a sensor fault (IEC 61800-7-201).
const SENSOR_FAULT: u16 = 0x7300;

/// The CiA 402 states that this drive can have.
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
    /// The objects of the servo.
    pub device: Device,
    state: State,
    last_controlword: Controlword,
}

impl Servo {
    /// Creates a servo after power-on.
    pub fn new() -> Self {
        Self { device: Device::new(ENTRIES), state: State::SwitchOnDisabled, last_controlword: Controlword::new() }
    }

    /// Enters the fault state and reports the error code.
    pub fn trip(&mut self, code: u16) -> Result<(), AbortCode> {
        self.state = State::Fault;
        self.device.emit_emergency(code, 0x21, [0; 5]);
        self.show()
    }

    fn show(&mut self) -> Result<(), AbortCode> {
        let bits = match self.state {
            State::SwitchOnDisabled => 0x40,
            State::ReadyToSwitchOn => 0x21,
            State::SwitchedOn => 0x23,
            State::OperationEnabled => 0x27,
            State::Fault => 0x08,
        };
        self.device.set(objects::STATUSWORD, Statusword::from_raw(0x0210 | bits))
    }

    fn obey(&mut self) -> Result<(), AbortCode> {
        let controlword = self.device.get(objects::CONTROLWORD)?;
        let last = std::mem::replace(&mut self.last_controlword, controlword);
        let reset = controlword.raw() & !last.raw() & 0x80 != 0;
        self.state = match (self.state, controlword.raw() & 0x0F) {
            (State::Fault, _) if reset => State::SwitchOnDisabled,
            (State::Fault, _) => State::Fault,
            (_, command) if command & 0x02 == 0 || command & 0x04 == 0 => State::SwitchOnDisabled,
            (_, 0x06 | 0x0E) => State::ReadyToSwitchOn,
            (State::SwitchOnDisabled, _) => State::SwitchOnDisabled,
            (_, 0x07) => State::SwitchedOn,
            (State::ReadyToSwitchOn, 0x0F) => State::SwitchedOn,
            _ => State::OperationEnabled,
        };
        Ok(())
    }

    fn run(&mut self, operational: bool) -> Result<(), AbortCode> {
        if operational {
            self.obey()?;
        }
        self.show()?;
        if self.state == State::OperationEnabled {
            let (position, velocity) = (objects::TARGET_POSITION, objects::TARGET_VELOCITY);
            self.device.set(objects::POSITION_ACTUAL_VALUE, self.device.get(position)?)?;
            self.device.set(objects::VELOCITY_ACTUAL_VALUE, self.device.get(velocity)?)?;
        }
        Ok(())
    }
}

impl Dictionary for Servo {
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32> {
        self.device.read(index, sub_index)
    }

    fn write(&mut self, index: u16, sub_index: u8, data: &[u8]) -> Result<(), u32> {
        self.device.write(index, sub_index, data)?;
        let is_encoder_offset = objects::ENCODER_OFFSET.object() == Some(Object::new(index, sub_index));
        if is_encoder_offset && self.state == State::OperationEnabled {
            // The write changes the actual position suddenly, like a faulty sensor.
            self.trip(SENSOR_FAULT).map_err(|code| code.0)?;
        }
        Ok(())
    }

    fn cycle(&mut self, operational: bool) {
        self.run(operational).expect("the objects of the servo");
    }

    fn emergencies(&mut self) -> Vec<Emergency> {
        self.device.emergencies()
    }
}

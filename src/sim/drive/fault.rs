//! Faults of a simulated drive.

use super::objects::Objects;
use super::state::State;
use super::Drive;
use crate::machine::MachineState;

/// Returns the bits of the error register (0x1001) for an error code (CiA 301 7.2.7.1).
const fn error_register(code: u16) -> u8 {
    const GENERIC: u8 = 1;
    match code >> 8 {
        0x20..=0x2F => GENERIC | 1 << 1,
        0x30..=0x3F => GENERIC | 1 << 2,
        0x40..=0x4F => GENERIC | 1 << 3,
        0x81 | 0x82 => GENERIC | 1 << 4,
        0x83..=0x8F | 0xFF => GENERIC | 1 << 5,
        _ => GENERIC,
    }
}

impl Drive {
    /// Enters the fault reaction and reports the fault.
    pub(super) fn enter_fault(&mut self, code: u16, persists: bool, objects: &mut Objects<'_>) {
        // Stores the controlword, so that a reset bit that is already set isn't a rising edge.
        self.control(objects);
        self.has_cause |= persists;
        if !self.state.is_fault() {
            self.enter(State::FaultReactionActive, objects);
        }
        objects.put(0x603F, code.into());
        let register = objects.device.slots.number(0x1001, 0).unwrap_or(0) as u8;
        objects.device.emit_emergency(code, register | error_register(code), [0; 5]);
        self.publish(objects);
    }

    /// Leaves the state "Fault". The error code (0x603F) remains the code of the last error.
    pub(super) fn reset_fault(&mut self, objects: &mut Objects<'_>) {
        self.enter(State::SwitchOnDisabled, objects);
        objects.device.emit_emergency(0, 0, [0; 5]);
    }
}

//! Errors of a simulated device.

use super::device::Device;
use super::slots::ERRORS;
use crate::bus::Object;
use crate::emergency::Emergency;

impl Device {
    /// Simulates an error and emits an emergency message. The error register (0x1001) and the error list (0x1003) are
    /// updated if the device has these objects. Code 0 means that no error remains. Code 0 isn't added to the error
    /// list.
    pub fn emit_emergency(&mut self, code: u16, register: u8, vendor: [u8; 5]) {
        let _ = self.set_bytes(Object::new(0x1001, 0), &[register]);
        if code != 0 {
            self.remember(code, vendor);
        }
        self.emergencies.push_back(Emergency { code, register, vendor });
    }

    /// Returns and removes the emergency messages that were emitted. A node on a simulated CAN bus sends emergency
    /// messages automatically.
    pub fn take_emergencies(&mut self) -> impl Iterator<Item = Emergency> + '_ {
        self.emergencies.drain(..)
    }

    /// Inserts an error at the top of the error list. If the list is full, the oldest error is removed.
    fn remember(&mut self, code: u16, vendor: [u8; 5]) {
        let room = self.slots.objects(ERRORS, ERRORS).map(|object| object.sub_index).max().unwrap_or(0);
        let length = self.slots.number(ERRORS, 0).map_or(0, |length| length.min(room.into()) as u8);
        let mut newer = [code.to_le_bytes(), [vendor[0], vendor[1]]].concat();
        let filled = length.saturating_add(1).min(room);
        for sub_index in 1..=filled {
            let object = Object::new(ERRORS, sub_index);
            let older = self.bytes(object).map(<[u8]>::to_vec).unwrap_or_default();
            let _ = self.set_bytes(object, &newer);
            newer = older;
        }
        let _ = self.set_bytes(Object::new(ERRORS, 0), &[filled]);
    }
}

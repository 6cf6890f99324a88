//! Statusword and actual values of a simulated drive.

use super::homing::Homing;
use super::modes::{
    self, CYCLIC_POSITION, CYCLIC_TORQUE_WITH_ANGLE, HOMING, INTERPOLATED_POSITION, PROFILE_POSITION, PROFILE_TORQUE,
    PROFILE_VELOCITY, START, VELOCITY,
};
use super::objects::Objects;
use super::state::State;
use super::{Drive, HALT};

/// Bits of the statusword that the drive doesn't change: warning and manufacturer-specific bits.
const FOREIGN: u16 = 1 << 7 | 1 << 8 | 1 << 14 | 1 << 15;

impl Drive {
    /// Writes the statusword, the active mode and the actual values.
    pub(super) fn publish(&mut self, objects: &mut Objects<'_>) {
        let status = objects.word(0x6041) & FOREIGN | self.state.bits() | self.mode_bits(objects);
        objects.put(0x6041, status.into());
        objects.put(0x6061, self.mode);
        let (motion, position) = (&self.motion, self.motion.position.round() as i64);
        objects.put(0x6064, position);
        objects.put(0x6063, position);
        objects.put(0x6062, motion.demand.round() as i64);
        objects.put(0x60F4, (motion.demand - motion.position).round() as i64);
        objects.put(0x606B, motion.velocity.round() as i64);
        objects.put(0x606C, motion.velocity.round() as i64);
        [0x6043, 0x6044].into_iter().for_each(|index| objects.put(index, motion.velocity.round() as i64));
        let torque = modes::torque(motion, objects).round() as i64;
        [0x6074, 0x6077, 0x6078].into_iter().for_each(|index| objects.put(index, torque));
        self.published = objects.number(0x6064);
    }

    /// Returns the bits 10 to 13 of the statusword.
    fn mode_bits(&self, objects: &Objects<'_>) -> u16 {
        if self.state == State::QuickStopActive {
            return u16::from(self.motion.is_still()) << 10;
        }
        if self.state != State::OperationEnabled {
            return 0;
        }
        let bits = [
            self.is_target_reached(objects),
            self.motion.is_limited,
            self.is_confirmed(objects),
            self.is_failed(objects),
        ];
        bits.into_iter().zip(10..).fold(0, |word, (bit, at)| word | u16::from(bit) << at)
    }

    /// Returns bit 10: target reached, or standstill of a halted axis. The bit is 0 in modes 2 and 8 to 11, because it
    /// has no meaning there.
    fn is_target_reached(&self, objects: &Objects<'_>) -> bool {
        let is_still = self.motion.is_still();
        match self.mode {
            VELOCITY | CYCLIC_POSITION..=CYCLIC_TORQUE_WITH_ANGLE => false,
            _ if self.control & HALT != 0 => is_still,
            PROFILE_POSITION => self.set_points.is_reached() && is_still,
            PROFILE_VELOCITY => (self.motion.velocity - objects.real(0x60FF)).abs() <= objects.real(0x606D),
            PROFILE_TORQUE => self.torque == objects.real(0x6071),
            HOMING => is_still && !self.homing.is_running(),
            INTERPOLATED_POSITION => is_still && self.motion.position == modes::data_record(objects),
            _ => is_still,
        }
    }

    /// Returns bit 12: set-point acknowledge, speed zero, homing attained, interpolation active, or follows command value.
    fn is_confirmed(&self, objects: &Objects<'_>) -> bool {
        match self.mode {
            PROFILE_POSITION => self.set_points.is_acknowledged(),
            PROFILE_VELOCITY => self.motion.velocity.abs() <= objects.real(0x606F),
            HOMING => self.homing == Homing::Attained,
            INTERPOLATED_POSITION => self.control & (HALT | START) == START,
            CYCLIC_POSITION..=CYCLIC_TORQUE_WITH_ANGLE => self.control & HALT == 0,
            _ => false,
        }
    }

    /// Returns bit 13: following error or homing error.
    fn is_failed(&self, objects: &Objects<'_>) -> bool {
        let error = (self.motion.demand - self.motion.position).abs();
        match self.mode {
            PROFILE_POSITION | CYCLIC_POSITION => objects.positive(0x6065).is_some_and(|window| error > window),
            HOMING => self.homing == Homing::Failed,
            _ => false,
        }
    }
}

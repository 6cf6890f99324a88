//! Objects of one axis, accessed by index.

use super::super::device::Device;
use super::super::values;
use crate::bus::Object;
use crate::data_type::DataType;
use crate::pdo::{from_bytes, sign_extend};
use crate::table::RawInitial;

/// Default profile velocity, in position units per second.
const VELOCITY: f64 = 10_000.0;
/// Default profile acceleration, in position units per second squared.
const ACCELERATION: f64 = 100_000.0;

/// Initial values of objects without an initial value in the device description. For these objects, the value 0 would
/// have an unwanted meaning: stop reactions, homing method, and supported modes of operation.
const DEFAULTS: [(u16, i64); 6] =
    [(0x605A, 2), (0x605C, 1), (0x605D, 1), (0x605E, 2), (0x6098, 37), (0x6502, 0b111_1110_1111)];

/// The objects of an axis.
pub(super) struct Objects<'d> {
    pub device: &'d mut Device,
    pub axis: u8,
}

impl Objects<'_> {
    fn slot(&self, index: u16, sub_index: u8) -> Option<usize> {
        let at = self.device.slot(&Object::new(index, sub_index), self.axis).ok()?;
        let is_integer = match self.device.slots.get(at).entry.data_type {
            DataType::Real32 | DataType::Real64 | DataType::TimeOfDay | DataType::TimeDifference => false,
            data_type => data_type.bits().is_some(),
        };
        is_integer.then_some(at)
    }

    /// Returns whether the axis has the object and the object is an integer.
    pub fn has(&self, index: u16) -> bool {
        self.slot(index, 0).is_some()
    }

    /// Returns the value of an object, or `None` if the axis doesn't have the object or the object isn't an integer.
    pub fn number(&self, index: u16) -> Option<i64> {
        self.sub_number(index, 0)
    }

    /// Returns the value of a sub-index, as [`number`](Self::number) does.
    pub fn sub_number(&self, index: u16, sub_index: u8) -> Option<i64> {
        let slot = self.device.slots.get(self.slot(index, sub_index)?);
        let raw = from_bytes(&slot.value);
        let bits = slot.entry.data_type.bits()?;
        Some(if slot.entry.data_type.is_signed() { sign_extend(raw, bits) } else { raw as i64 })
    }

    /// Returns the low 16 bits of an object, or 0 if the axis doesn't have the object.
    pub fn word(&self, index: u16) -> u16 {
        self.number(index).unwrap_or(0) as u16
    }

    /// Returns the value of an object, or 0 if the axis doesn't have the object.
    pub fn real(&self, index: u16) -> f64 {
        self.number(index).unwrap_or(0) as f64
    }

    /// Returns the value of an object, or `None` if the axis doesn't have the object or the value isn't positive.
    pub fn positive(&self, index: u16) -> Option<f64> {
        self.number(index).filter(|value| *value > 0).map(|value| value as f64)
    }

    /// Returns the value of an option code. If the axis doesn't have the object, returns the default value of CiA 402.
    pub fn option(&self, index: u16) -> i64 {
        let default = || DEFAULTS.iter().find(|(object, _)| *object == index).map_or(0, |(_, value)| *value);
        self.number(index).unwrap_or_else(default)
    }

    /// Sets the value of an object if the axis has the object. A value that doesn't fit is limited to the range of the
    /// type.
    pub fn put(&mut self, index: u16, value: i64) {
        let Some(at) = self.slot(index, 0) else { return };
        let slot = self.device.slots.get(at);
        let bytes = encoded(slot.entry.data_type, value);
        if bytes != slot.value {
            self.device.store(at, bytes);
        }
    }

    /// Declares initial values for objects without an initial value in the device description.
    pub fn declare_defaults(&mut self) {
        for (index, value) in DEFAULTS {
            let Some(at) = self.slot(index, 0) else { continue };
            let slot = self.device.slots.get_mut(at);
            let bytes = encoded(slot.entry.data_type, value);
            let is_unknown = slot.initial.is_none() && slot.entry.initial == RawInitial::Unknown;
            if is_unknown && values::check_range(&slot.entry, &bytes).is_ok() {
                slot.initial = Some(bytes);
            }
        }
    }

    /// Returns the maximum velocity (0x607F), or infinity if there is no positive maximum.
    pub fn max_velocity(&self) -> f64 {
        self.positive(0x607F).unwrap_or(f64::INFINITY)
    }

    /// Returns the quick-stop deceleration (0x6085). The default is ten times the profile deceleration.
    pub fn quick_deceleration(&self) -> f64 {
        self.positive(0x6085).unwrap_or_else(|| 10.0 * Profile::read(self).deceleration)
    }

    /// Returns an acceleration of the mode "velocity": the speed change (sub-index 1) divided by the time in seconds
    /// (sub-index 2). Returns `default` if the axis doesn't have the object, or if the speed change isn't positive.
    pub fn ramp(&self, index: u16, default: f64) -> f64 {
        match (self.sub_number(index, 1), self.sub_number(index, 2)) {
            // A time of 0 is an infinite acceleration.
            (Some(speed), Some(time)) if speed > 0 => speed as f64 / time as f64,
            _ => default,
        }
    }

    /// Returns the limits of the position (0x607D), if there are any.
    pub fn position_limits(&self) -> Option<(f64, f64)> {
        let limits = self.sub_number(0x607D, 1).zip(self.sub_number(0x607D, 2));
        limits.filter(|(low, high)| low < high).map(|(low, high)| (low as f64, high as f64))
    }
}

/// Limits `value` to the range of an integer type, and returns the bytes of the limited value.
fn encoded(data_type: DataType, value: i64) -> std::vec::Vec<u8> {
    let bits = data_type.bits().unwrap_or(0).clamp(1, 64);
    let value = match data_type.is_signed() {
        _ if bits == 64 => value,
        true => value.clamp(-1 << (bits - 1), (1 << (bits - 1)) - 1),
        false if bits == 63 => value.max(0),
        false => value.clamp(0, (1 << bits) - 1),
    };
    value.to_le_bytes().into_iter().take(bits.div_ceil(8) as usize).collect()
}

/// Velocity and ramps of a motion, in position units and seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Profile {
    pub velocity: f64,
    pub acceleration: f64,
    pub deceleration: f64,
}

impl Profile {
    /// Reads the profile velocity (0x6081), acceleration (0x6083) and deceleration (0x6084). If an object is 0 or
    /// doesn't exist, its default value applies.
    pub fn read(objects: &Objects<'_>) -> Self {
        let acceleration = objects.positive(0x6083).unwrap_or(ACCELERATION);
        Self {
            velocity: objects.positive(0x6081).unwrap_or(VELOCITY).min(objects.max_velocity()),
            acceleration,
            deceleration: objects.positive(0x6084).unwrap_or(acceleration),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_limited_to_their_type() {
        assert_eq!(encoded(DataType::Integer8, 200), [127]);
        assert_eq!(encoded(DataType::Integer16, -70_000), [0, 0x80]);
        assert_eq!(encoded(DataType::Unsigned8, -1), [0]);
        assert_eq!(encoded(DataType::Bits(63), -1), [0; 8]);
        assert_eq!(encoded(DataType::Bits(3), 9), [7]);
        assert_eq!(encoded(DataType::Integer64, -2), (-2_i64).to_le_bytes());
    }
}

//! Set-points of the mode "profile position" (CiA 402-2 12.2).

use super::motion::Motion;
use super::objects::{Objects, Profile};

/// Bits "change set immediately" and "relative" of the controlword.
const IMMEDIATELY: u16 = 1 << 5;
const RELATIVE: u16 = 1 << 6;

/// A set-point that the controller has sent.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SetPoint {
    position: f64,
    is_relative: bool,
    profile: Profile,
}

/// The active set-point, and the set-point that becomes active next.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SetPoints {
    active: Option<(f64, Profile)>,
    waiting: Option<SetPoint>,
    /// Last target position. A relative set-point refers to this position, unless 0x60F2 selects the actual position.
    last: Option<f64>,
    /// True from the acceptance of a set-point until the controller clears the bit "new set-point".
    is_accepted: bool,
    /// True if a position limit changed the last target.
    is_limited: bool,
}

impl SetPoints {
    /// Handles the rising edge of the bit "new set-point". If a set-point is already waiting, the new set-point is
    /// ignored, unless the bit "change set immediately" is set.
    pub fn accept(&mut self, control: u16, motion: &Motion, objects: &Objects<'_>) {
        let position = objects.real(0x607A);
        let point = SetPoint { position, is_relative: control & RELATIVE != 0, profile: Profile::read(objects) };
        if control & IMMEDIATELY != 0 || self.active.is_none() {
            self.waiting = None;
            self.start(point, motion, objects);
        } else if self.waiting.is_none() {
            self.waiting = Some(point);
        } else {
            return;
        }
        self.is_accepted = true;
    }

    /// Handles the falling edge of the bit "new set-point".
    pub fn release(&mut self) {
        self.is_accepted = false;
    }

    fn start(&mut self, point: SetPoint, motion: &Motion, objects: &Objects<'_>) {
        // Positioning option code (0x60F2): relative to the last target, or to the position.
        let is_to_last = objects.number(0x60F2).unwrap_or(0) & 0b11 == 0;
        let origin = self.last.filter(|_| is_to_last).unwrap_or(motion.position);
        let wanted = if point.is_relative { origin + point.position } else { point.position };
        let target = objects.position_limits().map_or(wanted, |(low, high)| wanted.clamp(low, high));
        self.is_limited = target != wanted;
        self.last = Some(target);
        self.active = Some((target, point.profile));
    }

    /// Moves the axis for one step.
    pub fn step(&mut self, motion: &mut Motion, objects: &Objects<'_>) {
        motion.is_limited = self.is_limited;
        let Some((target, profile)) = self.active else {
            let Profile { deceleration, .. } = Profile::read(objects);
            return motion.run(0.0, deceleration, deceleration);
        };
        if motion.approach(target, &profile) {
            self.active = None;
            if let Some(next) = self.waiting.take() {
                self.start(next, motion, objects);
            }
        }
    }

    /// Returns the bit "set-point acknowledge".
    pub const fn is_acknowledged(&self) -> bool {
        self.is_accepted || self.waiting.is_some()
    }

    /// Returns whether the axis has reached the target of all set-points.
    pub const fn is_reached(&self) -> bool {
        self.active.is_none()
    }
}

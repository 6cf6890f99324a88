//! Modes of operation of a simulated drive.

use super::motion::Motion;
use super::objects::{Objects, Profile};
use super::state::Stop;
use super::{Drive, HALT};

pub(super) const PROFILE_POSITION: i64 = 1;
pub(super) const PROFILE_VELOCITY: i64 = 3;
pub(super) const HOMING: i64 = 6;
pub(super) const CYCLIC_POSITION: i64 = 8;
pub(super) const CYCLIC_VELOCITY: i64 = 9;
pub(super) const CYCLIC_TORQUE: i64 = 10;

/// Bit of the controlword that starts a motion: "new set-point" or "homing start".
const START: u16 = 1 << 4;
/// Maximum interpolation period in steps.
const MAX_PERIOD: f64 = 10_000.0;

/// Returns whether the drive supports a mode. The object 0x6502 can exclude modes.
pub(super) fn is_supported(mode: i64, objects: &Objects<'_>) -> bool {
    let is_listed = |modes: i64| modes == 0 || modes >> (mode - 1) & 1 == 1;
    match mode {
        0 => true,
        PROFILE_POSITION | PROFILE_VELOCITY | HOMING | CYCLIC_POSITION..=CYCLIC_TORQUE => {
            objects.number(0x6502).map_or(true, is_listed)
        }
        _ => false,
    }
}

/// Velocity at which the friction needs the rated torque.
fn top_velocity(objects: &Objects<'_>) -> f64 {
    objects.positive(0x607F).unwrap_or_else(|| 10.0 * Profile::read(objects).velocity)
}

/// Returns the torque for the present motion, in 0.1 % of the rated torque. The rated torque causes the profile
/// acceleration. The friction is proportional to the velocity.
pub(super) fn torque(motion: &Motion, objects: &Objects<'_>) -> f64 {
    let inertia = motion.acceleration / Profile::read(objects).acceleration;
    1000.0 * (inertia + motion.velocity / top_velocity(objects))
}

/// Returns the number of steps in the interpolation period (0x60C2).
fn period(objects: &Objects<'_>) -> u32 {
    let (Some(mantissa), Some(exponent)) = (objects.sub_number(0x60C2, 1), objects.sub_number(0x60C2, 2)) else {
        return 1;
    };
    let exponent = exponent.clamp(-9, 9) as i32;
    (1000.0 * mantissa as f64 * 10_f64.powi(exponent)).round().clamp(1.0, MAX_PERIOD) as u32
}

impl Drive {
    /// Executes the bits of the controlword that depend on the mode.
    pub(super) fn command_mode(&mut self, rising: u16, falling: u16, objects: &Objects<'_>) {
        let (starts, ends) = (rising & START != 0, falling & START != 0);
        match self.mode {
            PROFILE_POSITION if starts => self.set_points.accept(self.control, &self.motion, objects),
            PROFILE_POSITION if ends => self.set_points.release(),
            HOMING if starts => self.homing.start(objects),
            HOMING if ends => self.homing.abort(),
            _ => {}
        }
    }

    /// Moves the axis for one step in "Operation enabled".
    pub(super) fn operate(&mut self, objects: &Objects<'_>) {
        let motion = &mut self.motion;
        if self.control & HALT != 0 {
            self.homing.abort();
            return Stop::of_option(objects.option(0x605D)).slow_down(motion, objects);
        }
        match self.mode {
            PROFILE_POSITION => self.set_points.step(motion, objects),
            PROFILE_VELOCITY => profile_velocity(motion, objects),
            HOMING => self.homing.step(motion, objects),
            CYCLIC_POSITION => cyclic_position(motion, objects),
            CYCLIC_VELOCITY => cyclic_velocity(motion, objects),
            CYCLIC_TORQUE => cyclic_torque(motion, objects),
            _ => Stop::Ramp.slow_down(motion, objects),
        }
    }
}

fn profile_velocity(motion: &mut Motion, objects: &Objects<'_>) {
    let (profile, most) = (Profile::read(objects), objects.max_velocity());
    let velocity = motion.limited(objects.real(0x60FF), -most, most);
    motion.run(velocity, profile.acceleration, profile.deceleration);
}

fn cyclic_position(motion: &mut Motion, objects: &Objects<'_>) {
    let wanted = objects.real(0x607A) + objects.real(0x60B0);
    let target = objects.position_limits().map_or(wanted, |(low, high)| motion.limited(wanted, low, high));
    motion.follow(target, period(objects), objects.max_velocity());
}

fn cyclic_velocity(motion: &mut Motion, objects: &Objects<'_>) {
    let most = objects.max_velocity();
    let velocity = motion.limited(objects.real(0x60FF) + objects.real(0x60B1), -most, most);
    motion.run(velocity, f64::INFINITY, f64::INFINITY);
}

fn cyclic_torque(motion: &mut Motion, objects: &Objects<'_>) {
    let most = objects.positive(0x6072).unwrap_or(f64::INFINITY);
    let torque = motion.limited(objects.real(0x6071) + objects.real(0x60B2), -most, most);
    let end = torque / 1000.0 * top_velocity(objects);
    // The friction slows the acceleration down, so the velocity approaches its end value exponentially.
    let rate = Profile::read(objects).acceleration / top_velocity(objects);
    let acceleration = (end - motion.velocity).abs() * rate;
    let is_near = (end - motion.velocity).abs() < 0.01;
    let acceleration = if is_near { f64::INFINITY } else { acceleration };
    motion.run(end, acceleration, acceleration);
}

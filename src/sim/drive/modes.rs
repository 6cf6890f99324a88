//! Modes of operation of a simulated drive.

use super::super::clock::STEP;
use super::motion::Motion;
use super::objects::{Objects, Profile};
use super::state::Stop;
use super::{Drive, HALT};

pub(super) const PROFILE_POSITION: i64 = 1;
pub(super) const VELOCITY: i64 = 2;
pub(super) const PROFILE_VELOCITY: i64 = 3;
pub(super) const PROFILE_TORQUE: i64 = 4;
pub(super) const HOMING: i64 = 6;
pub(super) const INTERPOLATED_POSITION: i64 = 7;
pub(super) const CYCLIC_POSITION: i64 = 8;
pub(super) const CYCLIC_VELOCITY: i64 = 9;
pub(super) const CYCLIC_TORQUE: i64 = 10;
pub(super) const CYCLIC_TORQUE_WITH_ANGLE: i64 = 11;

/// Bit of the controlword that starts a motion: "new set-point", "homing start", or "enable interpolation".
pub(super) const START: u16 = 1 << 4;
/// Bits "enable ramp", "unlock ramp" and "reference ramp" of the controlword in the mode "velocity".
const ENABLE_RAMP: u16 = 1 << 4;
const UNLOCK_RAMP: u16 = 1 << 5;
const REFERENCE_RAMP: u16 = 1 << 6;
/// Maximum interpolation period in steps.
const MAX_PERIOD: f64 = 10_000.0;

/// Returns whether the drive supports a mode. The axis must have the target object of the mode, if the mode has one.
/// Object 0x6502 can exclude modes.
pub(super) fn is_supported(mode: i64, objects: &Objects<'_>) -> bool {
    let has_target = match mode {
        0 => return true,
        PROFILE_POSITION | CYCLIC_POSITION => objects.has(0x607A),
        VELOCITY => objects.has(0x6042),
        PROFILE_VELOCITY | CYCLIC_VELOCITY => objects.has(0x60FF),
        PROFILE_TORQUE | CYCLIC_TORQUE | CYCLIC_TORQUE_WITH_ANGLE => objects.has(0x6071),
        HOMING => true,
        INTERPOLATED_POSITION => objects.sub_number(0x60C1, 1).is_some(),
        _ => false,
    };
    let is_listed = |modes: i64| modes == 0 || modes >> (mode - 1) & 1 == 1;
    has_target && objects.number(0x6502).map_or(true, is_listed)
}

/// Returns the velocity at which friction requires the rated torque.
fn top_velocity(objects: &Objects<'_>) -> f64 {
    objects.positive(0x607F).unwrap_or_else(|| 10.0 * Profile::read(objects).velocity)
}

/// Returns the torque for the current motion, in 0.1 % of the rated torque. Without friction, the rated torque produces
/// the profile acceleration. The friction is proportional to the velocity.
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
        if self.control & HALT != 0 {
            self.homing.abort();
            self.torque = 0.0;
            return self.slow_down(Stop::of_option(objects.option(0x605D)), objects);
        }
        let motion = &mut self.motion;
        match self.mode {
            PROFILE_POSITION => self.set_points.step(motion, objects),
            VELOCITY => velocity(motion, self.control, objects),
            PROFILE_VELOCITY => profile_velocity(motion, objects),
            PROFILE_TORQUE => {
                self.torque = ramped_torque(self.torque, motion, objects);
                drive_with(self.torque, motion, objects);
            }
            HOMING => self.homing.step(motion, objects),
            INTERPOLATED_POSITION if self.control & START != 0 => interpolated_position(motion, objects),
            CYCLIC_POSITION => cyclic_position(motion, objects),
            CYCLIC_VELOCITY => cyclic_velocity(motion, objects),
            CYCLIC_TORQUE | CYCLIC_TORQUE_WITH_ANGLE => cyclic_torque(motion, objects),
            _ => self.slow_down(Stop::Ramp, objects),
        }
    }

    /// Slows the axis down for one step, and discards the cyclic target position.
    pub(super) fn slow_down(&mut self, stop: Stop, objects: &Objects<'_>) {
        if !self.motion.is_still() {
            let profile = Profile::read(objects).deceleration;
            let deceleration = match stop {
                Stop::Coast => profile / 4.0,
                Stop::Ramp if self.mode == VELOCITY => objects.ramp(0x6049, profile),
                Stop::Ramp => profile,
                Stop::QuickRamp if self.mode == VELOCITY => objects.ramp(0x604A, objects.quick_deceleration()),
                Stop::QuickRamp => objects.quick_deceleration(),
            };
            self.motion.run(0.0, deceleration, deceleration);
        }
        self.motion.hold();
    }
}

/// Moves the axis in the mode "velocity" (CiA 402-2 19). Without the bit "enable ramp", the axis stops. Without "unlock
/// ramp", the axis keeps its velocity. Without "reference ramp", the axis ramps to velocity 0.
fn velocity(motion: &mut Motion, control: u16, objects: &Objects<'_>) {
    let profile = Profile::read(objects);
    let is_enabled = control & ENABLE_RAMP != 0;
    let wanted = match control & REFERENCE_RAMP {
        _ if is_enabled && control & UNLOCK_RAMP == 0 => motion.velocity,
        0 => 0.0,
        _ if is_enabled => vl_target(motion, objects),
        _ => 0.0,
    };
    motion.run(wanted, objects.ramp(0x6048, profile.acceleration), objects.ramp(0x6049, profile.deceleration));
}

/// Returns the target velocity (0x6042). Its magnitude is limited to the range in 0x6046 and to the maximum velocity.
fn vl_target(motion: &mut Motion, objects: &Objects<'_>) -> f64 {
    let target = objects.real(0x6042);
    let low = objects.sub_number(0x6046, 1).unwrap_or(0) as f64;
    let high = objects.sub_number(0x6046, 2).filter(|most| *most > 0).map_or(f64::INFINITY, |most| most as f64);
    motion.limited(target.abs(), low.min(high), high.min(objects.max_velocity())).copysign(target)
}

fn profile_velocity(motion: &mut Motion, objects: &Objects<'_>) {
    let (profile, most) = (Profile::read(objects), objects.max_velocity());
    let velocity = motion.limited(objects.real(0x60FF), -most, most);
    motion.run(velocity, profile.acceleration, profile.deceleration);
}

/// Moves the axis toward a position that it reaches at the end of the interpolation period.
fn interpolate(wanted: f64, motion: &mut Motion, objects: &Objects<'_>) {
    let target = objects.position_limits().map_or(wanted, |(low, high)| motion.limited(wanted, low, high));
    motion.follow(target, period(objects), objects.max_velocity());
}

/// Moves the axis toward the position in the interpolation data record (0x60C1:01).
fn interpolated_position(motion: &mut Motion, objects: &Objects<'_>) {
    interpolate(data_record(objects), motion, objects);
}

/// Returns the position in the interpolation data record.
pub(super) fn data_record(objects: &Objects<'_>) -> f64 {
    objects.sub_number(0x60C1, 1).unwrap_or(0) as f64
}

fn cyclic_position(motion: &mut Motion, objects: &Objects<'_>) {
    interpolate(objects.real(0x607A) + objects.real(0x60B0), motion, objects);
}

fn cyclic_velocity(motion: &mut Motion, objects: &Objects<'_>) {
    let most = objects.max_velocity();
    let velocity = motion.limited(objects.real(0x60FF) + objects.real(0x60B1), -most, most);
    motion.run(velocity, f64::INFINITY, f64::INFINITY);
}

fn cyclic_torque(motion: &mut Motion, objects: &Objects<'_>) {
    let torque = limited_torque(objects.real(0x6071) + objects.real(0x60B2), motion, objects);
    drive_with(torque, motion, objects);
}

/// Returns `torque`, limited by the maximum torque (0x6072).
fn limited_torque(torque: f64, motion: &mut Motion, objects: &Objects<'_>) -> f64 {
    let most = objects.positive(0x6072).unwrap_or(f64::INFINITY);
    motion.limited(torque, -most, most)
}

/// Returns the torque after one step toward the target torque (0x6071), limited by the torque slope (0x6087). Without a
/// slope, the torque changes immediately.
fn ramped_torque(torque: f64, motion: &mut Motion, objects: &Objects<'_>) -> f64 {
    let target = limited_torque(objects.real(0x6071), motion, objects);
    let most = objects.positive(0x6087).map_or(f64::INFINITY, |slope| slope * STEP.as_secs_f64());
    torque + (target - torque).clamp(-most, most)
}

/// Moves the axis for one step with a torque in 0.1 % of the rated torque.
fn drive_with(torque: f64, motion: &mut Motion, objects: &Objects<'_>) {
    let end = torque / 1000.0 * top_velocity(objects);
    // The friction slows the acceleration down, so the velocity approaches its end value exponentially.
    let rate = Profile::read(objects).acceleration / top_velocity(objects);
    let acceleration = (end - motion.velocity).abs() * rate;
    let is_near = (end - motion.velocity).abs() < 0.01;
    let acceleration = if is_near { f64::INFINITY } else { acceleration };
    motion.run(end, acceleration, acceleration);
}

//! Motion of a simulated axis.

use super::super::clock::STEP;

/// Number of positions of an axis. In velocity and torque modes, the position wraps around.
const POSITIONS: f64 = 4_294_967_296.0;

/// Position and velocity of an axis, in position units and seconds.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Motion {
    pub position: f64,
    pub velocity: f64,
    /// Acceleration in the last step.
    pub acceleration: f64,
    /// Position demand.
    pub demand: f64,
    /// True if a limit changed the set-point in the last step.
    pub is_limited: bool,
    /// Last cyclic target position, and the number of steps until the demand reaches this position.
    cyclic: Option<(f64, u32)>,
}

fn step_time() -> f64 {
    STEP.as_secs_f64()
}

impl Motion {
    /// Sets the position of the axis without a motion.
    pub fn place(&mut self, position: f64) {
        *self = Self { position, demand: position, cyclic: None, ..*self };
    }

    /// Begins a step: clears the acceleration and the limit flag of the last step.
    pub fn begin(&mut self) {
        (self.is_limited, self.acceleration) = (false, 0.0);
    }

    /// Discards the cyclic target position, and sets the demand to the actual position.
    pub fn hold(&mut self) {
        (self.demand, self.cyclic) = (self.position, None);
    }

    pub fn is_still(&self) -> bool {
        self.velocity == 0.0
    }

    /// Limits `value` to the range from `low` to `high`, and stores whether it was outside this range.
    pub fn limited(&mut self, value: f64, low: f64, high: f64) -> f64 {
        let limited = value.max(low).min(high);
        self.is_limited |= limited != value;
        limited
    }

    /// Moves the axis for one step at this velocity.
    fn advance(&mut self, velocity: f64) {
        self.acceleration = (velocity - self.velocity) / step_time();
        self.velocity = velocity;
        self.position += velocity * step_time();
        self.demand = self.position;
    }

    /// Returns the velocity after one step on the ramp to `target`.
    fn ramp(&self, target: f64, acceleration: f64, deceleration: f64) -> f64 {
        let speeds_up = target.abs() > self.velocity.abs() && target * self.velocity >= 0.0;
        let most = step_time() * if speeds_up { acceleration } else { deceleration };
        let change = target - self.velocity;
        if change.abs() <= most {
            return target;
        }
        self.velocity + change.clamp(-most, most)
    }

    /// Moves the axis for one step on the ramp to this velocity.
    pub fn run(&mut self, velocity: f64, acceleration: f64, deceleration: f64) {
        self.advance(self.ramp(velocity, acceleration, deceleration));
        if self.position.abs() > POSITIONS / 2.0 {
            self.place(self.position - self.position.signum() * POSITIONS);
        }
    }

    /// Moves the axis for one step toward a position where it stops. Returns whether the axis has arrived.
    pub fn approach(&mut self, target: f64, profile: &super::objects::Profile) -> bool {
        let (distance, time) = (target - self.position, step_time());
        let deceleration = profile.deceleration;
        // The axis can still stop at the target after a step with this speed.
        let possible = deceleration * ((time * time + 2.0 * distance.abs() / deceleration).sqrt() - time);
        let wanted = possible.min(profile.velocity).copysign(distance);
        let velocity = self.ramp(wanted, profile.acceleration, deceleration);
        let is_near = (distance - velocity * time).abs() <= 0.5;
        if is_near && velocity.abs() <= 2.0 * deceleration * time {
            self.advance(0.0);
            self.place(target);
            return true;
        }
        self.advance(velocity);
        false
    }

    /// Moves the axis for one step to a cyclic target position, on a straight line that ends after `period` steps.
    pub fn follow(&mut self, target: f64, period: u32, max_velocity: f64) {
        let left = match self.cyclic {
            Some((last, left)) if last == target => left,
            _ => period,
        };
        let demand = self.demand + (target - self.demand) / f64::from(left.max(1));
        let wanted = (demand - self.position) / step_time();
        let velocity = self.limited(wanted, -max_velocity, max_velocity);
        self.advance(velocity);
        if velocity == wanted {
            self.position = demand;
        }
        self.demand = demand;
        self.cyclic = Some((target, left.saturating_sub(1).max(1)));
    }
}

#[cfg(test)]
mod tests {
    use super::super::objects::Profile;
    use super::*;

    fn moves(profile: Profile, target: f64) -> (u32, f64) {
        let (mut motion, mut steps, mut top) = (Motion::default(), 0, 0.0_f64);
        while !motion.approach(target, &profile) {
            steps += 1;
            top = top.max(motion.velocity.abs());
            assert!(steps < 200_000, "{motion:?}");
            assert!(motion.position.abs() <= target.abs() + 1.0, "{motion:?}");
        }
        assert_eq!((motion.position, motion.velocity), (target, 0.0));
        (steps, top)
    }

    #[test]
    fn a_trapezoid_ends_at_the_target() {
        let profile = Profile { velocity: 1000.0, acceleration: 10_000.0, deceleration: 5000.0 };
        let (steps, top) = moves(profile, -2000.0);
        // 0.1 s of acceleration, 0.2 s of deceleration, and 1.85 s in between.
        assert!((2140..=2160).contains(&steps), "{steps}");
        assert_eq!(top, 1000.0);
        // The axis doesn't reach the profile velocity on a short way.
        assert!(moves(profile, 50.0).1 < 600.0);
        for target in [0.0, 1.0, 2.0, 7.0, 333.0] {
            moves(Profile { velocity: 1e6, acceleration: 1e7, deceleration: 1e7 }, target);
            moves(Profile { velocity: 3.0, acceleration: 1.0, deceleration: 1.0 }, target);
        }
    }
}

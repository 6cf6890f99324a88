//! Mode "homing" (CiA 402-2 13).

use super::motion::Motion;
use super::objects::{Objects, Profile};

/// Number of steps of a homing procedure.
const STEPS: u32 = 100;

/// Progress of homing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Homing {
    /// Not started, or aborted.
    #[default]
    Idle,
    /// Homing ends after this number of steps.
    Running(u32),
    Attained,
    Failed,
}

/// Returns whether a homing method (0x6098) is reserved.
const fn is_reserved(method: i64) -> bool {
    matches!(method, 15 | 16 | 31 | 32 | 36 | 38..)
}

impl Homing {
    /// Starts homing. A reserved homing method causes a homing error.
    pub fn start(&mut self, objects: &Objects<'_>) {
        *self = if is_reserved(objects.option(0x6098)) { Self::Failed } else { Self::Running(STEPS) };
    }

    pub fn abort(&mut self) {
        if matches!(self, Self::Running(_)) {
            *self = Self::Idle;
        }
    }

    /// Executes one step. The position at the end becomes the home position, and the actual position becomes the home
    /// offset (0x607C). The axis doesn't search for switches.
    pub fn step(&mut self, motion: &mut Motion, objects: &Objects<'_>) {
        if !motion.is_still() {
            let Profile { deceleration, .. } = Profile::read(objects);
            return motion.run(0.0, deceleration, deceleration);
        }
        match self {
            Self::Running(0) => {
                motion.place(objects.real(0x607C));
                *self = Self::Attained;
            }
            Self::Running(left) => *left -= 1,
            _ => {}
        }
    }

    /// Returns whether homing is in progress.
    pub const fn is_running(self) -> bool {
        matches!(self, Self::Running(_))
    }
}

//! Node guarding (CiA 301 7.2.8.3.2.1) and TIME (7.2.6) of a node.

use core::time::Duration;

use super::pdo::emit_communication_error;
use super::CanNode;
use crate::clients::canopen::{CanFrame, NmtState};
use crate::time::TimeOfDay;

/// Error code of an emergency message: life guard error or heartbeat error.
const LIFE_GUARD_ERROR: u16 = 0x8130;

/// State of node guarding: the toggle bit, and the time at which the node life time passes.
#[derive(Clone, Debug, Default)]
pub(super) struct Guard {
    toggle: bool,
    deadline: Option<Duration>,
}

impl Guard {
    /// Returns the data byte of the answer to a guarding request. The node expects the next request within `life_time`;
    /// 0 disables life guarding.
    pub fn answer(&mut self, state: NmtState, life_time: Duration, now: Duration) -> u8 {
        let raw = state.raw() | u8::from(self.toggle) << 7;
        self.toggle = !self.toggle;
        self.deadline = (!life_time.is_zero()).then(|| now.saturating_add(life_time));
        raw
    }

    /// Returns the time at which the node life time passes.
    pub const fn deadline(&self) -> Option<Duration> {
        self.deadline
    }

    /// Returns whether the node life time has passed. Returns `true` only once each time the node life time passes.
    pub fn is_expired(&mut self, now: Duration) -> bool {
        let is_expired = self.deadline.is_some_and(|deadline| deadline <= now);
        if is_expired {
            self.deadline = None;
        }
        is_expired
    }
}

impl CanNode {
    /// Answers a node guarding request (CiA 301 7.2.8.3.2.1). A node that produces heartbeats doesn't answer.
    pub(super) fn answer_guarding(&mut self, id: u32) {
        let is_request = id == 0x700 + u32::from(self.device.node_id().get());
        if is_request && self.heartbeat.is_none() {
            let number = |index| self.device.slots.number(index, 0).unwrap_or(0);
            let raw = self.guard.answer(self.state, Duration::from_millis(number(0x100C) * number(0x100D)), self.now);
            CanFrame::new(id, &[raw]).into_iter().for_each(|frame| self.emit(frame));
        }
    }

    /// Reports that the node life time has passed, and changes the NMT state as object 0x1029 declares (CiA 301 7.5.2.32).
    pub(super) fn fail_life_guarding(&mut self) {
        emit_communication_error(&mut self.device, LIFE_GUARD_ERROR);
        if self.state != NmtState::Stopped {
            self.tell();
        }
        match self.device.slots.number(0x1029, 1).unwrap_or(0) {
            0 if self.state == NmtState::Operational => self.enter(NmtState::PreOperational),
            2 => self.enter(NmtState::Stopped),
            _ => {}
        }
    }

    /// Processes a TIME message if the node consumes TIME (0x1012). In Stopped, the message has no effect. Returns true
    /// if the node consumes TIME and the frame is a TIME message.
    pub(super) fn consume_time(&mut self, frame: &CanFrame) -> bool {
        let cob_id = self.device.slots.number(0x1012, 0).filter(|cob_id| cob_id >> 31 & 1 == 1);
        let time = cob_id.and_then(|cob_id| TimeOfDay::of_id(frame, cob_id as u32));
        self.time_of_day = time.filter(|_| self.state != NmtState::Stopped).or(self.time_of_day);
        time.is_some()
    }
}

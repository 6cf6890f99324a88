//! Fastscan, the search for a slave with an unknown address.

use super::address::LssAddress;
use super::command::{FAST_SCAN, IDENTIFIED, START_SCAN};
use super::error::LssError;
use super::service::Message;

/// Fields of a fastscan request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Request {
    pub number: u32,
    /// The slave compares the bits of the number from this bit upwards. [`START_SCAN`] starts a scan.
    pub bit: u8,
    /// Position (0 to 3) of the number that the slave compares.
    pub part: u8,
    /// Position (0 to 3) of the number that the next request compares.
    pub next: u8,
}

impl Request {
    const fn message(self) -> Message {
        let [a, b, c, d] = self.number.to_le_bytes();
        [FAST_SCAN, a, b, c, d, self.bit, self.part, self.next]
    }

    pub const fn of(message: &Message) -> Self {
        let [_, a, b, c, d, bit, part, next] = *message;
        Self { number: u32::from_le_bytes([a, b, c, d]), bit, part, next }
    }
}

/// Returns whether a message is an answer to a fastscan request.
pub(crate) const fn is_identified(message: &Message) -> bool {
    message[0] == IDENTIFIED
}

/// Step of the scan: the question that the current request asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    /// Asks whether there is a slave without a node-ID.
    Start,
    /// Asks whether this bit is 0.
    Bit(u8),
    /// Asks whether all bits of the number are correct.
    Confirm,
    Ended,
}

/// Search for one slave in the state Waiting that has no node-ID, by binary search over its address (CiA 305).
///
/// Send the message that [`next`](Self::next) returns, pass all answers that arrive within a fixed time to
/// [`handle`](Self::handle), then call [`time_out`](Self::time_out). Wait for the full time after each message, because
/// several slaves may answer, and a missing answer is a valid result. A scan that finds a slave takes 133 times the
/// fixed time, and switches this slave to Configuration.
///
/// If an answer is lost or late, the result is [`LssError::Inconclusive`] or, rarely, a wrong address. To verify the
/// address, read its numbers with [`Service::Inquire`](super::Service::Inquire), as `clients::canopen::LssMaster` does.
#[derive(Clone, Debug)]
pub struct FastScan {
    parts: [u32; 4],
    part: u8,
    step: Step,
    is_sent: bool,
    is_answered: bool,
    result: Result<Option<LssAddress>, LssError>,
}

impl Default for FastScan {
    fn default() -> Self {
        Self::new()
    }
}

impl FastScan {
    /// Creates a scan.
    #[must_use]
    pub const fn new() -> Self {
        Self { parts: [0; 4], part: 0, step: Step::Start, is_sent: false, is_answered: false, result: Ok(None) }
    }

    /// Returns the next message to send. Returns `None` if the scan has ended, or if [`time_out`](Self::time_out) has
    /// not been called for the previous message.
    #[allow(clippy::should_implement_trait)]
    pub fn next(&mut self) -> Option<Message> {
        let (bit, next) = match self.step {
            Step::Start => (START_SCAN, 0),
            Step::Bit(bit) => (bit, self.part),
            Step::Confirm => (0, (self.part + 1) % 4),
            Step::Ended => return None,
        };
        if self.is_sent {
            return None;
        }
        self.is_sent = true;
        self.is_answered = false;
        let number = self.parts.get(usize::from(self.part)).copied().unwrap_or_default();
        Some(Request { number, bit, part: self.part, next }.message())
    }

    /// Returns whether the scan is in its first step, which asks whether there is a slave without a node-ID. A lost
    /// answer to this step ends the scan without a result. In this step, the caller can wait longer or repeat the
    /// message.
    #[must_use]
    pub fn is_start(&self) -> bool {
        self.step == Step::Start
    }

    /// Processes a message. Ignores messages that don't answer a fastscan request.
    pub fn handle(&mut self, message: &Message) {
        self.is_answered |= is_identified(message);
    }

    /// Ends the current step. Call this method when the time for answers has passed.
    pub fn time_out(&mut self) {
        self.is_sent = false;
        self.step = match (self.step, self.is_answered) {
            (Step::Start, true) => Step::Bit(31),
            (Step::Start, false) | (Step::Ended, _) => Step::Ended,
            (Step::Bit(bit), is_zero) => {
                if let Some(part) = self.parts.get_mut(usize::from(self.part)).filter(|_| !is_zero) {
                    *part |= 1 << bit;
                }
                bit.checked_sub(1).map_or(Step::Confirm, Step::Bit)
            }
            (Step::Confirm, true) if self.part == 3 => {
                self.result = Ok(Some(LssAddress::from_array(self.parts)));
                Step::Ended
            }
            (Step::Confirm, true) => {
                self.part += 1;
                Step::Bit(31)
            }
            (Step::Confirm, false) => {
                self.result = Err(LssError::Inconclusive);
                Step::Ended
            }
        };
    }

    /// Returns the address of the slave that was found. Returns `None` if no slave without a node-ID has answered, or
    /// if the scan has not ended.
    ///
    /// # Errors
    ///
    /// Returns [`LssError::Inconclusive`] if the answers contradict each other.
    pub const fn result(&self) -> Result<Option<LssAddress>, LssError> {
        self.result
    }
}

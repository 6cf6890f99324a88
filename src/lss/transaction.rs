//! Master side of one LSS service.

use super::error::LssError;
use super::service::{Message, Service};

/// Master side of one LSS service, as a state machine that performs no I/O.
///
/// Send all messages that [`next`](Self::next) returns. Then wait for an answer, and pass it to
/// [`handle`](Self::handle). After the first answer, wait for a short time, because a second answer shows that several
/// slaves execute the service. Call [`time_out`](Self::time_out) when this time, or the timeout for the first answer,
/// has passed.
#[derive(Clone, Debug)]
pub struct Transaction {
    service: Service,
    /// Number of messages that [`next`](Self::next) has returned.
    step: u8,
    answer: Option<Message>,
    result: Option<Result<u32, LssError>>,
}

impl Transaction {
    /// Creates the master side of a service.
    #[must_use]
    pub const fn new(service: Service) -> Self {
        Self { service, step: 0, answer: None, result: None }
    }

    /// Returns the next message to send, or `None` if there is no further message. If slaves don't answer the service,
    /// the call that returns `None` ends the transaction.
    #[allow(clippy::should_implement_trait)]
    pub fn next(&mut self) -> Option<Message> {
        let message = self.service.message(self.step);
        match message {
            Some(_) => self.step += 1,
            None if self.service.answer().is_none() => self.result = Some(Ok(0)),
            None => {}
        }
        message
    }

    /// Returns whether a message is an answer to this service. Don't restart the timeout for other messages.
    #[must_use]
    pub fn accepts(&self, message: &Message) -> bool {
        self.service.answer() == Some(message[0])
    }

    /// Processes an answer. Ignores messages that are not an answer to this service.
    pub fn handle(&mut self, message: &Message) {
        if self.result.is_some() || !self.accepts(message) {
            return;
        }
        if self.answer.is_some() && !self.service.is_for_several() {
            self.result = Some(Err(LssError::SeveralAnswers));
        }
        self.answer = Some(*message);
    }

    /// Returns whether an answer has arrived.
    #[must_use]
    pub const fn is_answered(&self) -> bool {
        self.answer.is_some()
    }

    /// Ends the transaction. Call this method when the time for an answer or for further answers has passed.
    pub fn time_out(&mut self) {
        if self.result.is_none() {
            let answer = self.answer.ok_or(LssError::Timeout);
            self.result = Some(answer.and_then(|answer| self.service.value(&answer)));
        }
    }

    /// Returns the result, or `None` if the transaction has not ended. The value is the number or the node-ID that the
    /// service reads. The node-ID is 0xFF if the slave has none. For services without a value, the value is 0.
    #[must_use]
    pub const fn result(&self) -> Option<Result<u32, LssError>> {
        self.result
    }
}

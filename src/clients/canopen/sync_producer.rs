//! SYNC producer (CiA 301 7.2.5).

use core::time::Duration;

use super::frame::CanFrame;
use super::nmt::{sync, sync_with_counter};
use super::node::Node;
use super::port::{AsyncCanPort, CanPort};
use crate::error::Error;

/// SYNC producer with a fixed period. [`Node::produce_sync`] sends the messages.
///
/// The messages are due at multiples of the period after the first message. A message that is sent late therefore does not
/// delay the next messages. If the program is late by more than one period, the producer skips messages instead of
/// sending several at once, and [counts](Self::skipped) them.
///
/// ```
/// use std::time::Duration;
///
/// use lexibus::clients::canopen::{CanPort, Node, SyncProducer};
/// use lexibus::Error;
///
/// /// A control loop with a cycle of 10 ms. The nodes have the synchronous counter overflow value 8 (0x1019).
/// fn run<P: CanPort>(node: &mut Node<P>, mut cycle: impl FnMut(&mut Node<P>)) -> Result<(), Error<P::Error>> {
///     let mut producer = SyncProducer::new(Duration::from_millis(10)).with_overflow(8).expect("2 to 240");
///     loop {
///         if node.produce_sync(&mut producer)? {
///             cycle(node);
///         }
///         let pause = node.port().now().map(|now| producer.remaining(now));
///         std::thread::sleep(pause.unwrap_or_default());
///     }
/// }
/// ```
#[derive(Clone, Debug)]
pub struct SyncProducer {
    period: Duration,
    overflow: Option<u8>,
    /// Counter of the next message.
    counter: u8,
    /// Time at which the next message is due, or `None` before the first message.
    due: Option<Duration>,
    skipped: u32,
}

impl SyncProducer {
    /// Creates a producer with the communication cycle period `period` (0x1006). The messages have no counter.
    #[must_use]
    pub const fn new(period: Duration) -> Self {
        Self { period, overflow: None, counter: 1, due: None, skipped: 0 }
    }

    /// Returns the producer with a counter from 1 to `overflow`, the synchronous counter overflow value of the nodes
    /// (0x1019). Returns `None` if `overflow` isn't 2 to 240.
    #[must_use]
    pub const fn with_overflow(self, overflow: u8) -> Option<Self> {
        match overflow {
            2..=240 => Some(Self { overflow: Some(overflow), ..self }),
            _ => None,
        }
    }

    /// Returns the time until the next message is due.
    #[must_use]
    pub fn remaining(&self, now: Duration) -> Duration {
        self.due.unwrap_or_default().saturating_sub(now)
    }

    /// Returns the number of messages that were not sent: those whose time passed before the program called the producer,
    /// and those that the interface could not send.
    #[must_use]
    pub const fn skipped(&self) -> u32 {
        self.skipped
    }

    /// Restarts the counter with 1. CiA 301 requires this when the producer enters Stopped.
    pub fn reset_counter(&mut self) {
        self.counter = 1;
    }

    /// Returns the next message if it is due, and plans the one after it.
    fn poll(&mut self, now: Duration) -> Option<CanFrame> {
        let due = *self.due.get_or_insert(now);
        let late = now.checked_sub(due)?;
        let skipped = late.as_nanos().checked_div(self.period.as_nanos()).unwrap_or(0);
        let skipped = u32::try_from(skipped).unwrap_or(u32::MAX);
        self.skipped = self.skipped.saturating_add(skipped);
        self.due = Some(due.saturating_add(self.period.saturating_mul(skipped.saturating_add(1))));
        match self.overflow {
            Some(_) => sync_with_counter(self.counter),
            None => Some(sync()),
        }
    }

    /// Records whether the last message was sent. The counter counts only messages that were sent.
    fn end(&mut self, is_sent: bool) {
        if !is_sent {
            self.skipped = self.skipped.saturating_add(1);
        } else if let Some(overflow) = self.overflow {
            self.counter = if self.counter < overflow { self.counter + 1 } else { 1 };
        }
    }
}

macro_rules! produce {
    ($Port:ident $produce_sync:ident $send:ident $($async:ident $await:ident)?) => {
        impl<P: $Port> Node<P> {
            /// Sends SYNC if it is due. Returns whether a message was sent. Call this method at least once in each period; it
            /// does not wait for the next message.
            ///
            /// # Errors
            ///
            /// - [`Error::Client`] if the interface fails, or [`Error::Timeout`] if the bus stays busy. The producer then
            ///   skips this message.
            /// - [`Error::NoClock`] if the interface has no clock: implement [`CanPort::now`].
            pub $($async)? fn $produce_sync(&mut self, producer: &mut SyncProducer) -> Result<bool, Error<P::Error>> {
                let now = self.port().now().ok_or(Error::NoClock)?;
                let Some(frame) = producer.poll(now) else { return Ok(false) };
                let sent = self.$send(&frame)$(.$await)?;
                producer.end(sent.is_ok());
                sent.map(|()| true)
            }
        }
    };
}

produce! { CanPort produce_sync send }
produce! { AsyncCanPort produce_sync_async send_async async await }

#[cfg(test)]
mod tests {
    use super::*;

    const fn ms(time: u64) -> Duration {
        Duration::from_millis(time)
    }

    #[test]
    fn late_calls_neither_shift_nor_repeat_messages() {
        let mut producer = SyncProducer::new(ms(10));
        let mut is_due = |now| producer.poll(ms(now)).is_some();
        assert_eq!([7, 16, 17, 26, 29, 37].map(&mut is_due), [true, false, true, false, true, true]);
        // The message at 47 ms is skipped. The message at 57 ms is late.
        assert_eq!([65, 66, 67].map(&mut is_due), [true, false, true]);
        assert_eq!((producer.skipped(), producer.remaining(ms(70))), (1, ms(7)));
        assert!(SyncProducer::new(Duration::ZERO).poll(ms(1)).is_some(), "no division by zero");
    }

    #[test]
    fn the_counter_counts_sent_messages() {
        assert!(SyncProducer::new(ms(1)).with_overflow(1).is_none());
        assert!(SyncProducer::new(ms(1)).with_overflow(241).is_none());
        let mut producer = SyncProducer::new(ms(1)).with_overflow(3).expect("a valid value");
        let mut counter = |now, is_sent| {
            let frame = producer.poll(ms(now)).expect("it is due");
            producer.end(is_sent);
            frame.data()[0]
        };
        assert_eq!([counter(0, true), counter(1, false), counter(2, true), counter(3, true)], [1, 2, 2, 3]);
        assert_eq!([counter(4, true), counter(5, true)], [1, 2]);
        assert_eq!(producer.skipped(), 1);
        producer.reset_counter();
        assert_eq!(producer.poll(ms(6)).map(|frame| frame.data()[0]), Some(1));
    }
}

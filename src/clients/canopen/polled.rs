//! Interfaces of `embedded-can`, which are polled.

use core::time::Duration;

use super::frame::CanFrame;
use super::port::{CanPort, MOST_WAITING};

/// CAN port that polls a non-blocking interface of `embedded-can`. The clock is a function that returns the time since
/// any fixed moment.
#[derive(Clone, Debug)]
pub struct Polled<C, T> {
    can: C,
    clock: T,
}

impl<C, T: FnMut() -> Duration> Polled<C, T> {
    /// Creates a port from the interface `can` and a monotonic clock.
    pub const fn new(can: C, clock: T) -> Self {
        Self { can, clock }
    }

    /// Returns the interface.
    pub fn into_inner(self) -> C {
        self.can
    }
}

impl<C: embedded_can::nb::Can, T: FnMut() -> Duration> CanPort for Polled<C, T> {
    type Error = C::Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, C::Error> {
        let end = (self.clock)().saturating_add(patience);
        let Some(mut next) = frame.to_frame::<C::Frame>() else { return Ok(false) };
        let mut is_sent = false;
        loop {
            match self.can.transmit(&next) {
                // A frame of lower priority that was displaced from the transmit buffer is sent after this one.
                Ok(Some(displaced)) => (is_sent, next) = (true, displaced),
                Ok(None) => return Ok(true),
                Err(nb::Error::Other(error)) => return Err(error),
                Err(nb::Error::WouldBlock) if (self.clock)() >= end => return Ok(is_sent),
                Err(nb::Error::WouldBlock) => core::hint::spin_loop(),
            }
        }
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, C::Error> {
        let end = (self.clock)().saturating_add(patience);
        let mut waiting = MOST_WAITING;
        while waiting > 0 {
            let now = (self.clock)();
            let is_late = now >= end;
            match self.can.receive() {
                Ok(frame) => {
                    if let Some(found) =
                        CanFrame::from_frame(&frame).map(|found| found.at(Some(now))).filter(|found| wanted(found))
                    {
                        return Ok(Some(found));
                    }
                    waiting -= usize::from(is_late);
                }
                Err(nb::Error::Other(error)) => return Err(error),
                Err(nb::Error::WouldBlock) if is_late => return Ok(None),
                Err(nb::Error::WouldBlock) => core::hint::spin_loop(),
            }
        }
        Ok(None)
    }

    fn now(&mut self) -> Option<Duration> {
        Some((self.clock)())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clients::canopen::Node;
    use crate::{CobId, NodeId};

    fn frame(id: u16) -> CanFrame {
        CanFrame::new(id.into(), &[]).expect("a frame")
    }

    type Transmitted = nb::Result<Option<Raw>, embedded_can::ErrorKind>;

    /// CAN controller with received frames (only identifiers), and a list of results for the next transmissions.
    #[derive(Default)]
    struct Fifo {
        waiting: std::collections::VecDeque<u16>,
        answers: std::collections::VecDeque<Transmitted>,
        sent: std::vec::Vec<Raw>,
        is_broken: bool,
    }

    #[derive(Clone, Debug, PartialEq)]
    struct Raw(embedded_can::Id);

    fn raw(id: u16) -> Raw {
        Raw(embedded_can::StandardId::new(id).expect("an identifier").into())
    }

    impl embedded_can::Frame for Raw {
        fn new(id: impl Into<embedded_can::Id>, _: &[u8]) -> Option<Self> {
            Some(Self(id.into()))
        }

        fn new_remote(_: impl Into<embedded_can::Id>, _: usize) -> Option<Self> {
            None
        }

        fn is_extended(&self) -> bool {
            false
        }

        fn is_remote_frame(&self) -> bool {
            false
        }

        fn id(&self) -> embedded_can::Id {
            self.0
        }

        fn dlc(&self) -> usize {
            0
        }

        fn data(&self) -> &[u8] {
            &[]
        }
    }

    impl embedded_can::nb::Can for Fifo {
        type Frame = Raw;
        type Error = embedded_can::ErrorKind;

        fn transmit(&mut self, frame: &Raw) -> Transmitted {
            let answer = self.answers.pop_front().unwrap_or(Err(nb::Error::WouldBlock));
            if answer.is_ok() {
                self.sent.push(frame.clone());
            }
            answer
        }

        fn receive(&mut self) -> nb::Result<Raw, Self::Error> {
            if self.is_broken {
                return Err(nb::Error::Other(embedded_can::ErrorKind::Overrun));
            }
            self.waiting.pop_front().map(raw).ok_or(nb::Error::WouldBlock)
        }
    }

    /// Sends frame 1 with a timeout of 5 ms. `answers` are the results of the transmissions. Returns the result and the
    /// frames that the controller accepted.
    fn sent(
        answers: impl IntoIterator<Item = Transmitted>,
    ) -> (Result<bool, embedded_can::ErrorKind>, std::vec::Vec<Raw>) {
        let fifo = Fifo { answers: answers.into_iter().collect(), ..Fifo::default() };
        let mut time = 0;
        let clock = || {
            time += 1;
            Duration::from_millis(time)
        };
        let mut port = Polled::new(fifo, clock);
        (port.send(&frame(1), Duration::from_millis(5)), port.into_inner().sent)
    }

    #[test]
    fn frames_are_sent_as_soon_as_there_is_room() {
        let busy = || Err(nb::Error::WouldBlock);
        assert_eq!(sent([Ok(None)]), (Ok(true), [raw(1)].into()));
        assert_eq!(sent([busy(), busy(), Ok(None)]), (Ok(true), [raw(1)].into()));
        assert_eq!(sent([]), (Ok(false), [].into()));
        // A frame of lower priority is displaced and sent afterwards.
        assert_eq!(sent([Ok(Some(raw(7))), busy(), Ok(None)]), (Ok(true), [raw(1), raw(7)].into()));
        assert_eq!(sent([Ok(Some(raw(7)))]), (Ok(true), [raw(1)].into()));
        let alone = embedded_can::ErrorKind::Acknowledge;
        assert_eq!(sent([Err(nb::Error::Other(alone))]), (Err(alone), [].into()));
    }

    #[test]
    fn a_broken_controller_is_told() {
        let mut port = Polled::new(Fifo { is_broken: true, ..Fifo::default() }, || Duration::ZERO);
        let overrun = embedded_can::ErrorKind::Overrun;
        assert_eq!(port.receive(Duration::ZERO, &mut |_| true), Err(overrun));
    }

    /// The frames of other nodes between two PDOs of a node don't hide the newer PDO.
    #[test]
    fn the_newest_pdo_follows_many_frames_of_other_nodes() {
        let pdo = CobId::from_node(0x180);
        let others = std::iter::repeat_n(0x300, 1000);
        let waiting = [0x185].into_iter().chain(others).chain([0x185]).collect();
        let id = NodeId::new(5).expect("a node-ID");
        let mut node = Node::new(Polled::new(Fifo { waiting, ..Fifo::default() }, || Duration::ZERO), id);
        assert_eq!(node.latest_pdo(pdo).map(|found| found.map(|found| found.id())), Ok(Some(0x185)));
        assert!(node.into_port().into_inner().waiting.is_empty());
    }

    #[test]
    fn what_has_come_is_seen_without_patience() {
        let mut time = 0;
        let clock = || {
            time += 1;
            Duration::from_millis(time)
        };
        let mut port = Polled::new(Fifo { waiting: (1..=100).collect(), ..Fifo::default() }, clock);
        assert_eq!(port.receive(Duration::ZERO, &mut |frame| frame.id() == 90), Ok(Some(frame(90))));
        assert_eq!(port.receive(Duration::from_millis(100), &mut |frame| frame.id() == 1), Ok(None));
        assert_eq!(port.send(&frame(1), Duration::from_millis(5)), Ok(false));
    }
}

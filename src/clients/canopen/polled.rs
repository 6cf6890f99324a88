//! Interfaces that are asked again and again.

use core::time::Duration;

use super::frame::CanFrame;
use super::port::{CanPort, BACKLOG};

/// An interface of `embedded-can` that never waits, and a clock: the time since any moment.
#[derive(Clone, Debug)]
pub struct Polled<C, T> {
    can: C,
    clock: T,
}

impl<C, T: FnMut() -> Duration> Polled<C, T> {
    /// The interface `can`, with a clock that never goes back.
    pub const fn new(can: C, clock: T) -> Self {
        Self { can, clock }
    }

    /// Gives the interface back.
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
                // A frame of lower priority that made room comes back, and is sent after this one.
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
        let mut waiting = BACKLOG;
        while waiting > 0 {
            let is_late = (self.clock)() >= end;
            match self.can.receive() {
                Ok(frame) => {
                    if let Some(own) = CanFrame::from_frame(&frame).filter(|own| wanted(own)) {
                        return Ok(Some(own));
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
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(id: u16) -> CanFrame {
        CanFrame::new(id, &[]).expect("a frame")
    }

    /// A controller with frames that wait in it, each of an identifier.
    struct Fifo(std::collections::VecDeque<u16>);

    #[derive(Clone, Debug)]
    struct Raw(embedded_can::Id);

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

        fn transmit(&mut self, _: &Raw) -> nb::Result<Option<Raw>, Self::Error> {
            Err(nb::Error::WouldBlock)
        }

        fn receive(&mut self) -> nb::Result<Raw, Self::Error> {
            let id = self.0.pop_front().ok_or(nb::Error::WouldBlock)?;
            Ok(Raw(embedded_can::StandardId::new(id).ok_or(nb::Error::WouldBlock)?.into()))
        }
    }

    #[test]
    fn what_has_come_is_seen_without_patience() {
        let mut time = 0;
        let clock = || {
            time += 1;
            Duration::from_millis(time)
        };
        let mut port = Polled::new(Fifo((1..=100).collect()), clock);
        assert_eq!(port.receive(Duration::ZERO, &mut |frame| frame.id() == 90), Ok(Some(frame(90))));
        assert_eq!(port.receive(Duration::from_millis(100), &mut |frame| frame.id() == 1), Ok(None));
        assert_eq!(port.send(&frame(1), Duration::from_millis(5)), Ok(false));
    }
}

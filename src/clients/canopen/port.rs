//! CAN interfaces: what sends frames, and waits for them.

use core::time::Duration;

use super::frame::CanFrame;

/// How many frames that wait in an interface are looked at when the time is up: with no patience at all, those that have
/// come are seen nevertheless, and a bus that is never silent doesn't hold on to its caller.
pub(super) const BACKLOG: usize = 256;

/// A CAN interface that waits for a while.
///
/// An implementation by hand, for a library that has frames and a time limit of its own:
///
/// ```
/// use std::collections::VecDeque;
/// use std::convert::Infallible;
/// use std::time::Duration;
///
/// use lexibus::clients::canopen::{CanFrame, CanPort};
///
/// /// What is sent comes back.
/// #[derive(Default)]
/// struct Loopback(VecDeque<CanFrame>);
///
/// impl CanPort for Loopback {
///     type Error = Infallible;
///
///     fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
///         self.0.push_back(*frame);
///         Ok(true)
///     }
///
///     fn receive(
///         &mut self,
///         _: Duration,
///         wanted: &mut dyn FnMut(&CanFrame) -> bool,
///     ) -> Result<Option<CanFrame>, Infallible> {
///         Ok(std::iter::from_fn(|| self.0.pop_front()).find(|frame| wanted(frame)))
///     }
/// }
///
/// let mut port = Loopback::default();
/// let frame = CanFrame::new(0x080, &[]).expect("a SYNC");
/// port.send(&frame, Duration::ZERO)?;
/// assert_eq!(port.receive(Duration::ZERO, &mut |frame| frame.id() == 0x080)?, Some(frame));
/// # Ok::<(), Infallible>(())
/// ```
pub trait CanPort {
    /// What can go wrong at the interface.
    type Error;

    /// Sends a frame. `false` where that couldn't be done within `patience`.
    ///
    /// # Errors
    ///
    /// Whatever the interface reports.
    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Self::Error>;

    /// The next frame that `wanted` takes; it is shown each frame that comes until it takes one, and those are gone. `None`
    /// where none was taken within `patience`. What has come before is looked at even with no patience.
    ///
    /// # Errors
    ///
    /// Whatever the interface reports.
    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Self::Error>;
}

/// A CAN interface that waits without blocking. The same rules as for [`CanPort`].
#[allow(async_fn_in_trait)]
pub trait AsyncCanPort {
    /// What can go wrong at the interface.
    type Error;

    /// Sends a frame, as [`CanPort::send`] does.
    ///
    /// # Errors
    ///
    /// Whatever the interface reports.
    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Self::Error>;

    /// The next frame that `wanted` takes, as [`CanPort::receive`] gives it.
    ///
    /// # Errors
    ///
    /// Whatever the interface reports.
    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Self::Error>;
}

impl<P: CanPort + ?Sized> CanPort for &mut P {
    type Error = P::Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, P::Error> {
        P::send(self, frame, patience)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, P::Error> {
        P::receive(self, patience, wanted)
    }
}

impl<P: AsyncCanPort + ?Sized> AsyncCanPort for &mut P {
    type Error = P::Error;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, P::Error> {
        P::send(self, frame, patience).await
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, P::Error> {
        P::receive(self, patience, wanted).await
    }
}

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
        let end = (self.clock)() + patience;
        let mut next: Option<C::Frame> = frame.to_frame();
        while let Some(frame) = next.take() {
            // A frame of lower priority that made room comes back, and is sent after this one.
            next = loop {
                match self.can.transmit(&frame) {
                    Ok(displaced) => break displaced,
                    Err(nb::Error::Other(error)) => return Err(error),
                    Err(nb::Error::WouldBlock) if (self.clock)() >= end => return Ok(false),
                    Err(nb::Error::WouldBlock) => core::hint::spin_loop(),
                }
            };
        }
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, C::Error> {
        let end = (self.clock)() + patience;
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

/// An interface that keeps up to `N` frames which came while others were waited for: an emergency message during an SDO
/// transfer isn't lost.
///
/// Of more than `N`, the oldest are lost, and [counted](Buffered::lost).
#[derive(Clone, Debug)]
pub struct Buffered<P, const N: usize> {
    port: P,
    kept: Kept<N>,
}

/// Frames in the order in which they came: `frames[..count]`.
#[derive(Clone, Debug)]
struct Kept<const N: usize> {
    frames: [Option<CanFrame>; N],
    count: usize,
    lost: usize,
}

impl<const N: usize> Kept<N> {
    const fn new() -> Self {
        Self { frames: [None; N], count: 0, lost: 0 }
    }

    fn push(&mut self, frame: CanFrame) {
        if self.count == N {
            self.lost = self.lost.saturating_add(1);
            self.remove(0);
        }
        if let Some(place) = self.frames.get_mut(self.count) {
            *place = Some(frame);
            self.count += 1;
        }
    }

    fn remove(&mut self, at: usize) -> Option<CanFrame> {
        let frame = self.frames.get_mut(at)?.take();
        self.frames[at..].rotate_left(1);
        self.count = self.count.saturating_sub(1);
        frame
    }

    fn take(&mut self, wanted: &mut dyn FnMut(&CanFrame) -> bool) -> Option<CanFrame> {
        let at = self.frames.iter().flatten().position(wanted)?;
        self.remove(at)
    }

    /// Whether `frame` is wanted; it is kept where it isn't.
    fn check(&mut self, frame: &CanFrame, wanted: &mut dyn FnMut(&CanFrame) -> bool) -> bool {
        let is_wanted = wanted(frame);
        if !is_wanted {
            self.push(*frame);
        }
        is_wanted
    }
}

impl<P, const N: usize> Buffered<P, N> {
    /// The interface `port`, with no frame kept.
    pub const fn new(port: P) -> Self {
        Self { port, kept: Kept::new() }
    }

    /// How many frames were lost because `N` others were kept.
    pub const fn lost(&self) -> usize {
        self.kept.lost
    }

    /// Forgets the frames that are kept.
    pub fn clear(&mut self) {
        self.kept = Kept { lost: self.kept.lost, ..Kept::new() };
    }

    /// Gives the interface back; what is kept is lost.
    pub fn into_inner(self) -> P {
        self.port
    }
}

impl<P: CanPort, const N: usize> CanPort for Buffered<P, N> {
    type Error = P::Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, P::Error> {
        self.port.send(frame, patience)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, P::Error> {
        if let Some(frame) = self.kept.take(wanted) {
            return Ok(Some(frame));
        }
        let kept = &mut self.kept;
        self.port.receive(patience, &mut |frame| kept.check(frame, wanted))
    }
}

impl<P: AsyncCanPort, const N: usize> AsyncCanPort for Buffered<P, N> {
    type Error = P::Error;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, P::Error> {
        self.port.send(frame, patience).await
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, P::Error> {
        if let Some(frame) = self.kept.take(wanted) {
            return Ok(Some(frame));
        }
        let kept = &mut self.kept;
        self.port.receive(patience, &mut |frame| kept.check(frame, wanted)).await
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(id: u16) -> CanFrame {
        CanFrame::new(id, &[]).expect("a frame")
    }

    #[test]
    fn frames_are_kept_in_their_order() {
        let mut kept = Kept::<2>::new();
        for id in [1, 2, 3] {
            assert!(!kept.check(&frame(id), &mut |_| false));
        }
        assert!(kept.check(&frame(9), &mut |_| true));
        assert_eq!((kept.count, kept.lost), (2, 1));
        assert_eq!(kept.take(&mut |frame| frame.id() == 3), Some(frame(3)));
        assert_eq!(kept.take(&mut |frame| frame.id() == 1), None);
        kept.push(frame(4));
        assert_eq!(kept.take(&mut |_| true), Some(frame(2)));
        assert_eq!(kept.take(&mut |_| true), Some(frame(4)));
        assert_eq!((kept.take(&mut |_| true), kept.count, kept.lost), (None, 0, 1));
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

    #[test]
    fn nothing_is_kept_in_no_room() {
        let mut kept = Kept::<0>::new();
        kept.push(frame(1));
        assert_eq!((kept.take(&mut |_| true), kept.lost), (None, 1));
    }
}

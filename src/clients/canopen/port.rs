//! CAN interfaces: traits to send frames and to wait for frames.

use core::time::Duration;

use super::frame::CanFrame;
use crate::clock::{Clock, DefaultClock};

/// Maximum number of matching frames that one call processes, so that a busy bus doesn't block the caller forever.
pub(super) const BACKLOG: usize = 256;

/// Maximum number of frames that are read from the receive queue of an interface after the timeout: more than any queue
/// holds. Frames that have already arrived are therefore found even with a timeout of zero.
pub(super) const MOST_WAITING: usize = 0x1_0000;

/// CAN interface with timeouts.
///
/// Implement this trait for a library with its own frame type:
///
/// ```
/// use std::collections::VecDeque;
/// use std::convert::Infallible;
/// use std::time::Duration;
///
/// use lexibus::clients::canopen::{CanFrame, CanPort};
///
/// /// Receives the frames that it sends.
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
    /// Error type of the interface.
    type Error;

    /// Sends a frame. Returns `false` if the frame could not be sent within `patience`.
    ///
    /// # Errors
    ///
    /// Returns the errors of the interface.
    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Self::Error>;

    /// Waits for a frame that `wanted` accepts and returns it. Passes each received frame to `wanted`. Rejected frames
    /// are lost. Returns `None` if `wanted` accepts no frame within `patience`. Frames that have already arrived are
    /// passed to `wanted` even if `patience` is zero.
    ///
    /// # Errors
    ///
    /// Returns the errors of the interface.
    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Self::Error>;

    /// Returns the time since a fixed moment, or `None` if the port has no clock. The port sets this time in received
    /// frames with [`CanFrame::at`]. A [`Node`](super::Node) uses the clock to limit the duration of a transfer. The
    /// default implementation uses the [`DefaultClock`].
    fn now(&mut self) -> Option<Duration> {
        DefaultClock.now()
    }
}

/// Non-blocking CAN interface with timeouts, under the same rules as [`CanPort`].
#[allow(async_fn_in_trait)]
pub trait AsyncCanPort {
    /// Error type of the interface.
    type Error;

    /// Sends a frame, as [`CanPort::send`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of the interface.
    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Self::Error>;

    /// Waits for a frame that `wanted` accepts, as [`CanPort::receive`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of the interface.
    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Self::Error>;

    /// Returns the time since a fixed moment, as [`CanPort::now`] does.
    fn now(&mut self) -> Option<Duration> {
        DefaultClock.now()
    }
}

macro_rules! borrowed {
    ($Port:ident $($async:ident $await:ident)?) => {
        impl<P: $Port + ?Sized> $Port for &mut P {
            type Error = P::Error;

            $($async)? fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, P::Error> {
                P::send(self, frame, patience)$(.$await)?
            }

            $($async)? fn receive(
                &mut self,
                patience: Duration,
                wanted: &mut dyn FnMut(&CanFrame) -> bool,
            ) -> Result<Option<CanFrame>, P::Error> {
                P::receive(self, patience, wanted)$(.$await)?
            }

            fn now(&mut self) -> Option<Duration> {
                P::now(self)
            }
        }
    };
}

borrowed! { CanPort }
borrowed! { AsyncCanPort async await }

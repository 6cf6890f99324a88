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
        }
    };
}

borrowed! { CanPort }
borrowed! { AsyncCanPort async await }

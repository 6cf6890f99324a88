//! Handles of a network as CAN ports.

use core::future::poll_fn;
use core::task::{Poll, Waker};
use core::time::Duration;

use super::super::frame::CanFrame;
use super::super::port::{AsyncCanPort, CanPort, MOST_WAITING};
use super::{Network, NetworkPort};
use crate::clock::elapsed;

/// Maximum time for which an async handle uses the interface before the other handles can use it.
const SLICE: Duration = Duration::from_millis(1);

/// The interface while a handle uses it. When this value is dropped, the network gets the interface back, even if the
/// future of the handle was dropped.
struct Used<'n, P, const N: usize> {
    network: &'n Network<P, N>,
    port: Option<P>,
}

impl<P, const N: usize> Drop for Used<'_, P, N> {
    fn drop(&mut self) {
        self.put_back();
    }
}

impl<P, const N: usize> Used<'_, P, N> {
    /// Gives the interface back to the network, and returns whether other handles wait for it.
    fn release(mut self) -> bool {
        self.put_back()
    }

    fn put_back(&mut self) -> bool {
        let Some(port) = self.port.take() else { return false };
        self.network.port.set(Some(port));
        self.network.turn.set(self.network.turn.get().wrapping_add(1));
        self.network.wake()
    }
}

impl<P, const N: usize> NetworkPort<'_, P, N> {
    /// Takes the interface, unless another handle uses it. `now` returns the time of the interface.
    fn using(&self, now: impl FnOnce(&mut P) -> Option<Duration>) -> Option<Used<'_, P, N>> {
        let mut port = self.network.port.take()?;
        self.network.time.set(now(&mut port));
        Some(Used { network: self.network, port: Some(port) })
    }

    /// Returns the time of the interface, or its last known time if another handle uses the interface.
    fn time(&self, now: impl FnOnce(&mut P) -> Option<Duration>) -> Option<Duration> {
        if let Some(mut port) = self.network.port.take() {
            self.network.time.set(now(&mut port));
            self.network.port.set(Some(port));
        }
        self.network.time.get()
    }

    /// Waits until another handle has received a frame or returned the interface.
    async fn pause(&self) {
        once_pending(|waker| self.network.note(waker)).await;
    }

    /// Lets the other handles run.
    async fn give_way(&self) {
        once_pending(Waker::wake_by_ref).await;
    }
}

/// Is pending at the first poll, which passes the waker to `first`, and ready at the second poll.
async fn once_pending(first: impl Fn(&Waker)) {
    let mut was_polled = false;
    let once = poll_fn(|context| {
        if was_polled {
            return Poll::Ready(());
        }
        was_polled = true;
        first(context.waker());
        Poll::Pending
    });
    once.await;
}

/// The interface is always free, because only one handle is called at a time.
impl<P: CanPort, const N: usize> CanPort for NetworkPort<'_, P, N> {
    type Error = P::Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, P::Error> {
        match self.using(P::now).as_mut().and_then(|used| used.port.as_mut()) {
            Some(port) => port.send(frame, patience),
            None => Ok(false),
        }
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, P::Error> {
        let (network, owner) = (self.network, self.owner);
        if let Some(frame) = network.take(owner, wanted) {
            return Ok(Some(frame));
        }
        match self.using(P::now).as_mut().and_then(|used| used.port.as_mut()) {
            Some(port) => port.receive(patience, &mut |frame| network.dispatch(owner, frame, wanted)),
            None => Ok(None),
        }
    }

    fn now(&mut self) -> Option<Duration> {
        self.time(P::now)
    }
}

/// Even if `patience` is zero, a handle waits until the handle that uses the interface gives it back, which takes at
/// most 1 ms. A future that uses the interface but is no longer polled never gives it back: drop such a future.
///
/// While another handle uses the interface, [`now`](AsyncCanPort::now) returns the time at which that handle took the
/// interface.
impl<P: AsyncCanPort, const N: usize> AsyncCanPort for NetworkPort<'_, P, N> {
    type Error = P::Error;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, P::Error> {
        let (start, mut waited, turn) = (AsyncCanPort::now(self), Duration::ZERO, self.network.turn.get());
        loop {
            let left = patience.saturating_sub(elapsed(start, AsyncCanPort::now(self)).unwrap_or(waited));
            let mut used = self.using(P::now);
            let Some(port) = used.as_mut().and_then(|used| used.port.as_mut()) else {
                if left.is_zero() && self.network.turn.get() != turn {
                    return Ok(false);
                }
                self.pause().await;
                continue;
            };
            let slice = left.min(SLICE);
            let is_sent = port.send(frame, slice).await?;
            if is_sent || left <= slice {
                return Ok(is_sent);
            }
            waited += slice;
            if used.is_some_and(Used::release) {
                self.give_way().await;
            }
        }
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, P::Error> {
        let (network, owner) = (self.network, self.owner);
        let (start, mut waited, turn) = (AsyncCanPort::now(self), Duration::ZERO, self.network.turn.get());
        loop {
            if let Some(frame) = network.take(owner, wanted) {
                return Ok(Some(frame));
            }
            let left = patience.saturating_sub(elapsed(start, AsyncCanPort::now(self)).unwrap_or(waited));
            let slice = left.min(SLICE);
            let mut used = self.using(P::now);
            let Some(port) = used.as_mut().and_then(|used| used.port.as_mut()) else {
                // The handle that uses the interface keeps the frames of this one. The interface may have more frames.
                if left.is_zero() && self.network.turn.get() != turn {
                    return Ok(None);
                }
                self.pause().await;
                continue;
            };
            let frame = port.receive(slice, &mut |frame| network.dispatch(owner, frame, wanted)).await?;
            if frame.is_some() || left <= slice {
                return Ok(frame);
            }
            waited += slice;
            if used.is_some_and(Used::release) {
                self.give_way().await;
            }
        }
    }

    fn now(&mut self) -> Option<Duration> {
        self.time(P::now)
    }
}

macro_rules! clear {
    ($Port:ident $clear:ident $($async:ident $await:ident)?) => {
        impl<P: $Port, const N: usize> NetworkPort<'_, P, N> {
            /// Discards all frames of the node that have already arrived: those that the network has kept and those in
            /// the receive queue of the interface. Any frame that is received later has therefore arrived after this
            /// call. Frames of other handles are kept.
            ///
            /// # Errors
            ///
            /// Returns the errors of the interface.
            pub $($async)? fn $clear(&mut self) -> Result<(), P::Error> {
                for _ in 0..MOST_WAITING {
                    if $Port::receive(self, Duration::ZERO, &mut |_| true)$(.$await)??.is_none() {
                        break;
                    }
                }
                Ok(())
            }
        }
    };
}

clear! { CanPort clear }
clear! { AsyncCanPort clear_async async await }

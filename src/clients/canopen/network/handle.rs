//! Handles of a network as CAN ports.

use core::future::poll_fn;
use core::task::Poll;
use core::time::Duration;

use super::super::frame::CanFrame;
use super::super::port::{AsyncCanPort, CanPort};
use super::{Network, NetworkPort};

/// Longest time for which an async handle waits for a frame before the other handles get the interface.
const SLICE: Duration = Duration::from_millis(1);

/// The interface while a handle uses it. It returns to the network even if the future that uses it is dropped.
struct Used<'n, P, const N: usize> {
    network: &'n Network<P, N>,
    port: Option<P>,
}

impl<P, const N: usize> Drop for Used<'_, P, N> {
    fn drop(&mut self) {
        if let Some(port) = self.port.take() {
            self.network.port.set(Some(port));
            self.network.wake();
        }
    }
}

impl<P, const N: usize> Used<'_, P, N> {
    /// Returns the interface to the network. Returns whether other handles wait for it.
    fn release(mut self) -> bool {
        self.network.port.set(self.port.take());
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

    /// Returns the time of the interface, or its latest time if another handle uses the interface.
    fn time(&self, now: impl FnOnce(&mut P) -> Option<Duration>) -> Option<Duration> {
        if let Some(mut port) = self.network.port.take() {
            self.network.time.set(now(&mut port));
            self.network.port.set(Some(port));
        }
        self.network.time.get()
    }

    /// Waits until another handle has received a frame or returned the interface.
    async fn pause(&self) {
        let mut is_noted = false;
        let noted = poll_fn(|context| {
            if is_noted {
                return Poll::Ready(());
            }
            is_noted = true;
            self.network.note(context.waker());
            Poll::Pending
        });
        noted.await;
    }

    /// Lets the other handles run.
    async fn give_way(&self) {
        let mut has_run = false;
        let others = poll_fn(|context| {
            if has_run {
                return Poll::Ready(());
            }
            has_run = true;
            context.waker().wake_by_ref();
            Poll::Pending
        });
        others.await;
    }
}

/// Returns the time since `start`, or `waited` without a clock.
fn elapsed(start: Option<Duration>, now: Option<Duration>, waited: Duration) -> Duration {
    start.zip(now).map_or(waited, |(start, now)| now.saturating_sub(start))
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
        let (network, node) = (self.network, self.node);
        if let Some(frame) = network.take(node, wanted) {
            return Ok(Some(frame));
        }
        match self.using(P::now).as_mut().and_then(|used| used.port.as_mut()) {
            Some(port) => port.receive(patience, &mut |frame| network.dispatch(node, frame, wanted)),
            None => Ok(None),
        }
    }

    fn now(&mut self) -> Option<Duration> {
        self.time(P::now)
    }
}

/// While another handle uses the interface, [`now`](AsyncCanPort::now) returns the time at which it took the interface.
impl<P: AsyncCanPort, const N: usize> AsyncCanPort for NetworkPort<'_, P, N> {
    type Error = P::Error;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, P::Error> {
        let start = AsyncCanPort::now(self);
        loop {
            let waited = elapsed(start, AsyncCanPort::now(self), Duration::ZERO);
            if let Some(port) = self.using(P::now).as_mut().and_then(|used| used.port.as_mut()) {
                return port.send(frame, patience.saturating_sub(waited)).await;
            }
            if waited > patience {
                return Ok(false);
            }
            self.pause().await;
        }
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, P::Error> {
        let (network, node) = (self.network, self.node);
        let (start, mut waited) = (AsyncCanPort::now(self), Duration::ZERO);
        loop {
            if let Some(frame) = network.take(node, wanted) {
                return Ok(Some(frame));
            }
            let left = patience.saturating_sub(elapsed(start, AsyncCanPort::now(self), waited));
            let is_shared = network.nodes.get().count_ones() > 1;
            let slice = if is_shared { left.min(SLICE) } else { left };
            let mut used = self.using(P::now);
            let Some(port) = used.as_mut().and_then(|used| used.port.as_mut()) else {
                // The handle that uses the interface keeps the frames of this one.
                if left.is_zero() {
                    return Ok(None);
                }
                self.pause().await;
                continue;
            };
            let frame = port.receive(slice, &mut |frame| network.dispatch(node, frame, wanted)).await?;
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

//! An async interface for tests, with simulated time.

use core::cell::{Cell, RefCell};
use core::future::{poll_fn, Future};
use core::pin::pin;
use core::task::{Context, Poll, Waker};
use core::time::Duration;
use std::collections::VecDeque;
use std::sync::Arc;
use std::task::Wake;
use std::vec::Vec;

use super::frame::CanFrame;
use super::port::AsyncCanPort;

/// Returns a waker that does nothing.
pub fn silent() -> Waker {
    struct Silent;
    impl Wake for Silent {
        fn wake(self: Arc<Self>) {}
    }
    Arc::new(Silent).into()
}

/// An async interface on which each wait ends only when its time has passed. The test advances the time.
#[derive(Default)]
pub struct Slow {
    pub now: Cell<Duration>,
    pub received: RefCell<VecDeque<CanFrame>>,
    pub sent: RefCell<Vec<(Duration, CanFrame)>>,
    pub is_busy: Cell<bool>,
}

impl Slow {
    async fn sleep(&self, time: Duration) {
        let end = self.now.get() + time;
        poll_fn(|_| match self.now.get() >= end {
            true => Poll::Ready(()),
            false => Poll::Pending,
        })
        .await;
    }
}

impl AsyncCanPort for &Slow {
    type Error = ();

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, ()> {
        if self.is_busy.get() && frame.id() != 0 {
            self.sleep(patience).await;
            return Ok(false);
        }
        self.sent.borrow_mut().push((self.now.get(), *frame));
        Ok(true)
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, ()> {
        loop {
            let frame = self.received.borrow_mut().pop_front();
            match frame {
                Some(frame) if wanted(&frame) => return Ok(Some(frame)),
                Some(_) => {}
                None => break,
            }
        }
        self.sleep(patience).await;
        Ok(None)
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now.get())
    }
}

/// Polls `long` and `short` in turn, in steps of 0.1 ms for at most 3 ms; `long` must stay pending. Returns the output
/// of `short`, or `None` if it takes longer.
pub fn beside<T>(slow: &Slow, long: impl Future, short: impl Future<Output = T>) -> Option<T> {
    let waker = silent();
    let mut context = Context::from_waker(&waker);
    let (mut long, mut short) = (pin!(long), pin!(short));
    for _ in 0..30 {
        assert!(long.as_mut().poll(&mut context).is_pending());
        if let Poll::Ready(output) = short.as_mut().poll(&mut context) {
            return Some(output);
        }
        slow.now.set(slow.now.get() + Duration::from_micros(100));
    }
    None
}

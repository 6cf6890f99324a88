//! Clocks and timers, which limit the duration of an exchange.

use core::future::{poll_fn, Future};
use core::hint::spin_loop;
use core::pin::pin;
use core::task::Poll;
use core::time::Duration;

/// Monotonic clock of a blocking client. A function that returns the time since any fixed moment is a clock.
pub trait Clock {
    /// Returns the time since a fixed moment, or `None` if there is no clock.
    fn now(&mut self) -> Option<Duration>;

    /// Waits for a moment between two polls of an interface. The default implementation signals the processor that the
    /// program is in a spin loop. Implement this method for a clock that can sleep. With the feature `std`, [`DefaultClock`]
    /// sleeps for at least 0.1 ms.
    fn pause(&mut self) {
        spin_loop();
    }
}

impl<F: FnMut() -> Duration> Clock for F {
    fn now(&mut self) -> Option<Duration> {
        Some(self())
    }
}

/// Returns the time since `start`, or `None` without a clock.
pub(crate) fn elapsed(start: Option<Duration>, now: Option<Duration>) -> Option<Duration> {
    start.zip(now).map(|(start, now)| now.saturating_sub(start))
}

/// Timer of an async client. A function is a timer if it returns a future that completes after the given time, such as
/// `tokio::time::sleep` or `embassy_time::Timer::after`.
#[allow(async_fn_in_trait)]
pub trait Timer {
    /// True if the timer can expire.
    const EXPIRES: bool = true;

    /// Returns the output of `future`, or `None` if the future takes longer than `time`.
    async fn limit<F: Future>(&mut self, time: Duration, future: F) -> Option<F::Output>;
}

impl<D: FnMut(Duration) -> S, S: Future> Timer for D {
    async fn limit<F: Future>(&mut self, time: Duration, future: F) -> Option<F::Output> {
        let (mut future, mut sleep) = (pin!(future), pin!(self(time)));
        let either = poll_fn(|context| match future.as_mut().poll(context) {
            Poll::Ready(output) => Poll::Ready(Some(output)),
            Poll::Pending => sleep.as_mut().poll(context).map(|_| None),
        });
        either.await
    }
}

/// The clock of the standard library if the feature `std` is enabled; otherwise, no clock. As a [`Timer`], this type
/// never expires, because a timer depends on the executor.
#[derive(Clone, Copy, Debug, Default)]
pub struct DefaultClock;

impl Clock for DefaultClock {
    #[cfg(feature = "std")]
    fn now(&mut self) -> Option<Duration> {
        static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
        // Times before the first use of the clock, such as the arrival of a frame, are not negative.
        const BEFORE: Duration = Duration::from_secs(24 * 60 * 60);
        Some(START.get_or_init(std::time::Instant::now).elapsed() + BEFORE)
    }

    #[cfg(not(feature = "std"))]
    fn now(&mut self) -> Option<Duration> {
        None
    }

    #[cfg(feature = "std")]
    fn pause(&mut self) {
        std::thread::sleep(Duration::from_micros(100));
    }
}

impl Timer for DefaultClock {
    const EXPIRES: bool = false;

    async fn limit<F: Future>(&mut self, _: Duration, future: F) -> Option<F::Output> {
        Some(future.await)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::now::now;

    #[test]
    fn timers() {
        let mut at_once = |_: Duration| core::future::ready(());
        assert_eq!(now(at_once.limit(Duration::ZERO, core::future::ready(5))), Some(5));
        assert_eq!(now(at_once.limit(Duration::ZERO, core::future::pending::<()>())), None);
        assert_eq!(now(DefaultClock.limit(Duration::ZERO, core::future::ready(5))), Some(5));
    }

    #[test]
    fn clocks() {
        let mut time = 0;
        let mut clock = || {
            time += 1;
            Duration::from_secs(time)
        };
        assert_eq!(Clock::now(&mut clock), Some(Duration::from_secs(1)));
        assert_eq!(Clock::now(&mut DefaultClock).is_some(), cfg!(feature = "std"));
    }
}

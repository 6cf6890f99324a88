//! CAN interfaces with a receive buffer.

use core::time::Duration;

use super::frame::CanFrame;
use super::port::{AsyncCanPort, CanPort, MOST_WAITING};

/// CAN interface with a buffer for up to `N` received frames. Frames that arrive while another frame is expected are
/// kept, for example an emergency message during an SDO transfer.
///
/// If a frame arrives while the buffer is full, the oldest frame is lost and [counted](Buffered::lost).
#[derive(Clone, Debug)]
pub struct Buffered<P, const N: usize> {
    port: P,
    kept: Kept<N>,
}

/// Frames in the order of arrival; only `frames[..count]` is used.
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

    fn clear(&mut self) {
        *self = Self { lost: self.lost, ..Self::new() };
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
        let rest = self.frames.get_mut(at..)?;
        let frame = rest.first_mut()?.take();
        rest.rotate_left(1);
        self.count = self.count.saturating_sub(1);
        frame
    }

    fn take(&mut self, wanted: &mut dyn FnMut(&CanFrame) -> bool) -> Option<CanFrame> {
        let at = self.frames.iter().flatten().position(wanted)?;
        self.remove(at)
    }

    /// Returns whether `wanted` accepts the frame. Stores a frame that `wanted` rejects.
    fn check(&mut self, frame: &CanFrame, wanted: &mut dyn FnMut(&CanFrame) -> bool) -> bool {
        let is_wanted = wanted(frame);
        if !is_wanted {
            self.push(*frame);
        }
        is_wanted
    }
}

impl<P, const N: usize> Buffered<P, N> {
    /// Creates an interface over `port` with an empty buffer.
    pub const fn new(port: P) -> Self {
        Self { port, kept: Kept::new() }
    }

    /// Returns how many frames were lost because the buffer was full.
    pub const fn lost(&self) -> usize {
        self.kept.lost
    }

    /// Returns the wrapped interface and drops the buffer.
    pub fn into_inner(self) -> P {
        self.port
    }
}

macro_rules! buffered {
    ($Port:ident $clear:ident $($async:ident $await:ident)?) => {
        impl<P: $Port, const N: usize> Buffered<P, N> {
            /// Discards all frames that have already arrived: those in the buffer and those in the receive queue of the
            /// interface. Any frame that is received later has therefore arrived after this call.
            ///
            /// # Errors
            ///
            /// Returns the errors of the interface.
            pub $($async)? fn $clear(&mut self) -> Result<(), P::Error> {
                self.kept.clear();
                for _ in 0..MOST_WAITING {
                    let waiting = self.port.receive(Duration::ZERO, &mut |_| true)$(.$await)?;
                    if waiting?.is_none() {
                        break;
                    }
                }
                Ok(())
            }
        }

        impl<P: $Port, const N: usize> $Port for Buffered<P, N> {
            type Error = P::Error;

            $($async)? fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, P::Error> {
                self.port.send(frame, patience)$(.$await)?
            }

            $($async)? fn receive(
                &mut self,
                patience: Duration,
                wanted: &mut dyn FnMut(&CanFrame) -> bool,
            ) -> Result<Option<CanFrame>, P::Error> {
                if let Some(frame) = self.kept.take(wanted) {
                    return Ok(Some(frame));
                }
                let kept = &mut self.kept;
                self.port.receive(patience, &mut |frame| kept.check(frame, wanted))$(.$await)?
            }

            fn now(&mut self) -> Option<Duration> {
                self.port.now()
            }
        }
    };
}

buffered! { CanPort clear }
buffered! { AsyncCanPort clear_async async await }

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(id: u16) -> CanFrame {
        CanFrame::new(id.into(), &[]).expect("a frame")
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

    #[test]
    fn nothing_is_kept_in_no_room() {
        let mut kept = Kept::<0>::new();
        kept.push(frame(1));
        assert_eq!((kept.take(&mut |_| true), kept.lost), (None, 1));
    }
}

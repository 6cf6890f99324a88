//! SocketCAN, the CAN interfaces of Linux.

use std::io;
use std::time::{Duration, Instant};

use socketcan::{CanSocket, Socket};

use super::frame::CanFrame;
use super::port::{CanPort, BACKLOG};

impl CanPort for CanSocket {
    type Error = io::Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, io::Error> {
        let Some(frame) = frame.to_frame::<socketcan::CanFrame>() else { return Ok(false) };
        // No time at all would be time without end.
        self.set_write_timeout(patience.max(Duration::from_micros(1)))?;
        let end = Instant::now().checked_add(patience);
        loop {
            match self.write_frame(&frame) {
                Ok(()) => return Ok(true),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) if is_late(&error) => return Ok(false),
                Err(error) if is_full(&error) => {
                    if end.is_some_and(|end| Instant::now() >= end) {
                        return Ok(false);
                    }
                    std::thread::sleep(PAUSE);
                }
                Err(error) => return Err(error),
            }
        }
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, io::Error> {
        let end = Instant::now().checked_add(patience);
        let mut waiting = BACKLOG;
        while waiting > 0 {
            let left = end.map_or(patience, |end| end.saturating_duration_since(Instant::now()));
            match self.read_frame_timeout(left) {
                Ok(frame) => {
                    if let Some(own) = CanFrame::from_frame(&frame).filter(|own| wanted(own)) {
                        return Ok(Some(own));
                    }
                    waiting -= usize::from(left.is_zero());
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) if is_late(&error) => return Ok(None),
                Err(error) => return Err(error),
            }
        }
        Ok(None)
    }
}

/// How long to wait where the queue of the interface is full: about a frame of 125 kbit/s.
pub(super) const PAUSE: Duration = Duration::from_millis(1);

/// Whether the queue of the interface is full, as it soon is where no other node acknowledges frames.
pub(super) fn is_full(error: &io::Error) -> bool {
    error.raw_os_error() == Some(libc::ENOBUFS)
}

fn is_late(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut)
}

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
        self.set_write_timeout(patience)?;
        match self.write_frame(&frame) {
            Ok(()) => Ok(true),
            Err(error) if is_late(&error) => Ok(false),
            Err(error) => Err(error),
        }
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, io::Error> {
        let end = Instant::now() + patience;
        let mut waiting = BACKLOG;
        while waiting > 0 {
            let left = end.saturating_duration_since(Instant::now());
            match self.read_frame_timeout(left) {
                Ok(frame) => {
                    if let Some(own) = CanFrame::from_frame(&frame).filter(|own| wanted(own)) {
                        return Ok(Some(own));
                    }
                    waiting -= usize::from(left.is_zero());
                }
                Err(error) if is_late(&error) => return Ok(None),
                Err(error) => return Err(error),
            }
        }
        Ok(None)
    }
}

fn is_late(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut)
}

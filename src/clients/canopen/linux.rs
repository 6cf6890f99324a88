//! Blocking access to the CAN interfaces of Linux (SocketCAN).

use std::io;
use std::time::{Duration, Instant};

use socketcan::{CanError, CanSocket, Error, Socket};

use super::frame::CanFrame;
use super::port::{CanPort, MOST_WAITING};
use crate::clock::{Clock, DefaultClock};

impl CanPort for CanSocket {
    type Error = Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Error> {
        let Some(frame) = frame.to_frame::<socketcan::CanFrame>() else { return Ok(false) };
        // A timeout of zero would disable the timeout.
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
                Err(error) => return Err(error.into()),
            }
        }
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Error> {
        let end = Instant::now().checked_add(patience);
        let mut waiting = MOST_WAITING;
        while waiting > 0 {
            let left = end.map_or(patience, |end| end.saturating_duration_since(Instant::now()));
            match self.read_frame_timeout(left) {
                Ok(frame) => {
                    if let Some(found) = received(&frame)?.filter(|found| wanted(found)) {
                        return Ok(Some(found));
                    }
                    waiting -= usize::from(left.is_zero());
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) if is_late(&error) => return Ok(None),
                Err(error) => return Err(error.into()),
            }
        }
        Ok(None)
    }
}

/// Pause before the next attempt if the transmit queue is full: about the duration of one frame at 125 kbit/s.
pub(super) const PAUSE: Duration = Duration::from_millis(1);

/// Returns whether the error reports a full transmit queue. The queue fills up if no other node acknowledges frames.
pub(super) fn is_full(error: &io::Error) -> bool {
    error.raw_os_error() == Some(libc::ENOBUFS)
}

/// Converts a data frame or a remote frame.
///
/// # Errors
///
/// Returns the error in an error frame. The interface itself generates error frames, and the socket receives only those
/// that match its error filter.
fn from_socket(frame: &socketcan::CanFrame) -> Result<Option<CanFrame>, CanError> {
    match frame {
        socketcan::CanFrame::Data(_) | socketcan::CanFrame::Remote(_) => Ok(CanFrame::from_frame(frame)),
        // An error frame can report several errors. Bus-off takes precedence because it ends the communication.
        socketcan::CanFrame::Error(error) if error.error_bits() & BUS_OFF != 0 => Err(CanError::BusOff),
        socketcan::CanFrame::Error(error) => Err(CanError::from(*error)),
    }
}

/// Converts a frame as [`from_socket`] does, and sets its time.
pub(super) fn received(frame: &socketcan::CanFrame) -> Result<Option<CanFrame>, CanError> {
    Ok(from_socket(frame)?.map(|frame| frame.at(DefaultClock.now())))
}

/// Bit of an error frame that reports bus-off.
const BUS_OFF: u32 = libc::CAN_ERR_BUSOFF;

fn is_late(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut)
}

#[cfg(test)]
mod tests {
    use socketcan::{CanErrorFrame, CanFrame as SocketFrame, EmbeddedFrame, StandardId};

    use super::*;

    #[test]
    fn error_frames_are_errors() {
        let id = StandardId::new(0x088).expect("an identifier");
        let data = SocketFrame::new(id, &[1, 2]).expect("a frame");
        assert_eq!(from_socket(&data).ok(), Some(CanFrame::new(0x088, &[1, 2])));
        let error = |bits| SocketFrame::Error(CanErrorFrame::new_error(bits, &[0; 8]).expect("an error"));
        assert!(matches!(from_socket(&error(0x040)), Err(CanError::BusOff)));
        assert!(matches!(from_socket(&error(0x042)), Err(CanError::BusOff)));
        assert!(matches!(from_socket(&error(0x020)), Err(CanError::NoAck)));
        let remote = SocketFrame::new_remote(id, 2).expect("a request");
        assert_eq!(from_socket(&remote).ok(), Some(CanFrame::remote(0x088, 2)));
        for frame in [
            CanFrame::remote(0x088, 2),
            CanFrame::remote(CanFrame::EXTENDED | 0x1234_5678, 8),
            CanFrame::new(CanFrame::EXTENDED | 0x088, &[1, 2, 3]),
        ] {
            let socket: SocketFrame = frame.and_then(|frame| frame.to_frame()).expect("a frame");
            assert_eq!(from_socket(&socket).ok(), Some(frame));
        }
        let time = received(&data).ok().flatten().and_then(|frame| frame.time());
        assert!(time.is_some_and(|time| Some(time) <= DefaultClock.now()));
    }
}

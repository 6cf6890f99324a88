//! Blocking access to the CAN interfaces of Linux (SocketCAN).

use std::io;
use std::os::fd::AsFd;
use std::time::{Duration, Instant, SystemTime};

use nix::poll::{poll, PollFd, PollFlags, PollTimeout};
use socketcan::{CanError, CanSocket, Error, Socket, SocketOptions};

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
        stamp(self);
        let end = Instant::now().checked_add(patience);
        let mut waiting = MOST_WAITING;
        while waiting > 0 {
            let left = end.map_or(patience, |end| end.saturating_duration_since(Instant::now()));
            match read(self, left) {
                Ok((frame, arrival)) => {
                    if let Some(found) = received(&frame, arrival)?.filter(|found| wanted(found)) {
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

/// Makes the kernel report when each frame arrived. If the kernel rejects this option, the time of a frame is the time at
/// which it is read.
pub(super) fn stamp(socket: &impl SocketOptions) {
    let _ = socket.set_recv_timestamp(true);
}

/// Waits for a frame. Returns the frame and its arrival time according to the system clock. The time is `None` if the kernel
/// reports no timestamp.
fn read(socket: &CanSocket, patience: Duration) -> io::Result<(socketcan::CanFrame, Option<SystemTime>)> {
    let timeout = PollTimeout::try_from(patience).unwrap_or(PollTimeout::MAX);
    match poll(&mut [PollFd::new(socket.as_fd(), PollFlags::POLLIN)], timeout)? {
        0 => Err(io::ErrorKind::TimedOut.into()),
        _ => socket.read_frame_with_timestamps().map(|(frame, times)| (frame, times.socket)),
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

/// Converts a frame as [`from_socket`] does, and sets the time of its arrival.
pub(super) fn received(frame: &socketcan::CanFrame, arrival: Option<SystemTime>) -> Result<Option<CanFrame>, CanError> {
    Ok(from_socket(frame)?.map(|frame| frame.at(monotonic(arrival))))
}

/// Converts a time of the system clock to a time of the [`DefaultClock`]. Returns the current time if `arrival` is `None` or
/// in the future.
fn monotonic(arrival: Option<SystemTime>) -> Option<Duration> {
    let age = arrival.and_then(|arrival| arrival.elapsed().ok());
    DefaultClock.now().map(|now| now.saturating_sub(age.unwrap_or_default()))
}

/// Bit of an error frame that reports bus-off.
const BUS_OFF: u32 = libc::CAN_ERR_BUSOFF;

fn is_late(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut)
}

#[cfg(test)]
mod tests {
    use std::os::fd::OwnedFd;
    use std::os::unix::net::UnixDatagram;

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
    }

    #[test]
    fn frames_have_the_time_of_their_arrival() {
        // Datagrams of a pair of sockets have timestamps of the kernel, as the frames of a CAN interface do.
        let (near, far) = UnixDatagram::pair().expect("a pair of sockets");
        let [mut near, far] = [near, far].map(|socket| CanSocket::from(OwnedFd::from(socket)));
        let id = StandardId::new(0x185).expect("an identifier");
        let before = DefaultClock.now().expect("a clock");
        assert_eq!(CanPort::receive(&mut near, Duration::ZERO, &mut |_| true).ok(), Some(None));
        far.write_frame(&SocketFrame::new(id, &[1]).expect("a frame")).expect("it is sent");
        let sent = DefaultClock.now().expect("a clock");
        std::thread::sleep(Duration::from_millis(100));
        let frame = CanPort::receive(&mut near, Duration::ZERO, &mut |_| true).ok().flatten().expect("a frame");
        let time = frame.time().expect("a time");
        // The clock of the system can be corrected in the meantime.
        let margin = Duration::from_millis(40);
        assert!(before <= time + margin && time <= sent + margin, "{before:?} {time:?} {sent:?}");
    }

    #[test]
    fn times_before_the_first_use_of_the_clock() {
        let at = |age| monotonic(SystemTime::now().checked_sub(Duration::from_secs(age))).expect("a clock");
        assert!(at(0) - at(3600) >= Duration::from_secs(3599));
        let now = DefaultClock.now().expect("a clock");
        assert!(monotonic(None) >= Some(now));
        assert!(monotonic(Some(SystemTime::now() + Duration::from_secs(9))) >= Some(now));
    }
}

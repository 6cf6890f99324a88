//! Async access to the CAN interfaces of Linux (SocketCAN).

use std::io;
use std::time::Duration;

use socketcan::tokio::CanSocket;
use socketcan::{CanFrame as SocketFrame, Error};
use tokio::time::{sleep, timeout, Instant};

use super::frame::CanFrame;
use super::linux::{is_full, received as frame_of, stamp, PAUSE};
use super::port::{AsyncCanPort, MOST_WAITING};

impl AsyncCanPort for CanSocket {
    type Error = Error;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Error> {
        let Some(frame) = frame.to_frame::<SocketFrame>() else { return Ok(false) };
        let sent = async {
            loop {
                match self.write_frame(frame).await {
                    Err(error) if is_full(&error) => sleep(PAUSE).await,
                    other => break other,
                }
            }
        };
        match timeout(patience, sent).await {
            Ok(sent) => Ok(sent.map(|()| true)?),
            Err(_) => Ok(false),
        }
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Error> {
        stamp(self);
        let end = Instant::now().checked_add(patience);
        let mut waiting = MOST_WAITING;
        while waiting > 0 {
            let left = end.map_or(patience, |end| end.saturating_duration_since(Instant::now()));
            let received = match timeout(left, self.read_frame_with_timestamps()).await {
                Ok(received) => received.map(|(frame, times)| (frame, times.socket)),
                // A frame can be in the queue before the executor is notified. Such a frame has just arrived.
                Err(_) => self.try_read_frame().map(|frame| (frame, None)),
            };
            match received {
                Ok((frame, arrival)) => {
                    if let Some(found) = frame_of(&frame, arrival)?.filter(|found| wanted(found)) {
                        return Ok(Some(found));
                    }
                    waiting -= usize::from(left.is_zero());
                }
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => return Ok(None),
                Err(error) => return Err(error.into()),
            }
        }
        Ok(None)
    }
}

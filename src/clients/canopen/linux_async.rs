//! Async access to the CAN interfaces of Linux (SocketCAN).

use std::io;
use std::time::Duration;

use socketcan::tokio::CanSocket;
use socketcan::{CanFrame as SocketFrame, Error};
use tokio::time::{sleep, timeout, Instant};

use super::frame::CanFrame;
use super::linux::{is_full, received as frame_of, PAUSE};
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
        let end = Instant::now().checked_add(patience);
        let mut waiting = MOST_WAITING;
        while waiting > 0 {
            let left = end.map_or(patience, |end| end.saturating_duration_since(Instant::now()));
            // Read a frame that is already in the queue, even if the executor hasn't been notified yet.
            let received = match self.try_read_frame() {
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => timeout(left, self.read_frame()).await,
                received => Ok(received),
            };
            match received {
                Ok(frame) => {
                    if let Some(found) = frame_of(&frame?)?.filter(|found| wanted(found)) {
                        return Ok(Some(found));
                    }
                    waiting -= usize::from(left.is_zero());
                }
                Err(_) => return Ok(None),
            }
        }
        Ok(None)
    }
}

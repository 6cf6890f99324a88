//! SocketCAN without blocking.

use std::io;
use std::time::Duration;

use socketcan::tokio::CanSocket;
use socketcan::CanFrame as SocketFrame;
use tokio::time::{timeout, timeout_at, Instant};

use super::frame::CanFrame;
use super::port::{AsyncCanPort, BACKLOG};

impl AsyncCanPort for CanSocket {
    type Error = io::Error;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, io::Error> {
        let Some(frame) = frame.to_frame::<SocketFrame>() else { return Ok(false) };
        match timeout(patience, self.write_frame(frame)).await {
            Ok(sent) => sent.map(|()| true),
            Err(_) => Ok(false),
        }
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, io::Error> {
        let end = Instant::now() + patience;
        let mut waiting = BACKLOG;
        while waiting > 0 {
            let is_late = Instant::now() >= end;
            match timeout_at(end, self.read_frame()).await {
                Ok(frame) => {
                    if let Some(own) = CanFrame::from_frame(&frame?).filter(|own| wanted(own)) {
                        return Ok(Some(own));
                    }
                    waiting -= usize::from(is_late);
                }
                Err(_) => return Ok(None),
            }
        }
        Ok(None)
    }
}

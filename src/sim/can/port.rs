//! A node as the CAN port of a client.

use core::convert::Infallible;
use core::time::Duration;

use super::CanNode;
use crate::clients::canopen::{AsyncCanPort, CanFrame, CanPort};

/// A bus with only this node. The clock of the node moves forward when a client waits for a frame.
impl CanPort for CanNode {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        self.handle(frame);
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        let end = self.now.saturating_add(patience);
        loop {
            while let Some(frame) = self.next_frame() {
                if wanted(&frame) {
                    return Ok(Some(frame.at(Some(self.now))));
                }
            }
            match self.next_event().filter(|next| *next <= end) {
                Some(next) => self.set_time(next),
                None => {
                    self.set_time(end);
                    return Ok(None);
                }
            }
        }
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}

/// An async bus with only this node. All futures are ready at the first poll.
impl AsyncCanPort for CanNode {
    type Error = Infallible;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Infallible> {
        CanPort::send(self, frame, patience)
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        CanPort::receive(self, patience, wanted)
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}

//! SDO transfers (CiA 301 7.2.4) that read and write the objects of one node.

use core::time::Duration;

use super::frame::CanFrame;
use super::node::{sent, Node};
use super::port::{AsyncCanPort, CanPort, BACKLOG};
use crate::abort::AbortCode;
use crate::bus::{CanOpen, Object};
use crate::client::{AsyncClient, Client};
use crate::clock::elapsed;
use crate::error::Error;
use crate::sdo::{abort, Channel, Expected, Message, Transfer};

/// Maximum number of late messages that the client waits for: a sub-block of a block transfer and its end.
const MOST_LATE: usize = 128;

/// A missing reply: the client gave up the transfer before the reply arrived, or the transfer was dropped.
#[derive(Clone, Copy, Debug)]
pub(super) struct Owed {
    reply: Expected,
    is_aborted: bool,
}

/// Returns the SDO message in a frame with this identifier, or `None` for other frames. An SDO message has eight bytes
/// (CiA 301 7.2.4.3). Shorter frames are not accepted because they would restart the timeout.
fn message(frame: &CanFrame, id: u32) -> Option<Message> {
    frame.data().try_into().ok().filter(|_| frame.id() == id)
}

/// An SDO transfer on a channel.
struct Running<'a> {
    transfer: Transfer<'a>,
    channel: Channel,
    /// Time of the first request.
    start: Option<Duration>,
}

impl Running<'_> {
    /// Returns the next frame to send.
    fn request(&mut self) -> Option<CanFrame> {
        self.transfer.next().map(|message| CanFrame::of(self.channel.request(), message))
    }

    /// Returns how long to wait for the bus or the next reply: at most `timeout`, and at most until the transfer exceeds
    /// its limit. The message that aborts a transfer always has the whole timeout.
    fn patience(&self, now: Option<Duration>, timeout: Duration) -> Duration {
        match self.start.zip(now).filter(|_| self.transfer.result().is_none()) {
            Some((start, now)) => self.transfer.limit(timeout).saturating_sub(now.saturating_sub(start)).min(timeout),
            None => timeout,
        }
    }

    /// Returns the reply to the last request if the node still has to send it.
    fn owed(&self) -> Option<Owed> {
        let is_aborted = self.transfer.result().is_some();
        (self.transfer.is_owed() || !is_aborted).then_some(Owed { reply: self.transfer.expected(), is_aborted })
    }

    /// Processes a reply, or `None` after a timeout.
    fn answer(&mut self, frame: Option<CanFrame>) {
        match frame {
            Some(frame) => self.transfer.handle(&frame.padded()),
            None => self.transfer.time_out(),
        }
    }
}

macro_rules! transfers {
    ($Port:ident $Client:ident $send:ident $settle:ident $discard:ident $run:ident $($async:ident $await:ident)?) => {
        impl<P: $Port> Node<P> {
            /// Waits for the reply to an earlier transfer that was given up or dropped, and discards all waiting
            /// replies. If the transfer was dropped, aborts it first.
            $($async)? fn $settle(&mut self) -> Result<(), Error<P::Error>> {
                let answers = self.channel().reply();
                if let Some(owed) = self.owed {
                    if !owed.is_aborted {
                        let abort = abort(owed.reply.object(), AbortCode::GENERAL);
                        self.$send(&CanFrame::of(self.channel().request(), abort))$(.$await)??;
                        self.owed = Some(Owed { is_aborted: true, ..owed });
                    }
                    self.$discard(owed.reply)$(.$await)??;
                    self.owed = None;
                }
                let mut old = BACKLOG;
                while old > 0 {
                    let late = self.port().receive(Duration::ZERO, &mut |frame| frame.id() == answers)$(.$await)?;
                    old = if late.map_err(Error::Client)?.is_some() { old - 1 } else { 0 };
                }
                Ok(())
            }

            /// Waits for a late reply and discards it. In a block upload, discards all segments that arrive within the
            /// timeout, because the next transfer could mistake them for its replies.
            $($async)? fn $discard(&mut self, late: Expected) -> Result<(), Error<P::Error>> {
                let answers = self.channel().reply();
                let mut patience = self.timeout();
                for _ in 0..MOST_LATE {
                    let start = self.port().now();
                    let is_late = &mut |frame: &CanFrame| message(frame, answers).is_some_and(|it| late.accepts(&it));
                    let frame = self.port().receive(patience, is_late)$(.$await)?.map_err(Error::Client)?;
                    if frame.is_none() || !late.is_stream() {
                        break;
                    }
                    let elapsed = elapsed(start, self.port().now());
                    patience = patience.saturating_sub(elapsed.unwrap_or_default());
                }
                Ok(())
            }

            $($async)? fn $run(&mut self, transfer: Transfer<'_>) -> Result<usize, Error<P::Error>> {
                let timeout = self.timeout();
                self.$settle()$(.$await)??;
                let mut transfer = Running { transfer, channel: self.channel(), start: self.port().now() };
                loop {
                    while let Some(frame) = transfer.request() {
                        self.owed = transfer.owed();
                        let patience = transfer.patience(self.port().now(), timeout);
                        let is_sent = self.port().send(&frame, patience)$(.$await)?;
                        if let Err(error) = is_sent.map_err(Error::Client).and_then(sent) {
                            // A node that did not receive the first request of a transfer does not reply. If the unsent
                            // message is an abort, the node can still reply to the request before it, and the next
                            // transfer sends the abort.
                            let is_open = |owed: &Owed| owed.is_aborted || owed.reply.is_continued();
                            self.owed = self.owed.filter(is_open).map(|owed| Owed { is_aborted: false, ..owed });
                            return Err(error);
                        }
                    }
                    self.is_block_refused |= transfer.transfer.is_block_refused();
                    if let Some(result) = transfer.transfer.result() {
                        return result.map_err(Error::from);
                    }
                    let (patience, answers) =
                        (transfer.patience(self.port().now(), timeout), transfer.channel.reply());
                    let is_expected = &mut |frame: &CanFrame| {
                        message(frame, answers).is_some_and(|message| transfer.transfer.accepts(&message))
                    };
                    match self.port().receive(patience, is_expected)$(.$await)? {
                        Ok(answer) => {
                            self.owed = None;
                            transfer.answer(answer);
                        }
                        Err(error) => {
                            // Abort the transfer, so that the node doesn't wait for its remaining messages. The caller
                            // gets the first error, even if the abort message cannot be sent.
                            transfer.transfer.fail();
                            if let Some(abort) = transfer.request() {
                                // If the abort cannot be sent, the next transfer sends it. Otherwise, the node would take
                                // the next request for a part of this transfer.
                                let unsent = Owed { reply: transfer.transfer.expected(), is_aborted: false };
                                let is_sent = self.$send(&abort)$(.$await)?.is_ok();
                                self.owed = if is_sent { transfer.owed() } else { Some(unsent) };
                            }
                            return Err(Error::Client(error));
                        }
                    }
                }
            }
        }

        impl<P: $Port> $Client for Node<P> {
            type Bus = CanOpen;
            type Error = P::Error;

            $($async)? fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<P::Error>> {
                self.$run(Transfer::upload(address, buffer, self.block_threshold()))$(.$await)?
            }

            $($async)? fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<P::Error>> {
                let transfer = Transfer::download(address, data, self.block_threshold())?;
                self.$run(transfer)$(.$await)?.map(|_| ())
            }

            /// Waits for `time`. Meanwhile, the interface receives frames. [`Buffered`](super::Buffered) and
            /// [`Network`](super::Network) keep these frames, as they do during a transfer. An interface without a buffer
            /// loses them.
            $($async)? fn wait(&mut self, time: Duration) -> Result<(), Error<P::Error>> {
                let start = self.port().now();
                let mut left = time;
                while !left.is_zero() {
                    self.port().receive(left, &mut |_| false)$(.$await)?.map_err(Error::Client)?;
                    let waited = elapsed(start, self.port().now()).unwrap_or(time);
                    // The clock of a simulated interface may not advance.
                    let next = time.saturating_sub(waited);
                    left = if next < left { next } else { Duration::ZERO };
                }
                Ok(())
            }

            fn now(&mut self) -> Option<Duration> {
                self.port().now()
            }
        }
    };
}

transfers! { CanPort Client send settle discard run }
transfers! { AsyncCanPort AsyncClient send_async settle_async discard_async run_async async await }

//! The traits of `tokio::io` for a stream with faults.

use core::future::Future;
use core::pin::Pin;
use core::task::{ready, Context, Poll};
use core::time::Duration;
use std::boxed::Box;
use std::collections::VecDeque;
use std::io;
use std::vec::Vec;

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::time::{sleep, Sleep};

use super::stream::FaultyStream;

/// Parts of messages that have not been sent yet.
#[derive(Default)]
pub(super) struct Late {
    /// The parts, with the pause before each part.
    parts: VecDeque<(Duration, Vec<u8>)>,
    /// The pause before the first part.
    pause: Option<Pin<Box<Sleep>>>,
}

impl Late {
    /// Sends all parts.
    fn poll_send<S: AsyncWrite + Unpin>(&mut self, stream: &mut S, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        while let Some((pause, part)) = self.parts.front_mut() {
            if !pause.is_zero() {
                let sleep = self.pause.get_or_insert_with(|| Box::pin(sleep(*pause)));
                ready!(sleep.as_mut().poll(context));
                *pause = Duration::ZERO;
                self.pause = None;
            }
            if part.is_empty() {
                self.parts.pop_front();
                continue;
            }
            match ready!(Pin::new(&mut *stream).poll_write(context, part))? {
                0 => return Poll::Ready(Err(io::ErrorKind::WriteZero.into())),
                count => drop(part.drain(..count)),
            }
        }
        Poll::Ready(Ok(()))
    }
}

impl<S: AsyncWrite + Unpin, W> FaultyStream<S, W> {
    fn poll_send(&mut self, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        self.late.poll_send(&mut self.inner, context)
    }
}

impl<S: AsyncRead + AsyncWrite + Unpin, W: Unpin> AsyncRead for FaultyStream<S, W> {
    fn poll_read(self: Pin<&mut Self>, context: &mut Context<'_>, buffer: &mut ReadBuf<'_>) -> Poll<io::Result<()>> {
        let this = self.get_mut();
        if let Poll::Ready(Err(error)) = this.poll_send(context) {
            return Poll::Ready(Err(error));
        }
        Pin::new(&mut this.inner).poll_read(context, buffer)
    }
}

impl<S: AsyncWrite + Unpin, W: Unpin> AsyncWrite for FaultyStream<S, W> {
    fn poll_write(self: Pin<&mut Self>, context: &mut Context<'_>, message: &[u8]) -> Poll<io::Result<usize>> {
        let this = self.get_mut();
        ready!(this.poll_send(context))?;
        if !message.is_empty() {
            let parts = this.parts(message);
            this.late.parts.extend(parts);
        }
        // What remains is sent by later calls.
        match this.poll_send(context) {
            Poll::Ready(Err(error)) => Poll::Ready(Err(error)),
            _ => Poll::Ready(Ok(message.len())),
        }
    }

    fn poll_flush(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        let this = self.get_mut();
        ready!(this.poll_send(context))?;
        Pin::new(&mut this.inner).poll_flush(context)
    }

    fn poll_shutdown(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        let this = self.get_mut();
        ready!(this.poll_send(context))?;
        Pin::new(&mut this.inner).poll_shutdown(context)
    }
}

#[cfg(test)]
mod tests {
    use tokio::io::{duplex, AsyncReadExt, AsyncWriteExt};
    use tokio::time::Instant;

    use super::*;
    use crate::sim::StreamFault;

    #[tokio::test(start_paused = true)]
    async fn a_late_message_is_sent_while_the_device_reads() {
        let second = Duration::from_secs(1);
        let (mut near, far) = duplex(2);
        let mut far = FaultyStream::new(far);
        far.inject_nth(StreamFault::Late(second), 1);
        let start = Instant::now();
        far.write_all(b"late").await.expect("it is accepted");
        assert_eq!(start.elapsed(), Duration::ZERO);
        let device = tokio::spawn(async move {
            let mut request = [0; 4];
            far.read_exact(&mut request).await.expect("a request");
            far.write_all(&request).await.expect("it is accepted");
            far.flush().await.expect("it is sent");
            far.shutdown().await
        });
        let mut reply = [0; 4];
        near.read_exact(&mut reply).await.expect("the late message");
        assert_eq!((start.elapsed(), &reply), (second, b"late"));
        near.write_all(b"next").await.expect("it is sent");
        near.read_exact(&mut reply).await.expect("a reply");
        assert_eq!((start.elapsed(), &reply), (second, b"next"));
        assert!(device.await.is_ok_and(|ended| ended.is_ok()));
    }
}

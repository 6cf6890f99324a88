//! The stream of a [`Link`](super::Link).

use core::future::poll_fn;
use core::pin::Pin;
use core::task::{ready, Context as TaskContext, Poll};
use std::fmt;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::vec::Vec;

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::time::Instant;

use super::request::NoReply;

/// A stream that the context of `tokio-modbus` and the [`Link`](super::Link) share.
pub(super) struct Shared<T>(Arc<Mutex<Line<T>>>);

pub(super) struct Line<T> {
    stream: T,
    /// Time of the last byte in either direction.
    pub(super) last: Instant,
    /// True while a broadcast is sent. A read then fails, because no reply follows.
    pub(super) is_broadcast: bool,
}

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T> fmt::Debug for Shared<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Shared")
    }
}

impl<T> Shared<T> {
    pub(super) fn new(stream: T) -> Self {
        Self(Arc::new(Mutex::new(Line { stream, last: Instant::now(), is_broadcast: false })))
    }

    pub(super) fn lock(&self) -> MutexGuard<'_, Line<T>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T: AsyncRead + Unpin> Shared<T> {
    /// Waits for bytes and returns their number. Appends the bytes to `to`, until `to` has 260 bytes.
    pub(super) async fn discard(&self, to: &mut Vec<u8>) -> io::Result<usize> {
        let mut bytes = [0; 260];
        let mut buffer = ReadBuf::new(&mut bytes);
        poll_fn(|context| Pin::new(&mut &*self).read(context, &mut buffer)).await?;
        let read = buffer.filled();
        to.extend(read.iter().take(260_usize.saturating_sub(to.len())));
        Ok(read.len())
    }

    fn read(self: Pin<&mut &Self>, context: &mut TaskContext<'_>, buffer: &mut ReadBuf<'_>) -> Poll<io::Result<()>> {
        let mut line = self.lock();
        if line.is_broadcast {
            return Poll::Ready(Err(NoReply.into()));
        }
        let before = buffer.filled().len();
        ready!(Pin::new(&mut line.stream).poll_read(context, buffer))?;
        if buffer.filled().len() > before {
            line.last = Instant::now();
        }
        Poll::Ready(Ok(()))
    }
}

impl<T: AsyncRead + Unpin> AsyncRead for Shared<T> {
    fn poll_read(
        self: Pin<&mut Self>,
        context: &mut TaskContext<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut &*self).read(context, buffer)
    }
}

impl<T: AsyncWrite + Unpin> AsyncWrite for Shared<T> {
    fn poll_write(self: Pin<&mut Self>, context: &mut TaskContext<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        let mut line = self.lock();
        let written = ready!(Pin::new(&mut line.stream).poll_write(context, bytes));
        line.last = Instant::now();
        Poll::Ready(written)
    }

    fn poll_flush(self: Pin<&mut Self>, context: &mut TaskContext<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.lock().stream).poll_flush(context)
    }

    fn poll_shutdown(self: Pin<&mut Self>, context: &mut TaskContext<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.lock().stream).poll_shutdown(context)
    }
}

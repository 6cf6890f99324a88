//! Connections that have a timeout and discard late replies.

use core::future::Future;
use core::time::Duration;
use std::fmt;
use std::io;
use std::net::SocketAddr;
use std::vec::Vec;

use tokio::io::{AsyncRead, AsyncWrite};
use tokio::net::TcpStream;
use tokio::runtime::{Builder, Runtime};
use tokio::time::{timeout, timeout_at, Instant};
use tokio_modbus::client::{rtu, sync, tcp, Client as _, Context};
use tokio_modbus::prelude::SlaveContext;
use tokio_modbus::{Request, Response, Slave};

use super::line::Shared;
use super::request::{Echo, NoReply};
use super::Reply;
use crate::framing::Check;

/// Minimum silence between two RTU frames at more than 19,200 bit/s (MODBUS over Serial Line 2.5.1.1). After a silence
/// of this length, the link considers a late reply complete.
const GAP: Duration = Duration::from_micros(1750);

/// Minimum time to wait for bytes, within which the executor can report bytes that have already arrived.
const TURN: Duration = Duration::from_millis(1);

/// Default turnaround delay of RTU: the time for all devices to execute a broadcast (MODBUS over Serial Line V1.02,
/// 2.4.1: 100 ms to 200 ms at 9600 bit/s).
pub const TURNAROUND: Duration = Duration::from_millis(100);

/// Connection to a device. The connection never mistakes a late reply for the reply to another request.
///
/// Modbus RTU has no transaction ID, so a reply cannot be matched to its request. After a timeout, an invalid reply or
/// a dropped call, the link waits before it sends the next request. The link discards the late reply, or it waits until
/// the line has been silent for twice the timeout. A call that first waits for a late reply, or for the end of noise,
/// takes at most four timeouts. Every other call takes at most one timeout; a broadcast also takes the [turnaround
/// delay](Self::with_turnaround).
///
/// Before each RTU request, the link waits for the silence that separates frames.
///
/// ```no_run
/// use std::time::Duration;
///
/// use lexibus::clients::modbus::tokio_modbus::Slave;
/// use lexibus::clients::modbus::{Link, ModbusClient};
/// use lexibus::{Flags, Item, OnModbus, Register, Rw};
///
/// const SPEED: Item<u32, Rw, OnModbus> =
///     Item::<u32, Rw, OnModbus>::register(Register::high_first(10, 2), "Speed", Flags::NONE);
///
/// # async fn drive() -> Result<(), Box<dyn std::error::Error>> {
/// let line = tokio_serial::SerialStream::open(&tokio_serial::new("/dev/ttyUSB0", 19_200))?;
/// let mut device = ModbusClient::new(Link::rtu(line, Slave(5), Duration::from_millis(500)));
/// SPEED.at(&mut device).write_async(1500).await?;
/// # Ok(())
/// # }
/// ```
pub struct Link<T> {
    context: Context,
    line: Shared<T>,
    device: Slave,
    timeout: Duration,
    is_rtu: bool,
    /// True if the reply to the last request may still arrive.
    is_unsettled: bool,
    /// Time for the devices to execute a broadcast; `None` if unit 0 is a device that replies.
    turnaround: Option<Duration>,
    /// Earliest time of the next request, after a broadcast.
    resume: Instant,
}

impl<T> fmt::Debug for Link<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Link").field("timeout", &self.timeout).field("is_rtu", &self.is_rtu).finish_non_exhaustive()
    }
}

impl<T: AsyncRead + AsyncWrite + Unpin + Send + 'static> Link<T> {
    /// Creates a connection to `device` with Modbus RTU. `timeout` is the maximum time from the request to the end of
    /// the reply.
    pub fn rtu(line: T, device: Slave, timeout: Duration) -> Self {
        Self::new(line, device, timeout, true)
    }

    /// Creates a connection to `device` with Modbus TCP. After a timeout, the late reply does not cause another call to
    /// fail.
    pub fn tcp(line: T, device: Slave, timeout: Duration) -> Self {
        Self::new(line, device, timeout, false)
    }

    fn new(line: T, device: Slave, timeout: Duration, is_rtu: bool) -> Self {
        let line = Shared::new(line);
        let context = attach(line.clone(), device, is_rtu);
        let turnaround = is_rtu.then_some(TURNAROUND);
        Self { context, line, device, timeout, is_rtu, is_unsettled: false, turnaround, resume: Instant::now() }
    }

    /// Sets the turnaround delay: the time after a broadcast in which the devices execute the write, and the link sends
    /// nothing. The default is [`TURNAROUND`] on RTU.
    ///
    /// On TCP, unit 0 is by default the device at the other end of the connection, which replies. With this setting,
    /// unit 0 is a broadcast on the serial line of a gateway, and no reply is expected. The link discards a reply that
    /// the gateway sends within the delay.
    #[must_use]
    pub fn with_turnaround(self, delay: Duration) -> Self {
        Self { turnaround: Some(delay), ..self }
    }

    /// Sends a request and waits for the reply. Devices don't reply to a broadcast, so the link itself creates the
    /// reply that confirms the write, after the turnaround delay.
    pub(super) async fn call(&mut self, request: Request<'_>) -> Reply {
        match self.turnaround.filter(|_| self.device.is_broadcast()) {
            Some(delay) => self.broadcast(request, delay).await,
            None => self.request(request).await,
        }
    }

    /// Sends a broadcast and waits until the turnaround delay has passed.
    async fn broadcast(&mut self, request: Request<'_>, delay: Duration) -> Reply {
        let Some(confirmation) = Echo::of(&request).into_response() else {
            return Err(io::Error::from(NoReply).into());
        };
        self.settle().await?;
        // The link stays unsettled if the call is dropped.
        self.is_unsettled = true;
        self.line.lock().is_broadcast = true;
        let sent = timeout(self.timeout, self.context.call(request)).await;
        self.line.lock().is_broadcast = false;
        let Ok(sent) = sent else { return Err(late().into()) };
        // After an error, a context reports the end of the stream.
        self.context = attach(self.line.clone(), self.device, self.is_rtu);
        // The error `NoReply` means that the context has sent the whole request and starts to read.
        if !matches!(&sent, Err(tokio_modbus::Error::Transport(error)) if NoReply::is(error)) {
            return sent;
        }
        self.resume = after(Instant::now(), delay);
        self.is_unsettled = false;
        self.turn_around().await?;
        Ok(Ok(confirmation))
    }

    /// Waits for the end of the turnaround delay. Discards all received bytes.
    async fn turn_around(&self) -> io::Result<()> {
        while Instant::now() < self.resume {
            self.discard_until(self.resume, &mut Vec::new()).await?;
        }
        Ok(())
    }

    /// Discards bytes and appends them to `discarded`. Returns false if no byte arrives before `end`.
    async fn discard_until(&self, end: Instant, discarded: &mut Vec<u8>) -> io::Result<bool> {
        match timeout_at(end, self.line.discard(discarded)).await {
            Ok(Ok(0)) => Err(io::ErrorKind::UnexpectedEof.into()),
            Ok(result) => result.map(|_| true),
            Err(_) => Ok(false),
        }
    }

    async fn request(&mut self, request: Request<'_>) -> Reply {
        self.settle().await?;
        let expected = Expected::of(&request);
        // The link stays unsettled if the call is dropped.
        self.is_unsettled = true;
        let reply = timeout(self.timeout, self.context.call(request)).await;
        let reply = reply.unwrap_or_else(|_| Err(late().into()));
        if matches!(&reply, Err(tokio_modbus::Error::Transport(error)) if error.kind() != io::ErrorKind::TimedOut) {
            // After an invalid frame, a context reports the end of the stream.
            self.context = attach(self.line.clone(), self.device, self.is_rtu);
        }
        self.is_unsettled = match &reply {
            Ok(Ok(response)) => !expected.is(response),
            Ok(Err(_)) => false,
            Err(_) => true,
        };
        reply
    }

    /// Waits until no reply to an earlier request can arrive. Discards all received bytes.
    async fn settle(&mut self) -> io::Result<()> {
        // A broadcast may have been dropped.
        self.line.lock().is_broadcast = false;
        self.turn_around().await?;
        let pause = match (self.is_unsettled, self.is_rtu) {
            (true, _) => self.timeout.saturating_mul(2),
            (false, true) => GAP,
            (false, false) => return Ok(()),
        };
        let end = after(Instant::now(), self.timeout.saturating_mul(3));
        let mut discarded = Vec::new();
        loop {
            // A complete frame is the missing reply.
            let pause = if self.is_unsettled && self.is_frame(&discarded) { GAP } else { pause };
            let silent = after(self.line.lock().last, pause).max(Instant::now() + TURN);
            if !self.discard_until(silent.min(end), &mut discarded).await? {
                // The line carries noise without a pause.
                if Instant::now() < silent {
                    return Err(late());
                }
                break;
            }
        }
        if self.is_unsettled && self.is_rtu {
            // A context keeps the unsent bytes of a request that timed out. Discard them, because the device would
            // execute the old request. On TCP, a part of a request would confuse the device.
            self.context = attach(self.line.clone(), self.device, self.is_rtu);
        }
        self.is_unsettled = false;
        Ok(())
    }

    /// Returns whether the bytes are one complete frame.
    fn is_frame(&self, bytes: &[u8]) -> bool {
        if self.is_rtu {
            // The CRC over a frame and its CRC is zero.
            (4..=256).contains(&bytes.len()) && Check::Crc16(0xFFFF).of(bytes) == [0; 2]
        } else {
            matches!(*bytes, [_, _, _, _, high, low, ref rest @ ..]
                if rest.len() == usize::from(u16::from_be_bytes([high, low])))
        }
    }
}

fn attach<T>(line: Shared<T>, device: Slave, is_rtu: bool) -> Context
where
    T: AsyncRead + AsyncWrite + Unpin + Send + 'static,
{
    if is_rtu {
        rtu::attach_slave(line, device)
    } else {
        tcp::attach_slave(line, device)
    }
}

/// Returns `start` plus `time`, or `start` plus 30 years if the sum is too large.
fn after(start: Instant, time: Duration) -> Instant {
    const YEARS: Duration = Duration::from_secs(30 * 365 * 24 * 3600);
    start.checked_add(time).unwrap_or(start + YEARS)
}

fn late() -> io::Error {
    io::ErrorKind::TimedOut.into()
}

impl<T> SlaveContext for Link<T> {
    fn set_slave(&mut self, slave: Slave) {
        self.device = slave;
        self.context.set_slave(slave);
    }
}

/// Content that the reply to a request must have.
enum Expected {
    Words(u16),
    Bits(u16),
    Echo(Echo),
}

impl Expected {
    fn of(request: &Request<'_>) -> Self {
        match request {
            Request::ReadHoldingRegisters(_, count)
            | Request::ReadInputRegisters(_, count)
            | Request::ReadWriteMultipleRegisters(_, count, ..) => Self::Words(*count),
            Request::ReadCoils(_, count) | Request::ReadDiscreteInputs(_, count) => Self::Bits(*count),
            request => Self::Echo(Echo::of(request)),
        }
    }

    fn is(&self, response: &Response) -> bool {
        match (self, response) {
            (
                Self::Words(count),
                Response::ReadHoldingRegisters(words)
                | Response::ReadInputRegisters(words)
                | Response::ReadWriteMultipleRegisters(words),
            ) => words.len() == usize::from(*count),
            (Self::Bits(count), Response::ReadCoils(bits) | Response::ReadDiscreteInputs(bits)) => {
                bits.len().div_ceil(8) == usize::from(*count).div_ceil(8)
            }
            (Self::Echo(echo), response) => echo.is(response),
            _ => false,
        }
    }
}

/// A [`Link`] with blocking calls.
///
/// ```no_run
/// use std::time::Duration;
///
/// use lexibus::clients::modbus::tokio_modbus::Slave;
/// use lexibus::clients::modbus::{BlockingLink, Link, ModbusClient};
///
/// let line = tokio_serial::new("/dev/ttyUSB0", 19_200);
/// let link = BlockingLink::open(async {
///     Ok(Link::rtu(tokio_serial::SerialStream::open(&line)?, Slave(5), Duration::from_millis(500)))
/// })?;
/// let mut device = ModbusClient::new(link);
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct BlockingLink<T> {
    runtime: Runtime,
    link: Link<T>,
}

impl<T> BlockingLink<T> {
    /// Creates a blocking link. `open` opens the stream and creates the link.
    ///
    /// # Errors
    ///
    /// Returns the errors of `open` and of the operating system.
    pub fn open(open: impl Future<Output = io::Result<Link<T>>>) -> io::Result<Self> {
        let runtime = Builder::new_current_thread().enable_all().build()?;
        let link = runtime.block_on(open)?;
        Ok(Self { runtime, link })
    }
}

impl<T: AsyncRead + AsyncWrite + Unpin + Send + 'static> BlockingLink<T> {
    /// Sets the turnaround delay, as [`Link::with_turnaround`] does.
    #[must_use]
    pub fn with_turnaround(self, delay: Duration) -> Self {
        Self { link: self.link.with_turnaround(delay), ..self }
    }
}

impl BlockingLink<TcpStream> {
    /// Connects to `device` with Modbus TCP. Unit 0 is the device itself, which replies. `timeout` limits the time to
    /// connect, and the time of each call as in [`Link`].
    ///
    /// # Errors
    ///
    /// Returns the errors of the connection, or [`io::ErrorKind::TimedOut`] if the connection takes too long.
    pub fn tcp(address: SocketAddr, device: Slave, timeout: Duration) -> io::Result<Self> {
        Self::open(async {
            let stream = tokio::time::timeout(timeout, TcpStream::connect(address)).await;
            Ok(Link::tcp(stream.unwrap_or_else(|_| Err(late()))?, device, timeout))
        })
    }
}

impl<T> SlaveContext for BlockingLink<T> {
    fn set_slave(&mut self, slave: Slave) {
        self.link.set_slave(slave);
    }
}

impl<T: AsyncRead + AsyncWrite + Unpin + Send + 'static> sync::Client for BlockingLink<T> {
    fn call(&mut self, request: Request<'_>) -> Reply {
        self.runtime.block_on(self.link.call(request))
    }
}

//! Tests serial lines with a simulated device and faults of the line, in simulated time.

use std::cell::Cell;
use std::collections::VecDeque;
use std::io::{ErrorKind, Write};
use std::pin::pin;
use std::rc::Rc;
use std::sync::{Arc, Mutex};
use std::task::Poll;
use std::time::Duration;

use lexibus::clients::serial::{embedded_io, embedded_io_async, SerialError, SerialLine};
use lexibus::framing::{Check, Delimited, Framing};
use lexibus::sim::{FaultyStream, StreamFault};
use lexibus::{AsyncExchange, Error, Exchange};
use tokio::io::{duplex, AsyncReadExt, AsyncWriteExt, DuplexStream};
use tokio::time::{sleep, timeout, Instant, Sleep};

use crate::can::poll_once;
use crate::faulty_stream::set;
use crate::matrix::{name, Row};
use crate::random::Random;

const FRAMING: Delimited = Delimited::new(Some(0x02), 0x03)
    .with_escape(0x1B, 0xFF, &[0x02, 0x03, 0x1B])
    .with_check(Check::Crc16(0xFFFF))
    .with_max_data(20);

/// Timeout of an exchange.
const TIMEOUT: Duration = Duration::from_millis(100);

/// Time that a reply takes.
const SOON: Duration = Duration::from_millis(1);

/// Returns noise that arrives for a minute instead of the reply, one byte every 10 ms.
fn endless_noise() -> StreamFault {
    StreamFault::Foreign { bytes: vec![0x41], count: 6000, period: Duration::from_millis(10) }
}

fn noise() -> StreamFault {
    StreamFault::Noise(vec![0xFF, 0x03, 0x41])
}

const LATE: StreamFault = StreamFault::Late(Duration::from_millis(150));

fn faults() -> [StreamFault; 5] {
    [LATE, StreamFault::Lost, StreamFault::Truncated, noise(), endless_noise()]
}

/// Returns the reply to a request.
fn reply(count: u32) -> Vec<u8> {
    let mut frame = vec![0; 64];
    let length = FRAMING.encode(&count.to_le_bytes(), &mut frame).expect("it fits");
    frame.truncate(length);
    frame
}

/// The device's end of a line in simulated time.
pub struct Wire {
    /// Time at which the bytes that the device writes next arrive at the client.
    time: Rc<Cell<Duration>>,
    bytes: VecDeque<(Duration, u8)>,
}

impl Write for Wire {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.bytes.extend(bytes.iter().map(|byte| (self.time.get(), *byte)));
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// A stream whose reads block until a byte arrives. The device at its other end answers each frame with the number of the
/// request.
pub struct Port {
    now: Rc<Cell<Duration>>,
    device: FaultyStream<Wire, Box<dyn FnMut(Duration)>>,
    count: u32,
}

impl Port {
    fn new(now: Rc<Cell<Duration>>) -> Self {
        let time = Rc::new(Cell::new(Duration::ZERO));
        let device = FaultyStream::new(Wire { time: time.clone(), bytes: VecDeque::new() });
        let wait: Box<dyn FnMut(Duration)> = Box::new(move |pause| time.set(time.get() + pause));
        Self { now, device: device.with_wait(wait), count: 0 }
    }
}

#[derive(Debug)]
pub struct Late(ErrorKind);

impl std::fmt::Display for Late {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Late {}

impl embedded_io::Error for Late {
    fn kind(&self) -> embedded_io::ErrorKind {
        self.0.into()
    }
}

impl embedded_io::ErrorType for Port {
    type Error = Late;
}

impl embedded_io::Read for Port {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Late> {
        let (at, byte) = self.device.inner().bytes.pop_front().expect("the read blocks forever");
        self.now.set(at.max(self.now.get()));
        buffer[0] = byte;
        Ok(1)
    }
}

impl embedded_io::ReadReady for Port {
    fn read_ready(&mut self) -> Result<bool, Late> {
        Ok(self.device.inner().bytes.front().is_some_and(|(at, _)| *at <= self.now.get()))
    }
}

impl embedded_io::Write for Port {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Late> {
        let wire = self.device.inner();
        let start = wire.bytes.back().map_or(Duration::ZERO, |(at, _)| *at).max(self.now.get());
        wire.time.set(start + SOON);
        self.device.write_all(&reply(self.count)).expect("no error");
        Ok(bytes.len())
    }

    fn flush(&mut self) -> Result<(), Late> {
        Ok(())
    }
}

pub type Outcome = Result<(), Error<SerialError<Late>>>;

pub fn blocking() -> (SerialLine<Port, Delimited, 64, impl FnMut() -> Duration>, Rc<Cell<Duration>>) {
    let now = Rc::new(Cell::new(Duration::ZERO));
    let clock = now.clone();
    let clock = move || {
        // Time passes while the line polls.
        clock.set(clock.get() + Duration::from_micros(100));
        clock.get()
    };
    (SerialLine::new(Port::new(now.clone()), FRAMING).with_time(clock, TIMEOUT), now)
}

/// Returns the number of bytes that the line has not read.
pub fn waiting<T>(line: &mut SerialLine<Port, Delimited, 64, T>) -> usize {
    line.stream().device.inner().bytes.len()
}

/// Performs one exchange whose reply has a fault. Panics if the reply is wrong.
pub fn once<T: lexibus::Clock>(
    line: &mut SerialLine<Port, Delimited, 64, T>,
    count: u32,
    fault: impl Into<Option<StreamFault>>,
) -> Outcome {
    line.stream().count = count;
    set(&mut line.stream().device, fault);
    let mut reply = [0; 20];
    let length = Exchange::exchange(line, &[1], &mut reply)?;
    assert_eq!(reply[..length], count.to_le_bytes(), "exchange {count}");
    Ok(())
}

#[test]
fn late_replies_are_not_those_of_the_next_request() {
    let (mut line, _) = blocking();
    let mut random = Random::new(28);
    let (mut late, mut failed) = (0, 0);
    for count in 0..10_000 {
        let is_late = random.below(20) == 0;
        late += u32::from(is_late);
        let fault = StreamFault::Late(Duration::from_millis(101 + random.below(90)));
        failed += u32::from(once(&mut line, count, is_late.then_some(fault)).is_err());
    }
    println!("10,000 exchanges on a serial line, {late} late: {failed} errors, no wrong reply");
    assert!(late > 400 && failed <= late, "{failed} errors for {late} late replies");
}

#[test]
fn a_repeated_reply_isnt_that_of_the_next_request() {
    let mut line = blocking().0;
    for count in 0..10 {
        once(&mut line, count, StreamFault::Duplicated).expect("the reply");
    }
}

/// After each exchange, the device sends a frame without a request. The next exchange must not return this frame as its reply.
#[test]
fn a_frame_without_a_request_is_no_reply() {
    let (mut line, now) = blocking();
    for count in 0..10 {
        once(&mut line, count, None).expect("the reply");
        now.set(now.get() + TIMEOUT);
        line.stream().device.inner().bytes.extend(reply(99).into_iter().map(|byte| (Duration::ZERO, byte)));
    }
}

/// The reply to a request arrives after a frame that the protocol rejects.
#[test]
fn after_a_rejected_reply_the_next_one_is_right() {
    let (mut line, now) = blocking();
    // The frame arrives during the exchange, so the line returns it as the reply. The right reply follows after 50 ms.
    let noise = StreamFault::Foreign { bytes: reply(99), count: 1, period: Duration::ZERO };
    line.stream().count = 1;
    set(&mut line.stream().device, noise);
    let mut wrong = [0; 20];
    assert_eq!(Exchange::exchange(&mut line, &[1], &mut wrong).ok(), Some(4));
    assert_eq!(wrong[..4], 99_u32.to_le_bytes());
    Exchange::unsettle(&mut line);
    let soon = now.get() + TIMEOUT / 2;
    line.stream().device.inner().bytes.extend(reply(1).into_iter().map(|byte| (soon, byte)));
    once(&mut line, 2, None).expect("the reply");
    // The line does not wait longer than its timeout for a reply that never arrives.
    Exchange::unsettle(&mut line);
    let start = now.get();
    once(&mut line, 3, None).expect("the reply");
    assert!(now.get() - start <= TIMEOUT + 20 * SOON, "{:?}", now.get() - start);
}

#[test]
fn after_each_fault_the_next_request_is_right() {
    for fault in faults() {
        let (mut line, now) = blocking();
        let first = once(&mut line, 1, fault.clone());
        assert!(now.get() <= TIMEOUT + SOON, "{fault:?}: {:?}", now.get());
        assert_eq!(first.is_ok(), fault == noise(), "{fault:?}: {first:?}");
        if fault == endless_noise() {
            let start = now.get();
            once(&mut line, 2, StreamFault::Lost).expect_err("noise");
            assert!(now.get() - start <= 2 * TIMEOUT + SOON);
            line.stream().device.inner().bytes.clear();
        }
        let start = now.get();
        once(&mut line, 3, None).expect("the reply");
        assert!(now.get() - start <= 2 * TIMEOUT, "{fault:?}");
    }
}

/// A `tokio` stream, and a byte that `read_ready` has already read from it.
pub struct AsyncPort(DuplexStream, Option<u8>);

impl embedded_io::ErrorType for AsyncPort {
    type Error = Late;
}

impl embedded_io_async::Read for AsyncPort {
    async fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Late> {
        if let Some(byte) = self.1.take() {
            buffer[0] = byte;
            return Ok(1);
        }
        self.0.read(buffer).await.map_err(|error| Late(error.kind()))
    }
}

impl embedded_io::ReadReady for AsyncPort {
    fn read_ready(&mut self) -> Result<bool, Late> {
        if self.1.is_none() {
            if let Poll::Ready(Ok(byte)) = poll_once(pin!(self.0.read_u8())) {
                self.1 = Some(byte);
            }
        }
        Ok(self.1.is_some())
    }
}

impl embedded_io_async::Write for AsyncPort {
    async fn write(&mut self, bytes: &[u8]) -> Result<usize, Late> {
        self.0.write(bytes).await.map_err(|error| Late(error.kind()))
    }

    async fn flush(&mut self) -> Result<(), Late> {
        Ok(())
    }
}

pub type World = Arc<Mutex<(u32, Option<StreamFault>)>>;

async fn serve(line: DuplexStream, world: World) {
    let mut line = FaultyStream::new(line);
    let (mut decoder, mut request) = (FRAMING.decoder(), [0; 20]);
    while let Ok(byte) = line.read_u8().await {
        if !matches!(FRAMING.decode(&mut decoder, byte, &mut request), Ok(Some(_))) {
            continue;
        }
        let (count, fault) = world.lock().unwrap().clone();
        set(&mut line, fault);
        sleep(SOON).await;
        line.write_all(&reply(count)).await.unwrap();
    }
}

pub type AsyncLine = SerialLine<AsyncPort, Delimited, 64, fn(Duration) -> Sleep>;

pub fn asynchronous() -> (AsyncLine, World) {
    let world = Arc::new(Mutex::new((0, None)));
    let (line, device) = duplex(0x1_0000);
    tokio::spawn(serve(device, world.clone()));
    let sleep: fn(Duration) -> Sleep = sleep;
    (SerialLine::new(AsyncPort(line, None), FRAMING).with_time(sleep, TIMEOUT), world)
}

pub async fn once_async<T: lexibus::Timer>(
    line: &mut SerialLine<AsyncPort, Delimited, 64, T>,
    world: &World,
    count: u32,
    fault: impl Into<Option<StreamFault>>,
) -> Outcome {
    *world.lock().unwrap() = (count, fault.into());
    let mut reply = [0; 20];
    let length = AsyncExchange::exchange(line, &[1], &mut reply).await?;
    assert_eq!(reply[..length], count.to_le_bytes(), "exchange {count}");
    Ok(())
}

#[tokio::test(start_paused = true)]
async fn async_late_replies_are_not_those_of_the_next_request() {
    let (mut line, world) = asynchronous();
    let mut random = Random::new(28);
    let (mut late, mut failed) = (0, 0);
    for count in 0..10_000 {
        let is_late = random.below(20) == 0;
        late += u32::from(is_late);
        let fault = StreamFault::Late(Duration::from_millis(101 + random.below(90)));
        failed += u32::from(once_async(&mut line, &world, count, is_late.then_some(fault)).await.is_err());
    }
    println!("10,000 async exchanges on a serial line, {late} late: {failed} errors, no wrong reply");
    assert!(late > 400 && failed <= late, "{failed} errors for {late} late replies");
}

#[tokio::test(start_paused = true)]
async fn async_after_each_fault_the_next_request_is_right() {
    let soon = Duration::from_millis(5);
    for fault in faults() {
        let (mut line, world) = asynchronous();
        let start = Instant::now();
        let first = once_async(&mut line, &world, 1, fault.clone()).await;
        assert!(start.elapsed() <= TIMEOUT + soon, "{fault:?}: {:?}", start.elapsed());
        assert_eq!(first.is_ok(), fault == noise(), "{fault:?}: {first:?}");
        if fault == endless_noise() {
            let start = Instant::now();
            once_async(&mut line, &world, 2, StreamFault::Lost).await.expect_err("noise");
            assert!(start.elapsed() <= 2 * TIMEOUT + soon);
            sleep(Duration::from_secs(60)).await;
        }
        let start = Instant::now();
        once_async(&mut line, &world, 3, None).await.expect("the reply");
        assert!(start.elapsed() <= 2 * TIMEOUT + soon, "{fault:?}: {:?}", start.elapsed());
    }
}

#[tokio::test(start_paused = true)]
async fn after_a_dropped_exchange_the_next_one_is_right() {
    let (mut line, world) = asynchronous();
    let late = StreamFault::Late(Duration::from_millis(50));
    assert!(timeout(Duration::from_millis(20), once_async(&mut line, &world, 1, late)).await.is_err());
    once_async(&mut line, &world, 2, None).await.expect("the reply");
}

/// Returns the rows for serial lines in the table of faults.
pub fn rows() -> Vec<Row> {
    let faults = [
        ("late", LATE),
        ("lost", StreamFault::Lost),
        ("duplicated", StreamFault::Duplicated),
        ("truncated", StreamFault::Truncated),
        // A frame with a wrong checksum.
        ("foreign", StreamFault::Foreign { bytes: vec![0x02, 0x41, 0x41, 0x41, 0x03], count: 1, period: SOON }),
        ("noise", noise()),
    ];
    let mut rows = Vec::new();
    for (fault_name, fault) in faults {
        let (mut line, now) = blocking();
        let result = name(&once(&mut line, 1, fault.clone()));
        let time = now.get();
        once(&mut line, 2, None).expect("the next request is right");
        let (client, timeout, next) = ("serial", TIMEOUT, now.get() - time);
        rows.push(Row { client, is_async: false, fault: fault_name, result, time, next, timeout });

        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().start_paused(true).build();
        rows.push(runtime.expect("a runtime").block_on(async {
            let (mut line, world) = asynchronous();
            let start = Instant::now();
            let result = name(&once_async(&mut line, &world, 1, fault.clone()).await);
            let time = start.elapsed();
            once_async(&mut line, &world, 2, None).await.expect("the next request is right");
            Row { client, is_async: true, fault: fault_name, result, time, next: start.elapsed() - time, timeout }
        }));
    }
    rows
}

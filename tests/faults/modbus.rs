//! Tests Modbus RTU and TCP with a simulated device and faults of the line, in simulated time.

use std::sync::{Arc, Mutex};
use std::time::Duration;

use lexibus::clients::modbus::tokio_modbus::client::tcp;
use lexibus::clients::modbus::tokio_modbus::Slave;
use lexibus::clients::modbus::{BlockingLink, Link, ModbusClient};
use lexibus::framing::Check;
use lexibus::modbus::{AsyncRegisterClient, Limits, TableLimits};
use lexibus::sim::{FaultyStream, StreamFault};
use lexibus::{AsyncClient, Client, Error, Flags, Item, OnModbus, Register, Rw};
use tokio::io::{duplex, AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt, DuplexStream};
use tokio::time::{sleep, timeout, Instant};

use crate::faulty_stream::set;
use crate::random::Random;

pub const DEVICE: u8 = 5;
pub const TIMEOUT: Duration = Duration::from_millis(200);
/// Two registers that contain the number of the current request.
pub const COUNT: Register = Register::high_first(10, 2);
pub const SETPOINT: Register = Register::holding(20);

type Setpoint = Item<u16, Rw, OnModbus>;

/// A request of the client.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Function 3.
    Read,
    /// Function 6.
    Write,
    /// Function 22.
    Mask,
    /// Function 23.
    Exchange,
}

const KINDS: [Kind; 4] = [Kind::Read, Kind::Write, Kind::Mask, Kind::Exchange];

/// The simulated device supports the optional functions 22 and 23.
const LIMITS: Limits =
    Limits { holding: TableLimits { functions: &[3, 6, 16, 22, 23], ..TableLimits::HOLDING }, ..Limits::STANDARD };

#[derive(Clone, Debug)]
pub struct World {
    pub count: u32,
    pub setpoint: u16,
    /// Fault of each reply.
    pub fault: Option<StreamFault>,
}

pub type Shared = Arc<Mutex<World>>;

pub fn world() -> Shared {
    Arc::new(Mutex::new(World { count: 0, setpoint: 0, fault: None }))
}

fn frame(is_rtu: bool, transaction: [u8; 2], device: u8, data: &[u8]) -> Vec<u8> {
    let mut frame = vec![device];
    frame.extend(data);
    if is_rtu {
        frame.extend(Check::Crc16(0xFFFF).of(&frame));
        return frame;
    }
    let [high, low] = (frame.len() as u16).to_be_bytes();
    [&transaction[..], &[0, 0, high, low], &frame].concat()
}

/// Returns a reply from another device (RTU) or to another transaction (TCP), which arrives before the expected reply.
pub fn foreign(is_rtu: bool) -> StreamFault {
    StreamFault::Noise(frame(is_rtu, [0xAB, 0xCD], DEVICE + 1, &[3, 4, 9, 9, 9, 9]))
}

/// Returns noise that arrives before the reply.
pub fn noise() -> StreamFault {
    StreamFault::Noise(vec![0xFF; 40])
}

/// Returns noise that arrives for a minute instead of the reply, one byte every 10 ms.
fn endless_noise() -> StreamFault {
    StreamFault::Foreign { bytes: vec![0xFF], count: 6000, period: Duration::from_millis(10) }
}

/// Receives a request. Returns the transaction ID (only on TCP), the unit ID and the data.
async fn receive(line: &mut (impl AsyncRead + Unpin), is_rtu: bool) -> std::io::Result<([u8; 2], u8, Vec<u8>)> {
    let mut head = vec![0; if is_rtu { 2 } else { 8 }];
    line.read_exact(&mut head).await?;
    let (unit, function) = (head[head.len() - 2], head[head.len() - 1]);
    // With function 23, the client writes exactly one register, so the length is fixed.
    let length = match function {
        22 => 6,
        23 => 11,
        _ => 4,
    };
    let mut data = vec![0; length + if is_rtu { 2 } else { 0 }];
    line.read_exact(&mut data).await?;
    data.truncate(length);
    data.insert(0, function);
    Ok((if is_rtu { [0; 2] } else { [head[0], head[1]] }, unit, data))
}

/// Simulates a device that answers requests that use function 3, 6, 22 or 23. The device executes broadcasts. After a
/// broadcast, only a faulty device replies.
async fn serve(line: impl AsyncRead + AsyncWrite + Unpin, is_rtu: bool, world: Shared) {
    let mut line = FaultyStream::new(line);
    while let Ok((transaction, unit, data)) = receive(&mut line, is_rtu).await {
        let World { count, setpoint, fault } = world.lock().unwrap().clone();
        let word = |at: usize| u16::from_be_bytes([data[at], data[at + 1]]);
        let values = |function: u8| [&[function, 4][..], &count.to_be_bytes()].concat();
        let (written, reply) = match data[0] {
            3 => (setpoint, values(3)),
            22 => (setpoint & word(3) | word(5) & !word(3), data.clone()),
            23 => (word(10), values(23)),
            _ => (word(3), data.clone()),
        };
        world.lock().unwrap().setpoint = written;
        if unit == 0 && fault.is_none() {
            continue;
        }
        sleep(Duration::from_millis(1)).await;
        set(&mut line, fault);
        line.write_all(&frame(is_rtu, transaction, DEVICE, &reply)).await.unwrap();
    }
}

pub fn link(is_rtu: bool, world: &Shared) -> Link<DuplexStream> {
    let (line, device) = duplex(0x1_0000);
    tokio::spawn(serve(device, is_rtu, world.clone()));
    let link = if is_rtu { Link::rtu } else { Link::tcp };
    link(line, Slave(DEVICE), TIMEOUT)
}

fn blocking(is_rtu: bool, world: &Shared) -> ModbusClient<BlockingLink<DuplexStream>> {
    let link = BlockingLink::open(async {
        tokio::time::pause();
        Ok(link(is_rtu, world))
    });
    ModbusClient::new(link.expect("a link"))
}

/// Sends one request. Panics if a value is wrong.
pub async fn request<C: AsyncRegisterClient<Bus = lexibus::Modbus>>(
    device: &mut C,
    world: &Shared,
    number: u32,
    kind: Kind,
) -> Result<(), Error<C::Error>> {
    world.lock().unwrap().count = number;
    let (mut buffer, word) = ([0; 4], number as u16);
    match kind {
        Kind::Read => {
            device.read(COUNT, &mut buffer).await?;
        }
        Kind::Write => device.write(SETPOINT, &word.to_le_bytes()).await?,
        Kind::Mask => device.mask_register(SETPOINT.address, 0, word).await?,
        Kind::Exchange => {
            device.write_and_read(SETPOINT, &word.to_le_bytes(), COUNT, &mut buffer).await?;
        }
    }
    if kind != Kind::Read {
        assert_eq!(world.lock().unwrap().setpoint, word, "request {number}");
    }
    if matches!(kind, Kind::Read | Kind::Exchange) {
        assert_eq!(u32::from_le_bytes(buffer), number, "request {number}");
    }
    Ok(())
}

/// Returns a client that uses the functions 22 and 23.
pub fn client<T>(link: T) -> ModbusClient<T> {
    ModbusClient::new(link).with_limits(LIMITS)
}

#[tokio::test(start_paused = true)]
async fn late_replies_are_not_those_of_the_next_request() {
    for is_rtu in [true, false] {
        let world = world();
        let mut device = client(link(is_rtu, &world));
        let mut random = Random::new(28);
        let (mut late, mut failed) = (0, 0);
        for number in 0..10_000 {
            let is_late = random.below(20) == 0;
            late += u32::from(is_late);
            let delay = Duration::from_millis(200 + random.below(190));
            world.lock().unwrap().fault = is_late.then_some(StreamFault::Late(delay));
            let kind = KINDS[random.below(4) as usize];
            match request(&mut device, &world, number, kind).await {
                Ok(()) => {}
                Err(Error::Timeout) => failed += 1,
                Err(other) => panic!("request {number}: {other}"),
            }
        }
        let name = if is_rtu { "RTU" } else { "TCP" };
        println!("10,000 Modbus {name} requests, {late} late: {failed} errors, no wrong value");
        assert!(late > 400 && failed <= late, "{failed} errors for {late} late replies");
    }
}

#[tokio::test(start_paused = true)]
async fn after_each_fault_the_next_request_is_right() {
    for is_rtu in [true, false] {
        let faults = [
            StreamFault::Late(TIMEOUT),
            StreamFault::Lost,
            StreamFault::Duplicated,
            StreamFault::Truncated,
            foreign(is_rtu),
            noise(),
            endless_noise(),
        ];
        for fault in faults {
            let world = world();
            let mut device = client(link(is_rtu, &world));
            world.lock().unwrap().fault = Some(fault.clone());
            let start = Instant::now();
            let first = request(&mut device, &world, 1, Kind::Read).await;
            let longest = start.elapsed();
            assert!(longest <= TIMEOUT + Duration::from_millis(10), "{fault:?}: {longest:?}");
            if fault == endless_noise() {
                let start = Instant::now();
                assert!(matches!(request(&mut device, &world, 2, Kind::Read).await, Err(Error::Timeout)));
                assert!(start.elapsed() <= 4 * TIMEOUT, "{:?}", start.elapsed());
                sleep(Duration::from_secs(60)).await;
            }
            world.lock().unwrap().fault = None;
            let start = Instant::now();
            let second = request(&mut device, &world, 3, Kind::Read).await;
            println!("rtu {is_rtu} {fault:?}: {first:?} in {longest:?}, then {second:?} in {:?}", start.elapsed());
            assert!(second.is_ok(), "{fault:?}: {second:?}");
            assert!(start.elapsed() <= 4 * TIMEOUT, "{fault:?}: {:?}", start.elapsed());
        }
    }
}

/// Tests a client on a pseudo-terminal in real time. On a machine under load, additional requests may time out.
#[cfg(unix)]
#[tokio::test]
async fn late_replies_on_a_pseudo_terminal() {
    const TIMEOUT: Duration = Duration::from_millis(100);
    let (near, far) = tokio_serial::SerialStream::pair().expect("a pseudo-terminal");
    let world = world();
    tokio::spawn(serve(far, true, world.clone()));
    let mut device = ModbusClient::new(Link::rtu(near, Slave(DEVICE), TIMEOUT));
    let (mut late, mut failed) = (0, 0);
    for number in 0..200 {
        let is_late = number % 20 == 7;
        late += u32::from(is_late);
        world.lock().unwrap().fault = is_late.then_some(StreamFault::Late(TIMEOUT * 5 / 4));
        failed += u32::from(request(&mut device, &world, number, Kind::Read).await.is_err());
    }
    println!("200 Modbus RTU requests on a pseudo-terminal, {late} late: {failed} errors, no wrong value");
    assert!((late..100).contains(&failed), "{failed} errors for {late} late replies");
}

#[tokio::test(start_paused = true)]
async fn after_a_dropped_call_the_next_one_is_right() {
    for is_rtu in [true, false] {
        let world = world();
        let mut device = client(link(is_rtu, &world));
        world.lock().unwrap().fault = Some(StreamFault::Late(Duration::from_millis(100)));
        let dropped = timeout(Duration::from_millis(20), request(&mut device, &world, 1, Kind::Read)).await;
        assert!(dropped.is_err());
        world.lock().unwrap().fault = None;
        request(&mut device, &world, 2, Kind::Read).await.expect("the reply");
    }
}

#[test]
fn blocking_calls_after_a_late_reply() {
    for is_rtu in [true, false] {
        let world = world();
        let mut device = blocking(is_rtu, &world);
        world.lock().unwrap().fault = Some(StreamFault::Late(TIMEOUT));
        assert!(matches!(Client::read(&mut device, COUNT, &mut [0; 4]), Err(Error::Timeout)));
        world.lock().unwrap().fault = None;
        world.lock().unwrap().count = 7;
        let mut buffer = [0; 4];
        assert_eq!(Client::read(&mut device, COUNT, &mut buffer).expect("a value"), 4);
        assert_eq!(buffer, [7, 0, 0, 0]);
        const ITEM: Setpoint = Setpoint::register(SETPOINT, "Setpoint", Flags::NONE);
        ITEM.at(&mut device).write(12).expect("a reply");
        assert_eq!(world.lock().unwrap().setpoint, 12);
    }
}

#[tokio::test(start_paused = true)]
async fn the_rest_of_a_request_is_not_sent_after_the_timeout() {
    // The line accepts only four bytes before the device reads.
    let (line, mut far) = duplex(4);
    let mut device = ModbusClient::new(Link::rtu(line, Slave(DEVICE), TIMEOUT));
    assert!(matches!(device.write(SETPOINT, &[1, 0]).await, Err(Error::Timeout)));
    let received = tokio::spawn(async move {
        let mut bytes = Vec::new();
        far.read_to_end(&mut bytes).await.map(|_| bytes)
    });
    assert!(matches!(device.write(SETPOINT, &[2, 0]).await, Err(Error::Timeout)));
    drop(device);
    let request = |value| frame(true, [0; 2], DEVICE, &[6, 0, 20, 0, value]);
    let bytes = received.await.expect("the task ends").expect("the line is closed");
    assert_eq!(bytes, [&request(1)[..4], &request(2)].concat());
}

#[tokio::test(start_paused = true)]
async fn a_timeout_of_any_length_is_valid() {
    for is_rtu in [true, false] {
        let world = world();
        let (line, device) = duplex(0x1_0000);
        tokio::spawn(serve(device, is_rtu, world.clone()));
        let link = if is_rtu { Link::rtu } else { Link::tcp };
        let mut device = ModbusClient::new(link(line, Slave(DEVICE), Duration::MAX));
        request(&mut device, &world, 1, Kind::Read).await.expect("the reply");
        world.lock().unwrap().fault = Some(StreamFault::Late(Duration::from_millis(100)));
        assert!(timeout(Duration::from_millis(20), request(&mut device, &world, 2, Kind::Read)).await.is_err());
        world.lock().unwrap().fault = None;
        request(&mut device, &world, 3, Kind::Read).await.expect("the reply");
    }
}

/// Shows why [`Link`] exists: without it, `tokio-modbus` keeps a late reply, and all later requests fail.
#[tokio::test(start_paused = true)]
async fn contexts_without_a_link_are_out_of_step() {
    let world = world();
    let (line, device) = duplex(0x1_0000);
    tokio::spawn(serve(device, false, world.clone()));
    let mut device = ModbusClient::new(tcp::attach_slave(line, Slave(DEVICE)));
    world.lock().unwrap().fault = Some(StreamFault::Late(TIMEOUT));
    assert!(timeout(TIMEOUT, request(&mut device, &world, 1, Kind::Read)).await.is_err());
    world.lock().unwrap().fault = None;
    sleep(TIMEOUT).await;
    let mut failed = 0;
    for number in 2..12 {
        failed += u32::from(request(&mut device, &world, number, Kind::Read).await.is_err());
    }
    assert_eq!(failed, 10, "each call gets the reply to the one before");
}

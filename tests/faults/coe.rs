//! Tests the EtherCAT mailbox client with a simulated SubDevice whose replies are delayed, lost or corrupted, in
//! simulated time.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::time::Duration;

use ethercrab::error::Error as BusError;
use ethercrab::subdevice_group::PreOp;
use ethercrab::{DefaultLock, SubDeviceGroup};
use lexibus::clients::ethercat::Sdo;
use lexibus::sim::{EtherCatFault, FaultyFrames};
use lexibus::{AbortCode, AsyncClient, Error, Object};
use tokio::time::{sleep, timeout, Instant, Sleep};

use crate::ethercat::objects::Dictionary;
use crate::ethercat::SubDevice;
use crate::matrix::{name, Row};
use crate::random::Random;
use crate::segment::with_faulty_segment;

const TIMEOUT: Duration = Duration::from_millis(200);
/// Object that contains the number of the current request.
const COUNT: Object = Object::new(0x2000, 0);
/// Object that contains the same number as a text of 300 bytes, which needs a segmented transfer.
const TEXT: Object = Object::new(0x2001, 0);
const SETPOINT: Object = Object::new(0x2002, 0);

/// A fault in the replies to one request.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    Nothing,
    /// The replies arrive with this delay.
    Late(Duration),
    /// The SubDevice sends no reply.
    Lost,
    /// The datagram that contains the reply is lost.
    LostDatagram,
    Duplicated,
    /// The replies are truncated to four bytes after the mailbox header.
    Truncated,
    /// A reply about another object arrives before the reply.
    Foreign,
    /// Messages of other protocols arrive before the reply.
    Noise,
    /// Messages of other protocols arrive without end, one every 10 ms.
    EndlessNoise,
}

/// The simulated SubDevice: its values, the current fault, and the messages that this fault delays.
struct World {
    count: u32,
    setpoint: u32,
    fault: Fault,
    /// Delayed messages with their arrival times.
    delayed: Vec<(Instant, Vec<u8>)>,
    /// Number of frames that the SubDevice has processed.
    frames: usize,
}

type Shared = Rc<RefCell<World>>;

struct Objects(Shared);

fn text(count: u32) -> Vec<u8> {
    format!("{count:0300}").into_bytes()
}

impl Dictionary for Objects {
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32> {
        let world = self.0.borrow();
        match Object::new(index, sub_index) {
            COUNT => Ok(world.count.to_le_bytes().to_vec()),
            TEXT => Ok(text(world.count)),
            _ => Err(AbortCode::NO_OBJECT.0),
        }
    }

    fn write(&mut self, _: u16, _: u8, data: &[u8]) -> Result<(), u32> {
        self.0.borrow_mut().setpoint = u32::from_le_bytes(data.try_into().map_err(|_| AbortCode::GENERAL.0)?);
        Ok(())
    }
}

impl World {
    /// Applies the fault to a reply, and returns the messages that the SubDevice sends now.
    fn filter(&mut self, reply: Option<Vec<u8>>) -> Vec<Vec<u8>> {
        self.frames += 1;
        let now = Instant::now();
        let (due, delayed) = std::mem::take(&mut self.delayed).into_iter().partition(|(at, _)| *at <= now);
        self.delayed = delayed;
        let mut messages: Vec<Vec<u8>> = due.into_iter().map(|(_, message)| message).collect();
        // Ethernet over EtherCAT has the protocol number 2.
        let ethernet = vec![2, 0, 0, 0, 0, 2, 0xAA, 0xBB];
        match (self.fault, reply) {
            (Fault::EndlessNoise, _) if self.delayed.is_empty() => self.delayed.push((now + TIMEOUT / 20, ethernet)),
            (_, None) | (Fault::Lost | Fault::EndlessNoise, _) => {}
            (Fault::Nothing | Fault::LostDatagram, Some(reply)) => messages.push(reply),
            (Fault::Late(delay), Some(reply)) => self.delayed.push((now + delay, reply)),
            (Fault::Duplicated, Some(reply)) => messages.extend([reply.clone(), reply]),
            (Fault::Truncated, Some(reply)) => messages.push([&[4, 0], &reply[2..10]].concat()),
            (Fault::Foreign, Some(reply)) => {
                let foreign = vec![10, 0, 0, 0, 0, 0x13, 0, 0x30, 0x43, 0x34, 0x12, 1, 9, 9, 9, 9];
                messages.extend([foreign, reply]);
            }
            (Fault::Noise, Some(reply)) => {
                messages.extend(vec![ethernet; 20]);
                messages.push(reply);
            }
        }
        messages
    }
}

type Client = Sdo<'static, fn(Duration) -> Sleep>;

/// A client on a segment with one SubDevice.
struct Bench {
    client: Client,
    world: Shared,
    faults: FaultyFrames,
}

thread_local! {
    static START: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// Returns the simulated time.
fn clock() -> Duration {
    let start = START.get().unwrap_or_else(Instant::now);
    START.set(Some(start));
    start.elapsed()
}

impl Bench {
    /// Sends one request, and panics if the value is wrong.
    async fn request(&mut self, count: u32, fault: Fault, object: Object) -> Result<(), Error<BusError>> {
        (self.world.borrow_mut().count, self.world.borrow_mut().fault) = (count, fault);
        self.faults.clear_faults();
        if fault == Fault::LostDatagram {
            self.faults.inject_nth(EtherCatFault::LostReply, 1);
        }
        let mut buffer = [0; 300];
        match object {
            SETPOINT => {
                self.client.write(object, &count.to_le_bytes()).await?;
                assert_eq!(self.world.borrow().setpoint, count, "{fault:?}");
            }
            TEXT => {
                let length = self.client.read(object, &mut buffer).await?;
                assert_eq!(buffer[..length], text(count), "{fault:?}");
            }
            _ => {
                let length = self.client.read(object, &mut buffer[..4]).await?;
                assert_eq!(buffer[..length], count.to_le_bytes(), "{fault:?}");
            }
        }
        Ok(())
    }
}

/// Runs a test with a client in state Pre-Operational.
fn with_bench<T, F: std::future::Future<Output = T>>(work: impl FnOnce(Bench) -> F) -> T {
    START.set(None);
    let world = World { count: 0, setpoint: 0, fault: Fault::Nothing, delayed: Vec::new(), frames: 0 };
    let world = Rc::new(RefCell::new(world));
    let filtered = world.clone();
    let subdevice = SubDevice::new(&crate::servo::DEVICE, Objects(world.clone()))
        .with_filter(Box::new(move |reply| filtered.borrow_mut().filter(reply)));
    let faults = FaultyFrames::new();
    with_faulty_segment(vec![subdevice], faults.clone(), |maindevice| async move {
        type Group = SubDeviceGroup<4, 64, DefaultLock, PreOp>;
        let group: Group = maindevice.init_single_group(|| 1_000_000).await.expect("Pre-Operational");
        let sdo = Sdo::new(maindevice, &group.subdevice(maindevice, 0).expect("a SubDevice"));
        let timer: fn(Duration) -> Sleep = sleep;
        let client = sdo.with_timeout(TIMEOUT).with_clock(clock).with_timer(timer);
        work(Bench { client, world, faults }).await
    })
}

#[test]
fn late_replies_are_not_those_of_the_next_request() {
    let (late, failed) = with_bench(|mut bench| async move {
        let mut random = Random::new(28);
        let (mut late, mut failed) = (0, 0);
        for number in 0..10_000 {
            let is_late = random.below(20) == 0;
            late += u32::from(is_late);
            let delay = TIMEOUT + Duration::from_millis(random.below(190));
            let fault = if is_late { Fault::Late(delay) } else { Fault::Nothing };
            let object = [COUNT, TEXT, SETPOINT][random.below(3) as usize];
            match bench.request(number, fault, object).await {
                Ok(()) => {}
                Err(Error::Timeout) => failed += 1,
                Err(other) => panic!("request {number}: {other}"),
            }
        }
        (late, failed)
    });
    println!("10,000 transfers through a mailbox, {late} late: {failed} errors, no wrong value");
    assert!(late > 400 && failed <= late, "{failed} errors for {late} late replies");
}

/// If each reply arrives just before the timeout, a segmented transfer must still fail.
#[test]
fn the_timeout_limits_the_whole_transfer() {
    with_bench(|mut bench| async move {
        let start = Instant::now();
        // The text needs three messages, so the client limits the transfer to one timeout plus two tenths of the timeout.
        let result = bench.request(1, Fault::Late(TIMEOUT * 9 / 10), TEXT).await;
        assert_eq!(
            (result, start.elapsed() <= TIMEOUT * 13 / 10),
            (Err(Error::Timeout), true),
            "{:?}",
            start.elapsed()
        );
        bench.request(2, Fault::Nothing, TEXT).await.expect("the next transfer is right");
        bench.request(3, Fault::Late(TIMEOUT * 3 / 10), TEXT).await.expect("within the limit");
    });
}

#[test]
fn after_a_dropped_transfer_the_next_one_is_right() {
    with_bench(|mut bench| async move {
        let late = Fault::Late(TIMEOUT / 2);
        for object in [COUNT, TEXT] {
            assert!(timeout(TIMEOUT / 10, bench.request(1, late, object)).await.is_err());
            bench.request(2, Fault::Nothing, object).await.expect("the reply");
        }
    });
}

#[test]
fn the_mailbox_is_not_polled_without_a_pause() {
    let frames = with_bench(|mut bench| async move {
        bench.request(1, Fault::Nothing, COUNT).await.expect("the addresses of the mailbox");
        let before = bench.world.borrow().frames;
        assert_eq!(bench.request(1, Fault::Lost, COUNT).await, Err(Error::Timeout));
        let frames = bench.world.borrow().frames - before;
        frames as u128
    });
    assert!((10..=TIMEOUT.as_millis() * 2 + 10).contains(&frames), "{frames} frames");
}

#[test]
fn endless_noise_ends_in_time() {
    with_bench(|mut bench| async move {
        for _ in 0..2 {
            let start = Instant::now();
            let work = bench.request(1, Fault::EndlessNoise, COUNT);
            let result = timeout(TIMEOUT * 3, work).await;
            assert_eq!(result, Ok(Err(Error::Timeout)));
            assert!(start.elapsed() <= 2 * TIMEOUT, "{:?}", start.elapsed());
        }
    });
}

/// Sends requests with random faults for the simulated time `time`, with a pause after each request. Returns the numbers
/// of requests and errors.
pub fn soak(time: Duration, mut observe: impl FnMut(Duration)) -> (u32, u32) {
    with_bench(|mut bench| async move {
        let (mut random, start) = (Random::new(31), Instant::now());
        let (mut requests, mut errors) = (0, 0);
        while start.elapsed() < time {
            let fault = match random.below(60) {
                0 => Fault::Late(TIMEOUT + Duration::from_millis(random.below(190))),
                1 => Fault::Lost,
                2 => Fault::LostDatagram,
                3 => Fault::Duplicated,
                4 => Fault::Truncated,
                5 => Fault::Foreign,
                6 => Fault::Noise,
                _ => Fault::Nothing,
            };
            let object = [COUNT, TEXT, SETPOINT][random.below(3) as usize];
            errors += u32::from(bench.request(requests, fault, object).await.is_err());
            requests += 1;
            sleep(TIMEOUT).await;
            observe(start.elapsed());
        }
        (requests, errors)
    })
}

/// Returns the rows for the mailbox in the table of faults.
pub fn rows() -> Vec<Row> {
    let faults = [
        ("late", Fault::Late(TIMEOUT + Duration::from_millis(100))),
        ("lost", Fault::Lost),
        ("lost datagram", Fault::LostDatagram),
        ("duplicated", Fault::Duplicated),
        ("truncated", Fault::Truncated),
        ("foreign", Fault::Foreign),
        ("noise", Fault::Noise),
    ];
    let row = |(fault_name, fault)| {
        with_bench(|mut bench| async move {
            let start = Instant::now();
            let result = bench.request(1, fault, COUNT).await;
            let time = start.elapsed();
            bench.request(2, Fault::Nothing, COUNT).await.expect("the next request is right");
            let next = start.elapsed() - time;
            let (client, result, timeout) = ("EtherCAT", name(&result), TIMEOUT);
            Row { client, is_async: true, fault: fault_name, result, time, next, timeout }
        })
    };
    faults.map(row).into()
}

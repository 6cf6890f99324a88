//! Soak tests: an hour of simulated time for each bus, with random faults. They cover the clients for SDO (CANopen and
//! EtherCAT), Modbus and serial lines, and the state machine walker. No value may be wrong, no buffer may grow, and the
//! memory of the process may grow by at most 1 MiB.

use std::process::Command;
use std::time::Duration;

use lexibus::clients::canopen::Node;
use lexibus::sim::{CanBus, CanFault, CanNode, Device, StreamFault};
use lexibus::NodeId;
use lexibus_drives::demo_drive::types::State;
use lexibus_drives::demo_drive::{objects, DemoDrive, ENTRIES};

use crate::faulty::{faulty, set, TIMEOUT};
use crate::lane;
use crate::modbus;
use crate::random::Random;
use crate::serial;

const HOUR: Duration = Duration::from_secs(3600);

/// Name of the environment variable that contains the name of the test to run in this process.
const ALONE: &str = "LEXIBUS_SOAK";

/// Maximum growth of the resident memory after the first fifth of a test, in KiB. The allocator keeps some free memory.
const MAX_GROWTH: usize = 1024;

/// Runs a soak test in a separate process, so that no other test changes the memory of the process.
fn alone(name: &str, work: impl FnOnce()) {
    if lane::skips(name) {
        return;
    }
    if std::env::var(ALONE).is_ok_and(|test| test == name) {
        return work();
    }
    let program = std::env::current_exe().expect("the test program");
    let output = Command::new(program)
        .args(["--exact", &format!("soak::{name}"), "--nocapture", "--test-threads=1"])
        .env(ALONE, name)
        .output()
        .expect("the test program starts");
    let printed = String::from_utf8_lossy(&output.stdout);
    println!("{printed}{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success() && printed.contains("1 passed"), "{name}");
}

/// Returns the resident memory of this process in KiB, or `None` if the system does not report it.
fn resident() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().strip_suffix(" kB")?.trim().parse().ok()
}

/// Compares the memory of the process after the first fifth of a test with that at its end.
#[derive(Default)]
struct Memory {
    early: Option<usize>,
}

impl Memory {
    fn observe(&mut self, elapsed: Duration, whole: Duration) {
        if self.early.is_none() && elapsed > whole / 5 {
            self.early = resident();
        }
    }

    fn check(&self) {
        let (Some(early), Some(end)) = (self.early, resident()) else { return println!("unknown memory") };
        println!("resident memory: {early} KiB after a fifth of the time, {end} KiB at the end");
        assert!(end <= early + MAX_GROWTH, "the memory grew from {early} to {end} KiB");
    }
}

fn fault(random: &mut Random) -> Option<CanFault> {
    match random.below(500) {
        0 => return Some(CanFault::Restart),
        1 => return Some(CanFault::BusOff),
        _ => {}
    }
    match random.below(60) {
        0 => Some(CanFault::Late(TIMEOUT + Duration::from_millis(random.below(450)))),
        1 => Some(CanFault::Lost),
        2 => Some(CanFault::Duplicated),
        3 => Some(CanFault::Truncated),
        4 => Some(CanFault::WrongToggle),
        5 => Some(CanFault::ErrorFrame),
        _ => None,
    }
}

#[test]
fn an_hour_over_can() {
    alone("an_hour_over_can", can);
}

fn can() {
    let mut memory = Memory::default();
    let id = NodeId::new(5).expect("a node-ID");
    let mut bus = CanBus::new();
    bus.add(CanNode::new(Device::new(ENTRIES).with_node_id(id).with_cia402()));
    let mut drive = DemoDrive::new(Node::new(faulty(bus), id));
    let mut random = Random::new(28);
    let (mut requests, mut errors, mut walks, mut longest, mut restarts) = (0_u32, 0, 0, 0, 0);
    while drive.client().port().bus().now() < HOUR {
        requests += 1;
        let value = requests % 50_000;
        let port = drive.client().port();
        let fault = fault(&mut random);
        restarts += u32::from(fault == Some(CanFault::Restart));
        set(port, fault);
        let is_right = match random.below(20) {
            0 => {
                walks += 1;
                let target = [State::OperationEnabled, State::SwitchOnDisabled][random.below(2) as usize];
                let result = drive.walk(target, Duration::from_secs(2));
                let status = drive.client().port().bus().nodes()[0].device().get(objects::STATUSWORD);
                result.map(|_| assert_eq!(status.map(|status| status.state()), Ok(Some(target)))).is_ok()
            }
            1..=10 => {
                let device = drive.client().port().bus().nodes()[0].device();
                device.set(objects::PROFILE_VELOCITY, value).expect("an object");
                drive.profile_velocity().read().map(|read| assert_eq!(read, value, "request {requests}")).is_ok()
            }
            _ => drive.profile_velocity().write(value).is_ok_and(|()| {
                let device = drive.client().port().bus().nodes()[0].device();
                assert_eq!(device.get(objects::PROFILE_VELOCITY), Ok(value), "request {requests}");
                true
            }),
        };
        errors += u32::from(!is_right);
        longest = longest.max(drive.client().port().waiting());
        memory.observe(drive.client().port().bus().now(), HOUR);
    }
    memory.check();
    println!("{requests} accesses, {walks} of them walks, {restarts} restarts: {errors} errors, no wrong value, {longest} waiting frames");
    assert!(requests > 10_000 && restarts > 10 && errors > 100 && errors < requests / 4, "{errors} errors");
    assert!(longest < 100, "{longest} waiting frames");
}

/// Runs asynchronous work in simulated time.
fn simulated(work: impl std::future::Future<Output = ()>) {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().start_paused(true).build();
    runtime.expect("a runtime").block_on(work);
}

#[test]
fn an_hour_over_modbus() {
    alone("an_hour_over_modbus", || simulated(modbus()));
}

async fn modbus() {
    for is_rtu in [true, false] {
        let world = modbus::world();
        let mut device = modbus::client(modbus::link(is_rtu, &world));
        let (mut random, start) = (Random::new(29), tokio::time::Instant::now());
        let (mut requests, mut errors, mut memory) = (0, 0, Memory::default());
        while start.elapsed() < HOUR / 2 {
            memory.observe(start.elapsed(), HOUR / 2);
            world.lock().unwrap().fault = match random.below(40) {
                0 => Some(StreamFault::Late(Duration::from_millis(200 + random.below(190)))),
                1 => Some(StreamFault::Lost),
                2 => Some(StreamFault::Duplicated),
                3 => Some(StreamFault::Truncated),
                4 => Some(modbus::foreign(is_rtu)),
                _ => None,
            };
            let kind = [modbus::Kind::Read, modbus::Kind::Write][random.below(2) as usize];
            errors += u32::from(modbus::request(&mut device, &world, requests, kind).await.is_err());
            requests += 1;
        }
        memory.check();
        let tasks = tokio::runtime::Handle::current().metrics().num_alive_tasks();
        assert!(tasks <= 2, "{tasks} tasks");
        println!("{requests} requests (RTU: {is_rtu}): {errors} errors, no wrong value");
        assert!(requests > 10_000 && errors > 100 && errors < requests / 4, "{errors} of {requests}");
    }
}

#[test]
fn an_hour_over_serial() {
    alone("an_hour_over_serial", serial);
}

/// Returns a fault for one reply in eight, on average.
fn serial_fault(random: &mut Random) -> Option<StreamFault> {
    match random.below(40) {
        0 => Some(StreamFault::Late(Duration::from_millis(101 + random.below(90)))),
        1 => Some(StreamFault::Lost),
        2 => Some(StreamFault::Duplicated),
        3 => Some(StreamFault::Truncated),
        4 => Some(StreamFault::Noise(vec![0xFF, 0x03, 0x41])),
        _ => None,
    }
}

fn serial() {
    let (mut line, now) = serial::blocking();
    let (mut random, mut memory) = (Random::new(30), Memory::default());
    let (mut requests, mut errors, mut longest) = (0, 0, 0);
    while now.get() < HOUR / 2 {
        errors += u32::from(serial::once(&mut line, requests, serial_fault(&mut random)).is_err());
        requests += 1;
        longest = longest.max(serial::waiting(&mut line));
        memory.observe(now.get(), HOUR / 2);
    }
    memory.check();
    println!("{requests} exchanges: {errors} errors, no wrong reply, {longest} waiting bytes");
    assert!(requests > 10_000 && errors > 100 && errors < requests / 4 && longest < 100, "{errors} of {requests}");
    simulated(async {
        let (mut line, world) = serial::asynchronous();
        let (mut requests, mut errors, mut memory) = (0, 0, Memory::default());
        let start = tokio::time::Instant::now();
        while start.elapsed() < HOUR / 2 {
            let fault = serial_fault(&mut random);
            errors += u32::from(serial::once_async(&mut line, &world, requests, fault).await.is_err());
            requests += 1;
            memory.observe(start.elapsed(), HOUR / 2);
        }
        memory.check();
        println!("{requests} async exchanges: {errors} errors, no wrong reply");
        assert!(requests > 10_000 && errors > 100 && errors < requests / 4, "{errors} of {requests}");
    });
}

#[cfg(all(feature = "ethercat", feature = "macros"))]
#[test]
fn an_hour_over_ethercat() {
    alone("an_hour_over_ethercat", || {
        let mut memory = Memory::default();
        let (requests, errors) = crate::coe::soak(HOUR, |elapsed| memory.observe(elapsed, HOUR));
        memory.check();
        println!("{requests} transfers through a mailbox: {errors} errors, no wrong value");
        assert!(requests > 10_000 && errors > 100 && errors < requests / 4, "{errors} of {requests}");
    });
}

//! Rows for Modbus in the table of faults.

use std::time::Duration;

use lexibus::clients::modbus::tokio_modbus::prelude::SlaveContext;
use lexibus::clients::modbus::tokio_modbus::Slave;
use lexibus::clients::modbus::{BlockingLink, ModbusError, TURNAROUND};
use lexibus::modbus::RegisterClient;
use lexibus::sim::StreamFault;
use lexibus::{AsyncClient, Client, Error};
use tokio::time::Instant;

use crate::matrix::{name, Row};
use crate::modbus::{client, foreign, link, noise, request, world, Kind, Shared, COUNT, DEVICE, SETPOINT, TIMEOUT};

/// Number of faults.
const FAULTS: usize = 6;

fn faults(is_rtu: bool) -> [(&'static str, StreamFault); FAULTS] {
    [
        ("late", StreamFault::Late(TIMEOUT)),
        ("lost", StreamFault::Lost),
        ("duplicated", StreamFault::Duplicated),
        ("truncated", StreamFault::Truncated),
        ("foreign", foreign(is_rtu)),
        ("noise", noise()),
    ]
}

/// Names of the requests in the table, for RTU and for TCP.
const CLIENTS: [(Kind, [&str; 2]); 3] = [
    (Kind::Read, ["Modbus RTU", "Modbus TCP"]),
    (Kind::Mask, ["Modbus RTU, mask write", "Modbus TCP, mask write"]),
    (Kind::Exchange, ["Modbus RTU, write and read", "Modbus TCP, write and read"]),
];

/// Number of rows that [`rows`] returns.
pub const COUNT_OF_ROWS: usize = CLIENTS.len() * 2 * FAULTS * 2 + 2 * FAULTS;

/// Returns the rows for Modbus in the table of faults.
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (kind, names) in CLIENTS {
        for (client, is_rtu) in names.into_iter().zip([true, false]) {
            for (fault_name, fault) in faults(is_rtu) {
                for is_async in [false, true] {
                    let world = world();
                    let (first, next) = if is_async {
                        twice(is_rtu, &world, &fault, kind)
                    } else {
                        blocking_twice(is_rtu, &world, &fault, kind)
                    };
                    let (result, time) = first;
                    rows.push(Row { client, is_async, fault: fault_name, result, time, next, timeout: TIMEOUT });
                }
            }
        }
    }
    for (fault_name, fault) in faults(true) {
        // A device that replies to a broadcast violates the standard. The link discards only replies that arrive
        // within the turnaround delay, so in this test, a late reply arrives after half of this delay.
        let is_late = fault == StreamFault::Late(TIMEOUT);
        let fault = if is_late { StreamFault::Late(TURNAROUND / 2) } else { fault };
        for is_async in [false, true] {
            let ((result, time), next) = if is_async { broadcast(&fault) } else { blocking_broadcast(&fault) };
            let client = "Modbus RTU, broadcast";
            rows.push(Row { client, is_async, fault: fault_name, result, time, next, timeout: TIMEOUT });
        }
    }
    rows
}

type Twice = ((&'static str, Duration), Duration);

/// Returns the result and duration of a request with a fault, and the duration of the next request, which must succeed.
fn twice(is_rtu: bool, world: &Shared, fault: &StreamFault, kind: Kind) -> Twice {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().start_paused(true).build();
    runtime.expect("a runtime").block_on(async {
        let mut device = client(link(is_rtu, world));
        world.lock().unwrap().fault = Some(fault.clone());
        let start = Instant::now();
        let first = (name(&request(&mut device, world, 1, kind).await), start.elapsed());
        world.lock().unwrap().fault = None;
        let start = Instant::now();
        request(&mut device, world, 2, kind).await.expect("the next request is right");
        (first, start.elapsed())
    })
}

/// Returns a blocking link that runs in simulated time, and a function that returns this time.
fn blocking(is_rtu: bool, world: &Shared) -> (BlockingLink<tokio::io::DuplexStream>, impl Fn() -> Instant) {
    let mut handle = None;
    let link = BlockingLink::open(async {
        tokio::time::pause();
        handle = Some(tokio::runtime::Handle::current());
        Ok(link(is_rtu, world))
    });
    let handle = handle.expect("the runtime of the link");
    let now = move || {
        let _guard = handle.enter();
        Instant::now()
    };
    (link.expect("a link"), now)
}

fn blocking_twice(is_rtu: bool, world: &Shared, fault: &StreamFault, kind: Kind) -> Twice {
    let (link, now) = blocking(is_rtu, world);
    let mut device = client(link);
    let mut send = |number: u32, fault: Option<StreamFault>| {
        (world.lock().unwrap().count, world.lock().unwrap().fault) = (number, fault.clone());
        let (mut buffer, word) = ([0; 4], number as u16);
        let start = now();
        let result = match kind {
            Kind::Read => Client::read(&mut device, COUNT, &mut buffer).map(|_| ()),
            Kind::Write => Client::write(&mut device, SETPOINT, &word.to_le_bytes()),
            Kind::Mask => RegisterClient::mask_register(&mut device, SETPOINT.address, 0, word),
            Kind::Exchange => {
                let data = word.to_le_bytes();
                RegisterClient::write_and_read(&mut device, SETPOINT, &data, COUNT, &mut buffer).map(|_| ())
            }
        };
        let is_read = matches!(kind, Kind::Read | Kind::Exchange);
        assert!(result.is_err() || !is_read || u32::from_le_bytes(buffer) == number, "{fault:?}");
        assert!(result.is_err() || kind == Kind::Read || world.lock().unwrap().setpoint == word, "{fault:?}");
        (result, now() - start)
    };
    let (first, time) = send(1, Some(fault.clone()));
    let (second, next) = send(2, None);
    second.expect("the next request is right");
    ((name(&first), time), next)
}

/// Returns the result and duration of a broadcast to a device that replies although it must not, and the duration of the
/// next read.
fn broadcast(fault: &StreamFault) -> Twice {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().start_paused(true).build();
    runtime.expect("a runtime").block_on(async {
        let world = world();
        let mut device = client(link(true, &world));
        world.lock().unwrap().fault = Some(fault.clone());
        device.context().set_slave(Slave::broadcast());
        let start = Instant::now();
        let first = (name(&request(&mut device, &world, 1, Kind::Write).await), start.elapsed());
        world.lock().unwrap().fault = None;
        device.context().set_slave(Slave(DEVICE));
        let start = Instant::now();
        request(&mut device, &world, 2, Kind::Read).await.expect("the next request is right");
        (first, start.elapsed())
    })
}

fn blocking_broadcast(fault: &StreamFault) -> Twice {
    let world = world();
    let (link, now) = blocking(true, &world);
    let mut device = client(link);
    world.lock().unwrap().fault = Some(fault.clone());
    device.context().set_slave(Slave::broadcast());
    let start = now();
    let result = Client::write(&mut device, SETPOINT, &[7, 0]);
    let first = (name(&result), now() - start);
    assert_eq!(world.lock().unwrap().setpoint, 7);
    (world.lock().unwrap().count, world.lock().unwrap().fault) = (2, None);
    device.context().set_slave(Slave(DEVICE));
    let (start, mut buffer) = (now(), [0; 4]);
    Client::read(&mut device, COUNT, &mut buffer).expect("the next request is right");
    assert_eq!(buffer, [2, 0, 0, 0]);
    (first, now() - start)
}

#[tokio::test(start_paused = true)]
async fn a_broadcast_takes_the_turnaround_delay() {
    const DELAY: Duration = Duration::from_millis(150);
    let world = world();
    let mut device = client(link(true, &world));
    device.context().set_slave(Slave::broadcast());
    let start = Instant::now();
    request(&mut device, &world, 1, Kind::Write).await.expect("no reply is expected");
    assert!((TURNAROUND..TURNAROUND + Duration::from_millis(10)).contains(&start.elapsed()), "{:?}", start.elapsed());
    request(&mut device, &world, 2, Kind::Mask).await.expect("function 22 needs no reply");

    let mut device = client(link(true, &world).with_turnaround(DELAY));
    device.context().set_slave(Slave::broadcast());
    // If a call is dropped during the delay, the next request waits for the rest of the delay.
    let start = Instant::now();
    let dropped = tokio::time::timeout(DELAY / 2, request(&mut device, &world, 3, Kind::Write)).await;
    assert!(dropped.is_err() && world.lock().unwrap().setpoint == 3);
    device.context().set_slave(Slave(DEVICE));
    request(&mut device, &world, 4, Kind::Read).await.expect("the reply");
    assert!((DELAY..2 * DELAY).contains(&start.elapsed()), "{:?}", start.elapsed());
}

#[tokio::test(start_paused = true)]
async fn a_broadcast_cannot_read() {
    let world = world();
    let mut device = client(link(true, &world));
    device.context().set_slave(Slave::broadcast());
    let start = Instant::now();
    let part = SETPOINT.part(0, 8);
    // Without function 22, a client must read a register to write a part of the register, and a broadcast cannot read.
    let mut plain = lexibus::clients::modbus::ModbusClient::new(link(true, &world));
    plain.context().set_slave(Slave::broadcast());
    let refused = [
        device.read(COUNT, &mut [0; 4]).await.map(|_| ()),
        request(&mut device, &world, 5, Kind::Exchange).await,
        plain.write(part, &[5]).await,
    ];
    for refused in refused {
        assert!(matches!(refused, Err(Error::Client(ModbusError::Broadcast))), "{refused:?}");
    }
    assert_eq!((world.lock().unwrap().setpoint, start.elapsed()), (0, Duration::ZERO), "nothing was sent");
    device.write(part, &[5]).await.expect("function 22");
    assert_eq!(world.lock().unwrap().setpoint, 5);
}

#[tokio::test(start_paused = true)]
async fn unit_0_on_tcp() {
    let world = world();
    // Without a turnaround delay, unit 0 is a single device that must reply. This device does not reply.
    let mut device = client(link(false, &world));
    device.context().set_slave(Slave::broadcast());
    assert!(matches!(request(&mut device, &world, 1, Kind::Write).await, Err(Error::Timeout)));
    // A gateway doesn't reply to a broadcast.
    let mut device = client(link(false, &world).with_turnaround(TURNAROUND));
    device.context().set_slave(Slave::broadcast());
    request(&mut device, &world, 2, Kind::Write).await.expect("no reply is expected");
    world.lock().unwrap().fault = Some(foreign(false));
    request(&mut device, &world, 3, Kind::Write).await.expect("replies of the gateway are discarded");
    world.lock().unwrap().fault = None;
    device.context().set_slave(Slave(DEVICE));
    request(&mut device, &world, 4, Kind::Read).await.expect("the reply");
}

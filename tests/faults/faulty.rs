//! The faults of the CAN bus in the table of faults.

use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, CanPort};
use lexibus::sim::{CanBus, CanFault, FaultyCan, SimulatedCan};

/// Timeout of the clients under test.
pub const TIMEOUT: Duration = Duration::from_millis(500);

/// Returns a fault: `frame` arrives repeatedly, for longer than any client waits.
pub const fn foreign(frame: CanFrame) -> CanFault {
    CanFault::Foreign { frame, count: 300, period: Duration::from_millis(200) }
}

/// Returns the faults of the test `matrix`, with the names in the table that it prints. `frame` is a frame of another node or
/// service.
pub fn faults(frame: CanFrame) -> [(&'static str, CanFault); 9] {
    [
        ("late", CanFault::Late(TIMEOUT + Duration::from_millis(100))),
        ("lost", CanFault::Lost),
        ("duplicated", CanFault::Duplicated),
        ("truncated", CanFault::Truncated),
        ("foreign", foreign(frame)),
        ("noise", CanFault::Noise(1000)),
        ("restart", CanFault::Restart),
        ("bus-off", CanFault::BusOff),
        ("error frame", CanFault::ErrorFrame),
    ]
}

pub type Faulty = FaultyCan<CanBus>;

/// Returns a bus whose first frames, such as boot-up messages, are already received.
pub fn faulty(bus: CanBus) -> Faulty {
    let mut faulty = FaultyCan::new(bus);
    assert_eq!(CanPort::receive(&mut faulty, Duration::ZERO, &mut |_| false), Ok(None));
    faulty
}

/// Applies this fault, or none, to all frames that arrive from now on. A restart happens only once.
pub fn set<B: SimulatedCan>(port: &mut FaultyCan<B>, fault: impl Into<Option<CanFault>>) {
    port.clear_faults();
    port.recover();
    match fault.into() {
        Some(CanFault::Restart) => port.inject_nth(CanFault::Restart, 1),
        Some(fault) => port.inject(fault, |_| true),
        None => {}
    }
}

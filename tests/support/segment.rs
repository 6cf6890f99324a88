//! A simulated EtherCAT segment with a master. The program contains the simulation in its module `ethercat`.

use std::future::Future;
use std::time::Duration;

use ethercrab::{MainDevice, MainDeviceConfig, PduStorage, Timeouts};
use lexibus::sim::FaultyFrames;

use crate::ethercat::{Segment, SubDevice};

/// Runs `work` concurrently with a simulated segment, as [`with_faulty_segment`] does.
pub fn with_segment<F: Future>(
    subdevices: Vec<SubDevice>,
    work: impl FnOnce(&'static MainDevice<'static>) -> F,
) -> F::Output {
    with_faulty_segment(subdevices, FaultyFrames::new(), work)
}

/// Runs `work` concurrently with a simulated segment with faults. Timers of `tokio` measure simulated time. The timeouts
/// of `ethercrab` are long enough for a machine under load.
pub fn with_faulty_segment<F: Future>(
    subdevices: Vec<SubDevice>,
    faults: FaultyFrames,
    work: impl FnOnce(&'static MainDevice<'static>) -> F,
) -> F::Output {
    let storage: &'static PduStorage<8, 1100> = Box::leak(Box::new(PduStorage::new()));
    let (tx, rx, pdu_loop) = storage.try_split().expect("a new storage");
    let long = Duration::from_secs(60);
    let timeouts = Timeouts {
        state_transition: long,
        pdu: long,
        eeprom: long,
        wait_loop_delay: Duration::ZERO,
        mailbox_echo: long,
        mailbox_response: long,
    };
    let config = MainDeviceConfig { dc_static_sync_iterations: 8, ..MainDeviceConfig::default() };
    let maindevice = Box::leak(Box::new(MainDevice::new(pdu_loop, timeouts, config)));
    let runtime = tokio::runtime::Builder::new_current_thread().enable_time().start_paused(true).build();
    runtime.expect("a runtime").block_on(async {
        let mut segment = Segment::new(subdevices).with_faults(faults);
        tokio::select! {
            ended = segment.run(tx, rx) => panic!("the segment ended: {ended:?}"),
            done = work(maindevice) => done,
        }
    })
}

//! Moves an EtherCAT drive, starting in the state "Init". Uses typed objects, a PDO assignment and process data.
//!
//! `cargo run --example ethercat --features std,ethercat,macros`
//!
//! The drive is simulated in this process. One of its mailbox replies is lost, and it doesn't
//! take part in one cycle. For a real segment, replace `Segment::run` with
//! `ethercrab::std::tx_rx_task`.

use std::error::Error;
use std::time::Duration;

use ethercrab::std::ethercat_now;
use ethercrab::{MainDevice, MainDeviceConfig, PduStorage, Timeouts};
use lexibus::clients::ethercat::{is_a, Cycle, CycleError, Sdo};
use lexibus::ethercat::Assignment;
use lexibus::sim::{EtherCatFault, FaultyFrames};
use lexibus::Walker;

#[path = "support/ethercat/mod.rs"]
mod ethercat;

lexibus::dictionary! {
    /// The bindings of the drive.
    pub mod servo = "examples/support/servo.esi.xml" { table: true }
}

use servo::types::{Controlword, State};
use servo::{image, DemoServo};

/// Limits of the segment: number of SubDevices (a power of two), bytes of process data, simultaneous frames, and bytes
/// per frame.
const SUBDEVICES: usize = 16;
const PROCESS_DATA: usize = 64;
const FRAMES: usize = 16;
const FRAME: usize = PduStorage::element_size(1100);

/// Maximum duration of a mailbox exchange.
const TIMEOUT: Duration = Duration::from_millis(500);

static STORAGE: PduStorage<FRAMES, FRAME> = PduStorage::new();

#[tokio::main(flavor = "current_thread")]
async fn main() -> Result<(), Box<dyn Error>> {
    let (tx, rx, pdu_loop) = STORAGE.try_split().map_err(|()| "the storage is in use")?;
    let timeouts = Timeouts { pdu: Duration::from_secs(1), eeprom: Duration::from_secs(1), ..Timeouts::default() };
    let config = MainDeviceConfig { dc_static_sync_iterations: 100, ..MainDeviceConfig::default() };
    let maindevice = MainDevice::new(pdu_loop, timeouts, config);

    let servo = ethercat::SubDevice::new(&servo::DEVICE, ethercat::Servo::new());
    let faults = FaultyFrames::new();
    let mut segment = ethercat::Segment::new(vec![servo]).with_faults(faults.clone());
    tokio::select! {
        ended = segment.run(tx, rx) => Ok(ended?),
        done = drive(&maindevice, &faults) => done,
    }
}

async fn drive(maindevice: &MainDevice<'_>, faults: &FaultyFrames) -> Result<(), Box<dyn Error>> {
    // Go from the state "Init" to "Pre-Operational".
    let group = maindevice.init_single_group::<SUBDEVICES, PROCESS_DATA>(ethercat_now).await?;
    let found = group.iter(maindevice).position(|subdevice| is_a(&subdevice, &servo::IDENTITY));
    let position = found.ok_or("there is no demo servo")?;
    let subdevice = group.subdevice(maindevice, position)?;
    // The timer pauses between two polls of the mailbox.
    let client = Sdo::new(maindevice, &subdevice).with_timer(tokio::time::sleep).with_timeout(TIMEOUT);
    let mut drive = DemoServo::new(client);

    // Access objects through the mailbox.
    let mut buffer = [0; 64];
    println!("{}", drive.device_name().read_into_async(&mut buffer).await?);
    println!("operating time {} ms", drive.operating_time().read_async().await?);
    // The next reply is lost. The client requests the reply again with the repeat bit.
    faults.inject_nth(EtherCatFault::LostReply, 1);
    println!("operating time {} ms, although a reply was lost", drive.operating_time().read_async().await?);
    drive.profile_velocity().write_async(250_000).await?;
    match drive.profile_velocity().write_async(2_000_000).await {
        Ok(()) => return Err("a velocity out of range was sent".into()),
        Err(error) => println!("velocity 2000000: {error}"),
    }

    // Use the default PDO assignment.
    let assignment = Assignment::<8>::by_default(&servo::DEVICE)?;
    drive.client().configure(assignment.startup()).await?;

    // Go to the states "Safe-Operational" and "Operational".
    let group = group.into_op(maindevice).await?;
    let cycle = Cycle::of(maindevice, &group);
    let subdevice = group.subdevice(maindevice, position)?;
    let mut controlword = Controlword::new();
    let mut walker = Walker::new(State::OperationEnabled).with_deadline(Duration::from_secs(10));
    let mut target = 0;
    // The servo doesn't process the frame of the ninth cycle.
    faults.inject_nth(EtherCatFault::WorkingCounter(3), 9);
    for number in 0..16 {
        {
            // Release the lock here, because the cycle also locks the process data.
            let mut outputs = subdevice.outputs_raw_mut();
            let mut outputs = image::OutputsView::new(&mut outputs[..])?;
            outputs.position_mode_mut().set_controlword(controlword);
            outputs.position_mode_mut().set_target_position(target);
        }
        match cycle.run(maindevice, &group).await {
            Ok(()) => {}
            // The inputs are those of the last cycle. A real program stops after several such cycles in succession.
            Err(error @ CycleError::WorkingCounter { .. }) => {
                println!("cycle {number:2}: {error}");
                continue;
            }
            Err(error) => return Err(error.into()),
        }
        let inputs = image::Inputs::unpack(&subdevice.inputs_raw())?.position;
        println!("cycle {number:2}: {:?}, position {}", inputs.statusword.state(), inputs.position_actual_value);
        // The walker resets a fault that is active at the start. It returns an error if a fault occurs later.
        let walked = walker.cycle(inputs.statusword, controlword)?;
        controlword = walked.control;
        if walked.is_reached {
            target += 1000;
        }
    }
    Ok(())
}

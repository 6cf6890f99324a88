//! Accesses a drive on Modbus TCP. A register table describes the drive. Run the example with `cargo run --example
//! modbus --features macros,modbus`.
//!
//! The drive is simulated by a `tokio-modbus` server in this process. It has the registers of
//! `examples/inverter.toml`. One of its replies is late.

use std::time::Duration;

use lexibus::clients::modbus::tokio_modbus::Slave;
use lexibus::clients::modbus::{BlockingLink, ModbusClient};
use lexibus::modbus::{Plan, RegisterClient};
use lexibus::sim::{FaultyStream, StreamFault};
use lexibus::RegisterTable::{Coil, DiscreteInput, Holding, Input};

use inverter::types::{Control, Mode};
use inverter::{objects, Inverter};
use server::{Device, Framing, Map, Server};

lexibus::dictionary! {
    /// A fictitious frequency inverter.
    pub mod inverter = "examples/inverter.toml";
}

#[allow(dead_code)]
#[path = "../tests/support/modbus_server.rs"]
mod server;

// The values of a cycle are consistent only if a single request reads them. This assertion checks the number of
// requests at compile time.
const _: () = {
    let cycle = [
        objects::SPEED.location().modbus,
        objects::CURRENT.location().modbus,
        objects::POSITION.location().modbus,
        objects::TEMPERATURE.location().modbus,
    ];
    assert!(matches!(Plan::new(cycle, &inverter::MODBUS), Ok(plan) if plan.len() == 1));
};

const TIMEOUT: Duration = Duration::from_millis(500);
/// Number of the reply that is late.
const LATE: u64 = 7;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let device = Device::new(simulated());
    let server = Server::start_with(&device, Framing::Tcp, |stream| {
        let mut stream = FaultyStream::new(stream);
        stream.inject_nth(StreamFault::Late(TIMEOUT * 3 / 2), LATE);
        stream
    })?;

    // Code for a real drive starts here. `MODBUS` contains the limits of the drive's requests. The link discards late
    // replies.
    let link = BlockingLink::tcp(server.address(), Slave(1), TIMEOUT)?;
    let client = ModbusClient::new(link).with_limits(inverter::MODBUS);
    let mut drive = Inverter::new(client);

    drive.mode().write(Mode::Position)?;
    drive.ramp().write_scaled(2.5)?;
    drive.distance().write_scaled(1250.0)?;
    drive.control().write(Control::new().with_enable(true))?;
    drive.fan().write(true)?;
    if let Err(error) = drive.speed_setpoint().write(3001) {
        println!("3001 rpm: {error}, nothing was sent");
    }
    show("written", &device);

    // The link discards the late reply, so that the next request gets its own reply.
    match drive.distance().read() {
        Err(error) => println!("a reply is late: {error}"),
        Ok(_) => return Err("the reply was in time".into()),
    }
    println!("the next reply: mode {:?}", drive.mode().read()?);
    show("after a late reply", &device);

    // Read four measured values with one request.
    let (speed, current, position, temperature) =
        drive.client().read_block((objects::SPEED, objects::CURRENT, objects::POSITION, objects::TEMPERATURE))?;
    println!("speed {speed} rpm, current {} A", objects::CURRENT.physical(current));
    match objects::TEMPERATURE.physical(temperature) {
        Some(degrees) => println!("position {} mm, {degrees} °C", objects::POSITION.physical(position)),
        None => println!("position {} mm, no temperature sensor", objects::POSITION.physical(position)),
    }
    show("the cycle", &device);

    // Read items in any order with the fewest requests that the drive allows. No request includes the password,
    // although it is between two of the items.
    let (limit, serial, mode, hours, stopped, setpoint) = drive.client().read_block((
        objects::CURRENT_LIMIT,
        objects::SERIAL_NUMBER,
        objects::MODE,
        objects::HOURS,
        objects::EMERGENCY_STOP,
        objects::SPEED_SETPOINT,
    ))?;
    println!("limit {} A, serial number {serial}, mode {mode:?}", objects::CURRENT_LIMIT.physical(limit));
    println!("{hours} h, emergency stop {stopped}, set to {setpoint} rpm");
    show("a survey", &device);

    let mut buffer = [0; 8];
    println!("its name is {:?}", drive.name().read_into(&mut buffer)?);
    if let Err(error) = drive.recipe().write("a long one") {
        println!("the recipe: {error}, nothing was sent");
    }
    show("texts", &device);
    Ok(())
}

/// Returns a simulated drive's registers after power-on.
fn simulated() -> Map {
    let text = |text: &[u8; 8]| [0, 2, 4, 6].map(|at| u16::from_be_bytes([text[at], text[at + 1]]));
    Map::default()
        .with(Holding, 0, &[0, 10, 0, 0, 0, 0x6400, 0x86A0, 1, 0x3401, 0x51D7])
        .with(Holding, 10, &text(b"Pump 7\0\0"))
        .with(Holding, 14, &[0, 125])
        .with(Holding, 19, &[0; 5])
        .with(Input, 0, &[1480, 73, 0xE848, 1, 41])
        .with(Input, 8, &[12_345, 0])
        .with(Coil, 0, &[0])
        .with(Coil, 2, &[0; 8])
        .with(DiscreteInput, 0, &[1, 0])
}

/// Prints the requests that the device received.
fn show(title: &str, device: &Device<Map>) {
    println!("-- {title}:");
    for request in device.requests() {
        println!("   {request}");
    }
}

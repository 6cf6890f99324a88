//! Tests a serial client with a simulated motor on a pseudo-terminal.

use std::io::{Read, Write};
use std::thread;
use std::time::Duration;

use embedded_io_adapters::std::FromStd;
use lexibus::clients::serial::SerialLine;
use lexibus::framing::Framing;
use lexibus::message::{Failure, Writer};
use lexibus::{Error, Parameters};
use lexibus_drives::hsd::messages::{self, CmdNack, Protocol, FRAMING, MAX_DATA};
use lexibus_drives::hsd::{objects, types, HsdMotor};
use serialport::{SerialPort, TTYPort};

use super::motor::Motor;

type Line = SerialLine<FromStd<TTYPort>, lexibus::framing::Delimited, 140>;

/// Simulates a motor that answers requests until the client closes the line. Sends noise before each reply.
fn serve(mut port: TTYPort) {
    let (mut motor, mut decoder, mut data) = (Motor::default(), FRAMING.decoder(), [0; MAX_DATA]);
    let mut byte = [0];
    while let Ok(1) = port.read(&mut byte) {
        let Ok(Some(length)) = FRAMING.decode(&mut decoder, byte[0], &mut data) else { continue };
        let (mut reply, mut frame) = ([0; MAX_DATA], [0; 160]);
        let mut to = Writer::new(&mut reply);
        motor.answer(&data[..length], &mut to).expect("a buffer for the reply");
        if to.is_empty() {
            continue;
        }
        let length = FRAMING.encode(to.written(), &mut frame).expect("a buffer for the frame");
        port.write_all(&[0x55, 0xFF, 0x03]).and_then(|()| port.write_all(&frame[..length])).expect("an open line");
    }
}

/// Starts a simulated motor and returns the client's end of the line.
fn served() -> TTYPort {
    let (near, mut far) = TTYPort::pair().expect("a pseudo-terminal");
    far.set_timeout(Duration::from_secs(5)).expect("a time limit");
    thread::spawn(move || serve(far));
    near
}

fn motor(node: u32) -> HsdMotor<Parameters<Line, Protocol, MAX_DATA>> {
    let timeout = Duration::from_millis(if node == 5 { 5000 } else { 50 });
    let line = SerialLine::with_ready(FromStd::new(served()), messages::FRAMING, Some(is_ready));
    HsdMotor::on(line.with_timeout(timeout), node)
}

fn is_ready(port: &mut FromStd<TTYPort>) -> bool {
    port.inner().bytes_to_read().map_or(true, |count| count > 0)
}

/// The sample code in docs/src/serial.md. The test compares the text of this function with the page.
#[test]
fn the_sample_of_the_documentation() -> Result<(), Box<dyn std::error::Error>> {
    let port = served();
    let line = SerialLine::<_, _, 140>::with_ready(FromStd::new(port), messages::FRAMING, Some(is_ready));
    let mut motor = HsdMotor::on(line, 5); // 5 is the device number; `on` takes no number if requests contain none
    motor.cmd_traj(100_000).send()?; // or `send_async().await?`
    let mut positions = motor.cmd_get_pos().select()?; // selects what later polls return
    while !positions.poll_position().send()?.is_complete() {} // `is_complete` checks the field that `completion` names
    motor.kp_vel().write_scaled(1.5)?; // writes a parameter with the messages of its parameter space
    motor.cmd_chg_par_n(&[objects::KP_VEL.setting(150)?, objects::LOW_SLIM.setting(-5)?]).send()?;

    let (guide, test) = (include_str!("../../docs/src/serial.md"), include_str!("line.rs"));
    let (_, behind) = guide.split_once("let line = SerialLine").ok_or("the sample")?;
    let sample = format!("let line = SerialLine{}", behind.split("\n# ").next().unwrap_or_default());
    assert_eq!(sample.lines().count(), 7);
    for line in sample.lines() {
        assert!(test.contains(&format!("    {line}\n")), "{line}");
    }
    Ok(())
}

#[test]
fn a_positioning() {
    let mut motor = motor(5);
    assert_eq!(motor.cmd_get_sm_stat().send().ok().map(|reply| reply.state), Some(types::State::Stopped));
    let reply = motor.cmd_traj(1_798_046).send().expect("a reply");
    assert!(!reply.is_complete());
    let mut positions = motor.cmd_get_pos().select().expect("a reply");
    assert!(!positions.poll_position().send().expect("a reply").is_complete());
    let last = positions.poll_position().send().expect("a reply");
    assert_eq!((last.is_complete(), last.real_position), (true, 1_798_046));
    let mut speeds = motor.cmd_get_vel().select().expect("a reply");
    let reply = speeds.poll_speeds().send().expect("a reply");
    assert_eq!((reply.real_speed, reply.theoretical_speed), (4267, 2497));
}

#[test]
fn parameters_one_by_one_and_together() {
    let mut motor = motor(5);
    motor.kp_vel().write_scaled(1.5).expect("written");
    assert_eq!(motor.kp_vel().read().ok(), Some(150));
    let settings = [objects::KP_VEL.setting(600).expect("in range"), objects::LOW_SLIM.setting(-5).expect("in range")];
    motor.cmd_chg_par_n(&settings).send().expect("a reply");
    assert_eq!((motor.kp_vel().read().ok(), motor.low_slim().read().ok()), (Some(600), Some(-5)));
}

#[test]
fn refusals_and_silence() {
    let mut refusing = motor(5);
    assert!(matches!(refusing.cmd_reg().send(), Err(Failure::Refused(CmdNack { node: 5, .. }))));
    // No motor on the line has this device number.
    let reply = motor(6).cmd_get_ver().send().map(|reply| reply.version);
    assert!(matches!(reply, Err(Failure::Error(Error::Timeout))), "{reply:?}");
}

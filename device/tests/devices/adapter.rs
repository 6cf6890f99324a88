//! Commands to a CAN adapter on a pseudo-terminal, and adapters that refuse them.

use std::time::Duration;

use crate::pty::Pty;
use lexibus::clients::canopen::CanPort;
use lexibus_device::{AnyPort, BusAddress, Failure};

/// Reply of an adapter that refused a command.
const BELL: &str = "\x07";

/// Opens an adapter that answers each command with the text that `reply` returns.
fn open(bit_rate: Option<u16>, reply: fn(&str) -> &'static str) -> Result<AnyPort, Failure> {
    let mut pty = Pty::open();
    let path = pty.path().to_owned();
    std::thread::spawn(move || {
        let (mut command, mut buffer) = (String::new(), [0; 64]);
        loop {
            let count = pty.read(&mut buffer, Duration::from_secs(10)).unwrap_or(0);
            for byte in &buffer[..count] {
                match byte {
                    b'\r' => {
                        let _ = pty.write(reply(&command).as_bytes(), Duration::from_secs(1));
                        command.clear();
                    }
                    letter => command.push(char::from(*letter)),
                }
            }
        }
    });
    BusAddress::Slcan { path, bit_rate }.open_port()
}

#[track_caller]
fn refused(result: Result<AnyPort, Failure>, expected: &str) {
    let message = result.map(drop).expect_err("a refusal").to_string();
    assert!(message.starts_with("cannot open the CAN adapter") && message.contains(expected), "{message}");
}

#[test]
fn refused_commands_are_reported() {
    let only = |_: &str| "\r";
    assert!(open(Some(500), only).is_ok());
    refused(open(Some(500), |command| if command.starts_with('S') { BELL } else { "\r" }), "refuses the bit rate");
    refused(open(Some(500), |command| if command == "O" { BELL } else { "\r" }), "refuses to open the channel");
    refused(open(Some(33), only), "33 kbit/s");
}

#[test]
fn an_adapter_can_refuse_to_close_or_send_no_replies() {
    assert!(open(Some(500), |command| if matches!(command, "" | "C") { BELL } else { "\r" }).is_ok());
    assert!(open(Some(500), |_| "").is_ok());
    assert!(open(None, |_| "").is_ok());
}

#[test]
fn frames_that_follow_the_reply_are_received() {
    let mut port = open(None, |command| if command == "O" { "\rt70517F\r" } else { "\r" }).expect("an adapter");
    let frame = port.receive(Duration::from_secs(1), &mut |_| true).expect("no error").expect("a frame");
    assert_eq!((frame.id(), frame.data()), (0x705, &[0x7F][..]));
}

//! Simulated devices behind a CAN adapter on a pseudo-terminal, and behind Modbus TCP.
#![allow(dead_code)]

#[path = "../../../tests/interop/pty.rs"]
mod pty;

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::time::{Duration, Instant};

use lexibus::clients::canopen::CanPort;
use lexibus::sim::{CanBus, CanNode, Device};
use lexibus::{NodeId, RegisterTable};
use lexibus_device::slcan::{line, Decoder};
use lexibus_drives::{demo_drive, vector_step};
use pty::Pty;

/// Node-ID of the simulated drive.
pub const NODE: u8 = 5;

/// Starts a CAN bus with a simulated drive. Returns the path of the adapter. The adapter waits for `delay` before it forwards
/// a frame to the bus.
pub fn adapter(delay: Duration) -> String {
    let (sender, receiver) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        let pty = Pty::open();
        let _ = sender.send(pty.path().to_owned());
        serve_can(pty, delay)
    });
    receiver.recv().expect("a path")
}

fn drive() -> Device {
    let id = NodeId::new(NODE).expect("a node-ID");
    let mut device = Device::new(demo_drive::ENTRIES).with_node_id(id).with_cia402();
    device.set_initial(demo_drive::objects::PRODUCER_HEARTBEAT_TIME, 100).expect("an object");
    device.power_cycle();
    device
}

/// Exchanges frames between the bus and the adapter in real time.
fn serve_can(mut pty: Pty, delay: Duration) -> ! {
    let mut bus = CanBus::new();
    bus.add(CanNode::new(drive()));
    let (mut decoder, mut buffer, mut command) = (Decoder::default(), [0; 1024], Vec::new());
    let mut last = Instant::now();
    loop {
        let count = pty.read(&mut buffer, Duration::from_millis(1)).unwrap_or(0);
        decoder.push(&buffer[..count]);
        for byte in &buffer[..count] {
            command.push(*byte);
            if *byte == b'\r' {
                let _ = pty.write(reply(&command), Duration::from_millis(100));
                command.clear();
            }
        }
        bus.advance(last.elapsed());
        last = Instant::now();
        while let Some(frame) = decoder.next_frame() {
            std::thread::sleep(delay);
            let _ = bus.send(&frame, Duration::ZERO);
        }
        while let Ok(Some(frame)) = bus.receive(Duration::ZERO, &mut |_| true) {
            let _ = pty.write(line(&frame).as_bytes(), Duration::from_millis(100));
        }
    }
}

/// Returns the reply of the adapter to a command line. The adapter rejects the command to close the channel, like an
/// adapter whose channel is already closed.
fn reply(line: &[u8]) -> &'static [u8] {
    match line {
        b"\r" | b"C\r" => b"\x07",
        [b't' | b'r', ..] => b"z\r",
        [b'T' | b'R', ..] => b"Z\r",
        _ => b"\r",
    }
}

/// Starts a Modbus TCP server with a simulated drive. Returns its port.
pub fn modbus_server() -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("an address").port();
    std::thread::spawn(move || {
        let mut device = Device::new(vector_step::ENTRIES);
        for stream in listener.incoming().flatten() {
            let _ = serve_modbus(stream, &mut device);
        }
    });
    port
}

/// Answers the requests of one connection (MODBUS Messaging on TCP/IP V1.0b).
fn serve_modbus(mut stream: TcpStream, device: &mut Device) -> std::io::Result<()> {
    loop {
        let mut header = [0; 7];
        stream.read_exact(&mut header)?;
        let length = usize::from(u16::from_be_bytes([header[4], header[5]]));
        let mut request = vec![0; length.saturating_sub(1)];
        stream.read_exact(&mut request)?;
        let reply = answer(&request, device);
        let mut frame = header.to_vec();
        frame[4..6].copy_from_slice(&(reply.len() as u16 + 1).to_be_bytes());
        frame.extend(reply);
        stream.write_all(&frame)?;
    }
}

/// Returns the reply to a request for the device identification (function 43) that begins with the object `first`. The
/// reply for object 0 contains the vendor name, and the next reply contains the product code.
fn identification(first: u8) -> Vec<u8> {
    let (value, more) = if first == 0 { (&b"AEC SRL"[..], 0xFF) } else { (&b"SMD1204"[..], 0) };
    [&[0x2B, 0x0E, 0x01, 0x01, more, 1, 1, first, value.len() as u8], value].concat()
}

/// Returns the reply to a request. Supports the function codes 3, 4, 6, 16 and 43, and rejects all others.
fn answer(request: &[u8], device: &mut Device) -> Vec<u8> {
    let number = |at: usize| u16::from_be_bytes([request[at], request[at + 1]]);
    let function = request[0];
    if function == 0x2B {
        return identification(request[3]);
    }
    let table = if function == 4 { RegisterTable::Input } else { RegisterTable::Holding };
    let result = match function {
        3 | 4 => device.read_words(table, number(1), number(3)).map(|words| {
            let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_be_bytes()).collect();
            [&[function, bytes.len() as u8], bytes.as_slice()].concat()
        }),
        6 => device.write_words(table, number(1), &[number(3)]).map(|()| request.to_vec()),
        16 => {
            let words = request[6..].chunks(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]]));
            device.write_words(table, number(1), &words.collect::<Vec<_>>()).map(|()| request[..5].to_vec())
        }
        _ => Err(lexibus::sim::Exception::IllegalFunction),
    };
    result.unwrap_or_else(|exception| vec![function | 0x80, exception.code()])
}

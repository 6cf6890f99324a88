//! Tests the bindings of the HSD motors: encoding and decoding all packets, damaged packets, the manual's examples, and
//! a simulated motor on a pseudo-terminal.

#![cfg(unix)]

#[path = "hsd/examples.rs"]
mod examples;
#[path = "hsd/line.rs"]
mod line;
#[path = "hsd/models.rs"]
mod models;
#[path = "hsd/motor.rs"]
mod motor;
#[path = "hsd/packets.rs"]
mod packets;
#[path = "hsd/states.rs"]
mod states;

use lexibus::framing::{FrameError, Framing};
use lexibus_drives::hsd::messages::FRAMING;

/// Returns the frame that contains a message.
fn framed(data: &[u8]) -> Vec<u8> {
    let mut frame = [0; 160];
    let length = FRAMING.encode(data, &mut frame).expect("a message of the protocol");
    frame[..length].to_vec()
}

/// Decodes a stream byte by byte. Returns the frames and errors.
fn found(stream: &[u8]) -> Vec<Result<Vec<u8>, FrameError>> {
    found_in_pieces(&[stream])
}

/// Decodes a stream that arrives in pieces. Only the decoder and its data are kept between the pieces.
fn found_in_pieces(pieces: &[&[u8]]) -> Vec<Result<Vec<u8>, FrameError>> {
    let (mut decoder, mut data, mut all) = (FRAMING.decoder(), [0; 80], Vec::new());
    for byte in pieces.iter().copied().flatten() {
        let frame = FRAMING.decode(&mut decoder, *byte, &mut data);
        all.extend(frame.transpose().map(|frame| frame.map(|length| data[..length].to_vec())));
    }
    all
}

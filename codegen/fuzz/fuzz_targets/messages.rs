//! Any bytes, as a stream of frames, and as a request and its reply: whatever is read is written as the same bytes.
#![no_main]

use lexibus::framing::Framing;
use lexibus::message::{Message, Reader, Reply, Request, Writer};
use lexibus_drives::hsd::messages::*;

/// Writes what `write` does and gives the bytes.
fn written(write: impl FnOnce(&mut Writer<'_>) -> Result<(), lexibus::message::WriteError>) -> Vec<u8> {
    let mut data = [0; 2 * MAX_DATA];
    let mut to = Writer::new(&mut data);
    write(&mut to).expect("what was read can be written");
    to.written().to_vec()
}

/// A request that is read is the one that is written, and so is a reply.
fn request<'r, M: Request<'r>>(data: &'r [u8], answer: &'r [u8]) {
    let mut from = Reader::new(data);
    if let Some((node, request)) = M::parse(&mut from) {
        assert_eq!(written(|to| request.write(node, to)), data, "{}", M::NAME);
    }
    if let Some(reply) = M::Reply::read(data, &mut Reader::new(answer)) {
        assert_eq!(written(|to| reply.write(data, to)), answer, "the reply to {}", M::NAME);
    }
    let _ = M::Refusal::read(data, &mut Reader::new(answer));
}

/// Each frame of a stream has data that make the same frame.
fn frames(stream: &[u8]) {
    let (mut decoder, mut data) = (FRAMING.decoder(), [0; MAX_DATA]);
    for &byte in stream {
        let Ok(Some(length)) = FRAMING.decode(&mut decoder, byte, &mut data) else { continue };
        let mut frame = [0; 2 * MAX_DATA + 8];
        let taken = FRAMING.encode(&data[..length], &mut frame).expect("data of a frame");
        let (mut again, mut same) = (FRAMING.decoder(), [0; MAX_DATA]);
        let found: Vec<_> = frame[..taken].iter().map(|&byte| FRAMING.decode(&mut again, byte, &mut same)).collect();
        assert_eq!(found.last(), Some(&Ok(Some(length))));
        assert_eq!(same[..length], data[..length]);
    }
}

macro_rules! requests {
    ($data:ident $answer:ident $($name:ident)*) => { $(request::<$name>($data, $answer);)* };
}

libfuzzer_sys::fuzz_target!(|bytes: (Vec<u8>, Vec<u8>)| {
    let (data, answer) = (&bytes.0[..], &bytes.1[..]);
    frames(data);
    let _ = lexibus_drives::hsd::messages::Request::parse(data);
    requests!(data answer
        CmdReset CmdNoReg CmdReg CmdHold CmdMazz CmdAzz CmdJogN CmdTraj CmdTrajVel PollPosition PollTheoreticalPosition
        PollSpeeds PollTorques CmdEmerg CmdSetOverr CmdGetOverr CmdChgParN CmdGetParN CmdSaveParFl CmdAdcOff CmdAzzEl
        CmdGetStatAzz CmdGetDistMicroZero CmdGetPos CmdGetPosT CmdGetVel CmdGetTor CmdGetAlarm CmdGetVer CmdGetType
        CmdGetSmStat CmdSampleVar CmdSampleMem CmdGetSamp CmdRegWait CmdHoldWait CmdJog CmdChgPar CmdAzzElWait CmdSample
    );
});

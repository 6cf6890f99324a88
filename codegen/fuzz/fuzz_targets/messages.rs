//! Any bytes, as a stream of frames, and as a request and its reply: whatever is read is written as the same bytes.
#![no_main]

use lexibus::framing::Framing;
use lexibus::message::{Message, Reader, Reply, Request, WriteError, Writer};
use lexibus_drives::hsd::messages::*;

/// What `write` writes is what was read, up to `known` bytes. A setting whose length isn't that of its parameter, and a value beyond
/// its limits, are read, for whoever looks for what is wrong on a line, and not written.
fn same(name: &str, data: &[u8], known: usize, write: impl FnOnce(&mut Writer<'_>) -> Result<(), WriteError>) {
    let mut again = [0; 2 * MAX_DATA];
    let mut to = Writer::new(&mut again);
    match write(&mut to) {
        Err(WriteError::Length(_)) if name.contains("Par") => {}
        Err(WriteError::OutOfRange(_)) => {}
        Err(error) => panic!("{name} was read, and isn't written: {error}"),
        Ok(()) => {
            assert_eq!(to.written().len(), data.len(), "{name}");
            // Zeros that stand for a value are written as such, and read whatever they are.
            let known = if name == CmdGetParN::NAME { known.min(6) } else { known };
            assert_eq!(to.written()[..known], data[..known], "{name}");
        }
    }
}

/// A request that is read is the one that is written, and so is a reply to it.
fn request<'r, M: Request<'r>>(data: &'r [u8], answer: &'r [u8]) {
    let _ = M::Refusal::read(data, &mut Reader::new(answer));
    let reply = M::Reply::read(data, &mut Reader::new(answer));
    let Some((node, request)) = M::parse(&mut Reader::new(data)) else { return };
    same(M::NAME, data, data.len(), |to| request.write(node, to));
    if let Some(reply) = reply {
        // A reply may have the request's bytes once more, and anything in place of those that a short request lacks.
        same(M::NAME, answer, data.len().min(answer.len()), |to| reply.write(data, to));
    }
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
    request::<lexibus_drives::akd::messages::Sdo>(data, answer);
    requests!(data answer
        CmdReset CmdNoReg CmdReg CmdHold CmdMazz CmdAzz CmdJogN CmdTraj CmdTrajVel PollPosition PollTheoreticalPosition
        PollSpeeds PollTorques CmdEmerg CmdSetOverr CmdGetOverr CmdChgParN CmdGetParN CmdSaveParFl CmdAdcOff CmdAzzEl
        CmdGetStatAzz CmdGetDistMicroZero CmdGetPos CmdGetPosT CmdGetVel CmdGetTor CmdGetAlarm CmdGetVer CmdGetType
        CmdGetSmStat CmdSampleVar CmdSampleMem CmdGetSamp CmdRegWait CmdHoldWait CmdJog CmdChgPar CmdAzzElWait CmdSample
    );
});

//! Decodes arbitrary bytes as a stream of HSD frames, and as each request of the HSD motors and the AKD with its reply.
//! Encoding the decoded data must give the same bytes.
#![no_main]

use lexibus::framing::Framing;
use lexibus::message::{Message, Reader, Reply, Request, WriteError, Writer};
use lexibus_drives::hsd::messages::*;

/// Checks that `write` writes as many bytes as `data` has, and that the first `known` bytes are the same. `write` may
/// fail for parameters with a wrong length and for values outside of their limits. Such data can be decoded for bus
/// diagnosis, but the writer rejects them.
fn same(name: &str, data: &[u8], known: usize, write: impl FnOnce(&mut Writer<'_>) -> Result<(), WriteError>) {
    let mut again = [0; 2 * MAX_DATA];
    let mut to = Writer::new(&mut again);
    match write(&mut to) {
        Err(WriteError::Length(_)) if name.contains("Par") => {}
        Err(WriteError::OutOfRange(_)) => {}
        Err(error) => panic!("{name} was read but cannot be written: {error}"),
        Ok(()) => {
            assert_eq!(to.written().len(), data.len(), "{name}");
            // A `CmdGetParN` request has zero bytes in place of the value, after the first 6 bytes. The reader accepts any
            // bytes there, but the writer writes zeros.
            let known = if name == CmdGetParN::NAME { known.min(6) } else { known };
            assert_eq!(to.written()[..known], data[..known], "{name}");
        }
    }
}

/// Decodes a request and the reply to it, and checks that encoding both gives the original bytes again.
fn request<'r, M: Request<'r>>(data: &'r [u8], answer: &'r [u8]) {
    let _ = M::Refusal::read(data, &mut Reader::new(answer));
    let reply = M::Reply::read(data, &mut Reader::new(answer));
    let Some((node, request)) = M::parse(&mut Reader::new(data)) else { return };
    same(M::NAME, data, data.len(), |to| request.write(node, to));
    if let Some(reply) = reply {
        // A reply can repeat bytes of the request. If the request is too short, these bytes can have any value.
        same(M::NAME, answer, data.len().min(answer.len()), |to| reply.write(data, to));
    }
}

/// Encodes the data of each decoded frame, and checks that decoding the result gives the same data.
fn frames(stream: &[u8]) {
    let (mut decoder, mut data) = (FRAMING.decoder(), [0; MAX_DATA]);
    for &byte in stream {
        let Ok(Some(length)) = FRAMING.decode(&mut decoder, byte, &mut data) else { continue };
        let mut frame = [0; 2 * MAX_DATA + 8];
        let encoded = FRAMING.encode(&data[..length], &mut frame).expect("data of a frame");
        let (mut again, mut same) = (FRAMING.decoder(), [0; MAX_DATA]);
        let found: Vec<_> = frame[..encoded].iter().map(|&byte| FRAMING.decode(&mut again, byte, &mut same)).collect();
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

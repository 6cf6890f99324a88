//! Sends messages to a drive on a serial line and accesses its parameters as items.
//!
//!     cargo run --example serial --features std,serial
//!
//! The drive is simulated by a thread at the other end of a pseudo-terminal. One of its replies is late. For a real
//! drive, use the port
//! `serialport::new("/dev/ttyUSB0", 115_200).timeout(…).open_native()`.

#[cfg(unix)]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    unix::main()
}

#[cfg(not(unix))]
fn main() {
    println!("this system has no pseudo-terminals");
}

#[cfg(unix)]
mod unix {
    use std::collections::BTreeMap;
    use std::error;
    use std::io::{Read, Write};
    use std::thread;
    use std::time::Duration;

    use embedded_io_adapters::std::FromStd;
    use lexibus::clients::serial::{SerialError, SerialLine};
    use lexibus::framing::{Check, Delimited, Framing};
    use lexibus::message::WriteError;
    use lexibus::sim::{FaultyStream, StreamFault};
    use lexibus::{
        AbortCode, AccessError, Error, Exchange, Flags, Initial, Item, LengthError, OnSerial, Parameter,
        ParameterMessages, Parameters, Range, Rw,
    };
    use serialport::{SerialPort, TTYPort};

    /// A frame consists of STX, data, checksum and ETX. STX, ETX and ESC bytes in the data are replaced with ESC and
    /// their complement.
    const FRAMING: Delimited = Delimited::new(Some(0x02), 0x03)
        .with_escape(0x1B, 0xFF, &[0x02, 0x03, 0x1B])
        .with_check(Check::Xor(0xFF))
        .with_max_data(MAX_DATA);
    const MAX_DATA: usize = 16;

    const TIMEOUT: Duration = Duration::from_millis(500);
    /// Number of the reply that is late.
    const LATE: u64 = 6;

    const NODE: u8 = 1;
    /// Order codes for reading a parameter, changing a parameter, querying the state, and refusing a request.
    const READ: u8 = 0x10;
    const CHANGE: u8 = 0x11;
    const STATE: u8 = 0x12;
    const REFUSED: u8 = 0x7F;

    const GAIN: Item<i16, Rw, OnSerial> =
        Item::new(OnSerial::serial(0x0105), "Gain", Range::Between(0, 1000), Initial::Value(150), "", Flags::NONE);
    const POSITION: Item<i32, Rw, OnSerial> =
        Item::new(OnSerial::serial(0x010C), "Position", Range::Full, Initial::Unknown, "counts", Flags::NONE);
    const MISSING: Item<i16, Rw, OnSerial> =
        Item::new(OnSerial::serial(0x0999), "Missing", Range::Full, Initial::Unknown, "", Flags::NONE);

    pub fn main() -> Result<(), Box<dyn error::Error>> {
        let (mut near, mut far) = TTYPort::pair()?;
        near.set_timeout(TIMEOUT)?;
        far.set_timeout(Duration::from_secs(5))?;
        let mut far = FaultyStream::new(far);
        far.inject_nth(StreamFault::Late(TIMEOUT * 3 / 2), LATE);
        let drive = thread::spawn(move || Drive::default().serve(&mut far));
        talk(near)?;
        Ok(drive.join().map_err(|_| "the drive panicked")??)
    }

    fn talk(port: TTYPort) -> Result<(), Box<dyn error::Error>> {
        // The line discards bytes that arrive before a request.
        let is_ready = |port: &mut FromStd<TTYPort>| port.inner().bytes_to_read().map_or(true, |count| count > 0);
        // The buffer of the line has space for start, end, and twice the bytes of data and checksum.
        let line: SerialLine<_, _, { 2 * (MAX_DATA + 1) + 2 }> =
            SerialLine::with_ready(FromStd::new(port), FRAMING, Some(is_ready));
        let mut line = line.with_timeout(TIMEOUT);
        let mut reply = [0; MAX_DATA];
        let length = line.exchange(&[NODE, STATE], &mut reply)?;
        println!("state: {:02x?}", &reply[..length]);

        let mut drive = Parameters::<_, _, MAX_DATA>::new(line, Messages);
        GAIN.at(&mut drive).write(300)?;
        POSITION.at(&mut drive).write(0x0203_1B00)?;
        println!("gain {}, position {:#010x}", GAIN.at(&mut drive).read()?, POSITION.at(&mut drive).read()?);
        // Each read returns its reply, and never the late one.
        let late: Option<AccessError<SerialError<_>>> = GAIN.at(&mut drive).read().err();
        println!("a reply is late: {}", late.ok_or("it was in time")?);
        println!("the next reply: position {:#010x}", POSITION.at(&mut drive).read()?);
        println!("gain 1001: {}", GAIN.at(&mut drive).write(1001).err().ok_or("it is out of range")?);
        let refused: Option<AccessError<SerialError<_>>> = MISSING.at(&mut drive).read().err();
        println!("parameter 0x0999: {}", refused.ok_or("it doesn't exist")?);
        Ok(())
    }

    /// The message protocol: node, order code, parameter number and value, all big-endian. A reply starts with the same
    /// bytes as its request, or has a different order code.
    struct Messages;

    fn head(order: u8, parameter: Parameter) -> [u8; 4] {
        let [.., high, low] = parameter.0.to_be_bytes();
        [NODE, order, high, low]
    }

    fn request(head: [u8; 4], value: &[u8], to: &mut [u8]) -> Result<usize, LengthError> {
        let length = head.len() + value.len();
        let error = LengthError::new(length, to.len());
        let to = to.get_mut(..length).ok_or(error)?;
        let bytes = head.iter().chain(value.iter().rev());
        to.iter_mut().zip(bytes).for_each(|(to, from)| *to = *from);
        Ok(length)
    }

    fn value<E>(head: [u8; 4], reply: &[u8]) -> Result<&[u8], Error<E>> {
        match reply.strip_prefix(&head) {
            Some(value) => Ok(value),
            None if reply.get(1) == Some(&REFUSED) => Err(Error::Abort(AbortCode::NO_OBJECT)),
            None => Err(Error::UnexpectedReply),
        }
    }

    impl ParameterMessages for Messages {
        fn read_request(&self, parameter: Parameter, _: usize, to: &mut [u8]) -> Result<usize, WriteError> {
            Ok(request(head(READ, parameter), &[], to)?)
        }

        fn read_reply<E>(
            &self,
            parameter: Parameter,
            _: &[u8],
            reply: &[u8],
            to: &mut [u8],
        ) -> Result<usize, Error<E>> {
            let bytes = value(head(READ, parameter), reply)?;
            to.iter_mut().zip(bytes.iter().rev()).for_each(|(to, from)| *to = *from);
            Ok(bytes.len())
        }

        fn write_request(&self, parameter: Parameter, value: &[u8], to: &mut [u8]) -> Result<usize, WriteError> {
            Ok(request(head(CHANGE, parameter), value, to)?)
        }

        fn write_reply<E>(&self, parameter: Parameter, _: &[u8], reply: &[u8]) -> Result<(), Error<E>> {
            value(head(CHANGE, parameter), reply).map(drop)
        }
    }

    /// A simulated drive that stores its parameters.
    #[derive(Default)]
    struct Drive(BTreeMap<[u8; 2], Vec<u8>>);

    impl Drive {
        /// Answers requests until the line is closed.
        fn serve(&mut self, port: &mut FaultyStream<TTYPort>) -> Result<(), std::io::Error> {
            let (mut decoder, mut data, mut frame) = (FRAMING.decoder(), [0; MAX_DATA], [0; 64]);
            let mut byte = [0];
            // After the client has closed the line, the pseudo-terminal returns an error or the end of the stream.
            while let Ok(1) = port.read(&mut byte) {
                let Ok(Some(length)) = FRAMING.decode(&mut decoder, byte[0], &mut data) else { continue };
                let reply = self.reply(&data[..length]);
                let length = FRAMING.encode(&reply, &mut frame).map_err(std::io::Error::other)?;
                port.write_all(&frame[..length])?;
            }
            Ok(())
        }

        fn reply(&mut self, request: &[u8]) -> Vec<u8> {
            match *request {
                [node, STATE] => vec![node, STATE, 0x02],
                [node, CHANGE, high, low, ref value @ ..] => {
                    self.0.insert([high, low], value.to_vec());
                    vec![node, CHANGE, high, low]
                }
                [node, READ, high, low] => match self.0.get(&[high, low]) {
                    Some(value) => [&[node, READ, high, low], &value[..]].concat(),
                    None => vec![node, REFUSED, high, low],
                },
                _ => vec![NODE, REFUSED],
            }
        }
    }
}

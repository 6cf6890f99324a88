use core::fmt::Debug;

use lexibus::message::{Message, Reader, Reply, Request, Setting, SettingsRule, WriteError, Writer};
use lexibus::profinet::NotAllowed;
use lexibus::{LengthError, Parameter};

/// Random bits, the same in each run (xorshift).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// Up to three of something, for as long as the program runs.
    fn several<T>(&mut self, one: impl Fn(&mut Self) -> T) -> &'static [T] {
        (0..self.next() & 3).map(|_| one(self)).collect::<Vec<_>>().leak()
    }

    /// Up to three parameters that the rule has, with values, for as long as the program runs.
    fn settings(&mut self, rule: SettingsRule) -> &'static [Setting] {
        self.several(|own| {
            let (first, last, length) = rule.lengths[own.next() as usize % rule.lengths.len()];
            let mut value = [0; 8];
            own.fill(&mut value);
            let parameter = Parameter(first + own.next() as u32 % (last - first + 1));
            Setting::new(parameter, value, length.into())
        })
    }

    fn fill(&mut self, bytes: &mut [u8]) {
        bytes.iter_mut().for_each(|byte| *byte = (self.next() >> 32) as u8);
    }

    /// A number of any size, as often small as large, and as often negative.
    fn number(&mut self) -> i64 {
        let (number, shift) = (self.next() as i64, self.next() & 63);
        number >> shift
    }

    /// A parameter with a value of one to eight bytes; of a reply, as often as not one that the request names.
    fn setting(&mut self, request: &[u8]) -> Setting {
        let named =
            request.windows(2).nth(self.next() as usize % 8).map(|two| i64::from(two[0]) << 8 | i64::from(two[1]));
        let number = named.unwrap_or_else(|| self.number());
        let (parameter, mut value) = (Parameter(number as u32), [0; 8]);
        self.fill(&mut value);
        Setting::of(parameter, &value[..1 << (self.next() & 3)]).expect("eight bytes at most")
    }
}

const SEED: u64 = 0x9E37_79B9_7F4A_7C15;

/// Bytes of data, and what the fields that they are read as look like.
type Packed = (Vec<u8>, String);

/// Checks a PDO or a process image.
macro_rules! process_data {
    ($file:expr, $path:expr, $name:ty) => {{
        let unpack = |data: &[u8]| <$name>::unpack(data).map(|own| (own.pack().to_vec(), format!("{own:?}")));
        process_data($file, $path, &unpack, <$name>::LEN);
    }};
}

/// Bits that a layout has are the same after unpacking and packing; bits that it hasn't are 0. Too few bytes are an error.
fn process_data(file: &str, path: &str, unpack: &dyn Fn(&[u8]) -> Result<Packed, LengthError>, len: usize) {
    let unpacked = |data: &[u8]| unpack(data).unwrap_or_else(|error| panic!("{file}: {path}: {error:?}"));
    let mut random = Random(SEED);
    let mut data = vec![0xFF; len];
    let covered = unpacked(&data).0;
    for round in 0..24 {
        match round {
            0 => data.fill(0),
            1 => data.fill(0xFF),
            2 => data.fill(0x80),
            3 => data.fill(0x7F),
            _ => random.fill(&mut data),
        }
        let (packed, fields) = unpacked(&data);
        let expected: Vec<u8> = data.iter().zip(&covered).map(|(data, covered)| data & covered).collect();
        assert!(packed == expected, "{file}: {path}: {data:02X?} is packed as {packed:02X?}, not {expected:02X?}");
        let again = unpacked(&packed);
        assert!(again == (packed, fields), "{file}: {path}: {data:02X?} is {again:?} the second time");
    }
    if len > 0 {
        assert!(unpack(&data[1..]).is_err(), "{file}: {path}: unpacks {} of {len} bytes", len - 1);
    }
}

/// Checks a record.
macro_rules! record {
    ($file:expr, $path:expr, $name:ty) => {{
        let decode = |data: &[u8]| {
            let own = <$name>::decode(data).unwrap_or_else(|error| panic!("{}: {}: {error:?}", $file, $path));
            own.encode().map(|bytes| (bytes.to_vec(), format!("{own:?}")))
        };
        let default = <$name>::DEFAULT.encode().map(|bytes| bytes.to_vec());
        record($file, $path, default.unwrap_or(vec![0; <$name>::LEN]), &decode);
    }};
}

/// A record that may be written is read as what was written. From its default on, bit by bit, through all values that are
/// allowed.
fn record(file: &str, path: &str, mut data: Vec<u8>, decode: &dyn Fn(&[u8]) -> Result<Packed, NotAllowed>) {
    let mut random = Random(SEED);
    for _ in 0..data.len().min(64) * 4 {
        let (mut next, at) = (data.clone(), random.next() as usize % data.len());
        next[at] ^= if random.next() & 1 == 0 { 1 << (random.next() & 7) } else { random.next() as u8 };
        let Ok((encoded, fields)) = decode(&next) else { continue };
        let again = decode(&encoded).unwrap_or_else(|error| panic!("{file}: {path}: {error:?}"));
        assert!(again == (encoded, fields), "{file}: {path}: {next:02X?} is {again:?} the second time");
        data = again.0;
    }
}

/// More data than any message has.
const MAX_DATA: usize = 512;

fn written(write: impl FnOnce(&mut Writer<'_>) -> Result<(), WriteError>) -> Result<Vec<u8>, WriteError> {
    let mut data = [0; MAX_DATA];
    let mut to = Writer::new(&mut data);
    write(&mut to)?;
    Ok(to.written().to_vec())
}

/// Requests and replies that can be written are read as they were. `request` gives the data of one, `reply` checks one to
/// these; none where a random value can't be sent.
fn message(file: &str, path: &str, request: fn(&mut Random) -> Option<Vec<u8>>, reply: fn(&mut Random, &[u8]) -> bool) {
    let mut random = Random(SEED);
    let (mut requests, mut replies) = (0, 0);
    for _ in 0..1_000_000 {
        let Some(data) = request(&mut random) else { continue };
        requests += 1;
        replies += usize::from(reply(&mut random, &data));
        if requests >= 32 && replies >= 32 {
            return;
        }
    }
    panic!("{file}: {path}: {requests} requests, {replies} replies");
}

/// Whether two values are equal, or look so: as numbers that aren't any do.
fn is_same<T: PartialEq + Debug>(one: &T, other: &T) -> bool {
    one == other || format!("{one:?}") == format!("{other:?}")
}

/// The data of a request, which are read as it.
macro_rules! sent {
    ($random:ident, $message:ty, $none:ident, $value:expr) => {{
        #[allow(unused)]
        let $none: &[u8] = &[];
        let (request, node) = ($value, u32::from($random.number() as u8));
        written(|to| request.write(node, to)).ok().inspect(|data| {
            let read = <$message>::parse(&mut Reader::new(data));
            // A protocol without numbers of devices reads 0.
            let node = if matches!(read, Some((0, _))) { 0 } else { node };
            assert!(is_same(&read, &Some((node, request))), "{data:02X?} is read as {read:?}");
        })
    }};
}

/// Data that are read as a request, which is written as they are.
macro_rules! overheard {
    ($random:ident, $message:ty, $constant:expr) => {{
        let data = likely($random, &[], $constant);
        <$message>::parse(&mut Reader::new(&data)).map(|(node, request)| {
            let own = written(|to| request.write(node, to));
            assert!(own.as_deref() == Ok(&data), "{data:02X?} is written as {own:02X?}");
            data.clone()
        })
    }};
}

/// The data of a reply are read as it.
macro_rules! answered {
    ($random:ident, $message:ty, $request:ident, $value:expr) => {{
        let reply = $value;
        let data = written(|to| reply.write($request, to));
        if let Ok(data) = &data {
            let read = <$message as Message>::Reply::read($request, &mut Reader::new(data));
            assert!(is_same(&read, &Some(reply)), "{:02X?}, {data:02X?} is read as {read:?}", $request);
        }
        data.is_ok()
    }};
}

/// Data that are read as a reply, which is written as they are.
macro_rules! overheard_reply {
    ($random:ident, $message:ty, $request:ident, $constant:expr) => {{
        let data = likely($random, $request, $constant);
        let read = <$message as Message>::Reply::read($request, &mut Reader::new(&data));
        if let Some(reply) = &read {
            let own = written(|to| reply.write($request, to));
            assert!(own.as_deref() == Ok(&data), "{:02X?}: {data:02X?} is written as {own:02X?}", $request);
        }
        read.is_some()
    }};
}

/// Random data of up to 48 bytes that begin as `from` does and have `constant` near their start.
fn likely(random: &mut Random, from: &[u8], constant: &[u8]) -> Vec<u8> {
    let mut data = vec![0; random.next() as usize % 49];
    random.fill(&mut data);
    if random.next() & 1 == 0 {
        data.iter_mut().take(4).for_each(|byte| *byte &= 15);
    }
    let copied = (random.next() as usize % 3).min(from.len()).min(data.len());
    data[..copied].copy_from_slice(&from[..copied]);
    let at = random.next() as usize % 4;
    if let Some(part) = data.get_mut(at..at + constant.len()) {
        part.copy_from_slice(constant);
    }
    data
}

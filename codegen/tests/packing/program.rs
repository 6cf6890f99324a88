use core::fmt::Debug;

use lexibus::message::{Message, Reader, Reply, Request, Setting, SettingsRule, WriteError, Writer};
use lexibus::Parameter;

/// A xorshift generator of random bits. All runs generate the same bits.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// Returns up to three random elements. The slice is leaked, so it is valid until the program ends.
    fn several<T>(&mut self, one: impl Fn(&mut Self) -> T) -> &'static [T] {
        (0..self.next() & 3).map(|_| one(self)).collect::<Vec<_>>().leak()
    }

    /// Returns up to three parameters with values that `rule` allows. The slice is valid until the program ends.
    fn settings(&mut self, rule: SettingsRule) -> &'static [Setting] {
        self.several(|random| {
            let (first, last, length) = rule.lengths[random.next() as usize % rule.lengths.len()];
            let mut value = [0; 8];
            random.fill(&mut value);
            let parameter = Parameter(first + random.next() as u32 % (last - first + 1));
            Setting::new(parameter, value, length.into())
        })
    }

    fn fill(&mut self, bytes: &mut [u8]) {
        bytes.iter_mut().for_each(|byte| *byte = (self.next() >> 32) as u8);
    }

    /// Returns a random number. Numbers of all lengths in bits are equally likely, and so are positive and negative numbers.
    fn number(&mut self) -> i64 {
        let (number, shift) = (self.next() as i64, self.next() & 63);
        number >> shift
    }

    /// Returns a parameter with a value of 1, 2, 4 or 8 bytes. In a reply, the parameter number is copied from a random position in
    /// the request, unless the request ends before this position.
    fn setting(&mut self, request: &[u8]) -> Setting {
        let named =
            request.windows(2).nth(self.next() as usize % 8).map(|two| i64::from(two[0]) << 8 | i64::from(two[1]));
        let number = named.unwrap_or_else(|| self.number());
        let (parameter, mut value) = (Parameter(number as u32), [0; 8]);
        self.fill(&mut value);
        Setting::of(parameter, &value[..1 << (self.next() & 3)]).expect("at most eight bytes")
    }
}

const SEED: u64 = 0x9E37_79B9_7F4A_7C15;

/// The bytes of packed data, and their unpacked fields as text.
type Packed = (Vec<u8>, String);

/// Unpacks data, sets a field to the bits of a value, and packs the fields. The second argument is the number of the field, or
/// [`NONE`] to set no field.
type Change<'c> = &'c dyn Fn(&[u8], usize, u64) -> Result<Packed, String>;

/// Field number that selects no field.
const NONE: usize = usize::MAX;

/// Bit positions of a type.
struct Layout {
    title: &'static str,
    bits: usize,
    /// Pieces of each field: first bit in the data, first bit in the value, and number of bits.
    fields: &'static [&'static [(u32, u32, u32)]],
    /// Default data of a record.
    default: &'static [u8],
}

impl Layout {
    fn len(&self) -> usize {
        self.bits.div_ceil(8)
    }

    /// Calls `look` for each bit of a field, with the positions in the data and in the value. Reserved bits have no position
    /// in the value.
    fn each_bit(&self, field: usize, mut look: impl FnMut(usize, Option<u32>)) {
        for (at, of, bits) in self.fields[field] {
            (0..*bits).for_each(|bit| look((at + bit) as usize, (*of != u32::MAX).then(|| of + bit)));
        }
    }

    /// Returns a mask that contains the bits of all fields.
    fn mask(&self) -> Vec<u8> {
        let mut mask = vec![0; self.len()];
        for field in 0..self.fields.len() {
            self.each_bit(field, |at, of| put(&mut mask, at, of.is_some()));
        }
        mask
    }

    /// Returns `data` after writing the bits of a value to a field.
    fn with(&self, mut data: Vec<u8>, field: usize, raw: u64) -> Vec<u8> {
        self.each_bit(field, |at, of| put(&mut data, at, of.is_some_and(|of| raw >> (of % 64) & 1 == 1)));
        data
    }
}

fn put(data: &mut [u8], bit: usize, value: bool) {
    data[bit / 8] = data[bit / 8] & !(1 << (bit % 8)) | u8::from(value) << (bit % 8);
}

/// Returns the bits of `data` where `mask` is 1, and the bits of `other` where `mask` is 0.
fn merged(data: &[u8], mask: &[u8], other: &[u8]) -> Vec<u8> {
    let all = data.iter().zip(mask).zip(other);
    all.map(|((data, mask), other)| data & mask | other & !mask).collect()
}

/// Returns `len` bytes that repeat the bits of `raw`.
fn filled(raw: u64, len: usize) -> Vec<u8> {
    raw.to_le_bytes().into_iter().cycle().take(len).collect()
}

fn bytes<const N: usize>(raw: u64) -> [u8; N] {
    filled(raw, N).try_into().expect("N bytes")
}

/// Checks a PDO or process image. `$set` writes the bits of a value to a field.
macro_rules! process_data {
    ($name:ty, $layout:expr, |$value:ident, $at:ident, $raw:ident| $set:expr) => {{
        let change = |data: &[u8], $at: usize, $raw: u64| {
            let mut $value = <$name>::unpack(data).map_err(|error| format!("{error:?}"))?;
            $set;
            Ok(($value.pack().to_vec(), if $at == NONE { format!("{:?}", $value) } else { String::new() }))
        };
        assert_eq!(<$name>::LEN, $layout.len(), "{}", $layout.title);
        process_data($layout, &change);
    }};
}

/// Checks process data. Unpacking and packing must keep the bits of all fields and clear all other bits. Setting a field must
/// change only its bits. Unpacking too few bytes must be an error.
fn process_data(layout: &Layout, change: Change<'_>) {
    let (title, mask, zeros) = (layout.title, layout.mask(), vec![0; layout.len()]);
    let changed = |data: &[u8], at, raw| change(data, at, raw).unwrap_or_else(|error| panic!("{title}: {error}"));
    let mut random = Random(SEED);
    let mut data = vec![0xFF; layout.len()];
    for round in 0..24 {
        match round {
            0 => data.fill(0),
            1 => data.fill(0xFF),
            2 => data.fill(0x80),
            3 => data.fill(0x7F),
            _ => random.fill(&mut data),
        }
        let (packed, fields) = changed(&data, NONE, 0);
        let expected = merged(&data, &mask, &zeros);
        assert!(packed == expected, "{title}: {data:02X?} is packed as {packed:02X?} instead of {expected:02X?}");
        let again = changed(&packed, NONE, 0);
        assert!(again == (packed, fields), "{title}: {data:02X?} is {again:?} the second time");
    }
    for at in 0..layout.fields.len() {
        for (fill, raw) in [(Some(0), !0), (Some(0xFF), 0), (None, random.next()), (None, random.next())] {
            random.fill(&mut data);
            fill.into_iter().for_each(|byte| data.fill(byte));
            let (packed, _) = changed(&data, at, raw);
            let expected = layout.with(merged(&data, &mask, &zeros), at, raw);
            assert!(
                packed == expected,
                "{title}: {raw:X} in {at} of {data:02X?} is {packed:02X?}, not {expected:02X?}"
            );
        }
    }
    if layout.len() > 0 {
        assert!(change(&data[1..], NONE, 0).is_err(), "{title}: unpacks {} of {} bytes", layout.len() - 1, layout.len());
    }
}

/// Reads the fields of a view, or the PDOs in the view of an image.
trait Getters<T> {
    /// Returns a struct with the values of all fields.
    fn fields(&self) -> T;
}

trait Setters<T> {
    /// Sets the field with the number `at`. Sets all fields if `at` is [`NONE`].
    fn set(&mut self, fields: &T, at: usize);
}

/// Implements `Getters` for the fields of a view.
macro_rules! getters {
    ($name:ty, $view:ty, |$value:ident| $fields:expr, [$($field:ident $getter:ident,)*]) => {
        impl Getters<$name> for $view {
            fn fields(&self) -> $name {
                type Fields = $name;
                let $value = self;
                let view = $fields;
                Fields { $($field: view.$getter(),)* }
            }
        }
    };
}

macro_rules! setters {
    ($name:ty, $view:ty, [$($at:literal $field:ident $setter:ident,)*]) => {
        impl Setters<$name> for $view {
            fn set(&mut self, fields: &$name, at: usize) {
                $(if at == $at || at == NONE {
                    self.$setter(fields.$field);
                })*
            }
        }
    };
}

/// Implements `Getters` and `Setters` for the PDOs in the views of an image.
macro_rules! image_views {
    ($name:ty, $reader:ty, $writer:ty, [$($read:ident $get:ident,)*], [$($at:literal $field:ident $set:ident,)*]) => {
        impl Getters<$name> for $reader {
            fn fields(&self) -> $name {
                type Fields = $name;
                Fields { $($read: self.$get().fields(),)* }
            }
        }

        impl Setters<$name> for $writer {
            fn set(&mut self, fields: &$name, at: usize) {
                $(if at == $at || at == NONE {
                    self.$set().set(&fields.$field, NONE);
                })*
            }
        }
    };
}

/// Checks a view. `$get` and `$set` return the view that starts at a given bit of the data, or an error.
macro_rules! view {
    ($name:ty, $layout:expr, $bits:expr, |$data:ident, $bit:ident| $get:expr, $set:expr) => {{
        let set = |$data: &mut [u8], $bit: usize, at: usize, from: &[u8]| {
            let fields = <$name>::unpack(from).expect("enough bytes");
            $set.map(|mut view| Setters::<$name>::set(&mut view, &fields, at)).map_err(|error| format!("{error:?}"))
        };
        let get = |$data: &mut [u8], $bit: usize| {
            let fields = $get.map(|view| Getters::<$name>::fields(&view));
            fields.map(|fields| fields.pack().to_vec()).map_err(|error| format!("{error:?}"))
        };
        view($layout, $bits, &set, &get);
    }};
}

/// Creates the view at a given bit, and copies a field from other packed data into it. Copies all fields if the field number is
/// [`NONE`].
type Set<'s> = &'s dyn Fn(&mut [u8], usize, usize, &[u8]) -> Result<(), String>;

/// Reads all fields of the view at a given bit, and returns them as packed data.
type Get<'g> = &'g dyn Fn(&mut [u8], usize) -> Result<Vec<u8>, String>;

/// Checks a view. Setting a field must change only its bits of the image, and reading must return the bits of the image. The test
/// places the view at each of the first `bits` bits, both in images that end with the view and in longer images.
fn view(layout: &Layout, bits: usize, set: Set<'_>, get: Get<'_>) {
    let (title, mask, mut random) = (layout.title, layout.mask(), Random(SEED));
    let (mut from, zeros) = (vec![0; layout.len()], vec![0; layout.len()]);
    for (bit, behind) in (0..bits).flat_map(|bit| [(bit, 0), (bit, 9)]) {
        let mut image = vec![0xFF; (bit + layout.bits).div_ceil(8) + behind];
        random.fill(&mut from);
        for at in (0..layout.fields.len()).chain([NONE]) {
            let mut expected = vec![0xFF; image.len()];
            let of_field = |field: &usize| at == NONE || at == *field;
            for field in (0..layout.fields.len()).filter(of_field) {
                layout.each_bit(field, |at, of| put(&mut expected, bit + at, of.is_some() && is_set(&from, at)));
            }
            image.fill(0xFF);
            let outcome = set(&mut image, bit, at, &from);
            assert!(outcome == Ok(()), "{title}: at bit {bit}: {outcome:?}");
            assert!(
                image == expected,
                "{title}: {at} of {from:02X?} at bit {bit} is {image:02X?}, not {expected:02X?}"
            );
        }
        random.fill(&mut image);
        let mut read = vec![0; layout.len()];
        (0..layout.bits).for_each(|at| put(&mut read, at, is_set(&image, bit + at)));
        let (read, got) = (merged(&read, &mask, &zeros), get(&mut image, bit));
        assert!(got.as_ref() == Ok(&read), "{title}: at bit {bit} of {image:02X?} is {got:02X?}, not {read:02X?}");
        let short = image.len() - behind - 1;
        let outcome = (set(&mut image[..short], bit, NONE, &from), get(&mut image[..short], bit));
        assert!(matches!(outcome, (Err(_), Err(_))), "{title}: {short} bytes from bit {bit} on: {outcome:?}");
    }
}

fn is_set(data: &[u8], bit: usize) -> bool {
    data[bit / 8] >> (bit % 8) & 1 == 1
}

/// Checks a record. `$set` writes the bits of a value to a field.
macro_rules! record {
    ($name:ty, $layout:expr, |$value:ident, $at:ident, $raw:ident| $set:expr) => {{
        let layout: &Layout = $layout;
        let decode = |data: &[u8]| <$name>::decode(data).unwrap_or_else(|error| panic!("{}: {error:?}", layout.title));
        let change = |data: &[u8], $at: usize, $raw: u64| {
            let mut $value = decode(data);
            $set;
            $value.encode().map(|bytes| (bytes.to_vec(), format!("{:?}", $value))).map_err(|error| format!("{error:?}"))
        };
        assert_eq!(<$name>::LEN, layout.len(), "{}", layout.title);
        let default = (<$name>::DEFAULT_BYTES, <$name>::DEFAULT);
        assert_eq!(default.0[..], *layout.default, "{}: the default", layout.title);
        assert_eq!(default.1.encode(), Ok(default.0), "{}: the default", layout.title);
        assert_eq!(format!("{:?}", decode(&default.0)), format!("{:?}", default.1), "{}: the default", layout.title);
        record(layout, &default.0, &change);
    }};
}

/// Minimum number of values that each record must accept. If a record has fields, at least as many accepted values must
/// differ from the previous value.
const ACCEPTED: usize = 64;

/// Checks a record. Decoding and encoding must keep the bits of all fields, and must set all other bits to those of
/// `default`. Setting a field must change only its bits. The test starts with the default and changes it step by step to other
/// valid records.
fn record(layout: &Layout, default: &[u8], change: Change<'_>) {
    let (title, mask, mut random) = (layout.title, layout.mask(), Random(SEED));
    let (mut data, mut accepted, mut moved) = (default.to_vec(), 0, 0);
    for round in 0..1_000_000 {
        let mut next = data.clone();
        let (field, raw) = match layout.fields.len() {
            fields @ 1.. if round % 2 == 0 => (random.next() as usize % fields, random.number() as u64),
            _ => (NONE, random.next()),
        };
        if field == NONE {
            let at = random.next() as usize % next.len();
            next[at] ^= if raw & 1 == 0 { 1 << (raw >> 1 & 7) } else { (raw >> 8) as u8 };
        }
        let Ok(packed) = change(&next, field, raw) else { continue };
        let kept = merged(&next, &mask, default);
        let expected = if field == NONE { kept } else { layout.with(kept, field, raw) };
        assert!(
            packed.0 == expected,
            "{title}: {raw:X} in {field} of {next:02X?} is {packed:02X?}, not {expected:02X?}"
        );
        let again = change(&packed.0, NONE, 0);
        assert!(again.as_ref() == Ok(&packed), "{title}: {next:02X?} is {again:?} the second time");
        accepted += 1;
        moved += usize::from(packed.0 != data);
        data = packed.0;
        if accepted >= ACCEPTED && (moved >= ACCEPTED || layout.fields.is_empty()) {
            return;
        }
    }
    panic!("{title}: only {accepted} values are accepted, and {moved} of them differ from the one before");
}

/// Maximum size of message data in bytes.
const MAX_DATA: usize = 512;

fn written(write: impl FnOnce(&mut Writer<'_>) -> Result<(), WriteError>) -> Result<Vec<u8>, WriteError> {
    let mut data = [0; MAX_DATA];
    let mut to = Writer::new(&mut data);
    write(&mut to)?;
    Ok(to.written().to_vec())
}

/// Checks a message. Requests and replies that can be written must be read unchanged. `request` returns the data of a
/// request, and `reply` checks replies to it. Random values that cannot be sent are skipped.
fn message(title: &str, request: fn(&mut Random) -> Option<Vec<u8>>, reply: fn(&mut Random, &[u8]) -> bool) {
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
    panic!("{title}: {requests} requests, {replies} replies");
}

/// Returns whether two values are equal or have the same text. The texts are also compared because NaN does not equal itself.
fn is_same<T: PartialEq + Debug>(one: &T, other: &T) -> bool {
    one == other || format!("{one:?}") == format!("{other:?}")
}

/// Returns the data of a request, after checking that they decode to an equal request. Returns `None` if the request cannot be
/// encoded.
macro_rules! sent {
    ($random:ident, $message:ty, $none:ident, $has_node:literal, $value:expr) => {{
        #[allow(unused)]
        let $none: &[u8] = &[];
        let (request, node) = ($value, u32::from($random.number() as u8));
        written(|to| request.write(node, to)).ok().inspect(|data| {
            let read = <$message>::parse(&mut Reader::new(data));
            // A request that contains no device number is read with number 0.
            let node = if $has_node { node } else { 0 };
            assert!(is_same(&read, &Some((node, request))), "{data:02X?} is read as {read:?}");
        })
    }};
}

/// Checks the round trip of request data: the decoded request must encode to the same data.
macro_rules! overheard {
    ($random:ident, $message:ty, $constant:expr) => {{
        let data = likely($random, &[], $constant);
        <$message>::parse(&mut Reader::new(&data)).map(|(node, request)| {
            let actual = written(|to| request.write(node, to));
            assert!(actual.as_deref() == Ok(&data), "{data:02X?} is written as {actual:02X?}");
            data.clone()
        })
    }};
}

/// Checks the round trip of a reply: its encoded data decode to an equal reply.
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

/// Checks the round trip of reply data: the decoded reply must encode to the same data.
macro_rules! overheard_reply {
    ($random:ident, $message:ty, $request:ident, $constant:expr) => {{
        let data = likely($random, $request, $constant);
        let read = <$message as Message>::Reply::read($request, &mut Reader::new(&data));
        if let Some(reply) = &read {
            let actual = written(|to| reply.write($request, to));
            assert!(actual.as_deref() == Ok(&data), "{:02X?}: {data:02X?} is written as {actual:02X?}", $request);
        }
        read.is_some()
    }};
}

/// Returns up to 48 random bytes. The bytes may begin with up to two bytes of `from`, and contain `constant` near the
/// start if it fits.
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

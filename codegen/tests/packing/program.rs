use core::fmt::Debug;

use lexibus::message::{Message, Reader, Reply, Request, Setting, SettingsRule, WriteError, Writer};
use lexibus::Parameter;

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

/// Unpacks data, sets the field of this number, if there is one, by the bits of a value, and packs the fields.
type Change<'c> = &'c dyn Fn(&[u8], usize, u64) -> Result<Packed, String>;

/// The number of no field.
const NONE: usize = usize::MAX;

/// Where the bits of a type are.
struct Layout {
    title: &'static str,
    bits: usize,
    /// The pieces of each field: the first bit within the data, the bit of the value that it is, and how many there are.
    fields: &'static [&'static [(u32, u32, u32)]],
    /// The bytes of a record by default.
    default: &'static [u8],
}

impl Layout {
    fn len(&self) -> usize {
        self.bits.div_ceil(8)
    }

    /// Hands each bit of a field to `look`: that of the data and that of the value, which reserved bits have not.
    fn each_bit(&self, field: usize, mut look: impl FnMut(usize, Option<u32>)) {
        for (at, of, bits) in self.fields[field] {
            (0..*bits).for_each(|bit| look((at + bit) as usize, (*of != u32::MAX).then(|| of + bit)));
        }
    }

    /// The bits that fields have.
    fn mask(&self) -> Vec<u8> {
        let mut mask = vec![0; self.len()];
        for field in 0..self.fields.len() {
            self.each_bit(field, |at, of| put(&mut mask, at, of.is_some()));
        }
        mask
    }

    /// `data` with the bits of a value in a field.
    fn with(&self, mut data: Vec<u8>, field: usize, raw: u64) -> Vec<u8> {
        self.each_bit(field, |at, of| put(&mut data, at, of.is_some_and(|of| raw >> (of % 64) & 1 == 1)));
        data
    }
}

fn put(data: &mut [u8], bit: usize, value: bool) {
    data[bit / 8] = data[bit / 8] & !(1 << (bit % 8)) | u8::from(value) << (bit % 8);
}

/// `data` where `mask` is 1, `other` where it is 0.
fn merged(data: &[u8], mask: &[u8], other: &[u8]) -> Vec<u8> {
    let all = data.iter().zip(mask).zip(other);
    all.map(|((data, mask), other)| data & mask | other & !mask).collect()
}

/// Bytes of the bits of `raw`, again and again.
fn filled(raw: u64, len: usize) -> Vec<u8> {
    raw.to_le_bytes().into_iter().cycle().take(len).collect()
}

fn bytes<const N: usize>(raw: u64) -> [u8; N] {
    filled(raw, N).try_into().expect("as many bytes")
}

/// Checks a PDO or a process image. `$set` puts the bits of a value into a field.
macro_rules! process_data {
    ($name:ty, $layout:expr, |$own:ident, $at:ident, $raw:ident| $set:expr) => {{
        let change = |data: &[u8], $at: usize, $raw: u64| {
            let mut $own = <$name>::unpack(data).map_err(|error| format!("{error:?}"))?;
            $set;
            Ok(($own.pack().to_vec(), if $at == NONE { format!("{:?}", $own) } else { String::new() }))
        };
        assert_eq!(<$name>::LEN, $layout.len(), "{}", $layout.title);
        process_data($layout, &change);
    }};
}

/// The bits of the fields are the same after unpacking and packing, all others are 0; the bits of a field that is set are
/// where they belong, and no others change. Too few bytes are an error.
fn process_data(own: &Layout, change: Change<'_>) {
    let (title, mask, zeros) = (own.title, own.mask(), vec![0; own.len()]);
    let changed = |data: &[u8], at, raw| change(data, at, raw).unwrap_or_else(|error| panic!("{title}: {error}"));
    let mut random = Random(SEED);
    let mut data = vec![0xFF; own.len()];
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
        assert!(packed == expected, "{title}: {data:02X?} is packed as {packed:02X?}, not {expected:02X?}");
        let again = changed(&packed, NONE, 0);
        assert!(again == (packed, fields), "{title}: {data:02X?} is {again:?} the second time");
    }
    for at in 0..own.fields.len() {
        for (fill, raw) in [(Some(0), !0), (Some(0xFF), 0), (None, random.next()), (None, random.next())] {
            random.fill(&mut data);
            fill.into_iter().for_each(|byte| data.fill(byte));
            let (packed, _) = changed(&data, at, raw);
            let expected = own.with(merged(&data, &mask, &zeros), at, raw);
            assert!(
                packed == expected,
                "{title}: {raw:X} in {at} of {data:02X?} is {packed:02X?}, not {expected:02X?}"
            );
        }
    }
    if own.len() > 0 {
        assert!(change(&data[1..], NONE, 0).is_err(), "{title}: unpacks {} of {} bytes", own.len() - 1, own.len());
    }
}

/// What the views of a PDO do within an image.
trait Getters<T> {
    /// All fields.
    fn fields(&self) -> T;
}

trait Setters<T> {
    /// Sets the field of this number, or all of them.
    fn set(&mut self, fields: &T, at: usize);
}

/// The fields of a view.
macro_rules! getters {
    ($name:ty, $view:ty, |$own:ident| $fields:expr, [$($field:ident $getter:ident,)*]) => {
        impl Getters<$name> for $view {
            fn fields(&self) -> $name {
                type Fields = $name;
                let $own = self;
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

/// The PDOs of a view of an image.
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

/// Checks a view. `$get` and `$set` are the view at a bit of data, or why there is none.
macro_rules! view {
    ($name:ty, $layout:expr, $bits:expr, |$data:ident, $bit:ident| $get:expr, $set:expr) => {{
        let set = |$data: &mut [u8], $bit: usize, at: usize, from: &[u8]| {
            let fields = <$name>::unpack(from).expect("as many bytes");
            $set.map(|mut view| Setters::<$name>::set(&mut view, &fields, at)).map_err(|error| format!("{error:?}"))
        };
        let get = |$data: &mut [u8], $bit: usize| {
            let fields = $get.map(|view| Getters::<$name>::fields(&view));
            fields.map(|fields| fields.pack().to_vec()).map_err(|error| format!("{error:?}"))
        };
        view($layout, $bits, &set, &get);
    }};
}

/// Sets the field of this number, or all of them, of the view at this bit of data as it is in other data.
type Set<'s> = &'s dyn Fn(&mut [u8], usize, usize, &[u8]) -> Result<(), String>;

/// Packs the fields of the view at this bit.
type Get<'g> = &'g dyn Fn(&mut [u8], usize) -> Result<Vec<u8>, String>;

/// A field that is set within an image has its bits there, and no others change; what is read is what stands there. In
/// images that end with the view and in longer ones, from each of the first `bits` bits on.
fn view(own: &Layout, bits: usize, set: Set<'_>, get: Get<'_>) {
    let (title, mask, mut random) = (own.title, own.mask(), Random(SEED));
    let (mut from, zeros) = (vec![0; own.len()], vec![0; own.len()]);
    for (bit, behind) in (0..bits).flat_map(|bit| [(bit, 0), (bit, 9)]) {
        let mut image = vec![0xFF; (bit + own.bits).div_ceil(8) + behind];
        random.fill(&mut from);
        for at in (0..own.fields.len()).chain([NONE]) {
            let mut expected = vec![0xFF; image.len()];
            let of_field = |field: &usize| at == NONE || at == *field;
            for field in (0..own.fields.len()).filter(of_field) {
                own.each_bit(field, |at, of| put(&mut expected, bit + at, of.is_some() && is_set(&from, at)));
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
        let mut read = vec![0; own.len()];
        (0..own.bits).for_each(|at| put(&mut read, at, is_set(&image, bit + at)));
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

/// Checks a record. `$set` puts the bits of a value into a field.
macro_rules! record {
    ($name:ty, $layout:expr, |$own:ident, $at:ident, $raw:ident| $set:expr) => {{
        let layout: &Layout = $layout;
        let decode = |data: &[u8]| <$name>::decode(data).unwrap_or_else(|error| panic!("{}: {error:?}", layout.title));
        let change = |data: &[u8], $at: usize, $raw: u64| {
            let mut $own = decode(data);
            $set;
            $own.encode().map(|bytes| (bytes.to_vec(), format!("{:?}", $own))).map_err(|error| format!("{error:?}"))
        };
        assert_eq!(<$name>::LEN, layout.len(), "{}", layout.title);
        let default = (<$name>::DEFAULT_BYTES, <$name>::DEFAULT);
        assert_eq!(default.0[..], *layout.default, "{}: the default", layout.title);
        assert_eq!(default.1.encode(), Ok(default.0), "{}: the default", layout.title);
        assert_eq!(format!("{:?}", decode(&default.0)), format!("{:?}", default.1), "{}: the default", layout.title);
        record(layout, &default.0, &change);
    }};
}

/// So many values of a record are checked that it takes, and as many that have other fields than the one before.
const ACCEPTED: usize = 64;

/// The bits of the fields are the same after decoding and encoding, all others are those of `default`; the bits of a field
/// that is set are where they belong. From the default on, change by change, through values that are allowed.
fn record(own: &Layout, default: &[u8], change: Change<'_>) {
    let (title, mask, mut random) = (own.title, own.mask(), Random(SEED));
    let (mut data, mut accepted, mut moved) = (default.to_vec(), 0, 0);
    for round in 0..1_000_000 {
        let mut next = data.clone();
        let (field, raw) = match own.fields.len() {
            fields @ 1.. if round % 2 == 0 => (random.next() as usize % fields, random.number() as u64),
            _ => (NONE, random.next()),
        };
        if field == NONE {
            let at = random.next() as usize % next.len();
            next[at] ^= if raw & 1 == 0 { 1 << (raw >> 1 & 7) } else { (raw >> 8) as u8 };
        }
        let Ok(packed) = change(&next, field, raw) else { continue };
        let kept = merged(&next, &mask, default);
        let expected = if field == NONE { kept } else { own.with(kept, field, raw) };
        assert!(
            packed.0 == expected,
            "{title}: {raw:X} in {field} of {next:02X?} is {packed:02X?}, not {expected:02X?}"
        );
        let again = change(&packed.0, NONE, 0);
        assert!(again.as_ref() == Ok(&packed), "{title}: {next:02X?} is {again:?} the second time");
        accepted += 1;
        moved += usize::from(packed.0 != data);
        data = packed.0;
        if accepted >= ACCEPTED && (moved >= ACCEPTED || own.fields.is_empty()) {
            return;
        }
    }
    panic!("{title}: only {accepted} values are allowed, {moved} of them others than before");
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

/// Whether two values are equal, or look so: as numbers that aren't any do.
fn is_same<T: PartialEq + Debug>(one: &T, other: &T) -> bool {
    one == other || format!("{one:?}") == format!("{other:?}")
}

/// The data of a request, which are read as it.
macro_rules! sent {
    ($random:ident, $message:ty, $none:ident, $has_node:literal, $value:expr) => {{
        #[allow(unused)]
        let $none: &[u8] = &[];
        let (request, node) = ($value, u32::from($random.number() as u8));
        written(|to| request.write(node, to)).ok().inspect(|data| {
            let read = <$message>::parse(&mut Reader::new(data));
            // A request without a number of the device reads 0.
            let node = if $has_node { node } else { 0 };
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

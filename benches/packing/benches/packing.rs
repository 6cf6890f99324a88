//! Measures packing and unpacking 256 frames with Lexibus, handwritten code and other libraries.

use bilge::prelude::*;
use deku::prelude::*;
use divan::{black_box, Bencher};
use ethercrab_wire::{EtherCrabWireRead, EtherCrabWireWriteSized};
use packed_struct::prelude::*;

type Frame = [u8; 6];

fn main() {
    divan::main();
}

/// Returns pseudo-random frames.
fn frames() -> Vec<Frame> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state.to_le_bytes()
    };
    (0..256).map(|_| *next().first_chunk().unwrap()).collect()
}

/// Measures `unpack`. First checks that packing the unpacked values gives the original frames again.
fn unpacked<T>(bencher: Bencher<'_, '_>, unpack: impl Fn(&Frame) -> T, pack: impl Fn(&T) -> Frame) {
    let frames = frames();
    frames.iter().for_each(|frame| assert_eq!(pack(&unpack(frame)), *frame));
    bencher.counter(frames.len()).bench_local(|| {
        for frame in &frames {
            black_box(unpack(black_box(frame)));
        }
    });
}

fn packed<T>(bencher: Bencher<'_, '_>, unpack: impl Fn(&Frame) -> T, pack: impl Fn(&T) -> Frame) {
    let values: Vec<T> = frames().iter().map(unpack).collect();
    bencher.counter(values.len()).bench_local(|| {
        for value in &values {
            black_box(pack(black_box(value)));
        }
    });
}

/// Defines two benchmarks for each library: unpacking and packing.
macro_rules! both {
    ($($name:ident: $unpack:expr, $pack:expr;)*) => {
        mod unpack {
            use super::*;
            $(#[divan::bench] fn $name(bencher: Bencher<'_, '_>) { super::super::unpacked(bencher, $unpack, $pack) })*
        }
        mod pack {
            use super::*;
            $(#[divan::bench] fn $name(bencher: Bencher<'_, '_>) { super::super::packed(bencher, $unpack, $pack) })*
        }
    };
}

/// Returns the frame that `deku` writes for the struct `value`.
fn deku_bytes(value: &impl DekuContainerWrite) -> Frame {
    let mut frame = [0; 6];
    value.to_slice(&mut frame).unwrap();
    frame
}

/// Returns the bytes of a frame as one little-endian number.
fn word(frame: &Frame) -> u48 {
    u48::from_le_bytes(*frame)
}

mod whole_bytes {
    use super::*;
    use lexibus_drives::demo_drive::pdo::RxPdo2;
    use lexibus_instructions::hand::WordAndLong;
    use lexibus_packing::whole_bytes::{Bilge, Deku, EtherCrab, Packed};

    both! {
        lexibus: |frame| RxPdo2::unpack(frame).unwrap(), |value| value.pack();
        by_hand: |frame| WordAndLong::unpack(frame).unwrap(), |value| value.pack();
        ethercrab_wire: |frame| EtherCrab::unpack_from_slice(frame).unwrap(), |value| value.pack();
        deku: |frame| Deku::from_bytes((frame, 0)).unwrap().1, deku_bytes;
        packed_struct: |frame| Packed::unpack(frame).unwrap(), |value| value.pack().unwrap();
        // `Bilge::from` only stores the word. Read all fields, because the other libraries also decode all fields.
        bilge: |frame| {
            let bits = Bilge::from(word(frame));
            WordAndLong { word: bits.word(), long: bits.long() as i32 }
        }, |value| u48::from(Bilge::of(value.word, value.long as u32)).to_le_bytes();
    }
}

mod odd_bits {
    use super::*;
    use lexibus_instructions::axis::pdo::Encoder;
    use lexibus_instructions::hand;
    use lexibus_packing::odd_bits::{Bilge, Mode};

    /// Decodes all fields of the `bilge` struct.
    fn fields(bits: Bilge) -> hand::Encoder {
        hand::Encoder {
            ready: bits.ready(),
            mode: match bits.mode() {
                Mode::Off => hand::Mode::Off,
                Mode::Position => hand::Mode::Position,
                Mode::Two => hand::Mode::Unknown(2),
                Mode::Velocity => hand::Mode::Velocity,
                Mode::Torque => hand::Mode::Torque,
                Mode::Unknown(other) => hand::Mode::Unknown(other.value()),
            },
            referenced: bits.referenced(),
            position: i64::from((bits.position().value() << 8) as i32 >> 8),
            overflow: bits.overflow(),
            quality: bits.quality().value().into(),
            speed: bits.speed() as i16,
        }
    }

    fn bits(value: &hand::Encoder) -> Bilge {
        let mode = match value.mode {
            hand::Mode::Off => Mode::Off,
            hand::Mode::Position => Mode::Position,
            hand::Mode::Velocity => Mode::Velocity,
            hand::Mode::Torque => Mode::Torque,
            hand::Mode::Unknown(2) => Mode::Two,
            hand::Mode::Unknown(other) => Mode::Unknown(u3::masked_new(other)),
        };
        Bilge::of(
            value.ready,
            mode,
            value.referenced,
            u24::masked_new(value.position as u32),
            value.overflow,
            u2::masked_new(value.quality as u8),
            value.speed as u16,
        )
    }

    both! {
        lexibus: |frame| Encoder::unpack(frame).unwrap(), |value| value.pack();
        by_hand: |frame| hand::Encoder::unpack(frame).unwrap(), |value| value.pack();
        bilge: |frame| fields(Bilge::from(word(frame))), |value| u48::from(bits(value)).to_le_bytes();
    }
}

//! The first part of a program that unpacks frames with generated Rust. The test appends the function
//! `unpacked(network, can_id, data)`.

#![allow(dead_code, deprecated, unused_imports)]

use std::io::Write as _;
use std::path::Path;

/// Converts a field of a PDO to text: integers in decimal notation, floating-point numbers with an exponent.
trait Field {
    fn text(self) -> String;
}

macro_rules! fields {
    ($($ty:ty: |$field:ident| $text:expr;)*) => {$(
        impl Field for $ty {
            fn text(self) -> String {
                let $field = self;
                $text
            }
        }
    )*};
}

fields! {
    bool: |field| u8::from(field).to_string();
    u8: |field| field.to_string();
    u16: |field| field.to_string();
    u32: |field| field.to_string();
    u64: |field| field.to_string();
    i8: |field| field.to_string();
    i16: |field| field.to_string();
    i32: |field| field.to_string();
    i64: |field| field.to_string();
    f32: |field| format!("{:e}", f64::from(field));
    f64: |field| format!("{field:e}");
    lexibus::TimeOfDay: |field| field.raw().to_string();
    lexibus::TimeDifference: |field| field.raw().to_string();
}

impl<const BITS: u32> Field for lexibus::Int<BITS> {
    fn text(self) -> String {
        self.get().to_string()
    }
}

impl<const BITS: u32> Field for lexibus::Uint<BITS> {
    fn text(self) -> String {
        self.get().to_string()
    }
}

impl<const LENGTH: usize> Field for [u8; LENGTH] {
    fn text(self) -> String {
        self.iter().rev().fold(0u64, |number, byte| number << 8 | u64::from(*byte)).to_string()
    }
}

/// Returns a physical value as text, with an exponent.
fn physical(value: impl Into<Option<f64>>) -> String {
    format!("{:e}", value.into().expect("a number"))
}

/// Appends the unpacked fields to each line of `frames.txt` in each folder of the arguments.
fn main() {
    for (network, folder) in std::env::args().skip(1).enumerate() {
        let path = Path::new(&folder).join("frames.txt");
        let text = std::fs::read_to_string(&path).expect("a file");
        let mut file = std::io::BufWriter::new(std::fs::File::create(&path).expect("a file"));
        for line in text.lines() {
            let (can_id, data) = line.split_once(';').expect("two fields");
            let byte = |at: usize| u8::from_str_radix(&data[2 * at..2 * at + 2], 16).expect("a byte");
            let bytes: Vec<u8> = (0..data.len() / 2).map(byte).collect();
            let fields = unpacked(network, can_id.parse().expect("a CAN-ID"), &bytes);
            writeln!(file, "{line};{}", fields.join(";")).expect("a file");
        }
    }
}


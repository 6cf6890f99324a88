//! Lexibus functions that encode and decode values, or read and write objects, each paired with a handwritten function.

use core::hint::black_box;

use lexibus::{CanOpen, Client, Error, Fixed, Int, LengthError, Object, OutOfRange};
use lexibus_drives::demo_drive::types::ModesOfOperation;
use lexibus_drives::demo_drive::DemoDrive;
use lexibus_instructions::hand::part;

/// Function pairs that encode and decode a value without a client.
mod integer {
    use super::*;

    pair!(encode, frame,
        ours (value: i32 = i32::from(frame[0])) -> ([u8; 8], usize) {
            let mut buffer = [0; 8];
            let length = <i32 as Fixed>::encode(value, &mut buffer).unwrap_or(0);
            (buffer, length)
        }
        hand (value: i32 = i32::from(frame[0])) -> ([u8; 8], usize) {
            let mut buffer = [0; 8];
            buffer[..4].copy_from_slice(&value.to_le_bytes());
            (buffer, 4)
        }
        same (left, right) left == right);

    pair!(decode, frame,
        ours (data: &[u8] = &frame[..4]) -> Result<i32, LengthError> { <i32 as Fixed>::decode(data) }
        hand (data: &[u8] = &frame[..4]) -> Result<i32, LengthError> {
            match data.try_into() {
                Ok(bytes) => Ok(i32::from_le_bytes(bytes)),
                Err(_) => Err(LengthError::new(4, data.len())),
            }
        }
        same (left, right) left == right);
}

/// Function pairs for a 24-bit integer, a width for which Rust has no integer type.
mod integer_24 {
    use super::*;

    pair!(encode, frame,
        ours (value: i32 = i32::from(frame[0])) -> Result<([u8; 8], usize), OutOfRange> {
            let mut buffer = [0; 8];
            let length = <Int<24> as Fixed>::encode(value, &mut buffer)?;
            Ok((buffer, length))
        }
        hand (value: i32 = i32::from(frame[0])) -> Result<([u8; 8], usize), OutOfRange> {
            if value << 8 >> 8 != value {
                return Err(OutOfRange);
            }
            let mut buffer = [0; 8];
            buffer[..3].copy_from_slice(&value.to_le_bytes()[..3]);
            Ok((buffer, 3))
        }
        same (left, right) left == right);

    pair!(decode, frame,
        ours (data: &[u8] = &frame[..3]) -> Result<i32, LengthError> { <Int<24> as Fixed>::decode(data) }
        hand (data: &[u8] = &frame[..3]) -> Result<i32, LengthError> {
            match *data {
                [a, b, c] => Ok(i32::from_le_bytes([0, a, b, c]) >> 8),
                _ => Err(LengthError::new(3, data.len())),
            }
        }
        same (left, right) left == right);
}

/// A simulated drive on a bus. The client methods are not inlined, because the methods of a bus library are usually not
/// inlined either.
pub struct Wire {
    data: [u8; 8],
    object: Object,
}

impl Wire {
    fn new(data: &[u8]) -> Self {
        Self { data: part(data, 0), object: Object::new(0, 0) }
    }
}

impl Client for Wire {
    type Bus = CanOpen;
    type Error = u8;

    #[inline(never)]
    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Error<u8>> {
        self.object = object;
        for (to, from) in buffer.iter_mut().zip(self.data) {
            *to = from;
        }
        Ok(black_box(buffer.len()))
    }

    #[inline(never)]
    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Error<u8>> {
        self.object = object;
        for (to, from) in self.data.iter_mut().zip(data) {
            *to = *from;
        }
        black_box(());
        Ok(())
    }
}

/// The drive or client, and the value to write, as one argument for a function that writes an object.
struct Writing<D>(D, i32);

/// Function pairs that access objects of the dictionary through a client.
mod objects {
    use super::*;

    pair!(read, frame,
        ours (drive: &mut DemoDrive<Wire> = &mut DemoDrive::new(Wire::new(frame))) -> Result<i32, Error<u8>> {
            Ok(drive.position_actual_value().read()?)
        }
        hand (client: &mut Wire = &mut Wire::new(frame)) -> Result<i32, Error<u8>> {
            let mut buffer = [0; 4];
            let length = client.read(Object::new(0x6064, 0), &mut buffer)?;
            if length != 4 {
                return Err(LengthError::new(4, length).into());
            }
            Ok(i32::from_le_bytes(buffer))
        }
        same (left, right) left == right);

    pair!(write, frame,
        ours (call: &mut Writing<DemoDrive<Wire>> = &mut Writing(DemoDrive::new(Wire::new(frame)), value(frame)))
            -> Result<(), Error<u8>>
        {
            Ok(call.0.target_position().write(call.1)?)
        }
        hand (call: &mut Writing<Wire> = &mut Writing(Wire::new(frame), value(frame))) -> Result<(), Error<u8>> {
            if call.1 < -1_000_000 || call.1 > 1_000_000 {
                return Err(OutOfRange.into());
            }
            call.0.write(Object::new(0x607A, 0), &call.1.to_le_bytes())
        }
        same (left, right) left == right);

    pair!(write_mode, frame,
        ours (call: &mut Writing<DemoDrive<Wire>> = &mut Writing(DemoDrive::new(Wire::new(frame)), value(frame)))
            -> Result<(), Error<u8>>
        {
            Ok(call.0.modes_of_operation().write(ModesOfOperation::from_raw(call.1 as i8))?)
        }
        hand (call: &mut Writing<Wire> = &mut Writing(Wire::new(frame), value(frame))) -> Result<(), Error<u8>> {
            let mode = call.1 as i8;
            if mode > 8 {
                return Err(OutOfRange.into());
            }
            call.0.write(Object::new(0x6060, 0), &mode.to_le_bytes())
        }
        same (left, right) left == right);
}

/// Returns a number from a frame. The number can be outside the limits of the object.
fn value(frame: &[u8]) -> i32 {
    i32::from_le_bytes(part(frame, 0)) >> 10
}

list! {
    integer: encode, decode;
    integer_24: encode, decode;
    objects: read, write, write_mode;
}

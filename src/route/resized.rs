//! Routes of integers whose width on the bus differs from the width of the item.

use super::{ReadRoute, Route, WriteRoute};
use crate::bus::{Bus, Object};
use crate::bus_address::BusAddress;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::pdo::{from_bytes, mask, sign_extend};
use crate::register::Register;
use crate::value::byte_len;
use crate::value_error::{LengthError, OutOfRange};

/// Route of an integer that has `bits` bits on the bus, independent of the width of the item.
///
/// If the value has fewer bits on the bus than in the item, a write fails if the value doesn't fit, and a read extends
/// the value. If the value has more bits on the bus, a write extends the value, and a read fails if the value doesn't
/// fit. Values are sign-extended if `is_signed` is set.
///
/// ```
/// use lexibus::{CanOpen, Client, Error, Modbus, Object, Register, Resized};
/// # use lexibus::{Flags, Initial, Item, OutOfRange, Range, Rw};
///
/// lexibus::location! {
///     /// 32 bits on Modbus, 8 bits on CANopen.
///     struct Resizing {
///         canopen: CanOpen => Resized<Object>,
///         modbus: Modbus => Register,
///     }
/// }
/// const LOCATION: Resizing = Resizing {
///     canopen: Resized::signed(Object::new(0x6060, 0), 8),
///     modbus: Register::high_first(0x8001, 2),
/// };
/// const MODE: Item<i32, Rw, Resizing> = Item::new(LOCATION, "Mode", Range::Full, Initial::Unknown, "", Flags::NONE);
///
/// # struct Node(i8);
/// # impl Client for Node {
/// #     type Bus = CanOpen;
/// #     type Error = core::convert::Infallible;
/// #     fn read(&mut self, _: Object, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>> {
/// #         buffer[0] = self.0 as u8;
/// #         Ok(1)
/// #     }
/// #     fn write(&mut self, _: Object, data: &[u8]) -> Result<(), Error<Self::Error>> {
/// #         self.0 = data[0] as i8;
/// #         assert_eq!(data.len(), 1);
/// #         Ok(())
/// #     }
/// # }
/// # let mut node = Node(0);
/// MODE.at(&mut node).write(-50)?; // one byte, 0xCE
/// assert_eq!(MODE.at(&mut node).read()?, -50);
/// assert_eq!(MODE.at(&mut node).write(200).map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
/// # Ok::<(), Error<core::convert::Infallible>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Resized<R> {
    /// Route to the number.
    pub at: R,
    /// Width of the number on the bus in bits, 1 to 64. The number is transferred in whole bytes.
    pub bits: u8,
    /// True if the narrower of the two numbers, on the bus and in the item, is in two's complement.
    pub is_signed: bool,
}

impl<R> Resized<R> {
    /// Creates a route for a signed number of `bits` bits.
    #[must_use]
    pub const fn signed(at: R, bits: u8) -> Self {
        Self { at, bits, is_signed: true }
    }

    /// Creates a route for an unsigned number of `bits` bits.
    #[must_use]
    pub const fn unsigned(at: R, bits: u8) -> Self {
        Self { at, bits, is_signed: false }
    }
}

/// Converts `value` from `from` bits to `to` bits. Returns `None` if the value doesn't fit. The narrower number is in
/// two's complement if `is_signed` is set.
const fn fit(value: u64, from: u32, to: u32, is_signed: bool) -> Option<u64> {
    let narrow = if from < to { from } else { to };
    let low = value & mask(narrow);
    let number = if is_signed { sign_extend(low, narrow) as u64 } else { low };
    if number & mask(from) == value & mask(from) {
        Some(number & mask(to))
    } else {
        None
    }
}

const fn bits_of(bytes: &[u8]) -> u32 {
    8 * bytes.len() as u32
}

/// Converts `raw`, a number of `bits` bits, to the width of the item, and writes the result to `buffer`. `buffer` has
/// the length of the item's value.
pub(super) fn read(raw: &[u8], bits: u32, is_signed: bool, buffer: &mut [u8]) -> Result<usize, OutOfRange> {
    let value = fit(from_bytes(raw), bits, bits_of(buffer), is_signed).ok_or(OutOfRange)?;
    let mut bytes = value.to_le_bytes().into_iter();
    buffer.fill_with(|| bytes.next().unwrap_or(0));
    Ok(buffer.len())
}

/// Converts the value of an item to a number of `bits` bits.
pub(super) fn written(data: &[u8], bits: u32, is_signed: bool) -> Result<[u8; 8], OutOfRange> {
    fit(from_bytes(data), bits_of(data), bits, is_signed).map(u64::to_le_bytes).ok_or(OutOfRange)
}

/// Returns the first bytes of `bytes`, as many as `bits` bits need.
pub(super) fn truncated(bytes: &mut [u8; 8], bits: u32) -> &mut [u8] {
    bytes.get_mut(..byte_len(bits)).unwrap_or_default()
}

pub(super) fn check(expected: usize, actual: usize) -> Result<(), LengthError> {
    if expected == actual {
        Ok(())
    } else {
        Err(LengthError::new(expected, actual))
    }
}

impl<R: Route> Route for Resized<R> {
    fn object(&self) -> Option<Object> {
        self.at.object()
    }

    fn register(&self) -> Option<Register> {
        self.at.register()
    }

    fn is_resized(&self) -> bool {
        true
    }
}

impl<B: Bus, R: ReadRoute<B>> ReadRoute<B> for Resized<R> {
    #[inline]
    fn read_address(&self) -> Option<BusAddress> {
        self.at.read_address()
    }

    fn read<C: Client<Bus = B>>(&self, client: &mut C, buffer: &mut [u8]) -> Result<usize, Error<C::Error>> {
        let (mut raw, bits) = ([0; 8], self.bits.into());
        let raw = truncated(&mut raw, bits);
        check(raw.len(), self.at.read(client, raw)?)?;
        Ok(read(raw, bits, self.is_signed, buffer)?)
    }

    async fn read_async<C: AsyncClient<Bus = B>>(
        &self,
        client: &mut C,
        buffer: &mut [u8],
    ) -> Result<usize, Error<C::Error>> {
        let (mut raw, bits) = ([0; 8], self.bits.into());
        let raw = truncated(&mut raw, bits);
        check(raw.len(), self.at.read_async(client, raw).await?)?;
        Ok(read(raw, bits, self.is_signed, buffer)?)
    }
}

impl<B: Bus, R: WriteRoute<B>> WriteRoute<B> for Resized<R> {
    #[inline]
    fn write_address(&self) -> Option<BusAddress> {
        self.at.write_address()
    }

    fn write<C: Client<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>> {
        let bits = self.bits.into();
        let mut raw = written(data, bits, self.is_signed)?;
        self.at.write(client, truncated(&mut raw, bits))
    }

    async fn write_async<C: AsyncClient<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>> {
        let bits = self.bits.into();
        let mut raw = written(data, bits, self.is_signed)?;
        self.at.write_async(client, truncated(&mut raw, bits)).await
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn narrower_on_the_bus() {
        assert_eq!(written(&(-50_i32).to_le_bytes(), 8, true), Ok([0xCE, 0, 0, 0, 0, 0, 0, 0]));
        assert_eq!(written(&200_i32.to_le_bytes(), 8, true), Err(OutOfRange));
        assert_eq!(written(&200_i32.to_le_bytes(), 8, false).map(|bytes| bytes[0]), Ok(200));
        assert_eq!(written(&(-1_i32).to_le_bytes(), 8, false), Err(OutOfRange));
        let mut value = [0xAA; 4];
        assert_eq!(read(&[0xCE], 8, true, &mut value), Ok(4));
        assert_eq!(i32::from_le_bytes(value), -50);
        assert_eq!(read(&[0xCE], 8, false, &mut value), Ok(4));
        assert_eq!(i32::from_le_bytes(value), 0xCE);
        assert_eq!(read(&[0x0C], 4, true, &mut value), Ok(4));
        assert_eq!(i32::from_le_bytes(value), -4);
    }

    #[test]
    fn wider_on_the_bus() {
        assert_eq!(written(&[0xCE], 16, true).map(|bytes| bytes[..2].to_vec()), Ok([0xCE, 0xFF].to_vec()));
        assert_eq!(written(&[0xCE], 16, false).map(|bytes| bytes[..2].to_vec()), Ok([0xCE, 0].to_vec()));
        let mut value = [0];
        assert_eq!(read(&[0xCE, 0xFF], 16, true, &mut value), Ok(1));
        assert_eq!(value, [0xCE]);
        assert_eq!(read(&[0xCE, 0x00], 16, true, &mut value), Err(OutOfRange));
        assert_eq!(read(&[0xCE, 0x01], 16, false, &mut value), Err(OutOfRange));
        assert_eq!(read(&[0xFF; 8], 64, true, &mut value), Ok(1));
    }

    #[test]
    fn every_byte_comes_back() {
        for (bits, is_signed) in [(8, true), (8, false), (16, true), (16, false), (64, true), (64, false)] {
            for value in 0..=u8::MAX {
                let bytes = written(&[value], bits, is_signed).unwrap();
                let mut back = [0];
                assert_eq!(read(&bytes[..byte_len(bits)], bits, is_signed, &mut back), Ok(1));
                assert_eq!(back, [value]);
            }
        }
    }
}

//! Windows: indirect access to numbered values. A client writes the number of a value to one address, and accesses the
//! value at another address.

use core::time::Duration;

use super::{resized, ReadRoute, Route, WriteRoute};
use crate::bus::Bus;
use crate::bus_address::BusAddress;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::value_error::OutOfRange;

/// Interval between two polls of a number that the device clears.
const INTERVAL: Duration = Duration::from_millis(1);

/// Specifies how a device reports that it has completed an access through a window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Handshake {
    /// Maximum number of polls if the device clears the number to 0. Polls are 1 ms apart if the client [can
    /// wait](Client::wait). This field is 0 if the device doesn't clear the number.
    pub polls: u16,
    /// Time in milliseconds that the device needs for the access, if it doesn't clear the number. If this time isn't 0,
    /// an access through a client that cannot wait fails with [`Error::NoClock`].
    pub wait: u16,
}

impl Handshake {
    /// The device has completed the access when it replies.
    pub const NONE: Self = Self { polls: 0, wait: 0 };

    /// Creates the handshake of a device that clears the number to 0. The client polls at most `polls` times.
    #[must_use]
    pub const fn cleared(polls: u16) -> Self {
        Self { polls, wait: 0 }
    }

    /// Creates the handshake of a device that needs `wait` milliseconds.
    #[must_use]
    pub const fn after(wait: u16) -> Self {
        Self { polls: 0, wait }
    }

    const fn time(self) -> Duration {
        Duration::from_millis(self.wait as u64)
    }
}

/// Window for reading: an address for the number of a value, and an address for the value.
///
/// A read writes the number, waits according to the [`Handshake`] and reads the value. The width of the value is
/// converted as in [`Resized`](crate::Resized).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ReadWindow<A> {
    /// Address to which the number is written.
    pub number: A,
    /// Width of the number in bits.
    pub number_bits: u8,
    /// Address from which the value is read.
    pub value: A,
    /// Width of the value in bits.
    pub value_bits: u8,
    /// Specifies how the device reports that the value is available.
    pub handshake: Handshake,
}

/// Window for writing: an address for the number of a value, and an address for the value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct WriteWindow<A> {
    /// Address to which the number is written.
    pub number: A,
    /// Width of the number in bits.
    pub number_bits: u8,
    /// Address to which the value is written.
    pub value: A,
    /// Width of the value in bits.
    pub value_bits: u8,
    /// True if the number is written before the value. In a process image, the number and the value are sent in one
    /// cycle.
    pub is_number_first: bool,
    /// Specifies how the device reports that it has accepted the value.
    pub handshake: Handshake,
}

/// Route through a [`ReadWindow`] or a [`WriteWindow`].
///
/// ```
/// use lexibus::{CanOpen, Client, Error, Flags, Handshake, Initial, Item, Object, Range, ReadWindow, Ro, Through};
///
/// // The number is written to 0x2005:1. The device clears it when the value is in 0x2005:2.
/// const WINDOW: ReadWindow<Object> = ReadWindow {
///     number: Object::new(0x2005, 1),
///     number_bits: 16,
///     value: Object::new(0x2005, 2),
///     value_bits: 32,
///     handshake: Handshake::cleared(100),
/// };
/// lexibus::location! {
///     struct BehindWindow {
///         canopen: CanOpen => Through<ReadWindow<Object>>,
///     }
/// }
/// const LOCATION: BehindWindow = BehindWindow { canopen: Through::signed(0x8017, &WINDOW) };
/// const SPEED: Item<i16, Ro, BehindWindow> =
///     Item::new(LOCATION, "Master speed", Range::Full, Initial::Unknown, "", Flags::NONE);
///
/// # struct Node(u16);
/// # impl Client for Node {
/// #     type Bus = CanOpen;
/// #     type Error = core::convert::Infallible;
/// #     fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>> {
/// #         match object.sub_index {
/// #             1 => buffer.fill(0),
/// #             _ => buffer.copy_from_slice(&if self.0 == 0x8017 { (-5_i32).to_le_bytes() } else { [0; 4] }),
/// #         }
/// #         Ok(buffer.len())
/// #     }
/// #     fn write(&mut self, _: Object, data: &[u8]) -> Result<(), Error<Self::Error>> {
/// #         self.0 = u16::from_le_bytes([data[0], data[1]]);
/// #         Ok(())
/// #     }
/// # }
/// # let mut node = Node(0);
/// assert_eq!(SPEED.at(&mut node).read()?, -5);
/// # Ok::<(), Error<core::convert::Infallible>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Through<W: 'static> {
    /// Number of the value.
    pub number: u32,
    /// The window.
    pub window: &'static W,
    /// True if the value is in two's complement.
    pub is_signed: bool,
}

impl<W> Through<W> {
    /// Creates the route to a signed value.
    #[must_use]
    pub const fn signed(number: u32, window: &'static W) -> Self {
        Self { number, window, is_signed: true }
    }

    /// Creates the route to an unsigned value or a bit field.
    #[must_use]
    pub const fn unsigned(number: u32, window: &'static W) -> Self {
        Self { number, window, is_signed: false }
    }

    /// Returns the bytes of the number, the least significant byte first.
    fn number(&self) -> [u8; 8] {
        u64::from(self.number).to_le_bytes()
    }
}

/// Ignores [`Error::NoClock`]: without a clock, the client polls without pauses.
fn unless_no_clock<E>(waited: Result<(), Error<E>>) -> Result<(), Error<E>> {
    match waited {
        Err(Error::NoClock) => Ok(()),
        other => other,
    }
}

macro_rules! settle {
    ($settle:ident $Client:ident $($async:ident $await:ident)?) => {
        /// Waits until the device has completed the access.
        $($async)? fn $settle<C: $Client>(
            client: &mut C,
            number: <C::Bus as Bus>::Address,
            bits: u8,
            handshake: Handshake,
        ) -> Result<(), Error<C::Error>> {
            if handshake.polls == 0 {
                return if handshake.wait == 0 { Ok(()) } else { client.wait(handshake.time())$(.$await)? };
            }
            for poll in 0..handshake.polls {
                if poll > 0 {
                    unless_no_clock(client.wait(INTERVAL)$(.$await)?)?;
                }
                let mut raw = [0; 8];
                let raw = resized::truncated(&mut raw, bits.into());
                resized::check(raw.len(), client.read(number, raw)$(.$await)??)?;
                if raw.iter().all(|byte| *byte == 0) {
                    return Ok(());
                }
            }
            Err(Error::Timeout)
        }
    };
}

settle! { settle Client }
settle! { settle_async AsyncClient async await }

/// A value that is accessed through a window has no address.
impl<W> Route for Through<W> {}

impl<B: Bus> ReadRoute<B> for Through<ReadWindow<B::Address>> {
    #[inline]
    fn read_address(&self) -> Option<BusAddress> {
        Some(BusAddress::Number(self.number))
    }

    fn read<C: Client<Bus = B>>(&self, client: &mut C, buffer: &mut [u8]) -> Result<usize, Error<C::Error>> {
        let window = self.window;
        client.write(window.number, resized::truncated(&mut self.number(), window.number_bits.into()))?;
        settle(client, window.number, window.number_bits, window.handshake)?;
        let (mut raw, bits) = ([0; 8], window.value_bits.into());
        let raw = resized::truncated(&mut raw, bits);
        resized::check(raw.len(), client.read(window.value, raw)?)?;
        Ok(resized::read(raw, bits, self.is_signed, buffer)?)
    }

    async fn read_async<C: AsyncClient<Bus = B>>(
        &self,
        client: &mut C,
        buffer: &mut [u8],
    ) -> Result<usize, Error<C::Error>> {
        let window = self.window;
        client.write(window.number, resized::truncated(&mut self.number(), window.number_bits.into())).await?;
        settle_async(client, window.number, window.number_bits, window.handshake).await?;
        let (mut raw, bits) = ([0; 8], window.value_bits.into());
        let raw = resized::truncated(&mut raw, bits);
        resized::check(raw.len(), client.read(window.value, raw).await?)?;
        Ok(resized::read(raw, bits, self.is_signed, buffer)?)
    }
}

/// A write: the address, the bytes, and the number of used bits.
type Transfer<A> = (A, [u8; 8], u32);

impl<A: Copy> Through<WriteWindow<A>> {
    /// Returns the two writes in their order.
    fn writes(&self, data: &[u8]) -> Result<[Transfer<A>; 2], OutOfRange> {
        let window = self.window;
        let value = resized::written(data, window.value_bits.into(), self.is_signed)?;
        let number = (window.number, self.number(), window.number_bits.into());
        let value = (window.value, value, window.value_bits.into());
        Ok(if window.is_number_first { [number, value] } else { [value, number] })
    }
}

impl<B: Bus> WriteRoute<B> for Through<WriteWindow<B::Address>> {
    #[inline]
    fn write_address(&self) -> Option<BusAddress> {
        Some(BusAddress::Number(self.number))
    }

    fn write<C: Client<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>> {
        let [(first, mut one, bits), (second, mut other, other_bits)] = self.writes(data)?;
        let writes =
            [(first, &*resized::truncated(&mut one, bits)), (second, &*resized::truncated(&mut other, other_bits))];
        client.write_both(writes)?;
        settle(client, self.window.number, self.window.number_bits, self.window.handshake)
    }

    async fn write_async<C: AsyncClient<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>> {
        let [(first, mut one, bits), (second, mut other, other_bits)] = self.writes(data)?;
        let writes =
            [(first, &*resized::truncated(&mut one, bits)), (second, &*resized::truncated(&mut other, other_bits))];
        client.write_both(writes).await?;
        settle_async(client, self.window.number, self.window.number_bits, self.window.handshake).await
    }
}

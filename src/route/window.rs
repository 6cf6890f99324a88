//! Values that are reached through others: their number goes here, they come out there.

use core::time::Duration;

use super::{resized, ReadRoute, Route, WriteRoute};
use crate::bus::Bus;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::value_error::OutOfRange;

/// How long two looks at a number are apart that the device clears.
const INTERVAL: Duration = Duration::from_millis(1);

/// How a device says that it has done what a window was asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Handshake {
    /// Where the device sets the number to 0: how often that is looked for, 1 ms apart where the client
    /// [can wait](Client::wait). 0 where the device doesn't do that.
    pub polls: u16,
    /// How many milliseconds the device needs, where it sets nothing to 0. A client that can't wait fails with
    /// [`Error::NoClock`] then.
    pub wait: u16,
}

impl Handshake {
    /// The device is as quick as its answers.
    pub const NONE: Self = Self { polls: 0, wait: 0 };

    /// The device sets the number to 0, which is looked for so often.
    #[must_use]
    pub const fn cleared(polls: u16) -> Self {
        Self { polls, wait: 0 }
    }

    /// The device needs so many milliseconds.
    #[must_use]
    pub const fn after(wait: u16) -> Self {
        Self { polls: 0, wait }
    }

    const fn time(self) -> Duration {
        Duration::from_millis(self.wait as u64)
    }
}

/// What takes the number of a value, and what has the value then.
///
/// Clears and waits as the [`Handshake`] says; the value of the item is fitted to that of the window as by
/// [`Resized`](crate::Resized).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ReadWindow<A> {
    /// What takes the number.
    pub number: A,
    /// Bits of the number.
    pub number_bits: u8,
    /// What has the value.
    pub value: A,
    /// Bits of the value.
    pub value_bits: u8,
    /// How the device says that the value is there.
    pub handshake: Handshake,
}

/// What takes the number of a value, and the value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct WriteWindow<A> {
    /// What takes the number.
    pub number: A,
    /// Bits of the number.
    pub number_bits: u8,
    /// What takes the value.
    pub value: A,
    /// Bits of the value.
    pub value_bits: u8,
    /// Whether the number is written before the value. In a process image both go out in one cycle.
    pub is_number_first: bool,
    /// How the device says that it has taken the value.
    pub handshake: Handshake,
}

/// A value behind a [`ReadWindow`] or a [`WriteWindow`].
///
/// ```
/// use lexibus::{CanOpen, Client, Error, Flags, Handshake, Initial, Item, Object, Range, ReadWindow, Ro, Through};
///
/// // Number to 0x2005:1, which the device clears once the value is in 0x2005:2.
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
    /// The number of the value.
    pub number: u32,
    /// The window.
    pub window: &'static W,
    /// Whether the value is in two's complement.
    pub is_signed: bool,
}

impl<W> Through<W> {
    /// A value in two's complement.
    #[must_use]
    pub const fn signed(number: u32, window: &'static W) -> Self {
        Self { number, window, is_signed: true }
    }

    /// A value without a sign, or bits.
    #[must_use]
    pub const fn unsigned(number: u32, window: &'static W) -> Self {
        Self { number, window, is_signed: false }
    }

    /// The bytes of the number, of which those count that `bits` bits take.
    fn number(&self) -> [u8; 8] {
        u64::from(self.number).to_le_bytes()
    }
}

/// Without a clock, the transfers themselves are the time.
fn unless_no_clock<E>(waited: Result<(), Error<E>>) -> Result<(), Error<E>> {
    match waited {
        Err(Error::NoClock) => Ok(()),
        other => other,
    }
}

macro_rules! settle {
    ($settle:ident $Client:ident $($async:ident $await:ident)?) => {
        /// Waits until the device has done it.
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
                let raw = resized::room(&mut raw, bits.into());
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

/// A window is no address of the value's own.
impl<W> Route for Through<W> {}

impl<B: Bus> ReadRoute<B> for Through<ReadWindow<B::Address>> {
    fn read<C: Client<Bus = B>>(&self, client: &mut C, buffer: &mut [u8]) -> Result<usize, Error<C::Error>> {
        let window = self.window;
        client.write(window.number, resized::room(&mut self.number(), window.number_bits.into()))?;
        settle(client, window.number, window.number_bits, window.handshake)?;
        let (mut raw, bits) = ([0; 8], window.value_bits.into());
        let raw = resized::room(&mut raw, bits);
        resized::check(raw.len(), client.read(window.value, raw)?)?;
        Ok(resized::read(raw, bits, self.is_signed, buffer)?)
    }

    async fn read_async<C: AsyncClient<Bus = B>>(
        &self,
        client: &mut C,
        buffer: &mut [u8],
    ) -> Result<usize, Error<C::Error>> {
        let window = self.window;
        client.write(window.number, resized::room(&mut self.number(), window.number_bits.into())).await?;
        settle_async(client, window.number, window.number_bits, window.handshake).await?;
        let (mut raw, bits) = ([0; 8], window.value_bits.into());
        let raw = resized::room(&mut raw, bits);
        resized::check(raw.len(), client.read(window.value, raw).await?)?;
        Ok(resized::read(raw, bits, self.is_signed, buffer)?)
    }
}

/// Address, bytes, and how many bits of them count.
type Transfer<A> = (A, [u8; 8], u32);

impl<A: Copy> Through<WriteWindow<A>> {
    /// What is written where, in this order.
    fn writes(&self, data: &[u8]) -> Result<[Transfer<A>; 2], OutOfRange> {
        let window = self.window;
        let value = resized::written(data, window.value_bits.into(), self.is_signed)?;
        let number = (window.number, self.number(), window.number_bits.into());
        let value = (window.value, value, window.value_bits.into());
        Ok(if window.is_number_first { [number, value] } else { [value, number] })
    }
}

impl<B: Bus> WriteRoute<B> for Through<WriteWindow<B::Address>> {
    fn write<C: Client<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>> {
        let [(first, mut one, bits), (second, mut other, other_bits)] = self.writes(data)?;
        let writes = [(first, &*resized::room(&mut one, bits)), (second, &*resized::room(&mut other, other_bits))];
        client.write_both(writes)?;
        settle(client, self.window.number, self.window.number_bits, self.window.handshake)
    }

    async fn write_async<C: AsyncClient<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>> {
        let [(first, mut one, bits), (second, mut other, other_bits)] = self.writes(data)?;
        let writes = [(first, &*resized::room(&mut one, bits)), (second, &*resized::room(&mut other, other_bits))];
        client.write_both(writes).await?;
        settle_async(client, self.window.number, self.window.number_bits, self.window.handshake).await
    }
}

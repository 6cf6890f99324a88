//! Routes: how the value of an item is transferred on one bus, through its address or indirectly.

use crate::bus::{Bus, EscMemory, Object, Parameter, Record};
use crate::bus_address::BusAddress;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::image_field::ImageField;
use crate::register::Register;

pub use limited::Limited;
pub use resized::Resized;
pub use window::{Handshake, ReadWindow, Through, WriteWindow};

/// Methods that return the address of a route, and whether the route converts the width, for tools such as the
/// simulator. A route through a window has no address.
pub trait Route {
    /// Returns the entry of the object dictionary, on CANopen or on CANopen over EtherCAT; `None` for all other routes.
    fn object(&self) -> Option<Object> {
        None
    }

    /// Returns the Modbus register; `None` if the route has none.
    fn register(&self) -> Option<Register> {
        None
    }

    /// Returns whether a [`Resized`] route converts the width of the value between the bus and the item.
    fn is_resized(&self) -> bool {
        false
    }
}

impl Route for Object {
    fn object(&self) -> Option<Object> {
        Some(*self)
    }
}

impl Route for Register {
    fn register(&self) -> Option<Register> {
        Some(*self)
    }
}

impl Route for Record {}
impl Route for Parameter {}
impl Route for ImageField {}
impl Route for EscMemory {}

/// A route that consists of an address on bus `B`.
#[diagnostic::on_unimplemented(
    message = "this item has no direct address on `{B}`",
    label = "on the client's bus, this item is accessed through a window or has another width"
)]
pub trait Direct<B: Bus>: Copy {
    /// Returns the address.
    fn address(self) -> B::Address;
}

/// A route that can read a value. Every address is a route. [`Split`], [`Resized`] and [`Limited`] are routes that
/// contain other routes. [`Through`] is a route through a window.
#[diagnostic::on_unimplemented(
    message = "this item cannot be read on `{B}`",
    label = "the client's bus has no route that reads this item"
)]
pub trait ReadRoute<B: Bus>: Copy {
    /// Returns the address, or the number of a value in a window, for error messages. The default implementation
    /// returns `None`.
    #[inline]
    fn read_address(&self) -> Option<BusAddress> {
        None
    }

    /// Reads the value into the start of `buffer` and returns its length, as [`Client::read`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of the client and of the route.
    fn read<C: Client<Bus = B>>(&self, client: &mut C, buffer: &mut [u8]) -> Result<usize, Error<C::Error>>;

    /// Reads the value without blocking, as [`read`](Self::read) does.
    ///
    /// # Errors
    ///
    /// Returns the errors of the client and of the route.
    #[allow(async_fn_in_trait)]
    async fn read_async<C: AsyncClient<Bus = B>>(
        &self,
        client: &mut C,
        buffer: &mut [u8],
    ) -> Result<usize, Error<C::Error>>;
}

/// A route that can write a value.
#[diagnostic::on_unimplemented(
    message = "this item cannot be written on `{B}`",
    label = "the client's bus has no route that writes this item"
)]
pub trait WriteRoute<B: Bus>: Copy {
    /// Returns the address, or the number of a value in a window, for error messages. The default implementation
    /// returns `None`.
    #[inline]
    fn write_address(&self) -> Option<BusAddress> {
        None
    }

    /// Writes the value, as [`Client::write`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of the client and of the route.
    fn write<C: Client<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>>;

    /// Writes the value without blocking, as [`write`](Self::write) does.
    ///
    /// # Errors
    ///
    /// Returns the errors of the client and of the route.
    #[allow(async_fn_in_trait)]
    async fn write_async<C: AsyncClient<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>>;
}

/// Defines the methods of a [`ReadRoute`] that delegates to `self.$route`.
macro_rules! read_by {
    ($route:tt) => {
        #[inline]
        fn read_address(&self) -> Option<BusAddress> {
            self.$route.read_address()
        }

        #[inline]
        fn read<C: Client<Bus = B>>(&self, client: &mut C, buffer: &mut [u8]) -> Result<usize, Error<C::Error>> {
            self.$route.read(client, buffer)
        }

        async fn read_async<C: AsyncClient<Bus = B>>(
            &self,
            client: &mut C,
            buffer: &mut [u8],
        ) -> Result<usize, Error<C::Error>> {
            self.$route.read_async(client, buffer).await
        }
    };
}

macro_rules! direct {
    ($($address:ty),*) => {$(
        impl<B: Bus<Address = $address>> Direct<B> for $address {
            fn address(self) -> $address {
                self
            }
        }

        impl<B: Bus<Address = $address>> ReadRoute<B> for $address {
            #[inline]
            fn read_address(&self) -> Option<BusAddress> {
                Some((*self).into())
            }

            #[inline]
            fn read<C: Client<Bus = B>>(&self, client: &mut C, buffer: &mut [u8]) -> Result<usize, Error<C::Error>> {
                client.read(*self, buffer)
            }

            async fn read_async<C: AsyncClient<Bus = B>>(
                &self,
                client: &mut C,
                buffer: &mut [u8],
            ) -> Result<usize, Error<C::Error>> {
                client.read(*self, buffer).await
            }
        }

        impl<B: Bus<Address = $address>> WriteRoute<B> for $address {
            #[inline]
            fn write_address(&self) -> Option<BusAddress> {
                Some((*self).into())
            }

            #[inline]
            fn write<C: Client<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>> {
                client.write(*self, data)
            }

            async fn write_async<C: AsyncClient<Bus = B>>(
                &self,
                client: &mut C,
                data: &[u8],
            ) -> Result<(), Error<C::Error>> {
                client.write(*self, data).await
            }
        }
    )*};
}

direct!(Object, Register, Record, Parameter, ImageField, EscMemory);

mod limited;
mod resized;
mod window;

/// Marks the direction in which a [`Split`] allows no access.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Closed;

/// Route that combines a route for reading with a different route for writing. An access in a [`Closed`] direction
/// causes a compile-time error.
///
/// ```
/// use lexibus::{CanOpen, Closed, Object, ReadRoute, Split, WriteRoute};
///
/// // In CiA 402, the mode of operation has one object for writing and another one for reading.
/// const MODE: Split<Object, Object> = Split { read: Object::new(0x6061, 0), write: Object::new(0x6060, 0) };
/// // This value is read-only.
/// const STATUS: Split<Object, Closed> = Split::reading(Object::new(0x6041, 0));
///
/// fn both_ways(_: impl ReadRoute<CanOpen> + WriteRoute<CanOpen>) {}
/// fn to_be_read(_: impl ReadRoute<CanOpen>) {}
/// both_ways(MODE);
/// to_be_read(STATUS);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Split<R, W> {
    /// Route for reading.
    pub read: R,
    /// Route for writing.
    pub write: W,
}

impl<R, W> Split<R, W> {
    /// Creates a route that uses `read` for reading and `write` for writing.
    #[must_use]
    pub const fn new(read: R, write: W) -> Self {
        Self { read, write }
    }
}

impl<R> Split<R, Closed> {
    /// Creates a read-only route.
    #[must_use]
    pub const fn reading(read: R) -> Self {
        Self { read, write: Closed }
    }
}

impl<W> Split<Closed, W> {
    /// Creates a write-only route.
    #[must_use]
    pub const fn writing(write: W) -> Self {
        Self { read: Closed, write }
    }
}

impl Route for Closed {}

impl<R: Route, W: Route> Route for Split<R, W> {
    fn object(&self) -> Option<Object> {
        self.read.object().or_else(|| self.write.object())
    }

    fn register(&self) -> Option<Register> {
        self.read.register().or_else(|| self.write.register())
    }

    fn is_resized(&self) -> bool {
        self.read.is_resized() || self.write.is_resized()
    }
}

impl<B: Bus, R: ReadRoute<B>, W: Copy> ReadRoute<B> for Split<R, W> {
    read_by!(read);
}

impl<B: Bus, R: Copy, W: WriteRoute<B>> WriteRoute<B> for Split<R, W> {
    #[inline]
    fn write_address(&self) -> Option<BusAddress> {
        self.write.write_address()
    }

    #[inline]
    fn write<C: Client<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>> {
        self.write.write(client, data)
    }

    async fn write_async<C: AsyncClient<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>> {
        self.write.write_async(client, data).await
    }
}

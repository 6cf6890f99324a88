//! Error of an access to an item.

use core::error;
use core::fmt;

use crate::bus_address::BusAddress;
use crate::error::Error;
use crate::raw_value::RawValue;
use crate::value_error::OutOfRange;

/// Error of an access that reads or writes an item. The error contains the reason, the name of the item and its address
/// on the bus. If the access writes a number, the error also contains this number. `E` is the error type of the client.
///
/// The `?` operator converts an access error to [`Error`], which contains only the reason.
///
/// ```
/// use lexibus::{Flags, Initial, Item, Object, OnCanOpen, Range, RawValue, Rw};
/// # use lexibus::{AbortCode, CanOpen, Client, Error};
///
/// const TARGET_POSITION: Item<i32, Rw, OnCanOpen> = Item::new(
///     OnCanOpen::canopen(0x607A, 0),
///     "Target position",
///     Range::Between(-200_000, 200_000),
///     Initial::Unknown,
///     "",
///     Flags::NONE,
/// );
///
/// # struct Node;
/// # impl Client for Node {
/// #     type Bus = CanOpen;
/// #     type Error = core::fmt::Error;
/// #     fn read(&mut self, _: Object, _: &mut [u8]) -> Result<usize, Error<Self::Error>> { Err(Error::Timeout) }
/// #     fn write(&mut self, _: Object, _: &[u8]) -> Result<(), Error<Self::Error>> { Err(Error::Timeout) }
/// # }
/// # let mut node = Node;
/// let error = TARGET_POSITION.at(&mut node).write(300_000).unwrap_err();
/// assert_eq!(error.to_string(), "write 300000 to Target position (0x607A:00): outside the range -200000 to 200000");
/// assert_eq!(error.value(), Some(RawValue::Signed(300_000)));
/// assert_eq!(error.address(), Some(Object::new(0x607A, 0).into()));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct AccessError<E> {
    /// Reason why the access failed.
    pub error: Error<E>,
    name: &'static str,
    address: Option<BusAddress>,
    access: Access,
    form: Form,
    /// Value, minimum and maximum; 0 if the access has no such number. If the access has no value, the first number is
    /// the number of [other items](Self::others). Floating-point numbers are stored as the bits of an `f64`.
    numbers: [u64; 3],
}

/// The access that failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Access {
    Read,
    /// A write whose value isn't stored, for example because it isn't a number.
    Write,
    WriteNumber,
    /// A write of a number that is outside the range of the item, or in a gap of the range.
    OutOfRange,
    /// A write of a physical value whose raw value doesn't fit the type of the item or has a special meaning.
    Unscalable,
}

/// [`RawValue`] variant of the numbers in an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Form {
    Signed,
    Unsigned,
    Real,
}

#[inline]
fn bits(value: RawValue) -> (Form, u64) {
    match value {
        RawValue::Signed(value) => (Form::Signed, value as u64),
        RawValue::Unsigned(value) => (Form::Unsigned, value),
        RawValue::Real(value) => (Form::Real, value.to_bits()),
    }
}

/// Name and address of the item that the failed access reads or writes.
pub(crate) type AccessedItem = (&'static str, Option<BusAddress>);

// The constructors are always inlined, so that the compiler removes the parts of an error that the program doesn't use,
// with the name of the item. An outlined function would store all of them.
impl<E> AccessError<E> {
    #[inline]
    const fn new(error: Error<E>, item: AccessedItem, access: Access, form: Form, numbers: [u64; 3]) -> Self {
        Self { error, name: item.0, address: item.1, access, form, numbers }
    }

    /// Creates the error for a failed read.
    #[inline(always)]
    pub(crate) fn read(error: Error<E>, item: AccessedItem) -> Self {
        Self::new(error, item, Access::Read, Form::Unsigned, [0; 3])
    }

    /// Creates the error for a failed write. `value` is `None` if the value isn't a number.
    #[inline(always)]
    pub(crate) fn write(error: Error<E>, item: AccessedItem, value: Option<RawValue>) -> Self {
        match value.map(bits) {
            Some((form, value)) => Self::new(error, item, Access::WriteNumber, form, [value, 0, 0]),
            None => Self::new(error, item, Access::Write, Form::Unsigned, [0; 3]),
        }
    }

    /// Returns the error with the number of other items that the request reads or writes. The error must have no value.
    pub(crate) fn with_others(self, count: usize) -> Self {
        Self { numbers: [count as u64, 0, 0], ..self }
    }

    /// Creates the error for a write whose value is not in the range of the item, or doesn't fit its type.
    #[inline(always)]
    pub(crate) fn out_of_range(item: AccessedItem, value: Option<RawValue>, limits: Option<[RawValue; 2]>) -> Self {
        let error = OutOfRange.into();
        let (Some(value), Some(limits)) = (value, limits) else { return Self::write(error, item, value) };
        let (form, value) = bits(value);
        Self::new(error, item, Access::OutOfRange, form, [value, bits(limits[0]).1, bits(limits[1]).1])
    }

    /// Creates the error for a write whose physical value has no raw value.
    #[inline(always)]
    pub(crate) fn unscalable(item: AccessedItem, physical: f64, limits: Option<[RawValue; 2]>) -> Self {
        let error = OutOfRange.into();
        let Some([low, high]) = limits else { return Self::write(error, item, None) };
        let (form, low) = bits(low);
        Self::new(error, item, Access::Unscalable, form, [physical.to_bits(), low, bits(high).1])
    }
}

impl<E> AccessError<E> {
    /// Returns the name of the item in the device description.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Returns the address of the item on the client's bus, or `None` if the route of the item has no address. For an
    /// access through an [`Axis`](crate::Axis), returns the address on the first axis.
    #[must_use]
    pub const fn address(&self) -> Option<BusAddress> {
        self.address
    }

    /// Returns the number of other items that the failed request reads or writes. The number is 0 unless the request
    /// belongs to a [block](crate::modbus::RegisterClient::read_block). In a block, the [address](Self::address) covers
    /// all registers of the request.
    #[must_use]
    pub const fn others(&self) -> usize {
        match self.access {
            Access::Read | Access::Write => self.numbers[0] as usize,
            Access::WriteNumber | Access::OutOfRange | Access::Unscalable => 0,
        }
    }

    /// Returns whether the access was a write.
    #[must_use]
    pub const fn is_write(&self) -> bool {
        !matches!(self.access, Access::Read)
    }

    /// Returns the raw value of a write. Returns `None` for a read, for a value that isn't a number, for a physical
    /// value without a raw value, and for a request that writes several items.
    #[must_use]
    pub fn value(&self) -> Option<RawValue> {
        match self.access {
            Access::WriteNumber | Access::OutOfRange => Some(self.number(0)),
            Access::Read | Access::Write | Access::Unscalable => None,
        }
    }

    /// Returns the physical value of a write that failed because the raw value doesn't fit the type of the item or has
    /// a special meaning.
    #[must_use]
    pub fn physical(&self) -> Option<f64> {
        match self.access {
            Access::Unscalable => Some(f64::from_bits(self.numbers[0])),
            _ => None,
        }
    }

    /// Returns the minimum and the maximum of the item as raw values, if the access failed because of the written
    /// value. The written value is then outside the range, in a gap of the range, or a [physical value](Self::physical)
    /// without a raw value.
    #[must_use]
    pub fn range(&self) -> Option<(RawValue, RawValue)> {
        match self.access {
            Access::OutOfRange | Access::Unscalable => Some((self.number(1), self.number(2))),
            Access::Read | Access::Write | Access::WriteNumber => None,
        }
    }

    fn number(&self, at: usize) -> RawValue {
        let bits = self.numbers.get(at).copied().unwrap_or_default();
        match self.form {
            Form::Signed => RawValue::Signed(bits as i64),
            Form::Unsigned => RawValue::Unsigned(bits),
            Form::Real => RawValue::Real(f64::from_bits(bits)),
        }
    }

    fn fmt_access(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.value(), self.physical()) {
            (Some(value), _) => write!(f, "write {value} to ")?,
            (None, Some(physical)) => write!(f, "write the physical value {physical} to ")?,
            (None, None) => f.write_str(if self.is_write() { "write " } else { "read " })?,
        }
        f.write_str(self.name)?;
        match self.others() {
            0 => {}
            1 => f.write_str(" and 1 other item")?,
            others => write!(f, " and {others} other items")?,
        }
        match self.address {
            Some(address) => write!(f, " ({address}): "),
            None => f.write_str(": "),
        }
    }
}

impl<E: fmt::Display> fmt::Display for AccessError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.fmt_access(f)?;
        let Some((low, high)) = self.range() else { return self.error.fmt(f) };
        match self.value() {
            None => write!(f, "the raw value is outside the range {low} to {high}, or has a special meaning"),
            Some(value) if low <= value && value <= high => {
                write!(f, "not one of the allowed values in the range {low} to {high}")
            }
            Some(_) => write!(f, "outside the range {low} to {high}"),
        }
    }
}

impl<E: fmt::Debug> fmt::Debug for AccessError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut fields = f.debug_struct("AccessError");
        fields.field("error", &self.error).field("name", &self.name).field("address", &self.address);
        fields.field("is_write", &self.is_write()).field("value", &self.value()).field("physical", &self.physical());
        fields.field("range", &self.range()).finish()
    }
}

impl<E: error::Error> error::Error for AccessError<E> {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        self.error.source()
    }
}

impl<E> From<AccessError<E>> for Error<E> {
    #[inline]
    fn from(error: AccessError<E>) -> Self {
        error.error
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        AbortCode, CanOpen, Client, Error, Flags, Handshake, Initial, Item, Limited, Location, Object, OnCanOpen,
        OutOfRange, Range, ReadWindow, Route, Rw, Scaled, Split, Through, TimeOfDay, Value, VisibleString,
    };
    use core::fmt::Error as BusFault;
    use std::format;
    use std::string::{String, ToString};

    /// A device that refuses each access with this error.
    struct Refusing(Error<BusFault>);

    impl Client for Refusing {
        type Bus = CanOpen;
        type Error = BusFault;

        fn read(&mut self, _: Object, _: &mut [u8]) -> Result<usize, Error<BusFault>> {
            Err(self.0)
        }

        fn write(&mut self, _: Object, _: &[u8]) -> Result<(), Error<BusFault>> {
            Err(self.0)
        }
    }

    const REFUSING: Refusing = Refusing(Error::Timeout);

    const fn item<V: Value>(range: Range<V::Native>) -> Item<V, Rw, OnCanOpen> {
        Item::new(OnCanOpen::canopen(0x2001, 3), "Gain", range, Initial::Unknown, "", Flags::NONE)
    }

    fn text<T, E: fmt::Display>(result: Result<T, AccessError<E>>) -> String {
        result.err().expect("an error").to_string()
    }

    #[test]
    fn values_outside_of_their_range() {
        let write = |range, value| text(item::<i16>(range).at(&mut { REFUSING }).write(value));
        assert_eq!(write(Range::From(5), 4), "write 4 to Gain (0x2001:03): outside the range 5 to 32767");
        assert_eq!(write(Range::To(5), 6), "write 6 to Gain (0x2001:03): outside the range -32768 to 5");
        let gaps = Range::OneOf(&[(6, 7), (-2, 1)]);
        assert_eq!(write(gaps, 8), "write 8 to Gain (0x2001:03): outside the range -2 to 7");
        assert_eq!(write(gaps, 3), "write 3 to Gain (0x2001:03): not one of the allowed values in the range -2 to 7");
        let wide = text(item::<crate::Uint<3>>(Range::Full).at(&mut { REFUSING }).write(9));
        assert_eq!(wide, "write 9 to Gain (0x2001:03): outside the range 0 to 7");
        let real = text(item::<f32>(Range::To(0.5)).at(&mut { REFUSING }).write(f32::NAN));
        assert_eq!(real, "write NaN to Gain (0x2001:03): outside the range -inf to 0.5");
        let time = TimeOfDay { milliseconds: u32::MAX, days: 0 };
        let time = text(item::<TimeOfDay>(Range::Full).at(&mut { REFUSING }).write(time));
        assert_eq!(time, "write Gain (0x2001:03): value out of range");
    }

    #[test]
    fn physical_values() {
        let range = Range::Between(0, 1500);
        let write = |value| item::<Scaled<u16, 1, 100>>(range).at(&mut { REFUSING }).write_scaled(value);
        assert_eq!(text(write(15.01)), "write 1501 to Gain (0x2001:03): outside the range 0 to 1500");
        let error = write(-1.5).unwrap_err();
        let expected =
            "write the physical value -1.5 to Gain (0x2001:03): the raw value is outside the range 0 to 1500, \
                        or has a special meaning";
        assert_eq!(error.to_string(), expected);
        assert_eq!((error.value(), error.physical()), (None, Some(-1.5)));
        assert_eq!(error.range(), Some((RawValue::Unsigned(0), RawValue::Unsigned(1500))));
    }

    #[test]
    fn refusals_by_the_device() {
        let mut device = Refusing(AbortCode::READ_ONLY.into());
        let refused = "the device refused: 0x06010002: attempt to write a read-only object";
        let error = item::<bool>(Range::Full).at(&mut device).write(true).unwrap_err();
        assert_eq!(error.to_string(), format!("write 1 to Gain (0x2001:03): {refused}"));
        assert_eq!((error.name(), error.is_write(), error.value()), ("Gain", true, Some(RawValue::Unsigned(1))));
        assert_eq!((error.error, error.range()), (Error::Abort(AbortCode::READ_ONLY), None));
        let error = item::<u8>(Range::Full).at(&mut device).read().unwrap_err();
        assert_eq!(error.to_string(), format!("read Gain (0x2001:03): {refused}"));
        assert_eq!((error.is_write(), error.value()), (false, None));
        let error = item::<VisibleString>(Range::Full).at(&mut device).write("text").unwrap_err();
        assert_eq!(error.to_string(), format!("write Gain (0x2001:03): {refused}"));
        assert_eq!(Error::from(error), Error::Abort(AbortCode::READ_ONLY));
    }

    #[test]
    fn the_error_of_the_client_is_the_source() {
        let error = item::<u8>(Range::Full).at(&mut Refusing(Error::Client(BusFault))).read().unwrap_err();
        assert!(error::Error::source(&error).is_none());
        assert!(format!("{error:?}").starts_with("AccessError { error: Client(Error), name: \"Gain\", address: Some"));
    }

    #[test]
    fn addresses_of_routes() {
        const WINDOW: ReadWindow<Object> = ReadWindow {
            number: Object::new(0x2005, 1),
            number_bits: 16,
            value: Object::new(0x2005, 2),
            value_bits: 32,
            handshake: Handshake::NONE,
        };
        crate::location! { struct Both { canopen: CanOpen => Split<Object, Limited<Object>> } }
        crate::location! { struct Window { canopen: CanOpen => Through<ReadWindow<Object>> } }
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        struct NoAddress;
        impl Route for NoAddress {}
        impl crate::ReadRoute<CanOpen> for NoAddress {
            fn read<C: Client<Bus = CanOpen>>(&self, _: &mut C, _: &mut [u8]) -> Result<usize, Error<C::Error>> {
                Err(Error::Refused)
            }
            async fn read_async<C>(&self, _: &mut C, _: &mut [u8]) -> Result<usize, Error<C::Error>>
            where
                C: crate::AsyncClient<Bus = CanOpen>,
            {
                Err(Error::Refused)
            }
        }
        crate::location! { struct Nowhere { canopen: CanOpen => NoAddress } }
        fn on<L: Location>(location: L) -> Item<u8, Rw, L> {
            Item::new(location, "Mode", Range::Full, Initial::Unknown, "", Flags::NONE)
        }
        let route = Split::new(Object::new(0x6061, 0), Limited::new(Object::new(0x6060, 0), false, &[(1, 3)]));
        assert!(text(on(Both::new(route)).at(&mut { REFUSING }).read()).starts_with("read Mode (0x6061:00): timeout"));
        let error = on(Both::new(route)).at(&mut { REFUSING }).write(4).unwrap_err();
        assert_eq!(error.to_string(), "write 4 to Mode (0x6060:00): value out of range");
        assert_eq!(error.error, Error::OutOfRange(OutOfRange));
        let read = text(on(Window::new(Through::unsigned(0x17, &WINDOW))).at(&mut { REFUSING }).read());
        assert!(read.starts_with("read Mode (number 0x17): timeout"), "{read}");
        let read = text(on(Nowhere::new(NoAddress)).at(&mut { REFUSING }).read());
        assert_eq!(read, "read Mode: the device refused");
    }
}

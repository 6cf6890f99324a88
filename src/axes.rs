//! Devices with several axes: addresses of the objects of each axis.

use core::time::Duration;

use crate::bus::{Bus, CanOpen, CoE, Object};
use crate::client::{AsyncClient, Client};
use crate::error::Error;

/// Number of axes of a device, and the rules that map an object of the first axis to the other axes.
///
/// ```
/// use lexibus::{Axes, AxisRange, AxisStep, Object};
///
/// const AXES: Axes = Axes {
///     count: 2,
///     ranges: &[AxisRange { first: 0x6000, last: 0x67FF, step: AxisStep::Index(0x800) }],
///     shared: &[Object::new(0x6502, 0)],
/// };
/// let target_position = Object::new(0x607A, 0);
/// assert_eq!(AXES.object(2, target_position), Some(Object::new(0x687A, 0)));
/// assert_eq!(AXES.object(3, target_position), None);
/// assert_eq!(AXES.object(2, Object::new(0x6502, 0)), Some(Object::new(0x6502, 0)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axes {
    /// The number of axes.
    pub count: u8,
    /// Rules for the addresses on the next axis, one rule per index range. The first range that contains an index
    /// applies.
    pub ranges: &'static [AxisRange],
    /// Objects within `ranges` that all axes share, in ascending order of address.
    pub shared: &'static [Object],
}

/// Range of indices, with the rule for the addresses on the next axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AxisRange {
    /// First index of the range.
    pub first: u16,
    /// Last index of the range.
    pub last: u16,
    /// Rule for the addresses on the next axis.
    pub step: AxisStep,
}

/// Rule that converts the address of an object on one axis to its address on the next axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisStep {
    /// On the next axis, the index is higher by this number (CiA 402-2: 0x800).
    Index(u16),
    /// The sub-index is the axis number.
    SubIndex,
    /// On the next axis, the sub-index is higher by this number, except for sub-index 0.
    SubIndexStride(u8),
}

impl Axes {
    /// Returns the address on axis `axis` of `object`, which is an object of the first axis. Axis numbers start at 1.
    /// Shared objects and objects outside all ranges have the same address on every axis.
    ///
    /// Returns `None` if the axis doesn't exist or doesn't have the object. In a range with [`AxisStep::SubIndex`],
    /// further axes have only those objects that the first axis has at sub-index 1, and the shared objects.
    #[must_use]
    pub fn object(&self, axis: u8, object: Object) -> Option<Object> {
        if axis == 0 || axis > self.count {
            return None;
        }
        let contains = |range: &&AxisRange| (range.first..=range.last).contains(&object.index);
        let Some(range) = self.ranges.iter().find(contains) else { return Some(object) };
        if axis == 1 || self.shared.binary_search(&object).is_ok() {
            return Some(object);
        }
        let Object { index, sub_index } = object;
        let further = axis - 1;
        match range.step {
            AxisStep::Index(step) => {
                let index = index.checked_add(step.checked_mul(further.into())?)?;
                Some(Object { index, sub_index })
            }
            AxisStep::SubIndex => (sub_index == 1).then_some(Object { index, sub_index: axis }),
            // Sub-index 0 contains the number of entries, which all axes share.
            AxisStep::SubIndexStride(_) if sub_index == 0 => Some(object),
            AxisStep::SubIndexStride(step) => {
                let sub_index = sub_index.checked_add(step.checked_mul(further)?)?;
                Some(Object { index, sub_index })
            }
        }
    }
}

/// Client for one axis of a device. The client replaces the address of each object of the first axis by the object's
/// address on this axis. The method `axis` of generated devices creates this client.
///
/// This client supports only CANopen and CANopen over EtherCAT, because address rules exist only for object
/// dictionaries.
#[derive(Debug)]
pub struct Axis<C> {
    client: C,
    axes: &'static Axes,
    number: u8,
}

impl<C> Axis<C> {
    /// Creates the client for axis `number`; the first axis is 1. If the device doesn't have this axis, every access
    /// returns [`Error::NoSuchAxis`]. If the axis lacks an object of the first axis, an access to this object returns
    /// the same error.
    pub const fn new(client: C, axes: &'static Axes, number: u8) -> Self {
        Self { client, axes, number }
    }

    /// Returns the axis number; the first axis is 1.
    #[must_use]
    pub const fn number(&self) -> u8 {
        self.number
    }

    fn object<E>(&self, object: Object) -> Result<Object, Error<E>> {
        self.axes.object(self.number, object).ok_or(Error::NoSuchAxis { axis: self.number, object })
    }
}

/// A bus with address rules for further axes: CANopen or CANopen over EtherCAT.
#[diagnostic::on_unimplemented(
    message = "{Self} has no rule for the addresses of further axes",
    label = "this client's bus has no further axes",
    note = "axis rules apply to object dictionaries: use a client of CANopen or of CANopen over EtherCAT"
)]
pub trait AxisBus: Bus<Address = Object> {}

impl AxisBus for CanOpen {}
impl AxisBus for CoE {}

macro_rules! axis {
    ($Client:ident $($async:ident $await:ident)?) => {
        impl<C: $Client> $Client for Axis<C>
        where
            C::Bus: AxisBus,
        {
            type Bus = C::Bus;
            type Error = C::Error;

            $($async)? fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<C::Error>> {
                let address = self.object(address)?;
                self.client.read(address, buffer)$(.$await)?
            }

            $($async)? fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<C::Error>> {
                let address = self.object(address)?;
                self.client.write(address, data)$(.$await)?
            }

            $($async)? fn wait(&mut self, time: Duration) -> Result<(), Error<C::Error>> {
                self.client.wait(time)$(.$await)?
            }

            fn now(&mut self) -> Option<Duration> {
                self.client.now()
            }

            fn is_transient(&self, error: &C::Error) -> bool {
                self.client.is_transient(error)
            }
        }
    };
}

axis! { Client }
axis! { AsyncClient async await }

#[cfg(test)]
mod tests {
    use super::*;

    const AXES: Axes = Axes {
        count: 3,
        ranges: &[
            AxisRange { first: 0x23E8, last: 0x23E8, step: AxisStep::SubIndexStride(10) },
            AxisRange { first: 0x2000, last: 0x5FFF, step: AxisStep::SubIndex },
            AxisRange { first: 0x6000, last: 0xFFFF, step: AxisStep::Index(0x6000) },
        ],
        shared: &[Object::new(0x2100, 1), Object::new(0x6502, 0)],
    };

    fn found(axis: u8, index: u16, sub_index: u8) -> Option<(u16, u8)> {
        AXES.object(axis, Object { index, sub_index }).map(|object| (object.index, object.sub_index))
    }

    #[test]
    fn each_range_has_its_rule() {
        assert_eq!(found(2, 0x6040, 0), Some((0xC040, 0)));
        assert_eq!(found(3, 0x2000, 1), Some((0x2000, 3)));
        assert_eq!(found(3, 0x23E8, 6), Some((0x23E8, 26)));
        assert_eq!(found(3, 0x23E8, 0), Some((0x23E8, 0)));
        assert_eq!(found(1, 0x2000, 1), Some((0x2000, 1)));
    }

    #[test]
    fn what_is_shared_or_in_no_range_stays() {
        assert_eq!(found(3, 0x1018, 2), Some((0x1018, 2)));
        assert_eq!(found(3, 0x2100, 1), Some((0x2100, 1)));
        assert_eq!(found(2, 0x6502, 0), Some((0x6502, 0)));
    }

    #[test]
    fn what_no_axis_has_is_nowhere() {
        assert_eq!(found(0, 0x6040, 0), None);
        assert_eq!(found(4, 0x6040, 0), None);
        assert_eq!(found(4, 0x1018, 0), None);
        assert_eq!(found(2, 0x2000, 0), None);
        assert_eq!(found(2, 0x2000, 2), None);
        assert_eq!(found(3, 0x23E8, 250), None);
        assert_eq!(found(3, 0x6040, 0), None);
    }
}

//! Further axes of a device: the same objects at other addresses.

use core::time::Duration;

use crate::bus::{Bus, CanOpen, CoE, Object};
use crate::client::{AsyncClient, Client};
use crate::error::Error;

/// How many axes a device has, and how the objects of further ones follow from those of the first.
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
    /// Rules by range of index; the first that contains an index holds.
    pub ranges: &'static [AxisRange],
    /// Objects within those ranges that the axes share, sorted.
    pub shared: &'static [Object],
}

/// A range of indices, and how to get from one axis to the next in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AxisRange {
    /// The first index.
    pub first: u16,
    /// The last index.
    pub last: u16,
    /// How to get to the next axis.
    pub step: AxisStep,
}

/// How to get from an object of one axis to that of the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisStep {
    /// So much is added to the index (CiA 402-2: 0x800).
    Index(u16),
    /// The sub-index is the number of the axis.
    SubIndex,
    /// So much is added to the sub-index.
    SubIndexStride(u8),
}

impl Axes {
    /// Where axis `axis` (from 1) has what the first axis has at `object`. An object that the axes share, or that no range
    /// has, stays where it is.
    ///
    /// `None` where there is no such axis, or no such object of it: of [`AxisStep::SubIndex`], sub-index 0 isn't an
    /// axis's.
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
            // Sub-index 0 counts the entries of all axes.
            AxisStep::SubIndexStride(_) if sub_index == 0 => Some(object),
            AxisStep::SubIndexStride(step) => {
                let sub_index = sub_index.checked_add(step.checked_mul(further)?)?;
                Some(Object { index, sub_index })
            }
        }
    }
}

/// One axis of the device that `client` talks to: a client that finds the objects of the first axis at the addresses of
/// this one. Made by the method `axis` of generated devices.
///
/// Manuals give such rules for object dictionaries only, so an axis is on CANopen and on EtherCAT.
#[derive(Debug)]
pub struct Axis<C> {
    client: C,
    axes: &'static Axes,
    number: u8,
}

impl<C> Axis<C> {
    /// Axis `number`, from 1. Where there is no such axis, every access is an [`Error::NoSuchAxis`].
    pub const fn new(client: C, axes: &'static Axes, number: u8) -> Self {
        Self { client, axes, number }
    }

    /// The number of the axis, from 1.
    #[must_use]
    pub const fn number(&self) -> u8 {
        self.number
    }

    fn object<E>(&self, object: Object) -> Result<Object, Error<E>> {
        self.axes.object(self.number, object).ok_or(Error::NoSuchAxis { axis: self.number, object })
    }
}

/// A bus on which the objects of further axes have addresses that a rule gives: CANopen and EtherCAT.
#[diagnostic::on_unimplemented(
    message = "no rule says where further axes are on {Self}",
    label = "this client's bus has no further axes",
    note = "rules of axes are about object dictionaries: use a client of CANopen or of CANopen over EtherCAT"
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

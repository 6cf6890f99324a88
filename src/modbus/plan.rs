//! Planning of read requests.

use core::ops::Range;

use super::limits::Limits;
use crate::register::{Register, RegisterTable, WordOrder};
use crate::value_error::LengthError;

/// The read requests for `N` items. The number of requests is the minimum that the limits of the device allow.
///
/// The plan doesn't allocate. If the items are constants, the plan can be a constant.
///
/// ```
/// use lexibus::modbus::{Limits, Plan};
/// use lexibus::Register;
///
/// // The values of one cycle are consistent only if a single request reads all of them:
/// const CYCLE: [Register; 3] = [Register::low_first(12, 2), Register::holding(10), Register::holding(11)];
/// const _: () = assert!(matches!(Plan::new(CYCLE, &Limits::STANDARD), Ok(plan) if plan.len() == 1));
///
/// let plan = Plan::new(CYCLE, &Limits::STANDARD)?;
/// assert_eq!((plan.requests()[0].address, plan.requests()[0].count), (10, 4));
/// # Ok::<(), lexibus::LengthError>(())
/// ```
///
/// The register of an item is the field `modbus` of its location.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan<const N: usize> {
    /// The first `len` entries are the requests.
    requests: [Register; N],
    /// Index of the request for each item; `N` if the item isn't planned yet.
    request_of: [usize; N],
    len: usize,
}

impl<const N: usize> Plan<N> {
    /// Plans the requests for a device with these limits.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if an item has no registers, or if an item exceeds one request and the device doesn't
    /// allow a [split](super::TableLimits::split).
    #[expect(clippy::indexing_slicing, reason = "`at` and `first` are below `N`, and there are at most `N` requests")]
    pub const fn new(items: [Register; N], limits: &Limits) -> Result<Self, LengthError> {
        let mut at = 0;
        while at < N {
            if let Err(error) = check(&items[at], limits) {
                return Err(error);
            }
            at += 1;
        }
        let mut plan = Self { requests: items, request_of: [N; N], len: 0 };
        while let Some(first) = plan.leftmost(&items) {
            let start = items[first];
            let end = plan.reach(&items, first, limits);
            let (mut at, mut count) = (0, 0);
            while at < N {
                let is_within = is_alike(&items[at], &start) && end_of(&items[at]) <= end;
                if plan.request_of[at] == N && is_within || at == first {
                    plan.request_of[at] = plan.len;
                    count += 1;
                }
                at += 1;
            }
            plan.requests[plan.len] = if count == 1 { start } else { joined(&start, end) };
            plan.len += 1;
        }
        Ok(plan)
    }

    /// Returns the requests. The request for a single item is the register of this item. A request for several items
    /// reads bits or words in the order of their addresses ([`WordOrder::LowFirst`]).
    #[must_use]
    pub const fn requests(&self) -> &[Register] {
        self.requests.split_at(self.len).0
    }

    /// Returns the number of requests.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.len
    }

    /// Returns whether there are no requests.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Returns the index of the request for each item.
    pub(super) const fn request_of(&self) -> &[usize; N] {
        &self.request_of
    }

    /// Returns the index of the item at which the next request begins. This item has the lowest address among the
    /// unassigned items with the same table and the same number of registers per address as the first unassigned item.
    #[expect(clippy::indexing_slicing, reason = "`at` and `found` are below `N`")]
    const fn leftmost(&self, items: &[Register; N]) -> Option<usize> {
        let (mut at, mut found) = (0, N);
        while at < N {
            let is_better =
                found == N || is_alike(&items[at], &items[found]) && items[at].address < items[found].address;
            if self.request_of[at] == N && is_better {
                found = at;
            }
            at += 1;
        }
        if found == N {
            None
        } else {
            Some(found)
        }
    }

    /// Returns the address after the last address of the request that begins with item `first`. The request includes
    /// further items, and readable addresses between the items, up to the limit.
    #[expect(clippy::indexing_slicing, reason = "`at` and `first` are below `N`")]
    const fn reach(&self, items: &[Register; N], first: usize, limits: &Limits) -> u32 {
        let start = items[first];
        let max = limits.max_read(start.table);
        if start.count > max {
            // A value that is split into several requests is read alone.
            return start.address as u32;
        }
        let last = start.address as u32 + (max / start.step()) as u32;
        let mut end = end_of(&start);
        loop {
            let (mut at, mut further) = (0, end);
            while at < N {
                let (item, item_end) = (&items[at], end_of(&items[at]));
                if self.request_of[at] == N
                    && is_alike(item, &start)
                    && further < item_end
                    && item_end <= last
                    && is_known(items, &start, end..item.address as u32, limits)
                {
                    further = item_end;
                }
                at += 1;
            }
            if further == end {
                return end;
            }
            end = further;
        }
    }
}

/// Checks that one request can read the item, or several requests if the item may be split.
const fn check(item: &Register, limits: &Limits) -> Result<(), LengthError> {
    let max = limits.max_read(item.table);
    if item.count == 0 || item.count > max && !limits.of(item.table).split {
        return Err(LengthError::new(bytes(item.table, max), bytes(item.table, item.count)));
    }
    Ok(())
}

/// Returns the request for the addresses from `first` up to `end`, exclusive.
const fn joined(first: &Register, end: u32) -> Register {
    // The request is within the limit, so the count fits into 16 bits.
    let count = (end - first.address as u32) as u16 * first.step();
    Register {
        order: WordOrder::LowFirst,
        words_per_address: first.words_per_address,
        ..Register::new(first.table, first.address, count)
    }
}

/// Returns the address after an item.
const fn end_of(item: &Register) -> u32 {
    item.address as u32 + item.addresses() as u32
}

/// Returns whether two items have the same table and the same number of registers per address.
const fn is_alike(one: &Register, other: &Register) -> bool {
    one.table as u8 == other.table as u8 && one.step() == other.step()
}

/// Returns whether each address of a range belongs to an item or to a readable span.
#[expect(clippy::indexing_slicing, reason = "`at` is below the length")]
const fn is_known(items: &[Register], kind: &Register, addresses: Range<u32>, limits: &Limits) -> bool {
    let spans = limits.of(kind.table).readable;
    let mut address = addresses.start;
    while address < addresses.end {
        let (mut at, mut end) = (0, address);
        while at < items.len() {
            let item = &items[at];
            if is_alike(item, kind) && item.address as u32 <= address && end_of(item) > end {
                end = end_of(item);
            }
            at += 1;
        }
        at = 0;
        while at < spans.len() {
            let span = &spans[at];
            let is_alike = Register { words_per_address: span.words_per_address, ..*kind }.step() == kind.step();
            if is_alike && span.first as u32 <= address && span.last as u32 >= end {
                end = span.last as u32 + 1;
            }
            at += 1;
        }
        if end == address {
            return false;
        }
        address = end;
    }
    true
}

/// Returns the number of bytes for `count` registers or bits.
pub(super) const fn bytes(table: RegisterTable, count: u16) -> usize {
    match table {
        RegisterTable::Coil | RegisterTable::DiscreteInput => count.div_ceil(8) as usize,
        RegisterTable::Holding | RegisterTable::Input => 2 * count as usize,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modbus::{Span, TableLimits};

    const fn at(address: u16, count: u16) -> Register {
        Register::high_first(address, count)
    }

    const fn limits(holding: TableLimits) -> Limits {
        Limits { holding, ..Limits::STANDARD }
    }

    /// Asserts the address and count of each request.
    #[track_caller]
    fn requests<const N: usize>(items: [Register; N], limits: Limits, expected: &[(u16, u16)]) {
        let plan = Plan::new(items, &limits).unwrap();
        assert!(
            plan.requests().iter().map(|request| (request.address, request.count)).eq(expected.iter().copied()),
            "{plan:?}"
        );
    }

    #[test]
    fn what_follows_each_other() {
        requests([], Limits::STANDARD, &[]);
        requests([at(5, 1)], Limits::STANDARD, &[(5, 1)]);
        requests([at(12, 2), at(10, 2), at(14, 1), at(14, 1)], Limits::STANDARD, &[(10, 5)]);
        requests([at(12, 2), at(9, 2)], Limits::STANDARD, &[(9, 2), (12, 2)]);
        requests([at(0xFFFF, 1), at(0xFFFE, 1), at(0, 1)], Limits::STANDARD, &[(0, 1), (0xFFFE, 2)]);
    }

    #[test]
    fn tables_are_apart() {
        let input = Register::new(RegisterTable::Input, 11, 1);
        let coils = [Register::new(RegisterTable::Coil, 8, 1), Register::new(RegisterTable::Coil, 9, 1999)];
        requests([at(10, 1), input, at(12, 1)], Limits::STANDARD, &[(10, 1), (11, 1), (12, 1)]);
        requests(coils, Limits::STANDARD, &[(8, 2000)]);
    }

    #[test]
    fn gaps_that_can_be_read() {
        const HOLDING: TableLimits = TableLimits {
            readable: &[Span::new(10, 12), Span::new(13, 20), Span::new(30, 40)],
            ..TableLimits::HOLDING
        };
        requests([at(20, 1), at(9, 1)], limits(HOLDING), &[(9, 12)]);
        requests([at(22, 1), at(10, 1)], limits(HOLDING), &[(10, 1), (22, 1)]);
        requests([at(10, 1), at(30, 1)], limits(HOLDING), &[(10, 1), (30, 1)]);
        // The third item covers the undescribed addresses between the first two items.
        requests([at(10, 1), at(30, 1), at(21, 9)], limits(HOLDING), &[(10, 21)]);
        // The third item covers these addresses even if it is too long for the request.
        let narrow = TableLimits { max_read: 12, ..HOLDING };
        requests([at(19, 1), at(30, 1), at(20, 11)], limits(narrow), &[(19, 12)]);
        requests([at(19, 1), at(30, 1), at(20, 12)], limits(narrow), &[(19, 12), (20, 12)]);
    }

    #[test]
    fn limits_of_the_device() {
        let narrow = TableLimits { max_read: 4, ..TableLimits::HOLDING };
        requests([at(0, 2), at(2, 2), at(4, 2)], limits(narrow), &[(0, 4), (4, 2)]);
        requests([at(0, 2), at(2, 3), at(3, 1)], limits(narrow), &[(0, 4), (2, 3)]);
        assert_eq!(Plan::new([at(0, 1), at(2, 5)], &limits(narrow)), Err(LengthError::new(8, 10)));
        assert_eq!(Plan::new([at(0, 0)], &limits(narrow)), Err(LengthError::new(8, 0)));
        // A split item is read alone.
        requests(
            [at(2, 5), at(2, 1), at(7, 1)],
            limits(TableLimits { split: true, ..narrow }),
            &[(2, 5), (2, 1), (7, 1)],
        );
    }

    #[test]
    fn registers_of_32_bits() {
        let wide = |address, count| at(address, count).words_per_address(2);
        // Three registers of two words. The single word is the lower half of a register and is read alone.
        requests([wide(0x8002, 2), wide(0x8000, 2), wide(0x8001, 1)], Limits::STANDARD, &[(0x8000, 6)]);
        requests([wide(0x8002, 1), wide(0x8000, 1)], Limits::STANDARD, &[(0x8000, 1), (0x8002, 1)]);
        requests([wide(0x8002, 2), at(0x8001, 1)], Limits::STANDARD, &[(0x8002, 2), (0x8001, 1)]);
        const NARROW: TableLimits = TableLimits {
            max_read: 5,
            readable: &[Span::new(0, 9), Span::new(10, 19).words_per_address(2)],
            ..TableLimits::HOLDING
        };
        requests([wide(10, 2), wide(11, 2), wide(12, 2)], limits(NARROW), &[(10, 4), (12, 2)]);
        let all = TableLimits { max_read: 125, ..NARROW };
        requests([wide(10, 2), wide(15, 2), wide(9, 2)], limits(all), &[(9, 14)]);
        requests([wide(2, 2), wide(4, 2)], limits(all), &[(2, 2), (4, 2)]);
    }

    #[test]
    fn as_a_constant() {
        const PLAN: Result<Plan<2>, LengthError> = Plan::new([at(1, 1), at(2, 2)], &Limits::STANDARD);
        const _: () = assert!(matches!(PLAN, Ok(plan) if plan.len() == 1 && !plan.is_empty()));
        assert_eq!(PLAN.map(|plan| plan.requests()[0].count), Ok(3));
    }
}

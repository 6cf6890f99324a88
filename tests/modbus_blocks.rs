//! Tests reading blocks of random items. A block must return the same values as single reads, with as few requests as
//! possible. No request may exceed the limit, or include an address outside the items and the readable ranges.

use std::collections::HashMap;

use lexibus::modbus::{Limits, Plan, RegisterClient, Span, TableLimits};
use lexibus::{Client, Error, Flags, Item, Modbus, OnModbus, Register, RegisterTable, Ro, Value, WordOrder};
use proptest::prelude::*;

type RegisterItem<V> = Item<V, Ro, OnModbus>;

const LIMITS: Limits = Limits {
    holding: TableLimits { max_read: 9, readable: &[Span::new(2, 9), Span::new(14, 20)], ..TableLimits::HOLDING },
    input: TableLimits {
        max_read: 11,
        readable: &[Span::new(3, 11).words_per_address(2), Span::new(12, 14)],
        ..TableLimits::INPUT
    },
    coil: TableLimits { max_read: 12, readable: &[Span::new(0, 10)], ..TableLimits::COIL },
    discrete: TableLimits { readable: &[Span::new(5, 30)], ..TableLimits::DISCRETE },
};

/// A simulated device that records its requests. The input registers of the device have 32 bits, with the high word
/// first. A request for one word returns the low word.
#[derive(Default)]
struct Device {
    requests: Vec<Register>,
}

/// Returns the content of a word at an address.
fn word(table: RegisterTable, address: u16, half: u16) -> u16 {
    (address.wrapping_mul(0x3D4F) ^ half.wrapping_mul(0x5A5B)).wrapping_add(table as u16 * 0x1357).rotate_left(3)
}

fn bit(table: RegisterTable, address: u16) -> bool {
    word(table, address, 0).count_ones() % 2 == 1
}

impl Client for Device {
    type Bus = Modbus;
    type Error = ();

    fn read(&mut self, register: Register, buffer: &mut [u8]) -> Result<usize, Error<()>> {
        self.requests.push(register);
        let Register { table, address, count, .. } = register;
        let words: Vec<u16> = match table {
            RegisterTable::Holding => (0..count).map(|at| word(table, address + at, 0)).collect(),
            RegisterTable::Input if count == 1 => vec![word(table, address, 1)],
            RegisterTable::Input => (0..count).map(|at| word(table, address + at / 2, at % 2)).collect(),
            RegisterTable::Coil | RegisterTable::DiscreteInput => {
                buffer.fill(0);
                for at in (0..count).filter(|at| bit(table, address + at)) {
                    buffer[usize::from(at / 8)] |= 1 << (at % 8);
                }
                return Ok(usize::from(count.div_ceil(8)));
            }
        };
        Ok(register.decode(&words, buffer)?)
    }

    fn write(&mut self, _: Register, _: &[u8]) -> Result<(), Error<()>> {
        Err(Error::Client(()))
    }
}

impl RegisterClient for Device {
    fn limits(&self) -> &Limits {
        &LIMITS
    }
}

fn item<V: Value>(register: Register) -> RegisterItem<V> {
    RegisterItem::register(register, "", Flags::NONE)
}

/// Generates registers in a table of words. In the table of input registers, an address has two words.
fn words(count: u16) -> impl Strategy<Value = Register> {
    let place = (0..24_u16, any::<bool>(), any::<bool>(), any::<bool>());
    place.prop_map(move |(address, is_input, is_low_first, is_swapped)| {
        let table = if is_input { RegisterTable::Input } else { RegisterTable::Holding };
        let order = if is_low_first && !is_input { WordOrder::LowFirst } else { WordOrder::HighFirst };
        let register = Register::new(table, address, count).ordered(order);
        let register = if is_input { register.words_per_address(2) } else { register };
        if is_swapped {
            register.swapped()
        } else {
            register
        }
    })
}

fn bits(count: u16) -> impl Strategy<Value = Register> {
    let place = (0..24_u16, any::<bool>());
    place.prop_map(move |(address, is_input)| {
        let table = if is_input { RegisterTable::DiscreteInput } else { RegisterTable::Coil };
        Register::new(table, address, count)
    })
}

fn part() -> impl Strategy<Value = Register> {
    (words(1), 0..8_u8).prop_map(|(register, first)| register.part(first, 8))
}

/// Returns all addresses of a register with their table.
fn addresses(register: &Register) -> impl Iterator<Item = (RegisterTable, u16)> {
    let (table, first) = (register.table, register.address);
    (0..register.addresses()).map(move |at| (table, first + at))
}

/// Returns whether a request may include the address.
fn is_described(items: &[Register], table: RegisterTable, address: u16) -> bool {
    let step = if table == RegisterTable::Input { 2 } else { 1 };
    let spans = LIMITS.of(table).readable.iter().filter(|span| span.words_per_address == step);
    spans.into_iter().any(|span| (span.first..=span.last).contains(&address))
        || items.iter().flat_map(addresses).any(|described| described == (table, address))
}

/// Returns the minimum number of requests that read all items of a table. Uses an exhaustive search.
fn fewest(items: &[Register], table: RegisterTable) -> usize {
    let wanted: Vec<Register> = items.iter().copied().filter(|item| item.table == table).collect();
    let all = (1_u32 << wanted.len()) - 1;
    let mut reached = HashMap::from([(0_u32, 0_usize)]);
    let windows: Vec<u32> = (0..24).map(|first| window(&wanted, items, table, first)).collect();
    for requests in 1..=wanted.len() {
        let now: Vec<u32> = reached.keys().copied().collect();
        for set in now.iter().flat_map(|set| windows.iter().map(move |window| set | window)) {
            reached.entry(set).or_insert(requests);
        }
    }
    reached[&all]
}

/// Returns the set of items that the longest allowed request from an address reads.
fn window(wanted: &[Register], items: &[Register], table: RegisterTable, first: u16) -> u32 {
    let step = if table == RegisterTable::Input { 2 } else { 1 };
    let longest = first + LIMITS.max_read(table) / step;
    let end = (first..longest).find(|&address| !is_described(items, table, address)).unwrap_or(longest);
    let is_within = |item: &Register| item.address >= first && item.address + item.addresses() <= end;
    wanted.iter().enumerate().filter(|(_, item)| is_within(item)).fold(0, |set, (at, _)| set | 1 << at)
}

proptest! {
    #[test]
    fn blocks_give_what_items_give(
        a in words(1), b in words(2), c in words(2), d in words(4), e in part(), f in bits(1), g in bits(9), h in bits(1),
    ) {
        let registers = [a, b, c, d, e, f, g, h];
        let block = (
            item::<u16>(a), item::<i32>(b), item::<f32>(c), item::<u64>(d), item::<u8>(e), item::<bool>(f),
            item::<u16>(g), item::<bool>(h),
        );
        let mut one_by_one = Device::default();
        let single = (
            block.0.at(&mut one_by_one).read().unwrap(), block.1.at(&mut one_by_one).read().unwrap(),
            block.2.at(&mut one_by_one).read().unwrap().to_bits(), block.3.at(&mut one_by_one).read().unwrap(),
            block.4.at(&mut one_by_one).read().unwrap(), block.5.at(&mut one_by_one).read().unwrap(),
            block.6.at(&mut one_by_one).read().unwrap(), block.7.at(&mut one_by_one).read().unwrap(),
        );

        let mut device = Device::default();
        let (a, b, c, d, e, f, g, h) = device.read_block(block).unwrap();
        prop_assert_eq!((a, b, c.to_bits(), d, e, f, g, h), single);

        for request in &device.requests {
            prop_assert!(request.count <= LIMITS.max_read(request.table), "{:?}", request);
            prop_assert!(addresses(request).all(|(table, address)| is_described(&registers, table, address)), "{:?}", request);
        }
        let tables = [RegisterTable::Holding, RegisterTable::Input, RegisterTable::Coil, RegisterTable::DiscreteInput];
        let fewest: usize = tables.into_iter().map(|table| fewest(&registers, table)).sum();
        prop_assert_eq!(device.requests.len(), fewest, "{:?}", device.requests);
        let plan = Plan::new(registers, &LIMITS).unwrap();
        prop_assert_eq!(plan.requests(), device.requests);
    }

    #[test]
    fn nothing_panics(
        places in prop::array::uniform6((any::<u16>(), any::<u16>(), any::<u8>(), 0..4_u8)),
        (max, step, split) in (any::<u16>(), any::<u8>(), any::<bool>()),
    ) {
        let items = places.map(|(address, count, words, table)| {
            let tables = [RegisterTable::Holding, RegisterTable::Input, RegisterTable::Coil, RegisterTable::DiscreteInput];
            Register::new(tables[usize::from(table)], address, count).words_per_address(words)
        });
        let spans = Box::leak(Box::new([Span { first: 0, last: u16::MAX, words_per_address: step }]));
        let table_limits = TableLimits { max_read: max, split, readable: spans, ..TableLimits::HOLDING };
        let limits = Limits { holding: table_limits, input: table_limits, coil: table_limits, discrete: table_limits };
        if let Ok(plan) = Plan::new(items, &limits) {
            for request in plan.requests().iter().filter(|request| !items.contains(request)) {
                prop_assert!(request.count <= limits.max_read(request.table));
            }
        }
    }
}

#[test]
fn items_that_are_no_block() {
    let short = item::<u32>(Register::holding(3));
    let read = Device::default().read_block((item::<u16>(Register::holding(2)), short));
    assert!(matches!(read.map_err(Error::from), Err(Error::Length(_))));
    let read = Device::default().read_block((short,));
    assert!(matches!(read.map_err(Error::from), Err(Error::Length(_))));
    let empty: [RegisterItem<u16>; 0] = [];
    assert!(matches!(Device::default().read_block(empty).map_err(Error::from), Err(Error::Length(_))));
    let mut device = Device::default();
    let long = device.read_block((item::<u64>(Register::high_first(0, 10)), item::<u16>(Register::holding(2))));
    assert!(matches!(long.map_err(Error::from), Err(Error::Length(_))));
    assert!(device.requests.is_empty());
}

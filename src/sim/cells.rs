//! Registers and bits of a simulated Modbus device, and the items that they contain.

use std::collections::{BTreeMap, BTreeSet};
use std::vec;
use std::vec::Vec;

use super::slots::{Slot, Slots};
use super::values;
use crate::data_type::DataType;
use crate::pdo::mask;
use crate::register::{Register, RegisterTable, WordOrder};
use crate::table::{AccessRights, Entry, RawInitial};

type Address = (RegisterTable, u16);

/// A register or a bit.
#[derive(Clone, Debug, Default)]
struct Cell {
    word: u16,
    /// Positions of the items in this register. Several items can share a register, as different bit fields or as
    /// different names of the same bits.
    items: Vec<usize>,
}

/// All registers and bits. A change to a register updates its items, and a change to an item updates its registers.
#[derive(Clone, Debug, Default)]
pub(super) struct Cells(BTreeMap<Address, Cell>);

/// Returns the table and the address of each register or bit of a value.
fn addresses(register: Register) -> impl Iterator<Item = Address> {
    (0..register.count).map_while(move |at| Some((register.table, register.address.checked_add(at)?)))
}

const fn is_bits(table: RegisterTable) -> bool {
    matches!(table, RegisterTable::Coil | RegisterTable::DiscreteInput)
}

/// Returns the words of an item's registers after a write of `value`. `held` contains the words before the write. Each
/// coil or discrete input is one word.
fn encode(register: Register, value: &[u8], held: Vec<u16>) -> Vec<u16> {
    if is_bits(register.table) {
        let bit = |at: usize| value.get(at / 8).map_or(0, |byte| u16::from(byte >> (at % 8) & 1));
        return (0..held.len()).map(bit).collect();
    }
    let mut words = held;
    // If the register is shorter than the object, the register contains only the lower bytes.
    let length = value.len().min(2 * words.len());
    // The encoding fails only for a bit field in more than four registers, which no client can access.
    let _ = register.encode(value.get(..length).unwrap_or(value), &mut words);
    words
}

/// Decodes the value of an item from its registers.
fn decode(entry: &Entry, register: Register, words: &[u16]) -> Vec<u8> {
    if is_bits(register.table) {
        let bytes = words.chunks(8).map(|bits| bits.iter().rev().fold(0, |byte, bit| byte << 1 | (*bit as u8 & 1)));
        return values::widened(entry.data_type, bytes.collect());
    }
    let mut bytes = vec![0; values::byte_length(entry.data_type).unwrap_or(2 * words.len())];
    let length = register.decode(words, &mut bytes).unwrap_or(0);
    bytes.truncate(length);
    if register.order == WordOrder::Bytes && entry.data_type == DataType::VisibleString {
        // Devices pad texts with NULs.
        let end = bytes.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1);
        bytes.truncate(end);
    }
    values::widened(entry.data_type, bytes)
}

/// Returns the mask of the item's bits in the register at `address`.
fn mask_at(register: Register, address: u16) -> u16 {
    let Some(part) = register.part else { return 0xFFFF };
    let bits = encode(register, &mask(part.bits.into()).to_le_bytes(), vec![0; register.count.into()]);
    let at = address.checked_sub(register.address).map(usize::from);
    at.and_then(|at| bits.get(at)).copied().unwrap_or(0)
}

pub(super) const fn is_readable(entry: &Entry) -> bool {
    !matches!(entry.access, AccessRights::WriteOnly)
}

pub(super) const fn is_writable(entry: &Entry) -> bool {
    matches!(entry.access, AccessRights::WriteOnly | AccessRights::ReadWrite)
}

impl Cells {
    /// Writes the values of all items to the registers. If items share bits, the items with a known initial value take
    /// precedence.
    pub fn fill(&mut self, slots: &mut Slots) {
        self.0.clear();
        let (unknown, known): (Vec<usize>, Vec<usize>) = (0..slots.len()).partition(|at| {
            let slot = slots.get(*at);
            slot.stored.is_none() && slot.initial.is_none() && slot.entry.initial == RawInitial::Unknown
        });
        for at in unknown.iter().chain(&known) {
            let Some(register) = slots.get(*at).entry.register else { continue };
            for address in addresses(register) {
                self.0.entry(address).or_default().items.push(*at);
            }
            self.put(register, &slots.get(*at).value);
        }
        for at in unknown {
            self.refresh(slots.get_mut(at));
        }
    }

    /// Writes the value of an item to its registers, and updates the other items in these registers.
    pub fn spread(&mut self, slots: &mut Slots, at: usize) {
        let Some(register) = slots.get(at).entry.register else { return };
        self.put(register, &slots.get(at).value);
        for other in self.items(addresses(register)) {
            if other != at {
                self.refresh(slots.get_mut(other));
            }
        }
    }

    fn put(&mut self, register: Register, value: &[u8]) {
        let words = encode(register, value, self.words(register));
        for (address, word) in addresses(register).zip(words) {
            self.set(address, word);
        }
    }

    /// Updates the value of an item from its registers. The value doesn't change if its encoding equals the registers,
    /// for example if a text is shorter than its registers.
    pub fn refresh(&self, slot: &mut Slot) {
        let Some(register) = slot.entry.register else { return };
        let words = self.words(register);
        if encode(register, &slot.value, words.clone()) != words {
            slot.value = decode(&slot.entry, register, &words);
        }
    }

    /// Returns the words of a value's registers. Returns 0 for registers that don't exist.
    pub fn words(&self, register: Register) -> Vec<u16> {
        let held = |address| self.word(address).unwrap_or(0);
        let mut words: Vec<u16> = addresses(register).map(held).collect();
        words.resize(register.count.into(), 0);
        words
    }

    /// Returns the contents of a single register or bit, or `None` if it doesn't exist.
    pub fn word(&self, address: Address) -> Option<u16> {
        self.0.get(&address).map(|cell| cell.word)
    }

    pub fn set(&mut self, address: Address, word: u16) {
        if let Some(cell) = self.0.get_mut(&address) {
            cell.word = word;
        }
    }

    /// Returns the positions of the items at these addresses.
    pub fn items(&self, addresses: impl Iterator<Item = Address>) -> BTreeSet<usize> {
        addresses.filter_map(|address| self.0.get(&address)).flat_map(|cell| &cell.items).copied().collect()
    }

    /// Returns the mask of the bits at this address that belong to the items that `which` selects.
    pub fn mask(&self, slots: &Slots, address: Address, which: impl Fn(&Entry) -> bool) -> u16 {
        let items = self.0.get(&address).map_or(&[][..], |cell| &cell.items);
        let entries = items.iter().map(|at| &slots.get(*at).entry).filter(|entry| which(entry));
        let masks = entries.filter_map(|entry| Some(mask_at(entry.register?, address.1)));
        masks.fold(0, |all, mask| all | mask)
    }

    /// Returns the value that the registers contain for an item, or `None` if the item has no register.
    pub fn value(&self, entry: &Entry) -> Option<Vec<u8>> {
        let register = entry.register?;
        Some(decode(entry, register, &self.words(register)))
    }
}

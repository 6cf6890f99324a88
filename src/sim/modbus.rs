//! Modbus requests to a simulated device.

use std::collections::BTreeSet;
use std::vec;
use std::vec::Vec;

use super::cells::{is_readable, is_writable};
use super::device::Device;
use super::fault::{Exception, Fault};
use super::limits::Limits;
use super::values;
use crate::error::Error;
use crate::modbus::{is_combined, masked, MAX_EXCHANGED};
use crate::register::{Register, RegisterTable};

const fn is_bits(table: RegisterTable) -> bool {
    matches!(table, RegisterTable::Coil | RegisterTable::DiscreteInput)
}

impl Device {
    /// Returns the device with these maximum numbers of registers in a read request and a write request. The limits of
    /// the Modbus specification are 125 and 123.
    #[must_use]
    pub fn with_modbus_limits(mut self, read: u16, write: u16) -> Self {
        self.limits = Limits { read, write };
        self
    }

    /// Handles the functions 3 and 4: reads `count` registers of [`Holding`](RegisterTable::Holding) or
    /// [`Input`](RegisterTable::Input). The registers may belong to several items.
    ///
    /// # Errors
    ///
    /// - [`Exception::IllegalDataAddress`] if a register doesn't belong to a readable item.
    /// - [`Exception::IllegalDataValue`] if `count` is 0 or too high.
    /// - [`Exception::IllegalFunction`] if the table contains coils or discrete inputs.
    /// - The exception for an injected fault ([`fail_next`](Self::fail_next)).
    pub fn read_words(&mut self, table: RegisterTable, address: u16, count: u16) -> Result<Vec<u16>, Exception> {
        if is_bits(table) {
            return Err(Exception::IllegalFunction);
        }
        self.request(table, address, count).map_err(Exception::of_fault)
    }

    /// Handles the functions 6 and 16: writes holding registers. The registers may belong to several items. Bits of
    /// read-only items don't change.
    ///
    /// # Errors
    ///
    /// - [`Exception::IllegalDataAddress`] if a register doesn't belong to a writable item.
    /// - [`Exception::IllegalDataValue`] if the number of registers is 0 or too high, or if an item would be outside
    ///   its limits.
    /// - [`Exception::IllegalFunction`] if the table isn't [`Holding`](RegisterTable::Holding).
    /// - The exception for the abort code of a reaction, or for an injected fault ([`fail_next`](Self::fail_next)).
    ///
    /// After any of these errors, nothing is written.
    pub fn write_words(&mut self, table: RegisterTable, address: u16, words: &[u16]) -> Result<(), Exception> {
        if table != RegisterTable::Holding {
            return Err(Exception::IllegalFunction);
        }
        self.command_cells(table, address, words).map_err(Exception::of_fault)
    }

    /// Handles function 22: sets a holding register with the value `held` to `held & and | or & !and`. Bits of
    /// read-only items don't change.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`write_words`](Self::write_words), and [`Exception::IllegalDataAddress`] if the register
    /// doesn't exist.
    pub fn mask_word(&mut self, address: u16, and: u16, or: u16) -> Result<(), Exception> {
        self.mask(address, and, or).map_err(Exception::of_fault)
    }

    /// Handles function 23: writes `words` to the holding registers starting at `write`, then reads `count` holding
    /// registers starting at `read`.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`read_words`](Self::read_words) and [`write_words`](Self::write_words). At most 121
    /// registers can be written. If the registers cannot be read, nothing is written.
    pub fn exchange_words(&mut self, write: u16, words: &[u16], read: u16, count: u16) -> Result<Vec<u16>, Exception> {
        self.exchange(write, words, read, count).map_err(Exception::of_fault)
    }

    /// Handles the functions 1 and 2: reads `count` bits of [`Coil`](RegisterTable::Coil) or
    /// [`DiscreteInput`](RegisterTable::DiscreteInput).
    ///
    /// # Errors
    ///
    /// Returns [`Exception::IllegalFunction`] if the table contains registers, otherwise the errors of
    /// [`read_words`](Self::read_words).
    pub fn read_bits(&mut self, table: RegisterTable, address: u16, count: u16) -> Result<Vec<bool>, Exception> {
        if !is_bits(table) {
            return Err(Exception::IllegalFunction);
        }
        let words = self.request(table, address, count).map_err(Exception::of_fault)?;
        Ok(words.into_iter().map(|word| word != 0).collect())
    }

    /// Handles the functions 5 and 15: writes coils.
    ///
    /// # Errors
    ///
    /// Returns [`Exception::IllegalFunction`] if the table isn't [`Coil`](RegisterTable::Coil), otherwise the errors of
    /// [`write_words`](Self::write_words).
    pub fn write_bits(&mut self, table: RegisterTable, address: u16, bits: &[bool]) -> Result<(), Exception> {
        if table != RegisterTable::Coil {
            return Err(Exception::IllegalFunction);
        }
        let words: Vec<u16> = bits.iter().map(|bit| u16::from(*bit)).collect();
        self.command_cells(table, address, &words).map_err(Exception::of_fault)
    }

    /// Handles a read access of a client.
    pub(super) fn read_register(&mut self, register: Register, buffer: &mut [u8]) -> Result<usize, Error<Fault>> {
        let words = self.request(register.table, register.address, register.count)?;
        if !is_bits(register.table) {
            return Ok(register.decode(&words, buffer)?);
        }
        for (byte, bits) in buffer.iter_mut().zip(words.chunks(8)) {
            *byte = bits.iter().rev().fold(0, |byte, bit| byte << 1 | (*bit as u8 & 1));
        }
        Ok(words.len().div_ceil(8))
    }

    /// Handles a write access of a client. If the value is part of a register, the register is read first, as real
    /// clients do.
    pub(super) fn write_register(&mut self, register: Register, data: &[u8]) -> Result<(), Error<Fault>> {
        let Register { table, address, count, .. } = register;
        if matches!(table, RegisterTable::Input | RegisterTable::DiscreteInput) {
            return Err(Fault::from(Exception::IllegalFunction).into());
        }
        if table == RegisterTable::Coil {
            let bit = |at: u16| data.get(usize::from(at / 8)).map_or(0, |byte| u16::from(byte >> (at % 8) & 1));
            let words: Vec<u16> = (0..count).map(bit).collect();
            return Ok(self.command_cells(table, address, &words)?);
        }
        let mut words = match register.part {
            Some(_) => self.request(table, address, count)?,
            None => vec![0; usize::from(count)],
        };
        register.encode(data, &mut words)?;
        Ok(self.command_cells(table, address, &words)?)
    }

    pub(super) fn mask(&mut self, address: u16, and: u16, or: u16) -> Result<(), Fault> {
        self.access();
        self.take_fault()?;
        let held = self.cells.word((RegisterTable::Holding, address)).ok_or(Exception::IllegalDataAddress)?;
        self.change_cells(RegisterTable::Holding, address, &[masked(held, and, or)])
    }

    pub(super) fn exchange(&mut self, write: u16, words: &[u16], read: u16, count: u16) -> Result<Vec<u16>, Fault> {
        self.access();
        self.take_fault()?;
        let table = RegisterTable::Holding;
        self.check_count(table, words.len(), |limits| limits.write.min(MAX_EXCHANGED))?;
        self.held_cells(table, read, count)?;
        self.change_cells(table, write, words)?;
        self.held_cells(table, read, count)
    }

    /// Handles a write and a read of a client with function 23, or with two requests if a value doesn't occupy whole
    /// holding registers.
    pub(super) fn exchange_registers(
        &mut self,
        write: Register,
        data: &[u8],
        read: Register,
        buffer: &mut [u8],
    ) -> Result<usize, Error<Fault>> {
        if !is_combined(&write, &read) {
            self.write_register(write, data)?;
            return self.read_register(read, buffer);
        }
        let mut words = vec![0; usize::from(write.count)];
        write.encode(data, &mut words)?;
        let words = self.exchange(write.address, &words, read.address, read.count)?;
        Ok(read.decode(&words, buffer)?)
    }

    fn check_count(&self, table: RegisterTable, count: usize, most: impl Fn(Limits) -> u16) -> Result<(), Exception> {
        let most = most(if is_bits(table) { Limits::BITS } else { self.limits });
        if (1..=usize::from(most)).contains(&count) {
            Ok(())
        } else {
            Err(Exception::IllegalDataValue)
        }
    }

    fn request(&mut self, table: RegisterTable, address: u16, count: u16) -> Result<Vec<u16>, Fault> {
        self.access();
        self.take_fault()?;
        self.held_cells(table, address, count)
    }

    fn held_cells(&self, table: RegisterTable, address: u16, count: u16) -> Result<Vec<u16>, Fault> {
        self.check_count(table, count.into(), |limits| limits.read)?;
        let word = |at: u16| -> Option<u16> {
            let address = (table, address.checked_add(at)?);
            let readable = self.cells.mask(&self.slots, address, is_readable);
            // Bits of write-only items are read as 0.
            self.cells.word(address).filter(|_| readable != 0).map(|word| word & readable)
        };
        let words: Option<Vec<u16>> = (0..count).map(word).collect();
        Ok(words.ok_or(Exception::IllegalDataAddress)?)
    }

    fn command_cells(&mut self, table: RegisterTable, address: u16, words: &[u16]) -> Result<(), Fault> {
        self.access();
        self.take_fault()?;
        self.change_cells(table, address, words)
    }

    /// Writes registers. If the write fails, all registers are restored.
    fn change_cells(&mut self, table: RegisterTable, address: u16, words: &[u16]) -> Result<(), Fault> {
        self.check_count(table, words.len(), |limits| limits.write)?;
        let addresses = (address..=u16::MAX).map(|address| (table, address)).take(words.len());
        if addresses.clone().count() < words.len() {
            return Err(Exception::IllegalDataAddress.into());
        }
        let mut changes = Vec::with_capacity(words.len());
        for (address, word) in addresses.zip(words) {
            let writable = self.cells.mask(&self.slots, address, is_writable);
            let held = self.cells.word(address).filter(|_| writable != 0).ok_or(Exception::IllegalDataAddress)?;
            changes.push((address, held, held & !writable | word & writable));
        }
        for (address, _, word) in &changes {
            self.cells.set(*address, *word);
        }
        let touched = self.cells.items(changes.iter().map(|(address, ..)| *address));
        let old: Vec<(usize, Vec<u8>)> = touched.iter().map(|at| (*at, self.slots.get(*at).value.clone())).collect();
        let result = self.take_over(&touched);
        if result.is_err() {
            for (address, held, _) in changes {
                self.cells.set(address, held);
            }
            for (at, value) in old {
                self.slots.get_mut(at).value = value;
            }
        }
        result
    }

    /// Checks and updates the items whose registers were written, and calls the reactions.
    fn take_over(&mut self, touched: &BTreeSet<usize>) -> Result<(), Fault> {
        let mut reacting = Vec::new();
        for at in touched {
            let slot = self.slots.get(*at);
            let Some(value) = self.cells.value(&slot.entry).filter(|_| is_writable(&slot.entry)) else { continue };
            let is_part = slot.entry.register.is_some_and(|register| register.part.is_some());
            // The write also contains the other parts of the register, whose values haven't changed.
            if !is_part || value != slot.value {
                values::check_range(&slot.entry, &value).map_err(Exception::of_abort)?;
                reacting.push(*at);
            }
        }
        for at in touched {
            self.cells.refresh(self.slots.get_mut(*at));
        }
        Ok(reacting.into_iter().try_for_each(|at| self.react(at))?)
    }
}

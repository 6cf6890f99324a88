//! Requests that read or write a value, and the evaluation of the replies.

use std::fmt;
use std::io;
use std::vec;
use std::vec::Vec;

use tokio_modbus::{Request, Response};

use super::{ModbusError, Reply};
use crate::error::Error;
use crate::modbus::Limits;
use crate::pdo::{from_bytes, mask, sign_extend};
use crate::register::{Register, RegisterTable};
use crate::value_error::OutOfRange;

/// Parts of a value, one per request. There is only one part, unless the limits require more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pieces {
    register: Register,
    /// Maximum number of registers or bits of a part.
    size: u16,
}

impl Pieces {
    pub(super) fn new(register: Register, max: u16, split: bool) -> Result<Self, ModbusError> {
        let count = register.count;
        let end = u32::from(register.address) + u32::from(register.addresses());
        if count == 0 || end > 0x1_0000 {
            return Err(ModbusError::NoSuchAddress { address: register.address, count });
        }
        // All registers of one address are in the same part.
        let size = if count > max { max - max % register.step() } else { max };
        if count > max && !(split && size > 0) {
            return Err(ModbusError::TooLong { count, max });
        }
        Ok(Self { register, size })
    }

    /// Returns address and count of the part that starts with register or bit `first` of the value, or `None` if the
    /// value has no such register or bit.
    fn at(&self, first: u16) -> Option<(u16, u16)> {
        let left = self.register.count.checked_sub(first).filter(|&left| left > 0)?;
        Some((self.register.address.wrapping_add(first / self.register.step()), left.min(self.size)))
    }
}

/// Returns the function code that reads a table.
fn read_function(table: RegisterTable) -> u8 {
    match table {
        RegisterTable::Coil => 1,
        RegisterTable::DiscreteInput => 2,
        RegisterTable::Holding => 3,
        RegisterTable::Input => 4,
    }
}

pub(super) fn response(reply: Reply) -> Result<Response, Error<ModbusError>> {
    match reply {
        Ok(Ok(response)) => Ok(response),
        Ok(Err(code)) => Err(Error::Client(ModbusError::Exception(code))),
        Err(tokio_modbus::Error::Transport(error)) if error.kind() == std::io::ErrorKind::TimedOut => {
            Err(Error::Timeout)
        }
        Err(tokio_modbus::Error::Transport(error)) if NoReply::is(&error) => Err(Error::Client(ModbusError::Broadcast)),
        Err(error) => Err(Error::Client(ModbusError::Bus(error))),
    }
}

/// A read access: its requests and the data received so far.
pub(super) struct Answer {
    pieces: Pieces,
    words: Vec<u16>,
    bits: Vec<bool>,
}

impl Answer {
    pub(super) fn new(register: Register, limits: &Limits) -> Result<Self, ModbusError> {
        let (table_limits, function) = (limits.of(register.table), read_function(register.table));
        if !table_limits.takes(function) {
            return Err(ModbusError::Function { table: register.table, function });
        }
        let pieces = Pieces::new(register, limits.max_read(register.table), table_limits.split)?;
        Ok(Self { pieces, words: Vec::new(), bits: Vec::new() })
    }

    /// Returns address and count of the next part, or `None` after the last part.
    fn next(&self) -> Option<(u16, u16)> {
        self.pieces.at(u16::try_from(self.words.len() + self.bits.len()).ok()?)
    }

    /// Returns the request for the next part, or `None` after the last part.
    pub(super) fn request(&self) -> Option<Request<'static>> {
        let (address, count) = self.next()?;
        Some(match self.pieces.register.table {
            RegisterTable::Holding => Request::ReadHoldingRegisters(address, count),
            RegisterTable::Input => Request::ReadInputRegisters(address, count),
            RegisterTable::Coil => Request::ReadCoils(address, count),
            RegisterTable::DiscreteInput => Request::ReadDiscreteInputs(address, count),
        })
    }

    /// Adds the reply for the next part.
    pub(super) fn add(&mut self, reply: Reply) -> Result<(), Error<ModbusError>> {
        let count = self.next().map_or(0, |(_, count)| usize::from(count));
        match response(reply)? {
            Response::ReadHoldingRegisters(words) | Response::ReadInputRegisters(words) if words.len() == count => {
                self.words.extend(words);
            }
            Response::ReadCoils(bits) | Response::ReadDiscreteInputs(bits) => {
                // The reply is padded to whole bytes.
                self.bits.extend(bits.get(..count).ok_or(Error::UnexpectedReply)?);
            }
            _ => return Err(Error::UnexpectedReply),
        }
        Ok(())
    }

    /// Writes the value to the start of `buffer` and returns its length in bytes.
    pub(super) fn value(&self, buffer: &mut [u8]) -> Result<usize, Error<ModbusError>> {
        if matches!(self.pieces.register.table, RegisterTable::Holding | RegisterTable::Input) {
            return Ok(self.pieces.register.decode(&self.words, buffer)?);
        }
        for (byte, bits) in buffer.iter_mut().zip(self.bits.chunks(8)) {
            *byte = bits.iter().rev().fold(0, |byte, bit| byte << 1 | u8::from(*bit));
        }
        Ok(self.bits.len().div_ceil(8))
    }

    /// Returns the registers that were read.
    pub(super) fn into_words(self) -> Vec<u16> {
        self.words
    }
}

/// A write access.
pub(super) struct Writes {
    pieces: Pieces,
    /// True if parts of one register or bit are written with the function for a single register or bit (6 or 5).
    single: bool,
    /// True if function 22 is used to change only some bits of a register.
    masks: bool,
}

impl Writes {
    pub(super) fn new(register: Register, limits: &Limits, single: bool) -> Result<Self, ModbusError> {
        let table = register.table;
        let (one, several) = match table {
            RegisterTable::Holding => (6, 16),
            RegisterTable::Coil => (5, 15),
            RegisterTable::Input | RegisterTable::DiscreteInput => return Err(ModbusError::ReadOnly),
        };
        let table_limits = limits.of(table);
        let masks =
            table == RegisterTable::Holding && register.part.is_some() && register.count == 1 && table_limits.names(22);
        let takes_several = table_limits.takes(several);
        let single = table_limits.takes(one) && (single || table == RegisterTable::Coil || !takes_several);
        let is_single = register.count == 1 || table_limits.split;
        if !(masks || takes_several || single && is_single) {
            return Err(ModbusError::Function { table, function: several });
        }
        let max = if takes_several { limits.max_write(table) } else { 1 };
        Ok(Self { pieces: Pieces::new(register, max, table_limits.split)?, single, masks })
    }

    /// Returns the read access for the current registers if the write changes only some bits of holding registers and
    /// function 22 is not used.
    pub(super) fn held(&self, limits: &Limits) -> Result<Option<Answer>, ModbusError> {
        let register = self.pieces.register;
        let is_read = register.table == RegisterTable::Holding && register.part.is_some() && !self.masks;
        is_read.then(|| Answer::new(register, limits)).transpose()
    }

    /// Returns the requests that write `data`. `held` are the current registers, if they were read.
    pub(super) fn requests(
        &self,
        held: Option<Vec<u16>>,
        data: &[u8],
    ) -> Result<Vec<Request<'static>>, Error<ModbusError>> {
        let register = self.pieces.register;
        if !takes(register, data) {
            return Err(Error::OutOfRange(OutOfRange));
        }
        if register.table == RegisterTable::Coil {
            return Ok(self.coils(data));
        }
        if self.masks {
            // The AND mask results from empty data encoded into 0xFFFF, and the OR mask from the data encoded into 0.
            let (mut kept, mut bits) = ([u16::MAX], [0]);
            register.encode(&[], &mut kept)?;
            register.encode(data, &mut bits)?;
            return Ok(vec![Request::MaskWriteRegister(register.address, kept[0], bits[0])]);
        }
        let mut words = held.unwrap_or_else(|| vec![0; usize::from(register.count)]);
        register.encode(data, &mut words)?;
        Ok(self.pieces(&words, |address, words| match words {
            [word] if self.single => Request::WriteSingleRegister(address, *word),
            _ => Request::WriteMultipleRegisters(address, words.to_vec().into()),
        }))
    }

    fn coils(&self, data: &[u8]) -> Vec<Request<'static>> {
        let bit = |at: usize| data.get(at / 8).is_some_and(|byte| byte >> (at % 8) & 1 == 1);
        let bits: Vec<bool> = (0..usize::from(self.pieces.register.count)).map(bit).collect();
        self.pieces(&bits, |address, bits| match bits {
            [bit] if self.single => Request::WriteSingleCoil(address, *bit),
            _ => Request::WriteMultipleCoils(address, bits.to_vec().into()),
        })
    }

    /// Returns one request per part.
    fn pieces<T>(&self, all: &[T], request: impl Fn(u16, &[T]) -> Request<'static>) -> Vec<Request<'static>> {
        let mut requests = Vec::new();
        let mut first = 0;
        while let Some((address, count)) = self.pieces.at(first) {
            let (from, behind) = (usize::from(first), usize::from(first) + usize::from(count));
            requests.extend(all.get(from..behind).map(|piece| request(address, piece)));
            first = first.saturating_add(count);
        }
        requests
    }
}

/// Returns whether the number in `data` fits in the [`part`](Register::part) of the register, or in the coils. The
/// upper bits must be zero or copies of the sign bit.
fn takes(register: Register, data: &[u8]) -> bool {
    let bits = match (register.part, register.table) {
        (Some(part), _) => u32::from(part.bits),
        (None, RegisterTable::Coil | RegisterTable::DiscreteInput) => u32::from(register.count),
        (None, _) => return true,
    };
    if bits == 0 || bits >= 64 || data.len() > 8 {
        return true;
    }
    let (value, whole) = (from_bytes(data), mask(8 * data.len() as u32));
    value & !mask(bits) == 0 || sign_extend(value & mask(bits), bits) as u64 & whole == value
}

/// Error of a broadcast: no device replies.
#[derive(Clone, Copy, Debug)]
pub(super) struct NoReply;

impl NoReply {
    /// Returns whether `error` is a `NoReply`.
    pub(super) fn is(error: &io::Error) -> bool {
        error.get_ref().is_some_and(|error| error.is::<Self>())
    }
}

impl fmt::Display for NoReply {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("no device replies to a broadcast")
    }
}

impl std::error::Error for NoReply {}

impl From<NoReply> for io::Error {
    fn from(error: NoReply) -> Self {
        Self::new(io::ErrorKind::Unsupported, error)
    }
}

/// The expected reply to a write, which repeats a part of the request.
pub(super) struct Echo(Option<Response>);

impl Echo {
    pub(super) fn of(request: &Request<'_>) -> Self {
        Self(Some(match request {
            Request::WriteSingleRegister(address, word) => Response::WriteSingleRegister(*address, *word),
            Request::WriteMultipleRegisters(address, words) => {
                Response::WriteMultipleRegisters(*address, words.len() as u16)
            }
            Request::MaskWriteRegister(address, kept, bits) => Response::MaskWriteRegister(*address, *kept, *bits),
            Request::WriteSingleCoil(address, bit) => Response::WriteSingleCoil(*address, *bit),
            Request::WriteMultipleCoils(address, bits) => Response::WriteMultipleCoils(*address, bits.len() as u16),
            _ => return Self(None),
        }))
    }

    /// Returns the reply, or `None` if the request isn't a write.
    pub(super) fn into_response(self) -> Option<Response> {
        self.0
    }

    /// Returns whether the response confirms the write.
    pub(super) fn is(&self, response: &Response) -> bool {
        self.0.as_ref() == Some(response)
    }

    /// Checks that the reply confirms the write. A late reply to another write doesn't match.
    pub(super) fn check(self, reply: Reply) -> Result<(), Error<ModbusError>> {
        if self.0 == Some(response(reply)?) {
            Ok(())
        } else {
            Err(Error::UnexpectedReply)
        }
    }
}

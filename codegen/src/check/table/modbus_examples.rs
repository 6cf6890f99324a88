//! Checks the example frames of Modbus against the registers, the lengths (MODBUS Application Protocol, 6.1 to 6.12) and the CRC of
//! the serial line.

use crate::check::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::facts::register::crc;
use crate::ir::{Binding, RegisterBinding, RegisterSpace};
use crate::number::hex16;
use crate::source::Span;
use crate::text::count_of;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let bindings = context.owner.items().flat_map(|item| &item.bindings);
    let registers: Vec<&RegisterBinding> = bindings
        .filter_map(|binding| match binding {
            Binding::Register(register) => Some(&**register),
            _ => None,
        })
        .collect();
    for example in &context.device.modbus_examples {
        let mut report = |what: &str, span: Span, problems: Vec<String>| {
            for problem in problems {
                let found = codes::EXAMPLE_DIFFERS.at(span, format!("the example {what} {problem}"));
                diagnostics
                    .push(found.help("keep the bytes that other frames of the manual confirm, and add a `doubt`"));
            }
        };
        let request = Request::read(&example.request);
        if let Some(request) = &request {
            report("request", example.request_at, request.problems(&registers, &example.request));
        }
        if !example.reply.is_empty() {
            report("reply", example.reply_at, reply(request.as_ref(), &example.reply));
        }
    }
}

/// The fields that all requests for registers have in common.
struct Request {
    node: u8,
    function: u8,
    start: u16,
    /// Number of registers; 1 for a request that writes a single register.
    quantity: u16,
}

impl Request {
    fn read(bytes: &[u8]) -> Option<Self> {
        let (&[node, function], rest) = bytes.split_first_chunk()?;
        let word = |at: usize| Some(u16::from_be_bytes([*rest.get(at)?, *rest.get(at + 1)?]));
        let quantity = match function {
            3 | 4 | 16 => word(2)?,
            6 => 1,
            _ => return None,
        };
        Some(Request { node, function, start: word(0)?, quantity })
    }

    /// Returns the number of bytes of node address, function code and data, without the CRC.
    fn length(&self, bytes: &[u8]) -> usize {
        match self.function {
            16 => 7 + usize::from(bytes.get(6).copied().unwrap_or(0)),
            _ => 6,
        }
    }

    fn problems(&self, registers: &[&RegisterBinding], bytes: &[u8]) -> Vec<String> {
        let space = if self.function == 4 { RegisterSpace::Input } else { RegisterSpace::Holding };
        let mut problems = Vec::new();
        let of_space = || registers.iter().filter(|register| register.space == space);
        if !of_space().any(|register| register.address == self.start) {
            problems.push(format!("starts at the address {}, which no row has", hex16(self.start)));
        } else if !of_space().any(|register| self.covers(register)) {
            let registers = count_of(self.quantity, "register");
            problems.push(format!("covers {registers}, but the last register is not the end of an item"));
        }
        if self.function == 16 && bytes.get(6).is_some_and(|count| u16::from(*count) != self.quantity.saturating_mul(2))
        {
            let (count, registers) = (bytes.get(6).unwrap_or(&0), count_of(self.quantity, "register"));
            problems.push(format!("has the byte count {count} for {registers}"));
        }
        problems.extend(ending(bytes, self.length(bytes)));
        problems
    }

    /// Returns whether the value starts in the requested registers and ends with the last requested register.
    fn covers(&self, register: &RegisterBinding) -> bool {
        // A request for a single register may address the first register of a longer value. Some devices then transfer only the low
        // word of the value.
        if matches!(self.function, 3 | 4 | 6) && self.quantity == 1 {
            return register.address == self.start;
        }
        let words = u32::from(register.words_per_address.max(1));
        let last = (u32::from(register.address).saturating_sub(self.start.into())) * words + u32::from(register.count);
        register.address >= self.start && last == u32::from(self.quantity)
    }
}

/// Returns the problems in a reply frame.
fn reply(request: Option<&Request>, bytes: &[u8]) -> Vec<String> {
    let (Some(request), [node, function, ..]) = (request, bytes) else { return Vec::new() };
    let mut problems = Vec::new();
    if *node != request.node {
        problems.push(format!("is from node {node}, but the request is to node {}", request.node));
    }
    let length = match function {
        3 | 4 => {
            let count = bytes.get(2).copied().unwrap_or(0);
            if u16::from(count) != request.quantity.saturating_mul(2) {
                let expected = request.quantity.saturating_mul(2);
                let registers = count_of(request.quantity, "register");
                problems.push(format!("has the byte count {count} instead of {expected} for {registers}"));
            }
            3 + usize::from(count)
        }
        6 | 16 => 6,
        0x80.. => 3,
        _ => return problems,
    };
    if function & 0x7F != request.function {
        problems.push(format!("has the function code {}, but the request has {}", function & 0x7F, request.function));
    }
    problems.extend(ending(bytes, length));
    problems
}

/// Returns the problem at the end of a frame: a wrong length or a wrong CRC. `length` is the length of node address, function code
/// and data in bytes. The frame may have no CRC.
fn ending(bytes: &[u8], length: usize) -> Option<String> {
    match bytes.len().checked_sub(length) {
        Some(0) => None,
        Some(2) => {
            let (data, check) = bytes.split_at(length);
            let crc = crc(data).to_le_bytes();
            (check != crc).then(|| format!("ends with the hexadecimal bytes {:02X?}, but its CRC is {crc:02X?}", check))
        }
        _ => Some(format!("has {} bytes, but its fields need {length}", bytes.len())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crc_of_the_standard() {
        // Frame with node address 2 and function code 7: the CRC is 0x1241, and its low byte is sent first.
        assert_eq!(crc(&[0x02, 0x07]), 0x1241);
    }
}

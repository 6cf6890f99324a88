//! Reads the frames that the manual prints, and creates frames according to the register table, so that tests can compare
//! them byte by byte.

use lexibus_codegen::ir::{Device, Framing, Item, Message, MessageField, MessageValue, Type};

use super::{cells, Manual};

/// One byte of a frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Byte {
    Constant(u8),
    /// A byte with the status in the lower four bits, and zeros in the upper four.
    Status,
    /// A byte of a value: the name of the value, the number of the byte, and the number of bytes in the value. Byte 0
    /// is the least significant one.
    Of(String, usize, usize),
    Check,
}

/// A printed frame: the number of its section, and one row per byte.
pub struct Frame {
    pub title: String,
    pub rows: Vec<Row>,
}

pub struct Row {
    pub line: usize,
    pub number: String,
    /// Cell in the column of the request. Empty if the request is shorter than the reply, or if the table has no such column.
    pub request: String,
    pub reply: String,
}

/// Returns the frames that the manual prints. A status in a separate cell is joined to the previous cell.
pub fn printed(manual: &Manual) -> Vec<Frame> {
    let (mut frames, mut title) = (Vec::new(), String::new());
    let mut line = 1;
    while line <= manual.len() {
        let text = manual.line(line);
        if let Some(entry) = heading(text) {
            title = entry.to_owned();
        }
        let head = cells(text).filter(|head| head[0] == "Byte" && head.iter().any(|cell| cell == "Risposta"));
        line += 1;
        let Some(head) = head else { continue };
        let mut rows = Vec::new();
        while let Some(cell) = cells(manual.line(line)).or_else(|| manual.line(line).starts_with('|').then(Vec::new)) {
            if !cell.is_empty() {
                rows.push(row(line, &cell, head[1] == "Risposta"));
            }
            line += 1;
        }
        frames.push(Frame { title: title.clone(), rows });
    }
    frames
}

/// Returns the section number of a heading such as `3.2 Uscita dallo stato di allarme`.
fn heading(text: &str) -> Option<&str> {
    let number = text.split(' ').next()?;
    let is_section = number.split('.').count() == 2 && number.split('.').all(|part| part.parse::<u8>().is_ok());
    is_section.then_some(number)
}

fn row(line: usize, cells: &[String], is_reply_only: bool) -> Row {
    let from = usize::from(!is_reply_only);
    let reply = cells.get(1 + from..).unwrap_or_default().join(" ");
    let request = if is_reply_only { String::new() } else { cells[1].clone() };
    Row { line, number: cells[0].clone(), request, reply: reply.trim().to_owned() }
}

/// Parses the cell of a byte. Returns [`Printed::Words`] if the cell describes a value in words.
pub fn meant(cell: &str) -> Printed {
    // Subscripts are separate words: `PL ₂`.
    let cell = ['₀', '₁', '₂', '₃']
        .iter()
        .fold(cell.trim().to_owned(), |cell, at| cell.replace(&format!(" {at}"), &at.to_string()));
    if cell == "0x0 BitStato" {
        return Printed::Status;
    }
    if let Some((name, value)) = cell.split_once('(').filter(|(_, rest)| rest.starts_with("0x")) {
        let value = u8::from_str_radix(value.trim_start_matches("0x").trim_end_matches(')'), 16);
        if name.trim() == "Tipo azzeramento" {
            return Printed::Part(0, 1);
        }
        return Printed::Constant(value.expect("a byte"));
    }
    if let Some(digits) = cell.strip_prefix("0x") {
        return Printed::Constant(u8::from_str_radix(digits, 16).expect("a byte"));
    }
    match cell.as_str() {
        "CRC" => return Printed::Check,
        "ETX" => return Printed::End,
        "Nodo" => return Printed::Part(0, 1),
        _ => {}
    }
    // The cell ends with the number of the byte, or with H or L, possibly in parentheses after other words.
    let short = cell.rsplit_once('(').map_or(cell.as_str(), |(_, entry)| entry.trim_end_matches(')'));
    let last = short.chars().last().map(|c| match c {
        '₀' | '0' => 0,
        '₁' | '1' => 1,
        '₂' | '2' => 2,
        '₃' | '3' => 3,
        'H' => 11,
        'L' => 10,
        _ => 99,
    });
    match last {
        Some(byte @ 0..=3) if short.len() <= 5 => Printed::Byte(byte),
        Some(half @ 10..=11) if short.len() == 2 => Printed::Part(half - 10, 2),
        _ if cell.starts_with("Parte alta") => Printed::Part(1, 2),
        _ if cell.starts_with("Parte bassa") => Printed::Part(0, 2),
        _ if cell.starts_with("Codice variabile") => Printed::Part(0, 1),
        _ => Printed::Words(cell),
    }
}

/// A byte as printed in a cell of the manual.
#[derive(Clone, Debug, PartialEq)]
pub enum Printed {
    Constant(u8),
    Status,
    Check,
    /// The word ETX without a number.
    End,
    /// The number of a byte within a 16-bit or 32-bit value. Byte 0 is the least significant one.
    Byte(usize),
    /// The number of a byte within a value, and the number of bytes in the value.
    Part(usize, usize),
    Words(String),
}

impl Printed {
    /// Returns whether the printed byte matches `byte` of a frame that was created according to the register table. A value in
    /// words matches no byte.
    pub fn is(&self, byte: &Byte, framing: &Framing) -> bool {
        match (self, byte) {
            (Printed::Constant(constant), Byte::Constant(byte)) => constant == byte,
            (Printed::End, Byte::Constant(byte)) => Some(*byte) == framing.end,
            (Printed::Status, Byte::Status) | (Printed::Check, Byte::Check) => true,
            (Printed::Byte(entry), Byte::Of(_, byte, _)) => entry == byte,
            (Printed::Part(part, size), Byte::Of(_, byte, of)) => (part, size) == (byte, of),
            _ => false,
        }
    }
}

/// Creates frames according to the register table, from the start byte to the end byte.
pub struct Layout<'d> {
    pub device: &'d Device,
    /// Lengths of the parameter values in bytes, in order. All further values have two bytes.
    pub values: Vec<usize>,
    /// Number of repetitions of fields whose count is in another field.
    pub count: usize,
}

impl<'d> Layout<'d> {
    pub fn new(device: &'d Device) -> Self {
        Layout { device, values: vec![2], count: 2 }
    }

    pub fn request(&self, message: &Message) -> Vec<Byte> {
        self.frame(self.data(&message.request, &[]))
    }

    pub fn reply(&self, message: &Message) -> Vec<Byte> {
        self.frame(self.data(&message.reply, &self.data(&message.request, &[])))
    }

    fn frame(&self, data: Vec<Byte>) -> Vec<Byte> {
        let framing = self.device.framing.as_ref().expect("a framing");
        let mut frame = vec![Byte::Constant(framing.start.expect("a start"))];
        frame.extend(data);
        frame.extend([Byte::Check, Byte::Constant(framing.end.expect("an end"))]);
        frame
    }

    /// Returns the data of a request or reply with these fields. For a reply, `request` is the data of the request.
    fn data(&self, fields: &[MessageField], request: &[Byte]) -> Vec<Byte> {
        let mut data = Vec::new();
        let mut values = self.values.iter().copied();
        self.fields(fields, request, &mut values, &mut data);
        data
    }

    fn fields(
        &self,
        fields: &[MessageField],
        request: &[Byte],
        values: &mut dyn Iterator<Item = usize>,
        data: &mut Vec<Byte>,
    ) {
        for field in fields {
            match field {
                MessageField::Constant(bytes) => data.extend(bytes.iter().map(|&byte| Byte::Constant(byte))),
                MessageField::FixedBits { bits: 4, value: 0 } => {}
                MessageField::Value(value) if self.bits(&value.item) == 4 => data.push(Byte::Status),
                MessageField::Value(value) => data.extend(self.value(value)),
                MessageField::Echo { field, bytes } => {
                    let actual: Vec<&Byte> = request
                        .iter()
                        .filter(|byte| matches!(byte, Byte::Of(name, ..) if name.as_str() == field.as_str()))
                        .collect();
                    let (first, last) =
                        bytes.map_or((0, actual.len() - 1), |(first, last)| (first.into(), last.into()));
                    data.extend(actual[first..=last].iter().copied().cloned());
                }
                MessageField::Copy { first, last } if request.is_empty() => {
                    data.extend((*first..=*last).map(|at| Byte::Of(format!("byte {at}"), 0, 1)));
                }
                MessageField::Copy { first, last } => {
                    data.extend_from_slice(&request[usize::from(*first)..=usize::from(*last)]);
                }
                MessageField::ItemCode { .. } => {
                    data.extend([Byte::Of("code".into(), 1, 2), Byte::Of("code".into(), 0, 2)]);
                }
                MessageField::ItemValue { space } => {
                    let size = values.next().unwrap_or(2);
                    let entry =
                        self.device.parameter_spaces.iter().find(|entry| entry.name == *space).expect("the space");
                    data.extend(ordered("value", size, &entry.byte_order));
                }
                MessageField::ItemPadding { .. } => {
                    data.extend(vec![Byte::Constant(0); values.next().unwrap_or(2)]);
                }
                MessageField::Repeat { count, fields, .. } => {
                    let times = if count.is_some() { self.count } else { self.values.len() };
                    (0..times).for_each(|_| self.fields(fields, request, values, data));
                }
                other => panic!("{other:?}"),
            }
        }
    }

    fn bits(&self, item: &Item) -> u32 {
        super::underlying(self.device, item.ty).bits().expect("an integer")
    }

    fn value(&self, value: &MessageValue) -> Vec<Byte> {
        let size = match super::underlying(self.device, value.item.ty) {
            Type::Unsigned(bits) | Type::Integer(bits) => usize::from(bits) / 8,
            other => panic!("{other}"),
        };
        ordered(&value.item.name, size, &value.byte_order)
    }
}

/// Returns the bytes of a value in wire order.
fn ordered(name: &str, size: usize, order: &[u8]) -> Vec<Byte> {
    let byte = |at: usize| if order.len() == size { usize::from(order[at]) } else { at };
    (0..size).map(|at| Byte::Of(name.to_owned(), size - 1 - byte(at), size)).collect()
}

/// Returns the bytes of a frame on the wire, according to the framing. `value` returns the byte with the given number in the value
/// with the given name.
pub fn wire(framing: &Framing, frame: &[Byte], value: &dyn Fn(&str, usize) -> u8) -> Vec<u8> {
    let data: Vec<u8> = frame[1..frame.len() - 2]
        .iter()
        .map(|byte| match byte {
            Byte::Constant(byte) => *byte,
            Byte::Status => value("status", 0),
            Byte::Of(name, at, _) => value(name, *at),
            Byte::Check => panic!("a checksum within the data"),
        })
        .collect();
    assert_eq!(framing.check, "xor");
    let check = data.iter().fold(framing.check_seed as u8, |check, byte| check ^ byte);
    let mut out = vec![framing.start.expect("a start")];
    for byte in data.iter().chain(Some(&check)) {
        match framing.escaped.contains(byte) {
            true => out.extend([framing.escape.expect("an escape"), byte ^ framing.escape_xor]),
            false => out.push(*byte),
        }
    }
    out.push(framing.end.expect("an end"));
    out
}

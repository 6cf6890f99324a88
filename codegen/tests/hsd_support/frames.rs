//! Frames: byte by byte as the manual prints them, and as the table's fields make them.

use lexibus_codegen::ir::{Device, Framing, Item, Message, MessageField, MessageValue, Type};

use super::{cells, Manual};

/// One byte of a frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Byte {
    Constant(u8),
    /// A half byte 0 and the status bits.
    Status,
    /// A byte of a value, the least significant numbered 0, and how many the value has.
    Of(String, usize, usize),
    Check,
}

/// A frame as the manual prints it: the number of its line, and of each byte its number and its cell.
pub struct Frame {
    pub title: String,
    pub rows: Vec<Row>,
}

pub struct Row {
    pub line: usize,
    pub number: String,
    /// Empty where the request, or the reply, is shorter.
    pub request: String,
    pub reply: String,
}

/// The tables of frames. A status that stands in a cell of its own is joined to the byte in front of it.
pub fn printed(manual: &Manual) -> Vec<Frame> {
    let (mut frames, mut title) = (Vec::new(), String::new());
    let mut line = 1;
    while line <= manual.len() {
        let text = manual.line(line);
        if let Some(own) = heading(text) {
            title = own.to_owned();
        }
        let head = cells(text).filter(|head| head[0] == "Byte" && head.iter().any(|cell| cell == "Risposta"));
        line += 1;
        let Some(head) = head else { continue };
        let mut rows = Vec::new();
        while let Some(own) = cells(manual.line(line)).or_else(|| manual.line(line).starts_with('|').then(Vec::new)) {
            if !own.is_empty() {
                rows.push(row(line, &own, head[1] == "Risposta"));
            }
            line += 1;
        }
        frames.push(Frame { title: title.clone(), rows });
    }
    frames
}

/// `3.2 Uscita dallo stato di allarme`: the number of a section.
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

/// What a cell says of its byte, in the same terms: `None` where a value is told in words.
pub fn meant(cell: &str) -> Printed {
    // The subscripts stand apart: `PL ₂`.
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
    // A letter with a number of the byte, be it in brackets behind words, or H and L.
    let short = cell.rsplit_once('(').map_or(cell.as_str(), |(_, own)| own.trim_end_matches(')'));
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

/// What a cell says.
#[derive(Clone, Debug, PartialEq)]
pub enum Printed {
    Constant(u8),
    Status,
    Check,
    /// ETX, without its code.
    End,
    /// A byte of a value of 16 or 32 bits.
    Byte(usize),
    /// A byte of a value, and how many it has.
    Part(usize, usize),
    Words(String),
}

impl Printed {
    /// Whether the byte of the table is what is printed.
    pub fn is(&self, byte: &Byte, framing: &Framing) -> bool {
        match (self, byte) {
            (Printed::Constant(own), Byte::Constant(byte)) => own == byte,
            (Printed::End, Byte::Constant(byte)) => Some(*byte) == framing.end,
            (Printed::Status, Byte::Status) | (Printed::Check, Byte::Check) => true,
            (Printed::Byte(own), Byte::Of(_, byte, _)) => own == byte,
            (Printed::Part(own, size), Byte::Of(_, byte, of)) => (own, size) == (byte, of),
            _ => false,
        }
    }
}

/// The bytes of frames, from start to end.
pub struct Layout<'d> {
    pub device: &'d Device,
    /// How many bytes the values of parameters have, in order; the last holds for all that follow.
    pub values: Vec<usize>,
    /// How often fields with a count occur.
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

    /// The data of a request, or of a reply to `request`.
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
                    let own: Vec<&Byte> =
                        request.iter().filter(|byte| matches!(byte, Byte::Of(name, ..) if name == field)).collect();
                    let (first, last) = bytes.map_or((0, own.len() - 1), |(first, last)| (first.into(), last.into()));
                    data.extend(own[first..=last].iter().copied().cloned());
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
                    let own = self.device.parameter_spaces.iter().find(|own| own.name == *space).expect("the space");
                    data.extend(ordered("value", size, &own.byte_order));
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

/// The bytes of a value on the wire.
fn ordered(name: &str, size: usize, order: &[u8]) -> Vec<Byte> {
    let byte = |at: usize| if order.len() == size { usize::from(order[at]) } else { at };
    (0..size).map(|at| Byte::Of(name.to_owned(), size - 1 - byte(at), size)).collect()
}

/// A frame on the wire, with the bytes of values as given, by the facts of the framing.
pub fn wire(framing: &Framing, frame: &[Byte], value: &dyn Fn(&str, usize) -> u8) -> Vec<u8> {
    let data: Vec<u8> = frame[1..frame.len() - 2]
        .iter()
        .map(|byte| match byte {
            Byte::Constant(byte) => *byte,
            Byte::Status => value("status", 0),
            Byte::Of(name, at, _) => value(name, *at),
            Byte::Check => panic!("a check within the data"),
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

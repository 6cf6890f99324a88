//! A device with layouts that no corpus file has. The layouts contain enumerations with fewer bits than their type, byte strings
//! that end within a byte, and numbers and times that cross byte boundaries.

use lexibus_codegen::ir::{
    Catalog, Device, Direction, EnumValue, FileInfo, Format, Pdo, PdoEntry, PdoEntryKind, ProcessData, Shape, Type,
    TypeDef, TypeId,
};
use lexibus_codegen::source::Encoding;

/// Returns an enumeration with the given base type and named values.
fn enumeration(name: &str, base: Type, values: std::ops::Range<i128>) -> TypeDef {
    let value = |value: i128| EnumValue::new(format!("value {value}").into(), value);
    TypeDef::new(name, Shape::Enumeration { base, values: values.map(value).collect(), closed: false }, base.bits())
}

/// Returns a PDO with consecutive entries. Entries without a type become padding.
fn pdo(direction: Direction, index: u16, entries: &[(Option<Type>, u32)]) -> Pdo {
    let mut pdo = Pdo { name: format!("PDO {index:X}").into(), ..Pdo::new(direction, index) };
    pdo.sync_manager = Some(2 + u8::from(direction == Direction::Transmit));
    for (number, (ty, bits)) in (1..).zip(entries) {
        let bit_offset = pdo.bits();
        let entry = PdoEntry { bit_offset, ..PdoEntry::new(0x2000 + index % 0x100, number, *bits) };
        pdo.entries.push(match ty {
            Some(ty) => PdoEntry { kind: PdoEntryKind::Item, ty: *ty, ..entry },
            None => PdoEntry { index: 0, sub_index: 0, kind: PdoEntryKind::Padding, ..entry },
        });
    }
    pdo
}

pub fn catalog() -> Catalog {
    let types = vec![
        enumeration("all of two bits", Type::Unsigned(2), 0..4),
        enumeration("some of three bits", Type::Unsigned(3), 0..3),
        enumeration("some of twelve bits", Type::Unsigned(12), 5..9),
        enumeration("some of a signed byte", Type::Integer(8), -2..2),
    ];
    let [two, three, twelve, signed] = [0, 1, 2, 3].map(|at| Type::Named(TypeId(at)));
    let (padding, text, bits) = (None, Type::VisibleString(None), Type::Opaque(None));
    let of = |ty: Type, bits: u32| (Some(ty), bits);
    let short = [(padding, 1), of(three, 3), of(two, 2), of(Type::Boolean, 1), of(twelve, 12), of(Type::Integer(6), 6)];
    let real = [(padding, 3), of(Type::Real32, 32), of(three, 3), of(signed, 8), of(text, 16)];
    let time = [of(three, 3), of(Type::TimeOfDay, 48), of(two, 2), (padding, 4), of(Type::Boolean, 1)];
    let long = [
        of(three, 3),
        of(bits, 70),
        of(two, 2),
        of(Type::TimeDifference, 48),
        of(Type::Real64, 64),
        of(twelve, 12),
        of(Type::OctetString(None), 24),
        of(signed, 8),
        of(Type::Unsigned(64), 64),
        of(Type::Integer(40), 40),
        (padding, 5),
        of(Type::Domain, 136),
        of(three, 3),
    ];
    let pdos = [Direction::Receive, Direction::Transmit].into_iter().flat_map(|direction| {
        let first = if direction == Direction::Receive { 0x1600 } else { 0x1A00 };
        let all: [&[_]; 4] = [&short, &long, &real, &time];
        (first..).zip(all).map(move |(index, entries)| pdo(direction, index, entries))
    });
    let process_data = ProcessData { pdos: pdos.collect(), ..ProcessData::default() };
    let device =
        Device { name: "odd".into(), types, ethercat: Some(Box::default()), process_data, ..Device::default() };
    let file =
        FileInfo { name: "odd".into(), format: Format::Esi, encoding: Encoding::Utf8, sha256: String::new().into() };
    Catalog { files: vec![file], devices: vec![device], ..Catalog::default() }
}

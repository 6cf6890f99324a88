//! Computes the bit positions in process data and records from the intermediate representation, without the code that
//! generates Rust.

use lexibus_codegen::ir::{
    Access, Binding, Catalog, Device, Format, Group, GroupKind, IoData, Message, MessageField, Pdo, PdoEntry,
    PdoEntryKind, ProcessData, Record, Shape, Submodule, Type, TypeDef, Value,
};

/// A sequence of adjacent bits in packed data.
#[derive(Clone, Copy)]
pub struct Piece {
    /// Position of the first bit, counted from the start of the data.
    at: u32,
    /// Position of the first bit within the value. `None` means that the bits are reserved and 0.
    of: Option<u32>,
    bits: u32,
}

/// Expected layout of a generated type.
pub struct Layout {
    /// `true` if the type is a record, and `false` if it is process data.
    pub is_record: bool,
    /// Name and value of the constant that identifies the type.
    pub number: Option<(&'static str, u16)>,
    pub bits: u32,
    fields: Vec<Vec<Piece>>,
    /// Default data of a record; empty for process data.
    default: Vec<u8>,
}

impl Layout {
    pub fn fields(&self) -> usize {
        self.fields.len()
    }

    /// Returns the layout as an expression for the test program. The maximum of `u32` marks bits that belong to no value.
    pub fn literal(&self, title: &str) -> String {
        let piece = |piece: &Piece| format!("({}, {}, {})", piece.at, piece.of.unwrap_or(u32::MAX), piece.bits);
        let field = |field: &Vec<Piece>| format!("&[{}]", field.iter().map(piece).collect::<Vec<_>>().join(", "));
        let fields = self.fields.iter().map(field).collect::<Vec<_>>().join(", ");
        let (bits, default) = (self.bits, &self.default);
        format!("Layout {{ title: {title:?}, bits: {bits}, fields: &[{fields}], default: &{default:?} }}")
    }
}

/// Returns all layouts of a catalog in the order of the bindings.
pub fn all(catalog: &Catalog) -> Vec<Layout> {
    let is_profinet = catalog.files.first().is_some_and(|file| file.format == Format::Gsdml);
    if is_profinet {
        return submodules(catalog).into_iter().flat_map(|submodule| of_submodule(submodule, &catalog.types)).collect();
    }
    let mut all: Vec<Layout> = catalog.devices.iter().flat_map(of_device).collect();
    for (at, module) in catalog.modules.iter().enumerate() {
        let mut takers = catalog.devices.iter().filter(|device| device.ethercat.is_some());
        let is_accepted = takers.any(|device| device.modules.iter().any(|usage| usage.module.0 as usize == at));
        if is_accepted || catalog.devices.is_empty() {
            all.extend(of_pdos(&module.process_data, &module.types));
        }
    }
    all
}

/// Returns whether requests of this message contain the device number. Returns `None` if there is no such message.
pub fn has_node(catalog: &Catalog, message: &str) -> Option<bool> {
    catalog.devices.iter().find_map(|device| {
        let address = device.framing.as_ref().and_then(|framing| framing.address.as_ref());
        let is_address = |field: &MessageField| match field {
            MessageField::Value(value) => Some(&value.item.name) == address,
            _ => false,
        };
        let found: &Message = device.messages.iter().find(|found| found.name == message)?;
        Some(found.request.iter().any(is_address))
    })
}

fn of_device(device: &Device) -> Vec<Layout> {
    let mut all = of_pdos(&device.process_data, &device.types);
    if device.ethercat.is_some() && !device.dictionary_only {
        all.extend(images(device));
    }
    all
}

fn of_pdos(data: &ProcessData, types: &[TypeDef]) -> Vec<Layout> {
    let layout = |pdo: &Pdo| Layout {
        is_record: false,
        number: Some(("INDEX", pdo.mapping_index)),
        bits: pdo.bits(),
        fields: mapped(pdo).map(|entry| little_endian(entry, types)).collect(),
        default: Vec::new(),
    };
    data.pdos.iter().filter(|pdo| has_struct(pdo)).map(layout).collect()
}

/// Returns the entries of a PDO that become fields.
fn mapped(pdo: &Pdo) -> impl Iterator<Item = &PdoEntry> {
    pdo.entries.iter().filter(|entry| entry.kind != PdoEntryKind::Padding && entry.bits > 0)
}

/// Returns whether a PDO becomes a struct. A PDO without fields, or with a field of more than 65,535 bits, has no struct.
fn has_struct(pdo: &Pdo) -> bool {
    mapped(pdo).next().is_some() && mapped(pdo).all(|entry| entry.bits <= 0xFFFF)
}

/// Returns the layouts of the sync managers' images. Each field of an image is a PDO, and the PDOs are adjacent.
fn images(device: &Device) -> Vec<Layout> {
    let assigned = device.process_data.assigned_by_default();
    let mut numbers: Vec<u8> = assigned.iter().map(|(_, number)| *number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let image = |number: u8| {
        let (mut fields, mut bits) = (Vec::new(), 0);
        for (pdo, _) in assigned.iter().filter(|(_, image)| *image == number) {
            let of_pdo = |entry| little_endian(entry, &device.types);
            let within = |piece: Piece| Piece { at: bits + piece.at, of: piece.of.map(|_| piece.at), ..piece };
            if has_struct(pdo) {
                fields.push(mapped(pdo).flat_map(of_pdo).map(within).collect());
            }
            bits += pdo.bits();
        }
        Layout { is_record: false, number: Some(("SYNC_MANAGER", number.into())), bits, fields, default: Vec::new() }
    };
    numbers.into_iter().map(image).filter(|layout| layout.fields() > 0).collect()
}

fn little_endian(entry: &PdoEntry, types: &[TypeDef]) -> Vec<Piece> {
    let at = entry.bit_offset;
    match (base(types, entry.ty), entry.bits) {
        (Type::TimeOfDay | Type::TimeDifference, 48) => vec![
            Piece { at, of: Some(0), bits: 28 },
            Piece { at: at + 28, of: None, bits: 4 },
            Piece { at: at + 32, of: Some(32), bits: 16 },
        ],
        (_, bits) => vec![Piece { at, of: Some(0), bits }],
    }
}

/// Returns the submodules that a device access point can have, in the order of the catalog.
fn submodules(catalog: &Catalog) -> Vec<&Submodule> {
    let points = catalog.devices.iter().filter(|device| device.profinet.is_some());
    let mut used = Vec::new();
    for point in points {
        used.extend(&point.submodules);
        let modules = point.modules.iter().filter_map(|usage| catalog.modules.get(usage.module.0 as usize));
        used.extend(modules.flat_map(|module| &module.submodules));
    }
    let is_used = |at: usize| used.iter().any(|usage| usage.submodule.0 as usize == at);
    catalog.submodules.iter().enumerate().filter(|(at, _)| is_used(*at)).map(|(_, submodule)| submodule).collect()
}

fn of_submodule(submodule: &Submodule, types: &[TypeDef]) -> Vec<Layout> {
    let images = [&submodule.input, &submodule.output].into_iter().flatten().map(|data| io_data(data, types));
    let records = submodule.records.iter().filter_map(|group| match &group.kind {
        GroupKind::Record(facts) if (1..=0xFFFF).contains(&facts.length) => Some(record(group, facts, types)),
        _ => None,
    });
    images.filter(|image| image.fields() > 0).chain(records).collect()
}

fn io_data(data: &IoData, types: &[TypeDef]) -> Layout {
    let length = data.image.length;
    let entries = data.image.fields.iter().filter(|entry| entry.kind != PdoEntryKind::Padding);
    let fields = entries.filter_map(|entry| big_endian(base(types, entry.ty), entry.bit_offset, entry.bits, length));
    Layout { is_record: false, number: None, bits: 8 * length, fields: fields.collect(), default: Vec::new() }
}

/// Returns the layout of a record's changeable parameters. The default data consist of the record's constants, overwritten with
/// the default values of all parameters. A parameter without a default value is 0.
fn record(group: &Group, record: &Record, types: &[TypeDef]) -> Layout {
    let (mut fields, mut default) = (Vec::new(), vec![0; record.length as usize]);
    for (offset, constant) in &record.constants {
        default.iter_mut().skip(*offset as usize).zip(constant).for_each(|(to, from)| *to = *from);
    }
    for item in &group.items {
        let base = base(types, item.ty);
        let place = item.bindings.iter().find_map(|binding| match binding {
            Binding::Record { bit_offset, bits, .. } => Some((*bit_offset, *bits)),
            _ => None,
        });
        let Some(pieces) = place.and_then(|(offset, bits)| big_endian(base, offset, bits, record.length)) else {
            continue;
        };
        let value = item.default.as_ref().and_then(|value| bits(value, base));
        put(&mut default, &pieces, &value.unwrap_or_default());
        if item.access != Access::Constant {
            fields.push(pieces);
        }
    }
    Layout { is_record: true, number: Some(("INDEX", record.index)), bits: 8 * record.length, fields, default }
}

/// Returns the bits of a value. The lowest bit comes first.
fn bits(value: &Value, base: Type) -> Option<Vec<bool>> {
    let bytes = match (value, base) {
        // Each character occupies one byte.
        (Value::Text(text), _) => text.chars().map(|letter| u8::try_from(letter).unwrap_or(b'?')).collect(),
        (Value::Bytes(bytes), _) => bytes.clone(),
        (_, Type::Real32) => (value.as_real()? as f32).to_le_bytes().to_vec(),
        (_, Type::Real64) => value.as_real()?.to_le_bytes().to_vec(),
        _ => value.as_int()?.to_le_bytes().to_vec(),
    };
    Some(bytes.iter().flat_map(|byte| (0..8).map(move |bit| byte >> bit & 1 == 1)).collect())
}

/// Writes the bits of the value to the data. All other bits stay unchanged.
fn put(data: &mut [u8], pieces: &[Piece], value: &[bool]) {
    for piece in pieces {
        for bit in 0..piece.bits {
            let at = piece.at + bit;
            let Some(value) = piece.of.and_then(|of| value.get((of + bit) as usize)) else { continue };
            let byte = &mut data[(at / 8) as usize];
            *byte = *byte & !(1 << (at % 8)) | u8::from(*value) << (at % 8);
        }
    }
}

/// Returns the pieces of a PROFINET field. Returns `None` if the field is outside the data or has no Rust equivalent.
fn big_endian(base: Type, offset: u32, bits: u32, length: u32) -> Option<Vec<Piece>> {
    let end = u64::from(offset) + u64::from(bits);
    if bits == 0 || end > 8 * u64::from(length) {
        return None;
    }
    let (byte, is_bytes) = (offset / 8, offset.is_multiple_of(8) && bits.is_multiple_of(8));
    let is_short = offset % 8 + bits <= 64;
    let is_number = match base {
        Type::Boolean | Type::Integer(_) | Type::Unsigned(_) => is_short,
        Type::TimeOfDay | Type::TimeDifference if is_bytes && bits == 48 => return Some(time(byte)),
        Type::Real32 | Type::Real64 | Type::Time(_) if is_bytes => matches!(
            (base, bits),
            (Type::Real32, 32) | (Type::Real64, 64) | (Type::Time(_), 32) if base.bits() == Some(bits)
        ),
        _ => !is_bytes && is_short,
    };
    match (is_number, is_bytes) {
        (true, _) => Some(number(byte, offset % 8, bits, 0)),
        (false, true) => Some(vec![Piece { at: offset, of: Some(0), bits }]),
        (false, false) => None,
    }
}

/// Returns the pieces of a big-endian number that starts in `byte`. In the last byte, the lowest `shift` bits do not belong to
/// the number. `of` is the position of the number's lowest bit within the value.
fn number(byte: u32, shift: u32, bits: u32, of: u32) -> Vec<Piece> {
    let end = shift + bits;
    let last = byte + (end - 1) / 8;
    let piece = |of_last: u32| {
        let (first, next) = ((8 * of_last).max(shift), (8 * of_last + 8).min(end));
        Piece { at: 8 * (last - of_last) + first % 8, of: Some(of + first - shift), bits: next - first }
    };
    (0..=last - byte).map(piece).collect()
}

/// Returns the pieces of a time: milliseconds in 28 bits of 4 bytes, and days in 2 bytes (IEC 61158-6, TimeOfDay with date
/// indication).
fn time(byte: u32) -> Vec<Piece> {
    let mut pieces = number(byte, 0, 28, 0);
    pieces.push(Piece { at: 8 * byte + 4, of: None, bits: 4 });
    pieces.extend(number(byte + 4, 0, 16, 32));
    pieces
}

/// Returns the basic type on which a type is based, or `Opaque` if there is none.
fn base(types: &[TypeDef], ty: Type) -> Type {
    let Type::Named(id) = ty else { return ty };
    match types.get(id.0 as usize).map(|definition| &definition.shape) {
        Some(Shape::Alias(base)) => self::base(types, *base),
        Some(Shape::Enumeration { base, .. } | Shape::BitField { base, .. } | Shape::Scaled { base, .. }) => {
            self::base(types, *base)
        }
        _ => Type::Opaque(None),
    }
}

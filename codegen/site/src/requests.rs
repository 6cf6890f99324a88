//! Requests that read and write an item: bytes on each bus and lines of Python, for pages without a script. The script
//! `requests.js` shows the same requests for a value, a node-ID and a Modbus unit identifier that the reader chooses.

mod object;
mod record;

use super::tools;
use lexibus_codegen::facts::{encoding, register, types};
use lexibus_codegen::ir::{Binding, Bus, Item, ModbusTable, RegisterBinding, RegisterSpace, Type, TypeDef};
use lexibus_codegen::number::hex16;
use object::Object;
pub(super) use record::OfRecord;

/// The node-ID and Modbus unit identifier of the requests.
const NODE: u8 = 1;

/// The bytes of a frame. A byte is `None` if it depends on an unknown value.
type Frame = Vec<Option<u8>>;

/// A request: title and text.
pub(super) type Request = (&'static str, String);

/// Returns whether a request reads or writes a PROFINET record. Such a request contains neither a node-ID nor a Modbus
/// unit identifier.
pub(super) fn is_of_record(request: &Request) -> bool {
    record::TITLES.contains(&request.0)
}

/// Returns the requests of an item. The node-ID or the Modbus unit identifier is 1. Write requests contain the default
/// value. If the item has no valid default value, the bytes of the value are shown as `xx`.
///
/// `record` is the PROFINET record that contains the item. It is used only for an item in a PROFINET record.
pub(super) fn requests(item: &Item, types: &[TypeDef], tables: &[ModbusTable], record: &OfRecord<'_>) -> Vec<Request> {
    let mut all = Vec::new();
    for binding in &item.bindings {
        match binding {
            Binding::Object { buses, index, sub_index } => {
                let object = Object { index: *index, sub_index: *sub_index };
                let on = |bus: Bus| {
                    let access = item.access_on(bus);
                    (access.readable(), Written::of(item, types, bus).filter(|_| access.writable()))
                };
                if buses.canopen {
                    let (is_readable, written) = on(Bus::CanOpen);
                    object.canopen(is_readable, written.as_ref(), &mut all);
                }
                if buses.coe {
                    let (is_readable, written) = on(Bus::EtherCat);
                    object.ethercat(is_readable, written.as_ref(), &mut all);
                }
            }
            Binding::Register(register) => {
                let functions = register::functions(register, item, tables);
                let written = Written::of(item, types, Bus::Modbus);
                modbus(register, &functions, written.as_ref(), &mut all);
            }
            Binding::Record { index, bit_offset, bits } => {
                all.extend(record.requests(item, types, *index, *bit_offset, *bits));
            }
            _ => {}
        }
    }
    all
}

/// The value of a write request.
struct Written {
    /// The bytes, least significant byte first.
    bytes: Frame,
    ty: Type,
}

impl Written {
    /// Returns the default value of an item on a bus, or unknown bytes if there is no valid default value. Returns
    /// `None` for items that are neither numbers nor Booleans.
    fn of(item: &Item, types: &[TypeDef], bus: Bus) -> Option<Self> {
        let ty = types::basic(types, item.type_on(bus));
        let is_number =
            matches!(ty, Type::Boolean | Type::Integer(_) | Type::Unsigned(_) | Type::Real32 | Type::Real64);
        let length = ty.bits().filter(|_| is_number)?.div_ceil(8) as usize;
        let default = item.default_on(bus).filter(|value| encoding::fits(value, ty));
        let bytes = match default.and_then(|value| encoding::bytes(&value.resolved(NODE), ty)) {
            Some(bytes) => known(&bytes),
            None => vec![None; length],
        };
        Some(Written { bytes, ty })
    }

    /// Returns the bytes if the value is known.
    fn known(&self) -> Option<Vec<u8>> {
        self.bytes.iter().copied().collect()
    }

    /// Returns the byte that pads the value to the size of its registers: the sign extension of an extended signed value, or 0.
    fn fill(&self, register: &RegisterBinding) -> Option<u8> {
        match self.bytes.last() {
            Some(last) if register.extended && self.ty.is_signed() => {
                last.map(|last| if last < 0x80 { 0 } else { 0xFF })
            }
            _ => Some(0),
        }
    }

    /// Returns the Python expression of the bytes. The variable `value` represents an unknown value.
    fn python(&self) -> String {
        match (self.known(), self.ty) {
            (Some(bytes), _) => {
                format!("bytes.fromhex(\"{}\")", bytes.iter().map(|byte| format!("{byte:02X}")).collect::<String>())
            }
            (None, Type::Real32) => "struct.pack(\"<f\", value)".to_owned(),
            (None, Type::Real64) => "struct.pack(\"<d\", value)".to_owned(),
            (None, ty) => {
                let signed = if ty.is_signed() { ", signed=True" } else { "" };
                format!("value.to_bytes({}, \"little\"{signed})", self.bytes.len())
            }
        }
    }
}

fn known(bytes: &[u8]) -> Frame {
    bytes.iter().copied().map(Some).collect()
}

fn text(frame: &[Option<u8>]) -> String {
    let byte = |byte: &Option<u8>| byte.map_or_else(|| "xx".to_owned(), |byte| format!("{byte:02X}"));
    frame.iter().map(byte).collect::<Vec<_>>().join(" ")
}

/// Adds the requests of a register, coil or discrete input (MODBUS Application Protocol V1.1b3, 6).
fn modbus(register: &RegisterBinding, functions: &[u8], written: Option<&Written>, all: &mut Vec<Request>) {
    let (address, count) = (register.address, tools::count(register));
    let (read, method) = match register.space {
        RegisterSpace::Coil => (1, "read_coils"),
        RegisterSpace::DiscreteInput => (2, "read_discrete_inputs"),
        RegisterSpace::Holding => (3, "read_holding_registers"),
        RegisterSpace::Input => (4, "read_input_registers"),
    };
    if functions.contains(&read) {
        all.push(("Modbus RTU read", rtu(read, address, &known(&count.to_be_bytes()))));
        all.push(("pymodbus read", format!("client.{method}({address}, count={count}, device_id={NODE})")));
    }
    let Some(written) = written.filter(|_| register.bit_offset.is_none()) else { return };
    if register.space == RegisterSpace::Coil && functions.contains(&5) {
        let value = written.bytes.first().copied().flatten();
        let state = value.map(|value| if value == 0 { 0 } else { 0xFF });
        let python = value.map_or("value", |value| if value == 0 { "False" } else { "True" });
        all.push(("Modbus RTU write", rtu(5, address, &[state, Some(0)])));
        all.push(("pymodbus write", format!("client.write_coil({address}, {python}, device_id={NODE})")));
        return;
    }
    let words = words(register, written);
    let data: Frame = words.iter().flatten().copied().collect();
    let list: Vec<String> = words.iter().enumerate().map(|(at, word)| python_word(*word, at)).collect();
    if count == 1 && functions.contains(&6) {
        all.push(("Modbus RTU write", rtu(6, address, &data)));
        let value = list.concat();
        all.push(("pymodbus write", format!("client.write_register({address}, {value}, device_id={NODE})")));
    } else if functions.contains(&16) {
        let mut payload = known(&count.to_be_bytes());
        payload.push(Some(u8::try_from(data.len()).unwrap_or(u8::MAX)));
        payload.extend(data);
        all.push(("Modbus RTU write", rtu(16, address, &payload)));
        let list = list.join(", ");
        all.push(("pymodbus write", format!("client.write_registers({address}, [{list}], device_id={NODE})")));
    }
}

/// Returns the words of a value in the order of the registers. The bytes of a word are in the order of their transmission.
fn words(register: &RegisterBinding, written: &Written) -> Vec<[Option<u8>; 2]> {
    let (fill, bytes) = (written.fill(register), &written.bytes);
    let byte = |at: usize| bytes.get(at).copied().unwrap_or(fill);
    let low_first = (0..usize::from(tools::count(register))).map(|at| [byte(2 * at + 1), byte(2 * at)]);
    let mut words: Vec<_> = low_first.collect();
    if !register.low_word_first {
        words.reverse();
    }
    if register.bytes_swapped {
        words.iter_mut().for_each(|word| word.reverse());
    }
    words
}

/// Returns a word in Python. A variable represents an unknown word.
fn python_word(word: [Option<u8>; 2], at: usize) -> String {
    match word {
        [Some(high), Some(low)] => hex16(u16::from_be_bytes([high, low])),
        _ => format!("word{at}"),
    }
}

/// Returns a Modbus RTU request with its CRC. The CRC is unknown if one of the bytes is unknown.
fn rtu(function: u8, address: u16, data: &[Option<u8>]) -> String {
    let mut frame = known(&[NODE, function]);
    frame.extend(known(&address.to_be_bytes()));
    frame.extend(data);
    let crc = frame.iter().copied().collect::<Option<Vec<u8>>>().map(|bytes| register::crc(&bytes).to_le_bytes());
    match crc {
        Some(crc) => {
            frame.extend(known(&crc));
            text(&frame)
        }
        None => format!("{} CRC CRC", text(&frame)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::ir::{Access, Buses, ItemVariant, ObjectBuses, Value};

    /// A record of seven bytes.
    const RECORD: OfRecord<'_> =
        OfRecord { submodule: "API 0, slot 1, subslot 1", length: 7, default_bytes: &[1, 2, 3, 4, 5, 6, 7] };

    fn texts(item: &Item) -> Vec<String> {
        requests(item, &[], &[], &RECORD).into_iter().map(|(title, text)| format!("{title}: {text}")).collect()
    }

    fn item(binding: Binding, ty: Type, default: Option<i128>) -> Item {
        Item { ty, access: Access::ReadWrite, default: default.map(Value::Int), ..Item::new(binding) }
    }

    #[test]
    fn requests_have_the_bytes_of_the_browser_tests() {
        // The example in the Modbus standard reads 3 registers from address 107.
        assert_eq!(rtu(3, 107, &known(&3_u16.to_be_bytes())), "01 03 00 6B 00 03 74 17");
        let object = Object { index: 0x6040, sub_index: 0 };
        assert_eq!(
            object.download(&known(&[0x0F, 0])).iter().map(|frame| text(frame)).collect::<Vec<_>>(),
            ["2B 40 60 00 0F 00 00 00"]
        );
        let object = Object { index: 0x2010, sub_index: 1 };
        let frames: Vec<String> =
            object.download(&known(&[1, 2, 3, 4, 5, 6, 7, 8])).iter().map(|frame| text(frame)).collect();
        assert_eq!(frames, ["21 10 20 01 08 00 00 00", "00 01 02 03 04 05 06 07", "1D 08 00 00 00 00 00 00"]);
    }

    #[test]
    fn a_record_is_written_as_a_whole() {
        let address = "API 0, slot 1, subslot 1, index 0x0002, length 7, value in";
        let number =
            |default| item(Binding::Record { index: 2, bit_offset: 16, bits: 16 }, Type::Unsigned(16), default);
        let expected = |bytes: &str| {
            let titles = ["PROFINET record read", "PROFINET record write"];
            let mut texts: Vec<String> = titles.map(|title| format!("{title}: {address} bytes 2–3")).into();
            texts.push(format!("PROFINET record bytes: {bytes}"));
            texts
        };
        assert_eq!(texts(&number(Some(0x0304))), expected("01 02 03 04 05 06 07"));
        assert_eq!(texts(&number(None)), expected("01 02 xx xx 05 06 07"));
        let constant = Item { access: Access::Constant, ..number(Some(0x0304)) };
        assert_eq!(texts(&constant), expected("")[..1]);
        let text = item(Binding::Record { index: 2, bit_offset: 16, bits: 16 }, Type::VisibleString(Some(2)), None);
        assert_eq!(texts(&text), expected("")[..1]);
    }

    #[test]
    fn a_default_value_is_written() {
        let object = item(Binding::canopen(0x6040, 0), Type::Unsigned(16), Some(15));
        let expected = [
            "SDO upload (COB-ID, data): 601  40 40 60 00 00 00 00 00",
            "canopen read: node.sdo.upload(0x6040, 0)",
            "SDO download (COB-ID, data): 601  2B 40 60 00 0F 00 00 00",
            "canopen write: node.sdo.download(0x6040, 0, bytes.fromhex(\"0F00\"))",
        ];
        assert_eq!(texts(&object), expected);
    }

    #[test]
    fn an_unknown_value_has_no_bytes() {
        let object = item(Binding::canopen(0x607A, 0), Type::Integer(32), None);
        let expected = [
            "SDO download (COB-ID, data): 601  23 7A 60 00 xx xx xx xx",
            "canopen write: node.sdo.download(0x607A, 0, value.to_bytes(4, \"little\", signed=True))",
        ];
        assert_eq!(texts(&object)[2..], expected);
    }

    /// Returns an item in two registers, with the high word first. A 16-bit value is extended to both registers.
    fn extended(ty: Type, default: Option<i128>) -> Item {
        let register = RegisterBinding { extended: true, ..RegisterBinding::new(RegisterSpace::Holding, 16, 2) };
        item(Binding::Register(Box::new(register)), ty, default)
    }

    fn variant(bus: Bus) -> ItemVariant {
        ItemVariant { buses: Buses::from_iter([bus]), ..ItemVariant::default() }
    }

    #[track_caller]
    fn has(item: &Item, expected: &str) {
        let texts = texts(item);
        assert!(texts.iter().any(|text| text.contains(expected)), "{expected}: {texts:#?}");
    }

    #[test]
    fn only_signed_values_are_extended_with_their_sign() {
        has(&extended(Type::Unsigned(16), Some(0x9000)), "01 10 00 10 00 02 04 00 00 90 00 ");
        has(&extended(Type::Unsigned(16), None), "01 10 00 10 00 02 04 00 00 xx xx CRC");
        has(&extended(Type::Integer(16), Some(-0x7000)), "01 10 00 10 00 02 04 FF FF 90 00 ");
        has(&extended(Type::Integer(16), Some(0x7000)), "01 10 00 10 00 02 04 00 00 70 00 ");
        has(&extended(Type::Integer(16), None), "01 10 00 10 00 02 04 xx xx xx xx CRC");
        // The item has 32 bits, but its type on Modbus has 16 bits and determines the request.
        let mut other = extended(Type::Unsigned(32), None);
        other.variants.push(ItemVariant { ty: Some(Type::Integer(16)), ..variant(Bus::Modbus) });
        has(&other, "01 10 00 10 00 02 04 xx xx xx xx CRC");
    }

    #[test]
    fn each_bus_has_its_own_access_rights_and_type() {
        let buses = ObjectBuses { canopen: true, coe: true };
        let mut object = item(Binding::Object { buses, index: 0x2000, sub_index: 0 }, Type::Unsigned(16), Some(5));
        object.variants.push(ItemVariant { access: Some(Access::ReadOnly), ..variant(Bus::CanOpen) });
        object.variants.push(ItemVariant { ty: Some(Type::Unsigned(32)), ..variant(Bus::EtherCat) });
        let expected = [
            "SDO upload (COB-ID, data): 601  40 00 20 00 00 00 00 00",
            "canopen read: node.sdo.upload(0x2000, 0)",
            "pysoem read: slave.sdo_read(0x2000, 0)",
            "pysoem write: slave.sdo_write(0x2000, 0, bytes.fromhex(\"05000000\"))",
        ];
        assert_eq!(texts(&object), expected);
    }

    #[test]
    fn the_default_value_of_the_bus_is_written() {
        let mut register = extended(Type::Unsigned(16), Some(1));
        register.variants.push(ItemVariant { default: Some(Value::Int(7)), ..variant(Bus::Modbus) });
        has(&register, "01 10 00 10 00 02 04 00 00 00 07 ");
        let mut object = item(Binding::canopen(0x2000, 0), Type::Unsigned(8), Some(1));
        object.variants.push(ItemVariant { default: Some(Value::Int(7)), ..variant(Bus::Modbus) });
        has(&object, "601  2F 00 20 00 01 00 00 00");
    }

    #[test]
    fn a_default_value_with_the_node_id_has_bytes() {
        let mut object = item(Binding::canopen(0x1014, 0), Type::Unsigned(32), None);
        object.default = Some(Value::NodeId(0x80));
        has(&object, "601  23 14 10 00 81 00 00 00");
        object.default = Some(Value::NodeId(i128::MAX));
        has(&object, "601  23 14 10 00 xx xx xx xx");
    }
}

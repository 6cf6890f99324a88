//! Tests simulated Modbus devices with the client of the Python library `pymodbus`, over TCP and with RTU frames.

use lexibus::clients::modbus::tokio_modbus::ExceptionCode;
use lexibus::sim::{Device, Exception};
use lexibus::RegisterTable;
use serde_json::{json, Value};

use crate::modbus::registers::types::{Mode, Status, StatusDirection as Direction};
use crate::modbus::registers::{objects, ENTRIES};
use crate::python::{python, Script};
use server::{Framing, Registers, Server};

#[path = "../support/modbus_server.rs"]
#[allow(dead_code)] // the registers in memory
mod server;

/// A simulated device whose registers the server makes available.
struct Simulated(Device);

fn refused(exception: Exception) -> ExceptionCode {
    match exception {
        Exception::IllegalFunction => ExceptionCode::IllegalFunction,
        Exception::IllegalDataAddress => ExceptionCode::IllegalDataAddress,
        Exception::IllegalDataValue => ExceptionCode::IllegalDataValue,
        _ => ExceptionCode::ServerDeviceFailure,
    }
}

fn is_bits(table: RegisterTable) -> bool {
    matches!(table, RegisterTable::Coil | RegisterTable::DiscreteInput)
}

impl Registers for Simulated {
    fn read_words(&mut self, table: RegisterTable, address: u16, count: u16) -> Result<Vec<u16>, ExceptionCode> {
        if !is_bits(table) {
            return self.0.read_words(table, address, count).map_err(refused);
        }
        let bits = self.0.read_bits(table, address, count).map_err(refused)?;
        Ok(bits.into_iter().map(u16::from).collect())
    }

    fn write_words(&mut self, table: RegisterTable, address: u16, words: &[u16]) -> Result<(), ExceptionCode> {
        if !is_bits(table) {
            return self.0.write_words(table, address, words).map_err(refused);
        }
        let bits: Vec<bool> = words.iter().map(|word| *word != 0).collect();
        self.0.write_bits(table, address, &bits).map_err(refused)
    }

    fn mask_word(&mut self, address: u16, and: u16, or: u16) -> Result<(), ExceptionCode> {
        self.0.mask_word(address, and, or).map_err(refused)
    }

    fn exchange_words(&mut self, write: u16, words: &[u16], read: u16, count: u16) -> Result<Vec<u16>, ExceptionCode> {
        self.0.exchange_words(write, words, read, count).map_err(refused)
    }
}

type Served = server::Device<Simulated>;

/// Starts a simulated device, its server, and the Python client.
fn start(framing: Framing) -> Option<(Script, Served, Server)> {
    let python = python()?;
    let device = Served::new(Simulated(Device::new(ENTRIES)));
    let server = Server::start(&device, framing).expect("a server on 127.0.0.1");
    let name = if matches!(framing, Framing::Rtu) { "rtu" } else { "tcp" };
    let (script, _) = Script::start(python, "modbus_client.py", &[&server.address().port().to_string(), name]);
    Some((script, device, server))
}

impl Script {
    fn request(&mut self, method: &str, mut arguments: Value) -> Value {
        (arguments["do"], arguments["method"]) = (json!("request"), json!(method));
        self.ask(arguments)
    }
}

/// Checks both directions: the device must get the value that the client writes, and the client must read the value that the device
/// has.
macro_rules! exchange {
    ($script:ident, $device:ident, $($place:ident $item:ident: [$written:expr, $read:expr];)*) => {$(
        let answer = $script.ask(json!({ "do": "set", "name": stringify!($place), "value": $written }));
        assert_eq!(answer["exception"], Value::Null, "{}: {answer}", stringify!($place));
        assert_eq!($device.with(|device| device.0.get(objects::$item)), Ok($written), "{}", stringify!($place));
        $device.with(|device| device.0.set(objects::$item, $read)).expect("a value");
        assert_eq!($script.at(stringify!($place)), json!($read), "{}", stringify!($place));
    )*};
}

fn numbers(script: &mut Script, device: &Served) {
    exchange! { script, device,
        high_u16 HIGH_U16: [0xA55A, 1];
        high_i16 HIGH_I16: [-2, i16::MIN];
        high_u32 HIGH_U32: [0x1234_5678, u32::MAX - 1];
        high_i32 HIGH_I32: [-0x1234_5678, i32::MIN + 1];
        high_f32 HIGH_F32: [-1.5, 16_777_215.0];
        high_u64 HIGH_U64: [0x0123_4567_89AB_CDEF_u64, u64::MAX - 1];
        high_i64 HIGH_I64: [-0x0123_4567_89AB_CDEF_i64, i64::MIN + 1];
        high_f64 HIGH_F64: [-0.1, 1e300];
        low_u32 LOW_U32: [0x1234_5678, u32::MAX - 1];
        low_i32 LOW_I32: [-0x1234_5678, i32::MIN + 1];
        low_f32 LOW_F32: [-1.5, 16_777_215.0];
        low_u64 LOW_U64: [0x0123_4567_89AB_CDEF_u64, u64::MAX - 1];
        low_f64 LOW_F64: [-0.1, 1e300];
        swapped_u16 SWAPPED_U16: [0x1234, 0xFF00];
        swapped_u32 SWAPPED_U32: [0x1234_5678, u32::MAX - 1];
        swapped_low_i32 SWAPPED_LOW_I32: [-0x1234_5678, i32::MIN + 1];
        swapped_low_f64 SWAPPED_LOW_F64: [-0.1, 1e300];
        temperature TEMPERATURE: [-400, 215];
    }
    assert_eq!(device.with(|device| device.0.set(objects::INPUT_U32, 0x89AB_CDEF)), Ok(()));
    assert_eq!(device.with(|device| device.0.set(objects::INPUT_LOW_F32, -1.5)), Ok(()));
    assert_eq!((script.at("input_u32"), script.at("input_low_f32")), (json!(0x89AB_CDEF_u32), json!(-1.5)));
}

/// Checks parts of a register, enumerations and bit fields.
fn parts_and_meanings(script: &mut Script, device: &Served) {
    script.ask(json!({ "do": "set", "name": "word_300", "value": 0xFE34 }));
    device.with(|device| {
        assert_eq!((device.0.get(objects::LOWER_BYTE), device.0.get(objects::UPPER_BYTE)), (Ok(0x34), Ok(-2)));
        device.0.set(objects::UPPER_BYTE, 0x12).expect("a value");
        device.0.set(objects::MODE, Mode::ByHand).expect("a value");
        let status = Status::new().with_running(true).with_direction(Direction::Backward);
        device.0.set(objects::STATUS, status).expect("a value");
    });
    assert_eq!(script.at("word_300"), 0x1234);
    assert_eq!((script.at("mode"), script.at("status")), (json!(2), json!(0b1001)));
}

fn bits(script: &mut Script, device: &Served) {
    device.with(|device| device.0.set(objects::DISCRETES, 0b10_0000_0001)).expect("a value");
    let mut expected = vec![false; 10];
    (expected[0], expected[9]) = (true, true);
    assert_eq!(script.request("read_discrete_inputs", json!({ "address": 5, "count": 10 }))["bits"], json!(expected));
    script.request("write_coil", json!({ "address": 0, "value": true }));
    let values = [true, false, false, true, false, false, true, true];
    script.request("write_coils", json!({ "address": 8, "values": values }));
    let coils = device.with(|device| (device.0.get(objects::COIL), device.0.get(objects::COILS)));
    assert_eq!(coils, (Ok(true), Ok(0b1100_1001)));
    assert_eq!(script.request("read_coils", json!({ "address": 8, "count": 8 }))["bits"], json!(values));
}

/// Checks the functions 22 and 23, and several items in one request.
fn further_functions(script: &mut Script, device: &Served) {
    script.ask(json!({ "do": "set", "name": "high_u16", "value": 0x12 }));
    script.request("mask_write_register", json!({ "address": 0, "and_mask": 0xF2, "or_mask": 0x25 }));
    assert_eq!(device.with(|device| device.0.get(objects::HIGH_U16)), Ok(0x17));
    let arguments = json!({ "read_address": 0, "read_count": 4, "write_address": 1, "values": [0xFFFD, 0, 5] });
    let answer = script.request("readwrite_registers", arguments);
    assert_eq!(answer["registers"], json!([0x17, 0xFFFD, 0, 5]), "the device writes before it reads");
    let values = device.with(|device| (device.0.get(objects::HIGH_I16), device.0.get(objects::HIGH_U32)));
    assert_eq!(values, (Ok(-3), Ok(5)));
}

/// Checks the exceptions of the device: 2 (illegal data address) and 3 (illegal data value).
fn refusals(script: &mut Script, device: &Served) {
    let exception = |answer: Value| answer["exception"].as_u64();
    // Holding register 30, input register 100 and coil 5 don't exist.
    for (method, arguments, expected) in [
        ("read_holding_registers", json!({ "address": 30, "count": 1 }), 2),
        ("read_holding_registers", json!({ "address": 29, "count": 2 }), 2),
        ("write_register", json!({ "address": 30, "value": 1 }), 2),
        ("write_registers", json!({ "address": 29, "values": [1, 1] }), 2),
        ("read_input_registers", json!({ "address": 100, "count": 1 }), 2),
        ("write_coil", json!({ "address": 5, "value": true }), 2),
        ("mask_write_register", json!({ "address": 30, "and_mask": 0, "or_mask": 1 }), 2),
        // The temperature has the range -400 to 1250.
        ("write_register", json!({ "address": 304, "value": 1251 }), 3),
    ] {
        let answer = script.request(method, arguments.clone());
        assert_eq!(exception(answer), Some(expected), "{method} {arguments}");
    }
    assert_eq!(device.with(|device| device.0.get(objects::TEMPERATURE)), Ok(215));
    assert_eq!(script.at("high_u16"), 0x17, "the next request");
}

fn all_scenarios(framing: Framing) {
    let Some((mut script, device, _server)) = start(framing) else { return };
    numbers(&mut script, &device);
    parts_and_meanings(&mut script, &device);
    bits(&mut script, &device);
    further_functions(&mut script, &device);
    refusals(&mut script, &device);
}

#[test]
fn over_tcp() {
    all_scenarios(Framing::Tcp);
}

#[test]
fn with_rtu_frames() {
    all_scenarios(Framing::Rtu);
}

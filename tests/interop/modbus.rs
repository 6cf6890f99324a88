//! Tests generated accessors on Modbus with servers of the Python library `pymodbus`: over TCP and RTU, with blocking
//! and asynchronous clients.
//!
//! Each scenario is a macro, which the tests expand for all four combinations of transport and client.

use std::net::SocketAddr;
use std::time::Duration;

use lexibus::clients::modbus::tokio_modbus::{ExceptionCode, Slave};
use lexibus::clients::modbus::{sync, tcp, BlockingLink, Link, ModbusClient, ModbusError};
use lexibus::modbus::{AsyncRegisterClient as _, Limits, RegisterClient as _, TableLimits};
use serde_json::{json, Value};
use tokio_serial::SerialStream;

use crate::block_on;
use crate::pty::Cable;
use crate::python::{python, Script};

lexibus::dictionary! {
    /// The bindings of the server's registers.
    pub mod registers = "tests/interop/registers.toml" { table: true }
}

use registers::objects::{COILS, HIGH_I16, HIGH_U16, HIGH_U32, INPUT_U32, LOW_F32, LOW_I32, NEXT_COIL};
use registers::types::{Mode, Status, StatusDirection as Direction};
use registers::Registers;

/// Maximum time to wait for a response. The Python server replies slowly on a machine under load.
pub const PATIENCE: Duration = Duration::from_secs(20);

/// The server's unit ID.
pub const DEVICE: Slave = Slave(1);

/// Bit rate of the serial line, which determines the silent interval between RTU frames.
pub const BAUD: u32 = 115_200;

pub type Error = lexibus::Error<ModbusError>;

impl Script {
    /// Returns the value with this name, which `pymodbus` decodes from the server's registers.
    pub fn at(&mut self, name: &str) -> Value {
        self.ask(json!({ "do": "get", "name": name }))
    }

    /// Sets the value with this name, which `pymodbus` encodes in the server's registers.
    fn put(&mut self, name: &str, value: Value) {
        self.ask(json!({ "do": "set", "name": name, "value": value }));
    }

    /// Returns the function codes of all requests since the last call.
    pub fn functions(&mut self) -> Value {
        self.ask(json!({ "do": "functions" }))
    }
}

/// Starts a server over TCP. Returns the server and its address, or `None` if Python or a library is missing.
pub fn over_tcp() -> Option<(Script, SocketAddr)> {
    let (script, port) = Script::start(python()?, "modbus_server.py", &["tcp"]);
    let port = port.as_u64().and_then(|port| port.try_into().ok()).expect("a port");
    Some((script, SocketAddr::from(([127, 0, 0, 1], port))))
}

/// Starts an RTU server on a simulated serial line. Returns the server and the line for the client, or `None` if Python or a
/// library is missing.
pub fn over_rtu() -> Option<(Script, Cable)> {
    let python = python()?;
    let cable = Cable::open();
    let (script, _) = Script::start(python, "modbus_server.py", &["rtu", cable.ends()[1]]);
    Some((script, cable))
}

/// Checks both directions: writes a value and compares it on the server, then sets a value on the server and reads it.
macro_rules! exchange {
    ($access:ident, $script:ident, $device:ident, $($place:ident: [$($value:expr),*];)*) => {$(
        $(
            $access!($device.$place(), write $value)?;
            assert_eq!($script.at(stringify!($place)), json!($value), "{} written", stringify!($place));
        )*
        $(
            $script.put(stringify!($place), json!($value));
            assert_eq!($access!($device.$place(), read)?, $value, "{} read", stringify!($place));
        )*
    )*};
}

/// Writes texts and compares them on the server, then sets texts on the server and reads them.
macro_rules! exchange_texts {
    ($access:ident, $script:ident, $device:ident, $($place:ident)*) => {$(
        for text in ["a", "bc", "def", "nineteen characters", "exactly 20 letters, "] {
            $access!($device.$place(), write text)?;
            assert_eq!($script.at(stringify!($place)), text, "{} written", stringify!($place));
            let text: String = text.chars().rev().collect();
            $script.put(stringify!($place), text.as_str().into());
            assert_eq!($access!($device.$place(), read_into &mut [0; 32])?, text, "{} read", stringify!($place));
        }
    )*};
}

macro_rules! numbers {
    ($access:ident, $script:ident, $device:ident) => {
        exchange! { $access, $script, $device,
            high_u16: [0xA55A, 1];
            high_i16: [-2, i16::MIN];
            high_u32: [0x1234_5678, u32::MAX - 1];
            high_i32: [-0x1234_5678, i32::MIN + 1];
            high_f32: [-1.5, 16_777_215.0];
            high_u64: [0x0123_4567_89AB_CDEF_u64, u64::MAX - 1];
            high_i64: [-0x0123_4567_89AB_CDEF_i64, i64::MIN + 1];
            high_f64: [-0.1, 1e300];
            low_u16: [0xA55A, 1];
            low_i16: [-2, i16::MIN];
            low_u32: [0x1234_5678, u32::MAX - 1];
            low_i32: [-0x1234_5678, i32::MIN + 1];
            low_f32: [-1.5, 16_777_215.0];
            low_u64: [0x0123_4567_89AB_CDEF_u64, u64::MAX - 1];
            low_i64: [-0x0123_4567_89AB_CDEF_i64, i64::MIN + 1];
            low_f64: [-0.1, 1e300];
            swapped_u16: [0x1234, 0xFF00];
            swapped_u32: [0x1234_5678, u32::MAX - 1];
            swapped_low_i32: [-0x1234_5678, i32::MIN + 1];
            swapped_low_f64: [-0.1, 1e300];
        }
        exchange_texts! { $access, $script, $device, high_text low_text swapped_text }
    };
}

macro_rules! parts_and_meanings {
    ($access:ident, $script:ident, $device:ident) => {
        $script.put("word_300", json!(0x1234));
        assert_eq!($access!($device.lower_byte(), read)?, 0x34);
        assert_eq!($access!($device.upper_byte(), read)?, 0x12);
        $access!($device.upper_byte(), write -2)?;
        assert_eq!($script.at("word_300"), 0xFE34);
        $access!($device.lower_byte(), write 0x56)?;
        assert_eq!($script.at("word_300"), 0xFE56);
        $script.put("word_301", json!(0x0F2F));
        assert_eq!($access!($device.three_bits(), read)?, 2);
        $access!($device.three_bits(), write 5)?;
        $access!($device.one_bit(), write true)?;
        assert_eq!($script.at("word_301"), 0x8F5F);

        exchange! { $access, $script, $device, temperature: [-400, 215]; }
        assert_eq!($access!($device.temperature(), read_scaled)?, 21.5);
        $access!($device.temperature(), write_scaled -12.3)?;
        assert_eq!($script.at("temperature"), -123);
        assert!(matches!($access!($device.temperature(), write 1251).map_err(Error::from), Err(Error::OutOfRange(_))));
        $access!($device.mode(), write Mode::ByHand)?;
        assert_eq!($script.at("mode"), 2);
        $script.put("mode", json!(7));
        assert_eq!($access!($device.mode(), read)?, Mode::Unknown(7));
        let status = Status::new().with_running(true).with_direction(Direction::Backward);
        $access!($device.status(), write status)?;
        assert_eq!($script.at("status"), 0b1001);
        $script.put("status", json!(0b0110));
        let status = $access!($device.status(), read)?;
        assert_eq!((status.running(), status.fault(), status.direction()), (false, true, Direction::Forward));
        // The word after the three written words must not change.
        $script.put("words_305", json!(0x1111_2222_3333_4444_u64));
        assert_eq!($access!($device.three_words(), read)?, 0x1111_2222_3333);
        $access!($device.three_words(), write 0xFEDC_BA98_7654)?;
        assert_eq!($script.at("words_305"), 0xFEDC_BA98_7654_4444_u64);
    };
}

macro_rules! other_tables {
    ($access:ident, $script:ident, $device:ident) => {
        $script.put("input_i16", json!(-2));
        assert_eq!($access!($device.input_i16(), read)?, -2);
        $script.put("input_u32", json!(0x89AB_CDEF_u32));
        assert_eq!($access!($device.input_u32(), read)?, 0x89AB_CDEF);
        $script.put("input_low_f32", json!(-1.5));
        assert_eq!($access!($device.input_low_f32(), read)?, -1.5);
        $script.put("input_text", json!("a text of inputs"));
        assert_eq!($access!($device.input_text(), read_into &mut [0; 32])?, "a text of inputs");

        $access!($device.coil(), write true)?;
        $access!($device.coils(), write 0b1000_0110)?;
        $access!($device.more_coils(), write 0b1001_0000_0001)?;
        assert_eq!($script.at("coils"), json!([0, 9, 10, 15, 19, 27, 30]));
        $access!($device.coil(), write false)?;
        $access!($device.next_coil(), write true)?;
        assert_eq!($script.at("coils"), json!([1, 9, 10, 15, 19, 27, 30]));
        $script.put("coils", json!([1, 8, 11, 20, 30]));
        assert!(!$access!($device.coil(), read)?);
        assert!($access!($device.next_coil(), read)?);
        assert_eq!($access!($device.coils(), read)?, 0b0000_1001);
        assert_eq!($access!($device.more_coils(), read)?, 0b1000_0000_0010);
        $script.put("discretes", json!([2, 5, 14, 15]));
        assert!($access!($device.discrete(), read)?);
        assert_eq!($access!($device.discretes(), read)?, 0b10_0000_0001);
    };
}

/// Checks that the client reports the Modbus exceptions that the server returns.
macro_rules! refusals {
    ($access:ident, $script:ident, $device:ident) => {
        let refused = [
            $access!($device.missing(), read).map(|_| ()),
            $access!($device.missing(), write 1),
            $access!($device.half_missing(), read).map(|_| ()),
            $access!($device.half_missing(), write 1),
            $access!($device.protected(), write 1),
        ];
        for refused in refused {
            let refused = refused.map_err(Error::from);
            let is_exception = matches!(
                refused,
                Err(Error::Client(ModbusError::Exception(ExceptionCode::IllegalDataAddress)))
            );
            assert!(is_exception, "{refused:?}");
        }
        // The next request after the exceptions must succeed.
        assert_eq!($access!($device.protected(), read)?, 0);
    };
}

/// Checks which function codes the clients use for each kind of access.
macro_rules! functions {
    ($access:ident, $script:ident, $device:ident) => {
        $script.functions();
        $access!($device.high_u16(), write 1)?;
        $access!($device.low_u32(), write 1)?;
        $access!($device.lower_byte(), write 1)?;
        $access!($device.low_u32(), read)?;
        $access!($device.input_u32(), read)?;
        $access!($device.coil(), write true)?;
        $access!($device.coils(), write 1)?;
        $access!($device.coils(), read)?;
        $access!($device.discretes(), read)?;
        assert_eq!($script.functions(), json!([6, 16, 3, 6, 3, 4, 5, 15, 1, 2]));
    };
}

/// Checks that one request per table reads adjacent items.
macro_rules! blocks {
    ($access:ident, $script:ident, $device:ident) => {
        $script.put("high_u16", json!(0xA55A));
        $script.put("high_i16", json!(-2));
        $script.put("high_u32", json!(0x1234_5678));
        $script.put("low_i32", json!(-0x1234_5678));
        $script.put("low_f32", json!(-1.5));
        $script.put("input_u32", json!(0x89AB_CDEF_u32));
        $script.put("coils", json!([1, 8, 11]));
        $script.functions();
        let values = $access!($device.client(), read_block(HIGH_U32, HIGH_U16, HIGH_I16))?;
        assert_eq!(values, (0x1234_5678, 0xA55A, -2));
        assert_eq!($script.functions(), json!([3]));
        let values = $access!($device.client(), read_block(LOW_I32, LOW_F32, INPUT_U32, COILS, NEXT_COIL))?;
        assert_eq!(values, (-0x1234_5678, -1.5, 0x89AB_CDEF, 0b0000_1001, true));
        let functions = $script.functions();
        let mut functions: Vec<u64> = functions.as_array().into_iter().flatten().filter_map(Value::as_u64).collect();
        functions.sort_unstable();
        // The coils are not adjacent, so reading them needs two requests.
        assert_eq!(functions, [1, 1, 3, 4]);
    };
}

/// Checks the functions 22 and 23, which the client's limits allow.
macro_rules! optional_functions {
    ($access:ident, $script:ident, $device:ident) => {
        $script.put("word_300", json!(0x1234));
        $script.put("high_i16", json!(0x0F0F));
        $script.functions();
        $access!($device.upper_byte(), write -2)?;
        assert_eq!($script.at("word_300"), 0xFE34);
        $access!($device.client(), write_masked HIGH_I16, 0x1111, 0x00FF)?;
        assert_eq!($script.at("high_i16"), 0x0F11);
        assert_eq!($script.functions(), json!([22, 22]));

        $script.put("low_i32", json!(-0x1234_5678));
        let values = $access!($device.client(), exchange (HIGH_U16, HIGH_I16), (0xA55A, -3), (LOW_I32,))?;
        assert_eq!(values, (-0x1234_5678,));
        assert_eq!(($script.at("high_u16"), $script.at("high_i16")), (json!(0xA55A), json!(-3)));
        // The server writes before it reads.
        assert_eq!($access!($device.client(), exchange (HIGH_U32,), (5,), (HIGH_U32, HIGH_I16))?, (5, -3));
        $access!($device.client(), write_block (HIGH_I16, HIGH_U16), (-4, 6))?;
        assert_eq!(($script.at("high_u16"), $script.at("high_i16")), (json!(6), json!(-4)));
        assert_eq!($script.functions(), json!([23, 23, 16]));
    };
}

/// Limits of a server with the functions 22 and 23.
pub const OPTIONAL: Limits =
    Limits { holding: TableLimits { functions: &[3, 6, 16, 22, 23], ..TableLimits::HOLDING }, ..Limits::STANDARD };

macro_rules! all_scenarios {
    ($access:ident, $script:ident, $device:ident) => {
        numbers! { $access, $script, $device }
        parts_and_meanings! { $access, $script, $device }
        other_tables! { $access, $script, $device }
        refusals! { $access, $script, $device }
        functions! { $access, $script, $device }
        blocks! { $access, $script, $device }
        let client = $device.into_client().with_limits(OPTIONAL);
        let mut device = Registers::new(client);
        optional_functions! { $access, $script, device }
    };
}

#[test]
fn tcp_blocking() -> Result<(), Error> {
    let Some((mut script, address)) = over_tcp() else { return Ok(()) };
    let link = BlockingLink::tcp(address, DEVICE, PATIENCE).expect("a connection");
    let mut device = Registers::new(ModbusClient::new(link));
    all_scenarios! { blocking, script, device }
    Ok(())
}

#[test]
fn rtu_blocking() -> Result<(), Error> {
    let Some((mut script, cable)) = over_rtu() else { return Ok(()) };
    let line = tokio_serial::new(cable.ends()[0], BAUD);
    let link = BlockingLink::open(async { Ok(Link::rtu(SerialStream::open(&line)?, DEVICE, PATIENCE)) });
    let mut device = Registers::new(ModbusClient::new(link.expect("a serial line")));
    all_scenarios! { blocking, script, device }
    Ok(())
}

#[test]
fn tcp_not_blocking() -> Result<(), Error> {
    let Some((mut script, address)) = over_tcp() else { return Ok(()) };
    block_on(async {
        let context = tcp::connect_slave(address, DEVICE).await.expect("a connection");
        let mut device = Registers::new(ModbusClient::new(context));
        all_scenarios! { awaited, script, device }
        Ok(())
    })
}

#[test]
fn rtu_not_blocking() -> Result<(), Error> {
    let Some((mut script, cable)) = over_rtu() else { return Ok(()) };
    block_on(async {
        let line = SerialStream::open(&tokio_serial::new(cable.ends()[0], BAUD)).expect("a serial line");
        let mut device = Registers::new(ModbusClient::new(Link::rtu(line, DEVICE, PATIENCE)));
        all_scenarios! { awaited, script, device }
        Ok(())
    })
}

/// Tests a device that supports only function 16 for writing.
#[test]
fn single_registers_by_function_16() -> Result<(), Error> {
    let Some((mut script, address)) = over_tcp() else { return Ok(()) };
    let context = sync::tcp::connect_slave_with_timeout(address, DEVICE, Some(PATIENCE)).expect("a connection");
    let mut device = Registers::new(ModbusClient::new(context).with_single_writes(false));
    device.high_u16().write(0x1234)?;
    assert_eq!(script.at("high_u16"), 0x1234);
    assert_eq!(script.functions(), json!([16]));
    Ok(())
}

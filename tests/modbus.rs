//! Tests generated accessors with a simulated Modbus server (`tokio-modbus`), over TCP and with RTU frames. The tests
//! check both values and requests.

#[path = "support/modbus_server.rs"]
mod server;

use lexibus::clients::modbus::{rtu, sync, tcp, ModbusClient, ModbusError};
use lexibus::modbus::{AsyncRegisterClient, Limits, RegisterClient, TableLimits};
use lexibus::RegisterTable::{Coil, DiscreteInput, Holding, Input};
use lexibus::{Error, Flags, Item, OnModbus, Register, Ro, Rw};
use server::{Device, Framing, Map, Registers, Server};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio_modbus::{ExceptionCode, Slave};

lexibus::dictionary! {
    /// A fictitious frequency inverter.
    pub mod inverter = "examples/inverter.toml";
}

use inverter::types::{Control, Mode};
use inverter::{objects, Inverter};

type Client = ModbusClient<sync::Context>;

/// Returns the registers of the inverter with their initial values.
fn registers() -> Map {
    Map::default()
        .with(Holding, 0, &[1500, 25, 0x0001, 0x86A0, 0xFFFD, 0x6400, 0x5678, 0x1234, 0x2211, 0x4433])
        .with(Holding, 10, &[0x5075, 0x6D70, 0x2037, 0])
        .with(Holding, 14, &[0xBEEF, 125])
        .with(Holding, 19, &[0x4142, 0x4344, 0x4546, 0x4748, 0x494A])
        .with(Input, 0, &[0xFA38, 73, 0x7960, 0xFFFE, 0x7FFF])
        .with(Input, 8, &[2, 1])
        .with(Coil, 0, &[1])
        .with(Coil, 2, &[1, 0, 1, 0, 0, 1, 0, 1])
        .with(DiscreteInput, 0, &[0, 1])
}

fn connected() -> (Device<Map>, Server, Inverter<Client>) {
    let device = Device::new(registers());
    let server = Server::start(&device, Framing::Tcp).expect("a server");
    let context = sync::tcp::connect(server.address()).expect("a connection");
    let inverter = Inverter::new(ModbusClient::new(context).with_limits(inverter::MODBUS));
    (device, server, inverter)
}

/// Returns `count` words from a table of the device.
fn words(device: &Device<Map>, table: lexibus::RegisterTable, address: u16, count: u16) -> Vec<u16> {
    device.with(|map| map.read_words(table, address, count)).expect("registers")
}

#[test]
fn values_in_registers() {
    let (device, _server, mut inverter) = connected();
    assert_eq!(inverter.speed_setpoint().read().unwrap(), 1500);
    // The following items have the high word first, the low word first, or swapped bytes.
    assert_eq!(inverter.distance().read_scaled().unwrap(), 1000.0);
    assert_eq!(inverter.energy().read().unwrap(), 0x1234_5678);
    assert_eq!(inverter.serial_number().read().unwrap(), 0x1122_3344);
    assert_eq!(inverter.position().read().unwrap(), -100_000);
    assert_eq!(inverter.name().read_into(&mut [0; 8]).unwrap(), "Pump 7");
    assert_eq!(inverter.temperature().read_scaled().unwrap(), None);
    inverter.distance().write(-2).unwrap();
    inverter.name().write("Fan 12").unwrap();
    assert_eq!(words(&device, Holding, 2, 2), [0xFFFF, 0xFFFE]);
    assert_eq!(words(&device, Holding, 10, 4), [0x4661, 0x6E20, 0x3132, 0]);
    inverter.control().write(Control::new().with_reverse(true)).unwrap();
    assert_eq!(words(&device, Holding, 4, 1), [2]);
}

#[test]
fn parts_are_read_before_they_are_written() {
    let (device, _server, mut inverter) = connected();
    inverter.mode().write(Mode::Position).unwrap();
    inverter.brake_delay().write(7).unwrap();
    assert_eq!(words(&device, Holding, 5, 1), [0x0701]);
    let requests = ["ReadHoldingRegisters(5, 1)", "WriteSingleRegister(5, 25601)"];
    assert_eq!(device.requests()[..2], requests);
    assert_eq!((inverter.mode().read().unwrap(), inverter.brake_delay().read().unwrap()), (Mode::Position, 7));
}

#[test]
fn bits() {
    let (device, _server, mut inverter) = connected();
    assert!(inverter.fan().read().unwrap());
    assert!(inverter.emergency_stop().read().unwrap() && !inverter.limit_switch().read().unwrap());
    assert_eq!(inverter.relays().read().unwrap(), 0b1010_0101);
    inverter.fan().write(false).unwrap();
    inverter.relays().write(0b0000_0110).unwrap();
    assert_eq!(words(&device, Coil, 0, 1), [0]);
    assert_eq!(words(&device, Coil, 2, 8), [0, 1, 1, 0, 0, 0, 0, 0]);
}

#[test]
fn blocks_are_as_few_requests_as_the_device_allows() {
    let (device, _server, mut inverter) = connected();
    let client = inverter.client();
    let (position, speed, current) = client.read_block((objects::POSITION, objects::SPEED, objects::CURRENT)).unwrap();
    assert_eq!((position, speed, objects::CURRENT.physical(current)), (-100_000, -1480, 7.3));
    assert_eq!(device.requests(), ["ReadInputRegisters(0, 4)"]);

    // The password is write-only, registers 30006 to 30008 do not exist, and a request can read at most 16 registers.
    let values = client.read_block((
        objects::CURRENT_LIMIT,
        objects::HOURS,
        objects::SPEED_SETPOINT,
        objects::RELAYS,
        objects::SERIAL_NUMBER,
        objects::BRAKE_DELAY,
        objects::TEMPERATURE,
        objects::MODE,
        objects::ENERGY,
        objects::FAN,
    ));
    let values = values.unwrap();
    assert_eq!((values.0, values.1, values.2, values.3), (125, 0x0001_0002, 1500, 0b1010_0101));
    assert_eq!((values.4, values.5, values.6, values.7), (0x1122_3344, 0x64, 0x7FFF, Mode::Speed));
    assert_eq!((values.8, values.9), (0x1234_5678, true));
    let requests = [
        "ReadHoldingRegisters(15, 1)",
        "ReadHoldingRegisters(0, 10)",
        "ReadInputRegisters(8, 2)",
        "ReadInputRegisters(4, 1)",
        "ReadCoils(0, 1)",
        "ReadCoils(2, 8)",
    ];
    let mut sent = device.requests();
    sent.sort();
    let mut expected = requests.map(str::to_owned);
    expected.sort();
    assert_eq!(sent, expected);

    let [stop, limit] = client.read_block([objects::EMERGENCY_STOP, objects::LIMIT_SWITCH]).unwrap();
    assert_eq!((stop, limit, device.requests().len()), (true, false, 1));
}

#[test]
fn one_value_that_is_missing_fails_its_request() {
    type RegisterItem = Item<u16, Ro, OnModbus>;
    const MISSING: RegisterItem = RegisterItem::register(Register::new(Input, 5, 1), "Missing", Flags::NONE);
    let (device, _server, mut inverter) = connected();
    let failed = inverter.client().read_block((MISSING, objects::TEMPERATURE)).unwrap_err();
    assert!(matches!(failed.error, Error::Client(ModbusError::Exception(ExceptionCode::IllegalDataAddress))));
    let text = failed.to_string();
    assert!(text.starts_with("read Missing and 1 other item (input register 4): "), "{text}");
    assert_eq!(device.requests(), ["ReadInputRegisters(4, 2)"]);
}

#[test]
fn what_the_device_does_not_take_is_not_sent() {
    let (device, _server, mut inverter) = connected();
    assert_eq!(inverter.recipe().read_into(&mut [0; 10]).unwrap(), "ABCDEFGHIJ");
    let refused = inverter.recipe().write("recipe").map_err(Error::from);
    assert!(matches!(refused, Err(Error::Client(ModbusError::TooLong { count: 5, max: 4 }))));
    assert!(matches!(inverter.speed_setpoint().write(3001).map_err(Error::from), Err(Error::OutOfRange(_))));
    assert_eq!(device.requests(), ["ReadHoldingRegisters(19, 5)"]);
    // With these limits, the client has no function for writing several registers, and may split a value into several requests.
    let context = inverter.into_client().into_context();
    let holding = TableLimits { functions: &[3, 6], max_read: 3, split: true, ..TableLimits::HOLDING };
    let mut inverter = Inverter::new(ModbusClient::new(context).with_limits(Limits { holding, ..Limits::STANDARD }));
    inverter.distance().write(100_000).unwrap();
    assert_eq!(inverter.recipe().read_into(&mut [0; 10]).unwrap(), "ABCDEFGHIJ");
    assert_eq!(
        device.requests(),
        [
            "WriteSingleRegister(2, 1)",
            "WriteSingleRegister(3, 34464)",
            "ReadHoldingRegisters(19, 3)",
            "ReadHoldingRegisters(22, 2)"
        ]
    );
}

fn runtime() -> tokio::runtime::Runtime {
    tokio::runtime::Builder::new_current_thread().enable_io().build().expect("a runtime")
}

/// Tests asynchronous clients, which must send the same requests as blocking clients.
async fn without_blocking(mut inverter: Inverter<ModbusClient<tokio_modbus::client::Context>>, device: &Device<Map>) {
    inverter.distance().write_async(123_456).await.unwrap();
    inverter.mode().write_async(Mode::Position).await.unwrap();
    inverter.relays().write_async(0xFF).await.unwrap();
    assert_eq!(inverter.name().read_into_async(&mut [0; 8]).await.unwrap(), "Pump 7");
    assert!(inverter.recipe().write_async("recipe").await.is_err());
    device.requests();
    let block = (objects::MODE, objects::ENERGY, objects::DISTANCE, objects::RELAYS);
    let values = inverter.client().read_block_async(block).await.unwrap();
    assert_eq!(values, (Mode::Position, 0x1234_5678, 123_456, 0xFF));
    assert_eq!(device.requests(), ["ReadHoldingRegisters(2, 6)", "ReadCoils(2, 8)"]);
}

#[test]
fn tcp_without_blocking() {
    let device = Device::new(registers());
    let server = Server::start(&device, Framing::Tcp).expect("a server");
    runtime().block_on(async {
        let context = tcp::connect(server.address()).await.expect("a connection");
        let client = ModbusClient::new(context).with_limits(inverter::MODBUS);
        without_blocking(Inverter::new(client), &device).await;
    });
}

#[test]
fn frames_of_rtu_without_blocking() {
    let device = Device::new(registers());
    let server = Server::start(&device, Framing::Rtu).expect("a server");
    runtime().block_on(async {
        let line = tokio::net::TcpStream::connect(server.address()).await.expect("a connection");
        let client = ModbusClient::new(rtu::attach_slave(line, Slave(5))).with_limits(inverter::MODBUS);
        without_blocking(Inverter::new(client), &device).await;
    });
}

/// Items for the registers R00, R01 and R06 of the Eco drive. The register at each address has 32 bits.
type Wide<V> = Item<V, Rw, OnModbus>;
const R00: Wide<u32> = Wide::register(Register::high_first(0x8000, 2).words_per_address(2), "R00", Flags::NONE);
const R01: Wide<i32> = Wide::register(Register::high_first(0x8001, 2).words_per_address(2), "R01", Flags::NONE);
const LOW_R01: Wide<i16> = Wide::register(Register::holding(0x8001).words_per_address(2), "R01, low half", Flags::NONE);
const LOW_R06: Wide<i16> = Wide::register(Register::holding(0x8006).words_per_address(2), "R06, low half", Flags::NONE);

#[test]
fn addresses_of_32_bits() {
    // The example in section "Codice 0x03: lettura dei parametri e dei registri" of the manual. R00 and R01 of node 5
    // are four registers from address 0x8000. The printed response contains only one of the two values.
    let frames: [(&[u8], &[u8]); 2] = [
        (
            &[0x05, 0x03, 0x80, 0x00, 0x00, 0x04, 0x6C, 0x4D],
            &[0x05, 0x03, 0x08, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88, 0x61, 0xAC],
        ),
        // A request for a single register must return the low word of the value.
        (&[0x05, 0x03, 0x80, 0x06, 0x00, 0x01, 0x4C, 0x4F], &[0x05, 0x03, 0x02, 0xFF, 0xFE, 0x89, 0xF4]),
    ];
    runtime().block_on(async {
        let (near, mut far) = tokio::io::duplex(64);
        let mut drive = ModbusClient::new(rtu::attach_slave(near, Slave(5)));
        let answers = async {
            for (request, reply) in frames {
                let mut sent = vec![0; request.len()];
                far.read_exact(&mut sent).await.expect("a request");
                assert_eq!(sent, request);
                far.write_all(reply).await.expect("an answer");
            }
        };
        let (values, ()) = tokio::join!(drive.read_block_async((LOW_R06, LOW_R01, R01, R00)), answers);
        // The low word of R01 is the second word of the value in the reply.
        assert_eq!(values.unwrap(), (-2, 0x7788, 0x5566_7788, 0x1122_3344));
    });
}

//! Requests that write and read registers (function 23).

use std::vec;

use tokio_modbus::{Request, Response};

use super::request::{response, Pieces};
use super::{ModbusError, Reply};
use crate::error::Error;
use crate::modbus::{is_combined, Limits};
use crate::register::{Register, RegisterTable};

/// A request that writes registers and then reads registers (MODBUS Application Protocol V1.1b3, 6.17).
#[derive(Clone, Copy, Debug)]
pub(super) struct ReadWrite {
    write: Register,
    read: Register,
}

impl ReadWrite {
    /// Returns the request, or `None` if the access needs two requests. Two requests are necessary if the device's
    /// limits don't contain function 23. They are also necessary if one of the values isn't in whole holding registers,
    /// is too long, or ends after the last address.
    pub(super) fn new(write: Register, read: Register, limits: &Limits) -> Option<Self> {
        let fits = |register, max| Pieces::new(register, max, false).is_ok();
        let is_possible = is_combined(&write, &read)
            && fits(write, limits.max_exchanged())
            && fits(read, limits.max_read(RegisterTable::Holding));
        is_possible.then_some(Self { write, read })
    }

    pub(super) fn request(&self, data: &[u8]) -> Result<Request<'static>, Error<ModbusError>> {
        let mut words = vec![0; usize::from(self.write.count)];
        self.write.encode(data, &mut words)?;
        let Self { write, read } = self;
        Ok(Request::ReadWriteMultipleRegisters(read.address, read.count, write.address, words.into()))
    }

    /// Writes the value in the reply to the start of `buffer` and returns its length in bytes.
    pub(super) fn value(&self, reply: Reply, buffer: &mut [u8]) -> Result<usize, Error<ModbusError>> {
        match response(reply)? {
            Response::ReadWriteMultipleRegisters(words) if words.len() == usize::from(self.read.count) => {
                Ok(self.read.decode(&words, buffer)?)
            }
            _ => Err(Error::UnexpectedReply),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::boxed::Box;

    use tokio_modbus::client::{sync, Context};
    use tokio_modbus::prelude::SlaveContext;
    use tokio_modbus::{ExceptionCode, Slave};

    use super::super::tests::{Device, Late};
    use super::super::ModbusClient;
    use super::*;
    use crate::modbus::{AsyncRegisterClient as _, RegisterClient as _, TableLimits};
    use crate::now::now;
    use crate::{Client as _, Flags, Item, OnModbus, Retrying, Rw};

    type RegisterItem<V> = Item<V, Rw, OnModbus>;
    const CONTROL: RegisterItem<u16> = RegisterItem::register(Register::holding(10), "Control", Flags::NONE);
    const TARGET: RegisterItem<u32> = RegisterItem::register(Register::high_first(11, 2), "Target", Flags::NONE);
    const STATUS: RegisterItem<u16> = RegisterItem::register(Register::holding(20), "Status", Flags::NONE);
    const ACTUAL: RegisterItem<u32> = RegisterItem::register(Register::low_first(21, 2), "Actual", Flags::NONE);
    const UPPER: RegisterItem<u8> = RegisterItem::register(Register::holding(13).part(8, 8), "Upper", Flags::NONE);
    const INPUT: RegisterItem<u16> =
        RegisterItem::register(Register::new(RegisterTable::Input, 4, 1), "Input", Flags::NONE);

    fn limits(functions: &'static [u8]) -> Limits {
        Limits { holding: TableLimits { functions, ..TableLimits::HOLDING }, ..Limits::STANDARD }
    }

    fn device(functions: &'static [u8]) -> ModbusClient<Device> {
        let mut device = ModbusClient::new(Device::default()).with_limits(limits(functions));
        device.context().holding.extend([(20, 7), (21, 2), (22, 1)]);
        device
    }

    #[test]
    fn one_request_writes_and_reads() {
        let mut device = device(&[3, 6, 16, 23]);
        let values = device.exchange((CONTROL, TARGET), (15, 0x1_0002), (ACTUAL, STATUS)).unwrap();
        assert_eq!(values, (0x1_0002, 7));
        assert_eq!(device.context().requests, ["ReadWriteMultipleRegisters(20, 3, 10, [15, 1, 2])"]);
        // The device writes before it reads.
        assert_eq!(device.exchange((TARGET,), (0x5_0006,), (TARGET,)).unwrap(), (0x5_0006,));
        let mut device =
            ModbusClient::new(Context::from(Box::new(device.into_context()) as Box<dyn tokio_modbus::client::Client>))
                .with_limits(limits(&[3, 6, 16, 23]));
        assert_eq!(now(device.exchange_async((CONTROL,), (1,), (CONTROL, TARGET))).unwrap(), (1, 0x5_0006));
        now(device.write_masked_async(CONTROL, 0x10, 0x11)).unwrap();
        now(device.write_block_async((CONTROL,), (2,))).unwrap();
    }

    #[test]
    fn two_requests_without_function_23() {
        let mut client = device(&[]);
        assert_eq!(client.exchange((TARGET, CONTROL), (0x1_0002, 15), (STATUS,)).unwrap(), (7,));
        let expected = ["WriteMultipleRegisters(10, [15, 1, 2])", "ReadHoldingRegisters(20, 1)"];
        assert_eq!(client.context().requests, expected);
        // Function 23 writes at most 121 registers.
        let mut client = device(&[3, 16, 23]);
        let long = Register::holding(50);
        let mut buffer = [0; 2];
        for (count, requests) in [(121, 1), (122, 3)] {
            let write = Register { count, ..long };
            client.write_and_read(write, &[1], STATUS.location().modbus, &mut buffer).unwrap();
            assert_eq!((client.context().requests.len(), buffer), (requests, [7, 0]));
        }
    }

    #[test]
    fn what_cannot_be_combined() {
        let mut device = device(&[3, 6, 16, 23]);
        assert_eq!(device.exchange((CONTROL, UPPER), (1, 2), (INPUT, STATUS)).unwrap(), (8, 7));
        let expected = [
            "WriteSingleRegister(10, 1)",
            "ReadHoldingRegisters(13, 1)",
            "WriteSingleRegister(13, 512)",
            "ReadInputRegisters(4, 1)",
            "ReadHoldingRegisters(20, 1)",
        ];
        assert_eq!(device.context().requests, expected);
    }

    #[test]
    fn masks() {
        for functions in [&[3, 6, 22][..], &[3, 6]] {
            let mut device = device(functions);
            device.context().holding.insert(10, 0x1234);
            device.write_masked(CONTROL, 0xFF07, 0x00FF).unwrap();
            assert_eq!(device.context().holding[&10], 0x1207);
            assert_eq!(device.context().requests.len(), if functions.contains(&22) { 1 } else { 2 });
            assert!(matches!(device.write_masked(TARGET, 1, 1).map_err(Error::from), Err(Error::Length(_))));
        }
    }

    #[test]
    fn a_late_reply_is_none_to_another_request() {
        let mut device = ModbusClient::new(Late::default()).with_limits(limits(&[3, 6, 16, 22, 23]));
        assert!(matches!(device.exchange((CONTROL,), (1,), (STATUS,)).map_err(Error::from), Err(Error::Timeout)));
        assert!(matches!(
            device.exchange((CONTROL,), (1,), (ACTUAL,)).map_err(Error::from),
            Err(Error::UnexpectedReply)
        ));
        assert!(matches!(device.write_masked(CONTROL, 1, 1).map_err(Error::from), Err(Error::UnexpectedReply)));
        assert!(matches!(device.write_masked(CONTROL, 2, 3).map_err(Error::from), Err(Error::UnexpectedReply)));
    }

    /// A device whose first requests fail with an error.
    struct Failing(fn() -> Reply, u8, Device);

    impl SlaveContext for Failing {
        fn set_slave(&mut self, _: Slave) {}
    }

    impl sync::Client for Failing {
        fn call(&mut self, request: Request<'_>) -> Reply {
            let left = self.1;
            self.1 = left.saturating_sub(1);
            if left > 0 {
                self.2.requests.push(std::format!("{request:?}"));
                return (self.0)();
            }
            sync::Client::call(&mut self.2, request)
        }
    }

    /// Returns the results of a read, a write, a mask write and an exchange whose first request fails, and the number of
    /// requests of each.
    fn attempts(error: fn() -> Reply, reads: u8, writes: u8) -> [(bool, usize); 4] {
        [0, 1, 2, 3].map(|access| {
            let client = ModbusClient::new(Failing(error, 1, Device::default())).with_limits(limits(&[3, 6, 22, 23]));
            let mut client = Retrying::reads(client, reads).and_writes(writes);
            let (register, mut buffer) = (Register::holding(10), [0; 2]);
            let result = match access {
                0 => client.read(register, &mut buffer).map(|_| ()),
                1 => client.write(register, &[1, 0]),
                2 => client.write_masked(CONTROL, 1, 1).map_err(Error::from),
                _ => client.exchange((CONTROL,), (1,), (STATUS,)).map(|_| ()).map_err(Error::from),
            };
            (result.is_ok(), client.client().context().2.requests.len())
        })
    }

    #[test]
    fn retries() {
        let silent: fn() -> Reply = || Err(tokio_modbus::Error::Transport(std::io::ErrorKind::TimedOut.into()));
        let broken: fn() -> Reply = || Err(tokio_modbus::Error::Transport(std::io::ErrorKind::InvalidData.into()));
        let busy: fn() -> Reply = || Ok(Err(ExceptionCode::ServerDeviceBusy));
        let (good, bad) = ((true, 2), (false, 1));
        for error in [silent, broken, busy] {
            assert_eq!(attempts(error, 0, 0), [bad; 4]);
            assert_eq!(attempts(error, 3, 0), [good, bad, bad, bad], "only reads");
            assert_eq!(attempts(error, 3, 1), [good; 4]);
        }
        let refused: fn() -> Reply = || Ok(Err(ExceptionCode::IllegalDataAddress));
        assert_eq!(attempts(refused, 3, 3), [bad; 4], "the device would refuse again");
    }
}

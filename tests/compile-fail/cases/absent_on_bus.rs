//! An item without a Modbus register cannot be read through a Modbus client.

use lexibus::{Client, Error, Flags, Initial, Item, Modbus, OnCanOpen, Range, Register, Ro};

const STATUSWORD: Item<u16, Ro, OnCanOpen> =
    Item::new(OnCanOpen::canopen(0x6041, 0), "Statusword", Range::Full, Initial::Unknown, "", Flags::TPDO);

struct Registers;

impl Client for Registers {
    type Bus = Modbus;
    type Error = ();

    fn read(&mut self, _: Register, _: &mut [u8]) -> Result<usize, Error<()>> {
        Err(Error::UnexpectedReply)
    }

    fn write(&mut self, _: Register, _: &[u8]) -> Result<(), Error<()>> {
        Err(Error::UnexpectedReply)
    }
}

fn main() {
    let _ = STATUSWORD.at(&mut Registers).read();
}

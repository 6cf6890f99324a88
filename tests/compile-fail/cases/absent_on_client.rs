//! A function for any Modbus client can read only the items of a device that have a Modbus register.

use lexibus::{Client, Flags, Item, Modbus, OnCanOpenAndCoE, OnCanOpenCoEAndModbus, Register, Ro};

type Everywhere = Item<i32, Ro, OnCanOpenCoEAndModbus>;
const POSITION: Everywhere = Everywhere::register(0x2008, 1, Register::low_first(8, 2), "Position", Flags::TPDO);
const DEVICE_TYPE: Item<u32, Ro, OnCanOpenAndCoE> = Item::shared_object(0x1000, 0, "Device type");

fn read<C: Client<Bus = Modbus>>(mut client: C) {
    let _ = POSITION.at(&mut client).read();
    let _ = DEVICE_TYPE.at(&mut client).read();
}

fn main() {}

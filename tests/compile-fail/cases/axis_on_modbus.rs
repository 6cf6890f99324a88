//! Items of an axis cannot be read on Modbus, because the rules for axes determine object addresses, but no register addresses.

use lexibus::{Axes, Axis, Client, Flags, Item, Modbus, OnCanOpenCoEAndModbus, Register, Ro};

static AXES: Axes = Axes { count: 2, ranges: &[], shared: &[] };

type Everywhere = Item<i32, Ro, OnCanOpenCoEAndModbus>;
const POSITION: Everywhere = Everywhere::register(0x2008, 1, Register::low_first(8, 2), "Position", Flags::TPDO);

fn read<C: Client<Bus = Modbus>>(client: C) {
    let _ = POSITION.at(&mut Axis::new(client, &AXES, 2)).read();
}

fn main() {}

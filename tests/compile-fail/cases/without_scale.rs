//! An item without a scale has no methods for physical values, and `write` takes only raw values.

use lexibus::{CanOpen, Client, Item, OnCanOpen, Rw, Scaled};

const COUNTER: Item<u16, Rw, OnCanOpen> = Item::object(0x2000, 0, "Counter");
const VELOCITY: Item<Scaled<i32, 1, 100>, Rw, OnCanOpen> = Item::object(0x6081, 0, "Profile velocity");

fn write<C: Client<Bus = CanOpen>>(mut client: C) {
    let _ = VELOCITY.at(&mut client).write_scaled(15.0);
    let _ = VELOCITY.at(&mut client).write(15.0);
    let _ = COUNTER.at(&mut client).write_scaled(15.0);
}

fn main() {}

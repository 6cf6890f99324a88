//! A read-only item cannot be written.

use lexibus::{CanOpen, Client, Flags, Initial, Item, OnCanOpen, Range, Ro};

const STATUSWORD: Item<u16, Ro, OnCanOpen> =
    Item::new(OnCanOpen::canopen(0x6041, 0), "Statusword", Range::Full, Initial::Unknown, "", Flags::TPDO);

fn write<C: Client<Bus = CanOpen>>(mut client: C) {
    let _ = STATUSWORD.at(&mut client).write(0);
}

fn main() {}

//! A write-only item cannot be read.

use lexibus::{CanOpen, Client, Flags, Initial, Item, OnCanOpen, Range, Wo};

const COMMAND: Item<u16, Wo, OnCanOpen> =
    Item::new(OnCanOpen::canopen(0x2000, 0), "Command", Range::Full, Initial::Unknown, "", Flags::NONE);

fn read<C: Client<Bus = CanOpen>>(mut client: C) {
    let _ = COMMAND.at(&mut client).read();
}

fn main() {}

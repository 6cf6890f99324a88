//! Items that cannot be part of a Modbus block: write-only items, and items on other buses.

use lexibus::modbus::RegisterClient;
use lexibus::{Flags, Item, OnCanOpen, OnModbus, Register, Ro, Wo};

type RegisterItem<V, A> = Item<V, A, OnModbus>;
const SPEED: RegisterItem<u16, Ro> = RegisterItem::register(Register::holding(1), "Speed", Flags::NONE);
const PASSWORD: RegisterItem<u16, Wo> = RegisterItem::register(Register::holding(2), "Password", Flags::NONE);
const ELSEWHERE: Item<u16, Ro, OnCanOpen> = Item::object(0x6041, 0, "Statusword");

fn read<C: RegisterClient>(mut client: C) {
    let _ = client.read_block((SPEED, PASSWORD));
    let _ = client.read_block([ELSEWHERE, ELSEWHERE]);
    let _ = client.read_block(SPEED);
}

fn main() {}

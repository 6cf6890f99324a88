//! Unsupported operations: reading an output-only field, writing an input-only field, and using a window on another bus
//! or in a block.

use lexibus::modbus::RegisterClient;
use lexibus::profinet::{Cyclic, ImageClient};
use lexibus::{
    CanOpen, Client, Closed, Flags, Handshake, ImageField, Initial, Item, Modbus, ProcessImage, Range, ReadWindow,
    Register, Rw, Split, Through,
};

lexibus::location! {
    struct OnlyOut {
        image: ProcessImage => Split<Closed, ImageField>,
    }
}

lexibus::location! {
    struct OnlyIn {
        image: ProcessImage => Split<ImageField, Closed>,
    }
}

lexibus::location! {
    struct Behind {
        modbus: Modbus => Through<ReadWindow<Register>>,
    }
}

const TARGET: Item<i32, Rw, OnlyOut> = Item::new(
    OnlyOut::new(Split::writing(ImageField::output(0, 32))),
    "Target",
    Range::Full,
    Initial::Unknown,
    "",
    Flags::NONE,
);

const ACTUAL: Item<i32, Rw, OnlyIn> = Item::new(
    OnlyIn::new(Split::reading(ImageField::input(0, 32))),
    "Actual",
    Range::Full,
    Initial::Unknown,
    "",
    Flags::NONE,
);

const WINDOW: ReadWindow<Register> = ReadWindow {
    number: Register::holding(1),
    number_bits: 16,
    value: Register::high_first(2, 2),
    value_bits: 32,
    handshake: Handshake::NONE,
};
const GAIN: Item<u32, Rw, Behind> = Item::new(
    Behind::new(Through::unsigned(0x8033, &WINDOW)),
    "Gain",
    Range::Full,
    Initial::Unknown,
    "",
    Flags::NONE,
);

fn image<I: ImageClient>(mut client: Cyclic<I, [u8; 5], [u8; 5]>) {
    let _ = TARGET.at(&mut client).write(1);
    let _ = TARGET.at(&mut client).read();
    let _ = ACTUAL.at(&mut client).read();
    let _ = ACTUAL.at(&mut client).write(1);
}

fn registers<C: RegisterClient>(mut client: C) {
    let _ = GAIN.at(&mut client).read();
    let _ = client.read_block((GAIN,));
}

fn objects<C: Client<Bus = CanOpen>>(mut client: C) {
    let _ = GAIN.at(&mut client).read();
}

fn main() {}

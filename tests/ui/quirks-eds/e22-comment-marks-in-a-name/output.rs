    /// a;b ; c: 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`a_b_c`](super::Pump::a_b_c).
    pub const A_B_C: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "a;b ; c");
    /// Input \#1 \# x: 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`input_1_x`](super::Pump::input_1_x).
    pub const INPUT_1_X: ReadWrite<u8> = ReadWriteU8::object(
        0x2001,
        0x00,
        "Input #1 # x",
    );

    /// Speed: Modbus 40101 (holding; wire address 100; FC 3/16), UNSIGNED16, read-write.
    /// Accessor: [`speed`](super::Press::speed).
    ///
    /// Chapter: Holding.
    pub const SPEED: ReadWrite<u16> = ReadWriteU16::register(
        rt::Register::holding(100),
        "Speed",
        rt::Flags::NONE,
    );
    /// Speed.
    ///
    /// Modbus 40101 (holding; wire address 100; FC 3/16), UNSIGNED16, read-write.
    /// Constant: [`objects::SPEED`].
    #[doc(alias("40101"))]
    pub fn speed(&mut self) -> objects::ReadWriteAccess<'_, C, u16> {
        objects::SPEED.at(&mut self.client)
    }
    /// Position: Modbus 40102–40103 (holding; wire address 101–102; FC 3/16; low word first), INTEGER32, read-write.
    /// Accessor: [`position`](super::Press::position).
    ///
    /// Chapter: Holding.
    pub const POSITION: ReadWrite<i32> = ReadWriteI32::register(
        rt::Register::low_first(101, 2),
        "Position",
        rt::Flags::NONE,
    );
    /// Input: Modbus 30005–30006 (input; wire address 4–5; FC 4; high word first; bytes swapped), UNSIGNED32, read-only.
    /// Accessor: [`input`](super::Press::input).
    ///
    /// Chapter: Others.
    pub const INPUT: ReadOnly<u32> = ReadOnlyU32::register(
        rt::Register::new(rt::RegisterTable::Input, 4, 2).swapped(),
        "Input",
        rt::Flags::NONE,
    );
    /// Lamp: Modbus 7 (coil; wire address 6; FC 1/5/15), BOOLEAN, read-write.
    /// Accessor: [`lamp`](super::Press::lamp).
    ///
    /// Chapter: Coils.
    pub const LAMP: ReadWrite<bool> = ReadWriteBool::register(
        rt::Register::new(rt::RegisterTable::Coil, 6, 1),
        "Lamp",
        rt::Flags::NONE,
    );
    /// Flags: Modbus 40104 (holding; wire address 103; FC 3; from bit 3), BOOLEAN, read-only.
    /// Accessor: [`flags`](super::Press::flags).
    ///
    /// Chapter: Holding.
    pub const FLAGS: ReadOnly<bool> = ReadOnlyBool::register(
        rt::Register::holding(103).part(3, 1),
        "Flags",
        rt::Flags::NONE,
    );

    /// Speed: Modbus R01 (holding; wire address 0x8001; FC 3/6/16; 32 bits per address; high word first), INTEGER32, read-write.
    /// Accessor: [`speed`](super::Press::speed).
    ///
    /// Speed of the slide: −10 … 10, ×2, the drive’s.
    ///
    /// Chapter: Registers.
    pub const SPEED: ReadWrite<i32> = ReadWriteI32::register(
        rt::Register::high_first(32769, 2).words_per_address(2),
        "Speed",
        rt::Flags::NONE,
    );
    /// Speed of the slide: −10 … 10, ×2, the drive’s.
    ///
    /// Speed: Modbus R01 (holding; wire address 0x8001; FC 3/6/16; 32 bits per address; high word first), INTEGER32, read-write.
    /// Constant: [`objects::SPEED`].
    #[doc(alias("R01"))]
    pub fn speed(&mut self) -> objects::ReadWriteAccess<'_, C, i32> {
        objects::SPEED.at(&mut self.client)
    }
    /// Gain: Modbus 1 (holding; wire address 1; FC 3/6/16), UNSIGNED16, read-write.
    /// Accessor: [`gain`](super::Press::gain).
    ///
    /// Chapter: Parameters.
    pub const GAIN: ReadWrite<u16> = ReadWriteU16::register(
        rt::Register::holding(1),
        "Gain",
        rt::Flags::NONE,
    );
    /// Time: Modbus 2–3 (holding; wire address 2–3; FC 3/16; low word first (assumed)), UNSIGNED32, read-write.
    /// Accessor: [`time`](super::Press::time).
    ///
    /// Chapter: Parameters.
    pub const TIME: ReadWrite<u32> = ReadWriteU32::register(
        rt::Register::low_first(2, 2),
        "Time",
        rt::Flags::NONE,
    );

    /// COB-ID: Default \`\$MY\_NODE\_ID+0x200\`, 0x2000:00, UNSIGNED32, read-write.
    /// Accessor: [`cob_id`](super::Pump::cob_id).
    pub const COB_ID: ReadWrite<u32> = ReadWriteU32::object(0x2000, 0x00, "COB-ID");

    /// Torque actual value: 0x6077:00, INTEGER16, read-only.
    /// Accessor: [`torque_actual_value`](super::Axis::torque_actual_value).
    ///
    /// Actual torque, relative to the rated torque.
    ///
    /// Description from CiA 402, 17.3.7. Manual, page 7.
    pub const TORQUE_ACTUAL_VALUE: ReadOnly<i16> = ReadOnlyI16::object(
        0x6077,
        0x00,
        "Torque actual value",
    );
    /// Digital inputs: 0x60FD:00, UNSIGNED32, read-only.
    /// Accessor: [`digital_inputs`](super::Axis::digital_inputs).
    ///
    /// Digital inputs: limit switches, home switch and manufacturer-specific inputs.
    ///
    /// Description from CiA 402, 9.3.15. Manual, page 8.
    pub const DIGITAL_INPUTS: ReadOnly<u32> = ReadOnlyU32::object(
        0x60FD,
        0x00,
        "Digital inputs",
    );

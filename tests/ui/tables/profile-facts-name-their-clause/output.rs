    /// Torque actual value: 1 LSB = 0.1 %, 0x6077:00, INTEGER16, read-only.
    /// Accessor: [`torque_actual_value`](super::Axis::torque_actual_value).
    ///
    /// Actual torque, relative to the rated torque.
    ///
    /// Unit from CiA 402, 17.3.7.
    ///
    /// Description from CiA 402, 17.3.7. Manual, page 7.
    pub const TORQUE_ACTUAL_VALUE: ReadOnly<rt::Scaled<i16, 1, 10>> = ReadOnlyI16Times1Per10::new(
        rt::OnCanOpen::canopen(0x6077, 0x00),
        "Torque actual value",
        rt::Range::Full,
        rt::Initial::Unknown,
        "%",
        rt::Flags::NONE,
    );
    /// Digital inputs: 0x60FD:00, UNSIGNED32, read-only.
    /// Accessor: [`digital_inputs`](super::Axis::digital_inputs). Value type: [`DigitalInputs`](super::types::DigitalInputs).
    ///
    /// Digital inputs: limit switches, home switch and manufacturer-specific inputs.
    ///
    /// Bits from CiA 402, 9.3.15.
    ///
    /// Description from CiA 402, 9.3.15. Manual, page 8.
    pub const DIGITAL_INPUTS: ReadOnly<super::types::DigitalInputs> = ReadOnlyNamedDigitalInputs::object(
        0x60FD,
        0x00,
        "Digital inputs",
    );
    /// Value type of [`DIGITAL_INPUTS`](super::objects::DIGITAL_INPUTS).
    ///
    #[doc(inline)]
    pub use ::lexibus::profiles::types::DigitalInputs;

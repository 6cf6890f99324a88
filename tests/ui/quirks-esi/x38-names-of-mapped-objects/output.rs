    /// RxPDO 0x1600: Outputs.
    ///
    /// Mapping object 0x1600, 56 bits.
    ///
    /// | Bytes | Field | Object | Type |
    /// |---|---|---|---|
    /// | 0–1 | [`controlword`](Self::controlword) | [0x6040:00](super::objects::CONTROLWORD) | [`Controlword`](super::types::Controlword) |
    /// | 2–3 | [`speed_2002`](Self::speed_2002) | [0x2002:00](super::objects::SPEED_2002) | `i16` |
    /// | 4–5 | [`a_limit_of_the_torque_in_operation_with_reduced`](Self::a_limit_of_the_torque_in_operation_with_reduced) | [0x2003:00](super::objects::A_LIMIT_OF_THE_TORQUE_IN_OPERATION_WITH_REDUCED) | `i16` |
    /// | 6 | [`lamp`](Self::lamp) | [0x5000:01](super::objects::object_5000::LAMP) | `u8` |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Outputs {
        /// Control Word: [0x6040:00](super::objects::CONTROLWORD), 16 bits at bit offset 0.
        pub controlword: super::types::Controlword,
        /// Set speed: [0x2002:00](super::objects::SPEED_2002), 16 bits at bit offset 16.
        pub speed_2002: i16,
        /// Torque: [0x2003:00](super::objects::A_LIMIT_OF_THE_TORQUE_IN_OPERATION_WITH_REDUCED), 16 bits at bit offset 32.
        pub a_limit_of_the_torque_in_operation_with_reduced: i16,
        /// Lamp: [0x5000:01](super::objects::object_5000::LAMP), 8 bits at bit offset 48.
        pub lamp: u8,
    }
    /// RxPDO 0x1600: Outputs.
    ///
    /// The view has the fields of [`pdo::Outputs`](super::pdo::Outputs).
    pub struct Outputs<B> {
        pub(super) data: B,
        pub(super) bit: usize,
    }
    /// Outputs: data of sync manager 2 with the default PDO assignment.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Outputs {
        /// RxPDO 0x1600: Outputs.
        pub outputs: super::pdo::Outputs,
    }
    /// TxPDO 0x1A00: Inputs.
    ///
    /// Mapping object 0x1A00, 32 bits.
    ///
    /// | Bytes | Field | Object | Type |
    /// |---|---|---|---|
    /// | 0.0 | [`digital_inputs_limit_switch`](Self::digital_inputs_limit_switch) | [0x2000:01](super::objects::digital_inputs::LIMIT_SWITCH) | `bool` |
    /// | 0.1 | [`digital_inputs_2`](Self::digital_inputs_2) | [0x2000:02](super::objects::digital_inputs::DIGITAL_INPUTS_2) | `bool` |
    /// | 0.2 | [`safe_inputs_limit_switch`](Self::safe_inputs_limit_switch) | [0x2010:01](super::objects::safe_inputs::LIMIT_SWITCH) | `bool` |
    /// | 0.3–1.7 | padding |  |  |
    /// | 2–3 | [`speed_2001`](Self::speed_2001) | [0x2001:00](super::objects::SPEED_2001) | `i16` |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Inputs {
        /// Inputs1\_B01: [0x2000:01](super::objects::digital_inputs::LIMIT_SWITCH), 1 bit at bit offset 0.
        pub digital_inputs_limit_switch: bool,
        /// Inputs1\_B02: [0x2000:02](super::objects::digital_inputs::DIGITAL_INPUTS_2), 1 bit at bit offset 1.
        pub digital_inputs_2: bool,
        /// Inputs2\_B01: [0x2010:01](super::objects::safe_inputs::LIMIT_SWITCH), 1 bit at bit offset 2.
        pub safe_inputs_limit_switch: bool,
        /// Actual speed: [0x2001:00](super::objects::SPEED_2001), 16 bits at bit offset 16.
        pub speed_2001: i16,
    }
    /// TxPDO 0x1A00: Inputs.
    ///
    /// The view has the fields of [`pdo::Inputs`](super::pdo::Inputs).
    pub struct Inputs<B> {
        pub(super) data: B,
        pub(super) bit: usize,
    }
    /// Inputs: data of sync manager 3 with the default PDO assignment.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Inputs {
        /// TxPDO 0x1A00: Inputs.
        pub inputs: super::pdo::Inputs,
    }
/// Items for use by the macro `lexibus::pdo!`, and whether they can be mapped. Their names are those of the accessors.
#[allow(missing_docs, non_camel_case_types)]
pub mod mappable {
    use ::lexibus as rt;
    pub mod digital_inputs {
        use super::rt;
        pub type number_of_entries = rt::pdo::NotMappable;
        pub type limit_switch = rt::Mappable<bool, rt::Tpdo, 0x2000_0101>;
        pub type digital_inputs_2 = rt::Mappable<bool, rt::Tpdo, 0x2000_0201>;
    }
    pub type speed_2001 = rt::Mappable<i16, rt::Tpdo, 0x2001_0010>;
    pub type speed_2002 = rt::Mappable<i16, rt::Rpdo, 0x2002_0010>;
    pub type a_limit_of_the_torque_in_operation_with_reduced = rt::Mappable<
        i16,
        rt::Rpdo,
        0x2003_0010,
    >;
    pub mod safe_inputs {
        use super::rt;
        pub type number_of_entries = rt::pdo::NotMappable;
        pub type limit_switch = rt::Mappable<bool, rt::Tpdo, 0x2010_0101>;
        pub type digital_inputs_2 = rt::Mappable<bool, rt::Tpdo, 0x2010_0201>;
    }
    pub mod object_5000 {
        use super::rt;
        pub type lamp = rt::Mappable<u8, rt::Rpdo, 0x5000_0108>;
    }
    pub type controlword = rt::Mappable<
        super::types::Controlword,
        rt::Rpdo,
        0x6040_0010,
    >;
}

//! Tests custom mappings: packing, unpacking and configuring `lexibus::pdo!` structs.

use lexibus::{CobId, Int, LengthError, MappedEntry, NodeId, Pdo, SdoWrite, Uint};
use lexibus_drives::{demo_drive, vector_step};
use proptest::prelude::*;

/// Generated code for a device whose objects have unusual lengths. The mapping granularity of the device is one bit.
#[allow(missing_docs)]
pub mod odd {
    pub mod types {
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Mode {
            Off,
            On,
            Unknown(u8),
        }

        impl lexibus::Enumeration for Mode {
            type Base = lexibus::Uint<3>;

            fn from_native(native: u8) -> Self {
                match native {
                    0 => Mode::Off,
                    1 => Mode::On,
                    other => Mode::Unknown(other),
                }
            }

            fn native(self) -> u8 {
                match self {
                    Mode::Off => 0,
                    Mode::On => 1,
                    Mode::Unknown(other) => other,
                }
            }
        }
    }

    #[allow(non_camel_case_types)]
    pub mod mappable {
        use lexibus as rt;

        pub type mode = rt::Mappable<super::types::Mode, rt::AnyPdo, 0x2000_0003>;
        pub type enable = rt::Mappable<bool, rt::Rpdo, 0x2001_0001>;
        pub type position = rt::Mappable<rt::Int<24>, rt::AnyPdo, 0x2002_0018>;
        pub mod inputs {
            use lexibus as rt;

            pub type input_1 = rt::Mappable<rt::Uint<12>, rt::AnyPdo, 0x2010_010C>;
            pub type input_2 = rt::Mappable<rt::Uint<12>, rt::AnyPdo, 0x2010_020C>;
            pub type real = rt::Mappable<f32, rt::AnyPdo, 0x2010_0320>;
            pub type text = rt::Mappable<[u8; 5], rt::AnyPdo, 0x2010_0428>;
        }
    }

    pub mod remappable {
        use lexibus as rt;

        pub enum RxPdo1 {}

        impl rt::Remappable for RxPdo1 {
            type Direction = rt::Rpdo;
            type CobId = rt::CobId;
            const COB_ID: rt::CobId = rt::CobId::from_node(0x200);
            const INDEX: u16 = 0x1600;
            const ENTRIES: usize = 8;
            const DUMMIES: u32 = 1 << 1 | 1 << 5;
            const COMMUNICATION: Option<u16> = Some(0x1400);
            const TIMING: &'static [rt::SdoWrite] = &[rt::SdoWrite::new_u8(0x1400, 2, 255)];
        }

        /// A PDO on EtherCAT that has a fixed entry.
        pub enum Inputs {}

        impl rt::Remappable for Inputs {
            type Direction = rt::Tpdo;
            type CobId = rt::pdo::OnEtherCat;
            const INDEX: u16 = 0x1A00;
            const ENTRIES: usize = 254;
            const MAX_BITS: u32 = 800;
            const KEPT: &'static [rt::MappedEntry] = &[rt::MappedEntry::new(0x2000, 0, 3)];
        }

        /// A PDO without a default COB-ID, whose COB-ID is read-only.
        pub enum TxPdo2 {}

        impl rt::Remappable for TxPdo2 {
            type Direction = rt::Tpdo;
            type CobId = rt::pdo::NoCobId;
            const INDEX: u16 = 0x1A01;
            const ENTRIES: usize = 1;
        }
    }
}

use odd::types::Mode;

lexibus::pdo! {
    /// Setpoints with unusual lengths.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct SetPoints: odd::pdo::RxPdo1 {
        mode,
        enable,
        _: 8,
        /// Target position.
        position,
        left: inputs::input_1,
        _: 1,
    }
}

lexibus::pdo! {
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Long: self::odd::pdo::Inputs {
        left: inputs::input_1,
        real: inputs::real,
        mode,
        _: 10,
        text: inputs::text,
    }
}

lexibus::pdo! {
    struct Lone: crate::odd::pdo::TxPdo2 { position }
}

fn node(number: u8) -> NodeId {
    NodeId::new(number).unwrap()
}

#[test]
fn fields_stand_bit_by_bit() {
    let points = SetPoints {
        mode: Mode::Unknown(6),
        enable: true,
        position: Int::new(-2).unwrap(),
        left: Uint::from_raw(0xABC),
    };
    assert_eq!((SetPoints::BITS, SetPoints::LEN), (49, 7));
    // The PDO contains 3 bits, 1 bit, a gap of 8 bits, 24 bits, 12 bits, and a gap of 1 bit: 0xABC_FFFFFE_00_E.
    assert_eq!(points.pack(), [0x0E, 0xE0, 0xFF, 0xFF, 0xCF, 0xAB, 0x00]);
    assert_eq!(SetPoints::unpack(&points.pack()), Ok(points));
    // Bits in gaps and after the mapped entries must be ignored.
    assert_eq!(SetPoints::unpack(&[0xFE, 0xEF, 0xFF, 0xFF, 0xCF, 0xAB, 0xFF, 0xFF]), Ok(points));
    assert_eq!(SetPoints::unpack(&[0; 6]), Err(LengthError { expected: 7, actual: 6 }));
}

#[test]
fn values_are_cut_to_their_bits() {
    let points = SetPoints { mode: Mode::Unknown(0xFF), enable: false, position: Int::MIN, left: Uint::MIN };
    assert_eq!(points.pack(), [0x07, 0, 0, 0, 0x08, 0, 0]);
    assert_eq!(SetPoints::unpack(&points.pack()).map(|points| points.mode), Ok(Mode::Unknown(7)));
}

#[test]
fn a_pdo_may_be_longer_than_a_word() {
    let long = Long { left: Uint::from_raw(0x123), real: 1.0, mode: Mode::On, text: *b"Hello" };
    assert_eq!((Long::BITS, Long::LEN), (97, 13));
    // The PDO contains 12 bits, 32 bits with the value 0x3F800000, 3 bits from bit 44, a gap of 10 bits, and 40 bits
    // from bit 57.
    assert_eq!(long.pack(), [0x23, 0x01, 0x00, 0x00, 0xF8, 0x13, 0x00, 0x90, 0xCA, 0xD8, 0xD8, 0xDE, 0x00]);
    assert_eq!(Long::unpack(&long.pack()), Ok(long));
    assert_eq!(Long::unpack(&[0; 12]), Err(LengthError { expected: 13, actual: 12 }));
}

#[test]
fn configuration_is_disable_clear_map_count_timing_enable() {
    let writes = [
        SdoWrite::new_u32(0x1400, 1, 0x8000_0205),
        SdoWrite::new_u8(0x1600, 0, 0),
        SdoWrite::new_u32(0x1600, 1, 0x2000_0003),
        SdoWrite::new_u32(0x1600, 2, 0x2001_0001),
        // The mapping contains dummy entries of 8 bits and 1 bit.
        SdoWrite::new_u32(0x1600, 3, 0x0005_0008),
        SdoWrite::new_u32(0x1600, 4, 0x2002_0018),
        SdoWrite::new_u32(0x1600, 5, 0x2010_010C),
        SdoWrite::new_u32(0x1600, 6, 0x0001_0001),
        SdoWrite::new_u8(0x1600, 0, 6),
        SdoWrite::new_u8(0x1400, 2, 255),
        SdoWrite::new_u32(0x1400, 1, 0x205),
    ];
    assert_eq!(SetPoints::COB_ID, CobId::from_node(0x200));
    assert_eq!(SetPoints::configuration(node(5)), writes);
    assert_eq!(SetPoints::configuration_as(0x8000_0205), writes);
    assert_eq!(SetPoints::mapping_writes(), writes[1..9]);
}

#[test]
fn what_nobody_may_write_is_left_out() {
    let writes =
        [SdoWrite::new_u8(0x1A01, 0, 0), SdoWrite::new_u32(0x1A01, 1, 0x2002_0018), SdoWrite::new_u8(0x1A01, 0, 1)];
    assert_eq!(Lone::configuration_as(0x285), writes);
    assert!(!Lone::COB_ID.is_valid());
    assert_eq!(Lone { position: Int::new(1).unwrap() }.pack(), [1, 0, 0]);
    assert!(Lone::unpack(&[0; 2]).is_err());
}

#[test]
fn a_gap_on_ethercat_needs_no_object() {
    let words: Vec<u32> = Long::MAPPING.iter().map(|entry| entry.word()).collect();
    assert_eq!(words, [0x2010_010C, 0x2010_0320, 0x2000_0003, 10, 0x2010_0428]);
    assert_eq!((<Long as Pdo>::INDEX, <Long as Pdo>::LEN), (0x1A00, 13));
}

lexibus::pdo! {
    /// A PDO with the default mapping.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct SameAsDefault: demo_drive::pdo::RxPdo2 { controlword, target_position }
}

lexibus::pdo! {
    /// A PDO with an array entry. The field has a custom name.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Feedback: ::lexibus_drives::demo_drive::pdo::TxPdo2 {
        mode: modes_of_operation_display,
        pressure: analog_inputs::input_2,
    }
}

#[test]
fn it_is_what_the_compiler_emits_for_the_default() {
    use demo_drive::{pdo::RxPdo2, types::Controlword};

    let controlword = Controlword::from_raw(0x000F);
    let image = SameAsDefault { controlword, target_position: -2 };
    assert_eq!(image.pack(), RxPdo2 { controlword, target_position: -2 }.pack());
    assert_eq!(SameAsDefault::configuration(node(9)), RxPdo2::configuration(node(9)));
    assert_eq!((SameAsDefault::BITS, SameAsDefault::LEN), (RxPdo2::BITS, RxPdo2::LEN));
    assert_eq!((SameAsDefault::COB_ID, SameAsDefault::MAPPING), (RxPdo2::COB_ID, RxPdo2::MAPPING));
}

#[test]
fn enumerations_and_entries_of_arrays() {
    use demo_drive::types::ModesOfOperation;

    let feedback = Feedback { mode: ModesOfOperation::Unknown(-1), pressure: 0x1234 };
    assert_eq!(feedback.pack(), [0xFF, 0x34, 0x12]);
    assert_eq!(
        Feedback::unpack(&[1, 0xFE, 0xFF]).unwrap(),
        Feedback { mode: ModesOfOperation::ProfilePosition, pressure: -2 }
    );
    assert_eq!(Feedback::MAPPING, [MappedEntry::new(0x6061, 0, 8), MappedEntry::new(0x2010, 2, 16)]);
}

lexibus::pdo! {
    /// A mapping for a PDO that has no default mapping.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Fast: vector_step::pdo::RxPdo3 { controlword, profile_velocity }
}

#[test]
fn an_empty_pdo_of_a_real_drive() {
    use vector_step::types::Controlword;

    assert_eq!(
        Fast::configuration(node(3)),
        [
            SdoWrite::new_u32(0x1402, 1, 0x8000_0403),
            SdoWrite::new_u8(0x1602, 0, 0),
            SdoWrite::new_u32(0x1602, 1, 0x6040_0010),
            SdoWrite::new_u32(0x1602, 2, 0x6081_0020),
            SdoWrite::new_u8(0x1602, 0, 2),
            SdoWrite::new_u8(0x1402, 2, 254),
            SdoWrite::new_u32(0x1402, 1, 0x403),
        ]
    );
    let fast = Fast { controlword: Controlword::from_raw(0x1F), profile_velocity: 0x0102_0304 };
    assert_eq!(fast.pack(), [0x1F, 0x00, 0x04, 0x03, 0x02, 0x01]);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn short_frames_come_back(frame: [u8; 7]) {
        let mut expected = frame;
        // The gaps are bits 4 to 11, and all bits from bit 48.
        (expected[0], expected[1], expected[6]) = (frame[0] & 0x0F, frame[1] & 0xF0, 0);
        prop_assert_eq!(SetPoints::unpack(&frame).unwrap().pack(), expected);
    }

    #[test]
    fn long_frames_come_back(frame: [u8; 13]) {
        let mut expected = frame;
        // The gaps are bits 47 to 56, and all bits from bit 97.
        (expected[5], expected[6], expected[7], expected[12]) = (frame[5] & 0x7F, 0, frame[7] & 0xFE, frame[12] & 1);
        prop_assert_eq!(Long::unpack(&frame).unwrap().pack(), expected);
    }

    #[test]
    fn frames_of_a_drive_are_read_alike(frame: [u8; 8]) {
        let (image, default) = (SameAsDefault::unpack(&frame).unwrap(), demo_drive::pdo::RxPdo2::unpack(&frame).unwrap());
        prop_assert_eq!((image.controlword, image.target_position), (default.controlword, default.target_position));
        // Packing must give the same reserved bits with both structs.
        prop_assert_eq!(image.pack(), default.pack());
    }
}

/// PDOs from an EtherCAT device description.
#[cfg(feature = "macros")]
mod ethercat {
    use super::*;
    use lexibus::ethercat::{Assignment, AssignmentError};
    use lexibus::pdo::OnEtherCat;
    use lexibus::Remappable;

    lexibus::dictionary! {
        /// A servo drive.
        #[allow(deprecated)]
        pub mod drive = "tests/data/coupler.esi.xml" { device: "SV-*@latest" }
    }

    lexibus::pdo! {
        /// A PDO with the controlword, a gap and the target position.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Position: drive::pdo::PositionMode { controlword, _: 3, target_position }
    }

    #[test]
    fn a_slave_is_mapped_in_pre_operational() {
        let _: Option<OnEtherCat> = None::<<drive::remappable::PositionMode as Remappable>::CobId>;
        assert_eq!(Position::BITS, 51);
        let assignment = Assignment::<8>::new(&drive::DEVICE, &[0x1600, 0x1A01]).unwrap();
        let assignment = assignment.with_mapping::<Position>().unwrap();
        assert_eq!((assignment.bits(2), assignment.bytes(2)), (51, 7));
        let commands: Vec<SdoWrite> = assignment.commands().collect();
        let at = commands.iter().position(|write| write.object().index == 0x1600).unwrap();
        assert_eq!(commands[at..at + 5], Position::mapping_writes());
        // The commands first clear the PDO assignment, then write the mapping, and then write the assignment.
        assert_eq!(commands[0], SdoWrite::new_u8(0x1C12, 0, 0));
        assert!(commands[at + 5..].contains(&SdoWrite::new_u16(0x1C12, 1, 0x1600)));
        let other = Assignment::<8>::new(&drive::DEVICE, &[0x1601, 0x1A01]).unwrap();
        assert_eq!(other.with_mapping::<Position>().map(|_| ()), Err(AssignmentError::Unknown(0x1600)));
    }

    lexibus::dictionary! {
        /// A sensor.
        #[allow(deprecated)]
        pub mod sensor = "tests/data/sensor.esi.xml";
    }

    lexibus::pdo! {
        /// A PDO with the fixed entry for the state and all other entries.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Everything: sensor::pdo::Measurement { _: 5, label, state, trend, alarm }
    }

    #[test]
    fn an_enumeration_has_no_more_bits_than_its_entry() {
        use sensor::pdo::Measurement;
        use sensor::types::{State, Trend};

        // The state is 1, the alarm is set, and the trend is -1. The bits above the state belong to other fields.
        let measurement = Measurement { state: State::Measuring, alarm: true, trend: Trend::Falling };
        assert_eq!(measurement.pack(), [0xFD, 0x07]);
        assert_eq!(Measurement::unpack(&[0xFD, 0xFF]), Ok(measurement));
        let unknown = Measurement { state: State::Unknown(0xFF), alarm: false, trend: Trend::Unknown(0) };
        assert_eq!(unknown.pack(), [0x03, 0x00]);
    }

    #[test]
    fn the_limits_are_those_of_the_description() {
        use sensor::remappable::Measurement;

        // The PDO has at most 14 bytes and a fixed entry for the state. Objects of the default mapping can also be part
        // of a custom mapping.
        assert_eq!(
            (Measurement::MAX_BITS, Measurement::KEPT, Measurement::ENTRIES),
            (112, &[MappedEntry::new(0x6000, 0, 2)][..], 254)
        );
        let everything = Everything {
            label: *b"0123456789",
            state: sensor::types::State::Measuring,
            trend: sensor::types::Trend::Rising,
            alarm: true,
        };
        assert_eq!((Everything::BITS, Everything::LEN), (96, 12));
        // From bit 80, the PDO contains five bits of the text, two bits of the state, eight bits of the trend, and the
        // alarm.
        assert_eq!(everything.pack()[10..], [0x80 | 0x20 | 0x07, 0x80]);
        assert_eq!(Everything::unpack(&everything.pack()), Ok(everything));
    }

    #[test]
    fn pdos_behind_one_of_ones_own_move() {
        let assignment = Assignment::<8>::by_default(&sensor::DEVICE).unwrap();
        assert_eq!((assignment.find(0x1A01).unwrap().bit, assignment.bits(3)), (11, 19));
        let assignment = assignment.with_mapping::<Everything>().unwrap();
        assert_eq!((assignment.find(0x1A01).unwrap().bit, assignment.bits(3)), (96, 104));
    }
}

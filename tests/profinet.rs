//! Tests the code that is generated for PROFINET from the files in `data`: process images, records, start-up plans and
//! diagnosis. The expected process images and records were calculated by hand.
#![cfg(feature = "macros")]

lexibus::dictionary! {
    /// A station with a PROFIsafe module.
    pub mod safe = "tests/data/safe.gsdml.xml";
}

lexibus::dictionary! {
    /// A servo drive with the PROFIdrive profile.
    pub mod drive = "tests/data/drive.gsdml.xml";
}

lexibus::dictionary! {
    /// A station with two device access points.
    pub mod heads = "tests/data/heads.gsdml.xml";
}

mod profisafe {
    use super::safe::submodules::safe_inputs::{
        self, InputFilterRecord, Inputs, InputsView, Outputs, OutputsMut, F_PARAMETERS,
    };
    use super::safe::values::VMode;
    use super::safe::{diagnosis, modules, DAP};
    use lexibus::profinet::{
        ChannelDiagnosis, FTrailer, IoData, IoObject, IoObjectMut, IoStatus, NotAllowed, Plan, RecordData, Replacement,
        UserStructure, WithStatus,
    };

    /// Emergency stops A (bit 0) and B (bit 3) in byte 0, speed −2, status byte 0x20, CRC 0xA1B2C3, and provider
    /// status.
    const OBJECT: [u8; 8] = [0x09, 0xFF, 0xFE, 0x20, 0xA1, 0xB2, 0xC3, 0x80];

    #[test]
    fn inputs_with_trailer_and_status() {
        let read = WithStatus::<Inputs>::read(&OBJECT).unwrap();
        let inputs = Inputs { emergency_stop_a: true, emergency_stop_b: true, speed: -2 };
        assert_eq!(read, WithStatus { data: inputs, provider: IoStatus::GOOD });
        assert_eq!(inputs.pack(), OBJECT[..3]);
        assert_eq!((Inputs::LEN, Inputs::TRAILER_LEN, WithStatus::<Inputs>::LEN), (3, 4, 8));
        let parts = IoObject::of::<Inputs>(&OBJECT).unwrap();
        assert_eq!(FTrailer::from_bytes(parts.trailer), Ok(FTrailer { status: 0x20, crc: 0xA1_B2C3 }));
        let view = InputsView::new(parts.data).unwrap();
        assert!(view.emergency_stop_a() && view.emergency_stop_b() && view.speed() == -2);
        assert!(InputsView::new(&OBJECT[..2]).is_err() && WithStatus::<Inputs>::read(&OBJECT[..7]).is_err());
    }

    #[test]
    fn outputs_leave_the_trailer_to_the_safety_layer() {
        let mut object = [0x00, 0x11, 0x22, 0x33, 0x44, 0x00];
        WithStatus { data: Outputs { command: 0x5A }, provider: IoStatus::GOOD }.write(&mut object).unwrap();
        assert_eq!(object, [0x5A, 0x11, 0x22, 0x33, 0x44, 0x80]);
        let parts = IoObjectMut::of::<Outputs>(&mut object).unwrap();
        let mut view = OutputsMut::new(parts.data).unwrap();
        view.set_command(7);
        assert_eq!(view.view().command(), 7);
        FTrailer { status: 0x21, crc: 0x01_0203 }.write(parts.trailer).unwrap();
        assert_eq!(object, [0x07, 0x21, 0x01, 0x02, 0x03, 0x80]);
    }

    #[test]
    fn parameters_start_from_their_defaults() {
        // The constants are 5A 01 and EE. Mode 2 in bits 1 to 3 is 0x04, and inversion in bit 7 is 0x80. The gain 1.5
        // is 3F C0 00 00. The last byte contains the layout number 7.
        let default = [0x5A, 0x01, 0x84, 0x3F, 0xC0, 0x00, 0x00, 0xEE, 0x07];
        assert_eq!(InputFilterRecord::DEFAULT_BYTES, default);
        assert_eq!(InputFilterRecord::default().encode(), Ok(default));
        assert_eq!(InputFilterRecord::LAYOUT, 7);
        // Mode 3 in bits 1 to 3 is 0x06, and the gain 10.0 is 41 20 00 00.
        let changed = InputFilterRecord { mode: VMode::Long, invert: false, gain: 10.0 };
        let bytes = [0x5A, 0x01, 0x06, 0x41, 0x20, 0x00, 0x00, 0xEE, 0x07];
        assert_eq!(changed.encode(), Ok(bytes));
        assert_eq!(InputFilterRecord::decode(&bytes), Ok(changed));
        assert_eq!((InputFilterRecord::INDEX, InputFilterRecord::TRANSFER_SEQUENCE), (2, 1));
        let mut buffer = [0; 10];
        assert_eq!(changed.encode_into(&mut buffer).map(<[u8]>::len), Ok(9));
    }

    #[test]
    fn values_outside_of_the_allowed_ones_are_refused() {
        let refused = |field| Err(NotAllowed { field });
        let record = InputFilterRecord::DEFAULT;
        assert_eq!(InputFilterRecord { gain: 0.25, ..record }.encode(), refused("Gain"));
        assert_eq!(InputFilterRecord { gain: f32::NAN, ..record }.encode(), refused("Gain"));
        assert_eq!(InputFilterRecord { mode: VMode::Unknown(1), ..record }.encode(), refused("Mode"));
        assert_eq!(InputFilterRecord { mode: VMode::Off, ..record }.check(), Ok(()));
        // A newer device may return values that the file does not define, such as 5 in bits 1 to 3.
        let read = InputFilterRecord::decode(&[0, 0, 0x0A, 0, 0, 0, 0, 0, 0]).unwrap();
        assert_eq!((read.mode, read.mode.raw()), (VMode::Unknown(5), 5));
    }

    #[test]
    fn f_parameters_get_their_checksum() {
        // SIL 2 is 01 in bits 2 and 3. Version 1 is in bits 6 and 7. The source and destination addresses are 1, and the
        // watchdog time is 100 ms. The CRC in the file is 49406 = 0xC0FE.
        assert_eq!(F_PARAMETERS.default_bytes(), [0x04, 0x40, 0x00, 0x01, 0x00, 0x01, 0x00, 0x64, 0xC0, 0xFE]);
        let mut parameters = F_PARAMETERS.default;
        parameters.destination_address = 12;
        parameters.watchdog_time = 200;
        let record = [0x04, 0x40, 0x00, 0x01, 0x00, 0x0C, 0x00, 0xC8, 0xBB, 0x42];
        assert_eq!(F_PARAMETERS.encode(&parameters), Ok(record));
        parameters.watchdog_time = 49;
        assert_eq!(F_PARAMETERS.encode(&parameters), Err(NotAllowed { field: "F_WD_Time" }));
        parameters.watchdog_time = 50;
        parameters.sil = lexibus::profinet::Sil::Sil3;
        assert_eq!(F_PARAMETERS.encode(&parameters), Err(NotAllowed { field: "F_SIL" }));
    }

    #[test]
    fn start_up_records_of_a_plan() {
        let mut plan = Plan::<8>::new(&DAP).unwrap();
        plan.plug(2, &modules::safe_inputs::MODULE).unwrap();
        let filter = InputFilterRecord { invert: false, ..InputFilterRecord::DEFAULT }.encode().unwrap();
        let replacements = [Replacement::new(2, 1, InputFilterRecord::INDEX, &filter)];
        let mut records = plan.records_with(&replacements).unwrap();
        let first = records.next().unwrap();
        assert_eq!((first.api, first.slot, first.subslot, first.index), (0, 2, 1, 2));
        assert_eq!(first.data, [0x5A, 0x01, 0x04, 0x3F, 0xC0, 0x00, 0x00, 0xEE, 0x07]);
        let second = records.next().unwrap();
        assert_eq!((second.index, second.data), (0x100, &F_PARAMETERS.default_bytes()[..]));
        assert_eq!(records.next(), None);
        // The inputs consist of 3 + 4 bytes with a provider status, and a consumer status for the outputs. The inputs
        // also contain one status byte each for head, interface and port.
        assert_eq!(plan.lengths(), (8 + 1 + 3, 6 + 1 + 3));
        assert_eq!(safe_inputs::SUBMODULE.input_len, Some(7));
    }

    #[test]
    fn diagnosis_has_the_texts_of_the_file() {
        // An error of channel 3 appears (0x0800): error type 256, extended error type 7, and value 5.
        let block = [0x00, 0x03, 0x08, 0x00, 0x01, 0x00, 0x00, 0x07, 0x00, 0x00, 0x00, 0x05];
        let structure = UserStructure::from_identifier(0x8002);
        let found = ChannelDiagnosis::decode(structure, &block).next().unwrap();
        let error = diagnosis::channel_error(0, found.error_type).unwrap();
        assert_eq!((error.name, error.help), ("Cross circuit", "Check the wiring."));
        let extended = found.extended.unwrap();
        let precise = error.extended(extended.error_type).unwrap();
        assert_eq!((precise.name, extended.add_value), ("Between A and B", 5));
        assert_eq!(diagnosis::channel_error(0, 1), None);
        // Two profiles define the same error type differently. Error types without a profile are valid for all APIs.
        let name = |api| diagnosis::channel_error(api, 0x9000).map(|error| error.name);
        assert_eq!((name(0x3A00), name(0x5B00), name(0)), (Some("Alpha"), Some("Beta"), None));
        assert_eq!(diagnosis::channel_error(0x3A00, found.error_type), Some(error));
        // The count is 0x0102, and the state in bits 4 and 5 is 2.
        let report = diagnosis::ReportDiagnosis::decode(&[0x01, 0x02, 0x20]).unwrap();
        assert_eq!((report.count, report.state), (0x0102, 2));
        assert_eq!(diagnosis::ReportDiagnosis::IDENTIFIER, 0x1000);
    }
}

mod profidrive {
    use super::drive::submodules::{standard_telegram_1, standard_telegram_3};
    use super::drive::{modules, DAP};
    use lexibus::profinet::{IoData, IoStatus, Plan, PlanError, WithStatus};
    use standard_telegram_3::{Inputs, Outputs, OutputsMut};

    #[test]
    fn telegram_words_are_big_endian() {
        // STW1 is 0x047F: bits 0 to 6 and 10. NSOLL_B is 0x20000000, half the reference speed. STW2 and G1_STW are 0.
        let outputs = Outputs {
            on: true,
            no_coast_stop: true,
            no_quick_stop: true,
            enable_operation: true,
            enable_ramp_generator: true,
            unfreeze_ramp_generator: true,
            enable_set_point: true,
            control_by_plc: true,
            nsoll_b: 0x2000_0000,
            stw2: 0,
            g1_stw: 0x0102,
        };
        let image = [0x04, 0x7F, 0x20, 0x00, 0x00, 0x00, 0x00, 0x00, 0x01, 0x02];
        assert_eq!(outputs.pack(), image);
        assert_eq!(Outputs::unpack(&image), Ok(outputs));

        // ZSW1 is 0x0205: bits 0, 2 and 9. NIST_B is −1. The encoder position follows.
        let mut image = [0x02, 0x05, 0xFF, 0xFF, 0xFF, 0xFF, 0x12, 0x34, 0x56, 0x78, 0, 0, 0, 0, 0, 0, 0, 0, 0x80];
        image[10..14].copy_from_slice(&[0xDE, 0xAD, 0xBE, 0xEF]);
        let read = WithStatus::<Inputs>::read(&image).unwrap();
        let inputs = read.data;
        assert!(inputs.ready_to_switch_on && inputs.operation_enabled && inputs.control_requested && !inputs.fault);
        assert_eq!((inputs.nist_b, inputs.zsw2, inputs.g1_zsw), (-1, 0x1234, 0x5678));
        assert_eq!((inputs.g1_xist1, inputs.g1_xist2, read.provider), (0xDEAD_BEEF, 0, IoStatus::GOOD));
    }

    #[test]
    fn a_cyclic_task_writes_in_place() {
        let mut image = [0; Outputs::LEN];
        let mut outputs = OutputsMut::new(&mut image).unwrap();
        outputs.set_control_by_plc(true);
        outputs.set_on(true);
        outputs.set_nsoll_b(-2);
        outputs.set_on(false);
        assert!(outputs.view().control_by_plc() && !outputs.view().on());
        assert_eq!(image, [0x04, 0x00, 0xFF, 0xFF, 0xFF, 0xFE, 0, 0, 0, 0]);
    }

    #[test]
    fn the_axis_is_fixed_and_its_telegram_a_choice() {
        let mut plan = Plan::<8>::with_defaults(&DAP).unwrap();
        let of_axis = |plan: &Plan<8>| {
            let mut places = plan.expected().filter(|expected| expected.slot == 1);
            [places.next(), places.next()]
                .map(|place| place.map(|place| (place.subslot, place.api, place.submodule_ident)))
        };
        assert_eq!(of_axis(&plan), [Some((1, 0x3A00, 0xFFFF)), Some((2, 0x3A00, 3))]);
        assert_eq!(plan.unplug(1), Err(PlanError::FixedModule));
        let other = &standard_telegram_1::SUBMODULE;
        assert_eq!(plan.plug_submodule(1, 2, other), Err(PlanError::SubslotTaken));
        plan.unplug_submodule(1, 2).unwrap();
        plan.plug_submodule(1, 2, other).unwrap();
        assert_eq!(of_axis(&plan)[1], Some((2, 0x3A00, 1)));
        assert_eq!(plan.module(1).map(|module| module.ident), Some(modules::axis::MODULE.ident));
        assert_eq!(standard_telegram_1::Inputs::LEN, 4);
        assert_eq!(<standard_telegram_1::Outputs as IoData>::STATUS_LEN, 1);
    }
}

mod multi_dap {
    use super::heads::{basic_head, modules, plus_head, submodules};
    use lexibus::profinet::{Plan, PlanError};
    use submodules::input_module::SetupRecord;

    fn places<const N: usize>(plan: &Plan<N>) -> Vec<(u16, u16, u32)> {
        plan.expected().map(|expected| (expected.slot, expected.subslot, expected.module_ident)).collect()
    }

    #[test]
    fn each_head_takes_its_own_modules() {
        let mut basic = Plan::<8>::new(&basic_head::DAP).unwrap();
        assert_eq!(places(&basic), [(0, 1, 1), (0, 0x8000, 1), (0, 0x8001, 1)]);
        basic.plug(1, &modules::input_module::MODULE).unwrap();
        assert_eq!(basic.plug(2, &modules::frame::MODULE), Err(PlanError::ModuleNotAllowed));
        assert_eq!(basic.plug(3, &modules::input_module::MODULE), Err(PlanError::NoSuchSlot));
        // The head, interface and port have one status byte each, and the inputs have two bytes and a status byte: 3 +
        // 3 bytes. Three more bytes exceed the maximum of 8.
        assert_eq!(basic.lengths().0, 6);
        assert_eq!(basic.plug(2, &modules::input_module::MODULE), Err(PlanError::InputsTooLong));

        let mut plus = Plan::<16>::new(&plus_head::DAP).unwrap();
        assert_eq!(places(&plus)[3..], [(1, 1, 0x102)], "the power module is always present");
        assert_eq!(plus.plug(1, &modules::input_module::MODULE), Err(PlanError::FixedModule));
        plus.plug(3, &modules::frame::MODULE).unwrap();
        assert_eq!(plus.plug_submodule(3, 5, &submodules::valve_output::SUBMODULE), Err(PlanError::NoSuchSubslot));
        plus.plug_submodule(3, 4, &submodules::valve_output::SUBMODULE).unwrap();
        plus.plug(2, &modules::input_module::MODULE).unwrap();
        assert_eq!(places(&plus)[4..], [(2, 1, 0x101), (3, 1, 0x103), (3, 4, 0x103)]);
        let defaults = Plan::<16>::with_defaults(&plus_head::DAP).unwrap();
        assert_eq!(places(&defaults)[4..], [(2, 1, 0x101)]);
    }

    #[test]
    fn records_of_each_slot() {
        let mut plan = Plan::<16>::new(&plus_head::DAP).unwrap();
        plan.plug(4, &modules::input_module::MODULE).unwrap();
        plan.plug(2, &modules::input_module::MODULE).unwrap();
        // The value 500 is 0x01F4.
        let records: Vec<_> = plan.records().map(|record| (record.slot, record.index, record.data.to_vec())).collect();
        assert_eq!(records, [(2, 16, vec![0x01, 0xF4]), (4, 16, vec![0x01, 0xF4])]);
        assert_eq!(SetupRecord { delay_ms: 1000 }.encode(), Ok([0x03, 0xE8]));
        assert!(SetupRecord { delay_ms: 1001 }.encode().is_err());
    }

    #[test]
    fn heads_are_told_apart() {
        assert_eq!((basic_head::DAP.module.ident, plus_head::DAP.module.ident), (1, 2));
        assert_eq!(plus_head::IDENTITY.product_name, "Plus head");
        assert_eq!(plus_head::DAP.device_id, 3);
    }
}

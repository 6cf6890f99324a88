//! EtherCAT from description to bytes: the bindings of `data/coupler.esi.xml`, a modular coupler and a servo drive, with
//! process images and start-up lists that were worked out by hand.

use lexibus::ethercat::{Assignment, AssignmentError, PlanError, SlotPlan, Transition};
use lexibus::{Client, CoE, Object, Pdo, SdoWrite};

lexibus::dictionary! {
    /// Everything in the file. (Its warnings are about objects that only PDOs know.)
    #[allow(deprecated)]
    pub mod io = "tests/data/coupler.esi.xml";
}

lexibus::dictionary! {
    /// Of two devices, the drive alone, and of it what is from 0x6000 on.
    #[allow(deprecated)]
    pub mod drive = "tests/data/coupler.esi.xml" { device: "sv-*@latest", objects: "0x6000..0xFFFF" }
}

use io::{cp_32, modules, sv_1};

/// Slot 0: inputs, slot 1: analogue inputs, slot 2: outputs, slot 4: inputs.
fn plan() -> SlotPlan<32> {
    let mut plan = SlotPlan::new(&cp_32::DEVICE).unwrap();
    plan.plug(0, &modules::di_16::MODULE).unwrap();
    plan.plug(1, &modules::ai_2::MODULE).unwrap();
    plan.plug(2, &modules::do_8::MODULE).unwrap();
    plan.plug(4, &modules::di_16::MODULE).unwrap();
    plan.check().unwrap();
    plan
}

#[test]
fn modules_follow_each_other_in_the_image() {
    let plan = plan();
    // The coupler's status takes byte 0; 16 inputs bytes 1 and 2; 2 × 16 + 2 + 2 + 4 bits bytes 3 to 7; 16 inputs the rest.
    assert_eq!((plan.bytes(2), plan.bytes(3)), (1, 10));
    let at = |slot, index| plan.place(slot, index).map(|place| (place.index, place.sync_manager, place.bit));
    assert_eq!(at(0, 0x1A00), Some((0x1A00, 3, 8)));
    assert_eq!(at(1, 0x1A00), Some((0x1A01, 3, 24)));
    assert_eq!(at(4, 0x1A00), Some((0x1A04, 3, 64)));
    assert_eq!(at(2, 0x1600), Some((0x1602, 2, 0)));
    assert_eq!(at(3, 0x1A00), None);
}

#[test]
fn inputs_are_read_where_they_stand() {
    let image = [0x80, 0x05, 0x80, 0xFE, 0xFF, 0x34, 0x12, 0x0B, 0x00, 0x01];
    let plan = plan();
    let of = |slot: u16| &image[plan.place(slot, 0x1A00).unwrap().bit as usize / 8..];
    let inputs = modules::di_16::view::Inputs::new(of(0)).unwrap();
    assert!(inputs.input_1() && !inputs.input_2() && inputs.input_3() && !inputs.input_15() && inputs.input_16());
    let channels = modules::ai_2::view::Channels::new(of(1)).unwrap();
    assert_eq!((channels.channel_1(), channels.channel_2()), (-2, 0x1234));
    // 0x0B is 0b10_11: the second state and the first.
    assert_eq!((channels.state_1().get(), channels.state_2().get()), (3, 2));
    let last = modules::di_16::pdo::Inputs::unpack(of(4)).unwrap();
    assert!(last.input_9 && !last.input_1);
    assert!(modules::ai_2::view::Channels::new(&image[6..]).is_err());
}

#[test]
fn outputs_are_written_where_they_stand() {
    let mut image = [0xFF; 1];
    let mut outputs = modules::do_8::view::Outputs::new(&mut image).unwrap();
    outputs.set_output_2(false);
    outputs.set_output_8(false);
    assert_eq!(image, [0b0111_1101]);
}

#[test]
fn what_does_not_fit_is_refused() {
    let mut plan = plan();
    assert_eq!(plan.plug(4, &modules::do_8::MODULE), Err(PlanError::Taken(4)));
    assert_eq!(plan.plug(32, &modules::do_8::MODULE), Err(PlanError::NoSuchSlot(32)));
    // Ten bytes are taken, and the sync manager has twelve.
    plan.plug(5, &modules::ai_2::MODULE).unwrap();
    assert_eq!(plan.check(), Err(PlanError::TooLong { sync_manager: 3, bytes: 15, max: 12 }));
    assert_eq!(SlotPlan::<32>::new(&cp_32::DEVICE).unwrap().check(), Err(PlanError::Empty(0)));
}

#[test]
fn the_start_up_list_of_a_plan() {
    let mut commands = Vec::new();
    let collected = plan().try_for_each_command(Transition::PS, |command| {
        commands.push((command.object.index, command.object.sub_index, command.data().to_vec()));
        Ok::<(), ()>(())
    });
    assert_eq!(collected, Ok(()));
    let expected: &[(u16, u8, &[u8])] = &[
        (0xF030, 0, &[0]),
        (0xF030, 1, &[0x01, 0x10, 0, 0]),
        (0xF030, 2, &[0x01, 0x30, 0, 0]),
        (0xF030, 3, &[0x01, 0x20, 0, 0]),
        (0xF030, 4, &[0, 0, 0, 0]),
        (0xF030, 5, &[0x01, 0x10, 0, 0]),
        (0xF030, 0, &[5]),
        (0x8010, 1, &[2]),
        (0x1C12, 0, &[0]),
        (0x1C13, 0, &[0]),
        (0x1C12, 1, &[0x02, 0x16]),
        (0x1C12, 0, &[1]),
        (0x1C13, 1, &[0xFF, 0x1A]),
        (0x1C13, 2, &[0x00, 0x1A]),
        (0x1C13, 3, &[0x01, 0x1A]),
        (0x1C13, 4, &[0x04, 0x1A]),
        (0x1C13, 0, &[4]),
    ];
    let expected: Vec<_> = expected.iter().map(|&(index, sub, data)| (index, sub, data.to_vec())).collect();
    assert_eq!(commands, expected);
}

#[derive(Default)]
struct Recorder(Vec<(Object, Vec<u8>)>);

impl Client for Recorder {
    type Bus = CoE;
    type Error = core::convert::Infallible;

    fn read(&mut self, _: Object, buffer: &mut [u8]) -> Result<usize, Self::Error> {
        buffer[0] = 2;
        Ok(1)
    }

    fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Self::Error> {
        self.0.push((address, data.to_vec()));
        Ok(())
    }
}

#[test]
fn objects_of_a_module_are_found_at_its_slot() {
    use modules::ai_2::{objects, types::Filter};
    let mut client = Recorder::default();
    let offset = plan().index_offset(1).unwrap();
    objects::settings::FILTER.shifted(offset).at(&mut client).write(Filter::_50Hz).unwrap();
    assert_eq!(client.0, [(Object { index: 0x8010, sub_index: 1 }, vec![1])]);
    assert_eq!(objects::settings::FILTER.at(&mut client).read().unwrap(), Filter::_60Hz);
    assert_eq!(Filter::from_raw(9), Filter::Unknown(9));
}

#[test]
fn the_image_of_the_drive() {
    // Ready and mode in bits 0 to 3 of byte 0, four bits of padding, then 16 and 32 bits.
    let inputs = sv_1::image::Inputs {
        inputs: sv_1::pdo::Inputs { ready: true, mode: lexibus::Uint::new(5).unwrap() },
        position: sv_1::pdo::Position { statusword: 0x1237, position_actual_value: -2 },
    };
    let bytes = [0x0B, 0x37, 0x12, 0xFE, 0xFF, 0xFF, 0xFF];
    assert_eq!(inputs.pack(), bytes);
    assert_eq!(sv_1::image::Inputs::unpack(&bytes).unwrap(), inputs);
    assert!(sv_1::image::Inputs::unpack(&bytes[..6]).is_err());
    let view = sv_1::image::InputsView::new(&bytes).unwrap();
    assert_eq!((view.inputs().mode().get(), view.position().position_actual_value()), (5, -2));

    let mut outputs = [0; sv_1::image::Outputs::LEN];
    let mut view = sv_1::image::OutputsView::new(&mut outputs).unwrap();
    view.position_mode_mut().set_controlword(0x0F);
    view.position_mode_mut().set_target_position(0x0102_0304);
    assert_eq!(outputs, [0x0F, 0, 4, 3, 2, 1]);
}

#[test]
fn any_legal_choice_of_pdos_has_its_image_and_its_start_up_list() {
    let default = Assignment::<8>::by_default(&sv_1::DEVICE).unwrap();
    assert_eq!(default.commands().collect::<Vec<_>>(), sv_1::STARTUP);
    assert_eq!(
        &sv_1::STARTUP[..4],
        [
            SdoWrite::new_u8(0x1C12, 0, 0),
            SdoWrite::new_u8(0x1C13, 0, 0),
            SdoWrite::new_u8(0x1600, 0, 0),
            SdoWrite::new_u32(0x1600, 1, 0x6040_0010),
        ]
    );
    let velocity = Assignment::<8>::new(&sv_1::DEVICE, &[sv_1::pdo::VelocityMode::INDEX, 0x1A01]).unwrap();
    assert_eq!((velocity.bytes(2), velocity.bytes(3)), (6, 7));
    assert_eq!(velocity.find(0x1A01).map(|placed| placed.bit), Some(0));
    let refused = |pdos: &[u16]| Assignment::<8>::new(&sv_1::DEVICE, pdos).map(|_| ()).unwrap_err();
    assert_eq!(refused(&[0x1600, 0x1601, 0x1A01]), AssignmentError::Conflict(0x1600, 0x1601));
    assert_eq!(refused(&[0x1600]), AssignmentError::Missing(0x1A01));
}

#[test]
fn what_a_master_has_to_know() {
    let device = &sv_1::DEVICE;
    assert_eq!((device.identity.product_code, device.identity.order_code), (Some(0x00A1_0002), "SV-1"));
    let manager = device.sync_manager(2).unwrap();
    assert_eq!((manager.start_address, manager.default_size, manager.control), (0x1100, 6, 0x64));
    let coe = device.mailbox.coe.unwrap();
    assert!(coe.pdo_assign && coe.pdo_config && device.mailbox.foe && !device.mailbox.eoe);
    assert_eq!((coe.init_commands[0].index, coe.init_commands[0].data), (0x6060, &[8][..]));
    let mode = &sv_1::CLOCK_MODES[0];
    assert_eq!((mode.name, mode.assign_activate), ("DC", 0x0300));
    assert_eq!((mode.cycle_sync0.of_cycle(1_000_000), mode.shift_sync0.of_cycle(1_000_000)), (1_000_000, 250_000));
    assert_eq!(sv_1::FMMUS.len(), 3);
    assert_eq!(sv_1::EEPROM_CONFIG_DATA, [0x08, 0x0C, 0x00, 0xCC, 0xE8, 0x03]);
}

#[test]
fn items_have_the_types_of_the_dictionary() {
    use sv_1::{objects, types::DirectionOfRotation};
    assert_eq!(*objects::DEVICE_TYPE.initial(), lexibus::Initial::Value(0x0002_0192));
    assert_eq!(*objects::DEVICE_NAME.initial(), lexibus::Initial::Value("SV-1"));
    assert_eq!(*objects::motor::DIRECTION.initial(), lexibus::Initial::Value(DirectionOfRotation::CounterClockwise));
    assert_eq!(*objects::motor::CURRENT_LIMIT.range(), lexibus::Range::Between(1, 500));
    assert_eq!(*objects::motor::CURRENT_LIMIT.initial(), lexibus::Initial::Value(100));
    assert!(objects::CONTROLWORD.flags().contains(lexibus::Flags::RPDO));
    // What a PDO maps and no dictionary describes is there, too.
    assert_eq!(objects::object_2100::MODE.location().coe, Object { index: 0x2100, sub_index: 2 });
    let mut drive = sv_1::Sv1::new(Recorder::default());
    assert!(drive.motor().current_limit().write(501).is_err());
    drive.motor().current_limit().write(500).unwrap();
    assert_eq!(drive.into_client().0, [(Object { index: 0x2000, sub_index: 2 }, vec![0xF4, 0x01])]);
}

#[test]
fn what_is_not_selected_costs_nothing() {
    assert_eq!(drive::IDENTITY.product_code, Some(0x00A1_0002));
    assert_eq!(drive::objects::TARGET_POSITION.location().coe.index, 0x607A);
}

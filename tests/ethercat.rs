//! Tests the code that is generated for EtherCAT devices: slot plans, start-up commands and process images. The
//! expected process images and start-up commands were calculated by hand. The bindings are generated from
//! `data/coupler.esi.xml` (a modular coupler and a servo drive) and `data/gateway.esi.xml` (slot groups).

#![cfg(feature = "macros")]

use lexibus::ethercat::{Assignment, AssignmentError, PlanError, SlotPlan, Transition};
use lexibus::{Client, CoE, Object, Pdo, SdoWrite};

lexibus::dictionary! {
    /// All devices of the file. The compiler warns about objects that only PDO entries describe.
    #[allow(deprecated)]
    pub mod io = "tests/data/coupler.esi.xml";
}

lexibus::dictionary! {
    /// Bindings of the drive only, with its objects from index 0x6000.
    #[allow(deprecated)]
    pub mod drive = "tests/data/coupler.esi.xml" { device: "sv-*@latest", objects: "0x6000..0xFFFF" }
}

lexibus::dictionary! {
    /// A device with slot groups, and with PDOs whose lengths are not multiples of 8 bits.
    #[allow(deprecated)]
    pub mod bits = "tests/data/gateway.esi.xml";
}

use bits::{bs_175, gw_4};
use io::{cp_32, modules, sv_1};

/// Returns a plan with digital inputs in slot 0, analog inputs in slot 1, outputs in slot 2, and digital inputs in slot
/// 4.
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
    // Byte 0 contains the coupler's status. Bytes 1 and 2 contain 16 inputs. Bytes 3 to 7 contain 2 × 16 + 2 + 2 + 4
    // bits. 16 inputs follow.
    assert_eq!((plan.bytes(2), plan.bytes(3)), (1, 10));
    let at = |slot, index| plan.pdo(slot, index).map(|place| (place.index, place.sync_manager, place.bit));
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
    let of = |slot: u16| &image[plan.pdo(slot, 0x1A00).unwrap().bit as usize / 8..];
    let inputs = modules::di_16::view::Inputs::new(of(0)).unwrap();
    assert!(inputs.input_1() && !inputs.input_2() && inputs.input_3() && !inputs.input_15() && inputs.input_16());
    let channels = modules::ai_2::view::Channels::new(of(1)).unwrap();
    assert_eq!((channels.channel_1(), channels.channel_2()), (-2, 0x1234));
    // 0x0B is 0b10_11. The first state is in the lower two bits, and the second state is in the upper two.
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
    // The plan has ten bytes of inputs, and the module in slot 5 adds five. The sync manager can have at most twelve.
    plan.plug(5, &modules::ai_2::MODULE).unwrap();
    assert_eq!(plan.check(), Err(PlanError::TooLong { sync_manager: 3, bytes: 15, max: 12 }));
    assert_eq!(SlotPlan::<32>::new(&cp_32::DEVICE).unwrap().check(), Err(PlanError::Empty(0)));
}

/// Returns the commands of a plan for a transition: index, sub-index and bytes.
fn commands<const N: usize>(plan: &SlotPlan<N>, transition: Transition) -> Vec<(u16, u8, Vec<u8>)> {
    let mut commands = Vec::new();
    let collected = plan.try_for_each_command(transition, |command| {
        commands.push((command.object.index, command.object.sub_index, command.data().to_vec()));
        Ok::<(), ()>(())
    });
    assert_eq!(collected, Ok(()));
    commands
}

fn expected(list: &[(u16, u8, &[u8])]) -> Vec<(u16, u8, Vec<u8>)> {
    list.iter().map(|&(index, sub, data)| (index, sub, data.to_vec())).collect()
}

#[test]
fn the_start_up_list_of_a_plan() {
    let list = [
        (0xF030, 0, &[0][..]),
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
    assert_eq!(commands(&plan(), Transition::PS), expected(&list));
    assert_eq!(commands(&plan(), Transition::IP), []);
}

/// Returns a plan with slots 0 and 1 in group 1, and slots 2 and 3 in group 2. The modules have 2, 4, 4 and 2 bits.
fn groups() -> SlotPlan<4> {
    let mut plan = SlotPlan::new(&gw_4::DEVICE).unwrap();
    plan.plug(0, &bits::modules::bit_2::MODULE).unwrap();
    plan.plug(1, &bits::modules::bit_4::MODULE).unwrap();
    plan.plug(2, &bits::modules::bit_4::MODULE).unwrap();
    plan.plug(3, &bits::modules::bit_2::MODULE).unwrap();
    plan.check().unwrap();
    plan
}

#[test]
fn indices_grow_with_slot_and_slot_group() {
    // PDO indices increase by 1 per slot and by 0x20 per group (0x30 in group 2). Object indices increase by 0x10 per
    // slot in group 1, by 0x20 per slot in group 2, and by 0x800 per group.
    let list = [
        (0x8800, 1, &[1][..]),
        (0x9000, 1, &[1]),
        (0x1C12, 0, &[0]),
        (0x1C13, 0, &[0]),
        // The first commands are for outputs. The PDO index of a 2-bit module depends on the slot, and its object index
        // depends on slot and group. The PDO index of a 4-bit module depends on the group. The PDO of a 4-bit module
        // maps an object that depends on the group, and an object of the device.
        (0x1600, 0, &[0]),
        (0x1600, 1, &[0x02, 1, 0x00, 0x78]),
        (0x1600, 0, &[1]),
        (0x1620, 0, &[0]),
        (0x1620, 1, &[0x03, 2, 0x00, 0x78]),
        (0x1620, 2, &[0x01, 1, 0x00, 0xF2]),
        (0x1620, 0, &[2]),
        (0x1660, 0, &[0]),
        (0x1660, 1, &[0x03, 2, 0x00, 0x80]),
        (0x1660, 2, &[0x01, 1, 0x00, 0xF2]),
        (0x1660, 0, &[2]),
        (0x1603, 0, &[0]),
        (0x1603, 1, &[0x02, 1, 0x60, 0x80]),
        (0x1603, 0, &[1]),
        // The other commands are for inputs. The PDO index of a 2-bit module depends on slot and group, and its object
        // indices depend on the slot. The PDO index of a 4-bit module depends on the slot, and its object index depends
        // on slot and group.
        (0x1A20, 0, &[0]),
        (0x1A20, 1, &[0x01, 1, 0x00, 0x60]),
        (0x1A20, 2, &[0x01, 2, 0x00, 0x60]),
        (0x1A20, 0, &[2]),
        (0x1A01, 0, &[0]),
        (0x1A01, 1, &[0x04, 1, 0x10, 0x68]),
        (0x1A01, 0, &[1]),
        (0x1A02, 0, &[0]),
        (0x1A02, 1, &[0x04, 1, 0x40, 0x70]),
        (0x1A02, 0, &[1]),
        (0x1A63, 0, &[0]),
        (0x1A63, 1, &[0x01, 1, 0x60, 0x60]),
        (0x1A63, 2, &[0x01, 2, 0x60, 0x60]),
        (0x1A63, 0, &[2]),
        (0x1C12, 1, &[0x00, 0x16]),
        (0x1C12, 2, &[0x20, 0x16]),
        (0x1C12, 3, &[0x60, 0x16]),
        (0x1C12, 4, &[0x03, 0x16]),
        (0x1C12, 0, &[4]),
        (0x1C13, 1, &[0x20, 0x1A]),
        (0x1C13, 2, &[0x01, 0x1A]),
        (0x1C13, 3, &[0x02, 0x1A]),
        (0x1C13, 4, &[0x63, 0x1A]),
        (0x1C13, 0, &[4]),
    ];
    let plan = groups();
    assert_eq!(commands(&plan, Transition::PS), expected(&list));
    let offsets = |index| [0, 1, 2, 3].map(|slot| plan.index_offset(slot, index).unwrap());
    // Index offsets of four objects for the slots. The index of an object depends on slot and group, only on the group,
    // or on neither.
    assert_eq!(offsets(0x8000)[1..3], [0x810, 0x1040]);
    assert_eq!(offsets(0x9000)[1..3], [0x800, 0x1000]);
    assert_eq!(offsets(0xF210), [0; 4]);
    assert_eq!(offsets(0x6000), [0, 0x810, 0x1040, 0x60]);
}

#[test]
fn the_list_of_modules_goes_out_on_the_change_that_the_description_names() {
    let list = [
        (0xF030, 0, &[0][..]),
        (0xF030, 1, &[0x01, 0x50, 0, 0]),
        (0xF030, 2, &[0x02, 0x50, 0, 0]),
        (0xF030, 3, &[0x02, 0x50, 0, 0]),
        (0xF030, 4, &[0x01, 0x50, 0, 0]),
        (0xF030, 0, &[4]),
    ];
    assert_eq!(commands(&groups(), Transition::IP), expected(&list));
    assert_eq!(commands(&groups(), Transition::SO), []);
}

#[test]
fn modules_of_a_few_bits_are_read_and_written_where_the_plan_puts_them() {
    let plan = groups();
    let bit = |slot, index| plan.pdo(slot, index).unwrap().bit as usize;
    assert_eq!([0, 1, 2, 3].map(|slot| bit(slot, 0x1A00)), [0, 2, 6, 10]);
    // The binary values of the modules, from the last to the first, are 10, 0110, 1010 and 01.
    let image = [0b1010_1001, 0b0000_1001];
    let two = |slot| bits::modules::bit_2::view::Inputs::at(image, bit(slot, 0x1A00)).unwrap();
    let four = |slot| bits::modules::bit_4::view::Inputs::at(image, bit(slot, 0x1A00)).unwrap().state().get();
    assert_eq!((two(0).input_1(), two(0).input_2(), four(1)), (true, false, 0b1010));
    assert_eq!((four(2), two(3).input_1(), two(3).input_2()), (0b0110, false, true));

    let mut image = [0xFF; 2];
    let mut four = bits::modules::bit_4::view::Outputs::at(&mut image, bit(2, 0x1600)).unwrap();
    four.set_level(lexibus::Uint::new(0b010).unwrap());
    assert!(four.enable());
    four.set_enable(false);
    assert_eq!((four.level().get(), four.enable()), (0b010, false));
    assert_eq!(image, [0b1011_1111, 0b1111_1100]);
    let mut two = |slot, value| {
        let mut view = bits::modules::bit_2::view::Outputs::at(&mut image, bit(slot, 0x1600)).unwrap();
        view.set_level(lexibus::Uint::new(value).unwrap());
    };
    two(3, 0b01);
    two(0, 0b00);
    assert_eq!(image, [0b1011_1100, 0b1111_0100]);

    // The image has no bits after bit 15.
    assert!(bits::modules::bit_4::view::Inputs::at(image, 12).is_ok());
    assert!(bits::modules::bit_4::view::Inputs::at(image, 13).is_err());
    assert!(bits::modules::bit_4::view::Inputs::at(image, usize::MAX).is_err());
}

/// Tests bit strings of 3 and 100 bits, then of 70 and 2 bits.
#[test]
fn strings_of_bits_of_any_length() {
    let mut flags = [0; 13];
    (flags[0], flags[12]) = (0x01, 0x0F);
    let mut pattern = [0xFF; 9];
    pattern[8] = 0x3F;
    let image = bs_175::image::Inputs {
        data: bs_175::pdo::Data { mode: lexibus::Uint::new(0b101).unwrap(), flags },
        bytes: bs_175::pdo::Bytes { pattern, count: lexibus::Uint::new(0b10).unwrap() },
    };
    let mut bytes = [0; 22];
    bytes[0] = 0b0000_1101;
    bytes[12..21].fill(0xFF);
    bytes[12] = 0b1111_1000;
    bytes[21] = 0b0101_1111;
    assert_eq!(image.pack(), bytes);
    assert_eq!(bs_175::image::Inputs::unpack(&bytes).unwrap(), image);
    // Bits that exceed the length of a field are discarded.
    let data = bs_175::pdo::Data { flags: [0xFF; 13], ..image.data };
    assert_eq!(data.pack()[12], 0b0111_1111);
    assert_eq!(bs_175::pdo::Data::unpack(&[0xFF; 13]).unwrap().flags[12], 0x0F);

    let view = bs_175::image::InputsView::new(&bytes).unwrap();
    assert_eq!((view.data().mode().get(), view.data().flags()), (0b101, flags));
    assert_eq!((view.bytes().pattern(), view.bytes().count().get()), (pattern, 0b10));
    let mut view = bs_175::image::InputsView::new(&mut bytes).unwrap();
    view.bytes_mut().set_pattern([0; 9]);
    view.data_mut().set_flags([0xFF; 13]);
    let mut changed = [0xFF; 22];
    changed[0] = 0b1111_1101;
    changed[12] = 0b0111_1111;
    changed[13..].fill(0);
    changed[21] = 0b0100_0000;
    assert_eq!(bytes, changed);
}

#[derive(Default)]
struct Recorder(Vec<(Object, Vec<u8>)>);

impl Client for Recorder {
    type Bus = CoE;
    type Error = core::convert::Infallible;

    fn read(&mut self, _: Object, buffer: &mut [u8]) -> Result<usize, lexibus::Error<Self::Error>> {
        buffer[0] = 2;
        Ok(1)
    }

    fn write(&mut self, address: Object, data: &[u8]) -> Result<(), lexibus::Error<Self::Error>> {
        self.0.push((address, data.to_vec()));
        Ok(())
    }
}

#[test]
fn objects_of_a_module_are_found_at_its_slot() {
    use modules::ai_2::{objects, types::Filter};
    let mut client = Recorder::default();
    let offset = plan().index_offset(1, 0x8000).unwrap();
    objects::settings::FILTER.shifted(offset).at(&mut client).write(Filter::_50Hz).unwrap();
    assert_eq!(client.0, [(Object { index: 0x8010, sub_index: 1 }, vec![1])]);
    assert_eq!(objects::settings::FILTER.at(&mut client).read().unwrap(), Filter::_60Hz);
    assert_eq!(Filter::from_raw(9), Filter::Unknown(9));
}

#[test]
fn the_image_of_the_drive() {
    // Byte 0 contains ready and mode in bits 0 to 3, and four bits of padding. Fields of 16 and 32 bits follow.
    let inputs = sv_1::image::Inputs {
        inputs: sv_1::pdo::Inputs { ready: true, mode: lexibus::Uint::new(5).unwrap() },
        position: sv_1::pdo::Position {
            statusword: sv_1::types::Statusword::from_raw(0x1237),
            position_actual_value: -2,
        },
    };
    let bytes = [0x0B, 0x37, 0x12, 0xFE, 0xFF, 0xFF, 0xFF];
    assert_eq!(inputs.pack(), bytes);
    assert_eq!(sv_1::image::Inputs::unpack(&bytes).unwrap(), inputs);
    assert!(sv_1::image::Inputs::unpack(&bytes[..6]).is_err());
    let view = sv_1::image::InputsView::new(&bytes).unwrap();
    assert_eq!((view.inputs().mode().get(), view.position().position_actual_value()), (5, -2));

    let mut outputs = [0; sv_1::image::Outputs::LEN];
    let mut view = sv_1::image::OutputsView::new(&mut outputs).unwrap();
    view.position_mode_mut().set_controlword(sv_1::types::Controlword::from_raw(0x0F));
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
fn the_default_start_up_list_is_sent_with_one_call() {
    /// Records the writes.
    struct Recorder(Vec<(Object, Vec<u8>)>);

    impl Client for Recorder {
        type Bus = CoE;
        type Error = ();

        fn read(&mut self, _: Object, _: &mut [u8]) -> Result<usize, lexibus::Error<()>> {
            Err(lexibus::Error::Client(()))
        }

        fn write(&mut self, object: Object, data: &[u8]) -> Result<(), lexibus::Error<()>> {
            self.0.push((object, data.to_vec()));
            Ok(())
        }
    }

    let mut client = Recorder(Vec::new());
    lexibus::ethercat::configure(&mut client, sv_1::STARTUP).unwrap();
    let expected: Vec<_> = sv_1::STARTUP.iter().map(|write| (write.object(), write.data().to_vec())).collect();
    assert_eq!(client.0, expected);
    assert_eq!(client.0[3], (Object { index: 0x1600, sub_index: 1 }, vec![0x10, 0, 0x40, 0x60]));
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
    use sv_1::objects;
    use sv_1::types::{DeviceType, DirectionOfRotation};
    assert_eq!(*objects::DEVICE_TYPE.initial(), lexibus::Initial::Value(DeviceType::from_raw(0x0002_0192)));
    assert_eq!(*objects::DEVICE_NAME.initial(), lexibus::Initial::Value("SV-1"));
    assert_eq!(*objects::motor::DIRECTION.initial(), lexibus::Initial::Value(DirectionOfRotation::CounterClockwise));
    assert_eq!(*objects::motor::CURRENT_LIMIT.range(), lexibus::Range::Between(1, 500));
    assert_eq!(*objects::motor::CURRENT_LIMIT.initial(), lexibus::Initial::Value(100));
    assert!(objects::CONTROLWORD.flags().contains(lexibus::Flags::RPDO));
    // An object that only a PDO entry describes must also have bindings.
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

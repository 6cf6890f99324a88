//! Tests generated accessors and PDOs of an EtherCAT drive with `ethercrab`. The SubDevices are simulated in this
//! process; no network interface is used.

use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;

use ethercrab::error::{Error as BusError, MailboxError};
use ethercrab::subdevice_group::{Op, PreOp};
use ethercrab::{AlStatusCode, DefaultLock, MainDevice, SubDeviceGroup, SubDeviceState};
use lexibus::clients::ethercat::{is_a, Cycle, CycleError, Memory, Sdo};
use lexibus::ethercat::{configure_async, Assignment, Device, Mailbox, StartupCommand, Transition};
use lexibus::sim::{EtherCatFault, FaultyFrames};
use lexibus::Emergency;
use lexibus::{
    AbortCode, AsyncClient, Error, EscMemory, Flags, Initial, Item, LengthError, Object, OctetString, OnEsc,
    OutOfRange, Pdo, Range, Ro, Rw, SdoWrite, Step, WalkError,
};

#[path = "../examples/support/ethercat/mod.rs"]
mod ethercat;
#[path = "support/segment.rs"]
mod segment;

use ethercat::objects::Dictionary;
use ethercat::{Servo, SubDevice};
use segment::{with_faulty_segment, with_segment};

lexibus::dictionary! {
    /// The bindings of the demo servo.
    pub mod servo = "examples/support/servo.esi.xml" { table: true, strict: true }
}

use servo::types::{Controlword, ModesOfOperation, State};
use servo::{image, objects, pdo, view, DemoServo};

type Group<S = PreOp> = SubDeviceGroup<4, 64, DefaultLock, S>;

/// Returns a SubDevice and the servo in it, which a test can inspect.
fn servo() -> (SubDevice, Rc<RefCell<Servo>>) {
    let servo = Rc::new(RefCell::new(Servo::new()));
    (SubDevice::new(&servo::DEVICE, servo.clone()), servo)
}

async fn pre_op(maindevice: &'static MainDevice<'static>) -> Group {
    maindevice.init_single_group(|| 1_000_000).await.expect("all SubDevices in Pre-Operational")
}

fn drive(maindevice: &'static MainDevice<'static>, group: &Group, index: usize) -> DemoServo<Sdo<'static>> {
    DemoServo::new(Sdo::new(maindevice, &group.subdevice(maindevice, index).expect("a SubDevice")))
}

async fn read(client: &mut Sdo<'_>, index: u16, sub_index: u8) -> Result<Vec<u8>, Error<BusError>> {
    let mut buffer = [0; 64];
    let length = client.read(Object { index, sub_index }, &mut buffer).await?;
    Ok(buffer[..length].to_vec())
}

async fn write(client: &mut Sdo<'_>, index: u16, sub_index: u8, data: &[u8]) -> Result<(), Error<BusError>> {
    client.write(Object { index, sub_index }, data).await
}

#[test]
fn objects_of_every_length() {
    let (subdevice, device) = servo();
    with_segment(vec![subdevice], |maindevice| async move {
        let group = pre_op(maindevice).await;
        let mut drive = drive(maindevice, &group, 0);

        // Expedited transfers of 1, 2 and 4 bytes.
        drive.modes_of_operation().write_async(ModesOfOperation::Homing).await.unwrap();
        assert_eq!(drive.modes_of_operation().read_async().await, Ok(ModesOfOperation::Homing));
        assert_eq!(drive.statusword().read_async().await.unwrap().raw(), 0x0250);
        drive.target_position().write_async(-100_000).await.unwrap();
        assert_eq!(drive.target_position().read_async().await, Ok(-100_000));
        assert_eq!(device.borrow().device.get(objects::TARGET_POSITION), Ok(-100_000));

        // Normal transfers: the value fits in one mailbox message.
        assert_eq!(drive.operating_time().read_async().await, Ok(5_000_000_123));
        drive.encoder_offset().write_async(i64::MIN + 5).await.unwrap();
        assert_eq!(drive.encoder_offset().read_async().await, Ok(i64::MIN + 5));
        let mut buffer = [0; 300];
        assert_eq!(drive.device_name().read_into_async(&mut buffer).await, Ok("Demo Servo"));
        drive.axis_label().write_async("turntable").await.unwrap();
        assert_eq!(drive.axis_label().read_into_async(&mut buffer).await, Ok("turntable"));

        // Segmented transfers: if the mailbox has 128 bytes, the first message contains up to 112 bytes of data, and
        // each segment contains up to 119.
        let text: String = ('a'..='z').cycle().take(300).collect();
        for length in [112, 113, 117, 119, 230, 231, 232, 235, 300] {
            drive.axis_label().write_async(&text[..length]).await.unwrap();
            assert_eq!(drive.axis_label().read_into_async(&mut buffer).await, Ok(&text[..length]));
        }
    });
}

#[test]
fn memory_of_the_slave_controller() {
    const fn item<V: lexibus::Value, A>(address: u16, length: u16) -> Item<V, A, OnEsc> {
        Item::new(OnEsc::memory(address, length), "Memory", Range::Full, Initial::Unknown, "", Flags::NONE)
    }
    const AL_STATUS: Item<u16, Ro, OnEsc> = item(0x0130, 2);
    const WATCHDOG_DIVIDER: Item<u16, Rw, OnEsc> = item(0x0400, 2);
    const PORT_TIMES: Item<OctetString, Ro, OnEsc> = item(0x0900, 16);
    with_segment(vec![servo().0, servo().0], |maindevice| async move {
        let group = pre_op(maindevice).await;
        let memory = |at| Memory::new(maindevice, &group.subdevice(maindevice, at).expect("a SubDevice"));
        let (mut first, mut second) = (memory(0), memory(1));
        assert_eq!(AL_STATUS.at(&mut first).read_async().await, Ok(2), "Pre-Operational");
        WATCHDOG_DIVIDER.at(&mut second).write_async(0x1234).await.unwrap();
        assert_eq!(WATCHDOG_DIVIDER.at(&mut second).read_async().await, Ok(0x1234));
        assert_eq!(WATCHDOG_DIVIDER.at(&mut first).read_async().await, Ok(0));
        let mut buffer = [0; 20];
        assert_eq!(PORT_TIMES.at(&mut first).read_into_async(&mut buffer).await.map(<[u8]>::len), Ok(16));
        let short = first.write(EscMemory::new(0x0400, 2), &[1]).await;
        assert_eq!(short, Err(Error::Length(LengthError::new(2, 1))));
    });
}

#[test]
fn what_the_device_refuses() {
    let (subdevice, _) = servo();
    with_segment(vec![subdevice], |maindevice| async move {
        let group = pre_op(maindevice).await;
        let mut drive = drive(maindevice, &group, 0);
        // Both the accessor and the device reject values outside the range.
        let refused = drive.profile_velocity().write_async(1_000_001).await.map_err(Error::from);
        assert_eq!(refused, Err(Error::OutOfRange(OutOfRange)));
        let client = drive.client();
        let too_high = write(client, 0x6081, 0, &1_000_001_u32.to_le_bytes()).await;
        assert_eq!(too_high, Err(Error::Abort(AbortCode::TOO_HIGH)));
        assert_eq!(write(client, 0x6041, 0, &[0, 0]).await, Err(Error::Abort(AbortCode::READ_ONLY)));
        assert_eq!(write(client, 0x607A, 0, &[0; 2]).await, Err(Error::Abort(AbortCode::TOO_SHORT)));
        assert_eq!(write(client, 0x607A, 0, &[0; 8]).await, Err(Error::Abort(AbortCode::TOO_LONG)));
        assert_eq!(read(client, 0x5FFF, 0).await, Err(Error::Abort(AbortCode::NO_OBJECT)));
        assert_eq!(read(client, 0x2100, 9).await, Err(Error::Abort(AbortCode::NO_SUB_INDEX)));
        let message = read(client, 0x5FFF, 0).await.unwrap_err().to_string();
        assert_eq!(message, "the device refused: 0x06020000: the object doesn't exist in the dictionary");

        // Values of 20 bytes (one message) and 200 bytes (segmented transfer) are longer than the buffer for reading.
        // The next transfer must succeed.
        let label = Object { index: 0x2011, sub_index: 0 };
        for length in [20, 200] {
            client.write(label, &vec![b'x'; length]).await.unwrap();
            let long = client.read(label, &mut [0; 4]).await;
            assert_eq!(long, Err(Error::Length(LengthError::new(4, length))));
            assert_eq!(drive_name(client).await, "Demo Servo");
        }
    });
}

async fn drive_name(client: &mut Sdo<'_>) -> String {
    String::from_utf8(read(client, 0x1008, 0).await.unwrap()).unwrap()
}

#[test]
fn process_data_by_default() {
    let (subdevice, device) = servo();
    with_segment(vec![subdevice], |maindevice| async move {
        let group = pre_op(maindevice).await;
        let mut drive = drive(maindevice, &group, 0);
        let assignment = Assignment::<8>::by_default(&servo::DEVICE).unwrap();
        drive.client().configure(assignment.startup()).await.unwrap();
        // The master must have sent the initialization command in the device description.
        assert_eq!(
            device.borrow().device.get(objects::MODES_OF_OPERATION),
            Ok(ModesOfOperation::CyclicSynchronousPosition)
        );

        let group: Group<Op> = group.into_op(maindevice).await.unwrap();
        let subdevice = group.subdevice(maindevice, 0).unwrap();
        let mut controlword = Controlword::new();
        let mut state = None;
        for _ in 0..20 {
            let outputs = image::Outputs { position_mode: pdo::PositionMode { controlword, target_position: 4711 } };
            subdevice.outputs_raw_mut().copy_from_slice(&outputs.pack());
            let answer = group.tx_rx(maindevice).await.unwrap();
            assert_eq!(answer.working_counter, 3);
            let inputs = image::Inputs::unpack(&subdevice.inputs_raw()).unwrap();
            assert!(inputs.signals.homed && inputs.signals.brake.get() == 5);
            state = inputs.position.statusword.state();
            match state.map(|state| state.toward(State::OperationEnabled)) {
                Some(Step::Command(command)) => controlword = controlword.with_command(command),
                Some(Step::Reached) if inputs.position.position_actual_value == 4711 => break,
                _ => {}
            }
        }
        assert_eq!(state, Some(State::OperationEnabled));
        assert_eq!(device.borrow().device.get(objects::CONTROLWORD), Ok(Controlword::from_raw(0x0F)));
        assert_eq!(device.borrow().device.get(objects::TARGET_POSITION), Ok(4711));
        assert_eq!(drive.position_actual_value().read_async().await, Ok(4711));

        // Write a single field within the process data.
        let mut outputs = subdevice.outputs_raw_mut();
        image::OutputsView::new(&mut outputs[..]).unwrap().position_mode_mut().set_target_position(-2);
        drop(outputs);
        group.tx_rx(maindevice).await.unwrap();
        group.tx_rx(maindevice).await.unwrap();
        let inputs = subdevice.inputs_raw();
        assert_eq!(image::InputsView::new(&inputs[..]).unwrap().position().position_actual_value(), -2);
    });
}

#[test]
fn process_data_of_another_choice() {
    let (subdevice, device) = servo();
    with_segment(vec![subdevice], |maindevice| async move {
        let group = pre_op(maindevice).await;
        let mut drive = drive(maindevice, &group, 0);
        let choice = [pdo::VelocityMode::INDEX, pdo::Velocity::INDEX, pdo::Position::INDEX];
        let assignment = Assignment::<8>::new(&servo::DEVICE, &choice).unwrap();
        configure_async(drive.client(), assignment.startup()).await.unwrap();
        assert_eq!(read(drive.client(), 0x1C12, 1).await, Ok(vec![0x01, 0x16]));
        assert_eq!(read(drive.client(), 0x1C13, 0).await, Ok(vec![2]));
        assert_eq!(read(drive.client(), 0x1C13, 1).await, Ok(vec![0x02, 0x1A]));
        assert_eq!(read(drive.client(), 0x1601, 2).await, Ok(vec![0x20, 0, 0xFF, 0x60]));

        let group = group.into_op(maindevice).await.unwrap();
        let subdevice = group.subdevice(maindevice, 0).unwrap();
        assert_eq!((subdevice.inputs_raw().len(), subdevice.outputs_raw().len()), (10, 6));
        for controlword in [0x06, 0x07, 0x0F, 0x0F] {
            let controlword = Controlword::from_raw(controlword);
            let packed = pdo::VelocityMode { controlword, target_velocity: -1500 }.pack();
            subdevice.outputs_raw_mut().copy_from_slice(&packed);
            group.tx_rx(maindevice).await.unwrap();
        }
        group.tx_rx(maindevice).await.unwrap();
        assert_eq!(device.borrow().device.get(objects::TARGET_VELOCITY), Ok(-1500));
        let inputs = subdevice.inputs_raw();
        let bit = |index| assignment.find(index).unwrap().bit as usize;
        let velocity = view::Velocity::at(&inputs[..], bit(pdo::Velocity::INDEX)).unwrap();
        let position = view::Position::at(&inputs[..], bit(pdo::Position::INDEX)).unwrap();
        assert_eq!(velocity.velocity_actual_value(), -1500);
        assert_eq!(position.statusword().state(), Some(State::OperationEnabled));
    });
}

#[test]
fn a_mapping_is_written_in_its_order_and_in_pre_operational() {
    let (subdevice, _) = servo();
    with_segment(vec![subdevice], |maindevice| async move {
        let group = pre_op(maindevice).await;
        let mut drive = drive(maindevice, &group, 0);
        let client = drive.client();
        // The device rejects a write to a mapping entry while the count is not 0, a write to a fixed mapping, and the
        // mapping of an unknown object.
        let entry = 0x6064_0020_u32.to_le_bytes();
        assert_eq!(write(client, 0x1A02, 1, &entry).await, Err(Error::Abort(AbortCode(0x0601_0003))));
        assert_eq!(write(client, 0x1A00, 0, &[0]).await, Err(Error::Abort(AbortCode::READ_ONLY)));
        SdoWrite::new_u8(0x1A02, 0, 0).send_async(client).await.unwrap();
        let missing = SdoWrite::new_u32(0x1A02, 1, 0x5FFF_0020).send_async(client).await;
        assert_eq!(missing.map_err(Error::from), Err(Error::Abort(AbortCode::NOT_MAPPABLE)));
        SdoWrite::new_u32(0x1A02, 1, u32::from_le_bytes(entry)).send_async(client).await.unwrap();
        SdoWrite::new_u8(0x1A02, 0, 1).send_async(client).await.unwrap();
        // Assign PDOs that exclude each other.
        SdoWrite::new_u8(0x1C12, 0, 0).send_async(client).await.unwrap();
        SdoWrite::new_u16(0x1C12, 1, 0x1600).send_async(client).await.unwrap();
        SdoWrite::new_u16(0x1C12, 2, 0x1601).send_async(client).await.unwrap();
        let both = SdoWrite::new_u8(0x1C12, 0, 2).send_async(client).await;
        assert_eq!(both.map_err(Error::from), Err(Error::Abort(AbortCode::PARAMETER_INCOMPATIBLE)));
        SdoWrite::new_u8(0x1C12, 0, 1).send_async(client).await.unwrap();

        let _group = group.into_safe_op(maindevice).await.unwrap();
        let late = SdoWrite::new_u8(0x1A02, 0, 0).send_async(client).await;
        assert_eq!(late.map_err(Error::from), Err(Error::Abort(AbortCode::DEVICE_STATE)));
        assert_eq!(drive.modes_of_operation().read_async().await, Ok(ModesOfOperation::from_raw(0)));
    });
}

#[test]
fn all_entries_at_once() {
    let (subdevice, _) = servo();
    with_segment(vec![subdevice], |maindevice| async move {
        let group = pre_op(maindevice).await;
        let mut drive = drive(maindevice, &group, 0);
        let client = drive.client();
        let assigned = Object { index: 0x1C13, sub_index: 0 };
        let mut buffer = [0; 16];
        assert_eq!(client.read_complete(assigned, &mut buffer).await, Ok(6));
        assert_eq!(buffer[..6], [2, 0, 0x00, 0x1A, 0x01, 0x1A]);

        let command = StartupCommand {
            transition: Transition::PS,
            object: assigned,
            complete_access: true,
            data: lexibus::ethercat::StartupData::Bytes(&[3, 0, 0x01, 0x1A, 0x02, 0x1A, 0x00, 0x1A]),
        };
        client.configure([command]).await.unwrap();
        assert_eq!(client.read_complete(assigned, &mut buffer).await, Ok(8));
        assert_eq!(buffer[..8], [3, 0, 0x01, 0x1A, 0x02, 0x1A, 0x00, 0x1A]);
        client.write_complete(assigned, &[1, 0, 0x01, 0x1A]).await.unwrap();
        assert_eq!(read(client, 0x1C13, 0).await, Ok(vec![1]));
    });
}

#[test]
fn an_emergency_in_front_of_an_answer_is_kept() {
    let (subdevice, device) = servo();
    with_segment(vec![subdevice], |maindevice| async move {
        let group = pre_op(maindevice).await;
        let mut drive = drive(maindevice, &group, 0);
        assert_eq!(drive.client().take_emergency(), None);
        let group = group.into_op(maindevice).await.unwrap();
        let subdevice = group.subdevice(maindevice, 0).unwrap();
        for controlword in [0x06, 0x07, 0x0F] {
            let controlword = Controlword::from_raw(controlword);
            let packed = pdo::PositionMode { controlword, target_position: 0 }.pack();
            subdevice.outputs_raw_mut().copy_from_slice(&packed);
            group.tx_rx(maindevice).await.unwrap();
        }
        // The write causes a fault. The device sends the emergency message before the response.
        drive.encoder_offset().write_async(7).await.unwrap();
        let emergency = Emergency { code: 0x7300, register: 0x21, vendor: [0; 5] };
        assert_eq!(drive.client().take_emergency(), Some(emergency));
        assert_eq!(drive.client().take_emergency(), None);
        assert_eq!(drive.encoder_offset().read_async().await, Ok(7));
        // The emergency message is pending before the request is sent.
        device.borrow_mut().trip(0x3210).unwrap();
        assert_eq!(drive.statusword().read_async().await.unwrap().state(), Some(State::Fault));
        assert_eq!(drive.client().take_emergency().map(|emergency| emergency.code), Some(0x3210));
    });
}

#[test]
fn several_subdevices_in_a_row() {
    let ((one, first), (other, second)) = (servo(), servo());
    with_segment(vec![one, other], |maindevice| async move {
        let group = pre_op(maindevice).await;
        assert_eq!(group.len(), 2);
        for subdevice in group.iter(maindevice) {
            assert!(is_a(&subdevice, &servo::IDENTITY));
            assert!(!is_a(&subdevice, &lexibus::Identity { product_code: Some(1), ..servo::IDENTITY }));
            assert_eq!(subdevice.name(), "DEMO-SERVO");
        }
        let (mut left, mut right) = (drive(maindevice, &group, 0), drive(maindevice, &group, 1));
        left.profile_velocity().write_async(111).await.unwrap();
        right.profile_velocity().write_async(222).await.unwrap();
        assert_eq!(first.borrow().device.get(objects::PROFILE_VELOCITY), Ok(111));
        assert_eq!(second.borrow().device.get(objects::PROFILE_VELOCITY), Ok(222));

        let group = group.into_op(maindevice).await.unwrap();
        for (index, target_position) in [(0, 1), (1, 2)] {
            let mode = pdo::PositionMode { controlword: Controlword::new(), target_position };
            let subdevice = group.subdevice(maindevice, index).unwrap();
            subdevice.outputs_raw_mut().copy_from_slice(&mode.pack());
        }
        let answer = group.tx_rx_sync_system_time(maindevice).await.unwrap();
        assert_eq!(answer.working_counter, 6);
        assert!(answer.extra.is_some(), "the segment has a clock");
        assert_eq!(first.borrow().device.get(objects::TARGET_POSITION), Ok(1));
        assert_eq!(second.borrow().device.get(objects::TARGET_POSITION), Ok(2));
    });
}

#[test]
fn stale_inputs_are_an_error() {
    with_segment(vec![servo().0, servo().0], |maindevice| async move {
        let group = pre_op(maindevice).await;
        let memory = |at| Memory::new(maindevice, &group.subdevice(maindevice, at).expect("a SubDevice"));
        let (mut first, mut second) = (memory(0), memory(1));
        let group: Group<Op> = group.into_op(maindevice).await.unwrap();
        let cycle = Cycle::of(maindevice, &group);
        assert_eq!(cycle, Cycle::expecting(6));
        assert_eq!(cycle.run(maindevice, &group).await, Ok(()));
        // The second SubDevice stops mapping its inputs when FMMU 1 is deactivated.
        let activate = EscMemory::new(0x061C, 1);
        second.write(activate, &[0]).await.unwrap();
        let missing = CycleError::WorkingCounter { expected: 6, actual: 5 };
        assert_eq!(cycle.run(maindevice, &group).await, Err(missing));
        second.write(activate, &[1]).await.unwrap();
        assert_eq!(cycle.run(maindevice, &group).await, Ok(()));
        // A write to AL control switches the first SubDevice to Safe-Operational.
        first.write(EscMemory::new(0x0120, 2), &[4, 0]).await.unwrap();
        let state =
            CycleError::State { subdevice: 0, state: SubDeviceState::SafeOp, code: Some(AlStatusCode::NoError) };
        assert_eq!(cycle.run(maindevice, &group).await, Err(state));
        // The SubDevice refuses a state that doesn't exist.
        first.write(EscMemory::new(0x0120, 2), &[7, 0]).await.unwrap();
        let refused = cycle.run(maindevice, &group).await.unwrap_err();
        let code = Some(AlStatusCode::UnknownRequestedState);
        assert!(matches!(refused, CycleError::State { subdevice: 0, code: of, .. } if of == code), "{refused:?}");
        assert!(refused.to_string().contains("0x0012"), "{refused}");
    });
}

#[test]
fn a_client_with_a_timer_can_wait() {
    with_segment(vec![servo().0], |maindevice| async move {
        let group = pre_op(maindevice).await;
        let subdevice = group.subdevice(maindevice, 0).unwrap();
        let limit = Duration::from_millis(100);
        let mut drive = DemoServo::new(Sdo::new(maindevice, &subdevice));
        let walked = drive.walk_async(State::OperationEnabled, limit).await;
        assert!(matches!(walked, Err(WalkError::Wait(Error::NoClock))), "{walked:?}");
        let mut drive = DemoServo::new(Sdo::new(maindevice, &subdevice).with_timer(tokio::time::sleep));
        let start = tokio::time::Instant::now();
        // The servo changes its drive state only in the EtherCAT state Operational.
        let walked = drive.walk_async(State::OperationEnabled, limit).await;
        assert!(matches!(walked, Err(WalkError::Deadline { state: Some(State::SwitchOnDisabled), .. })), "{walked:?}");
        assert!(start.elapsed() > Duration::ZERO, "the timer runs in simulated time");
    });
}

#[test]
fn faults_of_a_cycle() {
    let faults = FaultyFrames::new();
    with_faulty_segment(vec![servo().0, servo().0], faults.clone(), |maindevice| async move {
        let group = pre_op(maindevice).await;
        let station = group.subdevice(maindevice, 1).unwrap().configured_address();
        let group: Group<Op> = group.into_op(maindevice).await.unwrap();
        let cycle = Cycle::of(maindevice, &group);
        assert_eq!(cycle.run(maindevice, &group).await, Ok(()));
        // One SubDevice doesn't process the datagram of the second cycle.
        faults.inject_nth(EtherCatFault::WorkingCounter(3), 2);
        assert_eq!(cycle.run(maindevice, &group).await, Ok(()));
        let missing = CycleError::WorkingCounter { expected: 6, actual: 3 };
        assert_eq!(cycle.run(maindevice, &group).await, Err(missing));
        assert_eq!(cycle.run(maindevice, &group).await, Ok(()));
        // The second SubDevice leaves Operational with an error.
        faults.inject(EtherCatFault::State(0x14), move |datagram| datagram.station == station);
        for _ in 0..3 {
            let left = cycle.run(maindevice, &group).await;
            assert!(matches!(left, Err(CycleError::State { subdevice: 1, .. })), "{left:?}");
        }
        faults.clear_faults();
        assert_eq!(cycle.run(maindevice, &group).await, Ok(()));
        // The frame is lost. `ethercrab` would report the loss after its own timeout, in real time.
        faults.inject_nth(EtherCatFault::LostFrame, 1);
        let lost = tokio::time::timeout(Duration::from_secs(1), cycle.run(maindevice, &group)).await;
        assert!(lost.is_err(), "{lost:?}");
        assert_eq!(cycle.run(maindevice, &group).await, Ok(()));
    });
}

#[test]
fn a_lost_mailbox_reply_is_requested_again() {
    let (subdevice, device) = servo();
    let faults = FaultyFrames::new();
    with_faulty_segment(vec![subdevice], faults.clone(), |maindevice| async move {
        let lose = |count| (1..=count).for_each(|n| faults.inject_nth(EtherCatFault::LostReply, n));
        let group = pre_op(maindevice).await;
        let mut drive = drive(maindevice, &group, 0);
        for count in [1, 2, 3] {
            lose(count);
            drive.target_position().write_async(100 + count as i32).await.unwrap();
            assert_eq!(device.borrow().device.get(objects::TARGET_POSITION), Ok(100 + count as i32));
            lose(count);
            assert_eq!(drive.target_position().read_async().await, Ok(100 + count as i32));
        }
        // A read fails because four replies are lost. The next read must return the right value.
        lose(4);
        assert!(matches!(drive.target_position().read_async().await.map_err(Error::from), Err(Error::Client(_))));
        faults.clear_faults();
        assert_eq!(drive.target_position().read_async().await, Ok(103));
    });
}

/// The description of the servo, but without mailbox and sync managers.
static MUTE: Device = Device { mailbox: Mailbox::NONE, sync_managers: &[], ..servo::DEVICE };

#[test]
fn what_goes_wrong_on_the_bus() {
    struct Nothing;

    impl Dictionary for Nothing {
        fn read(&mut self, _: u16, _: u8) -> Result<Vec<u8>, u32> {
            Err(AbortCode::GENERAL.0)
        }

        fn write(&mut self, _: u16, _: u8, _: &[u8]) -> Result<(), u32> {
            // 0x12345678 is not a standard abort code.
            Err(0x1234_5678)
        }
    }

    let subdevices = vec![SubDevice::new(&MUTE, Nothing), SubDevice::new(&servo::DEVICE, Nothing)];
    with_segment(subdevices, |maindevice| async move {
        let group = pre_op(maindevice).await;
        let mut mute = drive(maindevice, &group, 0);
        let missing = BusError::Mailbox(MailboxError::NoWriteMailbox);
        assert_eq!(mute.target_position().read_async().await.map_err(Error::from), Err(Error::Client(missing)));

        let mut other = drive(maindevice, &group, 1);
        let unknown = Error::Abort(AbortCode(0x1234_5678));
        assert_eq!(other.target_position().write_async(1).await.map_err(Error::from), Err(unknown));
        assert_eq!(
            other.target_position().read_async().await.map_err(Error::from),
            Err(Error::Abort(AbortCode::GENERAL))
        );
        let mut hasty = DemoServo::new(other.into_client().with_timeout(Duration::ZERO));
        let late = hasty.target_position().read_async().await.map_err(Error::from);
        assert_eq!(late, Err(Error::Timeout));
    });
}

//! Tests the bindings of the Kollmorgen AKD with the byte sequences of its manual, packed, written and read by generated code.

#![cfg(feature = "akd")]

use std::collections::HashMap;

use lexibus::codes::CodeTable;
use lexibus::ethercat::{Assignment, AssignmentError, Transition};
use lexibus::message::{Message, Reader, Reply, Request, Writer};
use lexibus::{
    Client, CoE, Error, Esc, EscMemory, Item, LengthError, Object, OnEsc, Pdo, Ro, Rw, SdoWrite, Step, Value,
};
use lexibus_drives::akd::types::{
    AlCommand, AlControl, AlEventRequest, AlState, AlStatus, AlStatusCode, CommunicationState, ControlWord,
    DriveCommand, DriveState, InterruptEnable, LatchControl, LatchControlRead, LatchStatus, LatchStatusAcquired,
    MailboxRouting, MailboxType, MailboxTypeProtocol, ModesOfOperation, SdoCommand, SdoResult, StatusWord,
};
use lexibus_drives::akd::{codes, messages, objects, pdo, procedures, Akd, DEVICE, STARTUP};

/// Objects with any value. Records the order of writes.
#[derive(Default)]
struct Slave {
    objects: HashMap<Object, Vec<u8>>,
    written: Vec<(Object, Vec<u8>)>,
}

impl Client for Slave {
    type Bus = CoE;
    type Error = Object;

    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Error<Object>> {
        let value = self.objects.get(&object).ok_or(Error::Client(object))?;
        buffer.iter_mut().zip(value).for_each(|(to, from)| *to = *from);
        Ok(value.len())
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Error<Object>> {
        self.objects.insert(object, data.to_vec());
        self.written.push((object, data.to_vec()));
        Ok(())
    }
}

/// The start-up list of the example (section 4.6.1), with 0x1A00 instead of 0x1B01, which the manual assigns.
const LIST: [(u16, u8, &[u8]); 23] = [
    (0x1C12, 0, &[0x00]),
    (0x1C13, 0, &[0x00]),
    (0x1A00, 0, &[0x00]),
    (0x1A00, 1, &[0x10, 0x00, 0x41, 0x60]),
    (0x1A00, 2, &[0x20, 0x00, 0x63, 0x60]),
    (0x1A00, 0, &[0x02]),
    (0x1A01, 0, &[0x00]),
    (0x1A02, 0, &[0x00]),
    (0x1A03, 0, &[0x00]),
    (0x1600, 0, &[0x00]),
    (0x1600, 1, &[0x10, 0x00, 0x40, 0x60]),
    (0x1600, 2, &[0x20, 0x01, 0xC1, 0x60]),
    (0x1600, 0, &[0x02]),
    (0x1601, 0, &[0x00]),
    (0x1602, 0, &[0x00]),
    (0x1603, 0, &[0x00]),
    (0x1C12, 1, &[0x00, 0x16]),
    (0x1C12, 0, &[0x01]),
    (0x1C13, 1, &[0x00, 0x1A]),
    (0x1C13, 0, &[0x01]),
    (0x6060, 0, &[0x07]),
    (0x60C2, 1, &[0x02]),
    (0x60C2, 2, &[0xFD]),
];

fn bytes(write: &SdoWrite) -> (u16, u8, &[u8]) {
    (write.object().index, write.object().sub_index, write.data())
}

#[test]
fn the_start_up_list_is_a_procedure() {
    let list: Vec<_> = procedures::FREE_MAPPING.iter().map(bytes).collect();
    assert_eq!(list, LIST);
    let mut slave = Slave::default();
    for write in &procedures::FREE_MAPPING {
        write.send(&mut slave).expect("it takes any value");
    }
    let mut drive = Akd::new(slave);
    assert_eq!(drive.modes_of_operation().read(), Ok(ModesOfOperation::InterpolatedPosition));
    // The sequence that selects a fixed mapping (section 4.5).
    let fixed: Vec<_> = procedures::ASSIGN_1701.iter().map(bytes).collect();
    assert_eq!(fixed, [(0x1C12, 0, &[0x00][..]), (0x1C12, 1, &[0x01, 0x17]), (0x1C12, 0, &[0x01])]);
}

/// The printed mailbox request that assigns 0x1704 (section 4.13.3).
const REQUEST: [u8; 16] =
    [0x0A, 0x00, 0x00, 0x00, 0x00, 0x03, 0x00, 0x20, 0x2B, 0x12, 0x1C, 0x01, 0x04, 0x17, 0x00, 0x00];

#[test]
fn the_request_of_the_mailbox_is_what_the_accessor_writes() {
    let mut drive = Akd::new(Slave::default());
    drive.sync_manager_2_assignment().pdo_1().write(0x1704).expect("any value");
    let (object, data) = drive.client().written.pop().expect("it was written");
    let (index, sub_index) = (object.index.to_le_bytes(), object.sub_index);
    assert_eq!([index[0], index[1], sub_index, data[0], data[1]], REQUEST[9..14]);
    // The command states how many of the four bytes are written: 0x2F one, 0x2B two, 0x27 three, 0x23 four (section 4.13.1).
    assert_eq!((data.len(), REQUEST[8]), (2, 0x23 + (4 - 2) * 4));
    assert_eq!(REQUEST[14..], [0, 0]);
}

/// The reply (section 4.13.3), with the correct length and type.
const REPLY: [u8; 16] =
    [0x0A, 0x00, 0x00, 0x00, 0x00, 0x03, 0x00, 0x30, 0x60, 0x12, 0x1C, 0x01, 0x00, 0x00, 0x00, 0x00];

#[test]
fn the_frames_of_the_mailbox() {
    let r#type = MailboxType::new().with_protocol(MailboxTypeProtocol::CoE);
    let request = messages::Sdo {
        address: 0,
        routing: MailboxRouting::new(),
        r#type,
        command: SdoCommand::Write2Bytes,
        index: 0x1C12,
        sub_index: 1,
        data: 0x1704,
    };
    let mut data = [0; messages::MAX_DATA];
    let mut to = Writer::new(&mut data);
    request.write(0, &mut to).expect("16 bytes");
    assert_eq!(to.written(), REQUEST);
    assert_eq!(messages::Sdo::parse(&mut Reader::new(&REQUEST)), Some((0, request)));
    let reply = messages::SdoReply::read(&REQUEST, &mut Reader::new(&REPLY)).expect("the reply");
    assert_eq!((reply.r#type, reply.result, reply.data), (r#type, SdoResult::Written, 0));
    // The printed reply has a wrong length, and the type of a request.
    for (byte, printed) in [(0, 0x0E), (7, 0x20)] {
        let mut wrong = REPLY;
        wrong[byte] = printed;
        assert_eq!(messages::SdoReply::read(&REQUEST, &mut Reader::new(&wrong)), None);
    }
}

mod mapped {
    use lexibus_drives::akd as drive;

    lexibus::pdo! {
        /// Objects that the example maps to 0x1600.
        pub struct Outputs: drive::pdo::RxPdo1600 { control_word, position_command_value: interpolation_data_record::position_command_value }
    }
    lexibus::pdo! {
        /// Objects that the example maps to 0x1A00.
        pub struct Inputs: drive::pdo::TxPdo1A00 { status_word, internal_position_actual_value }
    }
}

#[test]
fn a_mapping_of_ones_own_gives_the_same_list() {
    let assignment =
        Assignment::<8>::new(&DEVICE, &[mapped::Inputs::INDEX, mapped::Outputs::INDEX]).expect("they go together");
    let assignment =
        assignment.with_mapping::<mapped::Inputs>().and_then(|mapped| mapped.with_mapping::<mapped::Outputs>());
    let assignment = assignment.expect("both can be mapped");
    let writes: Vec<SdoWrite> = assignment.commands().collect();
    let writes: Vec<_> = writes.iter().map(bytes).collect();
    // The whole list except the steps that clear unused PDOs, and the step that a user added.
    let unused = [0x1A01, 0x1A02, 0x1A03, 0x1601, 0x1602, 0x1603, 0x6060, 0x60C2];
    let expected: Vec<_> = LIST.into_iter().filter(|(index, ..)| !unused.contains(index)).collect();
    assert_eq!(writes, expected);
    let outputs = mapped::Outputs { control_word: ControlWord::from_raw(0x000F), position_command_value: -2 };
    assert_eq!(outputs.pack(), [0x0F, 0x00, 0xFE, 0xFF, 0xFF, 0xFF]);
}

#[test]
fn fixed_mappings_exclude_each_other() {
    let by_default = Assignment::<8>::by_default(&DEVICE).expect("they go together");
    let assigned: Vec<u16> = by_default.pdos().map(|mapped| mapped.pdo.index).collect();
    assert_eq!(assigned, [0x1701, 0x1B01]);
    assert_eq!((by_default.bytes(2), by_default.bytes(3)), (6, 6), "as the tool shows (section 4.6)");
    let writes: Vec<_> = STARTUP.iter().map(bytes).collect();
    assert_eq!(writes.first(), Some(&(0x1C12, 0, &[0x00][..])));
    assert!(writes.contains(&(0x1C12, 1, &[0x01, 0x17])) && writes.contains(&(0x1C13, 1, &[0x01, 0x1B])));
    assert_eq!(by_default.startup().filter(|mapped| mapped.transition == Transition::PS).count(), writes.len());
    let error = Assignment::<8>::new(&DEVICE, &[0x1701, 0x1720]).expect_err("one fixed mapping only");
    assert_eq!(error, AssignmentError::Conflict(0x1701, 0x1720));
    let unknown = Assignment::<8>::new(&DEVICE, &[0x1704]).expect_err("the manual doesn't describe it");
    assert_eq!(unknown, AssignmentError::Unknown(0x1704));
    let four =
        Assignment::<8>::new(&DEVICE, &[0x1600, 0x1601, 0x1602, 0x1603, 0x1A00]).expect("four at once (section 4.6)");
    assert!(four.with_mapping::<mapped::Outputs>().is_ok());
}

#[test]
fn set_points_are_packed_as_the_manual_lists_them() {
    let control_word = ControlWord::new().with_drive_command(DriveCommand::EnableOperation);
    assert_eq!(control_word.raw(), 0x000F);
    let position = pdo::RxPdo1701 { position_command_value: 0x0102_0304, control_word };
    assert_eq!(position.pack(), [0x04, 0x03, 0x02, 0x01, 0x0F, 0x00]);
    let velocity = pdo::RxPdo1702 { velocity_command_value: -1, control_word };
    assert_eq!(velocity.pack(), [0xFF, 0xFF, 0xFF, 0xFF, 0x0F, 0x00]);
    let torque = pdo::RxPdo1703 { torque_command_value: 0x1234, control_word };
    assert_eq!(torque.pack(), [0x34, 0x12, 0x0F, 0x00]);
    let latch_control_word =
        LatchControl::new().with_enable_latch_1_rising(true).with_read(LatchControlRead::Latch2Rising);
    let all = pdo::RxPdo1722 {
        control_word,
        position_command_value: 0x0102_0304,
        latch_control_word,
        torque_feed_forward: -2,
        physical_outputs: 0xA55A,
        maximum_torque: 0x0BB8,
    };
    let packed = [0x0F, 0x00, 0x04, 0x03, 0x02, 0x01, 0x01, 0x03, 0xFE, 0xFF, 0x5A, 0xA5, 0xB8, 0x0B];
    assert_eq!(all.pack(), packed);
    assert_eq!(pdo::RxPdo1722::unpack(&packed), Ok(all));
    let lengths = [pdo::RxPdo1720::LEN, pdo::RxPdo1721::LEN, pdo::RxPdo1723::LEN, pdo::RxPdo1724::LEN];
    assert_eq!(lengths, [12, 8, 14, 8]);
}

#[test]
fn actual_values_are_unpacked() {
    let mut frame = [0u8; 32];
    frame[0..4].copy_from_slice(&(-5i32).to_le_bytes());
    frame[20..24].copy_from_slice(&7i32.to_le_bytes());
    frame[24..26].copy_from_slice(&0x1237u16.to_le_bytes());
    frame[28..30].copy_from_slice(&0x8302u16.to_le_bytes());
    let all = pdo::TxPdo1B20::unpack(&frame).expect("32 bytes");
    assert_eq!((all.internal_position_actual_value, all.latch_position_rising_edge), (-5, 7));
    assert_eq!(all.status_word.drive_state(), Some(DriveState::OperationEnabled));
    assert!(all.latch_status_word.digital_input_1() && all.latch_status_word.latch_1_falling_valid());
    assert_eq!(all.pack(), frame);
    let lengths = [pdo::TxPdo1B01::LEN, pdo::TxPdo1B02::LEN, pdo::TxPdo1B21::LEN, pdo::TxPdo1B24::LEN];
    assert_eq!((lengths, pdo::TxPdo1B22::LEN, pdo::TxPdo1B23::LEN), ([6; 4], 32, 32));
}

#[test]
fn latch_words() {
    // "Parola del controllo del blocco (2 byte)": one bit each, and a number from bit 8.
    let word = LatchControl::new();
    let bits = [
        word.with_enable_latch_1_rising(true),
        word.with_enable_latch_1_falling(true),
        word.with_enable_latch_2_rising(true),
        word.with_enable_latch_2_falling(true),
    ];
    assert_eq!(bits.map(LatchControl::raw), [0x0001, 0x0002, 0x0004, 0x0008]);
    let read = [
        LatchControlRead::Latch1Rising,
        LatchControlRead::Latch1Falling,
        LatchControlRead::Latch2Rising,
        LatchControlRead::Latch2Falling,
    ];
    assert_eq!(read.map(|read| word.with_read(read).raw()), [0x0100, 0x0200, 0x0300, 0x0400]);
    // "Parola dello stato del blocco (2 byte)": the inputs are numbered in reverse.
    let status = |raw| LatchStatus::from_raw(raw);
    assert!(status(0x1000).digital_input_4() && status(0x2000).digital_input_3());
    assert!(status(0x4000).digital_input_2() && status(0x8000).digital_input_1());
    let acquired = [0x0100, 0x0200, 0x0300, 0x0400].map(|raw| status(raw).acquired());
    let expected = [
        LatchStatusAcquired::Latch1Rising,
        LatchStatusAcquired::Latch1Falling,
        LatchStatusAcquired::Latch2Rising,
        LatchStatusAcquired::Latch2Falling,
    ];
    assert_eq!(acquired, expected);
    assert_eq!(status(0x0500).acquired(), LatchStatusAcquired::Unknown(5));
}

#[test]
fn cycle_times() {
    let mut drive = Akd::new(Slave::default());
    // Section 4.9: 2 ms are 2 and -3, or 20 and -4.
    for (units, index) in [(2u8, -3i8), (20, -4)] {
        drive.interpolation_time_period().interpolation_time_units().write(units).expect("any value");
        drive.interpolation_time_period().interpolation_time_index().write(index).expect("any value");
        let seconds = drive.interpolation_time_period().interpolation_time_units().read_scaled_by(index.into());
        assert!((seconds.expect("it is there") - 0.002).abs() < 1e-12);
    }
    drive.interpolation_time_period().interpolation_time_units().write_scaled_by(0.002, (-3).into()).expect("2 ms");
    let written = drive.client().written.last().cloned();
    assert_eq!(written, Some((Object::new(0x60C2, 1), vec![0x02])));
    // The shortest cycle, 0.25 ms (section 4.10).
    drive
        .interpolation_time_period()
        .interpolation_time_units()
        .write_scaled_by(0.000_25, (-5).into())
        .expect("0.25 ms");
    assert_eq!(drive.client().written.last().map(|mapped| mapped.1.as_slice()), Some(&[25][..]));
}

#[test]
fn states_of_the_communication() {
    // Section 4.3.1.
    let control = AlControl::new().with_request(CommunicationState::Operational);
    assert_eq!((control.raw(), control.with_acknowledge(true).raw()), (0x0008, 0x0018));
    assert_eq!(AlControl::new().with_al_command(AlCommand::RequestPreOperational).raw(), 0x0002);
    // Section 4.3.2: init, with the error bit.
    let status = AlStatus::from_raw(0x0011);
    assert_eq!(
        (status.al_state(), status.error(), status.current()),
        (Some(AlState::Init), true, CommunicationState::Init)
    );
    assert_eq!(AlStatus::from_raw(0x0003).al_state(), Some(AlState::Bootstrap));
    assert_eq!(AlStatus::from_raw(0x0005).al_state(), None);
    // "Singole transizioni di comunicazione": operational is reached step by step, and bootstrap is left through init.
    let next = |from: AlState| match from.toward(AlState::Operational) {
        Step::Command(command) => command,
        other => panic!("{other:?}"),
    };
    assert_eq!(next(AlState::Init), AlCommand::RequestPreOperational);
    assert_eq!(next(AlState::PreOperational), AlCommand::RequestSafeOperational);
    assert_eq!(next(AlState::SafeOperational), AlCommand::RequestOperational);
    assert_eq!(next(AlState::Bootstrap), AlCommand::RequestInit);
    // Section 4.3.3.
    let known = [0x0000, 0x0011, 0x0017].map(AlStatusCode::from_raw);
    let named = [
        AlStatusCode::NoError,
        AlStatusCode::InvalidRequestedStateChange,
        AlStatusCode::InvalidSyncManagerConfiguration,
    ];
    assert_eq!(known, named);
    let row = codes::AlStatus::from_raw(0x0017).row().expect("a row");
    assert_eq!(row.name, "invalid sync manager configuration");
    assert_eq!(codes::Faults::from_raw(125), codes::Faults::SynchronizationLost);
}

/// The memory of the slave controller. A master reads and writes whole items, as the EtherCAT client does.
struct Memory(Vec<u8>);

impl Client for Memory {
    type Bus = Esc;
    type Error = LengthError;

    fn read(&mut self, memory: EscMemory, buffer: &mut [u8]) -> Result<usize, Error<LengthError>> {
        let mapped = &self.0[usize::from(memory.address)..][..usize::from(memory.length)];
        buffer.iter_mut().zip(mapped).for_each(|(to, from)| *to = *from);
        Ok(mapped.len())
    }

    fn write(&mut self, memory: EscMemory, data: &[u8]) -> Result<(), Error<LengthError>> {
        let length = usize::from(memory.length);
        if data.len() != length {
            return Err(Error::Client(LengthError::new(length, data.len())));
        }
        self.0[usize::from(memory.address)..][..length].copy_from_slice(data);
        Ok(())
    }
}

/// Items that a master only reads have a read-only type.
fn read_only<V: Value>(item: Item<V, Ro, OnEsc>) -> (u16, u16) {
    (item.location().esc.address, item.location().esc.length)
}

fn writable<V: Value>(item: Item<V, Rw, OnEsc>) -> (u16, u16) {
    (item.location().esc.address, item.location().esc.length)
}

/// Section 4.1, with the access rights of the master.
#[test]
fn registers_of_the_slave_controller() {
    let read = [
        read_only(objects::AL_STATUS),
        read_only(objects::AL_STATUS_CODE),
        read_only(objects::INTERRUPT_ENABLE),
        read_only(objects::PROC_IN_BUFFER),
        read_only(objects::MAILBOX_IN_BUFFER),
    ];
    assert_eq!(read, [(0x0130, 2), (0x0134, 2), (0x0204, 2), (0x1140, 64), (0x1C00, 512)]);
    let written = [
        writable(objects::AL_CONTROL),
        writable(objects::AL_EVENT_REQUEST),
        writable(objects::PROC_OUT_BUFFER),
        writable(objects::MAILBOX_OUT_BUFFER),
    ];
    assert_eq!(written, [(0x0120, 2), (0x0220, 2), (0x1100, 64), (0x1800, 512)]);
    let sync_managers = [
        objects::SYNC_MANAGER_0,
        objects::SYNC_MANAGER_1,
        objects::SYNC_MANAGER_2,
        objects::SYNC_MANAGER_3,
        objects::SYNC_MANAGER_4,
        objects::SYNC_MANAGER_5,
        objects::SYNC_MANAGER_6,
        objects::SYNC_MANAGER_7,
        objects::SYNC_MANAGER_8,
    ];
    for (item, address) in sync_managers.into_iter().zip((0x0800..).step_by(8)) {
        assert_eq!(writable(item), (address, 8), "{}", item.name());
    }
}

#[test]
fn the_memory_of_the_slave_controller_is_a_bus() {
    let mut drive = Akd::new(Memory(vec![0; 0x2000]));
    // Section 4.3.1, in both directions.
    let request = AlControl::new().with_al_command(AlCommand::RequestOperational).with_acknowledge(true);
    drive.al_control().write(request).expect("two bytes");
    assert_eq!(drive.client().0[0x0120..0x0122], [0x18, 0x00]);
    assert_eq!(drive.al_control().read(), Ok(request));
    // Sections 4.3.2 and 4.3.3, as the drive writes them.
    drive.client().0[0x0130..0x0136].copy_from_slice(&[0x12, 0x00, 0, 0, 0x11, 0x00]);
    let status = drive.al_status().read().expect("two bytes");
    assert_eq!((status.al_state(), status.error()), (Some(AlState::PreOperational), true));
    assert_eq!(drive.al_status_code().read(), Ok(AlStatusCode::InvalidRequestedStateChange));
    drive.client().0[0x0204..0x0206].copy_from_slice(&[0x20, 0x04]);
    let enabled = drive.interrupt_enable().read().expect("two bytes");
    assert!(enabled.eeprom_emulation() && enabled.sync_manager_2());
    drive.al_event_request().write(AlEventRequest::from_raw(0x0401)).expect("two bytes");
    assert_eq!(drive.client().0[0x0220..0x0222], [0x01, 0x04]);
    // A sync manager, and the mailbox of section 4.13.3.
    let process_data = [0x00, 0x11, 0x06, 0x00, 0x24, 0x00, 0x01, 0x00];
    drive.sync_manager_2().write(&process_data).expect("eight bytes");
    assert_eq!(drive.client().0[0x0810..0x0818], process_data);
    let mut buffer = [0; 512];
    assert_eq!(drive.sync_manager_2().read_into(&mut buffer), Ok(&process_data[..]));
    let mut mailbox = [0; 512];
    mailbox[..REQUEST.len()].copy_from_slice(&REQUEST);
    drive.mailbox_out_buffer().write(&mailbox).expect("the whole buffer");
    assert_eq!(drive.client().0[0x1800..0x1810], REQUEST);
    drive.client().0[0x1C00..0x1C10].copy_from_slice(&REPLY);
    let reply = drive.mailbox_in_buffer().read_into(&mut buffer).expect("the whole buffer");
    assert_eq!((reply.len(), &reply[..REPLY.len()]), (512, &REPLY[..]));
}

#[test]
fn events_of_the_slave_controller() {
    // Sections 4.2.1 and 4.2.2: bits of the second byte follow those of the first.
    let enable = InterruptEnable::new().with_eeprom_emulation(true).with_sync_manager_2(true);
    assert_eq!(enable.raw(), 0x0420);
    let request = AlEventRequest::from_raw(0x0801);
    assert!(request.al_control_event() && request.sync_manager_3() && !request.sync_manager_2());
}

#[test]
fn states_and_commands_of_the_drive() {
    // "Stati della macchina di stato".
    let states = [
        (0x0000, DriveState::NotReadyToSwitchOn),
        (0x0040, DriveState::SwitchOnDisabled),
        (0x0021, DriveState::ReadyToSwitchOn),
        (0x0023, DriveState::SwitchedOn),
        (0x0027, DriveState::OperationEnabled),
        (0x0008, DriveState::Fault),
        (0x000F, DriveState::FaultReactionActive),
        (0x0007, DriveState::QuickStopActive),
    ];
    for (raw, state) in states {
        assert_eq!(StatusWord::from_raw(raw | 0x0200).drive_state(), Some(state), "{raw:#06x}");
    }
    let decoded = (0..64u16).filter(|bits| {
        let raw = bits & 0x0F | (bits & 0x30) << 1;
        StatusWord::from_raw(raw).drive_state().is_some()
    });
    assert_eq!(decoded.count(), 12, "of the 64 combinations of the six bits");
    // "Comandi nella parola di controllo".
    let word = |command| ControlWord::from_raw(0).with_drive_command(command).raw();
    assert_eq!((word(DriveCommand::Shutdown), word(DriveCommand::SwitchOn)), (0x06, 0x07));
    assert_eq!((word(DriveCommand::QuickStop), word(DriveCommand::DisableVoltage)), (0x02, 0x00));
    assert_eq!((word(DriveCommand::EnableOperation), word(DriveCommand::FaultReset)), (0x0F, 0x80));
    let halted = ControlWord::from_raw(0x0100).with_drive_command(DriveCommand::EnableOperation);
    assert_eq!(halted.raw(), 0x010F, "a command does not change other bits");
    assert_eq!(DriveState::Fault.toward(DriveState::OperationEnabled), Step::Command(DriveCommand::FaultReset));
    // "Bit dipendenti dalla modalità nella parola di controllo": bits with a meaning in a single mode.
    let positioning = ControlWord::from_raw(0x000F).in_profile_position().with_new_set_point(true);
    assert_eq!(positioning.control_word().raw(), 0x001F);
    let modes = [1, 3, 4, 6, 7, 8].map(ModesOfOperation::from_raw);
    assert!(modes.iter().all(|mode| !matches!(mode, ModesOfOperation::Unknown(_))));
}

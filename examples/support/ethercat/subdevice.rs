//! The firmware of a SubDevice: state machine (ETG.1000.6 6.4), mailbox and process data.

use std::collections::VecDeque;

use lexibus::ethercat::{Device, SyncManagerPurpose};
use lexibus::{AbortCode, MappedEntry};

use super::coe::Server;
use super::controller::Controller;
use super::eeprom;
use super::objects::Dictionary;
use super::pdos::Pdos;

/// Values of AL control and AL status.
const INIT: u8 = 1;
const PRE_OP: u8 = 2;
const SAFE_OP: u8 = 4;
const OP: u8 = 8;

/// AL status codes for refused transitions (ETG.1000.6 table 11).
const INVALID_CHANGE: u16 = 0x0011;
const UNKNOWN_STATE: u16 = 0x0012;
const INVALID_MAILBOX: u16 = 0x0016;
const INVALID_OUTPUTS: u16 = 0x001D;
const INVALID_INPUTS: u16 = 0x001E;

/// Filter for the messages to the master, which simulates faults. The firmware calls the filter after each frame, with
/// its new message if there is one. The filter returns the messages to send now.
pub type Filter = Box<dyn FnMut(Option<Vec<u8>>) -> Vec<Vec<u8>>>;

/// A simulated SubDevice.
pub struct SubDevice {
    pub(super) controller: Controller,
    device: &'static Device,
    objects: Box<dyn Dictionary>,
    pdos: Pdos,
    server: Server,
    /// Messages to the master that wait for an empty mailbox.
    messages: VecDeque<Vec<u8>>,
    filter: Option<Filter>,
    state: u8,
}

impl SubDevice {
    /// Creates a device after power-on. `objects` contains its objects except the PDO configuration objects.
    pub fn new(device: &'static Device, objects: impl Dictionary + 'static) -> Self {
        Self {
            controller: Controller::new(eeprom::of(device)),
            device,
            objects: Box::new(objects),
            pdos: Pdos::new(device),
            server: Server::default(),
            messages: VecDeque::new(),
            filter: None,
            state: INIT,
        }
    }

    /// Returns the device with another content of its EEPROM.
    #[allow(dead_code)]
    pub fn with_eeprom(mut self, eeprom: Vec<u8>) -> Self {
        self.controller = Controller::new(eeprom);
        self
    }

    /// Returns the device with a filter for its messages.
    #[allow(dead_code)]
    pub fn with_filter(self, filter: Filter) -> Self {
        Self { filter: Some(filter), ..self }
    }

    /// Runs the firmware once between two frames.
    pub(super) fn run(&mut self) {
        self.controller.tick();
        if let Some(request) = self.controller.request.take() {
            self.change_state(request);
        }
        if self.state != INIT {
            self.serve_mailbox();
        }
        if std::mem::take(&mut self.controller.exchanged) {
            self.exchange();
        }
    }

    fn change_state(&mut self, request: u8) {
        let code = match (self.state, request & 0x0F) {
            (_, INIT) => 0,
            (INIT, PRE_OP) => self.check_mailbox(),
            (PRE_OP, SAFE_OP) => self.check_process_data(),
            (PRE_OP | SAFE_OP | OP, PRE_OP) | (SAFE_OP | OP, SAFE_OP) | (SAFE_OP | OP, OP) => 0,
            (_, PRE_OP | SAFE_OP | OP) => INVALID_CHANGE,
            _ => UNKNOWN_STATE,
        };
        if code == 0 {
            self.state = request & 0x0F;
        }
        self.controller.show_state(self.state, code);
        if matches!(self.state, SAFE_OP | OP) {
            self.exchange();
        }
    }

    /// Checks the settings of the mailboxes against the device description. Returns an AL status code, or 0.
    fn check_mailbox(&self) -> u16 {
        let purposes = [SyncManagerPurpose::MailboxOut, SyncManagerPurpose::MailboxIn];
        let mut mailboxes = self.device.sync_managers.iter().filter(|manager| purposes.contains(&manager.purpose));
        let is_right = mailboxes.all(|manager| {
            let set = self.controller.manager(manager.number);
            let sizes = manager.min_size.unwrap_or(1)..=manager.max_size.unwrap_or(u16::MAX);
            set.enabled
                && set.range.start == usize::from(manager.start_address)
                && sizes.contains(&(set.range.len() as u16))
        });
        if is_right {
            0
        } else {
            INVALID_MAILBOX
        }
    }

    /// Checks the lengths of the sync managers against the assigned PDOs. Returns an AL status code, or 0.
    fn check_process_data(&self) -> u16 {
        let wrong = self.device.sync_managers.iter().filter(|manager| manager.carries_data()).find(|manager| {
            let set = self.controller.manager(manager.number);
            let bytes = self.pdos.bytes(manager.number);
            set.range.len() != bytes || set.enabled != (bytes > 0)
        });
        match wrong.map(|manager| manager.purpose) {
            None => 0,
            Some(SyncManagerPurpose::Outputs) => INVALID_OUTPUTS,
            Some(_) => INVALID_INPUTS,
        }
    }

    fn serve_mailbox(&mut self) {
        let number = |purpose| {
            self.device.sync_managers.iter().find(|manager| manager.purpose == purpose).map(|manager| manager.number)
        };
        let (out, back) = (number(SyncManagerPurpose::MailboxOut), number(SyncManagerPurpose::MailboxIn));
        let (Some(out), Some(back)) = (out, back) else { return };
        let back = self.controller.manager(back);
        let request = self.controller.take(&self.controller.manager(out));
        let answer = request.and_then(|message| {
            let mut objects =
                Objects { is_pre_op: self.state == PRE_OP, pdos: &mut self.pdos, dictionary: &mut *self.objects };
            self.server.answer(&message, back.range.len(), &mut objects)
        });
        for emergency in self.objects.emergencies() {
            self.messages.push_back(self.server.emergency(emergency));
        }
        match &mut self.filter {
            Some(filter) => self.messages.extend(filter(answer)),
            None => self.messages.extend(answer),
        }
        if let Some(message) = self.messages.pop_front() {
            if !self.controller.put(&back, &message) {
                self.messages.push_front(message);
            }
        }
    }

    /// Passes outputs to the application and gets its inputs.
    fn exchange(&mut self) {
        if !matches!(self.state, SAFE_OP | OP) {
            return;
        }
        let of = |purpose| self.device.sync_managers.iter().filter(move |manager| manager.purpose == purpose);
        if self.state == OP {
            for manager in of(SyncManagerPurpose::Outputs) {
                let data = self.controller.load(&self.controller.manager(manager.number));
                self.pdos.scatter(manager.number, &data, &mut *self.objects);
            }
        }
        self.objects.cycle(self.state == OP);
        for manager in of(SyncManagerPurpose::Inputs) {
            let data = self.pdos.gather(manager.number, &mut *self.objects);
            let set = self.controller.manager(manager.number);
            self.controller.store(&set, &data);
        }
    }
}

/// All objects of a device, including the PDO configuration objects.
struct Objects<'d> {
    pdos: &'d mut Pdos,
    dictionary: &'d mut dyn Dictionary,
    is_pre_op: bool,
}

impl Dictionary for Objects<'_> {
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32> {
        if self.pdos.has(index) {
            self.pdos.read(index, sub_index)
        } else {
            self.dictionary.read(index, sub_index)
        }
    }

    fn write(&mut self, index: u16, sub_index: u8, data: &[u8]) -> Result<(), u32> {
        if !self.pdos.has(index) {
            return self.dictionary.write(index, sub_index, data);
        }
        if !self.is_pre_op {
            return Err(AbortCode::DEVICE_STATE.0);
        }
        // An index of 0 means a gap.
        let exists =
            |entry: MappedEntry| entry.index == 0 || self.dictionary.read(entry.index, entry.sub_index).is_ok();
        self.pdos.write(index, sub_index, data, exists)
    }
}

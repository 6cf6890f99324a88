//! The slave controller: 64 KiB of memory, of which 4 KiB are registers (ETG.1000.4 6).

use std::ops::Range;

/// Register addresses.
const STATION: usize = 0x0010;
const AL_CONTROL: usize = 0x0120;
const AL_STATUS: usize = 0x0130;
const AL_CODE: usize = 0x0134;
const EEPROM_CONTROL: usize = 0x0502;
const EEPROM_ADDRESS: usize = 0x0504;
const EEPROM_DATA: usize = 0x0508;
const FMMUS: usize = 0x0600;
const MANAGERS: usize = 0x0800;
const PORT_TIMES: usize = 0x0900;
const SYSTEM_TIME: usize = 0x0910;
const RECEIVE_TIME: usize = 0x0918;

/// Status bit of a mailbox sync manager. The bit is set if the mailbox is full.
const FULL: u8 = 0x08;

/// Bit in the activate register to request the repetition of a message, and in the PDI control register to acknowledge
/// it.
const REPEAT: u8 = 0x02;

/// Times in ns that a frame needs for the whole segment, and from one SubDevice to the next.
const FRAME: u64 = 10_000;
const HOP: u64 = 500;

/// Settings of a sync manager.
pub struct Manager {
    pub range: Range<usize>,
    pub enabled: bool,
    is_mailbox: bool,
    to_device: bool,
    state: usize,
}

/// A slave controller.
pub struct Controller {
    memory: Vec<u8>,
    eeprom: Vec<u8>,
    time: u64,
    position: u64,
    count: u64,
    /// The last value written to AL control if the firmware has not yet processed it.
    pub request: Option<u8>,
    /// True if process data have been exchanged since the last run of the firmware.
    pub exchanged: bool,
    /// The last message that the master read from the mailbox.
    last: Vec<u8>,
}

impl Controller {
    pub fn new(eeprom: Vec<u8>) -> Self {
        let mut memory = vec![0; 0x1_0000];
        // Type, revision and build; 8 FMMUs, 8 sync managers and 8 KiB of memory; two Ethernet ports; 64-bit clocks.
        memory[..10].copy_from_slice(&[0x11, 0, 1, 0, 8, 8, 8, 0x0F, 0x0C, 0]);
        memory[AL_STATUS] = 1;
        Self { memory, eeprom, time: 0, position: 0, count: 1, request: None, exchanged: false, last: Vec::new() }
    }

    /// Sets the position in the segment. The position determines which ports have a link.
    pub fn connect(&mut self, position: usize, count: usize) {
        (self.position, self.count) = (position as u64, count as u64);
        let is_last = position + 1 == count;
        self.memory[0x0110] = if is_last { 0x11 } else { 0x31 };
    }

    pub fn station(&self) -> u16 {
        self.word(STATION)
    }

    /// Sets AL status to the state, its error flag, and the AL status code.
    pub fn show_state(&mut self, state: u8, code: u16) {
        self.memory[AL_STATUS] = if code == 0 { state } else { state | 0x10 };
        self.memory[AL_CODE..][..2].copy_from_slice(&code.to_le_bytes());
    }

    fn word(&self, at: usize) -> u16 {
        u16::from_le_bytes([self.memory[at], self.memory[at + 1]])
    }

    pub fn manager(&self, number: u8) -> Manager {
        let at = MANAGERS + 8 * usize::from(number);
        let start = usize::from(self.word(at));
        let control = self.memory[at + 4];
        Manager {
            range: start..start + usize::from(self.word(at + 2)),
            enabled: self.memory[at + 6] & 1 != 0,
            is_mailbox: control & 0x03 == 0x02,
            to_device: control & 0x0C == 0x04,
            state: at + 5,
        }
    }

    /// Returns the mailbox sync manager that contains the address.
    fn mailbox(&self, address: usize) -> Option<Manager> {
        (0..8)
            .map(|number| self.manager(number))
            .find(|manager| manager.enabled && manager.is_mailbox && manager.range.contains(&address))
    }

    /// Handles a read by the master. Returns `None` if the working counter is not incremented.
    pub fn read(&mut self, address: u16, length: usize) -> Option<Vec<u8>> {
        let range = usize::from(address)..usize::from(address) + length;
        if range.contains(&SYSTEM_TIME) {
            let time = self.time + self.position * HOP;
            self.memory[SYSTEM_TIME..][..8].copy_from_slice(&time.to_le_bytes());
        }
        if let Some(mailbox) = self.mailbox(range.start) {
            if mailbox.to_device || self.memory[mailbox.state] & FULL == 0 || range.end > mailbox.range.end {
                return None;
            }
            if range.end == mailbox.range.end {
                self.memory[mailbox.state] &= !FULL;
                self.last = self.load(&mailbox);
            }
        }
        self.memory.get(range).map(<[u8]>::to_vec)
    }

    /// Handles a write by the master. Returns `false` if the working counter is not incremented.
    pub fn write(&mut self, address: u16, data: &[u8]) -> bool {
        let range = usize::from(address)..usize::from(address) + data.len();
        if range.end > self.memory.len() {
            return false;
        }
        if let Some(mailbox) = self.mailbox(range.start) {
            if !mailbox.to_device || self.memory[mailbox.state] & FULL != 0 || range.end > mailbox.range.end {
                return false;
            }
            if range.end == mailbox.range.end {
                self.memory[mailbox.state] |= FULL;
            }
        }
        for (at, byte) in range.clone().zip(data) {
            if is_writable(at) {
                self.memory[at] = *byte;
            }
        }
        self.written(&range);
        true
    }

    /// Executes the side effects of a write to registers.
    fn written(&mut self, range: &Range<usize>) {
        if range.contains(&AL_CONTROL) {
            self.request = Some(self.memory[AL_CONTROL]);
        }
        if range.contains(&(EEPROM_CONTROL + 1)) {
            self.run_eeprom();
        }
        if range.contains(&PORT_TIMES) {
            self.latch();
        }
        for number in 0..8 {
            let manager = self.manager(number);
            if !range.contains(&(manager.state + 1)) {
                continue;
            }
            if (self.memory[manager.state + 1] ^ self.memory[manager.state + 2]) & REPEAT != 0 {
                let message = std::mem::take(&mut self.last);
                self.put(&manager, &message);
                self.memory[manager.state + 2] ^= REPEAT;
            } else {
                // Reconfiguring a sync manager clears its buffer.
                self.memory[manager.state] = 0;
            }
        }
    }

    /// Executes an EEPROM command without delay.
    fn run_eeprom(&mut self) {
        let at = 2 * usize::from(self.word(EEPROM_ADDRESS));
        if self.memory[EEPROM_CONTROL + 1] & 0x01 != 0 {
            // Words beyond the end of the EEPROM read as ones.
            let bytes = (at..at + 4).map(|at| self.eeprom.get(at).copied().unwrap_or(0xFF));
            self.memory[EEPROM_DATA..][..4].iter_mut().zip(bytes).for_each(|(to, from)| *to = from);
        }
        self.memory[EEPROM_CONTROL..][..2].fill(0);
    }

    /// Latches the receive times of the ports for both directions of a frame.
    fn latch(&mut self) {
        let out = self.time + self.position * HOP;
        let back = self.time + (2 * self.count - self.position) * HOP;
        for (port, time) in [out, back, 0, 0].into_iter().enumerate() {
            self.memory[PORT_TIMES + 4 * port..][..4].copy_from_slice(&(time as u32).to_le_bytes());
        }
        self.memory[RECEIVE_TIME..][..8].copy_from_slice(&out.to_le_bytes());
    }

    /// Handles data with a logical address. FMMUs map such data to memory. Returns the increment of the working
    /// counter.
    pub fn logical(&mut self, address: u32, data: &mut [u8], reads: bool, writes: bool) -> u16 {
        let (mut read, mut written) = (false, false);
        let sent = data.to_vec();
        for at in (FMMUS..).step_by(16).take(8) {
            let fmmu = Fmmu::of(&self.memory[at..at + 16]);
            for (offset, byte) in data.iter_mut().enumerate() {
                let Some(place) = fmmu.place(address.wrapping_add(offset as u32)) else { continue };
                if reads && fmmu.read {
                    *byte = self.memory[place];
                    read = true;
                }
                if writes && fmmu.write {
                    self.memory[place] = sent[offset];
                    written = true;
                }
            }
        }
        self.exchanged |= read || written;
        let counts_twice = reads && writes;
        u16::from(read) + u16::from(written) * if counts_twice { 2 } else { 1 }
    }

    /// Removes a message of the master from a mailbox and returns it.
    pub fn take(&mut self, manager: &Manager) -> Option<Vec<u8>> {
        let full = manager.enabled && self.memory[manager.state] & FULL != 0;
        full.then(|| {
            self.memory[manager.state] &= !FULL;
            self.memory[manager.range.clone()].to_vec()
        })
    }

    /// Writes a message to a mailbox. Returns `false` if the mailbox is full.
    pub fn put(&mut self, manager: &Manager, message: &[u8]) -> bool {
        let free = manager.enabled && self.memory[manager.state] & FULL == 0;
        if free {
            self.store(manager, message);
            self.memory[manager.state] |= FULL;
        }
        free
    }

    /// Returns the data in the memory of a sync manager.
    pub fn load(&self, manager: &Manager) -> Vec<u8> {
        self.memory[manager.range.clone()].to_vec()
    }

    pub fn store(&mut self, manager: &Manager, data: &[u8]) {
        let room = &mut self.memory[manager.range.clone()];
        let bytes = data.iter().copied().chain(std::iter::repeat(0));
        room.iter_mut().zip(bytes).for_each(|(to, from)| *to = from);
    }

    /// Advances the time by one frame.
    pub fn tick(&mut self) {
        self.time += FRAME;
    }
}

/// Returns whether the master can write a register.
fn is_writable(at: usize) -> bool {
    let is_state = (MANAGERS..MANAGERS + 0x80).contains(&at) && at % 8 == 5;
    !matches!(at, 0..=0x0F | 0x0110..=0x011F | 0x0130..=0x013F | 0x0900..=0x091F) && !is_state
}

/// A fieldbus memory management unit (FMMU). This FMMU supports only whole bytes.
struct Fmmu {
    logical: u32,
    length: u32,
    physical: usize,
    read: bool,
    write: bool,
}

impl Fmmu {
    fn of(registers: &[u8]) -> Self {
        let word = |at: usize| u16::from_le_bytes([registers[at], registers[at + 1]]);
        let enabled = registers[12] & 1 != 0;
        Self {
            logical: u32::from(word(0)) | u32::from(word(2)) << 16,
            length: if enabled { u32::from(word(4)) } else { 0 },
            physical: usize::from(word(8)),
            read: registers[11] & 1 != 0,
            write: registers[11] & 2 != 0,
        }
    }

    fn place(&self, address: u32) -> Option<usize> {
        let offset = address.checked_sub(self.logical).filter(|offset| *offset < self.length)?;
        Some((self.physical + offset as usize) & 0xFFFF)
    }
}

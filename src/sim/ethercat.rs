//! Frames of an EtherCAT segment with faults (ETG.1000.4 5.3, 5.4).

use core::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::faults::Faults;

/// Lengths in bytes of the headers of a frame (Ethernet and EtherCAT), and of the header and the working counter of a
/// datagram.
const HEADERS: usize = 16;
const DATAGRAM: usize = 10;
const COUNTER: usize = 2;

/// Commands of datagrams: physical reads by position, station address and broadcast, and the first and last logical
/// command.
const APRD: u8 = 1;
const FPRD: u8 = 4;
const BRD: u8 = 7;
const LRD: u8 = 10;
const LRW: u8 = 12;

/// Register AL status, and the first address after the registers.
const AL_STATUS: u16 = 0x0130;
const MEMORY: u16 = 0x1000;

/// A fault of a datagram on its way back to the master. [`FaultyFrames`] injects the fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum EtherCatFault {
    /// The frame with the datagram is lost.
    LostFrame,
    /// The reply in a mailbox is lost: the SubDevice has sent it, but the datagram arrives with the working counter 0,
    /// and all data bytes are 0.
    LostReply,
    /// The working counter is lower by this number, because SubDevices did not process the datagram. In an LRW
    /// datagram, a SubDevice adds 1 for its inputs and 2 for its outputs.
    WorkingCounter(u16),
    /// AL status contains this value (ETG.1000.6 6.4). For example, 0x14 is Safe-Operational with the error flag: the
    /// SubDevice has left Operational because of an error.
    State(u8),
}

impl EtherCatFault {
    /// Returns whether the fault can affect a datagram.
    fn concerns(&self, datagram: &Datagram) -> bool {
        match self {
            Self::LostFrame => true,
            Self::LostReply => datagram.is_mailbox_read(),
            Self::WorkingCounter(_) => datagram.is_process_data(),
            Self::State(_) => datagram.reads_state(),
        }
    }

    /// Changes a datagram. Returns whether it arrives.
    fn apply(self, datagram: &Datagram, data: &mut [u8], counter: &mut [u8]) -> bool {
        match self {
            Self::LostFrame => return false,
            Self::LostReply => {
                data.fill(0);
                counter.fill(0);
            }
            Self::WorkingCounter(lower) => {
                let lower = datagram.working_counter.saturating_sub(lower).to_le_bytes();
                counter.iter_mut().zip(lower).for_each(|(to, from)| *to = from);
            }
            Self::State(state) => {
                let at = AL_STATUS.wrapping_sub(datagram.address);
                if let Some(status) = data.get_mut(usize::from(at)).filter(|_| datagram.reads_state()) {
                    *status = state;
                }
            }
        }
        true
    }
}

/// A datagram that returns to the master.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Datagram {
    /// Command, for example 4 for FPRD, and 12 for LRW (ETG.1000.4 5.4.1).
    pub command: u8,
    /// Station address or position of the SubDevice. For logical commands, the low 16 bits of the address.
    pub station: u16,
    /// Address in the memory of the SubDevice. For logical commands, the high 16 bits of the address.
    pub address: u16,
    /// Length of the data in bytes.
    pub length: u16,
    /// Working counter.
    pub working_counter: u16,
}

impl Datagram {
    /// Returns whether the datagram contains process data: LRD, LWR or LRW.
    #[must_use]
    pub const fn is_process_data(&self) -> bool {
        matches!(self.command, LRD..=LRW)
    }

    /// Returns whether the datagram has read a mailbox: an FPRD command with an address after the registers and a
    /// working counter above 0.
    #[must_use]
    pub const fn is_mailbox_read(&self) -> bool {
        self.command == FPRD && self.address >= MEMORY && self.working_counter > 0
    }

    /// Returns whether the datagram has read AL status.
    #[must_use]
    pub const fn reads_state(&self) -> bool {
        let is_read = matches!(self.command, APRD | FPRD | BRD) && self.working_counter > 0;
        is_read && self.address <= AL_STATUS && AL_STATUS - self.address < self.length
    }
}

/// Faults that are injected into the frames of an EtherCAT segment, for tests of masters and of drivers that use them.
///
/// The faults apply to Ethernet frames that return to the master, in a simulated segment, or between a master and a real
/// segment. Pass each frame to [`apply`](Self::apply). A clone is a handle to the same faults, so that a test can inject
/// faults while the master runs.
///
/// ```
/// use lexibus::sim::{EtherCatFault, FaultyFrames};
///
/// // An LRW datagram with two bytes. Both SubDevices have processed it.
/// let mut frame = [0; 60];
/// frame[12..16].copy_from_slice(&[0x88, 0xA4, 14, 0x10]);
/// frame[16] = 12;
/// frame[22] = 2;
/// frame[28] = 6;
///
/// let faults = FaultyFrames::new();
/// faults.inject_nth(EtherCatFault::WorkingCounter(3), 2);
/// assert!(faults.apply(&mut frame));
/// assert_eq!(frame[28], 6);
/// assert!(faults.apply(&mut frame));
/// assert_eq!(frame[28], 3);
/// ```
#[derive(Clone, Default)]
pub struct FaultyFrames {
    faults: Arc<Mutex<Faults<EtherCatFault, Datagram>>>,
}

impl fmt::Debug for FaultyFrames {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FaultyFrames").field("faults", &*self.lock()).finish()
    }
}

impl FaultyFrames {
    /// Creates a segment without faults.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    fn lock(&self) -> MutexGuard<'_, Faults<EtherCatFault, Datagram>> {
        self.faults.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Injects a fault into the `n`th datagram from now on that the fault can affect: 1 is the next one.
    /// [`LostReply`](EtherCatFault::LostReply) affects mailbox reads, [`State`](EtherCatFault::State) affects reads of
    /// AL status, [`WorkingCounter`](EtherCatFault::WorkingCounter) affects process data, and
    /// [`LostFrame`](EtherCatFault::LostFrame) affects any datagram.
    pub fn inject_nth(&self, fault: EtherCatFault, n: u64) {
        self.lock().add_nth_of(fault, n, EtherCatFault::concerns);
    }

    /// Injects a fault into each datagram that `selects` accepts, until [`clear_faults`](Self::clear_faults). If several
    /// faults affect a datagram, the first one that was injected applies.
    pub fn inject(&self, fault: EtherCatFault, selects: impl FnMut(&Datagram) -> bool + Send + 'static) {
        self.lock().add(fault, selects);
    }

    /// Removes all faults.
    pub fn clear_faults(&self) {
        self.lock().clear();
    }

    /// Changes a frame that returns from the segment. Returns false if the frame is lost. Frames of other protocols
    /// stay unchanged.
    pub fn apply(&self, frame: &mut [u8]) -> bool {
        let is_ethercat = frame.get(12..14) == Some(&[0x88, 0xA4]);
        let mut rest = frame.get_mut(HEADERS..).filter(|_| is_ethercat).unwrap_or_default();
        let mut faults = self.lock();
        while let Some((datagram, data, counter, next)) = split(rest) {
            if let Some(fault) = faults.next(&datagram) {
                if !fault.apply(&datagram, data, counter) {
                    return false;
                }
            }
            rest = next;
        }
        true
    }
}

/// A datagram, its data, its working counter, and the following datagrams.
type Split<'b> = (Datagram, &'b mut [u8], &'b mut [u8], &'b mut [u8]);

/// Splits the first datagram from the following ones.
fn split(bytes: &mut [u8]) -> Option<Split<'_>> {
    let (head, rest) = bytes.split_first_chunk_mut::<DATAGRAM>()?;
    let [command, _, station_low, station_high, address_low, address_high, length_low, length_high, ..] = *head;
    let length = u16::from_le_bytes([length_low, length_high]);
    let has_next = length & 0x8000 != 0;
    let length = length & 0x07FF;
    let (data, rest) = rest.split_at_mut_checked(length.into())?;
    let (counter, next) = rest.split_at_mut_checked(COUNTER)?;
    let datagram = Datagram {
        command,
        station: u16::from_le_bytes([station_low, station_high]),
        address: u16::from_le_bytes([address_low, address_high]),
        length,
        working_counter: u16::from_le_bytes(counter.try_into().ok()?),
    };
    Some((datagram, data, counter, if has_next { next } else { &mut [] }))
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;

    /// Returns a frame with these datagrams: command, station, address, data and working counter.
    fn frame(datagrams: &[(u8, u16, u16, &[u8], u16)]) -> Vec<u8> {
        let mut bytes = std::vec![0; 12];
        bytes.extend([0x88, 0xA4, 0, 0x10]);
        for (at, (command, station, address, data, counter)) in datagrams.iter().enumerate() {
            let next = if at + 1 < datagrams.len() { 0x8000 } else { 0 };
            bytes.extend([*command, at as u8]);
            for word in [*station, *address, data.len() as u16 | next, 0] {
                bytes.extend(word.to_le_bytes());
            }
            bytes.extend(*data);
            bytes.extend(counter.to_le_bytes());
        }
        // Padding to the minimum length of an Ethernet frame.
        bytes.resize(bytes.len().max(60), 0);
        bytes
    }

    #[test]
    fn each_fault_affects_its_datagrams() {
        let all = |reply: &[u8], counter, state, process| {
            frame(&[
                (FPRD, 0x1000, 0x0805, &[8], 1),
                (FPRD, 0x1000, 0x1080, reply, counter),
                (FPRD, 0x1001, AL_STATUS, &[state, 0], 1),
                (LRW, 0, 0, &[1, 2, 3, 4], process),
            ])
        };
        let good = all(&[1, 2, 3], 1, 8, 6);
        for (fault, expected) in [
            (EtherCatFault::LostReply, all(&[0, 0, 0], 0, 8, 6)),
            (EtherCatFault::WorkingCounter(1), all(&[1, 2, 3], 1, 8, 5)),
            (EtherCatFault::State(0x14), all(&[1, 2, 3], 1, 0x14, 6)),
        ] {
            let faults = FaultyFrames::new();
            faults.inject_nth(fault, 1);
            let mut bytes = good.clone();
            assert!(faults.apply(&mut bytes));
            assert_eq!(bytes, expected, "{fault:?}");
            assert!(faults.apply(&mut bytes) && bytes == expected, "only once");
        }
        let faults = FaultyFrames::new();
        faults.inject_nth(EtherCatFault::LostFrame, 5);
        assert!(faults.apply(&mut good.clone()) && !faults.apply(&mut good.clone()));
    }

    #[test]
    fn selected_datagrams_and_other_frames() {
        let faults = FaultyFrames::new();
        faults.inject(EtherCatFault::State(0x12), |datagram| datagram.station == 0x1001);
        let good = frame(&[(FPRD, 0x1000, AL_STATUS, &[8], 1), (FPRD, 0x1001, 0x012E, &[0, 0, 8], 1)]);
        for _ in 0..3 {
            let mut bytes = good.clone();
            assert!(faults.apply(&mut bytes));
            assert_eq!((bytes[26], bytes[41]), (8, 0x12));
        }
        faults.clear_faults();
        faults.inject(EtherCatFault::LostFrame, |_| true);
        let mut other = std::vec![0; 60];
        assert!(faults.apply(&mut other) && faults.apply(&mut []));
        assert!(!faults.apply(&mut good.clone()));
        // A datagram that is cut off has no fault.
        assert!(faults.apply(&mut good.clone()[..20]));
    }
}

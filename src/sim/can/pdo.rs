//! PDO communication of a node (CiA 301 7.2.2.2 and 7.5.2.35 to 7.5.2.38).

use core::ops::RangeInclusive;
use core::time::Duration;
use std::collections::BTreeMap;
use std::vec::Vec;

use super::super::device::Device;
use super::super::process;
use crate::abort::AbortCode;
use crate::clients::canopen::CanFrame;
use crate::pdo::can_id;

/// Indices of the communication parameters of RPDOs and TPDOs.
const RECEIVED: RangeInclusive<u16> = 0x1400..=0x15FF;
const TRANSMITTED: RangeInclusive<u16> = 0x1800..=0x19FF;
/// Difference between the index of the mapping and the index of the communication parameters.
const MAPPING: u16 = 0x200;
/// Minimum transmission type of PDOs that are sent on change or by timer.
const EVENT: u64 = 254;
/// Maximum transmission type of synchronous PDOs.
const SYNCHRONOUS: u64 = 240;

/// Error codes of emergency messages for received PDOs (CiA 301 7.2.7.1). The node doesn't process a PDO that is too
/// short, but processes a PDO that is too long.
const TOO_SHORT: u16 = 0x8210;
const TOO_LONG: u16 = 0x8220;
/// Error register bits: generic error and communication error.
const COMMUNICATION_ERROR: u8 = 1 | 1 << 4;

/// Sub-index of the SYNC start value.
const SYNC_START: u8 = 6;

/// PDO state of a node in Operational. The maps are keyed by the index of the communication parameters.
#[derive(Clone, Debug, Default)]
pub(super) struct Pdos {
    sent: BTreeMap<u16, Sent>,
    /// Received synchronous PDOs that are applied at the next SYNC.
    waiting: BTreeMap<u16, Vec<u8>>,
}

/// The last transmission of a PDO.
#[derive(Clone, Debug, Default)]
struct Sent {
    data: Vec<u8>,
    at: Option<Duration>,
    /// Number of SYNC messages since the transmission.
    syncs: u64,
    /// True if SYNC messages count: the message with the SYNC start value was received, or no start value applies.
    is_started: bool,
}

/// Communication parameters of a PDO.
#[derive(Clone, Copy)]
struct Communication {
    index: u16,
    id: u32,
    kind: u64,
    inhibit: Duration,
    timer: Duration,
    /// SYNC start value, or 0.
    start: u64,
}

impl Communication {
    /// Returns the communication parameters, or `None` if the PDO doesn't exist or is disabled.
    fn of(device: &Device, index: u16) -> Option<Self> {
        let number = |sub| device.slots.number(index, sub);
        let cob_id = number(1).filter(|_| device.is_used(index))?;
        Some(Self {
            index,
            id: can_id(cob_id as u32)?,
            kind: number(2).unwrap_or(EVENT),
            inhibit: Duration::from_micros(100 * number(3).unwrap_or(0)),
            timer: Duration::from_millis(number(5).unwrap_or(0)),
            start: number(SYNC_START).unwrap_or(0),
        })
    }

    /// Returns the communication parameters of all enabled PDOs.
    fn all(device: &Device, indices: RangeInclusive<u16>) -> Vec<Self> {
        let cob_ids = device.slots.objects(*indices.start(), *indices.end()).filter(|object| object.sub_index == 1);
        cob_ids.filter_map(|object| Self::of(device, object.index)).collect()
    }

    /// Returns the current data of the PDO. Returns `None` if the mapping is empty or contains an object that the
    /// device doesn't have.
    fn data(&self, device: &Device) -> Option<Vec<u8>> {
        device.transmit_pdo(self.index + MAPPING).ok().filter(|data| !data.is_empty())
    }
}

impl Pdos {
    /// Returns the time at which the next event timer or inhibit time ends.
    pub fn next_event(&self, device: &Device) -> Option<Duration> {
        let events = Communication::all(device, TRANSMITTED).into_iter().filter(|pdo| pdo.kind >= EVENT);
        let times = events.filter_map(|pdo| {
            let sent = self.sent.get(&pdo.index)?;
            let at = sent.at?;
            let is_changed = pdo.data(device).is_some_and(|data| data != sent.data);
            let inhibited = is_changed.then_some(at + pdo.inhibit);
            let timer = (!pdo.timer.is_zero()).then(|| at + pdo.timer.max(pdo.inhibit));
            inhibited.into_iter().chain(timer).min()
        });
        times.min()
    }

    /// Returns the PDOs to send because their data changed or their event timer expired. The first call in Operational
    /// returns all event-driven PDOs.
    pub fn changed(&mut self, device: &Device, now: Duration) -> Vec<CanFrame> {
        // A PDO that is enabled again starts like a new PDO.
        self.sent.retain(|index, _| device.is_used(*index));
        self.waiting.retain(|index, _| device.is_used(*index));
        let events = Communication::all(device, TRANSMITTED).into_iter().filter(|pdo| pdo.kind >= EVENT);
        events.filter_map(|pdo| self.send_event(device, &pdo, now)).collect()
    }

    fn send_event(&mut self, device: &Device, pdo: &Communication, now: Duration) -> Option<CanFrame> {
        let data = pdo.data(device)?;
        let sent = self.sent.entry(pdo.index).or_default();
        let is_due = match sent.at {
            None => true,
            Some(at) if now < at + pdo.inhibit => false,
            Some(at) => data != sent.data || !pdo.timer.is_zero() && now >= at + pdo.timer,
        };
        is_due.then(|| sent.send(pdo.id, data, now))?
    }

    /// Returns the PDOs to send after SYNC: the cyclic PDOs that are due, and the acyclic PDOs whose data changed or
    /// that have not been sent yet.
    ///
    /// `counter` is the counter in the SYNC message. A cyclic PDO with a SYNC start value ignores SYNC messages until
    /// the counter equals the start value. The message with the start value is the first one that counts. The start
    /// value has no effect if the message has no counter.
    pub fn sampled(&mut self, device: &Device, now: Duration, counter: Option<u8>) -> Vec<CanFrame> {
        let synchronous = Communication::all(device, TRANSMITTED).into_iter().filter(|pdo| pdo.kind <= SYNCHRONOUS);
        let frames = synchronous.filter_map(|pdo| {
            let data = pdo.data(device)?;
            let sent = self.sent.entry(pdo.index).or_default();
            sent.is_started |= pdo.start == 0 || counter.map_or(true, |counter| u64::from(counter) == pdo.start);
            if pdo.kind > 0 && !sent.is_started {
                return None;
            }
            sent.syncs += 1;
            let is_due = match pdo.kind {
                0 => sent.at.is_none() || data != sent.data,
                every => sent.syncs >= every,
            };
            is_due.then(|| sent.send(pdo.id, data, now))?
        });
        frames.collect()
    }

    /// Processes a received PDO. A synchronous PDO is applied at the next SYNC. Returns the index of the mapping object
    /// and the abort code if the PDO is too short or the device refused a value.
    pub fn receive(&mut self, device: &mut Device, id: u32, data: &[u8]) -> Vec<(u16, AbortCode)> {
        let pdos = Communication::all(device, RECEIVED).into_iter().filter(|pdo| pdo.id == id);
        let mut refused = Vec::new();
        for pdo in pdos {
            if pdo.kind <= SYNCHRONOUS {
                self.waiting.insert(pdo.index, data.to_vec());
            } else {
                refused.extend(take(device, pdo.index, data));
            }
        }
        refused
    }

    /// Applies the received synchronous PDOs after SYNC.
    pub fn actuate(&mut self, device: &mut Device) -> Vec<(u16, AbortCode)> {
        let waiting = core::mem::take(&mut self.waiting);
        waiting.into_iter().filter_map(|(index, data)| take(device, index, &data)).collect()
    }
}

impl Sent {
    fn send(&mut self, id: u32, data: Vec<u8>, now: Duration) -> Option<CanFrame> {
        let frame = CanFrame::new(id, &data);
        *self = Self { data, at: Some(now), syncs: 0, is_started: self.is_started };
        frame
    }
}

/// Emits an emergency message with a communication error. The other bits of the error register (0x1001) are unchanged.
pub(super) fn emit_communication_error(device: &mut Device, code: u16) {
    let register = device.slots.number(0x1001, 0).unwrap_or(0) as u8 | COMMUNICATION_ERROR;
    device.emit_emergency(code, register, [0; 5]);
}

/// Writes the data of a PDO to the device. Emits an emergency message if the PDO is too short or too long. If the PDO
/// is too short or the device refuses a value, returns the index of the mapping object and the abort code.
fn take(device: &mut Device, index: u16, data: &[u8]) -> Option<(u16, AbortCode)> {
    let index = index + MAPPING;
    let mapping = device.mapping(index).ok().filter(|mapping| !mapping.is_empty())?;
    let length = process::length(process::width(&mapping));
    if data.len() != length {
        emit_communication_error(device, if data.len() < length { TOO_SHORT } else { TOO_LONG });
    }
    device.receive_mapped(&mapping, data).err().map(|code| (index, code))
}

//! Frames with their datagrams (ETG.1000.4 5.3, 5.4).

use std::future::poll_fn;
use std::task::Poll;

use ethercrab::error::Error;
use ethercrab::{PduRx, PduTx};
use lexibus::sim::FaultyFrames;

use super::controller::Controller;
use super::subdevice::SubDevice;

/// Lengths in bytes of the Ethernet header and the EtherCAT header.
const ETHERNET: usize = 14;
const HEADERS: usize = ETHERNET + 2;

/// Lengths in bytes of a datagram before its data and after its data.
const DATAGRAM: usize = 10;
const COUNTER: usize = 2;

/// A line of SubDevices.
pub struct Segment {
    subdevices: Vec<SubDevice>,
    faults: FaultyFrames,
}

impl Segment {
    /// Creates a segment. The SubDevices have the order in which frames reach them.
    pub fn new(mut subdevices: Vec<SubDevice>) -> Self {
        let count = subdevices.len();
        for (position, subdevice) in subdevices.iter_mut().enumerate() {
            subdevice.controller.connect(position, count);
        }
        Self { subdevices, faults: FaultyFrames::new() }
    }

    /// Returns the segment with faults of the frames that return to the master.
    pub fn with_faults(self, faults: FaultyFrames) -> Self {
        Self { faults, ..self }
    }

    /// Transfers frames between the master and the SubDevices until the master drops its frame storage. Run this
    /// function concurrently with the master.
    pub async fn run(&mut self, mut tx: PduTx<'_>, mut rx: PduRx<'_>) -> Result<(), Error> {
        poll_fn(|context| {
            tx.replace_waker(context.waker());
            while let Some(frame) = tx.next_sendable_frame() {
                let mut bytes = Vec::new();
                frame.send_blocking(|sent| {
                    bytes.extend_from_slice(sent);
                    Ok(sent.len())
                })?;
                self.pass(&mut bytes);
                if self.faults.apply(&mut bytes) {
                    rx.receive_frame(&bytes)?;
                }
            }
            if tx.should_exit() {
                Poll::Ready(Ok(()))
            } else {
                Poll::Pending
            }
        })
        .await
    }

    /// Passes a frame through all SubDevices.
    fn pass(&mut self, frame: &mut [u8]) {
        // The first SubDevice sets this bit of the source address, so that the master recognizes a frame that has
        // returned.
        frame[6] |= 0x02;
        let mut datagrams = frame.get_mut(HEADERS..).unwrap_or_default();
        while datagrams.len() >= DATAGRAM + COUNTER {
            let word = u16::from_le_bytes([datagrams[6], datagrams[7]]);
            let length = usize::from(word & 0x07FF);
            let Some((datagram, rest)) = datagrams.split_at_mut_checked(DATAGRAM + length + COUNTER) else { break };
            self.process(datagram);
            if word & 0x8000 == 0 {
                break;
            }
            datagrams = rest;
        }
        self.subdevices.iter_mut().for_each(SubDevice::run);
    }

    fn process(&mut self, datagram: &mut [u8]) {
        let (head, rest) = datagram.split_at_mut(DATAGRAM);
        let (data, counter) = rest.split_at_mut(rest.len() - COUNTER);
        let command = head[0];
        for subdevice in &mut self.subdevices {
            let added = match command {
                10..=12 => subdevice.controller.logical(address32(head), data, command != 11, command != 10),
                _ => physical(&mut subdevice.controller, command, head, data),
            };
            let count = u16::from_le_bytes([counter[0], counter[1]]).wrapping_add(added);
            counter.copy_from_slice(&count.to_le_bytes());
        }
    }
}

fn address32(head: &[u8]) -> u32 {
    u32::from_le_bytes([head[2], head[3], head[4], head[5]])
}

/// Handles a datagram with a position address, a station address, or a broadcast address. Returns the increment of the
/// working counter.
fn physical(controller: &mut Controller, command: u8, head: &mut [u8], data: &mut [u8]) -> u16 {
    let device = u16::from_le_bytes([head[2], head[3]]);
    let register = u16::from_le_bytes([head[4], head[5]]);
    let by_position = matches!(command, 1..=3 | 7..=9 | 13);
    if by_position {
        head[2..4].copy_from_slice(&device.wrapping_add(1).to_le_bytes());
    }
    let is_meant = if by_position { device == 0 } else { device == controller.station() };
    match command {
        1 | 4 if is_meant => read(controller, register, data),
        2 | 5 if is_meant => write(controller, register, data),
        3 | 6 if is_meant => read_write(controller, register, data),
        7 => read_or(controller, register, data),
        8 => write(controller, register, data),
        9 => {
            let sent = data.to_vec();
            read_or(controller, register, data) + 2 * write(controller, register, &sent)
        }
        // The addressed SubDevice reads; all others write.
        13 | 14 if is_meant => read(controller, register, data),
        13 | 14 => write(controller, register, data),
        _ => 0,
    }
}

fn read(controller: &mut Controller, register: u16, data: &mut [u8]) -> u16 {
    let Some(bytes) = controller.read(register, data.len()) else { return 0 };
    data.copy_from_slice(&bytes);
    1
}

/// Handles a broadcast read. The data of all SubDevices are combined with OR.
fn read_or(controller: &mut Controller, register: u16, data: &mut [u8]) -> u16 {
    let Some(bytes) = controller.read(register, data.len()) else { return 0 };
    data.iter_mut().zip(bytes).for_each(|(to, from)| *to |= from);
    1
}

fn write(controller: &mut Controller, register: u16, data: &[u8]) -> u16 {
    u16::from(controller.write(register, data))
}

fn read_write(controller: &mut Controller, register: u16, data: &mut [u8]) -> u16 {
    let sent = data.to_vec();
    read(controller, register, data) + 2 * write(controller, register, &sent)
}

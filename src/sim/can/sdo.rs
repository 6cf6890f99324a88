//! SDO server of a node (CiA 301 7.2.4), based on `canopen-sdo`.

use core::fmt;
use core::time::Duration;
use std::boxed::Box;

use canopen_sdo::{ObjectDictionary, SdoAbortCode, SdoFrame, SdoServer, ServerConfig};

use super::super::device::{Device, Network};
use super::super::fault::Fault;
use super::super::values;
use crate::bus::Object;
use crate::clients::canopen::CanFrame;
use crate::node_id::NodeId;

/// Maximum length of a value in a transfer, in bytes.
const MOST_BYTES: usize = 8192;

/// The default SDO channel: requests with COB-ID 0x600 + node-ID, replies with 0x580 + node-ID.
pub(super) struct Channel(Box<SdoServer<MOST_BYTES>>);

impl fmt::Debug for Channel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Channel").field("is_idle", &self.0.is_idle()).finish_non_exhaustive()
    }
}

/// Converts a time to nanoseconds for the SDO server.
fn nanoseconds(time: Duration) -> u64 {
    time.as_nanos().try_into().unwrap_or(u64::MAX)
}

impl Channel {
    pub fn new(node: NodeId) -> Self {
        Self(Box::new(SdoServer::new(ServerConfig::new(node.get()))))
    }

    /// Returns the time at which an unfinished transfer times out.
    pub fn deadline(&self) -> Option<Duration> {
        self.0.poll_timeout().map(Duration::from_nanos)
    }

    /// Aborts a transfer that has timed out, and returns the abort message.
    pub fn timed_out(&mut self, now: Duration) -> Option<CanFrame> {
        // The result is the abort code, which is also in the abort message.
        let _ = self.0.handle_timeout(nanoseconds(now));
        self.answer()
    }

    /// Processes a request and returns the reply.
    pub fn handle(&mut self, device: &mut Device, frame: &CanFrame, now: Duration) -> Option<CanFrame> {
        let mut data: [u8; 8] = frame.data().try_into().ok()?;
        tell_size(device, &mut data);
        let mut dictionary = Dictionary { device, is_lost: false };
        // The result is the abort code, which is also in the reply.
        let _ = self.0.handle_frame(SdoFrame::new(frame.id(), data), nanoseconds(now), &mut dictionary);
        let is_lost = dictionary.is_lost;
        self.answer().filter(|_| !is_lost)
    }

    fn answer(&mut self) -> Option<CanFrame> {
        let frame = self.0.poll_transmit()?;
        CanFrame::new(frame.cob_id, &frame.data)
    }
}

/// Adds the size to an expedited download that doesn't indicate its size. CiA 301 allows such downloads, but the server
/// of `canopen-sdo` needs the size.
fn tell_size(device: &Device, data: &mut [u8; 8]) {
    const EXPEDITED: u8 = 0x22;
    const WITH_SIZE: u8 = 0x23;
    if data[0] & 0xE3 != EXPEDITED {
        return;
    }
    let object = Object::new(u16::from_le_bytes([data[1], data[2]]), data[3]);
    let length =
        device.slots.of_object(object).ok().and_then(|at| values::byte_length(device.slots.get(at).entry.data_type));
    if let Some(length @ 1..=4) = length {
        data[0] = WITH_SIZE | (4 - length as u8) << 2;
    }
}

/// The simulated device as an object dictionary for the SDO server.
struct Dictionary<'d> {
    device: &'d mut Device,
    /// True if a simulated fault suppresses the reply.
    is_lost: bool,
}

impl Dictionary<'_> {
    fn refused(&mut self, fault: Fault) -> SdoAbortCode {
        self.is_lost |= fault == Fault::Bus;
        match fault {
            Fault::Abort(code) => code.0.into(),
            Fault::Bus | Fault::Exception(_) => SdoAbortCode::General,
        }
    }
}

impl ObjectDictionary for Dictionary<'_> {
    fn read(&mut self, index: u16, sub: u8, buf: &mut [u8]) -> Result<usize, SdoAbortCode> {
        match self.device.upload(Object::new(index, sub)) {
            Ok(value) => {
                buf.get_mut(..value.len()).ok_or(SdoAbortCode::OutOfMemory)?.copy_from_slice(value);
                Ok(value.len())
            }
            Err(fault) => Err(self.refused(fault)),
        }
    }

    fn write(&mut self, index: u16, sub: u8, data: &[u8]) -> Result<(), SdoAbortCode> {
        let result = self.device.download(Network::CanOpen, Object::new(index, sub), data);
        result.map_err(|fault| self.refused(fault))
    }
}

//! SDO servers of a node (CiA 301 7.2.4).

use core::fmt;
use core::time::Duration;
use std::boxed::Box;
use std::vec::Vec;

use super::super::device::{Device, Network};
use super::super::fault::Fault;
use super::super::values;
use crate::abort::AbortCode;
use crate::bus::Object;
use crate::clients::canopen::CanFrame;
use crate::pdo::can_id;
use crate::sdo::{Channel, Objects, Server};

/// Maximum length of a value in a transfer, in bytes.
const MOST_BYTES: usize = 8192;

/// Objects with the COB-IDs of further SDO channels (CiA 301 7.5.2.33).
const FURTHER_CHANNELS: [u16; 2] = [0x1201, 0x127F];

/// COB-IDs of an SDO channel.
#[derive(Clone, Copy, Debug)]
enum Source {
    Default,
    /// The COB-IDs are in this object.
    Object(u16),
}

impl Source {
    /// Returns the COB-IDs of requests and replies. Returns `None` if the channel is disabled (bit 31 is set, or a
    /// COB-ID is 0), or if a COB-ID is invalid.
    fn identifiers(self, device: &Device) -> Option<(u32, u32)> {
        let index = match self {
            Self::Default => {
                let channel = Channel::of_node(device.node_id());
                return Some((channel.request(), channel.reply()));
            }
            Self::Object(index) => index,
        };
        let identifier = |sub_index| {
            let cob_id = device.slots.number(index, sub_index)?;
            let cob_id = u32::try_from(cob_id).ok().filter(|cob_id| *cob_id != 0 && cob_id >> 31 == 0);
            can_id(cob_id?)
        };
        Some((identifier(1)?, identifier(2)?))
    }
}

/// The SDO servers of a node: one for the default channel, and one for each further channel in the object dictionary.
pub(super) struct Servers {
    list: Vec<(Source, Box<Server<MOST_BYTES>>)>,
}

impl fmt::Debug for Servers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.list.iter().map(|(source, _)| source)).finish()
    }
}

impl Servers {
    pub fn new(device: &Device) -> Self {
        let [first, last] = FURTHER_CHANNELS;
        let objects = device.slots.objects(first, last).filter(|object| object.sub_index == 1);
        let sources = core::iter::once(Source::Default).chain(objects.map(|object| Source::Object(object.index)));
        Self { list: sources.map(|source| (source, Box::default())).collect() }
    }

    /// Ends all unfinished transfers.
    pub fn reset(&mut self) {
        self.list.iter_mut().for_each(|(_, server)| server.reset());
    }

    /// Allows or refuses block transfers.
    pub fn allow_blocks(&mut self, has_blocks: bool) {
        self.list.iter_mut().for_each(|(_, server)| server.allow_blocks(has_blocks));
    }

    /// Returns the time at which the next unfinished transfer times out.
    pub fn deadline(&self) -> Option<Duration> {
        self.list.iter().filter_map(|(_, server)| server.deadline()).min()
    }

    /// Aborts the transfers that have timed out, and returns the abort messages.
    pub fn timed_out(&mut self, device: &Device, now: Duration) -> Vec<CanFrame> {
        let mut aborts = Vec::new();
        for (source, server) in &mut self.list {
            server.time_out(now);
            while let Some(message) = server.next() {
                aborts.extend(source.identifiers(device).and_then(|(_, reply)| CanFrame::new(reply, &message)));
            }
        }
        aborts
    }

    /// Processes a frame. Returns the replies, or `None` if the frame is not an SDO request to the node.
    pub fn handle(&mut self, device: &mut Device, frame: &CanFrame, now: Duration) -> Option<Vec<CanFrame>> {
        let of = |source: &Source| source.identifiers(device).filter(|(request, _)| *request == frame.id());
        let ((_, reply), server) = self.list.iter_mut().find_map(|(source, server)| Some((of(source)?, server)))?;
        let Ok(request) = frame.data().try_into() else { return Some(Vec::new()) };
        let mut dictionary = Dictionary { device, is_lost: false };
        server.handle(&request, now, &mut dictionary);
        let is_lost = dictionary.is_lost;
        let replies = core::iter::from_fn(|| server.next()).filter_map(|message| CanFrame::new(reply, &message));
        Some(replies.filter(|_| !is_lost).collect())
    }
}

/// The objects of a simulated device, for an SDO server.
struct Dictionary<'d> {
    device: &'d mut Device,
    /// True if a simulated fault suppresses the reply.
    is_lost: bool,
}

impl Dictionary<'_> {
    fn refused(&mut self, fault: Fault) -> AbortCode {
        self.is_lost |= fault == Fault::Bus;
        match fault {
            Fault::Abort(code) => code,
            Fault::Bus | Fault::Exception(_) => AbortCode::GENERAL,
        }
    }
}

impl Objects for Dictionary<'_> {
    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, AbortCode> {
        match self.device.upload(object) {
            Ok(value) => {
                buffer.get_mut(..value.len()).ok_or(AbortCode::OUT_OF_MEMORY)?.copy_from_slice(value);
                Ok(value.len())
            }
            Err(fault) => Err(self.refused(fault)),
        }
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), AbortCode> {
        let result = self.device.download(Network::CanOpen, object, data);
        result.map_err(|fault| self.refused(fault))
    }

    fn length(&mut self, object: Object) -> Option<usize> {
        let at = self.device.slots.of_object(object).ok()?;
        values::byte_length(self.device.slots.get(at).entry.data_type)
    }
}

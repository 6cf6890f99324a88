//! Configuration of a PDO with communication parameters.

use super::parameters::{Defaults, PdoParameterError, PdoParameters, RawParameters};
use super::sdo_write::{SdoWrite, SdoWriteError};
use super::word::from_bytes;
use crate::bus::{Bus, Object};
use crate::client::{AsyncClient, Client};

/// Bit 31 of a COB-ID: the PDO is disabled. Bit 30: the PDO refuses remote requests.
const DISABLED: u32 = 1 << 31;
const NO_REMOTE_REQUESTS: u32 = 1 << 30;

/// Sub-indices of the communication parameters that a configuration can write, in the order of the writes.
const SUB_INDICES: [u8; 4] = [2, 3, 5, 6];

impl PdoParameters {
    /// Returns the writes that configure a PDO with these parameters. `configuration` contains the writes that
    /// `configuration(node_id)` or `configuration_as(cob_id)` of a PDO struct returns.
    ///
    /// The writes are in the order of CiA 301 7.5.2.35 to 7.5.2.38. They disable the PDO, then set the transmission
    /// type, inhibit time, event timer and SYNC start value. Then they clear the mapping, write the entries and their
    /// number, and enable the PDO.
    ///
    /// # Errors
    ///
    /// - [`PdoParameterError::NoCobId`] if `configuration` doesn't start with a write to the COB-ID.
    /// - The other variants of [`PdoParameterError`] if a parameter is out of range, or conflicts with the direction of
    ///   the PDO or with another parameter.
    pub const fn configure<const N: usize>(
        self,
        configuration: [SdoWrite; N],
    ) -> Result<PdoConfiguration<N>, PdoParameterError> {
        let Some(communication) = communication(&configuration) else { return Err(PdoParameterError::NoCobId) };
        let Some(cob_id) = value(&configuration, communication, 1) else { return Err(PdoParameterError::NoCobId) };
        let defaults = Defaults {
            is_transmitted: communication >= 0x1800,
            transmission: match value(&configuration, communication, 2) {
                Some(code) => Some(code as u8),
                None => None,
            },
            refuses_remote_requests: cob_id & NO_REMOTE_REQUESTS != 0,
        };
        let parameters = match self.raw(defaults) {
            Ok(parameters) => parameters,
            Err(error) => return Err(error),
        };
        let cob_id = match parameters.remote_requests {
            Some(true) => cob_id & !NO_REMOTE_REQUESTS,
            Some(false) => cob_id | NO_REMOTE_REQUESTS,
            None => cob_id,
        };
        Ok(PdoConfiguration {
            configuration,
            parameters,
            communication,
            cob_id: cob_id & !DISABLED,
            next: Step::Disable,
        })
    }
}

/// Returns the index of the communication parameters, if the configuration starts with a write to the COB-ID.
const fn communication(configuration: &[SdoWrite]) -> Option<u16> {
    match configuration {
        [first, ..] => match first.object() {
            Object { index: index @ (0x1400..=0x15FF | 0x1800..=0x19FF), sub_index: 1 } => Some(index),
            _ => None,
        },
        [] => None,
    }
}

/// Returns the first value that the configuration writes to a sub-index of an object.
#[expect(clippy::indexing_slicing, reason = "`at` is below the length")]
const fn value(configuration: &[SdoWrite], index: u16, sub_index: u8) -> Option<u32> {
    let mut at = 0;
    while at < configuration.len() {
        let object = configuration[at].object();
        if object.index == index && object.sub_index == sub_index {
            return Some(from_bytes(configuration[at].data()) as u32);
        }
        at += 1;
    }
    None
}

/// The next write of a configuration. `Parameter` contains a position in [`SUB_INDICES`], and `Mapping` contains a
/// position in the configuration.
#[derive(Clone, Copy, Debug)]
enum Step {
    Disable,
    Parameter(usize),
    Mapping(usize),
    End,
}

/// The writes that configure a PDO with communication parameters. [`PdoParameters::configure`] creates this iterator.
///
/// ```
/// use lexibus::pdo::{PdoParameters, TransmissionType};
/// # use lexibus::{sim::Device, CanOpen, NodeId};
/// use lexibus_drives::demo_drive::pdo::TxPdo2;
///
/// # let node_id = NodeId::new(5).unwrap();
/// # let mut device = Device::new(lexibus_drives::demo_drive::ENTRIES).with_node_id(node_id);
/// # let mut client = device.client::<CanOpen>();
/// let parameters = PdoParameters::new().transmission(TransmissionType::EverySync(2));
/// parameters.configure(TxPdo2::configuration(node_id))?.send(&mut client)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[must_use = "the writes are sent by `send` or `send_async`, or one by one"]
pub struct PdoConfiguration<const N: usize> {
    configuration: [SdoWrite; N],
    parameters: RawParameters,
    communication: u16,
    /// COB-ID of the enabled PDO.
    cob_id: u32,
    next: Step,
}

impl<const N: usize> PdoConfiguration<N> {
    /// Sends the writes through a CANopen client.
    ///
    /// # Errors
    ///
    /// Returns the first write that failed. The PDO may then be disabled.
    pub fn send<C: Client>(self, client: &mut C) -> Result<(), SdoWriteError<C::Error>>
    where
        C::Bus: Bus<Address = Object>,
    {
        for write in self {
            write.send(client)?;
        }
        Ok(())
    }

    /// Sends the writes through an asynchronous client, as [`send`](Self::send) does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`send`](Self::send).
    pub async fn send_async<C: AsyncClient>(self, client: &mut C) -> Result<(), SdoWriteError<C::Error>>
    where
        C::Bus: Bus<Address = Object>,
    {
        for write in self {
            write.send_async(client).await?;
        }
        Ok(())
    }

    /// Returns the write of a communication parameter, or `None` if neither the parameters nor the configuration
    /// contain a value for this parameter.
    fn parameter(&self, sub_index: u8) -> Option<SdoWrite> {
        let index = self.communication;
        let new = match sub_index {
            2 => self.parameters.transmission.map(|code| SdoWrite::new_u8(index, 2, code)),
            3 => self.parameters.inhibit_time.map(|time| SdoWrite::new_u16(index, 3, time)),
            5 => self.parameters.event_timer.map(|time| SdoWrite::new_u16(index, 5, time)),
            _ => self.parameters.sync_start.map(|counter| SdoWrite::new_u8(index, 6, counter)),
        };
        let object = Object { index, sub_index };
        new.or_else(|| self.configuration.iter().find(|write| write.object() == object).copied())
    }
}

impl<const N: usize> Iterator for PdoConfiguration<N> {
    type Item = SdoWrite;

    fn next(&mut self) -> Option<SdoWrite> {
        loop {
            match self.next {
                Step::Disable => {
                    self.next = Step::Parameter(0);
                    return Some(SdoWrite::new_u32(self.communication, 1, self.cob_id | DISABLED));
                }
                Step::Parameter(at) => {
                    let Some(sub_index) = SUB_INDICES.get(at) else {
                        self.next = Step::Mapping(0);
                        continue;
                    };
                    self.next = Step::Parameter(at + 1);
                    if let Some(write) = self.parameter(*sub_index) {
                        return Some(write);
                    }
                }
                Step::Mapping(at) => {
                    let Some(write) = self.configuration.get(at) else {
                        self.next = Step::End;
                        return Some(SdoWrite::new_u32(self.communication, 1, self.cob_id));
                    };
                    self.next = Step::Mapping(at + 1);
                    if write.object().index != self.communication {
                        return Some(*write);
                    }
                }
                Step::End => return None,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::parameters::TransmissionType;
    use super::*;
    use core::time::Duration;
    use std::string::{String, ToString};
    use std::vec::Vec;

    /// The configuration of a TPDO whose description sets a transmission type and an event timer.
    const DEFAULT: [SdoWrite; 7] = [
        SdoWrite::new_u32(0x1800, 1, 0x8000_0185),
        SdoWrite::new_u8(0x1A00, 0, 0),
        SdoWrite::new_u32(0x1A00, 1, 0x6041_0010),
        SdoWrite::new_u8(0x1A00, 0, 1),
        SdoWrite::new_u8(0x1800, 2, 254),
        SdoWrite::new_u16(0x1800, 5, 100),
        SdoWrite::new_u32(0x1800, 1, 0x0000_0185),
    ];

    fn writes(parameters: PdoParameters) -> Vec<String> {
        parameters.configure(DEFAULT).unwrap().map(|write| write.to_string()).collect()
    }

    #[test]
    fn parameters_come_before_the_mapping() {
        let expected = [
            "0x1800:01 = 0x80000185",
            "0x1800:02 = 0xFE",
            "0x1800:05 = 0x0064",
            "0x1A00:00 = 0x00",
            "0x1A00:01 = 0x60410010",
            "0x1A00:00 = 0x01",
            "0x1800:01 = 0x00000185",
        ];
        assert_eq!(writes(PdoParameters::new()), expected);
        let all = PdoParameters::new().inhibit_time(Duration::from_millis(2)).event_timer(Duration::from_millis(7));
        let expected = ["0x1800:02 = 0xFE", "0x1800:03 = 0x0014", "0x1800:05 = 0x0007", "0x1A00:00 = 0x00"];
        assert_eq!(writes(all)[1..5], expected);
        let cyclic = PdoParameters::new().transmission(TransmissionType::EverySync(4)).sync_start(2);
        let expected = ["0x1800:02 = 0x04", "0x1800:05 = 0x0064", "0x1800:06 = 0x02", "0x1A00:00 = 0x00"];
        assert_eq!(writes(cyclic)[1..5], expected);
    }

    #[test]
    fn remote_requests_are_a_bit_of_the_cob_id() {
        let refusing = writes(PdoParameters::new().remote_requests(false));
        assert_eq!((&*refusing[0], &*refusing[6]), ("0x1800:01 = 0xC0000185", "0x1800:01 = 0x40000185"));
        let mut default = DEFAULT;
        default[0] = SdoWrite::new_u32(0x1800, 1, 0xC000_0185);
        let allowing = PdoParameters::new().remote_requests(true).configure(default).unwrap();
        assert_eq!(allowing.last().unwrap().to_string(), "0x1800:01 = 0x00000185");
        let kept = PdoParameters::new().configure(default).unwrap();
        assert_eq!(kept.last().unwrap().to_string(), "0x1800:01 = 0x40000185");
    }

    #[test]
    fn a_mapping_alone_has_no_cob_id() {
        let [_, clear, map, count, ..] = DEFAULT;
        let refused = PdoParameters::new().configure([clear, map, count]).map(|_| ());
        assert_eq!(refused, Err(PdoParameterError::NoCobId));
        assert_eq!(PdoParameters::new().configure([]).map(|_| ()), Err(PdoParameterError::NoCobId));
    }
}

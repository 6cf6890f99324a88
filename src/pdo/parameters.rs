//! Communication parameters of a PDO: transmission type, inhibit time, event timer and SYNC start value.

use core::error;
use core::fmt;
use core::time::Duration;

/// Specifies when the device sends a TPDO, and when a received RPDO takes effect (sub-index 2, CiA 301 7.5.2.35 and
/// 7.5.2.37).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TransmissionType {
    /// Synchronous, acyclic (0). The device sends the TPDO after a SYNC if an event, such as a change of the data,
    /// occurred before the SYNC. An RPDO takes effect at the next SYNC.
    SynchronousAcyclic,
    /// Synchronous, cyclic (1 to 240). The device sends the TPDO after every nth SYNC. An RPDO takes effect at the next
    /// SYNC, regardless of n.
    EverySync(u8),
    /// On remote request, synchronous (252); only for TPDOs. The device samples the data at a SYNC and sends the TPDO
    /// on a remote request.
    SampledOnSync,
    /// On remote request, event-driven (253); only for TPDOs. The device samples the data and sends the TPDO on a
    /// remote request.
    OnRemoteRequest,
    /// Event-driven, with events that the manufacturer defines (254). An RPDO takes effect immediately.
    ManufacturerEvent,
    /// Event-driven, with events that the device profile or application profile defines (255). An RPDO takes effect
    /// immediately.
    ProfileEvent,
}

/// Maximum number of SYNC messages between two transmissions, and maximum SYNC start value.
const MAX_SYNC: u8 = 240;

impl TransmissionType {
    /// Returns the value in the object dictionary.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::SynchronousAcyclic => 0,
            Self::EverySync(count) => count,
            Self::SampledOnSync => 252,
            Self::OnRemoteRequest => 253,
            Self::ManufacturerEvent => 254,
            Self::ProfileEvent => 255,
        }
    }

    /// Returns the transmission type for a value of the object dictionary, or `None` for the reserved values 241 to 251.
    #[must_use]
    pub const fn from_code(code: u8) -> Option<Self> {
        Some(match code {
            0 => Self::SynchronousAcyclic,
            1..=MAX_SYNC => Self::EverySync(code),
            241..=251 => return None,
            252 => Self::SampledOnSync,
            253 => Self::OnRemoteRequest,
            254 => Self::ManufacturerEvent,
            255 => Self::ProfileEvent,
        })
    }

    const fn is_event_driven(self) -> bool {
        matches!(self, Self::ManufacturerEvent | Self::ProfileEvent)
    }
}

/// Communication parameters of a PDO (CiA 301 7.5.2.35 and 7.5.2.37). [`configure`](Self::configure) adds them to the
/// configuration of a PDO struct. A parameter that is not set keeps its value in the configuration or in the device.
///
/// ```
/// use core::time::Duration;
///
/// use lexibus::pdo::{PdoParameters, TransmissionType};
/// use lexibus::NodeId;
/// use lexibus_drives::demo_drive::pdo::TxPdo2;
///
/// /// Sent on change, at most every 10 ms, and at least every second.
/// const ON_CHANGE: PdoParameters = PdoParameters::new()
///     .transmission(TransmissionType::ProfileEvent)
///     .inhibit_time(Duration::from_millis(10))
///     .event_timer(Duration::from_secs(1));
///
/// // The check of the parameters also works at compile time:
/// const _: () = assert!(ON_CHANGE.configure(TxPdo2::configuration_as(0x285)).is_ok());
///
/// # let node_id = NodeId::new(5).unwrap();
/// let writes: Vec<String> =
///     ON_CHANGE.configure(TxPdo2::configuration(node_id))?.map(|write| write.to_string()).collect();
/// assert_eq!(writes[0], "0x1801:01 = 0x80000285"); // the PDO is disabled
/// assert_eq!(writes[1], "0x1801:02 = 0xFF");
/// assert_eq!(writes[2], "0x1801:03 = 0x0064"); // 100 × 100 µs
/// assert_eq!(writes[3], "0x1801:05 = 0x03E8"); // 1000 ms
/// assert_eq!(writes.last().unwrap(), "0x1801:01 = 0x00000285");
/// # Ok::<(), lexibus::pdo::PdoParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PdoParameters {
    transmission: Option<TransmissionType>,
    inhibit_time: Option<Duration>,
    event_timer: Option<Duration>,
    sync_start: Option<u8>,
    remote_requests: Option<bool>,
}

/// Direction and default values of the PDO to which parameters are added.
#[derive(Clone, Copy)]
pub(super) struct Defaults {
    pub is_transmitted: bool,
    pub transmission: Option<u8>,
    pub refuses_remote_requests: bool,
}

/// Parameters as raw values of the object dictionary.
#[derive(Clone, Copy, Debug)]
pub(super) struct RawParameters {
    pub transmission: Option<u8>,
    /// Inhibit time in units of 100 µs.
    pub inhibit_time: Option<u16>,
    /// Event timer in ms.
    pub event_timer: Option<u16>,
    pub sync_start: Option<u8>,
    pub remote_requests: Option<bool>,
}

impl PdoParameters {
    /// Creates parameters that change nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self { transmission: None, inhibit_time: None, event_timer: None, sync_start: None, remote_requests: None }
    }

    /// Sets the transmission type (sub-index 2).
    #[must_use]
    pub const fn transmission(self, transmission: TransmissionType) -> Self {
        Self { transmission: Some(transmission), ..self }
    }

    /// Sets the inhibit time (sub-index 3): the minimum time between two transmissions of an event-driven TPDO. The time
    /// is a multiple of 100 µs, at most 6.5535 s. Zero disables the inhibit time.
    #[must_use]
    pub const fn inhibit_time(self, time: Duration) -> Self {
        Self { inhibit_time: Some(time), ..self }
    }

    /// Sets the event timer (sub-index 5): the maximum time between two transmissions of an event-driven TPDO. For an
    /// RPDO, the event timer is the time after which the device reports that the PDO is missing. The time is a multiple
    /// of 1 ms, at most 65.535 s. Zero disables the event timer.
    #[must_use]
    pub const fn event_timer(self, time: Duration) -> Self {
        Self { event_timer: Some(time), ..self }
    }

    /// Sets the SYNC start value (sub-index 6), 1 to 240. The SYNC message with this counter value counts as the first
    /// SYNC for a cyclic TPDO. The value 0 disables the SYNC start value. The SYNC messages must contain a counter
    /// (0x1019).
    #[must_use]
    pub const fn sync_start(self, counter: u8) -> Self {
        Self { sync_start: Some(counter), ..self }
    }

    /// Allows or refuses remote requests for the TPDO (bit 30 of the COB-ID; a set bit refuses them).
    #[must_use]
    pub const fn remote_requests(self, are_allowed: bool) -> Self {
        Self { remote_requests: Some(are_allowed), ..self }
    }

    /// Checks the parameters and converts them to raw values.
    pub(super) const fn raw(self, defaults: Defaults) -> Result<RawParameters, PdoParameterError> {
        if let Err(error) = self.check_transmission(defaults) {
            return Err(error);
        }
        let transmission = match self.transmission {
            Some(transmission) => Some(transmission.code()),
            None => defaults.transmission,
        };
        let kind = match transmission {
            Some(code) => TransmissionType::from_code(code),
            None => None,
        };
        let is_event_driven = match kind {
            Some(kind) if defaults.is_transmitted => kind.is_event_driven(),
            _ => true,
        };
        let inhibit_time = match time(self.inhibit_time, 100, is_event_driven) {
            Ok(time) => time,
            Err(TimeError::Range) => return Err(PdoParameterError::InhibitTime),
            Err(TimeError::Event) => return Err(PdoParameterError::NotEventDriven),
        };
        let event_timer = match time(self.event_timer, 1000, is_event_driven) {
            Ok(time) => time,
            Err(TimeError::Range) => return Err(PdoParameterError::EventTimer),
            Err(TimeError::Event) => return Err(PdoParameterError::NotEventDriven),
        };
        if let Err(error) = self.check_sync_start(defaults, kind) {
            return Err(error);
        }
        Ok(RawParameters {
            transmission: match self.transmission {
                Some(transmission) => Some(transmission.code()),
                None => None,
            },
            inhibit_time,
            event_timer,
            sync_start: self.sync_start,
            remote_requests: self.remote_requests,
        })
    }

    const fn check_transmission(&self, defaults: Defaults) -> Result<(), PdoParameterError> {
        if let Some(TransmissionType::EverySync(count)) = self.transmission {
            if count == 0 || count > MAX_SYNC {
                return Err(PdoParameterError::SyncCount(count));
            }
        }
        if self.remote_requests.is_some() && !defaults.is_transmitted {
            return Err(PdoParameterError::OnlyTransmitted);
        }
        let is_refused = match self.remote_requests {
            Some(are_allowed) => !are_allowed,
            None => defaults.refuses_remote_requests,
        };
        let is_requested = match (self.transmission, defaults.transmission) {
            (Some(transmission), _) => {
                matches!(transmission, TransmissionType::SampledOnSync | TransmissionType::OnRemoteRequest)
            }
            (None, code) => matches!(code, Some(252 | 253)),
        };
        match (is_requested, defaults.is_transmitted) {
            (true, false) => Err(PdoParameterError::OnlyTransmitted),
            (true, true) if is_refused => Err(PdoParameterError::RemoteRequests),
            _ => Ok(()),
        }
    }

    const fn check_sync_start(
        &self,
        defaults: Defaults,
        kind: Option<TransmissionType>,
    ) -> Result<(), PdoParameterError> {
        match self.sync_start {
            None => Ok(()),
            Some(_) if !defaults.is_transmitted => Err(PdoParameterError::OnlyTransmitted),
            Some(0) => Ok(()),
            Some(counter) if counter > MAX_SYNC => Err(PdoParameterError::SyncStart(counter)),
            Some(_) => match kind {
                Some(TransmissionType::EverySync(_)) | None => Ok(()),
                Some(_) => Err(PdoParameterError::NotCyclic),
            },
        }
    }
}

/// Reason why a time is invalid.
enum TimeError {
    /// The time isn't a multiple of the unit, or is too long.
    Range,
    /// The PDO isn't event-driven.
    Event,
}

/// Converts a time to a number of units. `unit` is the length of a unit in µs.
const fn time(time: Option<Duration>, unit: u32, is_event_driven: bool) -> Result<Option<u16>, TimeError> {
    let Some(time) = time else { return Ok(None) };
    let nanoseconds = time.as_nanos();
    let count = nanoseconds / (unit as u128 * 1000);
    if nanoseconds % (unit as u128 * 1000) != 0 || count > u16::MAX as u128 {
        return Err(TimeError::Range);
    }
    if count > 0 && !is_event_driven {
        return Err(TimeError::Event);
    }
    Ok(Some(count as u16))
}

/// Reason why PDO parameters are invalid. Nothing was sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PdoParameterError {
    /// The number of SYNC messages between two transmissions isn't 1 to 240.
    SyncCount(u8),
    /// The inhibit time isn't a multiple of 100 µs, or exceeds 6.5535 s.
    InhibitTime,
    /// The event timer isn't a multiple of 1 ms, or exceeds 65.535 s.
    EventTimer,
    /// The SYNC start value isn't 0 to 240.
    SyncStart(u8),
    /// The inhibit time and the event timer of a TPDO need the transmission type 254 or 255.
    NotEventDriven,
    /// The SYNC start value needs a cyclic transmission type, 1 to 240.
    NotCyclic,
    /// Remote requests, the transmission types 252 and 253, and the SYNC start value exist only for TPDOs.
    OnlyTransmitted,
    /// The transmission types 252 and 253 need remote requests, but the COB-ID refuses them.
    RemoteRequests,
    /// The configuration doesn't write the COB-ID, so the PDO cannot be disabled while the parameters are set. The
    /// COB-ID is unknown or read-only, or the PDO is on EtherCAT.
    NoCobId,
}

impl fmt::Display for PdoParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SyncCount(count) => write!(f, "a PDO cannot be sent on every {count} SYNC messages, only 1 to 240"),
            Self::InhibitTime => f.write_str("the inhibit time must be a multiple of 100 µs, at most 6.5535 s"),
            Self::EventTimer => f.write_str("the event timer must be a multiple of 1 ms, at most 65.535 s"),
            Self::SyncStart(counter) => write!(f, "the SYNC start value must be 0 to 240, not {counter}"),
            Self::NotEventDriven => {
                f.write_str("inhibit time and event timer of a TPDO need the transmission type 254 or 255")
            }
            Self::NotCyclic => f.write_str("the SYNC start value needs a transmission type from 1 to 240"),
            Self::OnlyTransmitted => {
                f.write_str("RPDOs have no remote requests, transmission type 252 or 253, or SYNC start value")
            }
            Self::RemoteRequests => {
                f.write_str("the transmission types 252 and 253 need remote requests, but the COB-ID refuses them")
            }
            Self::NoCobId => f.write_str("the configuration of the PDO doesn't write the COB-ID"),
        }
    }
}

impl error::Error for PdoParameterError {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    const TPDO: Defaults = Defaults { is_transmitted: true, transmission: Some(255), refuses_remote_requests: false };
    const RPDO: Defaults = Defaults { is_transmitted: false, ..TPDO };

    const NEW: PdoParameters = PdoParameters::new();

    #[track_caller]
    fn refused(parameters: PdoParameters, defaults: Defaults, error: PdoParameterError) {
        assert_eq!(parameters.raw(defaults).map(|_| ()), Err(error));
    }

    #[test]
    fn codes() {
        for code in 0..=255 {
            let transmission = TransmissionType::from_code(code);
            assert_eq!(transmission.is_none(), (241..=251).contains(&code));
            assert!(transmission.map_or(true, |transmission| transmission.code() == code));
        }
    }

    #[test]
    fn ranges() {
        let inhibit = |micros| NEW.inhibit_time(Duration::from_micros(micros));
        let raw = |parameters: PdoParameters| parameters.raw(TPDO).unwrap();
        assert_eq!(raw(inhibit(6_553_500)).inhibit_time, Some(65_535));
        assert_eq!(raw(inhibit(100)).inhibit_time, Some(1));
        for micros in [99, 150, 6_553_600, u64::MAX] {
            refused(inhibit(micros), TPDO, PdoParameterError::InhibitTime);
        }
        let timer = |millis| NEW.event_timer(Duration::from_millis(millis));
        assert_eq!(raw(timer(65_535)).event_timer, Some(65_535));
        refused(timer(65_536), TPDO, PdoParameterError::EventTimer);
        refused(NEW.event_timer(Duration::from_micros(1500)), TPDO, PdoParameterError::EventTimer);
        refused(NEW.event_timer(Duration::MAX), TPDO, PdoParameterError::EventTimer);
        let every = |count| NEW.transmission(TransmissionType::EverySync(count));
        assert_eq!((raw(every(1)).transmission, raw(every(240)).transmission), (Some(1), Some(240)));
        for count in [0, 241, 252, 255] {
            refused(every(count), TPDO, PdoParameterError::SyncCount(count));
        }
        assert_eq!(raw(every(3).sync_start(240)).sync_start, Some(240));
        refused(every(3).sync_start(241), TPDO, PdoParameterError::SyncStart(241));
        assert_eq!(PdoParameterError::SyncStart(241).to_string(), "the SYNC start value must be 0 to 240, not 241");
    }

    #[test]
    fn parameters_that_contradict_each_other() {
        use PdoParameterError::{NotCyclic, NotEventDriven, OnlyTransmitted, RemoteRequests};
        let (sync, time) = (NEW.transmission(TransmissionType::EverySync(1)), Duration::from_millis(1));
        for parameters in [sync.inhibit_time(time), sync.event_timer(time)] {
            refused(parameters, TPDO, NotEventDriven);
            assert!(parameters.raw(RPDO).is_ok());
        }
        assert!(sync.inhibit_time(Duration::ZERO).event_timer(Duration::ZERO).raw(TPDO).is_ok());
        // Without a transmission type, that of the configuration counts.
        let cyclic = Defaults { transmission: Some(1), ..TPDO };
        refused(NEW.event_timer(time), cyclic, NotEventDriven);
        assert!(NEW.event_timer(time).raw(Defaults { transmission: None, ..TPDO }).is_ok());
        refused(NEW.sync_start(1), TPDO, NotCyclic);
        assert!(NEW.sync_start(1).raw(cyclic).is_ok());
        refused(NEW.sync_start(0), RPDO, OnlyTransmitted);
        refused(NEW.remote_requests(true), RPDO, OnlyTransmitted);
        for transmission in [TransmissionType::SampledOnSync, TransmissionType::OnRemoteRequest] {
            let parameters = NEW.transmission(transmission);
            assert!(parameters.raw(TPDO).is_ok());
            refused(parameters, RPDO, OnlyTransmitted);
            refused(parameters.remote_requests(false), TPDO, RemoteRequests);
            let refusing = Defaults { refuses_remote_requests: true, ..TPDO };
            refused(parameters, refusing, RemoteRequests);
            assert!(parameters.remote_requests(true).raw(refusing).is_ok());
        }
        let on_request = Defaults { transmission: Some(253), ..TPDO };
        refused(NEW.remote_requests(false), on_request, RemoteRequests);
    }
}

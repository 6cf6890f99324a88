//! Errors of LSS services.

use core::convert::Infallible;
use core::error;
use core::fmt;

/// Reason why an LSS service failed. `E` is the error type of the CAN interface. The state machines of this module
/// don't access the CAN interface; their `E` is [`Infallible`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LssError<E = Infallible> {
    /// The CAN interface returned an error.
    Client(E),
    /// The bus was busy, and the request was not sent.
    NotSent,
    /// No slave answered in time.
    Timeout,
    /// The slave refused the service.
    Refused(Refusal),
    /// More than one answer arrived: several slaves executed the service, or one slave answered twice.
    SeveralAnswers,
    /// The answers to a fastscan contradict each other, because an answer was lost or late. Repeat the scan.
    Inconclusive,
    /// The slave answered with an invalid value.
    UnexpectedReply,
}

/// Answer of a slave that refuses a service (CiA 305).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Refusal {
    /// Error code. 1: the node-ID is out of range, the bit timing is not supported, or the slave cannot store. 2: the
    /// slave failed to access its storage. 0xFF: `specific` contains the error.
    pub code: u8,
    /// Device-specific error code; valid only if `code` is 0xFF.
    pub specific: u8,
}

impl Refusal {
    /// Error code 1: the value or the service is not supported.
    pub const NOT_SUPPORTED: Self = Self { code: 1, specific: 0 };
    /// Error code 2 of the service store: access to the storage failed.
    pub const STORAGE: Self = Self { code: 2, specific: 0 };
}

impl LssError {
    /// Converts the error to an error of a client with the error type `E`.
    #[cfg(feature = "canopen")]
    pub(crate) fn of_client<E>(self) -> LssError<E> {
        match self {
            Self::Client(never) => match never {},
            Self::NotSent => LssError::NotSent,
            Self::Timeout => LssError::Timeout,
            Self::Refused(refusal) => LssError::Refused(refusal),
            Self::SeveralAnswers => LssError::SeveralAnswers,
            Self::Inconclusive => LssError::Inconclusive,
            Self::UnexpectedReply => LssError::UnexpectedReply,
        }
    }
}

impl<E: fmt::Display> fmt::Display for LssError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Client(error) => error.fmt(f),
            Self::NotSent => f.write_str("the bus is busy, the LSS request was not sent"),
            Self::Timeout => f.write_str("timeout: no answer from an LSS slave"),
            Self::Refused(Refusal { code: 0xFF, specific }) => {
                write!(f, "the LSS slave refused: device-specific error 0x{specific:02X}")
            }
            Self::Refused(Refusal { code, .. }) => write!(f, "the LSS slave refused: error {code}"),
            Self::SeveralAnswers => f.write_str("more than one answer of LSS slaves"),
            Self::Inconclusive => f.write_str("the answers to the fastscan contradict each other"),
            Self::UnexpectedReply => f.write_str("the LSS slave answered with an invalid value"),
        }
    }
}

impl<E: error::Error> error::Error for LssError<E> {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Client(error) => error.source(),
            _ => None,
        }
    }
}

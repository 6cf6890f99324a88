//! Errors of an access to a device.

use std::error::Error;
use std::fmt;

use lexibus::AbortCode;

/// The reason why an access to a device failed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// The device aborted the SDO transfer with this code.
    Abort(AbortCode),
    /// The device refused the Modbus request with this exception code.
    Exception(u8),
    /// The device didn't reply in time. The device may have executed the request.
    Timeout,
    /// The reply was Modbus exception 5 (acknowledge) or 11 (gateway target device failed to respond). The device may have
    /// executed the request.
    Unconfirmed(u8),
    /// The client or the device doesn't support this access. For example, the value is too long for a Modbus request.
    Unsupported(String),
    /// The bus cannot be used, or the bus or the client failed.
    Bus(String),
}

impl Failure {
    /// Returns whether the device refused the access, or the access is impossible. Other accesses can still succeed.
    #[must_use]
    pub fn is_refusal(&self) -> bool {
        matches!(self, Failure::Abort(_) | Failure::Exception(_) | Failure::Unsupported(_))
    }

    /// Returns whether the device may have executed the request without confirming it.
    #[must_use]
    pub fn is_timeout(&self) -> bool {
        matches!(self, Failure::Timeout | Failure::Unconfirmed(_))
    }

    /// Returns whether the device reports that it has no such object, sub-index or register.
    #[must_use]
    pub fn is_missing(&self) -> bool {
        /// Illegal data address (MODBUS Application Protocol V1.1b3, 7).
        const ILLEGAL_ADDRESS: u8 = 2;
        match self {
            Failure::Abort(code) => matches!(*code, AbortCode::NO_OBJECT | AbortCode::NO_SUB_INDEX),
            Failure::Exception(code) => *code == ILLEGAL_ADDRESS,
            _ => false,
        }
    }

    /// Returns the abort code, if the device aborted an SDO transfer.
    #[must_use]
    pub fn abort_code(&self) -> Option<AbortCode> {
        match self {
            Failure::Abort(code) => Some(*code),
            _ => None,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Abort(code) => write!(f, "the device aborted the transfer: {code}"),
            Failure::Exception(code) => {
                write!(f, "the device refused the request: Modbus exception {code} ({})", exception(*code))
            }
            Failure::Timeout => f.write_str("no reply within the timeout"),
            Failure::Unconfirmed(code) => {
                write!(f, "the request is not confirmed: Modbus exception {code} ({})", exception(*code))
            }
            Failure::Unsupported(text) | Failure::Bus(text) => f.write_str(text),
        }
    }
}

impl Error for Failure {}

/// Calls `read` again after a timeout, up to three times in total.
pub(crate) fn retried<T>(mut read: impl FnMut() -> Result<T, Failure>) -> Result<T, Failure> {
    for _ in 1..3 {
        match read() {
            Err(failure) if failure.is_timeout() => {}
            result => return result,
        }
    }
    read()
}

/// Returns the name of an exception code (MODBUS Application Protocol V1.1b3, 7).
fn exception(code: u8) -> &'static str {
    match code {
        1 => "illegal function",
        2 => "illegal data address",
        3 => "illegal data value",
        4 => "server device failure",
        5 => "acknowledge",
        6 => "server device busy",
        8 => "memory parity error",
        10 => "gateway path unavailable",
        11 => "gateway target device failed to respond",
        _ => "unknown code",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unconfirmed_request_counts_as_a_timeout_and_names_the_exception() {
        let failure = Failure::Unconfirmed(11);
        assert!(failure.is_timeout() && !failure.is_refusal());
        let text = "the request is not confirmed: Modbus exception 11 (gateway target device failed to respond)";
        assert_eq!(failure.to_string(), text);
        let mut attempts = 0;
        let result: Result<(), _> = retried(|| {
            attempts += 1;
            Err(Failure::Unconfirmed(5))
        });
        assert_eq!((attempts, result), (3, Err(Failure::Unconfirmed(5))));
    }
}

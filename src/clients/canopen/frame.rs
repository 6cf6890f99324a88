//! CAN frames.

use core::time::Duration;

use embedded_can::{ExtendedId, Id, StandardId};

use crate::pdo::{is_can_id, EXTENDED};

/// A CAN frame: a data frame, or a remote frame, which requests a data frame. A received frame also has a
/// [time](Self::time).
///
/// The identifier has the format of a COB-ID: for a CAN-ID of 29 bits, bit 29 is set ([`EXTENDED`](Self::EXTENDED)). An
/// 11-bit and a 29-bit CAN-ID therefore never have the same identifier:
///
/// ```
/// use lexibus::clients::canopen::CanFrame;
///
/// let frame = CanFrame::new(CanFrame::EXTENDED | 0x185, &[1, 2]).expect("a CAN-ID of 29 bits");
/// assert_ne!(frame.id(), 0x185);
/// let request = CanFrame::remote(0x185, 2).expect("a remote frame");
/// assert!(request.is_remote() && request.data().is_empty());
/// ```
///
/// Frames are equal if their identifiers, types, lengths and data are equal. The comparison ignores the time.
#[derive(Clone, Copy, Debug)]
pub struct CanFrame {
    id: u32,
    data: [u8; 8],
    length: u8,
    is_remote: bool,
    time: Option<Duration>,
}

impl PartialEq for CanFrame {
    fn eq(&self, other: &Self) -> bool {
        let kind = |frame: &Self| (frame.id, frame.length, frame.is_remote);
        kind(self) == kind(other) && self.data() == other.data()
    }
}

impl Eq for CanFrame {}

impl CanFrame {
    /// Bit of an identifier that is set if the CAN-ID has 29 bits.
    pub const EXTENDED: u32 = EXTENDED;

    /// Creates a data frame. Returns `None` if `data` has more than 8 bytes, or if `id` is neither an 11-bit CAN-ID nor
    /// a 29-bit CAN-ID with [`EXTENDED`](Self::EXTENDED).
    #[must_use]
    pub fn new(id: u32, data: &[u8]) -> Option<Self> {
        let mut bytes = [0; 8];
        bytes.get_mut(..data.len())?.copy_from_slice(data);
        is_can_id(id).then_some(Self { id, data: bytes, length: data.len() as u8, is_remote: false, time: None })
    }

    /// Creates a remote frame, which requests a data frame of this length. Returns `None` if `length` is more than 8, or
    /// if `id` is invalid, as for [`new`](Self::new).
    #[must_use]
    pub fn remote(id: u32, length: u8) -> Option<Self> {
        let is_possible = length <= 8 && is_can_id(id);
        is_possible.then_some(Self { id, data: [0; 8], length, is_remote: true, time: None })
    }

    /// Creates a data frame. The caller ensures that `id` is valid and that `data` has at most 8 bytes.
    pub(super) fn of<const N: usize>(id: u32, data: [u8; N]) -> Self {
        let mut bytes = [0; 8];
        bytes.iter_mut().zip(data).for_each(|(to, from)| *to = from);
        Self { id, data: bytes, length: N.min(8) as u8, is_remote: false, time: None }
    }

    /// Returns the data, padded with 0 to eight bytes.
    pub(super) const fn padded(&self) -> [u8; 8] {
        self.data
    }

    /// Returns the frame with the arrival time `time`, which is `None` if there is no clock. A port sets the time of each
    /// received frame.
    #[must_use]
    pub const fn at(self, time: Option<Duration>) -> Self {
        Self { time, ..self }
    }

    /// Returns the time at which the frame arrived, measured with the clock of the port
    /// ([`CanPort::now`](super::CanPort::now)). Returns `None` if the port has no clock, and for a frame that wasn't
    /// received.
    ///
    /// SocketCAN sockets use the timestamps of the kernel. If the system clock is changed between the arrival and the
    /// reading of a frame, the time of the frame is wrong. If the interface has no timestamps, as with
    /// [`Polled`](super::Polled), this is the time at which the frame is taken from the interface. The frame then arrived at
    /// this time or earlier, because it may have waited in the receive queue.
    #[must_use]
    pub const fn time(&self) -> Option<Duration> {
        self.time
    }

    /// Returns the identifier: the CAN-ID, and [`EXTENDED`](Self::EXTENDED) if the CAN-ID has 29 bits.
    #[must_use]
    pub const fn id(&self) -> u32 {
        self.id
    }

    /// Returns whether the CAN-ID has 29 bits.
    #[must_use]
    pub const fn is_extended(&self) -> bool {
        self.id & EXTENDED != 0
    }

    /// Returns whether the frame is a remote frame.
    #[must_use]
    pub const fn is_remote(&self) -> bool {
        self.is_remote
    }

    /// Returns the number of bytes in a data frame, or the number of bytes that a remote frame requests.
    #[must_use]
    pub const fn length(&self) -> u8 {
        self.length
    }

    /// Returns the data. A remote frame has no data.
    #[must_use]
    pub fn data(&self) -> &[u8] {
        let length = if self.is_remote { 0 } else { usize::from(self.length) };
        self.data.get(..length).unwrap_or(&self.data)
    }

    /// Converts a frame of another library. Returns `None` if the frame has more than 8 bytes.
    pub fn from_frame(frame: &impl embedded_can::Frame) -> Option<Self> {
        let id = match frame.id() {
            Id::Standard(id) => id.as_raw().into(),
            Id::Extended(id) => EXTENDED | id.as_raw(),
        };
        if frame.is_remote_frame() {
            return Self::remote(id, u8::try_from(frame.dlc()).ok()?);
        }
        Self::new(id, frame.data())
    }

    /// Converts the frame to a frame of another library. Returns `None` if the other library cannot represent the
    /// frame.
    pub fn to_frame<F: embedded_can::Frame>(&self) -> Option<F> {
        let id = match self.is_extended() {
            true => Id::Extended(ExtendedId::new(self.id & !EXTENDED)?),
            false => Id::Standard(StandardId::new(u16::try_from(self.id).ok()?)?),
        };
        if self.is_remote {
            return F::new_remote(id, self.length.into());
        }
        F::new(id, self.data())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits() {
        assert_eq!(CanFrame::new(0x800, &[]), None);
        assert_eq!(CanFrame::new(0x7FF, &[0; 9]), None);
        let frame = CanFrame::new(0x185, &[1, 2]).expect("a frame");
        assert_eq!((frame.id(), frame.data()), (0x185, [1, 2].as_slice()));
        assert_ne!(frame, CanFrame::new(0x185, &[1, 2, 0]).expect("a longer frame"));
    }

    #[test]
    fn identifiers_of_29_bits_and_remote_frames() {
        let extended = CanFrame::new(CanFrame::EXTENDED | 0x1FFF_FFFF, &[1]).expect("a frame");
        assert!(extended.is_extended() && !extended.is_remote());
        assert_eq!(CanFrame::new(0x4000_0185, &[]), None);
        assert_eq!(CanFrame::new(0x1FFF_FFFF, &[]), None);
        let remote = CanFrame::remote(0x705, 1).expect("a remote frame");
        assert_eq!((remote.data(), remote.length()), ([].as_slice(), 1));
        assert_ne!(remote, CanFrame::new(0x705, &[0]).expect("a data frame"));
        assert_ne!(CanFrame::remote(0x705, 0), CanFrame::new(0x705, &[]));
        assert_eq!((CanFrame::remote(0x705, 9), CanFrame::remote(0x800, 1)), (None, None));
    }

    #[test]
    fn the_time_is_not_compared() {
        let frame = CanFrame::new(0x185, &[1, 2]).expect("a frame");
        let received = frame.at(Some(Duration::from_secs(3)));
        assert_eq!((received.time(), frame.time()), (Some(Duration::from_secs(3)), None));
        assert_eq!(received, frame);
    }
}

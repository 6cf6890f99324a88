//! CAN frames.

use core::time::Duration;

use embedded_can::{Id, StandardId};

/// A CAN data frame with an 11-bit identifier. A received frame also has a [time](Self::time).
///
/// Frames are equal if their identifiers and data are equal. The comparison ignores the time.
#[derive(Clone, Copy, Debug)]
pub struct CanFrame {
    id: u16,
    data: [u8; 8],
    length: u8,
    time: Option<Duration>,
}

impl PartialEq for CanFrame {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id && self.data() == other.data()
    }
}

impl Eq for CanFrame {}

impl CanFrame {
    /// Creates a frame. Returns `None` if `id` has more than 11 bits, or `data` more than 8 bytes.
    #[must_use]
    pub fn new(id: u16, data: &[u8]) -> Option<Self> {
        let mut bytes = [0; 8];
        bytes.get_mut(..data.len())?.copy_from_slice(data);
        (id <= 0x7FF).then_some(Self { id, data: bytes, length: data.len() as u8, time: None })
    }

    /// Creates a frame whose identifier and length are known to be valid: 11 bits and at most 8 bytes.
    pub(super) fn of<const N: usize>(id: u16, data: [u8; N]) -> Self {
        let mut bytes = [0; 8];
        bytes.iter_mut().zip(data).for_each(|(to, from)| *to = from);
        Self { id: id & 0x7FF, data: bytes, length: N.min(8) as u8, time: None }
    }

    /// Returns the data, padded with 0 to eight bytes.
    pub(super) const fn padded(&self) -> [u8; 8] {
        self.data
    }

    /// Returns the frame with the time at which it was taken from the interface, or `None` if there is no clock. A port
    /// sets the time of each received frame.
    #[must_use]
    pub const fn at(self, time: Option<Duration>) -> Self {
        Self { time, ..self }
    }

    /// Returns the time at which the frame was taken from the interface, measured with the clock of the port
    /// ([`CanPort::now`](super::CanPort::now)). Returns `None` if the port has no clock, and for a frame that wasn't
    /// received.
    ///
    /// The frame arrived at this time or earlier, because it may have waited in the receive queue of the interface.
    #[must_use]
    pub const fn time(&self) -> Option<Duration> {
        self.time
    }

    /// Returns the identifier (COB-ID).
    #[must_use]
    pub const fn id(&self) -> u16 {
        self.id
    }

    /// Returns the data.
    #[must_use]
    pub fn data(&self) -> &[u8] {
        &self.data[..usize::from(self.length)]
    }

    /// Converts a frame of another library. Returns `None` for remote frames and for 29-bit identifiers.
    pub fn from_frame(frame: &impl embedded_can::Frame) -> Option<Self> {
        match frame.id() {
            Id::Standard(id) if frame.is_data_frame() => Self::new(id.as_raw(), frame.data()),
            _ => None,
        }
    }

    /// Converts the frame to a frame of another library. Returns `None` if the other library cannot represent the
    /// frame.
    pub fn to_frame<F: embedded_can::Frame>(&self) -> Option<F> {
        F::new(StandardId::new(self.id)?, self.data())
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
    fn the_time_is_not_compared() {
        let frame = CanFrame::new(0x185, &[1, 2]).expect("a frame");
        let received = frame.at(Some(Duration::from_secs(3)));
        assert_eq!((received.time(), frame.time()), (Some(Duration::from_secs(3)), None));
        assert_eq!(received, frame);
    }
}

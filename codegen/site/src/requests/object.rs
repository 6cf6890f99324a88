//! Requests of an object: SDOs on CANopen, and the same services on EtherCAT.

use super::{known, text, Frame, Request, Written, NODE};
use lexibus_codegen::number::hex16;

/// The address of an object.
pub(super) struct Object {
    pub index: u16,
    pub sub_index: u8,
}

impl Object {
    /// Adds the requests on CANopen.
    pub fn canopen(&self, is_readable: bool, written: Option<&Written>, all: &mut Vec<Request>) {
        let frame = |data: &Frame| format!("{:03X}  {}", 0x600 + u16::from(NODE), text(data));
        if is_readable {
            all.push(("SDO upload (COB-ID, data)", frame(&self.upload())));
            all.push(("canopen read", format!("node.sdo.upload({})", self.python())));
        }
        if let Some(written) = written {
            let frames: Vec<String> = self.download(&written.bytes).iter().map(frame).collect();
            all.push(("SDO download (COB-ID, data)", frames.join("; ")));
            all.push(("canopen write", format!("node.sdo.download({}, {})", self.python(), written.python())));
        }
    }

    /// Adds the requests on EtherCAT.
    pub fn ethercat(&self, is_readable: bool, written: Option<&Written>, all: &mut Vec<Request>) {
        all.extend(is_readable.then(|| ("pysoem read", format!("slave.sdo_read({})", self.python()))));
        if let Some(written) = written {
            all.push(("pysoem write", format!("slave.sdo_write({}, {})", self.python(), written.python())));
        }
    }

    /// Returns the Python arguments for index and sub-index.
    fn python(&self) -> String {
        format!("{}, {}", hex16(self.index), self.sub_index)
    }

    /// Returns the data of an SDO frame: command specifier, index, sub-index, and `data` padded with zeros.
    fn frame(&self, command: u8, data: &[Option<u8>]) -> Frame {
        let [low, high] = self.index.to_le_bytes();
        let mut frame = known(&[command, low, high, self.sub_index]);
        frame.extend(data);
        frame.resize(8, Some(0));
        frame
    }

    /// Returns the data of an SDO upload request (CiA 301, 7.2.4.3.5).
    fn upload(&self) -> Frame {
        self.frame(0x40, &[])
    }

    /// Returns the data of an SDO download (CiA 301, 7.2.4.3.3): an expedited transfer, or a segmented one if there are
    /// more than four bytes. A number has at most eight bytes.
    pub fn download(&self, bytes: &[Option<u8>]) -> Vec<Frame> {
        let count = u8::try_from(bytes.len()).unwrap_or(u8::MAX);
        if let Some(unused) = 4_u8.checked_sub(count) {
            return vec![self.frame(0x23 | unused << 2, bytes)];
        }
        let mut frames = vec![self.frame(0x21, &[Some(count)])];
        let segments = bytes.chunks(7).collect::<Vec<_>>();
        for (at, segment) in segments.iter().enumerate() {
            let unused = 7_u8.saturating_sub(u8::try_from(segment.len()).unwrap_or(7));
            let toggle = if at % 2 == 1 { 0x10 } else { 0 };
            let mut frame = known(&[toggle | unused << 1 | u8::from(at + 1 == segments.len())]);
            frame.extend(*segment);
            frame.resize(8, Some(0));
            frames.push(frame);
        }
        frames
    }
}

//! A simulated device for blocking and asynchronous clients.

use std::collections::HashMap;

use lexibus::profinet::parameter_access::{Format, GLOBAL, LOCAL};
use lexibus::profinet::{AsyncRecordClient, PnioStatus, RecordAddress, RecordClient};
use lexibus::Error;

pub const INVALID_INDEX: PnioStatus = PnioStatus(0xDE80_B000);
pub const STATE_CONFLICT: PnioStatus = PnioStatus(0xDE80_B500);

/// A device that stores records in memory, and contains a drive that answers parameter requests.
#[derive(Default)]
pub struct Device {
    pub records: HashMap<RecordAddress, Vec<u8>>,
    pub writes: Vec<(RecordAddress, Vec<u8>)>,
    pub drive: Drive,
    pub pauses: u32,
}

/// A drive with PROFIdrive parameters. Parameter 100 has a maximum of 3000.
#[derive(Default)]
pub struct Drive {
    /// Format and bytes of each parameter, by axis, parameter number and subindex.
    pub values: HashMap<(u8, u16, u16), (Format, Vec<u8>)>,
    pub response: Vec<u8>,
    /// Number of reads before the response is available.
    pub delay: u32,
    /// True if the record is empty until the response is available. If this value is false, reads return an error until
    /// the response is available.
    pub is_empty: bool,
}

impl Drive {
    fn request(&mut self, request: &[u8]) {
        let (kind, axis, count) = (request[1], request[2], usize::from(request[3]));
        let addresses = request[4..].chunks_exact(6).take(count);
        let mut values = &request[4 + 6 * count..];
        let (mut answers, mut is_negative) = (Vec::new(), false);
        for address in addresses {
            let (pnu, first) =
                (u16::from_be_bytes([address[2], address[3]]), u16::from_be_bytes([address[4], address[5]]));
            let subindices = first..first + u16::from(address[1]);
            let answer = match kind {
                1 => self.read(axis, pnu, subindices),
                _ => {
                    let size = Format(values[0]).size().expect("a known format");
                    let (bytes, rest) = values[2..].split_at(size * usize::from(values[1]));
                    let answer = self.change(axis, pnu, subindices, Format(values[0]), bytes);
                    values = &rest[bytes.len() % 2..];
                    answer
                }
            };
            is_negative |= answer.is_err();
            let mut answer = answer.unwrap_or_else(|(number, at)| vec![0x44, 2, 0, number, 0, at]);
            answer.resize(answer.len().next_multiple_of(2), 0);
            answers.extend(answer);
        }
        self.response = vec![request[0], kind | if is_negative { 0x80 } else { 0 }, axis, request[3]];
        if kind == 1 || is_negative {
            self.response.extend(answers);
        }
    }

    fn read(&self, axis: u8, pnu: u16, subindices: std::ops::Range<u16>) -> Result<Vec<u8>, (u8, u8)> {
        let mut answer = vec![0, subindices.len() as u8];
        for subindex in subindices {
            let (format, bytes) = self.values.get(&(axis, pnu, subindex)).ok_or((3, subindex as u8))?;
            answer[0] = format.0;
            answer.extend(bytes);
        }
        Ok(answer)
    }

    fn change(
        &mut self,
        axis: u8,
        pnu: u16,
        subindices: std::ops::Range<u16>,
        format: Format,
        bytes: &[u8],
    ) -> Result<Vec<u8>, (u8, u8)> {
        if pnu == 100 && bytes > &3000_u16.to_be_bytes()[..] {
            return Err((2, 0));
        }
        let size = format.size().expect("a known format");
        for (subindex, bytes) in subindices.zip(bytes.chunks(size)) {
            self.values.insert((axis, pnu, subindex), (format, bytes.to_vec()));
        }
        Ok(vec![0x40, 0])
    }
}

impl Device {
    pub fn with_parameters(values: &[(u8, u16, u16, Format, &[u8])]) -> Self {
        let mut device = Self::default();
        let entries =
            values.iter().map(|(axis, pnu, sub, format, bytes)| ((*axis, *pnu, *sub), (*format, bytes.to_vec())));
        device.drive.values.extend(entries);
        device
    }
}

impl RecordClient for Device {
    type Error = PnioStatus;

    fn read_record(&mut self, address: RecordAddress, buffer: &mut [u8]) -> Result<usize, Error<PnioStatus>> {
        let data = match address.index {
            LOCAL | GLOBAL if self.drive.delay > 0 => {
                self.drive.delay -= 1;
                return if self.drive.is_empty { Ok(0) } else { Err(Error::Client(STATE_CONFLICT)) };
            }
            LOCAL | GLOBAL => &self.drive.response,
            _ => self.records.get(&address).ok_or(Error::Client(INVALID_INDEX))?,
        };
        // A record that exceeds the buffer is truncated. The returned length is the length of the whole record.
        buffer.iter_mut().zip(data).for_each(|(to, from)| *to = *from);
        Ok(data.len())
    }

    fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<PnioStatus>> {
        self.writes.push((address, data.to_vec()));
        match address.index {
            LOCAL | GLOBAL => self.drive.request(data),
            _ => drop(self.records.insert(address, data.to_vec())),
        }
        Ok(())
    }

    fn is_busy(&self, error: &PnioStatus) -> bool {
        error.is_busy()
    }

    fn pause(&mut self) {
        self.pauses += 1;
    }
}

/// The device as an asynchronous client.
pub struct Async(pub Device);

impl AsyncRecordClient for Async {
    type Error = PnioStatus;

    async fn read_record(&mut self, address: RecordAddress, buffer: &mut [u8]) -> Result<usize, Error<PnioStatus>> {
        self.0.read_record(address, buffer)
    }

    async fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<PnioStatus>> {
        self.0.write_record(address, data)
    }

    fn is_busy(&self, error: &PnioStatus) -> bool {
        error.is_busy()
    }

    async fn pause(&mut self) {
        self.0.pause();
    }
}

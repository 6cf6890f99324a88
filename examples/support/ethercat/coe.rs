//! The SDO server of the mailbox (ETG.1000.6 5.6.2): expedited, normal and segmented transfers, and complete
//! access.

use lexibus::{AbortCode, Emergency};

use super::objects::Dictionary;

/// Lengths in bytes: the mailbox and CoE headers together, and the start of a transfer.
const HEADERS: usize = 8;
const INITIATE: usize = 16;

/// A segmented transfer in progress.
enum Transfer {
    Up { rest: Vec<u8>, toggle: bool },
    Down { index: u16, sub_index: u8, complete: bool, size: usize, data: Vec<u8>, toggle: bool },
}

/// The state of the server between two messages.
#[derive(Default)]
pub struct Server {
    transfer: Option<Transfer>,
    counter: u8,
}

impl Server {
    /// Returns the response to a message. The response has at most `room` bytes. Returns `None` if the message is not
    /// an SDO request.
    pub fn answer(&mut self, message: &[u8], room: usize, objects: &mut dyn Dictionary) -> Option<Vec<u8>> {
        let length = usize::from(u16::from_le_bytes([*message.first()?, *message.get(1)?]));
        let body = message.get(6..6 + length)?;
        if message[5] & 0x0F != 3 || body.get(1)? >> 4 != 2 {
            return None;
        }
        let sdo = body.get(2..)?;
        let (index, sub_index) = (u16::from_le_bytes([*sdo.get(1)?, *sdo.get(2)?]), *sdo.get(3)?);
        let done = match sdo[0] >> 5 {
            0 => self.download_segment(sdo, objects),
            1 => self.download(sdo, objects),
            2 => self.upload(sdo[0] & 0x10 != 0, index, sub_index, room, objects),
            3 => self.upload_segment(sdo[0] & 0x10 != 0, room),
            _ => Err(AbortCode::COMMAND.0),
        };
        let [low, high] = index.to_le_bytes();
        Some(match done {
            Ok(sdo) => self.message(3, &sdo),
            Err(code) => {
                self.transfer = None;
                let code = code.to_le_bytes();
                self.message(2, &[0x80, low, high, sub_index, code[0], code[1], code[2], code[3]])
            }
        })
    }

    /// Returns a CoE message.
    fn message(&mut self, service: u8, sdo: &[u8]) -> Vec<u8> {
        self.counter = self.counter % 7 + 1;
        let mut bytes = ((sdo.len() + 2) as u16).to_le_bytes().to_vec();
        bytes.extend([0, 0, 0, 3 | self.counter << 4, 0, service << 4]);
        bytes.extend(sdo);
        bytes
    }

    /// Returns an emergency message.
    pub fn emergency(&mut self, emergency: Emergency) -> Vec<u8> {
        self.message(1, &emergency.to_bytes())
    }

    fn upload(
        &mut self,
        complete: bool,
        index: u16,
        sub_index: u8,
        room: usize,
        objects: &mut dyn Dictionary,
    ) -> Result<Vec<u8>, u32> {
        let value = if complete { read_all(objects, index, sub_index)? } else { objects.read(index, sub_index)? };
        let command = 0x40 | u8::from(complete) << 4;
        let [low, high] = index.to_le_bytes();
        if (1..=4).contains(&value.len()) {
            let mut sdo = vec![command | 0x03 | (4 - value.len() as u8) << 2, low, high, sub_index];
            sdo.extend(&value);
            sdo.resize(8, 0);
            return Ok(sdo);
        }
        let mut sdo = vec![command | 0x01, low, high, sub_index];
        sdo.extend((value.len() as u32).to_le_bytes());
        let (first, rest) = value.split_at(value.len().min(room - INITIATE));
        sdo.extend(first);
        self.transfer = (!rest.is_empty()).then(|| Transfer::Up { rest: rest.to_vec(), toggle: false });
        Ok(sdo)
    }

    fn upload_segment(&mut self, toggle: bool, room: usize) -> Result<Vec<u8>, u32> {
        let Some(Transfer::Up { rest, toggle: expected }) = &mut self.transfer else {
            return Err(AbortCode::COMMAND.0);
        };
        if *expected != toggle {
            return Err(AbortCode::TOGGLE_BIT.0);
        }
        let length = rest.len().min(room - HEADERS - 1);
        let part: Vec<u8> = rest.drain(..length).collect();
        *expected = !toggle;
        let unused = 7_usize.saturating_sub(length) as u8;
        let mut sdo = vec![u8::from(toggle) << 4 | unused << 1 | u8::from(rest.is_empty())];
        sdo.extend(part);
        sdo.resize(sdo.len().max(8), 0);
        Ok(sdo)
    }

    fn download(&mut self, sdo: &[u8], objects: &mut dyn Dictionary) -> Result<Vec<u8>, u32> {
        let [command, low, high, sub_index, ref value @ ..] = *sdo else { return Err(AbortCode::COMMAND.0) };
        let (index, complete) = (u16::from_le_bytes([low, high]), command & 0x10 != 0);
        let answer = vec![0x60 | command & 0x10, low, high, sub_index, 0, 0, 0, 0];
        if command & 0x02 != 0 {
            let size = if command & 0x01 != 0 { 4 - usize::from(command >> 2 & 3) } else { 4 };
            store(objects, index, sub_index, complete, value.get(..size).ok_or(AbortCode::COMMAND.0)?)?;
            return Ok(answer);
        }
        let (size, first) = value.split_first_chunk().ok_or(AbortCode::COMMAND.0)?;
        let size = u32::from_le_bytes(*size) as usize;
        if first.len() < size {
            let data = first.to_vec();
            self.transfer = Some(Transfer::Down { index, sub_index, complete, size, data, toggle: false });
        } else {
            store(objects, index, sub_index, complete, &first[..size])?;
        }
        Ok(answer)
    }

    fn download_segment(&mut self, sdo: &[u8], objects: &mut dyn Dictionary) -> Result<Vec<u8>, u32> {
        let Some(Transfer::Down { index, sub_index, complete, size, data, toggle }) = &mut self.transfer else {
            return Err(AbortCode::COMMAND.0);
        };
        let (command, bytes) = sdo.split_first().ok_or(AbortCode::COMMAND.0)?;
        if *toggle != (command & 0x10 != 0) {
            return Err(AbortCode::TOGGLE_BIT.0);
        }
        let unused = if bytes.len() == 7 { usize::from(command >> 1 & 7) } else { 0 };
        data.extend(&bytes[..bytes.len() - unused]);
        *toggle = !*toggle;
        if command & 1 != 0 {
            if data.len() != *size {
                return Err(AbortCode::LENGTH.0);
            }
            store(objects, *index, *sub_index, *complete, data)?;
            self.transfer = None;
        }
        Ok(vec![0x20 | command & 0x10, 0, 0, 0, 0, 0, 0, 0])
    }
}

fn store(objects: &mut dyn Dictionary, index: u16, sub_index: u8, complete: bool, data: &[u8]) -> Result<(), u32> {
    if complete {
        write_all(objects, index, sub_index, data)
    } else {
        objects.write(index, sub_index, data)
    }
}

/// Reads all entries from sub-index `from` for complete access. Sub-index 0 occupies two bytes.
fn read_all(objects: &mut dyn Dictionary, index: u16, from: u8) -> Result<Vec<u8>, u32> {
    let last = *objects.read(index, 0)?.first().ok_or(AbortCode::GENERAL.0)?;
    let mut all = Vec::new();
    for sub_index in from..=last {
        all.extend(objects.read(index, sub_index)?);
        if sub_index == 0 {
            all.push(0);
        }
    }
    Ok(all)
}

/// Writes all entries of a list for complete access. First sets the count in sub-index 0 to 0, and finally to its
/// value.
fn write_all(objects: &mut dyn Dictionary, index: u16, from: u8, data: &[u8]) -> Result<(), u32> {
    if from != 0 {
        return Err(AbortCode::UNSUPPORTED_ACCESS.0);
    }
    let (count, rest) = data.split_first_chunk::<2>().ok_or(AbortCode::TOO_SHORT.0)?;
    let width = rest.len().checked_div(usize::from(count[0])).unwrap_or(0);
    objects.write(index, 0, &[0])?;
    for (entry, sub_index) in rest.chunks_exact(width.max(1)).zip(1..) {
        objects.write(index, sub_index, entry)?;
    }
    objects.write(index, 0, &count[..1])
}

//! The same program as `generated` without Lexibus. The frames are handwritten.

#![no_std]
#![no_main]

fn read<const N: usize>(index: u16, sub_index: u8) -> Result<[u8; N], ()> {
    let reply = no_std::exchange(&no_std::request(0x40, index, sub_index, &[]));
    let expected = 0x43 | (4 - N as u8) << 2;
    match reply[4..].first_chunk() {
        Some(data) if reply[0] == expected => Ok(*data),
        _ => Err(()),
    }
}

fn write(index: u16, sub_index: u8, data: &[u8]) -> Result<(), ()> {
    let unused = 4_u8.saturating_sub(data.len() as u8);
    let reply = no_std::exchange(&no_std::request(0x23 | unused << 2, index, sub_index, data));
    if reply[0] == 0x60 {
        Ok(())
    } else {
        Err(())
    }
}

fn move_to(position: i32) -> Result<bool, ()> {
    write(0x6060, 0, &[1])?;
    write(0x607A, 0, &position.to_le_bytes())?;
    let statusword = u16::from_le_bytes(read(0x6041, 0)?);
    Ok(statusword & 8 != 0)
}

fn main() -> u8 {
    match move_to(100_000) {
        Ok(false) => 0,
        Ok(true) => 1,
        Err(()) => 2,
    }
}

no_std::entry!(main);

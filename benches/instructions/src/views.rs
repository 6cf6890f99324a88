//! Generated functions that read and write single fields of a process image, each paired with a handwritten function.

use lexibus::LengthError;
use lexibus_instructions::hand::{self, frame_mut, part};
use lexibus_instructions::{axis, station};

use axis::image;
use station::submodules::standard_telegram_3 as telegram;

/// Function pairs for a byte-aligned number.
mod whole_bytes {
    use super::*;

    pair!(get, image,
        ours (data: &[u8] = &image[..14]) -> Result<i32, LengthError> {
            Ok(image::OutputsView::new(data)?.set_points().target_velocity())
        }
        hand (data: &[u8] = &image[..14]) -> Result<i32, LengthError> {
            Ok(i32::from_le_bytes(part(hand::frame::<14>(data)?, 8)))
        }
        same (left, right) left == right);

    pair!(set, image,
        ours (data: &mut [u8] = &mut image[..14]) -> Result<&[u8], LengthError> {
            let mut view = image::OutputsView::new(&mut *data)?;
            view.set_points_mut().set_target_velocity(-2);
            Ok(data)
        }
        hand (data: &mut [u8] = &mut image[..14]) -> Result<&[u8], LengthError> {
            frame_mut::<14>(data)?[8..12].copy_from_slice(&(-2_i32).to_le_bytes());
            Ok(data)
        }
        same (left, right) left == right);
}

/// Function pairs for a number that is not byte-aligned, in the second PDO of an image.
mod odd_bits {
    use super::*;

    pair!(get, image,
        ours (data: &[u8] = &image[..18]) -> Result<i32, LengthError> {
            Ok(image::InputsView::new(data)?.actual_values().position())
        }
        hand (data: &[u8] = &image[..18]) -> Result<i32, LengthError> {
            Ok((u64::from_le_bytes(part(hand::frame::<18>(data)?, 8)) >> 4) as i32)
        }
        same (left, right) left == right);

    pair!(set, image,
        ours (data: &mut [u8] = &mut image[..18]) -> Result<&[u8], LengthError> {
            let mut view = image::InputsView::new(&mut *data)?;
            view.actual_values_mut().set_position(-2);
            Ok(data)
        }
        hand (data: &mut [u8] = &mut image[..18]) -> Result<&[u8], LengthError> {
            let frame = frame_mut::<18>(data)?;
            let word = u64::from_le_bytes(part(frame, 8)) & !0xF_FFFF_FFF0 | 0xF_FFFF_FFE0;
            frame[8..16].copy_from_slice(&word.to_le_bytes());
            Ok(data)
        }
        same (left, right) left == right);
}

/// Function pairs for a single bit.
mod one_bit {
    use super::*;

    pair!(get, image,
        ours (data: &[u8] = &image[..18]) -> Result<bool, LengthError> {
            Ok(image::InputsView::new(data)?.encoder().overflow())
        }
        hand (data: &[u8] = &image[..18]) -> Result<bool, LengthError> {
            Ok(hand::frame::<18>(data)?[3] & 0x20 != 0)
        }
        same (left, right) left == right);

    pair!(set, image,
        ours (data: &mut [u8] = &mut image[..18]) -> Result<&[u8], LengthError> {
            let mut view = image::InputsView::new(&mut *data)?;
            view.encoder_mut().set_overflow(true);
            Ok(data)
        }
        hand (data: &mut [u8] = &mut image[..18]) -> Result<&[u8], LengthError> {
            frame_mut::<18>(data)?[3] |= 0x20;
            Ok(data)
        }
        same (left, right) left == right);
}

/// Function pairs for big-endian fields of a submodule.
mod profinet {
    use super::*;

    pair!(get, data,
        ours (data: &[u8] = &data[..18]) -> Result<u32, LengthError> {
            Ok(telegram::InputsView::new(data)?.g1_xist1())
        }
        hand (data: &[u8] = &data[..18]) -> Result<u32, LengthError> {
            Ok(u32::from_be_bytes(part(hand::frame::<18>(data)?, 10)))
        }
        same (left, right) left == right);

    pair!(set, data,
        ours (data: &mut [u8] = &mut data[..10]) -> Result<&[u8], LengthError> {
            let mut view = telegram::OutputsMut::new(data)?;
            view.set_enable_set_point(true);
            view.set_nsoll_b(-2);
            Ok(data)
        }
        hand (data: &mut [u8] = &mut data[..10]) -> Result<&[u8], LengthError> {
            let frame = frame_mut::<10>(data)?;
            frame[1] |= 0x40;
            frame[2..6].copy_from_slice(&(-2_i32).to_be_bytes());
            Ok(data)
        }
        same (left, right) left == right);
}

list! {
    whole_bytes: get, set;
    odd_bits: get, set;
    one_bit: get, set;
    profinet: get, set;
}

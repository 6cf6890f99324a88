//! Generated functions that pack and unpack the structs of frames, each paired with a handwritten function.

use lexibus::LengthError;
use lexibus_drives::{demo_drive as demo, vector_step};
use lexibus_instructions::{axis, hand, station};

/// For each pair of a generated and a handwritten struct, declares a module with the function pairs `pack` and
/// `unpack`. The expression after `same` compares the two structs.
macro_rules! frames {
    ($($name:ident: $length:literal, $ours:ty, $hand:ty, same |$left:ident, $right:ident| $same:expr;)*) => {$(
        /// Function pairs that pack and unpack the struct.
        mod $name {
            #[allow(unused_imports)]
            use super::*;

            fn ours(frame: &[u8]) -> $ours {
                <$ours>::unpack(frame).unwrap()
            }

            fn hand(frame: &[u8]) -> $hand {
                <$hand>::unpack(frame).unwrap()
            }

            fn same($left: $ours, $right: $hand) -> bool {
                $same
            }

            pair!(pack, frame,
                ours (value: &$ours = &super::ours(frame)) -> [u8; $length] { value.pack() }
                hand (value: &$hand = &super::hand(frame)) -> [u8; $length] { value.pack() }
                same (left, right) left == right);
            pair!(unpack, frame,
                ours (data: &[u8] = &frame[..$length]) -> Result<$ours, LengthError> { <$ours>::unpack(data) }
                hand (data: &[u8] = &frame[..$length]) -> Result<$hand, LengthError> { <$hand>::unpack(data) }
                same (left, right) same(left.unwrap(), right.unwrap()));
        }
    )*

        list! { $($name: pack, unpack;)* }
    };
}

frames! {
    demo_rx_pdo_2: 6, demo::pdo::RxPdo2, hand::WordAndLong,
        same |ours, hand| (ours.controlword.raw(), ours.target_position) == (hand.word, hand.long);
    demo_tx_pdo_2: 6, demo::pdo::TxPdo2, hand::WordAndLong,
        same |ours, hand| (ours.statusword.raw(), ours.position_actual_value) == (hand.word, hand.long);
    vector_step_rx_pdo_1: 3, vector_step::pdo::RxPdo1, hand::WordAndMode,
        same |ours, hand| (ours.controlword.raw(), ours.modes_of_operation.raw()) == (hand.word, hand.mode.raw());
    vector_step_rx_pdo_2: 6, vector_step::pdo::RxPdo2, hand::WordAndLong,
        same |ours, hand| (ours.controlword.raw(), ours.target_position) == (hand.word, hand.long);
    vector_step_tx_pdo_1: 3, vector_step::pdo::TxPdo1, hand::WordAndMode,
        same |ours, hand| (ours.statusword.raw(), ours.modes_of_operation_display.raw()) == (hand.word, hand.mode.raw());
    vector_step_tx_pdo_2: 6, vector_step::pdo::TxPdo2, hand::WordAndLong,
        same |ours, hand| (ours.statusword.raw(), ours.position_actual_value) == (hand.word, hand.long);
    eight_bytes: 8, axis::pdo::DriveStatus, hand::Full,
        same |ours, hand| (ours.statusword.raw(), ours.position, ours.torque) == (hand.word, hand.long, hand.short);
    odd_bits: 6, axis::pdo::Encoder, hand::Encoder, same |ours, hand| hand == from_encoder(ours);
    long_whole_bytes: 14, axis::pdo::SetPoints, hand::SetPoints,
        same |ours, hand| hand == hand::SetPoints {
            controlword: ours.controlword.raw(),
            mode: hand::AxisMode::from_raw(ours.modes_of_operation.raw()),
            position: ours.target_position,
            velocity: ours.target_velocity,
            torque: ours.torque_offset,
        };
    long_odd_bits: 12, axis::pdo::ActualValues, hand::ActualValues, same |ours, hand| hand == from_actual_values(ours);
    several_pdos: 18, axis::image::Inputs, hand::Image,
        same |ours, hand| {
            hand.encoder == from_encoder(ours.encoder)
                && hand.actual_values == from_actual_values(ours.actual_values)
        };
    profinet_inputs: 18, station::submodules::standard_telegram_3::Inputs, hand::Inputs,
        same |ours, hand| hand == hand::Inputs {
            control_requested: ours.control_requested,
            ready_to_switch_on: ours.ready_to_switch_on,
            operation_enabled: ours.operation_enabled,
            fault: ours.fault,
            speed: ours.nist_b,
            status_2: ours.zsw2,
            encoder_status: ours.g1_zsw,
            position_1: ours.g1_xist1,
            position_2: ours.g1_xist2,
        };
    profinet_outputs: 10, station::submodules::standard_telegram_3::Outputs, hand::Outputs,
        same |ours, hand| hand == hand::Outputs {
            control_by_plc: ours.control_by_plc,
            on: ours.on,
            no_coast_stop: ours.no_coast_stop,
            no_quick_stop: ours.no_quick_stop,
            enable_operation: ours.enable_operation,
            enable_ramp: ours.enable_ramp_generator,
            unfreeze_ramp: ours.unfreeze_ramp_generator,
            enable_set_point: ours.enable_set_point,
            speed: ours.nsoll_b,
            control_2: ours.stw2,
            encoder_control: ours.g1_stw,
        };
}

fn from_encoder(ours: axis::pdo::Encoder) -> hand::Encoder {
    hand::Encoder {
        ready: ours.ready,
        mode: hand::Mode::from_raw(ours.mode.raw()),
        referenced: ours.referenced,
        position: ours.position.get(),
        overflow: ours.overflow,
        quality: ours.quality.get(),
        speed: ours.speed,
    }
}

fn from_actual_values(ours: axis::pdo::ActualValues) -> hand::ActualValues {
    hand::ActualValues {
        statusword: ours.statusword.raw(),
        limit: ours.limit,
        mode: hand::Mode::from_raw(ours.mode.raw()),
        position: ours.position,
        velocity: ours.velocity,
        current: ours.current.get(),
    }
}

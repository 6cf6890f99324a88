//! Unpacks arbitrary bytes as the process data of each drive. Packing must give the same bytes, except that padding
//! bits become 0.
#![no_main]

use lexibus_drives::{akd, demo_drive, eco, vector_step};

macro_rules! process_data {
    ($data:ident $($name:path)*) => { $({
        use $name as Layout;
        // In `ones`, all bits that belong to fields are set, and all padding bits are 0.
        let ones = Layout::unpack(&[0xFF; Layout::LEN]).expect("so many bytes").pack();
        match Layout::unpack($data) {
            Ok(fields) => {
                let bytes = fields.pack();
                assert!(bytes.iter().zip(ones).zip($data).all(|((byte, ones), data)| *byte == data & ones));
                let again = Layout::unpack(&bytes).expect("so many bytes");
                assert_eq!(again.pack(), bytes);
                assert_eq!(format!("{again:?}"), format!("{fields:?}"));
            }
            Err(_) => assert!($data.len() < Layout::LEN, "{} of {}", $data.len(), stringify!($name)),
        }
    })* };
}

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    process_data!(data
        demo_drive::pdo::RxPdo1 demo_drive::pdo::RxPdo2 demo_drive::pdo::TxPdo1 demo_drive::pdo::TxPdo2
        vector_step::pdo::RxPdo1 vector_step::pdo::RxPdo2 vector_step::pdo::TxPdo1 vector_step::pdo::TxPdo2
        eco::pdo::InterpolatedPosition eco::pdo::Mode eco::pdo::Position eco::pdo::Velocity eco::pdo::Status
        eco::pdo::ModeDisplay eco::pdo::ActualPosition eco::pdo::ActualVelocity eco::image::Outputs eco::image::Inputs
        akd::pdo::RxPdo1701 akd::pdo::RxPdo1702 akd::pdo::RxPdo1703 akd::pdo::RxPdo1720 akd::pdo::RxPdo1721
        akd::pdo::RxPdo1722 akd::pdo::RxPdo1723 akd::pdo::RxPdo1724 akd::pdo::TxPdo1B01 akd::pdo::TxPdo1B02
        akd::pdo::TxPdo1B20 akd::pdo::TxPdo1B21 akd::pdo::TxPdo1B22 akd::pdo::TxPdo1B23 akd::pdo::TxPdo1B24
        akd::pdo::RxPdo1600 akd::pdo::TxPdo1A00 akd::image::Outputs akd::image::Inputs
    );
});

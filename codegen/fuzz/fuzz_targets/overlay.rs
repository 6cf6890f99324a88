//! Any bytes, given as a table that corrects a description of each format.
#![no_main]

use lexibus_codegen_fuzz::overlaid;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    overlaid("pump.eds", include_str!("../../../docs/examples/pump.eds"), bytes);
    overlaid("coupler.xml", include_str!("../../../tests/data/coupler.esi.xml"), bytes);
    overlaid("drive.xml", include_str!("../../../tests/data/heads.gsdml.xml"), bytes);
});

//! Compiles a description with arbitrary bytes as an overlay.
#![no_main]

use lexibus_codegen_fuzz::overlaid;

const DESCRIPTIONS: [(&str, &str); 3] = [
    ("pump.eds", include_str!("../../../docs/examples/pump.eds")),
    ("coupler.xml", include_str!("../../../tests/data/coupler.esi.xml")),
    ("drive.xml", include_str!("../../../tests/data/heads.gsdml.xml")),
];

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    // The number of bytes selects the description. Each run compiles only one description, because compiling is slow.
    let (name, description) = DESCRIPTIONS[bytes.len() % DESCRIPTIONS.len()];
    overlaid(name, description, bytes);
});

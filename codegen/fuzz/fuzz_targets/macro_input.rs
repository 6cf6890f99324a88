//! Any text, given between the parentheses of `dictionary!`; what its options say is generated.
#![no_main]

// The macro itself can't be called from a program. What it reads can: the files that a call names aren't opened here.
#[allow(dead_code)]
#[path = "../../../macros/src/call.rs"]
mod call;

use lexibus_codegen::compile::check;
use lexibus_codegen::source::Source;

const DEMO: &str = include_str!("../../../dictionaries/demo-drive.eds");

libfuzzer_sys::fuzz_target!(|text: &str| {
    let Ok(tokens) = text.parse::<proc_macro2::TokenStream>() else { return };
    match syn::parse2::<call::Call>(tokens) {
        Ok(call) => {
            let compilation = check(Source::new(call.path.value(), DEMO.into()), &call.options);
            // Text that is no Rust is the macro's error, not its panic.
            let _ = compilation.rust(&call.options.rust).map(|text| text.parse::<proc_macro2::TokenStream>());
        }
        Err(error) => drop(error.to_compile_error()),
    }
});

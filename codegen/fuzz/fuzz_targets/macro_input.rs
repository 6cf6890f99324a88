//! Parses arbitrary text as the arguments of `dictionary!` and generates code with the resulting options.
#![no_main]

// The target calls the parser of the macro, because a program cannot call the macro itself. The target does not open
// files that the arguments name.
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
            // Ignore the result: options such as `runtime` accept any text, so the generated code may be invalid Rust.
            let _ = compilation.rust(&call.options.rust).map(|text| text.parse::<proc_macro2::TokenStream>());
        }
        Err(error) => drop(error.to_compile_error()),
    }
});

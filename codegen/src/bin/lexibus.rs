//! The `lexibus` command line.

use std::process::ExitCode;

fn main() -> ExitCode {
    lexibus_codegen::cli::main()
}

//! Code generated for another version of the interface.

const _: () = lexibus::interface::assert_version(lexibus::interface::VERSION + 1);

fn main() {}

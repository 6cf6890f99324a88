//! Code that was generated for another version of the runtime's interface.

const _: () = lexibus::interface::assert_version(lexibus::interface::VERSION + 1);

fn main() {}

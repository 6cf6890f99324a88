fn main() -> Result<(), lexibus_codegen::BuildError> {
    lexibus_codegen::Builder::new().table(lexibus_codegen::Presence::Always).compile("pump.eds")
}

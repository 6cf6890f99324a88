//! Tests that the Rust code contains the operations of CiA 402 only for devices that have the necessary objects.

use crate::compile_support;
use crate::form_support;

use compile_support::{compile, document};
use form_support::canonical;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;

/// Returns an EDS of a drive that contains the additional sections `more`.
fn drive(name: &str, more: &str) -> String {
    format!(
        "[DeviceInfo]\nProductName={name}\n\
         [1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\nDefaultValue=0x00020192\n\
         [6040]\nParameterName=Control\nDataType=6\nAccessType=rww\nPDOMapping=1\n\
         [6041]\nParameterName=Status\nDataType=6\nAccessType=ro\nPDOMapping=1\n\
         [6060]\nParameterName=Mode\nDataType=2\nAccessType=wo\n{more}"
    )
}

const ACTIVE_MODE: &str = "[6061]\nParameterName=Active mode\nDataType=2\nAccessType=ro\n";

fn bindings(text: &str, options: &Options) -> String {
    let compilation = check(Source::new("x.eds", text.as_bytes().to_vec()), options);
    compilation.rust(&options.rust).expect("bindings")
}

/// Returns the names of the CiA 402 traits that the type of the device implements.
fn traits(text: &str) -> Vec<&str> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("impl<B: rt::Bus> rt::cia402::"));
    lines.filter_map(|line| line.split_once("<B> for ")).map(|(name, _)| name).collect()
}

#[test]
fn the_traits_of_a_device() {
    let options = Options::default();
    let of = |more: &str| bindings(&drive("Drive", more), &options);
    // Without the object of the active mode (0x6061), the driver cannot confirm a mode change, so the device gets no trait.
    assert_eq!(traits(&of("")), [""; 0]);
    assert!(!of("").contains("cia402"));
    assert_eq!(traits(&of(ACTIVE_MODE)), ["Objects"]);
    let position = "[607A]\nParameterName=Position\nDataType=4\nAccessType=rw\n";
    assert_eq!(traits(&of(&format!("{ACTIVE_MODE}{position}"))), ["Objects", "Positioning"]);
    // A position that is read-only or has 64 bits can't be used.
    let read_only = position.replace("rw", "ro");
    let wide = position.replace("DataType=4", "DataType=0x15");
    assert_eq!(traits(&of(&format!("{ACTIVE_MODE}{read_only}"))), ["Objects"]);
    assert_eq!(traits(&of(&format!("{ACTIVE_MODE}{wide}"))), ["Objects"]);
    let others = "[60FF]\nParameterName=Velocity\nDataType=3\nAccessType=rww\n\
                  [6098]\nParameterName=Method\nDataType=2\nAccessType=wo\n\
                  [603F]\nParameterName=Code\nDataType=6\nAccessType=ro\n\
                  [60F4]\nParameterName=Lag\nDataType=4\nAccessType=ro\n";
    let text = of(&format!("{ACTIVE_MODE}{others}"));
    assert_eq!(traits(&text), ["Objects", "Velocity", "Homing"]);
    assert!(text.contains("change of the mode, velocities and homing."), "{text}");
    assert!(text.contains("fn error_code()") && text.contains("fn following_error()"));
    assert!(!of(ACTIVE_MODE).contains("fn error_code()"));
}

#[test]
fn devices_without_the_profile() {
    let text = drive("Drive", ACTIVE_MODE);
    assert!(!bindings(&text, &Options { no_profiles: true, ..Options::default() }).contains("cia402"));
    // If the controlword is write-only, the driver cannot read the bits that it must keep, so the device gets no trait.
    let text = text.replace("AccessType=rww", "AccessType=wo");
    assert!(!bindings(&text, &Options::default()).contains("cia402"));
    // Without accessors, the code contains no type for the device.
    let mut options = Options::default();
    options.rust.accessors = false;
    assert!(!bindings(&drive("Drive", ACTIVE_MODE), &options).contains("cia402"));
}

#[test]
fn the_code_compiles_and_has_the_form_of_prettyplease() {
    let all = format!(
        "{ACTIVE_MODE}\
         [607A]\nParameterName=Position\nDataType=4\nAccessType=rw\nLowLimit=-5\nHighLimit=5\n\
         [60FF]\nParameterName=Velocity\nDataType=3\nAccessType=rww\n\
         [6098]\nParameterName=cia402\nDataType=5\nAccessType=rw\n\
         [603F]\nParameterName=Code\nDataType=6\nAccessType=ro\n\
         [60F4]\nParameterName=Lag\nDataType=3\nAccessType=ro\n"
    );
    // If the name exceeds a certain length, the lines of the code must be broken. These names are close to this length.
    for length in 36..44 {
        let text = bindings(&drive(&"N".repeat(length), &all), &Options::default());
        assert_eq!(canonical("a name near the margin", &text), Ok(()));
    }
    for name in ["Drive", "A drive with a name that is so long that the lines of its code have to be broken"] {
        let text = bindings(&drive(name, &all), &Options::default());
        // An object has the name `cia402`, so the method for the profile gets an underscore.
        assert!(text.contains("pub fn cia402(&mut self) -> objects::"), "{text}");
        assert!(text.contains("pub fn cia402_(") && text.contains("-> rt::cia402::Drive<"), "{text}");
        assert_eq!(canonical(name, &text), Ok(()));
        compile(name, &text).unwrap_or_else(|message| panic!("{message}"));
        document(name, &[&text]).unwrap_or_else(|message| panic!("{message}"));
    }
}

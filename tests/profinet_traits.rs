//! Traits of other crates reach the types that a GSDML file becomes, byte strings of any length included.

use std::path::Path;
use std::process::Command;

/// A submodule with 40 octets, single bits, an enumeration, a time and a record.
const XML: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<ISO15745Profile xmlns="http://www.profibus.com/GSDML/2003/11/DeviceProfile"><ProfileBody>
<DeviceIdentity VendorID="0x1" DeviceID="0x2"><InfoText TextId="T"/><VendorName Value="Example"/></DeviceIdentity>
<DeviceFunction><Family MainFamily="I/O" ProductFamily="Example"/></DeviceFunction>
<ApplicationProcess><DeviceAccessPointList>
<DeviceAccessPointItem ID="D" PNIO_Version="V2.35" PhysicalSlots="0" FixedInSlots="0" ModuleIdentNumber="0x1"
 MinDeviceInterval="32" DNS_CompatibleName="example"><ModuleInfo><Name TextId="T"/><InfoText TextId="T"/></ModuleInfo>
<VirtualSubmoduleList><VirtualSubmoduleItem ID="S" SubmoduleIdentNumber="0x1"><IOData>
<Input><DataItem DataType="OctetString" Length="40" TextId="T"/>
<DataItem DataType="TimeOfDay with date indication" TextId="T"/></Input>
<Output><DataItem DataType="Unsigned8" UseAsBits="true" TextId="T"><BitDataItem BitOffset="3" TextId="T"/></DataItem>
<DataItem DataType="Float64" TextId="T"/></Output></IOData>
<RecordDataList><ParameterRecordDataItem Index="1" Length="50"><Name TextId="T"/>
<Ref ID="R" ValueItemTarget="V" DataType="BitArea" ByteOffset="0" BitLength="3" DefaultValue="0" TextId="T"/>
<Ref ID="Q" DataType="VisibleString" Length="40" ByteOffset="1" DefaultValue="name" TextId="T"/>
</ParameterRecordDataItem></RecordDataList><ModuleInfo><Name TextId="T"/><InfoText TextId="T"/></ModuleInfo>
</VirtualSubmoduleItem></VirtualSubmoduleList></DeviceAccessPointItem></DeviceAccessPointList>
<ValueList><ValueItem ID="V"><Assignments><Assign TextId="T" Content="0"/></Assignments></ValueItem></ValueList>
<ExternalTextList><PrimaryLanguage><Text TextId="T" Value="Thing"/></PrimaryLanguage></ExternalTextList>
</ApplicationProcess></ProfileBody></ISO15745Profile>
"#;

/// A value of the long record through `serde` and back, in a format of the test's own: what matters is that it
/// compiles.
const CODE: &str = "//! A thing.
lexibus::dictionary! {
    pub mod thing = \"thing.gsdml.xml\" { serde: true, defmt: true, allow: \"warnings\" }
}
use thing::submodules::thing::{Inputs, Outputs, ThingRecord};
fn both<T: serde::Serialize + for<'d> serde::Deserialize<'d> + defmt::Format>() {}
/// Every struct has the traits.
pub fn all() {
    both::<Inputs>();
    both::<Outputs>();
    both::<ThingRecord>();
    both::<thing::values::V>();
}
";

#[test]
fn serde_and_defmt() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("profinet-traits");
    std::fs::create_dir_all(folder.join("src")).expect("a folder for temporary files");
    let manifest = format!(
        "[package]\nname = \"profinet-traits\"\nversion = \"0.1.0\"\nedition = \"2021\"\n[workspace]\n[dependencies]\n\
         lexibus = {{ path = {root:?}, features = [\"macros\", \"serde\", \"defmt\"] }}\n\
         serde = {{ version = \"1\", default-features = false, features = [\"derive\"] }}\ndefmt = \"1\"\n"
    );
    for (name, text) in [("Cargo.toml", manifest.as_str()), ("thing.gsdml.xml", XML), ("src/lib.rs", CODE)] {
        std::fs::write(folder.join(name), text).expect("a temporary file");
    }
    // The workspace's versions, so that nothing is fetched anew.
    std::fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).expect("the workspace's Cargo.lock");
    let output = Command::new(env!("CARGO"))
        .args(["check", "--quiet"])
        .current_dir(&folder)
        .env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("drive-crate"))
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

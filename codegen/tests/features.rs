//! Tests that reading a file causes an error if its format needs a disabled feature. The error must name the feature. The
//! part `features` of `tests/full.sh` runs these tests without the features. If all features are enabled, the tests check
//! that this error does not occur.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::source::Source;

const TABLE: &str = "lexibus = 1\n[device]\nname = \"Axis\"\nbuses = [\"canopen\"]\n[[chapters]]\n[chapters.objects]\n\
                     0x1000 = { name = \"Device type\", type = \"u32\", access = \"ro\" }\n";

/// For each format: the feature that reads it, the start of a file, and whether the feature is enabled.
const FORMATS: [(&str, &str, bool); 6] = [
    ("eds", "[DeviceInfo]\nProductName=Pump\n", cfg!(feature = "eds")),
    ("xdd", "<ISO15745ProfileContainer/>", cfg!(feature = "xdd")),
    ("esi", "<EtherCATInfo/>", cfg!(feature = "esi")),
    ("gsdml", "<ISO15745Profile><!-- GSDML-DeviceProfile --></ISO15745Profile>", cfg!(feature = "gsdml")),
    ("table", TABLE, cfg!(feature = "table")),
    (
        "messages",
        "lexibus = 1\n[device]\nname = \"Axis\"\n[[messages]]\nname = \"Stop\"\nrequest = [{ bytes = [1] }]\n",
        cfg!(feature = "messages") || !cfg!(feature = "table"),
    ),
];

fn compiled(text: &str, options: &Options) -> Compilation {
    check(Source::new("device", text.into()), options)
}

/// Returns whether an error states that the compiler was built without the feature. Asserts that the help of this error
/// explains how to enable the feature.
fn names_feature(compilation: &Compilation, feature: &str) -> bool {
    let mut list = compilation.diagnostics.list().iter();
    let Some(found) = list.find(|found| found.message.contains(&format!("was built without the feature `{feature}`")))
    else {
        return false;
    };
    assert!(compilation.diagnostics.has_errors(), "{feature}");
    assert!(found.help.as_deref().is_some_and(|help| help.contains(&format!("features = [\"{feature}\"]"))));
    true
}

#[test]
fn a_format_whose_feature_is_off_is_an_error_that_names_it() {
    for (feature, text, is_on) in FORMATS {
        let compilation = compiled(text, &Options::default());
        assert_eq!(names_feature(&compilation, feature), !is_on, "{feature}");
        assert!(is_on || compilation.rust(&Options::default().rust).is_none(), "{feature}");
    }
}

#[cfg(feature = "table")]
#[test]
fn a_register_table_needs_no_further_feature() {
    let compilation = compiled(TABLE, &Options::default());
    assert!(!compilation.diagnostics.has_errors());
    assert!(compilation.rust(&Options::default().rust).is_some_and(|text| text.contains("device_type")));
}

#[cfg(feature = "eds")]
mod eds {
    use lexibus_codegen::ir::{Fact, FactOrigin};

    use super::*;

    const EDS: &str = "[DeviceInfo]\nProductName=Drive\n\
        [1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\nDefaultValue=0x00020192\n\
        [6040]\nParameterName=Control\nDataType=6\nAccessType=rww\n\
        [6041]\nParameterName=Status\nDataType=6\nAccessType=ro\n\
        [6060]\nParameterName=Mode\nDataType=5\nAccessType=rw\n\
        [60F2]\nParameterName=Positioning\nDataType=6\nAccessType=rw\n\
        [6077]\nParameterName=Torque\nDataType=3\nAccessType=ro\n";

    #[test]
    fn an_overlay_needs_the_feature_of_register_tables() {
        let overlay = "lexibus = 1\n[overlay]\nwhy = \"manual\"\n[[chapters]]\n[chapters.objects]\n0x6077 = { doc = \"Torque\" }\n";
        let overlays = vec![Source::new("overlay.toml", overlay.into())];
        let compilation = compiled(EDS, &Options { overlays, ..Options::default() });
        assert_eq!(names_feature(&compilation, "table"), !cfg!(feature = "table"));
        assert_eq!(compilation.is_usable(), cfg!(feature = "table"));
    }

    /// Profiles must also add names of bits and values, units, state machines and codes if all other features are
    /// disabled.
    #[test]
    fn profiles_apply_to_every_format() {
        let compilation = compiled(EDS, &Options::default());
        assert!(!compilation.diagnostics.has_errors());
        let device = &compilation.catalog.as_ref().expect("a catalog").devices[0];
        let types: Vec<&str> = device.types.iter().map(|definition| definition.name.as_str()).collect();
        assert_eq!(
            types,
            [
                "Controlword",
                "Statusword",
                "ModesOfOperationU8",
                "PositioningOption relative to",
                "PositioningOption rotary axis direction",
                "PositioningOption",
                "DeviceType"
            ]
        );
        let torque = device.entry(0x6077, 0).expect("an item");
        assert_eq!(torque.quantity.as_ref().expect("a unit").unit, "%");
        assert_eq!(torque.origins.get(Fact::Unit), Some(&FactOrigin::Standard("CiA 402, 17.3.7".into())));
        assert_eq!((device.machines.len(), device.code_tables.len()), (1, 2));
    }
}

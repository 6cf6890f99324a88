//! A format whose feature is off is an error that names the feature. With all features there is nothing to test: the part `features` of
//! `tests/full.sh` runs this without them.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;

/// The start of a file of each format, by the feature that reads it, and whether the feature is on.
const FORMATS: [(&str, &str, bool); 4] = [
    ("eds", "[DeviceInfo]\nProductName=Pump\n", cfg!(feature = "eds")),
    ("xdd", "<ISO15745ProfileContainer/>", cfg!(feature = "xdd")),
    ("esi", "<EtherCATInfo/>", cfg!(feature = "esi")),
    ("gsdml", "<ISO15745Profile><!-- GSDML-DeviceProfile --></ISO15745Profile>", cfg!(feature = "gsdml")),
];

#[test]
fn a_format_whose_feature_is_off_is_an_error_that_names_it() {
    for (feature, text, is_on) in FORMATS {
        let compilation = check(Source::new("device", text.into()), &Options::default());
        let found =
            compilation.diagnostics.list().iter().find(|found| found.message.contains("was built without the feature"));
        assert_eq!(found.is_none(), is_on, "{feature}");
        if let Some(found) = found {
            assert!(compilation.diagnostics.has_errors() && compilation.catalog.is_none(), "{feature}");
            assert!(found.message.contains(&format!("`{feature}`")), "{}", found.message);
            assert!(found.help.as_deref().is_some_and(|help| help.contains(&format!("features = [\"{feature}\"]"))));
        }
    }
}

/// Register tables need no feature, nor do the profiles that complete them.
#[test]
fn register_tables_are_always_read() {
    let table = "lexibus = 1\n[device]\nname = \"Axis\"\nbuses = [\"canopen\"]\n[[chapters]]\n[chapters.objects]\n\
                 0x1000 = { name = \"Device type\", type = \"u32\", access = \"ro\" }\n";
    let compilation = check(Source::new("axis.toml", table.into()), &Options::default());
    assert!(!compilation.diagnostics.has_errors());
    assert!(compilation.rust(&Options::default().rust).is_some_and(|text| text.contains("device_type")));
}

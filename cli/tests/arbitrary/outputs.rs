//! Creates all outputs of a compilation except Rust.

use lexibus_codegen::compile::Compilation;
use lexibus_codegen::ir::Device;
use lexibus_export::esi::{Export, Refusal};
use lexibus_export::{eds, esi, gsdml, json, sii};
use lexibus_site::{Format, Page, Site};

/// The outputs of all back ends except Rust.
pub struct Outputs {
    pub html: Vec<Page>,
    pub markdown: Vec<Page>,
    /// The catalog as JSON text.
    pub dump: String,
    /// EDS and DCF files, each with the position of its device in the catalog.
    pub eds: Vec<(usize, String)>,
    pub esi: Option<String>,
    pub gsdml: Option<String>,
}

/// Runs all back ends except Rust.
pub fn others(compilation: &Compilation) -> Outputs {
    json::info(compilation);
    let mut outputs = Outputs {
        html: site(Format::Html, compilation),
        markdown: site(Format::Markdown, compilation),
        dump: String::new(),
        eds: Vec::new(),
        esi: None,
        gsdml: None,
    };
    let Some(catalog) = &compilation.catalog else { return outputs };
    outputs.dump = json::dump(catalog);
    for flavor in [eds::Flavor::Eds, eds::Flavor::Dcf] {
        let devices = catalog.devices.iter().enumerate();
        let export = |(at, device)| Some((at, eds::export(catalog, device, flavor)?.text));
        outputs.eds.extend(devices.filter_map(export));
    }
    outputs.esi = completed(|options| esi::export(catalog, options), esi::Options::set);
    catalog.devices.iter().for_each(image);
    outputs.gsdml = completed(|options| gsdml::export(catalog, options), gsdml::Options::set);
    outputs
}

/// Checks the length of a device's EEPROM image.
fn image(device: &Device) {
    let mut options = sii::Options::default();
    for (key, value) in [("vendor-id", "1"), ("product-code", "1"), ("config-data", "01"), ("eeprom-size", "524288")] {
        options.set(key, value).expect("an option");
    }
    let eeprom = device.ethercat.as_ref().and_then(|settings| settings.eeprom.as_ref());
    let declared = eeprom.map(|eeprom| eeprom.data.len()).filter(|length| *length > 0);
    match sii::export(device, &options) {
        Ok(image) => assert_eq!(image.bytes.len(), declared.unwrap_or(524_288)),
        Err(Refusal::Nothing | Refusal::TooLong { .. }) => {}
        Err(missing) => panic!("{missing}"),
    }
}

fn site(format: Format, compilation: &Compilation) -> Vec<Page> {
    let mut site = Site::new(format);
    let mut pages = site.add_compilation("arbitrary", compilation);
    pages.extend(site.finish());
    pages
}

/// Exports a catalog. Sets an option for each required fact that the catalog does not contain. Returns `None` if there
/// is nothing to export.
fn completed<O: Default>(
    export: impl Fn(&O) -> Result<Export, Refusal>,
    set: impl Fn(&mut O, &str, &str) -> Result<(), String>,
) -> Option<String> {
    let mut options = O::default();
    if let Err(Refusal::Missing(facts)) = export(&options) {
        for fact in facts {
            let is_set = ["1", "true"].iter().any(|value| set(&mut options, fact.key, value).is_ok());
            assert!(is_set, "`{}` accepts neither a number nor a truth value", fact.key);
        }
    }
    match export(&options) {
        Ok(export) => Some(export.text),
        Err(Refusal::Nothing) => None,
        Err(missing) => panic!("{missing}"),
    }
}

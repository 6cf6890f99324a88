//! Writes the file with its header, identity and lists.

use lexibus_codegen::ir::{Catalog, CompactString, Format, ProfileHeader};

use super::super::note::Subject;
use super::super::options::MissingFacts;
use super::super::xml::Xml;
use super::context::Context;
use super::options::TrackedOptions;
use super::texts::TextList;
use super::{device, diagnosis, image, module, submodule, values};
use super::{Export, NoteKind, Options, Refusal};

/// Schema version of the file if the source does not declare one.
const VERSION: &str = "2.35";

/// Exports all device access points of `catalog` or, if the source is not a GSDML, a new device access point for each
/// device with process images. The encoding is UTF-8. Save the file under the name that [`file_name`] returns.
///
/// # Errors
///
/// Returns [`Refusal::Nothing`] if there is nothing to export, and [`Refusal::Missing`] if the schema requires facts that neither
/// the source nor the options contain.
pub fn export(catalog: &Catalog, options: &Options) -> Result<Export, Refusal> {
    let options = &TrackedOptions::new(options);
    // Mark the option `date` as used, because the file name contains the date even if the content of the file does not.
    options.date();
    let (mut xml, mut missing) = (Xml::new(), MissingFacts::new(Options::KEYS));
    let from_images = match is_gsdml(catalog) {
        true => None,
        false => Some(image::catalog(catalog, options, &mut xml.notes, &mut missing).ok_or(Refusal::Nothing)?),
    };
    let catalog = from_images.as_ref().unwrap_or(catalog);
    if catalog.devices.is_empty() && catalog.modules.is_empty() && catalog.submodules.is_empty() {
        return Err(Refusal::Nothing);
    }
    let texts = TextList::new(&catalog.unused_texts);
    let mut context = Context {
        catalog,
        options,
        types: &catalog.types,
        missing,
        texts,
        pluggable_ports: submodule::pluggable_ports(catalog),
        is_gsdml: from_images.is_none(),
    };
    root(&mut xml, &mut context);
    options.note_unused(&mut xml.notes);
    context.missing.finish(xml)
}

/// Returns the required file name without extension: schema version, vendor, family and date. If the options contain no
/// date, returns the file name of a GSDML source, provided that it begins with `GSDML-V`. Returns `None` if the date,
/// vendor or family is missing.
pub fn file_name(catalog: &Catalog, options: &Options) -> Option<String> {
    let source = catalog.files.first().filter(|_| is_gsdml(catalog));
    let stem = source.and_then(|file| {
        let name = lexibus_codegen::text::file_name(&file.name);
        name.strip_suffix(".xml").or_else(|| name.strip_suffix(".XML"))
    });
    if let (Some(stem), None) = (stem.filter(|stem| stem.starts_with("GSDML-V")), &options.date) {
        return Some(stem.to_owned());
    }
    let date = options.date.as_ref()?;
    let device = catalog.devices.first();
    let vendor =
        options.vendor_name.as_deref().or_else(|| device.map(|device| device.identity.vendor_name.as_str()))?;
    let family = options.product_family.as_deref().or_else(|| device.map(|device| device.name.as_str()))?;
    // Replace hyphens and other special characters within a part, because a hyphen separates the parts of the file
    // name.
    let part = |text: &str| -> String {
        let is_safe = |letter: char| letter.is_ascii_alphanumeric() || matches!(letter, '_' | '.' | '+');
        text.trim().chars().map(|letter| if is_safe(letter) { letter } else { '_' }).collect()
    };
    Some(format!("GSDML-V{}-{}-{}-{}", version(catalog), part(vendor), part(family), part(date)))
}

fn is_gsdml(catalog: &Catalog) -> bool {
    catalog.files.first().is_some_and(|file| file.format == Format::Gsdml)
}

fn version(catalog: &Catalog) -> &str {
    let version = catalog.devices.first().map(|device| device.header.format_version.as_str());
    version.filter(|version| is_gsdml(catalog) && !version.is_empty()).unwrap_or(VERSION)
}

fn root(xml: &mut Xml, context: &mut Context<'_>) {
    const NAMESPACE: &str = "http://www.profibus.com/GSDML/2003/11/DeviceProfile";
    let version = version(context.catalog);
    xml.open("ISO15745Profile");
    xml.attribute("xmlns", NAMESPACE);
    xml.attribute("xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance");
    xml.attribute("xsi:schemaLocation", format_args!("{NAMESPACE} ..\\xsd\\GSDML-DeviceProfile-v{version}.xsd"));
    profile_header(xml, context.catalog);
    xml.open("ProfileBody");
    identity(xml, context);
    xml.open("ApplicationProcess");
    process(xml, context);
    let texts = std::mem::take(&mut context.texts);
    texts.write(xml);
    lost(xml, context.catalog);
}

/// Writes the header (ISO 15745-1). Elements that the source does not have get their usual content.
fn profile_header(xml: &mut Xml, catalog: &Catalog) {
    let none = ProfileHeader::default();
    let header = catalog.profile_header.as_deref().unwrap_or(&none);
    let or = |text: &CompactString, usual: &'static str| match text.is_empty() {
        true => CompactString::const_new(usual),
        false => text.clone(),
    };
    xml.open("ProfileHeader");
    xml.leaf("ProfileIdentification", or(&header.identification, "PROFINET Device Profile"));
    xml.leaf("ProfileRevision", or(&header.revision, "1.00"));
    xml.leaf("ProfileName", or(&header.name, "Device Profile for PROFINET Devices"));
    xml.leaf("ProfileSource", or(&header.source, "PROFIBUS Nutzerorganisation e. V. (PNO)"));
    xml.leaf("ProfileClassID", or(&header.class, "Device"));
    xml.text_leaf("ProfileDate", &header.date);
    xml.text_leaf("AdditionalInformation", &header.additional_information);
    xml.open("ISO15745Reference");
    xml.leaf("ISO15745Part", or(&header.iso_part, "4"));
    xml.leaf("ISO15745Edition", or(&header.iso_edition, "1"));
    xml.leaf("ProfileTechnology", or(&header.technology, "GSDML"));
    xml.close();
    xml.close();
}

/// Writes the DeviceIdentity and DeviceFunction elements.
fn identity(xml: &mut Xml, context: &mut Context<'_>) {
    let (catalog, options) = (context.catalog, context.options);
    let none = Default::default();
    let device = catalog.devices.first().unwrap_or(&none);
    let number_of_source =
        |number: Option<u32>| number.and_then(|number| u16::try_from(number).ok()).filter(|_| context.is_gsdml);
    let (vendor, number) =
        (number_of_source(device.identity.vendor_id), number_of_source(device.identity.product_code));
    let name = Some(device.identity.vendor_name.to_string()).filter(|name| context.is_gsdml || !name.is_empty());
    let text = Some(device.header.description.to_string()).filter(|text| context.is_gsdml || !text.is_empty());
    let family = device.profinet.as_ref().map(|settings| &settings.family);
    let main = family.map(|(main, _)| main.to_string()).filter(|main| context.is_gsdml || !main.is_empty());
    let product = family.map(|(_, product)| product.to_string()).filter(|product| !product.is_empty());
    xml.open("DeviceIdentity");
    let vendor = context.missing.require(options.vendor_id().or(vendor), "vendor-id");
    xml.attribute("VendorID", format_args!("0x{vendor:04X}"));
    let number = context.missing.require(options.device_id().or(number), "device-id");
    xml.attribute("DeviceID", format_args!("0x{number:04X}"));
    let text = context.missing.require(options.description().or(text), "description");
    context.texts.text(xml, "InfoText", &text, &catalog.descriptions);
    let name = context.missing.require(options.vendor_name().or(name), "vendor-name");
    xml.empty("VendorName", &[("Value", &name)]);
    xml.close();
    xml.open("DeviceFunction");
    xml.open("Family");
    let main = context.missing.require(options.main_family().or(main), "main-family");
    xml.attribute("MainFamily", main);
    xml.optional("ProductFamily", options.product_family().or(product));
    xml.close();
    xml.close();
}

fn process(xml: &mut Xml, context: &mut Context<'_>) {
    let catalog = context.catalog;
    xml.open("DeviceAccessPointList");
    catalog.devices.iter().for_each(|device| device::write(xml, context, device));
    xml.close();
    xml.list("ModuleList", &catalog.modules, |xml, module| module::write(xml, context, module));
    submodule::pluggable(xml, context);
    values::write(xml, context);
    diagnosis::write(xml, context, catalog);
    xml.list("GraphicsList", &catalog.graphics, |xml, graphic| {
        xml.empty("GraphicItem", &[("ID", &graphic.id), ("GraphicFile", &graphic.file)]);
    });
    xml.list("CategoryList", &catalog.families, |xml, family| category(xml, context, family));
}

fn category(xml: &mut Xml, context: &mut Context<'_>, family: &lexibus_codegen::ir::Family) {
    xml.open("CategoryItem");
    xml.attribute("ID", &family.id);
    xml.attribute("TextId", context.texts.id(&family.name, &family.names));
    if let Some((first, others)) = family.descriptions.split_first() {
        let translations = others.iter().cloned().collect();
        context.texts.text(xml, "InfoText", &first.text, &translations);
    }
    xml.close();
}

/// Adds notes for the extensions, vendor names, URLs and code tables of the catalog that the file does not contain.
fn lost(xml: &mut Xml, catalog: &Catalog) {
    let lost = catalog.extensions.len() + catalog.vendor_names.len() + catalog.vendor_urls.len();
    xml.notes.add_many(NoteKind::Extension, lost, Subject::Device);
    let tables = catalog.code_tables.iter().filter(|table| !diagnosis::is_list(&table.name)).count();
    xml.notes.add_many(NoteKind::OtherPart, tables, Subject::Device);
}

//! Header of a file: file name, schema version, vendor, and family of devices.

use std::sync::Arc;

use super::reader::Reader;
use super::resolve::Resolver;
use crate::diagnostics::{codes, Diagnostics};
use crate::frontend::xml::Read;
use crate::ir::{Catalog, CompactString, Documentation};
use crate::source::{FileId, Span};
use crate::syntax::xml::Tag;

/// Maximum number of text bytes in a header that are copied to each device without reducing the budget for copies.
const MAX_FREE_TEXTS: usize = 1024;

/// Facts that apply to all devices of a file.
#[derive(Default)]
pub(super) struct Header {
    vendor_id: Option<u32>,
    vendor_name: CompactString,
    device_id: Option<u32>,
    /// Placeholder for the description of the device family; see `resolve`.
    description: Option<Arc<Documentation>>,
    family: (CompactString, CompactString),
    /// Version of the GSDML schema, and the span of the version.
    version: Option<(CompactString, Span)>,
}

impl Header {
    /// Reads the schema version from the schema location in the root element.
    pub fn root(&mut self, reader: &mut Reader<'_, '_>, root: &Tag<'_>) -> Read<()> {
        let Some(location) = root.attribute("schemaLocation")? else { return Ok(()) };
        let text = location.value(reader.diagnostics);
        if let Some(version) = version_in(crate::text::file_name(&text)) {
            self.version = Some((version.into(), location.span));
        }
        Ok(())
    }

    /// Reads a `DeviceIdentity` element.
    pub fn identity<'a>(&mut self, reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<()> {
        let [vendor, device] = reader.attributes(tag, ["VendorID", "DeviceID"])?;
        for (given, name) in [(&vendor, "VendorID"), (&device, "DeviceID")] {
            reader.require(tag, given, name, "the devices are read without this ID");
        }
        self.vendor_id = reader.ident(&vendor, u16::MAX.into(), "vendor ID");
        self.device_id = reader.ident(&device, u16::MAX.into(), "device ID");
        while let Some(child) = reader.child(tag)? {
            match child.name {
                "InfoText" => self.description = reader.documentation(&child)?,
                "VendorName" => self.vendor_name = reader.single(&child, "Value")?.compact(),
                _ => reader.unknown(&child)?,
            }
        }
        Ok(())
    }

    /// Reads the `Family` child of a `DeviceFunction` element.
    pub fn family<'a>(&mut self, reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<()> {
        let [main, product] = reader.attributes(tag, ["MainFamily", "ProductFamily"])?;
        self.family = (main.compact(), product.compact());
        reader.no_children(tag)
    }

    /// Adds the facts in the header to every device.
    pub fn apply(mut self, catalog: &mut Catalog, resolver: &mut Resolver<'_, '_>) {
        resolver.documentation(&mut self.description);
        let description = Documentation::text_of(self.description.as_deref());
        let version = self.version.as_ref().map_or_else(CompactString::default, |(text, _)| text.clone());
        let family = self.family.0.len() + self.family.1.len();
        let weight = self.vendor_name.len() + description.len() + family + version.len();
        for device in &mut catalog.devices {
            let identity = &mut device.identity;
            (identity.vendor_id, identity.product_code) = (self.vendor_id, self.device_id);
            if weight > MAX_FREE_TEXTS && !resolver.spend(weight, device.origin.span) {
                continue;
            }
            let of_device = std::mem::replace(&mut identity.vendor_name, self.vendor_name.clone());
            identity.product_name = device.name.clone();
            device.header.description = description.into();
            device.header.format_version = version.clone();
            let Some(settings) = &mut device.profinet else { continue };
            settings.device_id = self.device_id.and_then(|id| u16::try_from(id).ok()).unwrap_or(0);
            settings.family = self.family.clone();
            if !of_device.is_empty() && of_device != device.identity.vendor_name {
                settings.attributes.push(("ModuleInfo/VendorName".into(), of_device));
            }
        }
        if let Some(documentation) = self.description {
            catalog.descriptions.clone_from(&documentation.translations);
        }
    }

    /// Reports a file name that violates the naming rule or contradicts the schema version.
    pub fn check_file_name(&self, name: &str, file: FileId, diagnostics: &mut Diagnostics) {
        if !diagnostics.wants(&codes::GSDML_FILE_NAME) {
            return;
        }
        let name = crate::text::file_name(name);
        let Some(named) = version_of_name(name) else {
            let message = format!("`{name}` is not a GSDML file name");
            let help = "rename the file to the form `GSDML-V2.35-Vendor-Device-20200131.xml`, optionally with `-hhmmss` after \
                        the date";
            diagnostics.push(codes::GSDML_FILE_NAME.at(Span::new(file, 0, 0), message).help(help));
            return;
        };
        if let Some((version, span)) = &self.version {
            if version != named {
                let message = format!("the file name has version {named}, but the schema has version {version}");
                diagnostics.push(codes::GSDML_FILE_NAME.at(*span, message).label("this version is used"));
            }
        }
    }
}

/// Returns the version in a schema name such as `GSDML-DeviceProfile-v2.35.xsd`.
fn version_in(name: &str) -> Option<&str> {
    let (_, rest) = name.rsplit_once(['-', '_'])?;
    let version = rest.strip_prefix(['v', 'V'])?.strip_suffix(".xsd").or(rest.strip_prefix(['v', 'V']))?;
    is_version(version).then_some(version)
}

fn is_version(text: &str) -> bool {
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    text.split_once('.').is_some_and(|(major, minor)| digits(major) && digits(minor))
}

/// Returns the version in a file name that follows the naming rule.
fn version_of_name(name: &str) -> Option<&str> {
    let rest = name.strip_prefix("GSDML-V")?;
    let rest = rest.strip_suffix(".xml").or_else(|| rest.strip_suffix(".XML"))?;
    let (version, rest) = rest.split_once('-')?;
    let digits = |text: &str, count| text.len() == count && text.bytes().all(|byte| byte.is_ascii_digit());
    // The last part of the name is the date, or the time after the date.
    let (front, last) = rest.rsplit_once('-')?;
    let front = match (digits(last, 8), front.rsplit_once('-')) {
        (true, _) => front,
        (false, Some((front, date))) if digits(last, 6) && digits(date, 8) => front,
        _ => return None,
    };
    // The vendor and the device are separate parts of the name.
    let named = front.split_once('-').is_some_and(|(vendor, device)| !vendor.is_empty() && !device.is_empty());
    (is_version(version) && named).then_some(version)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files() {
        for (name, version) in [
            ("GSDML-V2.35-Maker-Drive-20200131.xml", Some("2.35")),
            ("GSDML-V2.25-#Maker-Drive one-20200131-235959.xml", Some("2.25")),
            ("GSDML-V2.3-A-B-C-20200131.xml", Some("2.3")),
            ("gsdml-v2.35-maker-drive-20200131.xml", None),
            ("GSDML-V2.35-Maker-20200131.xml", None),
            ("GSDML-V2.35-Maker-Drive-2020013.xml", None),
            ("GSDML-V2-Maker-Drive-20200131.xml", None),
            ("gsdml.xml", None),
        ] {
            assert_eq!(version_of_name(name), version, "{name}");
        }
        assert_eq!(version_in("GSDML-DeviceProfile-v2.35.xsd"), Some("2.35"));
        assert_eq!(version_in("GSDML-DeviceProfile.xsd"), None);
    }
}

//! Reads the parameters for functional safety (PROFIsafe).

use super::number;
use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::ir::{FParameter, FParameters, Submodule};
use crate::syntax::xml::Tag;

/// PROFIsafe parameter as the GSDML schema defines it.
struct Known {
    name: &'static str,
    /// True if a record must contain the parameter.
    required: bool,
    default: &'static str,
    allowed: &'static str,
    changeable: bool,
    visible: bool,
    /// Named values and their numbers in the record; empty if the values are numbers.
    labels: &'static [(&'static str, i128)],
}

const fn known(name: &'static str, default: &'static str, allowed: &'static str, changeable: bool) -> Known {
    Known { name, required: true, default, allowed, changeable, visible: true, labels: &[] }
}

impl Known {
    const fn optional(self) -> Self {
        Known { required: false, ..self }
    }

    const fn hidden(self) -> Self {
        Known { visible: false, ..self }
    }

    const fn labels(self, labels: &'static [(&'static str, i128)]) -> Self {
        Known { labels, ..self }
    }
}

/// Parameters in the order of the schema, with their default values.
static KNOWN: [Known; 12] = [
    known("F_Check_iPar", "NoCheck", "Check NoCheck", false).hidden().labels(&[("NoCheck", 0), ("Check", 1)]),
    known("F_SIL", "SIL3", "SIL1 SIL2 SIL3 NoSIL", true).labels(&[("SIL1", 0), ("SIL2", 1), ("SIL3", 2), ("NoSIL", 3)]),
    known("F_CRC_Length", "3-Byte-CRC", "3-Byte-CRC", false).hidden().labels(&[
        ("3-Byte-CRC", 0),
        ("2-Byte-CRC", 1),
        ("4-Byte-CRC", 2),
    ]),
    // GSDML defines a single value for `F_CRC_Seed`, which is a cleared bit in the record. The checksums that vendors
    // declare for their default values are correct only if the bit is cleared.
    known("F_CRC_Seed", "CRC-Seed24/32", "CRC-Seed24/32", false).optional().labels(&[("CRC-Seed24/32", 0)]),
    known("F_Passivation", "Device/Module", "Device/Module", false)
        .optional()
        .labels(&[("Device/Module", 0), ("Channel", 1)]),
    known("F_Block_ID", "0", "0..7", false),
    known("F_Par_Version", "1", "1", false),
    known("F_Source_Add", "1", "1..65534", true),
    known("F_Dest_Add", "1", "1..65534", true),
    known("F_WD_Time", "150", "1..65535", true),
    known("F_Par_CRC", "53356", "0..65535", true),
    known("F_iPar_CRC", "0", "0..4294967295", true).optional(),
];

impl<'a> Reader<'a, '_> {
    /// Reads an `F_ParameterRecordDataItem` element.
    pub fn f_record(&mut self, parent: &Tag<'a>, submodule: &mut Submodule) -> Read<()> {
        let origin = self.origin(parent);
        let names = ["Index", "TransferSequence", "F_ParamDescCRC", "F_SupportedParameters", "ChangeableWithBump"];
        let fields = self.attributes(parent, names)?;
        let [index, sequence, crc, supported, bump] = fields;
        submodule.attributes.extend(supported.attribute("F_ParameterRecordDataItem@F_SupportedParameters"));
        submodule.attributes.extend(bump.attribute("F_ParameterRecordDataItem@ChangeableWithBump"));
        self.require(parent, &index, "Index", "read as 0");
        let mut found = FParameters {
            index: self.unsigned16(&index, "record index").unwrap_or(0),
            transfer_sequence: self.unsigned16(&sequence, "transfer sequence").unwrap_or(0),
            description_crc: self.unsigned16(&crc, "16-bit checksum"),
            parameters: Vec::new(),
            origin,
        };
        while let Some(tag) = self.child(parent)? {
            match KNOWN.iter().find(|known| known.name == tag.name) {
                Some(known) => found.parameters.push(self.f_parameter(&tag, known)?),
                None => self.unknown(&tag)?,
            }
        }
        self.add_missing(parent, &mut found.parameters);
        if submodule.f_parameters.is_some() {
            let message = "a submodule can have only one F-parameter record";
            self.report(&codes::DUPLICATE_ID, parent.span, message, "replaces the previous record");
        }
        submodule.f_parameters = Some(Box::new(found));
        Ok(())
    }

    /// Reports the mandatory parameters that the file omits, and adds them with their default values. Sorts all
    /// parameters in the order of the schema.
    fn add_missing(&mut self, tag: &Tag<'a>, parameters: &mut Vec<FParameter>) {
        for known in KNOWN.iter().filter(|known| known.required) {
            if !parameters.iter().any(|parameter| parameter.name == known.name) {
                self.missing(tag, known.name, "added with the default of the schema");
                parameters.push(by_schema(known));
            }
        }
        let position = |parameter: &FParameter| KNOWN.iter().position(|known| known.name == parameter.name);
        parameters.sort_by_key(position);
    }

    fn f_parameter(&mut self, tag: &Tag<'a>, known: &Known) -> Read<FParameter> {
        let names = ["DefaultValue", "AllowedValues", "Changeable", "Visible"];
        let [default, allowed, changeable, visible] = self.attributes(tag, names)?;
        let mut parameter = by_schema(known);
        if !default.is_missing() {
            self.f_default(&default, known, &mut parameter);
        }
        if !allowed.is_missing() {
            self.f_allowed(&allowed, known, &mut parameter);
        }
        parameter.changeable = self.flag_or(&changeable, known.changeable);
        parameter.visible = self.flag_or(&visible, known.visible);
        self.no_children(tag)?;
        Ok(parameter)
    }

    fn f_default(&mut self, given: &Given<'a>, known: &Known, parameter: &mut FParameter) {
        if known.labels.is_empty() {
            match self.unsigned(given, u32::MAX, "F-parameter value") {
                Some(value) => parameter.default = value.into(),
                None => parameter.label = given.text.as_ref().into(),
            }
            return;
        }
        parameter.label = given.text.as_ref().into();
        match known.labels.iter().find(|(label, _)| *label == given.text) {
            Some(&(_, number)) => parameter.default = number,
            None => self.bad(given, "F-parameter value", "kept as text; read as the default number of the schema"),
        }
    }

    fn f_allowed(&mut self, given: &Given<'a>, known: &Known, parameter: &mut FParameter) {
        if known.labels.is_empty() {
            let ranges = number::wide_ranges(&given.text);
            match ranges {
                Some(ranges) => parameter.allowed = ranges,
                None => self.bad(given, "list of numbers and ranges", "the values of the schema are used"),
            }
            return;
        }
        parameter.allowed_labels = given.text.split_ascii_whitespace().map(Into::into).collect();
        let is_known = |label: &str| known.labels.iter().any(|(known, _)| *known == label);
        if !given.text.split_ascii_whitespace().all(is_known) {
            self.bad(given, "list of F-parameter values", "kept unchanged");
        }
    }
}

/// Returns a parameter with the values that the schema defines.
fn by_schema(known: &Known) -> FParameter {
    let mut parameter = FParameter {
        name: known.name.into(),
        changeable: known.changeable,
        visible: known.visible,
        ..FParameter::default()
    };
    match known.labels.iter().find(|(label, _)| *label == known.default) {
        Some(&(label, number)) => {
            (parameter.label, parameter.default) = (label.into(), number);
            parameter.allowed_labels = known.allowed.split(' ').map(Into::into).collect();
        }
        None => {
            parameter.default = known.default.parse().unwrap_or(0);
            parameter.allowed = number::wide_ranges(known.allowed).unwrap_or_default();
        }
    }
    parameter
}

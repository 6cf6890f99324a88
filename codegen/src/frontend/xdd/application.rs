//! The application process: parameters, parameter templates and what they are made of.
//!
//! Everything here is only collected. Values are converted where an object refers to a parameter, because its data type
//! may stand with the object.

use std::collections::HashMap;

use super::reader::{note, Given, Read, Reader, Texts};
use super::types::{self, RawType, TypeRef};
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{CompactString, Device, Extension, Extensions, LocalText};
use crate::source::Span;
use crate::syntax::xml::Tag;
use crate::text::brief;

/// How many characters of a group's label its parameters remember.
const MAX_GROUP_LABEL: usize = 128;

/// Positions of elements by their uniqueID.
pub(super) type Ids = HashMap<String, usize>;

#[derive(Default)]
pub(super) struct Application<'a> {
    /// Parameters, and variables of structures, to which sub-objects may refer as well.
    pub parameters: Vec<Parameter<'a>>,
    pub templates: Vec<Parameter<'a>>,
    pub allowed_templates: Vec<Allowed<'a>>,
    pub types: Vec<RawType<'a>>,
    parameter_ids: Ids,
    template_ids: Ids,
    allowed_ids: Ids,
    pub type_ids: Ids,
    /// Groups of parameters: the uniqueIDRef and the label of the innermost group.
    grouped: Vec<(Given<'a>, LocalText)>,
}

/// A parameter, a parameterTemplate or a varDeclaration.
#[derive(Default)]
pub(super) struct Parameter<'a> {
    pub template: Option<Given<'a>>,
    pub access: Option<Given<'a>>,
    /// Whether the source has a default for the access: a variable hasn't.
    pub is_variable: bool,
    pub support: Option<Given<'a>>,
    pub persistent: Option<Given<'a>>,
    pub offset: Option<Given<'a>>,
    pub multiplier: Option<Given<'a>>,
    pub texts: Texts,
    pub denotation: Option<Box<Texts>>,
    pub ty: Option<TypeRef<'a>>,
    pub default: Option<Given<'a>>,
    pub actual: Option<Given<'a>>,
    pub allowed: Option<Box<Allowed<'a>>>,
    pub unit: Option<Box<Unit<'a>>>,
    pub extensions: Extensions,
    /// Length of its element, which bounds what copies of it may cost.
    pub weight: usize,
    /// The structure and field, where it is a variable of one.
    pub field: Option<(usize, usize)>,
}

/// allowedValues or allowedValuesTemplate.
#[derive(Default)]
pub(super) struct Allowed<'a> {
    pub template: Option<Given<'a>>,
    pub values: Vec<(Given<'a>, Texts)>,
    pub ranges: Vec<AllowedRange<'a>>,
    /// Length of its element.
    pub weight: usize,
}

#[derive(Default)]
pub(super) struct AllowedRange<'a> {
    pub low: Option<Given<'a>>,
    pub high: Option<Given<'a>>,
    pub step: Option<Given<'a>>,
}

#[derive(Default)]
pub(super) struct Unit<'a> {
    pub multiplier: Option<Given<'a>>,
    pub uri: Option<Given<'a>>,
    pub texts: Texts,
}

/// A parameter with the template it refers to; the parameter's own facts count first.
#[derive(Clone, Copy)]
pub(super) struct View<'p, 'a> {
    /// Position of the parameter.
    pub position: Option<usize>,
    own: Option<&'p Parameter<'a>>,
    template: Option<&'p Parameter<'a>>,
}

impl<'p, 'a> View<'p, 'a> {
    /// Of an object that refers to no parameter.
    pub const NONE: View<'static, 'static> = View { position: None, own: None, template: None };

    pub fn exists(&self) -> bool {
        self.own.is_some()
    }

    pub fn own(&self) -> Option<&'p Parameter<'a>> {
        self.own
    }

    /// The first of the two that has the fact.
    pub fn find<T>(&self, fact: impl Fn(&'p Parameter<'a>) -> Option<T>) -> Option<T> {
        self.own.and_then(&fact).or_else(|| self.template.and_then(&fact))
    }

    /// The labels and descriptions, each of the first of the two that has any.
    pub fn texts(&self) -> Texts {
        let list = |of: fn(&Texts) -> &Vec<LocalText>| {
            self.find(|parameter| Some(of(&parameter.texts)).filter(|texts| !texts.is_empty()))
                .cloned()
                .unwrap_or_default()
        };
        Texts { labels: list(|texts| &texts.labels), descriptions: list(|texts| &texts.descriptions) }
    }

    pub fn extensions(&self) -> impl Iterator<Item = &'p Extension> + use<'p, 'a> {
        let of = |parameter: Option<&'p Parameter<'a>>| parameter.map_or(&[][..], |parameter| &parameter.extensions);
        of(self.own).iter().chain(of(self.template))
    }

    /// What a copy costs.
    pub fn weight(&self) -> usize {
        self.own.map_or(0, |own| own.weight) + self.template.map_or(0, |template| template.weight)
    }
}

impl<'a> Application<'a> {
    /// Reads ApplicationProcess.
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>, device: &mut Device) -> Read<()> {
        while let Some(list) = reader.cursor.child(parent)? {
            match list.name {
                "dataTypeList" => {
                    while let Some(tag) = reader.cursor.child(&list)? {
                        types::read(reader, &tag, self, device)?;
                    }
                }
                "parameterList" => {
                    while let Some(tag) = reader.cursor.child(&list)? {
                        self.parameter(reader, &tag, device)?;
                    }
                }
                "templateList" => {
                    while let Some(tag) = reader.cursor.child(&list)? {
                        self.template(reader, &tag, device)?;
                    }
                }
                "parameterGroupList" => self.groups(reader, &list, device)?,
                "functionTypeList" | "functionInstanceList" => reader.keep(&list, &mut device.extensions)?,
                _ => reader.unknown(&list, &mut device.extensions)?,
            }
        }
        self.note_groups(reader);
        Ok(())
    }

    fn parameter(&mut self, reader: &mut Reader<'a, '_>, tag: &Tag<'a>, device: &mut Device) -> Read<()> {
        if tag.name != "parameter" {
            return reader.unknown(tag, &mut device.extensions);
        }
        let (id, parameter) = read_parameter(reader, tag)?;
        insert(reader, &mut self.parameter_ids, id, self.parameters.len());
        self.parameters.push(parameter);
        Ok(())
    }

    /// A variable of a structure; its position.
    pub fn variable(&mut self, reader: &mut Reader<'a, '_>, tag: &Tag<'a>, field: (usize, usize)) -> Read<usize> {
        let (id, mut parameter) = read_parameter(reader, tag)?;
        parameter.is_variable = true;
        parameter.field = Some(field);
        let position = self.parameters.len();
        insert(reader, &mut self.parameter_ids, id, position);
        self.parameters.push(parameter);
        Ok(position)
    }

    fn template(&mut self, reader: &mut Reader<'a, '_>, tag: &Tag<'a>, device: &mut Device) -> Read<()> {
        match tag.name {
            "parameterTemplate" => {
                let (id, parameter) = read_parameter(reader, tag)?;
                insert(reader, &mut self.template_ids, id, self.templates.len());
                self.templates.push(parameter);
            }
            "allowedValuesTemplate" => {
                let id = reader.field(tag, "uniqueID")?;
                insert(reader, &mut self.allowed_ids, id, self.allowed_templates.len());
                let allowed = read_allowed(reader, tag, &mut device.extensions)?;
                self.allowed_templates.push(allowed);
            }
            _ => reader.unknown(tag, &mut device.extensions)?,
        }
        Ok(())
    }

    /// Groups may contain groups.
    fn groups(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>, device: &mut Device) -> Read<()> {
        let mut texts = Texts::default();
        let first = self.grouped.len();
        while let Some(tag) = reader.cursor.child(parent)? {
            match tag.name {
                "parameterGroup" => self.groups(reader, &tag, device)?,
                "parameterRef" => {
                    if let Some(given) = reader.field(&tag, "uniqueIDRef")? {
                        let unnamed = LocalText { language: "".into(), text: "".into() };
                        self.grouped.push((given, unnamed));
                    }
                }
                _ => {
                    if !reader.texts(&tag, &mut texts)? {
                        reader.keep(&tag, &mut device.extensions)?;
                    }
                }
            }
        }
        let label = texts.label();
        // Copied once a reference, so that a text in the place of a label can't multiply.
        let label: CompactString = label.chars().take(MAX_GROUP_LABEL).collect();
        for (_, name) in self.grouped[first..].iter_mut().filter(|(_, name)| name.text.is_empty()) {
            name.text = label.clone();
        }
        Ok(())
    }

    fn note_groups(&mut self, reader: &mut Reader<'a, '_>) {
        for (given, name) in std::mem::take(&mut self.grouped) {
            match self.parameter_ids.get(given.text.as_ref()) {
                Some(&at) if !name.text.is_empty() => {
                    let parameter = &mut self.parameters[at];
                    parameter.weight += size_of::<Extension>() + name.text.len();
                    let key = "parameterGroup".into();
                    parameter.extensions.push(Extension { key, value: name.text, span: given.span });
                }
                Some(_) => {}
                None => dangling(reader, &given, "parameter"),
            }
        }
    }

    /// The parameter to which an object refers.
    pub fn view(&self, reader: &mut Reader<'a, '_>, reference: Option<&Given<'a>>) -> View<'_, 'a> {
        let Some(given) = reference else { return View::NONE };
        let Some(&position) = self.parameter_ids.get(given.text.as_ref()) else {
            dangling(reader, given, "parameter");
            return View::NONE;
        };
        let own = &self.parameters[position];
        let template = own.template.as_ref().and_then(|given| {
            let template = self.template_ids.get(given.text.as_ref()).map(|&at| &self.templates[at]);
            if template.is_none() {
                dangling(reader, given, "parameterTemplate");
            }
            template
        });
        View { position: Some(position), own: Some(own), template }
    }

    /// The allowed values of a parameter, perhaps those of a template.
    pub fn allowed<'p>(&'p self, reader: &mut Reader<'a, '_>, allowed: &'p Allowed<'a>) -> &'p Allowed<'a> {
        let Some(given) = &allowed.template else { return allowed };
        match self.allowed_ids.get(given.text.as_ref()) {
            Some(&at) => &self.allowed_templates[at],
            None => {
                dangling(reader, given, "allowedValuesTemplate");
                allowed
            }
        }
    }
}

pub(super) fn dangling(reader: &mut Reader<'_, '_>, given: &Given<'_>, what: &str) {
    let message = format!("no {what} has the uniqueID `{}`", brief(&given.text));
    reader.diagnostics.push(Diagnostic::new(&codes::DANGLING_REFERENCE, given.span, message).label("not resolved"));
}

/// Notes the place of an element by its uniqueID; the first element of that name counts.
pub(super) fn insert(reader: &mut Reader<'_, '_>, ids: &mut Ids, id: Option<Given<'_>>, position: usize) {
    let Some(given) = id else { return };
    if ids.contains_key(given.text.as_ref()) {
        reader.bad(&given, "unique identifier: it occurs twice", "references lead to the first");
        return;
    }
    ids.insert(given.text.into_owned(), position);
}

fn read_parameter<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<(Option<Given<'a>>, Parameter<'a>)> {
    const NAMES: [&str; 10] = [
        "uniqueID",
        "templateIDRef",
        "access",
        "support",
        "persistent",
        "offset",
        "multiplier",
        "accessList",
        // Of a variable.
        "name",
        "initialValue",
    ];
    let mut parameter = Parameter::default();
    let fields = reader.fields(parent, &NAMES, &mut parameter.extensions)?;
    let [id, template, access, support, persistent, offset, multiplier, access_list, name, initial] = fields;
    note("accessList", access_list.as_ref(), &mut parameter.extensions);
    (parameter.template, parameter.access, parameter.support) = (template, access, support);
    (parameter.persistent, parameter.offset, parameter.multiplier) = (persistent, offset, multiplier);
    parameter.default = initial;
    while let Some(tag) = reader.cursor.child(parent)? {
        child(reader, &tag, &mut parameter)?;
    }
    if let (Some(name), true) = (name, parameter.texts.labels.is_empty()) {
        parameter.texts.labels.push(LocalText { language: "".into(), text: name.text.into() });
    }
    parameter.weight = reader.length(parent);
    Ok((id, parameter))
}

fn child<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, parameter: &mut Parameter<'a>) -> Read<()> {
    if let Some(ty) = types::reference(reader, tag)? {
        parameter.ty = Some(ty);
        return Ok(());
    }
    match tag.name {
        "label" | "description" => {
            reader.texts(tag, &mut parameter.texts)?;
        }
        "denotation" => {
            let mut texts = Texts::default();
            while let Some(inner) = reader.cursor.child(tag)? {
                if !reader.texts(&inner, &mut texts)? {
                    reader.unknown(&inner, &mut parameter.extensions)?;
                }
            }
            parameter.denotation = Some(Box::new(texts));
        }
        "defaultValue" => parameter.default = value(reader, tag, &mut parameter.extensions)?,
        "actualValue" => parameter.actual = value(reader, tag, &mut parameter.extensions)?,
        "substituteValue" => {
            let given = value(reader, tag, &mut parameter.extensions)?;
            note("substituteValue", given.as_ref(), &mut parameter.extensions);
        }
        "allowedValues" => {
            let allowed = read_allowed(reader, tag, &mut parameter.extensions)?;
            parameter.allowed = Some(Box::new(allowed));
        }
        "unit" => parameter.unit = Some(Box::new(unit(reader, tag, &mut parameter.extensions)?)),
        "property" => {
            let [name, given] = reader.fields(tag, &["name", "value"], &mut parameter.extensions)?;
            if let Some(name) = name {
                let (value, span) =
                    given.map_or_else(|| (Default::default(), name.span), |given| (given.text, given.span));
                let extension = Extension { key: name.text.as_ref().into(), value: value.as_ref().into(), span };
                parameter.extensions.push(extension);
            }
        }
        "conditionalSupport" | "variableRef" | "labelRef" | "descriptionRef" => {
            reader.keep(tag, &mut parameter.extensions)?;
        }
        _ => reader.unknown(tag, &mut parameter.extensions)?,
    }
    Ok(())
}

/// The `value` of defaultValue and its like; what else it says is kept.
fn value<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<Option<Given<'a>>> {
    let [given] = reader.fields(tag, &["value"], extensions)?;
    while let Some(inner) = reader.cursor.child(tag)? {
        reader.keep(&inner, extensions)?;
    }
    Ok(given)
}

fn read_allowed<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<Allowed<'a>> {
    let mut allowed = Allowed { template: reader.field(parent, "templateIDRef")?, ..Allowed::default() };
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "value" => {
                let [given] = reader.fields(&tag, &["value"], extensions)?;
                let mut texts = Texts::default();
                while let Some(inner) = reader.cursor.child(&tag)? {
                    if !reader.texts(&inner, &mut texts)? {
                        reader.keep(&inner, extensions)?;
                    }
                }
                allowed.values.extend(given.map(|given| (given, texts)));
            }
            "range" => {
                let mut range = AllowedRange::default();
                while let Some(inner) = reader.cursor.child(&tag)? {
                    match inner.name {
                        "minValue" => range.low = value(reader, &inner, extensions)?,
                        "maxValue" => range.high = value(reader, &inner, extensions)?,
                        "step" => range.step = value(reader, &inner, extensions)?,
                        _ => reader.keep(&inner, extensions)?,
                    }
                }
                allowed.ranges.push(range);
            }
            _ => reader.keep(&tag, extensions)?,
        }
    }
    allowed.weight = reader.length(parent);
    Ok(allowed)
}

fn unit<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<Unit<'a>> {
    let [multiplier, uri] = reader.fields(parent, &["multiplier", "unitURI"], extensions)?;
    let mut unit = Unit { multiplier, uri, ..Unit::default() };
    while let Some(tag) = reader.cursor.child(parent)? {
        if !reader.texts(&tag, &mut unit.texts)? {
            reader.keep(&tag, extensions)?;
        }
    }
    Ok(unit)
}

/// Where something that has no place of its own stands.
pub(super) fn span_of(given: Option<&Given<'_>>) -> Span {
    given.map_or(Span::default(), |given| given.span)
}

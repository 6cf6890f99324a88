//! Application process: parameters, parameter templates and data types by uniqueID.
//!
//! Values are converted when an object refers to their parameter, because the object may declare the data type.

use std::borrow::Cow;
use std::sync::Arc;

use super::attributes::{keys, Attributes};
use super::data_type::{RawType, TypeRef};
use super::reader::{Lang, Reader, Texts};
use crate::collections::HashMap;
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Names};
use crate::ir::{self, CompactString, Documentation, Extension, Extensions};
use crate::text::brief;

/// Positions of elements by uniqueID.
pub(super) type Ids<'a> = HashMap<Cow<'a, str>, usize>;

#[derive(Default)]
pub(super) struct Application<'a> {
    /// Parameters, and variables of structures. Sub-objects may refer to both.
    pub parameters: Vec<Parameter<'a>>,
    pub templates: Vec<Parameter<'a>>,
    pub allowed_templates: Vec<Allowed<'a>>,
    pub types: Vec<RawType<'a>>,
    pub parameter_ids: Ids<'a>,
    pub template_ids: Ids<'a>,
    pub allowed_ids: Ids<'a>,
    pub type_ids: Ids<'a>,
}

keys! {
    /// Attributes of a parameter, and child elements that contain one value. The discriminant is the position of the
    /// attribute in [`Parameter::attributes`].
    ParameterKey {
        Id = "uniqueID",
        Template = "templateIDRef",
        Access = "access",
        Support = "support",
        Persistent = "persistent",
        Offset = "offset",
        Multiplier = "multiplier",
        AccessList = "accessList",
        // Only a `varDeclaration` element has the attribute `name`.
        Name = "name",
        Default = "initialValue",
        ;
        Actual,
    }
}

/// Contents of a `parameter`, `parameterTemplate` or `varDeclaration` element.
#[derive(Default)]
pub(super) struct Parameter<'a> {
    pub attributes: Attributes<'a>,
    pub texts: Texts<'a>,
    pub denotation: Option<Box<Texts<'a>>>,
    pub ty: Option<TypeRef<'a>>,
    pub allowed: Option<Box<Allowed<'a>>>,
    pub unit: Option<Box<Unit<'a>>>,
    pub extensions: Extensions,
    /// Length of the parameter's element in bytes, which counts toward the limit for copies.
    pub weight: usize,
    /// Positions of the structure and the field, if the parameter is a variable of a structure (`varDeclaration`).
    pub field: Option<(usize, usize)>,
}

impl<'a> Parameter<'a> {
    /// Returns the attribute or value `key`, or `None` if it is missing.
    fn get(&self, key: ParameterKey) -> Option<&Given<'a>> {
        self.attributes.get(key as u8)
    }
}

/// Contents of an `allowedValues` or `allowedValuesTemplate` element.
#[derive(Default)]
pub(super) struct Allowed<'a> {
    pub template: Given<'a>,
    pub values: Vec<(Given<'a>, Texts<'a>)>,
    pub ranges: Vec<AllowedRange<'a>>,
    /// Length of the element in bytes, which counts toward the limit for copies.
    pub weight: usize,
}

#[derive(Default)]
pub(super) struct AllowedRange<'a> {
    pub low: Given<'a>,
    pub high: Given<'a>,
    pub step: Given<'a>,
}

#[derive(Default)]
pub(super) struct Unit<'a> {
    pub multiplier: Given<'a>,
    pub uri: Given<'a>,
    pub texts: Texts<'a>,
}

/// Parameter with its template. Facts of the parameter take precedence over those of the template.
#[derive(Clone, Copy)]
pub(super) struct View<'p, 'a> {
    /// Position of the parameter in [`Application::parameters`].
    pub position: Option<usize>,
    pub parameter: Option<&'p Parameter<'a>>,
    template: Option<&'p Parameter<'a>>,
}

impl<'p, 'a> View<'p, 'a> {
    /// View for an object without a parameter.
    pub const NONE: Self = View { position: None, parameter: None, template: None };

    /// Returns a fact of the parameter, or of the template if the parameter does not declare the fact.
    pub fn find<T>(&self, fact: impl Fn(&'p Parameter<'a>) -> Option<T>) -> Option<T> {
        self.parameter.and_then(&fact).or_else(|| self.template.and_then(&fact))
    }

    /// Returns an attribute or value of the parameter, or of the template if the parameter does not declare it.
    pub fn get(&self, key: ParameterKey) -> Option<&'p Given<'a>> {
        self.find(|parameter| parameter.get(key))
    }

    fn labels(&self) -> Option<&'p Names<'a, Lang>> {
        self.find(|parameter| Some(&parameter.texts.labels).filter(|labels| !labels.is_empty()))
    }

    /// Returns the label that serves as the name, or an empty string if there is no label.
    pub fn name(&self) -> CompactString {
        self.labels().map(Names::name).unwrap_or_default()
    }

    /// Returns all labels that differ from `name`.
    pub fn labels_except(&self, name: &str) -> ir::Texts {
        self.labels().map(|labels| labels.except(name)).unwrap_or_default()
    }

    /// Returns the description of the parameter, or of the template if the parameter has none.
    pub fn documentation(&self) -> Option<Arc<Documentation>> {
        self.find(|parameter| parameter.texts.documentation())
    }

    pub fn extensions(&self) -> impl Iterator<Item = &'p Extension> + use<'p, 'a> {
        let of = |parameter: Option<&'p Parameter<'a>>| parameter.map_or(&[][..], |parameter| &parameter.extensions);
        of(self.parameter).iter().chain(of(self.template))
    }

    /// Returns the cost of a copy: the length in bytes of the elements of the parameter and the template.
    pub fn weight(&self) -> usize {
        self.parameter.map_or(0, |parameter| parameter.weight) + self.template.map_or(0, |template| template.weight)
    }
}

impl<'a> Application<'a> {
    /// Returns the parameter to which an object refers, with its template. Reports an unknown parameter or template.
    pub fn view(&self, reader: &mut Reader<'a, '_>, given: Option<&Given<'a>>) -> View<'_, 'a> {
        let Some(given) = given else { return View::NONE };
        let Some(&position) = self.parameter_ids.get(given.text.as_ref()) else {
            dangling(reader, given, "parameter");
            return View::NONE;
        };
        let parameter = &self.parameters[position];
        let template = parameter.get(ParameterKey::Template).and_then(|given| {
            let template = self.template_ids.get(given.text.as_ref()).map(|&at| &self.templates[at]);
            if template.is_none() {
                dangling(reader, given, "parameterTemplate");
            }
            template
        });
        View { position: Some(position), parameter: Some(parameter), template }
    }

    /// Returns `allowed`, or the `allowedValuesTemplate` to which it refers.
    pub fn allowed<'p>(&'p self, reader: &mut Reader<'a, '_>, allowed: &'p Allowed<'a>) -> &'p Allowed<'a> {
        let given = &allowed.template;
        if given.is_missing() {
            return allowed;
        }
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
    let message = format!("the file has no {what} with the uniqueID `{}`", brief(&given.text));
    reader.report(&codes::DANGLING_REFERENCE, given.span, message, "the reference is ignored");
}

/// Registers the position of an element by uniqueID. Reports a repeated uniqueID, which then identifies the first
/// element.
pub(super) fn insert<'a>(reader: &mut Reader<'_, '_>, ids: &mut Ids<'a>, given: Given<'a>, position: usize) {
    if given.is_missing() {
        return;
    }
    if ids.contains_key(given.text.as_ref()) {
        reader.bad(&given, "uniqueID, because it occurs twice", "references resolve to the first element");
        return;
    }
    ids.insert(given.text, position);
}

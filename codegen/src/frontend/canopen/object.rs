//! Facts about an object that EDS and XDD files have in common: object type, data type, number of sub-indices.

use std::fmt::Display;

use super::deftype::defined_type;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{Access, Fact, FactOrigin, Group, Item, ObjectCode, Rule, Shape, Type, TypeDef};
use crate::number::hex16;
use crate::source::Span;
use crate::text::brief;

/// Names that a file format uses for the parts of an object.
pub struct Terms {
    /// Key for the number of sub-indices.
    pub sub_number: &'static str,
    /// Name of the section or element that describes a sub-index.
    pub sub_object: &'static str,
    /// Plural name of the sections or elements that describe sub-indices.
    pub elements: &'static str,
    /// Help text that explains how to declare objects with sub-indices.
    pub records: &'static str,
}

/// Object type as written in the file.
pub struct ObjectType<'t> {
    /// Text of the object type.
    pub text: &'t str,
    /// Object code that the text states, or `None` if the text is not the number of an object code.
    pub code: Option<ObjectCode>,
    /// Span of the object type in the file.
    pub span: Span,
}

impl ObjectType<'_> {
    /// Returns the object code of a sub-index: VAR or DOMAIN. Reports any other object type.
    pub fn of_sub_index(&self, terms: &Terms, diagnostics: &mut Diagnostics) -> ObjectCode {
        match self.code {
            Some(ObjectCode::Domain) => return ObjectCode::Domain,
            Some(ObjectCode::Var) => {}
            _ => {
                let message = format!("`{}` is not a valid object type for a {}", self.text, terms.sub_object);
                diagnostics.push(codes::UNKNOWN_OBJECT_TYPE.at(self.span, message).label("read as VAR"));
            }
        }
        ObjectCode::Var
    }
}

/// Returns the object code of the object `index`. The presence of sub-indices determines the code if the object type is
/// missing, invalid or VAR. `span` is the location of the object, for diagnostics about a missing object type.
pub fn object_code(
    index: u16,
    given: Option<&ObjectType<'_>>,
    span: Span,
    has_subs: bool,
    terms: &Terms,
    diagnostics: &mut Diagnostics,
) -> ObjectCode {
    let span = given.map_or(span, |given| given.span);
    let by_content = if has_subs { ObjectCode::Record } else { ObjectCode::Var };
    match given.map(|given| given.code) {
        Some(Some(code)) if code != ObjectCode::Var => return code,
        Some(None) => {
            let message = format!("`{}` is not a valid object type", given.map_or("", |given| given.text));
            let found = codes::UNKNOWN_OBJECT_TYPE.at(span, message);
            diagnostics.push(found.label(format!("read as {}", by_content.name())));
        }
        _ if has_subs => {
            let message = format!("object {} is a VAR, but has sub-indices", hex16(index));
            diagnostics.push(codes::VAR_WITH_SUBS.at(span, message).label("read as a RECORD").help(terms.records));
        }
        _ => {}
    }
    by_content
}

/// Returns the origin of an object code. `None` means that the file states the code, or that the object is a VAR without a stated
/// code, because VAR is the default of CiA 306.
pub fn code_origin(given: Option<&ObjectType<'_>>, code: ObjectCode) -> Option<FactOrigin> {
    let stated = given.map_or(Some(ObjectCode::Var), |given| given.code);
    (stated != Some(code)).then_some(FactOrigin::Rule(Rule::ObjectContents))
}

/// Returns the data type with the code `code`. `defined` is the type that the file defines for this code. Reports an
/// unknown code, and returns raw bytes for it.
pub fn type_by_code(code: u32, span: Span, defined: Option<Type>, diagnostics: &mut Diagnostics) -> Type {
    if let Some(ty) = Type::from_cia301(code).or(defined) {
        return ty;
    }
    let shown = hex16(code);
    let (kind, message) = match code {
        0x20..=0x23 => {
            (&codes::COMPLEX_DATA_TYPE, format!("{shown} is a record type, but a single value needs a basic type"))
        }
        0x0E | 0x17 | 0x1C..=0x1F => (&codes::COMPLEX_DATA_TYPE, format!("the data type {shown} is reserved")),
        _ => (&codes::UNKNOWN_DATA_TYPE, format!("neither CiA 301 nor this file defines the data type {shown}")),
    };
    diagnostics.push(kind.at(span, message).label("kept as raw bytes"));
    Type::Opaque(Some(code))
}

/// Returns the access rights for an access type of CiA 306. Reports a text that is not an access type.
pub fn access(text: &str, span: Span, diagnostics: &mut Diagnostics) -> Access {
    if let Some(access) = Access::from_cia306(text) {
        return access;
    }
    let access = if text.eq_ignore_ascii_case("w") { Access::WriteOnly } else { Access::ReadOnly };
    unknown_access(text, span, access, "write one of ro, wo, rw, rwr, rww, const", diagnostics);
    access
}

/// Reports an unknown access type, which is read as `access`.
pub fn unknown_access(text: &str, span: Span, access: Access, help: &str, diagnostics: &mut Diagnostics) {
    let message = format!("`{}` is not a valid access type", brief(text));
    diagnostics.push(codes::UNKNOWN_ACCESS.at(span, message).label(format!("read as {}", access.name())).help(help));
}

/// Compares the announced number of sub-indices, written as `text`, with the number of described sub-indices. Sub-index
/// 0 is counted, but sub-index 0xFF is not.
pub fn sub_number(
    group: &Group,
    announced: i128,
    text: impl Display,
    span: Span,
    terms: &Terms,
    diagnostics: &mut Diagnostics,
) {
    let structure = group.items.iter().filter(|item| item.object().is_some_and(|(_, sub)| sub == 0xFF)).count();
    let described = group.items.len() - structure;
    let Terms { sub_number, elements, .. } = terms;
    let found = if structure > 0 && announced == group.items.len() as i128 {
        codes::STRUCTURE_ENTRY
            .at(span, format!("{sub_number} counts sub-index 0xFF, which is not an element"))
            .label(format!("expected {described}"))
    } else if announced != described as i128 {
        let message = format!("{sub_number} is {text}, but the file describes {described} sub-indices");
        codes::SUB_NUMBER.at(span, message).label(format!("the existing {elements} are used"))
    } else {
        return;
    };
    diagnostics.push(found.fix(described.to_string()));
}

/// Adds to `types` the alias that a DEFTYPE or DEFSTRUCT object defines. Returns the data type code and the type to which the alias
/// refers. Returns `None` for any other object, and reports the object if it is in the data type area.
pub fn define_type(group: &Group, types: &mut Vec<TypeDef>, diagnostics: &mut Diagnostics) -> Option<(u32, Type)> {
    let (index, code) = (group.index()?, group.object_code()?);
    if !matches!(code, ObjectCode::DefType | ObjectCode::DefStruct) {
        if index < 0x1000 && index > 0 {
            let message =
                format!("object {} is in the data type area, but has the object type {}", hex16(index), code.name());
            diagnostics.push(codes::TYPE_AREA_OBJECT.at(group.origin.span, message));
        }
        return None;
    }
    let (target, bits) = defined_type(group, index, code);
    types.push(TypeDef {
        code: Some(u32::from(index)),
        origin: group.origin,
        ..TypeDef::new(group.name.clone(), Shape::Alias(target), bits)
    });
    Some((u32::from(index), target))
}

/// Makes an item without a data type read-only. A value of unknown length cannot be written.
pub fn without_type(item: &mut Item) {
    let rule = || Some(FactOrigin::Rule(Rule::MissingKey));
    item.origins.set(Fact::Type, rule());
    if item.access != Access::ReadOnly {
        item.access = Access::ReadOnly;
        item.origins.set(Fact::Access, rule());
    }
}

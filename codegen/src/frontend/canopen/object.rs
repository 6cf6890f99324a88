//! What EDS and XDD files say of an object in the same terms: object type, data type, number of sub-indices.

use super::deftype::defined_type;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Access, Group, ObjectCode, Shape, Type, TypeDef};
use crate::source::Span;
use crate::text::brief;

/// How a format calls the parts of an object.
pub struct Terms {
    /// The key of the number of sub-indices.
    pub sub_number: &'static str,
    /// What describes a sub-index.
    pub sub_object: &'static str,
    /// The elements that describe sub-indices.
    pub elements: &'static str,
    /// How to write the object types of objects with sub-indices.
    pub records: &'static str,
}

/// An object type as written.
pub struct ObjectType<'t> {
    /// The text.
    pub text: &'t str,
    /// Its number, if it is one.
    pub number: Option<i128>,
    /// Its span.
    pub span: Span,
}

impl ObjectType<'_> {
    /// What a sub-index is: a VAR, or a DOMAIN.
    pub fn of_sub_index(&self, terms: &Terms, diagnostics: &mut Diagnostics) -> ObjectCode {
        match self.number {
            Some(2) => return ObjectCode::Domain,
            Some(7) => {}
            _ => {
                let message = format!("`{}` is no object type of a {}", self.text, terms.sub_object);
                let found = Diagnostic::new(&codes::UNKNOWN_OBJECT_TYPE, self.span, message);
                diagnostics.push(found.label("read as VAR"));
            }
        }
        ObjectCode::Var
    }
}

/// The object code of `index`: that of its object type, or what the sub-indices show if that is missing or impossible. `span` is
/// marked if it is missing.
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
    match given.map(|given| given.number.and_then(ObjectCode::from_number)) {
        Some(Some(code)) if code != ObjectCode::Var => return code,
        Some(None) => {
            let message = format!("`{}` is no object type", given.map_or("", |given| given.text));
            let found = Diagnostic::new(&codes::UNKNOWN_OBJECT_TYPE, span, message);
            diagnostics.push(found.label(format!("read as {}", by_content.name())));
        }
        _ if has_subs => {
            let message = format!("0x{index:04X} is a VAR and has sub-indices");
            let found = Diagnostic::new(&codes::VAR_WITH_SUBS, span, message).label("treated as a RECORD");
            diagnostics.push(found.help(terms.records));
        }
        _ => {}
    }
    by_content
}

/// The data type with this code; `defined` has those of the file.
pub fn type_by_code(code: u32, span: Span, defined: Option<Type>, diagnostics: &mut Diagnostics) -> Type {
    if let Some(ty) = Type::from_cia301(code).or(defined) {
        return ty;
    }
    let (kind, message) = match code {
        0x20..=0x23 => (&codes::COMPLEX_DATA_TYPE, format!("{code:#06x} is the type of a record, not of a value")),
        0x0E | 0x17 | 0x1C..=0x1F => (&codes::COMPLEX_DATA_TYPE, format!("the data type {code:#06x} is reserved")),
        _ => (&codes::UNKNOWN_DATA_TYPE, format!("{code:#06x} is no data type of CiA 301 or of this file")),
    };
    diagnostics.push(Diagnostic::new(kind, span, message).label("kept as raw bytes"));
    Type::Opaque(Some(code))
}

/// The access rights of an access type of CiA 306; anything else is reported.
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
    let message = format!("`{}` is no access type", brief(text));
    let found = Diagnostic::new(&codes::UNKNOWN_ACCESS, span, message);
    diagnostics.push(found.label(format!("read as {}", access.name())).help(help));
}

/// Compares an announced number of sub-indices, given as `text`, with those that are described. Sub-index 0 counts, 0xFF does not.
pub fn sub_number(
    group: &Group,
    announced: i128,
    text: &str,
    span: Span,
    terms: &Terms,
    diagnostics: &mut Diagnostics,
) {
    let structure = group.items.iter().filter(|item| item.object().is_some_and(|(_, sub)| sub == 0xFF)).count();
    let described = group.items.len() - structure;
    let Terms { sub_number, elements, .. } = terms;
    let found = if structure > 0 && announced == group.items.len() as i128 {
        Diagnostic::new(&codes::STRUCTURE_ENTRY, span, format!("{sub_number} counts sub-index 0xFF"))
            .label(format!("{described} without it"))
    } else if announced != described as i128 {
        let message = format!("{sub_number} is {text}, but {described} sub-indices are described");
        Diagnostic::new(&codes::SUB_NUMBER, span, message).label(format!("the {elements} that exist are used"))
    } else {
        return;
    };
    diagnostics.push(found.fix(described.to_string()));
}

/// The code and type that an object of the data type area defines, added to `types`: another name of a basic type, or a number of
/// bits of unknown meaning.
pub fn define_type(group: &Group, types: &mut Vec<TypeDef>, diagnostics: &mut Diagnostics) -> Option<(u32, Type)> {
    let (index, code) = (group.index()?, group.object_code()?);
    if !matches!(code, ObjectCode::DefType | ObjectCode::DefStruct) {
        if index < 0x1000 && index > 0 {
            let message = format!("0x{index:04X} lies in the area of data types and is a {}", code.name());
            diagnostics.push(Diagnostic::new(&codes::TYPE_AREA_OBJECT, group.origin.span, message));
        }
        return None;
    }
    let (target, bits) = defined_type(group, index, code);
    types.push(TypeDef {
        name: group.name.clone(),
        code: Some(u32::from(index)),
        shape: Shape::Alias(target),
        bits,
        documentation: None,
        origin: group.origin,
    });
    Some((u32::from(index), target))
}

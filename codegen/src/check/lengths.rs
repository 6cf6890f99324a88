//! Lengths of items: differences between addresses, types and defaults.

use crate::diagnostics::{codes, Code, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{stated, Binding, Item, RegisterSpace, Type, Value};
use crate::source::Span;
use crate::text::brief;

pub(super) fn check(owner: Owner<'_>, diagnostics: &mut Diagnostics) {
    for item in owner.items() {
        for binding in &item.bindings {
            bound(owner, item, binding, diagnostics);
        }
        text(owner, item, diagnostics);
    }
}

fn report(item: &Item, code: &'static Code, span: Span, message: String, diagnostics: &mut Diagnostics) {
    diagnostics.push(code.at(span.or(item.at.ty).or(item.origin.span), message));
}

fn bound(owner: Owner<'_>, item: &Item, binding: &Binding, diagnostics: &mut Diagnostics) {
    let (code, message) = match binding {
        Binding::EscMemory { length, .. } => {
            let Some(bits) = bits(owner, item).filter(|bits| bits.div_ceil(8) != u32::from(*length)) else { return };
            (&codes::LENGTH_MISMATCH, format!("has {length} bytes of ESC memory, but its type has {bits} bits"))
        }
        Binding::Register(register)
            if register.bit_offset.is_none()
                && matches!(register.space, RegisterSpace::Holding | RegisterSpace::Input) =>
        {
            let Some(bits) = bits(owner, item).filter(|bits| is_odd(owner, item, *bits)) else { return };
            (&codes::REGISTER_SPAN, format!("has {bits} bits, which is not a whole number of bytes"))
        }
        _ => return,
    };
    report(item, code, Span::default(), format!("`{}` {message}", brief(&item.name)), diagnostics);
}

/// Returns the length of an item's type in bits.
fn bits(owner: Owner<'_>, item: &Item) -> Option<u32> {
    let basic = || match stated::ty(owner, item) {
        Type::OctetString(bytes) | Type::VisibleString(bytes) => bytes?.checked_mul(8),
        ty => ty.bits(),
    };
    stated::definition(owner, item).map_or_else(basic, |definition| definition.bits)
}

/// Returns whether the length of an integer is not a whole number of bytes. A single bit is excluded, because it
/// occupies a whole register.
fn is_odd(owner: Owner<'_>, item: &Item, bits: u32) -> bool {
    matches!(owner.basic(item.ty), Type::Integer(_) | Type::Unsigned(_)) && bits > 1 && !bits.is_multiple_of(8)
}

/// Reports a default text or byte string that exceeds the length of its type.
fn text(owner: Owner<'_>, item: &Item, diagnostics: &mut Diagnostics) {
    let (Type::VisibleString(Some(max)) | Type::OctetString(Some(max))) = owner.basic(item.ty) else { return };
    let given = match &item.default {
        Some(Value::Text(text)) => text.len(),
        Some(Value::Bytes(bytes)) => bytes.len(),
        _ => return,
    };
    if max > 0 && given > max as usize {
        let message = format!("the default has {given} bytes, but `{}` holds at most {max}", brief(&item.name));
        report(item, &codes::LENGTH_MISMATCH, item.at.default, message, diagnostics);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(binding: Binding, ty: Type, default: Option<Value>) -> Vec<&'static str> {
        let mut item = Item::new(binding);
        (item.ty, item.default) = (ty, default);
        let mut diagnostics = Diagnostics::default();
        let owner = Owner { types: &[], groups: &[] };
        for binding in &item.bindings {
            bound(owner, &item, binding, &mut diagnostics);
        }
        text(owner, &item, &mut diagnostics);
        diagnostics.list().iter().map(|found| found.code.id).collect()
    }

    #[test]
    fn lengths_agree() {
        let memory = |length| Binding::EscMemory { address: 0x220, length };
        assert_eq!(found(memory(2), Type::Unsigned(16), None), [""; 0]);
        assert_eq!(found(memory(2), Type::Unsigned(32), None), ["TAB020"]);
        let text = |text: &str| Some(Value::Text(text.into()));
        assert_eq!(found(Binding::canopen(0x1008, 0), Type::VisibleString(Some(4)), text("SMD5")), [""; 0]);
        assert_eq!(found(Binding::canopen(0x1008, 0), Type::VisibleString(Some(4)), text("SMD50")), ["TAB020"]);
    }
}

//! Checks of one parameter: presence, access, length, value.

use lexibus::AbortCode;
use lexibus_codegen::facts::pdo;
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{Access, Identity, Type, Value};
use lexibus_codegen::number::hex32;

use super::finding::{Finding, FindingKind, Found};
use super::session::{unverifiable, Run};
use crate::address::Network;
use crate::connection::Connection;
use crate::failure::Failure;
use crate::parameter::Parameter;
use crate::protection::ReadRefusal;

/// Checks one parameter. The entries of a missing object are not checked.
pub(super) fn check<C: Connection>(run: &mut Run<'_, C>, parameter: &Parameter<'_>) -> Result<(), Failure> {
    if parameter.address().object().is_some_and(|object| run.missing.contains(&object.index)) {
        return Ok(());
    }
    match parameter.read_refusal() {
        Some(ReadRefusal::WriteOnly) => return check_write_only(run, parameter),
        Some(refusal) => {
            run.add(unverifiable(parameter, &format!("not read: {refusal}")));
            return Ok(());
        }
        None => {}
    }
    match run.read(parameter)? {
        Ok(bytes) => {
            run.report.read += 1;
            if parameter.access().writable() {
                run.report.unverified_writes += 1;
            }
            check_bytes(run, parameter, &bytes);
        }
        Err(failure) => check_failure(run, parameter, &failure),
    }
    Ok(())
}

/// Checks that a CANopen device refuses to send the value of a write-only parameter. On Modbus, reports the
/// parameter as unverifiable.
fn check_write_only<C: Connection>(run: &mut Run<'_, C>, parameter: &Parameter<'_>) -> Result<(), Failure> {
    // Devices on Modbus can return any value for a write-only register.
    if run.description.network() == Network::Modbus {
        run.add(unverifiable(parameter, "not read: write-only"));
        return Ok(());
    }
    match run.read(parameter)? {
        Ok(_) => run.add(different(parameter, "access rights").compared("wo", "readable").found(Found::Readable)),
        Err(failure) if failure.is_missing() => check_failure(run, parameter, &failure),
        Err(Failure::Abort(AbortCode::WRITE_ONLY | AbortCode::UNSUPPORTED_ACCESS)) => run.report.read += 1,
        Err(failure) => check_failure(run, parameter, &failure),
    }
    Ok(())
}

/// Reports a failed read.
fn check_failure<C>(run: &mut Run<'_, C>, parameter: &Parameter<'_>, failure: &Failure)
where
    C: Connection,
{
    let finding = match failure {
        failure if failure.is_missing() && is_conditional(parameter) || is_unused_entry(parameter, failure) => {
            unverifiable(parameter, "the device doesn't have the parameter, which exists only under a condition")
        }
        Failure::Abort(AbortCode::NO_OBJECT) => {
            run.missing.extend(parameter.address().object().map(|object| object.index));
            let finding = Finding::of(parameter, FindingKind::Missing, failure.to_string()).found(Found::Nothing);
            Finding { name: parameter.group().name.to_string(), ..finding }
        }
        failure if failure.is_missing() => {
            Finding::of(parameter, FindingKind::Missing, failure.to_string()).found(Found::Nothing)
        }
        Failure::Abort(AbortCode::WRITE_ONLY) => {
            let access = parameter.access().name();
            different(parameter, "access rights").compared(access, "wo").found(Found::WriteOnly)
        }
        Failure::Unsupported(reason) => unverifiable(parameter, &format!("not read: {reason}")),
        failure => Finding::of(parameter, FindingKind::Unreadable, failure.to_string()),
    };
    run.add(finding.failed(failure));
}

fn different(parameter: &Parameter<'_>, fact: &str) -> Finding {
    Finding::of(parameter, FindingKind::Different, fact)
}

/// Returns whether the device can lack the parameter. This is so for entries of the error history and of mappings, for
/// optional parameters, and for parameters of some models or versions.
fn is_conditional(parameter: &Parameter<'_>) -> bool {
    let item = parameter.item();
    item.is_optional || item.availability.is_some() || is_entry(parameter)
}

/// Returns whether the parameter is an entry of the error history or of a mapping. Entries above the current number of entries don't
/// exist, or have no value (CiA 301 7.5.2.4, 7.5.2.36 and 7.5.2.38).
fn is_entry(parameter: &Parameter<'_>) -> bool {
    const HISTORY: u16 = 0x1003;
    let object = parameter.address().object();
    object.is_some_and(|object| object.sub_index > 0 && (object.index == HISTORY || pdo::is_mapping(object.index)))
}

/// Returns whether a failure means that an entry of the error history or of a mapping has no value.
fn is_unused_entry(parameter: &Parameter<'_>, failure: &Failure) -> bool {
    is_entry(parameter) && matches!(failure, Failure::Abort(AbortCode::NO_DATA | AbortCode::NO_RESOURCE))
}

/// Checks the length and the value.
fn check_bytes<C: Connection>(run: &mut Run<'_, C>, parameter: &Parameter<'_>, bytes: &[u8]) {
    let ty = parameter.basic();
    if let Some(message) = wrong_length(ty, parameter.length(), bytes.len()) {
        let (declared, actual) = (ty.with_length(), message);
        run.add(different(parameter, "length").compared(declared, actual).found(Found::Length(bytes.len())));
        return;
    }
    let Some(value) = parameter.decode(bytes) else {
        let actual = lexibus_codegen::number::bytes(bytes);
        run.add(different(parameter, "value").compared(ty.with_length(), actual));
        return;
    };
    match wrong_value(run.options.node_id, parameter, &value) {
        Some(finding) => run.add(finding),
        None => run.report.changed.extend(changed(run.options.node_id, parameter, &value)),
    }
}

/// Returns the length of the value as text, or `None` if the type allows this length.
fn wrong_length(ty: Type, expected: Option<usize>, length: usize) -> Option<String> {
    let maximum = match ty {
        Type::VisibleString(maximum) | Type::OctetString(maximum) => maximum,
        Type::UnicodeString(maximum) => maximum.and_then(|maximum| maximum.checked_mul(2)),
        _ => None,
    };
    let is_wrong = match (expected, maximum) {
        (Some(expected), _) => length != expected,
        (None, Some(maximum)) => length > maximum as usize,
        (None, None) => false,
    };
    is_wrong.then(|| format!("{length} byte{}", if length == 1 { "" } else { "s" }))
}

/// Returns the deviation of a value from the description, or `None` if there is none.
fn wrong_value(node_id: Option<u8>, parameter: &Parameter<'_>, value: &Value) -> Option<Finding> {
    // A declared value that doesn't fit the type is a mistake in the description, and is not compared.
    let fits = |value: &Value| parameter.encode(value, node_id.or(Some(1))).is_some();
    if let Some(expected) = expected(parameter).filter(fits) {
        let expected = node_id.map_or_else(|| expected.clone(), |node_id| expected.resolved(node_id));
        return differs(&expected, value)
            .then(|| different(parameter, "value").compared(parameter.text(&expected), parameter.text(value)));
    }
    let sentinels = parameter.item().quantity.as_deref().map_or(&[][..], |quantity| &quantity.sentinels);
    if sentinels.iter().any(|(sentinel, _)| sentinel == value) {
        return None;
    }
    if parameter.excluded(value, node_id).is_some() {
        return Some(
            different(parameter, "value").compared(format!("range {}", parameter.range()), parameter.text(value)),
        );
    }
    let (values, is_closed) = Owner::of_types(&parameter.description().device().types).enumeration(parameter.ty())?;
    let is_listed = |number: i128| values.iter().any(|named| (named.range().0..=named.range().1).contains(&number));
    let is_unknown = is_closed && value.as_int().is_some_and(|number| !is_listed(number));
    is_unknown.then(|| different(parameter, "value").compared("one of the listed values", parameter.text(value)))
}

/// Returns the value that the description states for an identity number, a constant or the device type. Returns `None` if it states
/// none, for other parameters, for numbers of entries and for mappings.
fn expected(parameter: &Parameter<'_>) -> Option<Value> {
    let object = parameter.address().object();
    let identity = &parameter.description().device().identity;
    let number = match object.map(|object| (object.index, object.sub_index)) {
        Some((0x1018, 4)) => return identity.serial_number.map(|number| Value::Int(number.into())),
        Some((0x1018, sub_index)) => identity_number(identity, sub_index),
        _ => None,
    };
    let is_fixed = object.is_some_and(|object| matches!(object.index, 0x1000 | 0x1018));
    // The number of entries is checked in `extra`, and mappings are checked as a whole in `mapping`.
    let is_mapping = object.is_some_and(|object| pdo::is_mapping(object.index));
    let is_fixed =
        !is_number_of_entries(parameter) && !is_mapping && (is_fixed || parameter.access() == Access::Constant);
    number.map(|number| Value::Int(number.into())).or_else(|| parameter.default().filter(|_| is_fixed).cloned())
}

/// Returns the vendor ID, the product code or the revision number that a description states.
fn identity_number(identity: &Identity, sub_index: u8) -> Option<u32> {
    match sub_index {
        1 => identity.vendor_id,
        2 => identity.product_code,
        3 => identity.revision_number,
        _ => None,
    }
}

/// Compares the vendor ID, the product code and the revision number if the description states them without declaring their
/// sub-indices of 0x1018.
pub(super) fn check_identity<C: Connection>(run: &mut Run<'_, C>) -> Result<(), Failure> {
    const IDENTITY: u16 = 0x1018;
    let description = run.description;
    for sub_index in 1..=3 {
        let declared = identity_number(&description.device().identity, sub_index);
        let is_undeclared = description.object(IDENTITY, sub_index).is_none();
        let Some(declared) = declared.filter(|_| is_undeclared && !run.missing.contains(&IDENTITY)) else { continue };
        let Ok(bytes) = run.read_object(IDENTITY, sub_index)? else { continue };
        let actual = <[u8; 4]>::try_from(bytes).map(u32::from_le_bytes).ok();
        if let Some(actual) = actual.filter(|actual| *actual != declared) {
            let finding = Finding::of_object(IDENTITY, sub_index, "identity").compared(hex32(declared), hex32(actual));
            run.add(Finding { kind: FindingKind::Different, ..finding });
        }
    }
    Ok(())
}

/// Returns whether the parameter is the number of entries of an object.
fn is_number_of_entries(parameter: &Parameter<'_>) -> bool {
    let has_entries = parameter.group().object_code().is_some_and(lexibus_codegen::ir::ObjectCode::has_subs);
    has_entries && parameter.address().object().is_some_and(|object| object.sub_index == 0)
}

/// Returns whether two values are equal. Real numbers are compared as REAL32, because a description can state more
/// digits than the device stores.
pub(super) fn is_same(one: &Value, other: &Value) -> bool {
    let is_close = |one: f64, other: f64| one as f32 == other as f32;
    one == other
        || one.compare(other) == Some(std::cmp::Ordering::Equal)
        || matches!((one, other), (Value::Real(one), Value::Real(other)) if is_close(*one, *other))
}

/// Returns whether a value differs from a declared value. A formula whose node-ID is unknown and a text that was not converted
/// are not compared.
fn differs(declared: &Value, value: &Value) -> bool {
    !matches!(declared, Value::NodeId(_) | Value::Raw(_)) && !is_same(declared, value)
}

/// Returns a finding if the value of a writable parameter differs from its default value.
fn changed(node_id: Option<u8>, parameter: &Parameter<'_>, value: &Value) -> Option<Finding> {
    let default = parameter.default().filter(|_| parameter.access().writable())?;
    let default = node_id.map_or_else(|| default.clone(), |node_id| default.resolved(node_id));
    let finding = Finding::of(parameter, FindingKind::Changed, "value");
    differs(&default, value).then(|| finding.compared(parameter.text(&default), parameter.text(value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_without_a_node_id_is_not_compared() {
        assert!(differs(&Value::Int(5), &Value::Int(6)) && !differs(&Value::Int(5), &Value::Int(5)));
        assert!(!differs(&Value::NodeId(0x180), &Value::Int(0x185)));
        assert!(!differs(&Value::Raw("text".into()), &Value::Bytes(vec![1])));
    }
}

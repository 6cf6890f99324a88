//! Compares the addresses of an item on all buses.

use std::mem::discriminant;

use super::change::Judgment;
use super::comparison::{compare_fields, fact, fact_as, or_default, part, rules, text, Comparison, COMPARED};
use super::show::Show;
use super::types;
use lexibus_codegen::facts::address;
use lexibus_codegen::facts::words::bus_name;
use lexibus_codegen::ir::{Binding, CompactString, ImageBinding, IndirectBinding, RegisterBinding, WindowSide};

/// Compares the addresses of an item. Addresses of the same kind are paired in list order.
pub(super) fn compare(old: &[Binding], new: &[Binding], comparison: &mut Comparison<'_>) {
    buses(old, new, comparison);
    let mut left: Vec<&Binding> = new.iter().collect();
    for one in old {
        match left.iter().position(|other| discriminant(*other) == discriminant(one)) {
            Some(at) => binding(one, left.remove(at), comparison),
            None if is_reached(one, new) => {
                comparison.push("further address", address::number(one), String::new(), Judgment::WIRE);
            }
            None => {}
        }
    }
    for one in left.into_iter().filter(|binding| is_reached(binding, old)) {
        comparison.push("further address", String::new(), address::number(one), Judgment::WIRE_COMPATIBLE);
    }
}

/// Returns whether the other addresses cover all buses of this address. If so, the comparison of buses does not report
/// that this address was added or removed.
fn is_reached(binding: &Binding, others: &[Binding]) -> bool {
    let names = names_of(others);
    buses_of(binding).iter().all(|bus| names.contains(bus))
}

/// Compares the buses on which the item is accessible. Using any other bus for the item is a compile error in Rust.
fn buses(old: &[Binding], new: &[Binding], comparison: &mut Comparison<'_>) {
    let (old, new) = (names_of(old), names_of(new));
    let is_lost = old.iter().any(|bus| !new.contains(bus));
    let judgment = if is_lost { Judgment::API_AND_WIRE } else { Judgment::ADDITION };
    comparison.texts("buses", old.join(", "), new.join(", "), judgment);
}

fn names_of(bindings: &[Binding]) -> Vec<String> {
    let mut all: Vec<String> = bindings.iter().flat_map(buses_of).collect();
    all.sort_unstable();
    all.dedup();
    all
}

fn buses_of(binding: &Binding) -> Vec<String> {
    match binding {
        Binding::Indirect(window) => window.buses.iter().map(|bus| format!("{} (window)", bus_name(bus))).collect(),
        Binding::Object { buses, .. } => buses.show().split(", ").map(str::to_owned).collect(),
        _ => address::bus(binding).split(", ").map(str::to_owned).collect(),
    }
}

fn binding(old: &Binding, new: &Binding, comparison: &mut Comparison<'_>) {
    comparison.texts("address", address::number(old), address::number(new), Judgment::WIRE);
    let bits = fact("length in bits", Judgment::WIRE);
    match (old, new) {
        (Binding::Register(old), Binding::Register(new)) => register(old, new, comparison),
        (Binding::Record { bits: old, .. }, Binding::Record { bits: new, .. }) => bits(old, new, comparison),
        (Binding::Image(old), Binding::Image(new)) => image(old, new, comparison),
        (Binding::EscMemory { length: old, .. }, Binding::EscMemory { length: new, .. }) => {
            fact("length in bytes", Judgment::WIRE)(old, new, comparison);
        }
        (Binding::Indirect(old), Binding::Indirect(new)) => window(old, new, comparison),
        // All other bindings have no fields except the address. The buses of the item have already been compared.
        _ => {}
    }
}

fn register(old: &RegisterBinding, new: &RegisterBinding, comparison: &mut Comparison<'_>) {
    // Word order only matters for items with several registers.
    let word_order = if old.count.max(new.count) > 1 { Judgment::WIRE } else { Judgment::NONE };
    compare_fields!(RegisterBinding, old, new, comparison, {
        // If the wire address or the length changes, the printed address usually changes, too, and is not reported
        // separately.
        printed: |one: &CompactString, other: &CompactString, comparison: &mut Comparison<'_>| {
            if (old.address, old.count) == (new.address, new.count) {
                text("printed address")(one, other, comparison);
            }
        },
        is_order_assumed: fact("word order is an assumption", Judgment::NONE),
        count: fact("number of registers", Judgment::WIRE),
        low_word_first: fact_as("word order", word_order, |low_word_first| {
            if *low_word_first { "low word first" } else { "high word first" }.to_owned()
        }),
        bytes_swapped: fact_as("byte order", Judgment::WIRE, |swapped| {
            if *swapped { "low byte first" } else { "high byte first" }.to_owned()
        }),
        words_per_address: fact("registers of one address", Judgment::WIRE),
        extended: fact("extended to the length of the registers", Judgment::WIRE),
    }, COMPARED => [space, address, bit_offset]);
}

rules!(fn image(ImageBinding) {
    bits: fact("length in bits", Judgment::WIRE),
    ty: types::compare_optional("type in the image", Judgment::WIRE),
}, COMPARED => [image, bit_offset]);

rules!(fn window(IndirectBinding) {
    window: fact("number of the window", Judgment::WIRE),
    read: part("read through the window", or_default(side)),
    write: part("written through the window", or_default(side)),
}, COMPARED => [space, buses, number]);

rules!(fn side(WindowSide) {
    number: fact("item of the number", Judgment::WIRE),
    value: fact("item of the value", Judgment::WIRE),
    number_first: fact("number is written first", Judgment::WIRE),
    clears: fact("the device clears the number", Judgment::BEHAVIOR),
    wait: fact("wait in ms", Judgment::BEHAVIOR),
    timeout: fact("timeout in ms", Judgment::BEHAVIOR),
    procedure: fact("procedure", Judgment::BEHAVIOR),
});

//! Random state machines, procedures, code tables and other facts that concern several items.

use lexibus_codegen::ir::{
    AxisRange, AxisRule, AxisStep, CodeRow, CodeTable, CommandOutcomes, CompactString, Composite, Direction,
    GivenNumber, Outcome, Pattern, Procedure, StateMachine, StateOutcome, Step, Transition, Value, Variant,
};
use lexibus_codegen::source::Origin;

use super::bytes::Bytes;
use super::facts::availability;
use super::names;
use super::profinet::identity;
use super::values;

/// Returns a state machine that uses some of these items.
pub fn machine(b: &mut Bytes<'_>, items: &[CompactString], types: &[CompactString]) -> StateMachine {
    let (states, commands) = (b.list(6, pattern), b.list(6, pattern));
    let [state_names, command_names]: [Vec<CompactString>; 2] =
        [&states, &commands].map(|list| list.iter().map(|pattern| pattern.name.clone()).collect());
    let transitions = b.list(6, |b| Transition {
        number: b.maybe(2, |b| b.within(0..=16)),
        from: b.maybe(2, |b| names::of(b, &state_names).into()),
        to: names::of(b, &state_names).into(),
        command: b.maybe(2, |b| names::of(b, &command_names).into()),
        documentation: names::documentation(b),
    });
    StateMachine {
        name: names::name(b),
        status_item: names::of(b, items).into(),
        control_item: names::of(b, items).into(),
        state_type: b.maybe(5, |b| names::of(b, types).into()),
        initial: b.maybe(3, |b| names::of(b, &state_names).into()),
        faults: b.few(3, 2, |b| names::of(b, &state_names).into()),
        outcomes: b.few(3, 3, |b| outcomes(b, &state_names)),
        states: states.into(),
        commands: commands.into(),
        transitions: transitions.into(),
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        stated_by: names::stated_by(b),
    }
}

fn pattern(b: &mut Bytes<'_>) -> Pattern {
    let mask = b.pick(&[0x6F, 0x4F, 0x0F, 0x87, 1, 0, 0x8000, u32::MAX]);
    let value = if b.one_in(12) { b.any() } else { b.any::<u32>() & mask };
    Pattern { name: names::name(b), mask, value, names: names::texts(b), documentation: names::documentation(b) }
}

fn outcomes(b: &mut Bytes<'_>, states: &[CompactString]) -> CommandOutcomes {
    CommandOutcomes {
        name: names::name(b),
        commands: b.list(2, |b| names::name(b).into()),
        availability: b.maybe(4, availability).map(Box::new),
        cells: b.list(4, |b| StateOutcome {
            state: names::of(b, states).into(),
            outcomes: b.list(2, |b| match b.within(0..=2) {
                0 => Outcome::Unchanged,
                1 => Outcome::Refused,
                _ => Outcome::States(b.list(2, |b| names::of(b, states).into())),
            }),
            documentation: names::documentation(b),
        }),
        documentation: names::documentation(b),
        origin: Origin::default(),
    }
}

/// Returns a procedure that uses some of these items and messages.
pub fn procedure(b: &mut Bytes<'_>, items: &[CompactString], messages: &[CompactString]) -> Procedure {
    // A procedure becomes a constant if it consists only of writes.
    let writes = b.one_in(2);
    let steps = b.list(5, |b| {
        let item = names::of(b, items).into();
        match b.within(0..=8) {
            kind if writes || kind == 0 => Step::Write(item, Value::Int(values::number(b))),
            1 => Step::WriteBits(item, b.any(), values::any(b)),
            2 => Step::WriteArgument(item, names::name(b)),
            3 => Step::Read(item),
            4 => Step::WaitFor(item, b.any(), Value::Int(0), b.maybe(2, Bytes::any)),
            5 => Step::Delay(b.any()),
            6 => Step::Send(names::of(b, messages).into()),
            7 => Step::Exchange(b.pick(&[Direction::Receive, Direction::Transmit])),
            _ => Step::Manual(names::text(b).into()),
        }
    });
    Procedure {
        name: names::name(b),
        names: names::texts(b),
        arguments: b.few(3, 2, names::name),
        step_spans: Vec::new(),
        steps,
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        origin: Origin::default(),
    }
}

pub fn code_table(b: &mut Bytes<'_>) -> CodeTable {
    let columns = b.list(2, names::name);
    let rows = b.list(7, |b| {
        let code = values::number(b);
        CodeRow {
            printed: b.maybe(3, names::text).unwrap_or_default(),
            printed_cells: b.few(4, 3, names::text),
            code,
            last: b.maybe(5, |b| code + b.within(0..=0x200)),
            name: names::name(b),
            names: names::texts(b),
            availability: b.maybe(8, availability).map(Box::new),
            documentation: names::documentation(b),
            cells: b.list(3, values::any),
            stated_by: names::stated_by(b),
        }
    });
    let buses = names::buses(b);
    CodeTable {
        name: names::name(b),
        columns,
        rows: rows.into(),
        buses,
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        stated_by: names::stated_by(b),
        origin: Origin::default(),
    }
}

pub fn given(b: &mut Bytes<'_>) -> GivenNumber {
    GivenNumber {
        name: names::name(b),
        unit: names::unit(b),
        models: b.few(3, 2, |b| (names::model(b).into(), Value::Real(values::real(b)))),
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        origin: Origin::default(),
    }
}

pub fn composite(b: &mut Bytes<'_>, items: &[CompactString]) -> Composite {
    Composite {
        name: names::name(b),
        names: names::texts(b),
        parts: b.list(3, |b| names::of(b, items).into()),
        base: b.any(),
        sign: b.maybe(3, |b| (names::of(b, items).into(), b.any())),
        unit: names::unit(b),
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        origin: Origin::default(),
    }
}

pub fn variant(b: &mut Bytes<'_>) -> Variant {
    Variant {
        name: names::model(b),
        constants: b.list(3, |b| (names::name(b), values::any(b))),
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        identity: identity(b),
        origin: Origin::default(),
    }
}

pub fn axes(b: &mut Bytes<'_>) -> AxisRule {
    let steps = [AxisStep::Index(0x800), AxisStep::Index(0), AxisStep::SubIndex, AxisStep::SubIndexStride(5)];
    AxisRule {
        axes: b.within(0..=8),
        models: b.list(1, names::model),
        rules: b.list(3, |b| AxisRange {
            indices: (b.within(0x2000..=0x6000), b.within(0x6000..=0x67FF)),
            step: b.pick(&steps),
        }),
    }
}

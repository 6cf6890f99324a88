use super::*;
use crate::profinet::{IoLengths, ModuleUse, Places, Record};
use std::vec::Vec;

const EMPTY: Submodule = Submodule {
    ident: 0,
    api: 0,
    name: "",
    input_len: None,
    output_len: None,
    provider_len: 1,
    consumer_len: 1,
    records: &[],
};

static HEAD: Submodule = Submodule { ident: 1, ..EMPTY };
static PORT: Submodule = Submodule { ident: 2, ..EMPTY };
static DIGITAL: Submodule = Submodule {
    ident: 3,
    input_len: Some(2),
    output_len: Some(1),
    records: &[Record::new(7, 1, "First", &[1, 2]), Record::new(3, 2, "Second", &[3])],
    ..EMPTY
};
static ANALOG: Submodule = Submodule { ident: 4, api: 0x3A00, input_len: Some(100), ..EMPTY };

static DIGITAL_MODULE: Module = Module {
    ident: 0x30,
    name: "Digital",
    submodules: &[SubmoduleUse::new(&DIGITAL, Places::fixed(&[(1, 1)]))],
    subslots: &[],
};
static FRAME_MODULE: Module = Module {
    ident: 0x40,
    name: "Frame",
    submodules: &[
        SubmoduleUse::new(&DIGITAL, Places::new(&[(2, 3)], &[], &[(2, 2)])),
        SubmoduleUse::new(&ANALOG, Places::allowed(&[(3, 3)])),
    ],
    subslots: &[(2, 4)],
};
static POWER_MODULE: Module = Module { ident: 0x50, name: "Power", submodules: &[], subslots: &[] };

static DAP: Dap = Dap {
    vendor_id: 0x1234,
    device_id: 1,
    slot: 0,
    module: Module {
        ident: 0x10,
        name: "Head",
        submodules: &[
            SubmoduleUse::new(&PORT, Places::fixed(&[(0x8001, 0x8002)])),
            SubmoduleUse::new(&HEAD, Places::fixed(&[(1, 1)])),
        ],
        subslots: &[],
    },
    slots: &[(0, 4), (9, 9)],
    modules: &[
        ModuleUse::new(&DIGITAL_MODULE, Places::new(&[(1, 3)], &[], &[(3, 3)])),
        ModuleUse::new(&FRAME_MODULE, Places::allowed(&[(1, 4)])),
        ModuleUse::new(&POWER_MODULE, Places::fixed(&[(9, 9)])),
    ],
    max_lengths: IoLengths { input: Some(108), output: Some(9), data: None },
    max_record_size: 4068,
};

fn places<const N: usize>(plan: &Plan<N>) -> Vec<(u16, u16, u32)> {
    plan.expected().map(|expected| (expected.slot, expected.subslot, expected.submodule_ident)).collect()
}

#[test]
fn what_is_always_there() {
    let plan = Plan::<8>::new(&DAP).unwrap();
    assert_eq!(places(&plan), [(0, 1, 1), (0, 0x8001, 2), (0, 0x8002, 2)]);
    assert_eq!(plan.module(9).map(|module| module.name), Some("Power"));
    assert_eq!(plan.lengths(), (3, 3), "three submodules without data: a provider and a consumer status each");
    assert_eq!(Plan::<3>::new(&DAP).unwrap_err(), PlanError::Full, "the power module also counts");
    assert_eq!(plan.dap().module.ident, 0x10);
}

#[test]
fn defaults_can_be_chosen() {
    let plan = Plan::<8>::with_defaults(&DAP).unwrap();
    assert_eq!(places(&plan), [(0, 1, 1), (0, 0x8001, 2), (0, 0x8002, 2), (3, 1, 3)]);
}

#[test]
fn modules_fit_or_dont() {
    let mut plan = Plan::<8>::new(&DAP).unwrap();
    plan.plug(2, &DIGITAL_MODULE).unwrap();
    let refused = [
        (2, &DIGITAL_MODULE, PlanError::SlotTaken),
        (4, &DIGITAL_MODULE, PlanError::ModuleNotAllowed),
        (1, &DAP.module, PlanError::ModuleNotAllowed),
        (5, &DIGITAL_MODULE, PlanError::NoSuchSlot),
        (0, &DIGITAL_MODULE, PlanError::FixedModule),
        (9, &DIGITAL_MODULE, PlanError::FixedModule),
    ];
    for (slot, module, error) in refused {
        assert_eq!(plan.plug(slot, module), Err(error), "{slot}");
    }
    assert_eq!(places(&plan)[3..], [(2, 1, 3)]);
    assert_eq!(plan.lengths(), (3 + 3 + 1, 3 + 2 + 1));
    assert_eq!(plan.unplug(0), Err(PlanError::FixedModule));
    assert_eq!(plan.unplug(1), Err(PlanError::EmptySlot));
    plan.unplug(2).unwrap();
    assert_eq!(places(&plan).len(), 3);
}

#[test]
fn submodules_fit_or_dont() {
    let mut plan = Plan::<8>::new(&DAP).unwrap();
    assert_eq!(plan.plug_submodule(1, 2, &DIGITAL), Err(PlanError::EmptySlot));
    plan.plug(1, &FRAME_MODULE).unwrap();
    assert_eq!(places(&plan).len(), 3, "a module without submodules isn't expected yet");
    plan.plug_submodule(1, 3, &ANALOG).unwrap();
    assert_eq!(plan.plug_submodule(1, 3, &DIGITAL), Err(PlanError::SubslotTaken));
    assert_eq!(plan.plug_submodule(1, 2, &ANALOG), Err(PlanError::SubmoduleNotAllowed));
    assert_eq!(plan.plug_submodule(1, 5, &ANALOG), Err(PlanError::NoSuchSubslot));
    assert_eq!(plan.plug_submodule(0, 1, &HEAD), Err(PlanError::FixedSubmodule));
    assert_eq!(plan.plug_submodule(0, 7, &HEAD), Err(PlanError::NoSuchSubslot));
    assert_eq!(places(&plan)[3..], [(1, 3, 4)]);
    assert_eq!(plan.unplug_submodule(0, 1), Err(PlanError::FixedSubmodule));
    assert_eq!(plan.unplug_submodule(1, 2), Err(PlanError::NoSuchSubslot));
    plan.unplug_submodule(1, 3).unwrap();
    assert_eq!((places(&plan).len(), plan.module(1).map(|module| module.name)), (3, Some("Frame")));
}

#[test]
fn lengths_are_limited_and_a_refusal_changes_nothing() {
    let mut plan = Plan::<8>::new(&DAP).unwrap();
    plan.plug(1, &FRAME_MODULE).unwrap();
    plan.plug_submodule(1, 3, &ANALOG).unwrap();
    assert_eq!(plan.lengths(), (3 + 101, 3 + 1));
    plan.plug(2, &DIGITAL_MODULE).unwrap();
    assert_eq!(plan.lengths(), (108, 7));
    assert_eq!(plan.plug(3, &DIGITAL_MODULE), Err(PlanError::InputsTooLong));
    assert_eq!(plan.plug_submodule(1, 2, &DIGITAL), Err(PlanError::InputsTooLong));
    assert_eq!(places(&plan).len(), 5);
    assert!(plan.module(3).is_none());

    let mut small = Plan::<4>::new(&DAP).unwrap();
    assert_eq!(small.plug(1, &DIGITAL_MODULE), Err(PlanError::Full));
    assert!(small.module(1).is_none());
}

#[test]
fn records_come_in_order_and_can_be_replaced() {
    let mut plan = Plan::<8>::new(&DAP).unwrap();
    plan.plug(2, &DIGITAL_MODULE).unwrap();
    plan.plug(1, &FRAME_MODULE).unwrap();
    plan.plug_submodule(1, 2, &DIGITAL).unwrap();
    let list = |records: Records<'_, 8>| {
        records.map(|record| (record.slot, record.subslot, record.index, record.data.to_vec())).collect::<Vec<_>>()
    };
    let (first, second) = (std::vec![1, 2], std::vec![3]);
    assert_eq!(
        list(plan.records()),
        [(1, 2, 7, first.clone()), (1, 2, 3, second.clone()), (2, 1, 7, first.clone()), (2, 1, 3, second.clone())]
    );
    let replacements = [Replacement::new(2, 1, 3, &[9])];
    let replaced = list(plan.records_with(&replacements).unwrap());
    assert_eq!(replaced[3], (2, 1, 3, std::vec![9]));
    assert_eq!(replaced[..3], list(plan.records())[..3]);
    for (replacement, error) in [
        (Replacement::new(2, 1, 4, &[9]), PlanError::NoSuchRecord),
        (Replacement::new(3, 1, 3, &[9]), PlanError::NoSuchRecord),
        (Replacement::new(2, 1, 3, &[9, 9]), PlanError::RecordLength),
    ] {
        assert_eq!(plan.records_with(&[replacement]).unwrap_err(), error);
    }
}

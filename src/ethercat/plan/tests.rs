//! Tests of slot plans.

use std::vec::Vec;

use super::super::samples::{COUPLER, INPUTS, OUTPUTS, WIDE};
use super::super::{Device, PdoGroup, Slots, Transitions};
use super::*;

fn plan() -> SlotPlan<8> {
    let mut plan = SlotPlan::new(&COUPLER).unwrap();
    plan.plug(0, &OUTPUTS).unwrap();
    plan.plug(1, &INPUTS).unwrap();
    plan.plug(3, &INPUTS).unwrap();
    plan
}

fn places(plan: &SlotPlan<8>, manager: u8) -> Vec<(Option<u16>, u16, u32, u32)> {
    plan.pdos(manager).map(|placed| (placed.slot, placed.index, placed.bit, placed.bits)).collect()
}

#[test]
fn indices_grow_with_the_slot() {
    let plan = plan();
    assert_eq!(places(&plan, 2), [(Some(0), 0x1600, 0, 12)]);
    // The status of the coupler comes first. The second group is aligned to a byte.
    assert_eq!(
        places(&plan, 3),
        [(None, 0x1AFF, 0, 4), (None, 0x1AF0, 4, 4), (Some(1), 0x1A04, 8, 8), (Some(3), 0x1A0C, 16, 8)]
    );
    assert_eq!((plan.bytes(2), plan.bytes(3)), (2, 3));
    assert_eq!(plan.pdo(3, 0x1A00).map(|placed| (placed.bit, placed.index)), Some((16, 0x1A0C)));
    let offsets = [0x6000, 0x8000, 0x9000, 0xA001, 0xF100].map(|index| plan.index_offset(3, index).unwrap());
    assert_eq!(offsets, [0x30, 0x30, 0x800, 0x830, 0]);
    assert_eq!((plan.index_offset(2, 0x6000), plan.index_offset(8, 0x6000)), (None, None));
    assert_eq!(plan.check(), Ok(()));
}

#[test]
fn lists_of_the_device_have_room_for_255() {
    for (bits, entries) in [(4, 1), (255, 1), (256, 2), (508, 2), (700, 3)] {
        let writes: Vec<_> =
            gap_writes(0x1A80, bits).map(|write| (write.object().sub_index, write.data().to_vec())).collect();
        assert_eq!((writes[0].clone(), writes.len()), ((0, std::vec![0]), entries + 2));
        assert_eq!(writes.last(), Some(&(0, std::vec![entries as u8])));
        let mapped = writes[1..=entries].iter().map(|(_, word)| u32::from(word[0])).sum::<u32>();
        assert_eq!(mapped, bits);
    }
    assert_eq!(room_for(0xF030, 255, MAX_LISTED), Ok(()));
    let many = room_for(0xF030, 256, MAX_LISTED).unwrap_err();
    assert_eq!(std::format!("{many}"), "object 0xF030 cannot hold 256 entries");
}

/// A variant of the coupler: the alignment of the second group needs more padding than a mapping can describe.
static WIDELY_ALIGNED: Device = Device {
    slots: Some(Slots {
        pdo_groups: &[
            PdoGroup { alignment: 0, rx_pdo: None, tx_pdo: None },
            PdoGroup { alignment: 9000, rx_pdo: Some(0x16F0), tx_pdo: Some(0x1AF0) },
        ],
        ..COUPLER.slots.unwrap()
    }),
    ..COUPLER
};

#[test]
fn padding_needs_room_in_its_mapping() {
    let mut plan = SlotPlan::<8>::new(&WIDELY_ALIGNED).unwrap();
    plan.plug(0, &OUTPUTS).unwrap();
    plan.plug(1, &INPUTS).unwrap();
    assert_eq!(plan.check(), Err(PlanError::TooMany { index: 0x1AF0, count: 283 }));
}

#[test]
fn only_what_fits_is_plugged() {
    let mut plan = plan();
    assert_eq!(plan.plug(9, &INPUTS), Err(PlanError::NoSuchSlot(9)));
    assert_eq!(plan.plug(1, &INPUTS), Err(PlanError::Taken(1)));
    assert_eq!(plan.plug(2, &WIDE), Err(PlanError::DoesNotFit { slot: 2, ident: WIDE.ident }));
    assert!(plan.unplug(0).is_some());
    assert_eq!(plan.check(), Err(PlanError::Empty(0)));
    assert!(SlotPlan::<3>::new(&COUPLER).is_err());
    let default = SlotPlan::<8>::by_default(&COUPLER).unwrap();
    assert_eq!(default.module(0).map(|module| module.ident), Some(OUTPUTS.ident));
}

#[test]
fn the_list_of_modules_goes_out_when_the_device_wants_it() {
    static EARLY: Device = {
        let Some(slots) = COUPLER.slots else { panic!() };
        let download_idents = Transitions::of(&[Transition::IP, Transition::SO]);
        Device { slots: Some(Slots { download_idents, ..slots }), ..COUPLER }
    };
    let mut plan = SlotPlan::<8>::new(&EARLY).unwrap();
    plan.plug(0, &OUTPUTS).unwrap();
    let count = |transition| {
        let mut count = 0;
        let visited = plan.try_for_each_command(transition, |command| {
            assert_eq!(command.transition, transition);
            count += usize::from(command.object.index == MODULE_IDENTS);
            Ok::<(), ()>(())
        });
        visited.map(|()| count)
    };
    let changes = [Transition::IP, Transition::PS, Transition::SO, Transition::OP];
    assert_eq!(changes.map(count), [Ok(3), Ok(0), Ok(3), Ok(0)]);
}

#[test]
fn commands_set_up_modules_and_process_data() {
    let mut commands = Vec::new();
    let collected = plan().try_for_each_command(Transition::PS, |command| {
        commands.push((command.object.index, command.object.sub_index, command.data().to_vec()));
        Ok::<(), ()>(())
    });
    assert_eq!(collected, Ok(()));
    let expected: [(u16, u8, &[u8]); 28] = [
        (0xF030, 0, &[0]),
        (0xF030, 1, &[2, 0, 0, 0]),
        (0xF030, 2, &[1, 0, 0, 0]),
        (0xF030, 3, &[0, 0, 0, 0]),
        (0xF030, 4, &[1, 0, 0, 0]),
        (0xF030, 0, &[4]),
        // Initialization commands of the modules, at the indices of the modules' slots.
        (0x8010, 2, &[0x0A, 0]),
        (0x8030, 2, &[0x0A, 0]),
        (0x1C12, 0, &[0]),
        (0x1C13, 0, &[0]),
        // The writes of the padding in front of the second group.
        (0x1AF0, 0, &[0]),
        (0x1AF0, 1, &[4, 0, 0, 0]),
        (0x1AF0, 0, &[1]),
        // Only the index of the slot-dependent entry changes.
        (0x1A04, 0, &[0]),
        (0x1A04, 1, &[7, 1, 0x10, 0x60]),
        (0x1A04, 2, &[1, 2, 0x00, 0xF1]),
        (0x1A04, 0, &[2]),
        (0x1A0C, 0, &[0]),
        (0x1A0C, 1, &[7, 1, 0x30, 0x60]),
        (0x1A0C, 2, &[1, 2, 0x00, 0xF1]),
        (0x1A0C, 0, &[2]),
        (0x1C12, 1, &[0x00, 0x16]),
        (0x1C12, 0, &[1]),
        (0x1C13, 1, &[0xFF, 0x1A]),
        (0x1C13, 2, &[0xF0, 0x1A]),
        (0x1C13, 3, &[0x04, 0x1A]),
        (0x1C13, 4, &[0x0C, 0x1A]),
        (0x1C13, 0, &[4]),
    ];
    let expected: Vec<_> = expected.iter().map(|&(index, sub, data)| (index, sub, data.to_vec())).collect();
    assert_eq!(commands, expected);
    let mut count = 0;
    let stopped = plan().try_for_each_command(Transition::PS, |_| {
        count += 1;
        if count == 3 {
            Err("full")
        } else {
            Ok(())
        }
    });
    assert_eq!((stopped, count), (Err("full"), 3));
}

//! Property test: on a bus that loses and repeats messages, a transfer returns the correct value or an error.

use core::cell::Cell;
use std::vec;
use std::vec::Vec;

use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};

use super::super::{Message, Transfer};
use super::{run, Device, LONG, OBJECT};

/// One transfer on a bus with faults: the length, whether it is a download, and the minimum length of a block transfer.
type Case = (usize, bool, usize);

fn cases() -> impl Strategy<Value = (Vec<Case>, Vec<u8>)> {
    let length = prop_oneof![1_usize..40, 880..900_usize, 1..LONG];
    let case = (length, any::<bool>(), prop_oneof![Just(0), Just(usize::MAX)]);
    // A small number means that a message is lost or arrives twice.
    (prop::collection::vec(case, 1..6), prop::collection::vec(any::<u8>(), 64))
}

#[test]
fn faults_of_the_bus_are_errors_but_never_wrong_values() {
    let config = ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() };
    // The CRC has 16 bits, so one of 65,536 damaged values is not detected. The same numbers are used in each run.
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let [right, failed, blocks] = [0, 0, 0].map(Cell::new);
    let count = |cell: &Cell<usize>| cell.set(cell.get() + 1);
    let all = runner.run(&cases(), |(cases, fates)| {
        let mut device = Device::new(&[0]);
        let mut number = 0_usize;
        for (round, (length, is_download, threshold)) in cases.into_iter().enumerate() {
            let fate = |_: bool, _: &Message| {
                number = number.wrapping_mul(31).wrapping_add(17);
                match fates[number / 7 % fates.len()].wrapping_add((number / 3) as u8) {
                    0 => 0,
                    1 => 2,
                    _ => 1,
                }
            };
            let value: Vec<u8> = (0..length).map(|at| (at * 7 + round * 31 + at / 256) as u8).collect();
            let mut buffer = vec![0; length];
            let result = if is_download {
                let mut download = Transfer::download(OBJECT, &value, threshold).unwrap();
                let result = run(&mut download, &mut device, fate).0;
                prop_assert!(result.is_err() || device.value() == value, "a wrong value is written");
                result
            } else {
                device.values.0.insert(OBJECT, value.clone());
                let mut upload = Transfer::upload(OBJECT, &mut buffer, threshold);
                let result = run(&mut upload, &mut device, fate).0;
                prop_assert!(result.is_err() || buffer == value, "a wrong value is read");
                result
            };
            match result {
                Ok(all) => {
                    prop_assert_eq!(all, length);
                    count(if threshold == 0 && length > 28 { &blocks } else { &right });
                }
                Err(_) => count(&failed),
            }
        }
        Ok(())
    });
    all.expect("no wrong value");
    let [right, failed, blocks] = [right, failed, blocks].map(Cell::into_inner);
    assert!(right > 1000 && failed > 300 && blocks > 300, "{right} right, {failed} failed, {blocks} in blocks");
}

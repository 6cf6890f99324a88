//! Tests of the LSS messages, and of a master with simulated slaves.

use std::vec::Vec;

use super::*;
use crate::node_id::NodeId;

/// A [`Host`] with a bit timing and a non-volatile memory.
#[derive(Default)]
struct Memory {
    timing: Option<(u8, u8)>,
    delay: Option<u16>,
    stored: Option<NodeId>,
    is_broken: bool,
}

impl Host for Memory {
    fn configure_bit_timing(&mut self, table: u8, index: u8) -> Result<(), Refusal> {
        let is_valid = table == 0 && BitRate::from_index(index).is_some();
        self.timing = is_valid.then_some((table, index));
        self.timing.map(|_| ()).ok_or(Refusal::NOT_SUPPORTED)
    }

    fn activate_bit_timing(&mut self, delay: u16) {
        self.delay = Some(delay);
    }

    fn store(&mut self, node: Option<NodeId>) -> Result<(), Refusal> {
        if self.is_broken {
            return Err(Refusal::STORAGE);
        }
        self.stored = node;
        Ok(())
    }
}

const ADDRESS: LssAddress =
    LssAddress { vendor_id: 0x319, product_code: 0x8000_0001, revision_number: u32::MAX, serial_number: 0 };

fn run(slaves: &mut [Slave], host: &mut Memory, service: Service) -> Result<u32, LssError> {
    let mut transaction = Transaction::new(service);
    while let Some(request) = transaction.next() {
        for answer in slaves.iter_mut().filter_map(|slave| slave.handle(&request, host)) {
            transaction.handle(&answer);
        }
    }
    transaction.time_out();
    transaction.result().expect("it has ended")
}

fn scan(slaves: &mut [Slave]) -> Result<Option<LssAddress>, LssError> {
    let mut scan = FastScan::new();
    while let Some(request) = scan.next() {
        assert_eq!(scan.next(), None, "the time for answers has not passed");
        for answer in slaves.iter_mut().filter_map(|slave| slave.handle(&request, &mut NoHost)) {
            scan.handle(&answer);
        }
        scan.time_out();
    }
    scan.result()
}

fn node(id: u8) -> Option<NodeId> {
    NodeId::new(id)
}

#[test]
fn messages() {
    let all = |service: Service| service.messages().collect::<Vec<_>>();
    assert_eq!(all(Service::SwitchGlobal(LssState::Configuration)), [[4, 1, 0, 0, 0, 0, 0, 0]]);
    assert_eq!(all(Service::ConfigureNodeId(node(5))), [[0x11, 5, 0, 0, 0, 0, 0, 0]]);
    assert_eq!(all(Service::ConfigureNodeId(None)), [[0x11, 0xFF, 0, 0, 0, 0, 0, 0]]);
    assert_eq!(all(Service::ConfigureBitTiming { table: 0, index: 4 }), [[0x13, 0, 4, 0, 0, 0, 0, 0]]);
    assert_eq!(all(Service::ActivateBitTiming { delay: 0x1234 }), [[0x15, 0x34, 0x12, 0, 0, 0, 0, 0]]);
    assert_eq!(all(Service::Inquire(IdentityPart::SerialNumber)), [[0x5D, 0, 0, 0, 0, 0, 0, 0]]);
    let selective = [
        [0x40, 0x19, 3, 0, 0, 0, 0, 0],
        [0x41, 1, 0, 0, 0x80, 0, 0, 0],
        [0x42, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0],
        [0x43, 0, 0, 0, 0, 0, 0, 0],
    ];
    assert_eq!(all(Service::SwitchSelective(ADDRESS)), selective);
}

#[test]
fn a_selected_slave_is_configured() {
    let other = LssAddress { serial_number: 1, ..ADDRESS };
    let mut slaves = [Slave::new(ADDRESS, None), Slave::new(other, node(9))];
    let mut memory = Memory::default();
    let mut ask = |service| run(&mut slaves, &mut memory, service);
    assert_eq!(ask(Service::Store), Err(LssError::Timeout), "no slave is in Configuration");
    assert_eq!(ask(Service::SwitchSelective(LssAddress { serial_number: 2, ..other })), Err(LssError::Timeout));
    assert_eq!(ask(Service::SwitchSelective(other)), Ok(0));
    for part in IdentityPart::ALL {
        assert_eq!(ask(Service::Inquire(part)), Ok(other.part(part)));
    }
    assert_eq!(ask(Service::InquireNodeId), Ok(9));
    assert_eq!(ask(Service::ConfigureNodeId(node(10))), Ok(0));
    assert_eq!(ask(Service::InquireNodeId), Ok(9), "the new node-ID is not active");
    let refused = Err(LssError::Refused(Refusal::NOT_SUPPORTED));
    assert_eq!(ask(Service::ConfigureBitTiming { table: 0, index: 5 }), refused);
    assert_eq!(ask(Service::ConfigureBitTiming { table: 0, index: 4 }), Ok(0));
    assert_eq!(ask(Service::Store), Ok(0));
    assert_eq!(ask(Service::ActivateBitTiming { delay: 300 }), Ok(0));
    assert_eq!((memory.timing, memory.delay, memory.stored), (Some((0, 4)), Some(300), node(10)));
    memory.is_broken = true;
    assert_eq!(run(&mut slaves, &mut memory, Service::Store), Err(LssError::Refused(Refusal::STORAGE)));
    slaves[1].restart();
    assert_eq!((slaves[1].node_id(), slaves[1].state(), slaves[0].node_id()), (node(10), LssState::Waiting, None));
}

#[test]
fn several_slaves_in_configuration() {
    let mut slaves = [Slave::new(ADDRESS, None), Slave::new(ADDRESS, None)];
    let mut memory = Memory::default();
    let mut ask = |service| run(&mut slaves, &mut memory, service);
    assert_eq!(ask(Service::IdentifyUnconfigured), Ok(0));
    assert_eq!(ask(Service::SwitchGlobal(LssState::Configuration)), Ok(0));
    assert_eq!(ask(Service::IdentifyUnconfigured), Err(LssError::Timeout));
    assert_eq!(ask(Service::ConfigureNodeId(node(5))), Err(LssError::SeveralAnswers));
    assert_eq!(ask(Service::InquireNodeId), Err(LssError::SeveralAnswers));
}

#[test]
fn invalid_messages() {
    let mut slave = Slave::new(ADDRESS, None);
    slave.handle(&[4, 1, 0, 0, 0, 0, 0, 0], &mut NoHost);
    assert_eq!(slave.handle(&[0x11, 0, 0, 0, 0, 0, 0, 0], &mut NoHost), Some([0x11, 1, 0, 0, 0, 0, 0, 0]));
    assert_eq!(slave.handle(&[0x11, 128, 0, 0, 0, 0, 0, 0], &mut NoHost), Some([0x11, 1, 0, 0, 0, 0, 0, 0]));
    for command in 0..=255 {
        for byte in [0, 0x80, 0xFF] {
            for state in [0, 1] {
                slave.handle(&[4, state, 0, 0, 0, 0, 0, 0], &mut NoHost);
                slave.handle(&[command, byte, byte, byte, byte, byte, byte, byte], &mut NoHost);
            }
        }
    }
    let mut inquiry = Transaction::new(Service::InquireNodeId);
    assert!(inquiry.next().is_some());
    inquiry.handle(&[0x5D, 5, 0, 0, 0, 0, 0, 0]);
    assert!(!inquiry.is_answered());
    inquiry.handle(&[0x5E, 0, 0, 0, 0, 0, 0, 0]);
    inquiry.time_out();
    assert_eq!(inquiry.result(), Some(Err(LssError::UnexpectedReply)));
}

#[test]
fn fast_scan_finds_each_slave() {
    let mut random = 88_172_645_463_325_252_u64;
    let mut number = || {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        // Some numbers are equal, and some have only zeros or ones.
        [0, u32::MAX, 5, random as u32][(random >> 40) as usize % 4]
    };
    let mut addresses: Vec<LssAddress> = Vec::new();
    while addresses.len() < 30 {
        let address = LssAddress::from_array([number(), number(), number(), number()]);
        if !addresses.contains(&address) {
            addresses.push(address);
        }
    }
    let mut slaves: Vec<Slave> = addresses.iter().map(|address| Slave::new(*address, None)).collect();
    slaves.push(Slave::new(ADDRESS, node(100)));
    let mut memory = Memory::default();
    let mut found = Vec::new();
    while let Some(address) = scan(&mut slaves).expect("a result") {
        found.push(address);
        let id = node(found.len() as u8);
        assert_eq!(run(&mut slaves, &mut memory, Service::ConfigureNodeId(id)), Ok(0));
        assert_eq!(run(&mut slaves, &mut memory, Service::SwitchGlobal(LssState::Waiting)), Ok(0));
        let slave = slaves.iter().find(|slave| slave.node_id() == id);
        assert!(slave.is_some_and(|slave| addresses.contains(&address) && slave.state() == LssState::Waiting));
    }
    // A scan finds the slave with the lowest number first, part by part.
    addresses.sort();
    assert_eq!(found, addresses);
}

#[test]
fn a_lost_answer_makes_a_scan_inconclusive() {
    for lost in 0..133 {
        let (mut slave, mut scan, mut sent) = (Slave::new(ADDRESS, None), FastScan::new(), 0);
        while let Some(request) = scan.next() {
            if let Some(answer) = slave.handle(&request, &mut NoHost).filter(|_| sent != lost) {
                scan.handle(&answer);
            }
            sent += 1;
            scan.time_out();
        }
        match scan.result() {
            Ok(None) => assert_eq!(lost, 0),
            // There was no answer to lose, or the answer that was lost is the one to the last request.
            result => assert!(matches!(result, Ok(Some(ADDRESS)) | Err(LssError::Inconclusive)), "{lost}"),
        }
    }
}

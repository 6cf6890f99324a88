//! Tests the worked examples of the HSD manual. The comments cite sections of the manual.

use lexibus::codes::CodeTable;
use lexibus::message::{Message, Reader, Reply, Writer};
use lexibus::{Client, Error, OutOfRange, Parameter, Serial};
use lexibus_drives::hsd::machine::Machine;
use lexibus_drives::hsd::messages::*;
use lexibus_drives::hsd::{codes, models, objects, types};

/// The machine in the examples. In the positioning examples, the machine has 500 counts per turn.
const MACHINE: Machine = Machine { screw_pitch: 0.32, counts_per_turn: 800.0 };

fn sent(message: &impl Message) -> Vec<u8> {
    let mut data = [0; MAX_DATA];
    let mut to = Writer::new(&mut data);
    message.write(1, &mut to).expect("a message of the protocol");
    to.written().to_vec()
}

/// The reply to the null request in section 3.11, examples 1 and 2.
const ANSWER: [u8; 6] = [0x01, 0x02, 0x10, 0xAB, 0x09, 0xC1];

#[test]
fn positions() {
    // Section 3.6: the text of the example prints 6766.8176 mm, but its formula contains 6780.8465 mm. The printed
    // bytes agree with the formula.
    let position = MACHINE.mm_to_count(6780.8465) as i32;
    assert_eq!((position, sent(&CmdMazz { position })), (16_952_116, vec![1, 0x01, 0xAB, 0x34, 0x01, 0x02]));
    // Sections 3.9 and 3.10: 1798046 counts. The manual prints 0x01 for the highest byte Q3, but 1798046 is 0x001B6F9E.
    let machine = Machine { counts_per_turn: 500.0, ..MACHINE };
    let target = machine.mm_to_count(1150.75) as i32;
    assert_eq!((target, sent(&CmdTraj { target })), (1_798_046, vec![1, 0x02, 0x6F, 0x9E, 0x00, 0x1B]));
    // Section 3.10: the same target, and a speed of 468.75 rpm, which is truncated.
    let speed = machine.mm_per_min_to_rpm(150.0) as u16;
    let data = sent(&CmdTrajVel { target, speed });
    assert_eq!((speed, data), (0x01D4, vec![1, 0x00, 0xC8, 0x00, 0x6F, 0x9E, 0x00, 0x1B, 0x01, 0xD4]));
    // Section 3.11, example 1: theoretical position.
    let poll = sent(&PollTheoreticalPosition);
    let reply = PollTheoreticalPositionReply::read(&poll, &mut Reader::new(&ANSWER)).expect("a reply");
    assert_eq!(reply.theoretical_position, 163_647_659);
    assert!((MACHINE.count_to_mm(reply.theoretical_position.into()) - 65_459.063_6).abs() < 1e-4);
}

/// Sections 3.9 and 3.10. At position 1000, targets from -67107863 to 67109863 are allowed. Only the motor knows its
/// position, so both messages accept all targets. The bindings contain the alarm for an invalid target.
#[test]
fn the_limit_of_a_way_is_the_motors() {
    let ends = [1000 - 0x03FF_FFFF, 1000 + 0x03FF_FFFF];
    assert_eq!(ends, [-67_107_863, 67_109_863]);
    let expected = [vec![1, 0x02, 0x03, 0xE9, 0xFC, 0x00], vec![1, 0x02, 0x03, 0xE7, 0x04, 0x00]];
    assert_eq!(ends.map(|target| sent(&CmdTraj { target })), expected);
    let beyond = [ends[0] - 1, ends[1] + 1, i32::MIN, i32::MAX];
    for target in ends.into_iter().chain(beyond) {
        let both = [sent(&CmdTraj { target }), sent(&CmdTrajVel { target, speed: 1 })];
        let parsed = both.each_ref().map(|data| Request::parse(data).map(|(_, request)| request));
        let [Some(Request::CmdTraj(one)), Some(Request::CmdTrajVel(two))] = parsed else { panic!("{both:02X?}") };
        assert_eq!((one.target, two.target), (target, target));
    }
    let request = sent(&CmdGetAlarm);
    let reply =
        CmdGetAlarmReply::read(&request, &mut Reader::new(&[1, 0x02, 0x60, 0x00, 0x40, 0x0B])).expect("a reply");
    assert_eq!(codes::Warning::from_raw(reply.message), codes::Warning::MotionTooLong);
    assert_eq!(codes::Warning::MotionTooLong.row().map(|row| row.first), Some(0x400B));
}

#[test]
fn acceleration_in_steps() {
    // Section "Quantizzazione SM137": 430 mm/s² are 1343.75 turns/s². The motor uses 17 steps of 78.125 turns/s², that
    // is, 425 mm/s².
    let wanted = MACHINE.mm_per_s2_to_rev_per_s2(430.0);
    let steps = (wanted / 78.125).trunc();
    assert!((wanted - 1343.75).abs() < 1e-9);
    assert_eq!(steps, 17.0);
    assert!((MACHINE.rev_per_s2_to_mm_per_s2(steps * 78.125) - 425.0).abs() < 1e-9);
}

#[test]
fn speeds() {
    // Section 3.8: -185 mm/min are -578.125 rpm, which is truncated. The manual's text lacks the sign.
    let speed = MACHINE.mm_per_min_to_rpm(-185.0) as i16;
    assert_eq!((speed, sent(&CmdJogN { speed })), (-578, vec![1, 0x08, 0xE0, 0x00, 0xFD, 0xBE]));
    // Section 5.3: the same speed as a fraction of 8000 rpm.
    let base = models::sm137_rev_c::SPEED_BASE;
    let speed = CmdJog::SPEED.raw_by(MACHINE.mm_per_min_to_rpm(-185.0), base).expect("within the base value");
    assert_eq!((speed, sent(&CmdJog { speed })), (-2368, vec![1, 0x08, 0x40, 0x00, 0xF6, 0xC0]));
    // Section 3.11, example 2: both speeds in mm/min.
    let poll = sent(&PollSpeeds);
    let reply = PollSpeedsReply::read(&poll, &mut Reader::new(&ANSWER)).expect("a reply");
    let mm_per_min = |rpm| MACHINE.rpm_to_mm_per_min(rpm);
    let theoretical = mm_per_min(PollSpeedsReply::THEORETICAL_SPEED.physical_by(reply.theoretical_speed, base));
    let real = mm_per_min(PollSpeedsReply::REAL_SPEED.physical_by(reply.real_speed, base));
    assert!((theoretical - 195.0781).abs() < 1e-4 && (real - 333.3594).abs() < 1e-4, "{theoretical}, {real}");
}

#[test]
fn override_version_and_status() {
    // Section 4.2: 90 % is 0x005A.
    assert_eq!(sent(&CmdSetOverr { r#override: 90 }), [1, 0x08, 0xD0, 0x00, 0x00, 0x5A]);
    // Section 4.16: 0x0067 is version 103.
    let request = sent(&CmdGetVer);
    let reply = CmdGetVerReply::read(&request, &mut Reader::new(&[1, 0x02, 0x80, 0x00, 0x00, 0x67]));
    assert_eq!(reply.map(|reply| reply.version), Some(103));
    assert!(reply.is_some_and(|reply| reply.status == types::BitStato::new().with_command_complete(true)));
}

/// A motor that returns the last written value for any parameter.
struct Last(Vec<u8>);

impl Client for Last {
    type Bus = Serial;
    type Error = core::convert::Infallible;

    fn read(&mut self, _: Parameter, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>> {
        buffer.copy_from_slice(&self.0);
        Ok(self.0.len())
    }

    fn write(&mut self, _: Parameter, data: &[u8]) -> Result<(), Error<Self::Error>> {
        self.0 = data.to_vec();
        Ok(())
    }
}

#[test]
fn fractions() {
    // Section 6.1.2, step 1: 200 / 32768 of 8000 rpm are 48.8 rpm.
    let rpm = objects::RESERVED1.physical_by(200, models::sm137_rev_b::SPEED_BASE);
    assert!((rpm - 48.8).abs() < 0.05, "{rpm}");
    // Appendix A, notation Q15: 5 A are 14482 if the base current is 11.313 A. The table of base values prints 11.3137
    // A.
    let mut client = Last(Vec::new());
    let base = models::sm137_rev_b::CURRENT_BASE;
    objects::MAXTORQUE.at(&mut client).write_scaled_by(5.0, base).expect("within the base value");
    assert_eq!(client.0, 14_482_i16.to_le_bytes());
    assert!((objects::MAXTORQUE.physical_by(14_482, base) - 5.0).abs() < 1e-3);
}

#[test]
fn mantissa_and_exponent() {
    // Appendix A: the default gain of the position controller is 5. The parameters for this gain are 20480 and 3.
    assert_eq!(objects::KPOSPIMANT.physical_by(20_480, 3.0), 5.0);
    assert_eq!(objects::KPOSPIMANT.mantissa_and_exponent(5.0, 0..=6), Ok((20_480, 3)));
    assert_eq!(objects::KPOSPIMANT.mantissa_and_exponent(64.0, 0..=6), Err(OutOfRange));
    // Appendix A, notation ME15: two representations of 15.5.
    assert_eq!(
        [(31_744, 4.0), (15_872, 5.0)].map(|(raw, power)| objects::KVELPIMANT.physical_by(raw, power)),
        [15.5; 2]
    );
    assert_eq!(objects::KVELPIMANT.mantissa_and_exponent(15.5, 0..=6), Ok((31_744, 4)));
    assert_eq!(objects::KVELPIMANT.mantissa_and_exponent(15.5, 5..=6), Ok((15_872, 5)));
    let mut client = Last(Vec::new());
    objects::KPOSPIMANT.at(&mut client).write_scaled_by(5.0, 3.0).expect("in range");
    assert_eq!(client.0, 20_480_i16.to_le_bytes());
}

#[test]
fn gains_of_a_controller() {
    // Appendix A, gains of PI controllers: Kp 0.5, Ki 0.08 and 15 %. The gains of the other two controllers use the
    // same notation.
    let (sum, correction) = (0.5 + 0.08, 0.08 / (0.5 + 0.08));
    for mantissa in [objects::KIQDPIMANT, objects::KVELPIMANT, objects::KPOSPIMANT] {
        assert_eq!(mantissa.mantissa_and_exponent(sum, 0..=6), Ok((19_005, 0)), "{}", mantissa.name());
    }
    for gain in [objects::KIQDKCOR, objects::KVELKCOR, objects::KPOSKCOR] {
        assert_eq!(gain.raw(correction), Ok(4520), "{}", gain.name());
    }
    for percentage in [objects::KVELKFF, objects::KPOSKFF] {
        assert_eq!(percentage.raw(15.0), Ok(4915), "{}", percentage.name());
    }
}

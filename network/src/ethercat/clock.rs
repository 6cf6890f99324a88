//! The distributed clocks of a SubDevice.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::{ClockMode, ClockTime, Device};
use lexibus_codegen::source::Span;
use lexibus_codegen::text::similar;

use super::declared::DeclaredSubDevice;
use super::segment::{Clock, ClockSignal, ClockSyncManager};

/// Bit of `AssignActivate` that activates SYNC0 (register 0x0981, bit 1).
const SYNC0: u32 = 0x0200;

/// Returns the settings of the mode that the file chooses, or of the default mode. Returns `None` if there is no such mode. `cycle` is the
/// cycle time of the segment in ns.
pub(super) fn resolve(
    device: &Device,
    declared: &DeclaredSubDevice,
    cycle: Option<u64>,
    diagnostics: &mut Diagnostics,
) -> Option<Clock> {
    let clocks = device.ethercat.as_ref().and_then(|settings| settings.clocks.as_ref());
    let modes = clocks.map_or(&[][..], |clocks| &clocks.modes);
    let (mode, span) = match &declared.clock_mode {
        None => (modes.first()?, declared.name.span),
        Some(name) => match modes.iter().find(|mode| mode.name == name.value) {
            Some(mode) => (mode, name.span),
            None => {
                diagnostics.push(unknown(device, modes, &name.value, name.span));
                return None;
            }
        },
    };
    if cycle.is_none() && depends_on_cycle(mode) {
        let message = format!("the mode `{}` of the distributed clocks needs the cycle time of the segment", mode.name);
        let found = Diagnostic::new(&codes::NETWORK_VALUE, span, message);
        diagnostics.push(found.help("add `cycle` in µs to the section `segment`"));
    }
    Some(clock(mode, cycle.unwrap_or(0)))
}

fn unknown(device: &Device, modes: &[ClockMode], name: &str, span: Span) -> Diagnostic {
    let message = format!("`{}` has no mode `{name}` of the distributed clocks", device.name);
    let found = Diagnostic::new(&codes::NO_SUCH_CLOCK_MODE, span, message);
    let names = || modes.iter().map(|mode| mode.name.as_str());
    match similar(name, names()) {
        Some(similar) => found.help(format!("write `{similar}`")),
        None if modes.is_empty() => found.help("remove the key; the description has no modes"),
        None => found.help(format!("use one of the modes {}", names().collect::<Vec<_>>().join(", "))),
    }
}

/// Returns the cycle time of SYNC0 as the description states it. If SYNC0 is active and the description states neither a
/// time nor a factor, returns the cycle time of the segment.
fn cycle_sync0(mode: &ClockMode) -> ClockTime {
    let is_active = mode.assign_activate & SYNC0 != 0;
    match mode.cycle_sync0 {
        ClockTime { nanoseconds: 0, factor: None, input } if is_active => {
            ClockTime { nanoseconds: 0, factor: Some(1), input }
        }
        stated => stated,
    }
}

/// Returns whether the mode is active and its SYNC0 cycle time or shift time depends on the cycle time of the segment.
fn depends_on_cycle(mode: &ClockMode) -> bool {
    let has_factor = |time: ClockTime| time.factor.is_some_and(|factor| factor != 0);
    mode.assign_activate != 0 && (has_factor(cycle_sync0(mode)) || has_factor(mode.shift_sync0))
}

fn clock(mode: &ClockMode, cycle: u64) -> Clock {
    let cycle = cycle as i64;
    let sync0 = time(cycle_sync0(mode), cycle);
    let signal = |cycle_time, shift: ClockTime, cycle| ClockSignal {
        cycle_time,
        shift_time: time(shift, cycle),
        relative_to_inputs: shift.input,
    };
    let sync_manager = |manager: &lexibus_codegen::ir::ClockSyncManager| ClockSyncManager {
        number: manager.number,
        sync_type: manager.sync_type,
        pdos: manager.pdos.clone(),
    };
    Clock {
        mode: mode.name.to_string(),
        assign_activate: mode.assign_activate,
        sync0: signal(sync0, mode.shift_sync0, cycle),
        sync1: signal(time(mode.cycle_sync1, sync0), mode.shift_sync1, sync0),
        sync_managers: mode.sync_managers.iter().map(sync_manager).collect(),
    }
}

/// Returns a time in ns: the sum of the constant part and the multiple or fraction of a cycle time.
fn time(time: ClockTime, cycle: i64) -> i64 {
    let part = match time.factor.unwrap_or(0) {
        factor @ 1.. => cycle.saturating_mul(factor.into()),
        0 => 0,
        divisor => cycle / -i64::from(divisor),
    };
    part.saturating_add(time.nanoseconds.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_follow_the_cycle() {
        let of = |nanoseconds, factor, cycle| time(ClockTime { nanoseconds, factor, input: false }, cycle);
        assert_eq!(of(0, Some(1), 1_000_000), 1_000_000);
        assert_eq!(of(-5_000, Some(-4), 1_000_000), 245_000);
        assert_eq!(of(30_000, None, 1_000_000), 30_000);
        assert_eq!(of(i32::MIN, Some(i32::MIN), u32::MAX.into()), 1 - (1 << 31));
    }

    #[test]
    fn sync1_depends_on_the_cycle_of_sync0() {
        let sync1 =
            |sync0, assign_activate| {
                let [cycle_sync0, cycle_sync1] = [(sync0, None), (1_000, Some(2))]
                    .map(|(nanoseconds, factor)| ClockTime { nanoseconds, factor, input: false });
                let mode = ClockMode { assign_activate, cycle_sync0, cycle_sync1, ..ClockMode::default() };
                clock(&mode, 2_000_000).sync1.cycle_time
            };
        assert_eq!(sync1(500_000, 0x0700), 1_001_000);
        // An active SYNC0 without a time has the cycle time of the segment.
        assert_eq!(sync1(0, 0x0700), 4_001_000);
        // Without SYNC0, the factor has no effect.
        assert_eq!(sync1(0, 0x0500), 1_000);
    }

    #[test]
    fn an_active_sync0_without_times_has_the_cycle_of_the_segment() {
        let mode = ClockMode { assign_activate: 0x0700, ..ClockMode::default() };
        assert!(depends_on_cycle(&mode));
        assert_eq!(clock(&mode, 2_000_000).sync0.cycle_time, 2_000_000);
        let inactive = ClockMode::default();
        assert!(!depends_on_cycle(&inactive));
        assert_eq!(clock(&inactive, 2_000_000).sync0.cycle_time, 0);
    }
}

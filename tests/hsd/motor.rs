//! A simulated motor for the tests.

use std::collections::BTreeMap;

use lexibus::message::{Reply, Setting, WriteError, Writer};
use lexibus::Parameter;
use lexibus_drives::hsd::messages::*;
use lexibus_drives::hsd::types::{BitStato, State};

/// A motor that reaches its target at the second poll.
#[derive(Default)]
pub struct Motor {
    parameters: BTreeMap<u32, Setting>,
    position: i32,
    target: i32,
    selected: Selected,
    polls: u32,
}

/// The values that the reply to the null request contains.
#[derive(Clone, Copy, Default, PartialEq)]
enum Selected {
    #[default]
    Position,
    Speeds,
}

impl Motor {
    fn status(&self) -> BitStato {
        BitStato::new().with_command_complete(self.position == self.target)
    }

    /// Executes a request to node 5 and writes the reply. Ignores requests to other nodes and invalid requests.
    pub fn answer(&mut self, request: &[u8], to: &mut Writer<'_>) -> Result<(), WriteError> {
        let Some((5, received)) = Request::parse(request) else { return Ok(()) };
        match received {
            Request::CmdTraj(trajectory) => {
                (self.target, self.polls) = (trajectory.target, 0);
                CmdTrajReply { status: self.status() }.write(request, to)
            }
            Request::PollPosition(_) => self.poll(request, to),
            Request::CmdGetPos(_) => {
                self.selected = Selected::Position;
                CmdGetPosReply { status: self.status() }.write(request, to)
            }
            Request::CmdGetVel(_) => {
                self.selected = Selected::Speeds;
                CmdGetVelReply { status: self.status() }.write(request, to)
            }
            Request::CmdChgParN(change) => {
                self.parameters.extend(change.settings.iter().map(|setting| (setting.parameter.0, setting)));
                CmdChgParNReply { status: self.status() }.write(request, to)
            }
            Request::CmdGetParN(query) => {
                let setting = self.parameters.get(&query.parameter.0).copied();
                let setting = setting.unwrap_or_else(|| Setting::new(Parameter(query.parameter.0), [0; 8], 2));
                CmdGetParNReply { status: self.status(), setting }.write(request, to)
            }
            Request::CmdGetSmStat(_) => {
                CmdGetSmStatReply { status: self.status(), state: State::Stopped }.write(request, to)
            }
            _ => CmdNack { node: 5, status: self.status() }.write(request, to),
        }
    }

    fn poll(&mut self, request: &[u8], to: &mut Writer<'_>) -> Result<(), WriteError> {
        self.polls += 1;
        if self.polls == 2 {
            self.position = self.target;
        }
        let status = self.status();
        match self.selected {
            Selected::Position => PollPositionReply { status, real_position: self.position }.write(request, to),
            Selected::Speeds => {
                PollSpeedsReply { status, real_speed: 4267, theoretical_speed: 2497 }.write(request, to)
            }
        }
    }
}

//! `lexibus monitor`.

use std::time::{Duration, Instant};

use lexibus::clients::canopen::CanPort;
use lexibus::NodeId;
use lexibus_device::monitor::{Event, EventKind, Interpreter, Named};
use lexibus_device::{CanOpenConnection, Connection, Network, Parameter};

use super::events::Output;
use super::target::Watched;
use crate::args::Monitor;
use crate::interrupt::Deferred;
use crate::Failure;

/// Maximum time to wait for a frame before the periodic reads are checked.
const TURN: Duration = Duration::from_millis(50);

/// Determines when the monitor reads values and when it ends.
struct Schedule {
    start: Instant,
    next: Instant,
    period: Duration,
    duration: Option<Duration>,
    deferred: Deferred,
}

impl Schedule {
    fn new(arguments: &Monitor) -> Self {
        let start = Instant::now();
        let period = Duration::from_millis(arguments.period.into());
        let duration = arguments.duration.map(|duration| Duration::from_millis(duration.into()));
        Self { start, next: start, period, duration, deferred: Deferred::new() }
    }

    fn is_over(&self) -> bool {
        self.deferred.is_requested() || self.duration.is_some_and(|duration| self.start.elapsed() >= duration)
    }

    /// Returns whether the values must be read now. If so, schedules the next read.
    fn is_due(&mut self) -> bool {
        let is_due = Instant::now() >= self.next;
        if is_due {
            self.next = Instant::now() + self.period;
        }
        is_due
    }
}

pub(super) fn run(arguments: &Monitor) -> Result<bool, Failure> {
    let watched = Watched::new(&arguments.watched, arguments.bus.as_ref())?;
    let bus = watched.bus()?;
    let Some((node, first)) = watched.nodes.first() else { return Ok(true) };
    let parameters = arguments.read.iter().map(|name| first.find(name)).collect::<Result<Vec<_>, _>>();
    let parameters = parameters.map_err(|error| Failure::Usage(error.to_string()))?;
    let mut output = Output::new(std::io::stdout(), arguments.format)?;
    let timeout = Duration::from_millis(arguments.timeout.into());
    let mut schedule = Schedule::new(arguments);
    match bus.network() {
        Network::Modbus if parameters.is_empty() => {
            return Err(Failure::Usage("on Modbus, name the values to read with --read".to_owned()));
        }
        Network::Modbus => {
            let mut connection = bus.connect(first, *node, timeout)?;
            while !schedule.is_over() {
                match schedule.is_due() {
                    true => read(*node, &parameters, &mut connection, &schedule, &mut output)?,
                    false => std::thread::sleep(TURN.min(schedule.period)),
                }
            }
        }
        Network::CanOpen => {
            let id = NodeId::new(*node)
                .ok_or_else(|| Failure::Usage("the node-ID is not in the range 1 to 127".to_owned()))?;
            let mut connection = bus.open_port()?.connection(id, timeout);
            let nodes = watched.nodes.iter().map(|(node, description)| (*node, description));
            let mut interpreter = Interpreter::new(nodes);
            while !schedule.is_over() {
                if !parameters.is_empty() && schedule.is_due() {
                    read(*node, &parameters, &mut connection, &schedule, &mut output)?;
                }
                watch(&mut connection, &mut interpreter, &schedule, &mut output)?;
            }
        }
    }
    output.finish()?;
    Ok(true)
}

/// Waits up to [`TURN`] for a frame. Writes the event if the frame has one.
fn watch<P>(
    connection: &mut CanOpenConnection<lexibus::clients::canopen::Node<P>>,
    interpreter: &mut Interpreter<'_>,
    schedule: &Schedule,
    output: &mut Output<impl std::io::Write>,
) -> Result<(), Failure>
where
    P: CanPort<Error = lexibus_device::Failure>,
{
    let frame = connection.client().port().receive(TURN, &mut |_| true)?;
    if let Some(event) = frame.and_then(|frame| interpreter.interpret(&frame)) {
        output.put(Some(schedule.start.elapsed()), &event)?;
    }
    Ok(())
}

/// Reads values and writes them as one event.
fn read(
    node: u8,
    parameters: &[Parameter<'_>],
    connection: &mut impl Connection,
    schedule: &Schedule,
    output: &mut Output<impl std::io::Write>,
) -> Result<(), Failure> {
    let mut values = Vec::new();
    for parameter in parameters {
        let value = parameter.read(connection);
        let value = value.map_or_else(|failure| format!("error: {failure}"), |reading| reading.to_string());
        values.push(Named { address: parameter.address_text(), name: parameter.name(), value });
    }
    let event = Event { node: Some(node), kind: EventKind::Sdo, text: "read".to_owned(), values };
    Ok(output.put(Some(schedule.start.elapsed()), &event)?)
}

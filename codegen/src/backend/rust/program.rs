//! Names of the generated elements with which a program accesses a device. New drive crates use these names.

use super::constants::Constants;
use super::context::Context;
use super::device_names;
use super::item_addresses;
use super::locations::Locations;
use super::model;
use super::named::Types;
use super::naming::handles::NamedItem;
use super::objects::{self, ObjectModel};
use super::options::RustOptions;
use super::route::RouteBus;
use super::scope::Scope;
use super::simulation::{self, Simulation};
use super::target::{NoTarget, Path};
use super::walk::{self, WalkModel};
use super::{cia402::Cia402Model, example};
use crate::facts::words::PLAIN;
use crate::ir::{excluded, Bus, Device, FileInfo, Item, ItemRef, Value};

/// The generated elements with which a program accesses a device on one bus. All paths are relative to the module of the
/// device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// Name of the driver's type.
    pub driver: String,
    /// Bus of the program: CANopen, EtherCAT or Modbus.
    pub bus: Bus,
    /// State machine that the program leads to its operating state, or the reason why the program cannot do so.
    pub machine: Option<Result<ProgramMachine, NoTarget>>,
    /// Operations of CiA 402.
    pub cia402: Option<ProgramCia402>,
    /// A number that the program reads, preferably a measured value.
    pub read: Option<ProgramItem>,
    /// A setting that the program writes, and its default value.
    pub write: Option<(ProgramItem, i128)>,
}

/// A state machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramMachine {
    /// Method that leads the state machine to a state.
    pub walk: String,
    /// Type of the states, in the module `types`.
    pub states: String,
    /// Path of the constant of the status item.
    pub status: String,
    /// State to which the program leads the device: its operating state. No fault state is on the path from the state after
    /// power-on.
    pub target: String,
    /// Behavior of a simulated device. `None` for the controlword and statusword of CiA 402, whose behavior
    /// `lexibus::sim` provides.
    pub simulation: Option<Simulation>,
}

/// Operations of CiA 402.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramCia402 {
    /// Method that returns the operations.
    pub method: String,
    /// Whether the device accepts target positions in the mode "profile position".
    pub positioning: bool,
    /// A raw target position within the limits of the device. `None` if the device does not accept target positions, or if no suitable
    /// value was found.
    pub target: Option<i128>,
    /// Call that reads the actual position, such as `position_actual_value()`.
    pub position: Option<String>,
}

/// An item that a program accesses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramItem {
    /// Call that returns the accessor, such as `profile_velocity()`.
    pub call: String,
    /// Name of the item in the description.
    pub name: String,
    /// Path of the constant, such as `objects::PROFILE_VELOCITY`.
    pub constant: String,
    /// Primitive type of the raw value, such as `u32`.
    pub native: &'static str,
    /// A raw value within the type and the limits of the item.
    pub sample: i128,
    /// Unit and resolution of the raw value, such as `unit rpm` or `1 LSB = 0.01 rev/s`. The text is empty if the item
    /// has neither a unit nor a scale.
    pub unit: String,
}

/// Buses of a program, in order of preference.
const BUSES: [RouteBus; 3] = [RouteBus::CanOpen, RouteBus::CoE, RouteBus::Modbus];

/// Returns the elements for a program that accesses `device` on `bus`. If `bus` is `None`, the possible buses are
/// CANopen, EtherCAT and Modbus, in this order. The program uses the first bus on which it can lead a state machine to
/// its operating state. If there is no such bus, the program uses the first bus on which it can access a state machine.
/// If it can access no state machine, it uses the first bus on which it can access a value. Returns `None` if the
/// program can access neither a state machine nor a value.
pub fn program(device: &Device, file: &FileInfo, bus: Option<Bus>) -> Option<Program> {
    let options = RustOptions::default();
    let driver = device_names::device_name(device, file, None);
    let context = model::context(Scope::of_device(device), &options, &driver);
    let locations = Locations::of(&context);
    let objects = objects::models(&context, &locations);
    let types = Types::of(&context, &options);
    let constants = Constants { context: &context, locations: &locations, objects: &objects };
    let walks = walk::models(&constants, &types.machines);
    let parts = Parts { context: &context, constants: &constants, walks: &walks, objects: &objects };
    let possible = || BUSES.into_iter().filter(|route| bus.is_none_or(|bus| route.of_items() == bus));
    let machines = || possible().filter_map(|route| Some((route, Some(parts.machine(&types, route)?))));
    let with_machine = machines().find(|(_, machine)| matches!(machine, Some(Ok(_)))).or_else(|| machines().next());
    let usable = || possible().find(|route| parts.read(*route).is_some() || parts.write(*route).is_some());
    let (route, machine) = with_machine.or_else(|| Some((usable()?, None)))?;
    let cia402 = Cia402Model::new(&constants, &walks)
        .filter(|_| matches!(&machine, Some(Ok(machine)) if machine.simulation.is_none()));
    Some(Program {
        driver,
        bus: route.of_items(),
        machine,
        cia402: cia402.map(|model| parts.cia402(&model, route)),
        read: parts.read(route),
        write: parts.write(route),
    })
}

/// Results of the back end's stages. The elements of a program are chosen from these results.
struct Parts<'p, 'a> {
    context: &'p Context<'a>,
    constants: &'p Constants<'p, 'a>,
    walks: &'p [WalkModel],
    objects: &'p [ObjectModel],
}

impl Parts<'_, '_> {
    /// Returns the first state machine that has an operating state, and whose status item and control item can be
    /// accessed on a bus. If there is no such machine, returns the reason why the program does not use the first
    /// machine on the bus. Returns `None` if no machine is on the bus.
    fn machine(&self, types: &Types, bus: RouteBus) -> Option<Result<ProgramMachine, NoTarget>> {
        let machines = self.context.names.types.machines.iter().zip(&types.machines).enumerate();
        let mut on_bus = machines.filter_map(|(position, (named, model))| {
            let walk = self.walks.iter().find(|walk| walk.machine == position)?;
            let (status, control) = (&named.machine.status_item, &named.machine.control_item);
            let is_on = |item, writes| self.context.referred(item).is_some_and(|item| self.is_on(item, bus, writes));
            if !is_on(status, false) || !is_on(control, true) {
                return None;
            }
            let is_at = |object, item: &ItemRef| self.constants.object(object).map(|it| it.id()) == item.id;
            let is_cia402 = is_at((0x6040, 0), control) && is_at((0x6041, 0), status);
            let path = match Path::to_operation(named.machine, model) {
                Ok(path) => path,
                Err(reason) => return Some(Err(reason)),
            };
            let simulated = simulation::of(model, walk, &path)?;
            Some(Ok(ProgramMachine {
                walk: walk.method.clone(),
                states: walk.states.clone(),
                status: walk.status.clone(),
                target: path.target.to_owned(),
                simulation: (!is_cia402).then_some(simulated),
            }))
        });
        let first = on_bus.next()?;
        Some(first.or_else(|reason| on_bus.find_map(Result::ok).ok_or(reason)))
    }

    fn cia402(&self, model: &Cia402Model, bus: RouteBus) -> ProgramCia402 {
        let has = |name: &str| model.traits.iter().any(|implemented| implemented.path.ends_with(name));
        let object = |index| Some(self.constants.object((index, 0))?.id());
        let target = object(0x607A).and_then(|id| self.context.item(id)).filter(|item| self.is_on(item, bus, true));
        let position = object(0x6064).and_then(|id| self.calls().find(|(entry, _)| entry.id == id));
        let call = position.filter(|(entry, _)| self.is_on(entry.item, bus, false)).map(|(_, call)| call);
        ProgramCia402 {
            method: model.method.clone(),
            positioning: has("::Positioning"),
            target: target.and_then(|item| self.sample(item, bus, &[100, 1, 0])),
            position: call,
        }
    }

    /// Returns the number that a program reads on a bus, preferably a measured value. Returns `None` if there is no
    /// suitable item.
    fn read(&self, bus: RouteBus) -> Option<ProgramItem> {
        let is_usable = |item: &Item| self.is_on(item, bus, false) && self.sample(item, bus, &[1, 0]).is_some();
        let calls: Vec<(&NamedItem<'_>, String)> = self.calls().filter(|(entry, _)| is_usable(entry.item)).collect();
        let (entry, call) = example::readable(self.context, &calls)?;
        self.item(entry, call, self.sample(entry.item, bus, &[1, 0])?)
    }

    /// Returns the setting that a program writes on a bus, and its default value.
    fn write(&self, bus: RouteBus) -> Option<(ProgramItem, i128)> {
        let is_default_possible = |item: &Item| {
            let number = item.default_integer();
            item.default_on(bus.of_items()) == item.default.as_ref()
                && number.is_some_and(|number| self.is_possible(item, bus, number) && is_writable(item, number))
        };
        let is_usable = |item: &Item| self.is_on(item, bus, true) && is_default_possible(item);
        let calls: Vec<(&NamedItem<'_>, String)> = self.calls().filter(|(entry, _)| is_usable(entry.item)).collect();
        let (entry, call, number) = example::writable(self.context, &calls)?;
        Some((self.item(entry, call, number)?, number))
    }

    /// Returns the first raw value that an item can have on a bus: one of the `preferred` numbers, a limit, or an
    /// allowed value.
    fn sample(&self, item: &Item, bus: RouteBus, preferred: &[i128]) -> Option<i128> {
        let limits = item.limits_on(bus.of_items()).unwrap_or(&item.limits);
        let (low, high) = limits.integers();
        let first = limits.allowed.iter().filter_map(|(first, _)| first.as_int());
        let mut numbers = preferred.iter().copied().chain(low).chain(high).chain(first);
        numbers.find(|number| self.is_possible(item, bus, *number))
    }

    /// Returns whether a raw value is within the type and the limits of an item on a bus.
    fn is_possible(&self, item: &Item, bus: RouteBus, number: i128) -> bool {
        let bus = bus.of_items();
        let range = |ty| self.context.base(ty).integer_range();
        let fits = |ty| range(ty).is_some_and(|(low, high)| (low..=high).contains(&number));
        let mut limits = item.limits_on(bus).into_iter().chain([&*item.limits]);
        fits(item.ty) && fits(item.type_on(bus)) && limits.all(|limits| excluded(limits, &Value::Int(number)).is_none())
    }

    fn item(&self, entry: &NamedItem<'_>, call: &str, sample: i128) -> Option<ProgramItem> {
        let all = self.objects.iter().flat_map(|object| object.items.iter().map(move |model| (object, model)));
        let (object, model) = all.into_iter().find(|(_, model)| model.id == entry.id)?;
        let item = entry.item;
        Some(ProgramItem {
            call: call.to_owned(),
            name: item.name.to_string(),
            constant: object.path(model),
            native: self.context.value_type(item.ty).native()?,
            sample,
            unit: item.quantity.as_deref().and_then(|quantity| PLAIN.unit(quantity)).unwrap_or_default(),
        })
    }

    /// Returns the items that are integers of 8, 16 or 32 bits without an enumeration or bit field, and the calls of
    /// their accessors. Sub-index 0 of objects with several entries is left out, because it contains the number of
    /// sub-indices.
    fn calls(&self) -> impl Iterator<Item = (&NamedItem<'_>, String)> {
        let is_count =
            |item: &Item, call: &str| call.contains('.') && item.object().is_some_and(|(_, sub_index)| sub_index == 0);
        objects::calls(self.context)
            .filter(move |(entry, call)| example::is_number(self.context, entry.item) && !is_count(entry.item, call))
    }

    /// Returns whether a client on `bus` can read the item or, if `writes` is set, write it.
    fn is_on(&self, item: &Item, bus: RouteBus, writes: bool) -> bool {
        item_addresses::address(self.context, item, bus, writes).is_some()
    }
}

/// Returns whether a device accepts this raw value. Returns true if the description does not restrict the values that
/// the device accepts.
fn is_writable(item: &Item, number: i128) -> bool {
    let values = item.behavior.as_deref().map(|behavior| behavior.writable_values.as_slice()).unwrap_or_default();
    values.is_empty() || values.contains(&Value::Int(number))
}

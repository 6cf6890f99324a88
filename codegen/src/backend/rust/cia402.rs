//! Objects of CiA 402 that a device has and the runtime uses for its CiA 402 operations.

use super::code::Doc;
use super::constants::{accesses, bound, Constant, Constants};
use super::method_names::{reserved, unused_name};
use super::walk::WalkModel;
use crate::facts::words::enumerated;

/// The method that returns the CiA 402 operations, and the traits that the operations need, ready to be printed.
pub(super) struct Cia402Model {
    /// Name of the method that returns the CiA 402 operations.
    pub method: String,
    pub docs: Vec<String>,
    /// Traits of the runtime that the device's type implements.
    pub traits: Vec<TraitModel>,
}

/// Implementation of a trait of the runtime.
pub(super) struct TraitModel {
    /// Path of the trait without its parameter.
    pub path: &'static str,
    pub functions: Vec<FunctionModel>,
    /// Trait bounds of the location types.
    pub bounds: Vec<Doc>,
}

/// A trait function that returns an object.
pub(super) struct FunctionModel {
    pub name: &'static str,
    /// Whether the operations read the object, and whether they write it.
    pub access: (bool, bool),
    /// Path of the object's constant.
    pub path: String,
}

/// An object of CiA 402: its address, the function that returns it, and whether the operations read it and write it.
struct Role {
    object: (u16, u8),
    function: &'static str,
    access: (bool, bool),
}

const READ: (bool, bool) = (true, false);
const WRITE: (bool, bool) = (false, true);

const CONTROLWORD: Role = Role { object: (0x6040, 0), function: "controlword", access: (true, true) };
const STATUSWORD: Role = Role { object: (0x6041, 0), function: "statusword", access: READ };
const MODE: Role = Role { object: (0x6060, 0), function: "modes_of_operation", access: WRITE };
const ACTIVE_MODE: Role = Role { object: (0x6061, 0), function: "modes_of_operation_display", access: READ };
/// The error code is read from object 0x1003:1 if a client cannot read object 0x603F.
const ERROR_CODE: Role = Role { object: (0x603F, 0), function: "error_code", access: READ };
const FOLLOWING_ERROR: Role = Role { object: (0x60F4, 0), function: "following_error", access: READ };

/// For each optional trait of a drive: path of the trait, object that the drive must have, and text for the
/// documentation.
const CAPABILITIES: [(&str, Role, &str); 3] = [
    (
        "rt::cia402::Positioning",
        Role { object: (0x607A, 0), function: "target_position", access: WRITE },
        "set-points with handshake",
    ),
    ("rt::cia402::Velocity", Role { object: (0x60FF, 0), function: "target_velocity", access: WRITE }, "velocities"),
    ("rt::cia402::Homing", Role { object: (0x6098, 0), function: "homing_method", access: WRITE }, "homing"),
];

/// A role, and the constant of the device's object for this role.
type Played<'r, 'c> = (&'r Role, Constant<'c>);

impl Cia402Model {
    /// Returns the model of a device. Returns `None` unless the device has the CiA 402 state machine, and the objects
    /// 0x6040, 0x6041, 0x6060 and 0x6061 with access rights that allow the operations.
    pub(super) fn new(constants: &Constants<'_, '_>, walks: &[WalkModel]) -> Option<Self> {
        let find = |role: &Role| {
            let (reads, writes) = role.access;
            let is_allowed =
                |constant: &Constant<'_>| (!reads || constant.is_readable()) && (!writes || constant.is_writable());
            constants.object(role.object).filter(is_allowed)
        };
        let mut core = Vec::new();
        for role in [&CONTROLWORD, &STATUSWORD, &MODE, &ACTIVE_MODE] {
            core.push((role, find(role)?));
        }
        let [(_, control), (_, status), ..] = core.as_slice() else { return None };
        let is_drive =
            |walk: &WalkModel| walk.energized.is_some() && walk.control == control.path && walk.status == status.path;
        if !walks.iter().any(is_drive) {
            return None;
        }
        // Use the error code and the following error only if they have the same location type as a mandatory object
        // that the operations read. Otherwise, these optional objects would restrict the buses of the operations.
        let read = accesses(core.iter().map(located));
        let is_everywhere =
            |constant: &Constant<'_>| read.get(constant.location.as_str()).is_some_and(|access| access.0);
        let code = constants.error_code().filter(is_everywhere).map(|constant| (&ERROR_CODE, constant));
        let following = find(&FOLLOWING_ERROR).filter(is_everywhere).map(|constant| (&FOLLOWING_ERROR, constant));
        core.extend(code.into_iter().chain(following));
        let mut traits = vec![implementation("rt::cia402::Objects", &core, &[])];
        let mut operations = vec!["change of the mode"];
        for (path, role, operation) in &CAPABILITIES {
            let Some(constant) = find(role) else { continue };
            traits.push(implementation(path, &[(role, constant)], &core));
            operations.push(operation);
        }
        let names = constants.objects.iter().map(|object| object.name.as_str());
        let walks = walks.iter().map(|walk| walk.method.as_str());
        let used: Vec<&str> = names.chain(walks).chain(reserved()).collect();
        let method = unused_name(|name| used.contains(&name.as_str()), "cia402".to_owned());
        Some(Self { method, docs: documentation(&operations), traits })
    }
}

/// Returns the implementation of a trait for these objects. `core` contains the objects of the supertrait.
fn implementation(path: &'static str, objects: &[Played<'_, '_>], core: &[Played<'_, '_>]) -> TraitModel {
    let function = |(role, constant): &Played<'_, '_>| FunctionModel {
        name: role.function,
        access: role.access,
        path: constant.path.clone(),
    };
    let all = accesses(objects.iter().chain(core).map(located));
    TraitModel {
        path,
        functions: objects.iter().map(function).collect(),
        bounds: all.iter().map(|(location, access)| bound(location, "B", *access)).collect(),
    }
}

/// Returns the location type of an object, and whether the operations read the object and write it.
fn located<'p>(played: &'p Played<'_, '_>) -> (&'p str, (bool, bool)) {
    let (role, constant) = played;
    (&constant.location, role.access)
}

fn documentation(operations: &[&str]) -> Vec<String> {
    vec![
        format!("Returns the operations of CiA 402: {}.", enumerated(operations)),
        String::new(),
        "The operations need a drive in the state \"Operation enabled\", except the change of the mode. See \
         [`rt::cia402`]."
            .to_owned(),
    ]
}

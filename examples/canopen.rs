//! Moves a CANopen drive after power-on. Uses SDO transfers first, then PDOs.
//!
//!     cargo run --example canopen --features std,canopen
//!
//! The node is simulated at the level of CAN frames. For a real node, replace `simulated_node` with a CAN interface
//! such as `socketcan::CanSocket::open("can0")?`.

use std::error::Error;
use std::time::Duration;

use lexibus::clients::canopen::{NmtCommand, NmtState, Node};
use lexibus::sim::{CanNode, Device};
use lexibus::{AbortCode, NodeId};
use lexibus_drives::demo_drive::types::{Command, Controlword, ModesOfOperation, State, Statusword};
use lexibus_drives::demo_drive::{objects, pdo, DemoDrive, ENTRIES};

/// Maximum time to wait for a response.
const PATIENCE: Duration = Duration::from_millis(500);
/// Maximum number of steps of the state machine, and of SYNC cycles.
const MOST_STEPS: u32 = 100;

type Drive = DemoDrive<Node<CanNode>>;

fn main() -> Result<(), Box<dyn Error>> {
    let id = NodeId::new(5).ok_or("a node-ID is 1 to 127")?;
    let mut drive = DemoDrive::new(Node::new(simulated_node(id)?, id));
    drive.client().nmt(NmtCommand::ResetNode)?;
    drive.client().wait_for(NmtState::BootUp, PATIENCE)?;
    println!("node {id} has booted");
    let mut text = [0; 32];
    println!("it is a {:?}", drive.manufacturer_device_name().read_into(&mut text)?);

    drive.modes_of_operation().write(ModesOfOperation::ProfilePosition)?;
    drive.profile_velocity().write(20_000)?;
    match drive.profile_velocity().write(600_000) {
        Err(error) => println!("600000 is not sent: {error}"),
        Ok(()) => return Err("the range was not checked".into()),
    }
    // Resets a fault if there is one, and enables the drive.
    drive.walk(State::OperationEnabled, PATIENCE)?;
    move_to(&mut drive, id, 100_000)
}

/// Moves the drive with process data. RPDO 2 contains the target position, and TPDO 2 the actual position. Both are
/// synchronized with SYNC.
fn move_to(drive: &mut Drive, id: NodeId, target: i32) -> Result<(), Box<dyn Error>> {
    for write in pdo::RxPdo2::configuration(id).iter().chain(&pdo::TxPdo2::configuration(id)) {
        write.send(drive.client())?;
    }
    let node = drive.client();
    node.nmt(NmtCommand::Start)?;
    let enabled = Controlword::new().with_command(Command::EnableOperation);
    let new_set_point = enabled.in_profile_position().with_new_set_point(true).controlword();
    for cycle in 0..MOST_STEPS {
        let controlword = if cycle == 0 { new_set_point } else { enabled };
        let output = pdo::RxPdo2 { controlword, target_position: target };
        node.send_pdo(pdo::RxPdo2::COB_ID, &output.pack())?;
        node.sync()?;
        let frame = node.receive_pdo(pdo::TxPdo2::COB_ID, PATIENCE)?;
        let input = pdo::TxPdo2::unpack(frame.data())?;
        println!("cycle {cycle}: at {}", input.position_actual_value);
        if input.statusword.target_reached() {
            println!("the target is reached");
            return Ok(());
        }
    }
    Err("the drive doesn't reach the target".into())
}

/// Returns a simulated drive. Each write of the controlword moves the enabled drive by a part of the distance.
fn simulated_node(id: NodeId) -> Result<CanNode, Box<dyn Error>> {
    let mut device = Device::new(ENTRIES).with_node_id(id);
    device.set_initial(objects::STATUSWORD, Statusword::from_raw(0x40))?;
    device.on_write(objects::CONTROLWORD, |device, controlword| {
        let state = device.get(objects::STATUSWORD)?.state().ok_or(AbortCode::INTERNAL_INCOMPATIBLE)?;
        let is = |command: Command| controlword.raw() & command.mask() == command.value();
        let mut status = Statusword::from_raw(match state {
            State::SwitchOnDisabled if is(Command::Shutdown) => 0x21,
            State::ReadyToSwitchOn if is(Command::SwitchOn) => 0x23,
            State::SwitchedOn if is(Command::EnableOperation) => 0x27,
            _ => device.get(objects::STATUSWORD)?.raw(),
        });
        if state == State::OperationEnabled {
            let (target, from) = (device.get(objects::TARGET_POSITION)?, device.get(objects::POSITION_ACTUAL_VALUE)?);
            let to = from + (target - from).clamp(-30_000, 30_000);
            device.set(objects::POSITION_ACTUAL_VALUE, to)?;
            status = status.with_target_reached(to == target);
        }
        device.set(objects::STATUSWORD, status)
    })?;
    Ok(CanNode::new(device))
}

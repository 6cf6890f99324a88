//! Moves a CANopen drive after power-on. Uses SDO transfers first, then PDOs.
//!
//!     cargo run --example canopen --features std,canopen
//!
//! The node is simulated at the level of CAN frames, and behaves as a drive of CiA 402. One of its replies and
//! one of its PDOs are lost. For a
//! real node, replace `FaultyCan` with a CAN interface such as `socketcan::CanSocket::open("can0")?`.

use std::error::Error;
use std::time::Duration;

use lexibus::clients::canopen::{NmtCommand, NmtState, Node};
use lexibus::sim::{CanFault, CanNode, Device, FaultyCan};
use lexibus::NodeId;
use lexibus_drives::demo_drive::types::{Command, Controlword, ModesOfOperation, State};
use lexibus_drives::demo_drive::{pdo, DemoDrive, ENTRIES};

/// Maximum time to wait for a response.
const PATIENCE: Duration = Duration::from_millis(500);
/// Time between two SYNC messages.
const CYCLE: Duration = Duration::from_millis(50);
/// Maximum number of SYNC cycles.
const MOST_CYCLES: u32 = 100;

type Drive = DemoDrive<Node<FaultyCan<CanNode>>>;

fn main() -> Result<(), Box<dyn Error>> {
    let id = NodeId::new(5).ok_or("a node-ID is 1 to 127")?;
    // Each CAN frame to the simulated node takes a millisecond of simulated time.
    let device = Device::new(ENTRIES).with_node_id(id).with_cia402().with_access_time(Duration::from_millis(1));
    let mut drive = DemoDrive::new(Node::new(FaultyCan::new(CanNode::new(device)), id).with_timeout(PATIENCE));
    drive.client().nmt(NmtCommand::ResetNode)?;
    drive.client().wait_for(NmtState::BootUp, PATIENCE)?;
    println!("node {id} has booted");
    let mut text = [0; 32];
    println!("it is a {:?}", drive.manufacturer_device_name().read_into(&mut text)?);

    drive.modes_of_operation().write(ModesOfOperation::ProfilePosition)?;
    drive.profile_velocity().write(100_000)?;
    drive.profile_acceleration().write(500_000)?;
    match drive.profile_velocity().write(600_000) {
        Err(error) => println!("600000 is not sent: {error}"),
        Ok(()) => return Err("the range was not checked".into()),
    }
    // The client aborts a transfer without a reply. The next transfer is right.
    drive.client().port().inject_nth(CanFault::Lost, 1);
    match drive.profile_velocity().read() {
        Err(error) => println!("a reply is lost: {error}"),
        Ok(_) => return Err("the reply was not lost".into()),
    }
    println!("the next reply: velocity {}", drive.profile_velocity().read()?);
    // Resets a fault if there is one, and enables the drive.
    drive.walk(State::OperationEnabled, PATIENCE)?;
    move_to(&mut drive, id, 50_000)
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
    for cycle in 0..MOST_CYCLES {
        let controlword = if cycle == 0 { new_set_point } else { enabled };
        let output = pdo::RxPdo2 { controlword, target_position: target };
        node.send_pdo(pdo::RxPdo2::COB_ID, &output.pack())?;
        if cycle == 3 {
            node.port().inject_nth(CanFault::Lost, 1); // the PDO that the node sends after SYNC
        }
        node.sync()?;
        // With a CAN interface, wait for the next cycle with a timer instead.
        node.port().bus().advance(CYCLE);
        // Discards older PDOs. A real program stops after several cycles without a PDO.
        let Some(frame) = node.latest_pdo(pdo::TxPdo2::COB_ID)? else {
            println!("cycle {cycle}: no PDO");
            continue;
        };
        let input = pdo::TxPdo2::unpack(frame.data())?;
        println!("cycle {cycle}: at {}", input.position_actual_value);
        if input.statusword.target_reached() {
            println!("the target is reached");
            return Ok(());
        }
    }
    Err("the drive doesn't reach the target".into())
}

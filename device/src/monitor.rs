//! Traffic of a CANopen bus by name: NMT commands, states, emergency messages, SDO transfers and PDOs.
//!
//! An [`Interpreter`] has the descriptions of some nodes, and converts frames to [`Event`]s. It doesn't send anything.
//!
//! ```
//! use lexibus::clients::canopen::CanFrame;
//! use lexibus_codegen::compile::Options;
//! use lexibus_codegen::source::Source;
//! use lexibus_device::monitor::Interpreter;
//! use lexibus_device::{Description, Network};
//!
//! let file = Source::read("../dictionaries/demo-drive.eds".as_ref())?;
//! let drive = Description::compile(file, Network::CanOpen, &Options::default())?;
//! let mut interpreter = Interpreter::new([(5, &drive)]);
//! let frame = CanFrame::new(0x085, &[0x11, 0x86, 0x21, 0, 0, 0, 0, 0]).expect("a frame");
//! let event = interpreter.interpret(&frame).expect("an emergency message");
//! assert_eq!(event.to_string(), "node 5: EMCY 0x8611 (following error), error register 0x21");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod block;
mod emergency;
mod event;
mod interpreter;
mod process;
mod sdo;

pub(crate) use interpreter::state_name;

pub use event::{Event, EventKind, Named};
pub use interpreter::Interpreter;

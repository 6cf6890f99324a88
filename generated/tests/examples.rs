//! Compiles the example at the beginning of each driver's documentation. In the generated code, the examples are not
//! tested, because the compiler does not know the crate that contains the code.

#![cfg(all(feature = "akd", feature = "demo-drive", feature = "eco", feature = "hsd", feature = "vector-step"))]

use std::fmt::Debug;
use std::time::Duration;

use lexibus::{CanOpen, Client, CoE, Serial};

/// Any error.
struct Failed;

impl<E: Debug> From<E> for Failed {
    fn from(_: E) -> Self {
        Failed
    }
}

fn akd<C: Client<Bus = CoE, Error = ()>>(client: C) -> Result<i32, Failed> {
    use lexibus_drives::akd::{types, Akd};
    let mut drive = Akd::new(client);
    drive.walk_drive(types::DriveState::OperationEnabled, Duration::from_secs(2))?;
    let value = drive.second_position_feedback().read()?;
    Ok(value)
}

fn demo_drive<C: Client<Bus = CanOpen, Error = ()>>(client: C) -> Result<f32, Failed> {
    use lexibus_drives::demo_drive::{types, DemoDrive};
    let mut drive = DemoDrive::new(client);
    drive.walk(types::State::OperationEnabled, Duration::from_secs(2))?;
    let value = drive.motor_temperature().read()?;
    Ok(value)
}

fn eco<C: Client<Bus = CanOpen, Error = ()>>(client: C) -> Result<i32, Failed> {
    use lexibus_drives::eco::{types, Eco};
    let mut drive = Eco::new(client);
    drive.walk(types::State::OperationEnabled, Duration::from_secs(2))?;
    let value = drive.position_actual_value().read()?; // rev
    Ok(value)
}

fn hsd<C: Client<Bus = Serial, Error = ()>>(client: C) -> Result<i16, Failed> {
    use lexibus_drives::hsd::HsdMotor;
    let mut drive = HsdMotor::new(client);
    let value = drive.kp_i().read()?;
    drive.kp_i().write(30)?; // 0.30 (raw 30)
    Ok(value)
}

fn vector_step<C: Client<Bus = CanOpen, Error = ()>>(client: C) -> Result<i32, Failed> {
    use lexibus_drives::vector_step::{types, VectorStep};
    let mut drive = VectorStep::new(client);
    drive.walk(types::State::OperationEnabled, Duration::from_secs(2))?;
    let value = drive.rposactreq().read()?; // step
    drive.rhtinv().write(512)?; // 512
    Ok(value)
}

/// A client without a device.
struct Nothing<B>(std::marker::PhantomData<B>);

impl<B: lexibus::Bus> Client for Nothing<B> {
    type Bus = B;
    type Error = ();

    fn read(&mut self, _: B::Address, _: &mut [u8]) -> Result<usize, lexibus::Error<()>> {
        Err(lexibus::Error::Client(()))
    }

    fn write(&mut self, _: B::Address, _: &[u8]) -> Result<(), lexibus::Error<()>> {
        Err(lexibus::Error::Client(()))
    }
}

#[test]
fn examples_are_those_of_the_documentation() {
    let of_tests: Vec<&str> = include_str!("examples.rs").lines().map(str::trim).collect();
    for (name, code) in [
        ("akd", include_str!("../src/akd.rs")),
        ("demo_drive", include_str!("../src/demo_drive.rs")),
        ("eco", include_str!("../src/eco.rs")),
        ("hsd", include_str!("../src/hsd.rs")),
        ("vector_step", include_str!("../src/vector_step.rs")),
    ] {
        let mut lines = code.lines().map(str::trim).skip_while(|line| *line != "/// ```ignore").skip(1);
        let example: Vec<&str> =
            lines.by_ref().map_while(|line| line.strip_prefix("/// ")).take_while(|line| *line != "```").collect();
        assert!(example.len() > 1, "{name}: {example:?}");
        assert!(of_tests.windows(example.len()).any(|lines| lines == example), "{name}: {example:?}");
    }
}

#[test]
fn errors_end_the_examples() {
    assert!(akd(Nothing(Default::default())).is_err());
    assert!(demo_drive(Nothing(Default::default())).is_err());
    assert!(eco(Nothing(Default::default())).is_err());
    assert!(hsd(Nothing(Default::default())).is_err());
    assert!(vector_step(Nothing(Default::default())).is_err());
}

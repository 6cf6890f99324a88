//! Backups, restores and comparisons with the CANopen descriptions of the corpus, and a simulated device with the
//! objects and values that the description declares.

use std::collections::BTreeMap;

use crate::support::{described, repository};
use lexibus::{AbortCode, Object};
use lexibus_codegen::compile::Options as CompileOptions;
use lexibus_codegen::ir::{Type, Value};
use lexibus_codegen::source::Source;
use lexibus_device::backup::{backup, difference, Backup, Options};
use lexibus_device::restore::Plan;
use lexibus_device::verify::{verify, Options as VerifyOptions};
use lexibus_device::{Address, Connection, Description, Failure, Network, Parameter};

const NODE: u8 = 5;

/// A simulated device with the objects and the initial values of its description.
struct Mirror {
    values: BTreeMap<Object, Vec<u8>>,
    write_only: Vec<Object>,
}

impl Mirror {
    fn new(description: &Description) -> Self {
        let mut mirror = Self { values: BTreeMap::new(), write_only: Vec::new() };
        for parameter in description.parameters() {
            let Some(object) = parameter.address().object() else { continue };
            mirror.values.entry(object).or_insert_with(|| initial(&parameter));
            if !parameter.access().readable() {
                mirror.write_only.push(object);
            }
        }
        mirror
    }
}

/// Returns the bytes of the value that the simulated device has. Tries the identity number, the initial value, the minimum,
/// the maximum and 0, and takes the first that fits the type and the limits. If none fits, all bytes are zero.
fn initial(parameter: &Parameter<'_>) -> Vec<u8> {
    let identity = &parameter.description().device().identity;
    let object = parameter.address().object();
    let number = match object.map(|object| (object.index, object.sub_index)) {
        Some((0x1018, 1)) => identity.vendor_id,
        Some((0x1018, 2)) => identity.product_code,
        Some((0x1018, 3)) => identity.revision_number,
        Some((0x1018, 4)) => identity.serial_number,
        _ => None,
    };
    let limits = parameter.limits();
    let within = [limits.low.clone(), limits.high.clone(), Some(Value::Int(0)), Some(Value::Real(0.0))];
    let candidates = [number.map(|number| Value::Int(number.into())), parameter.item().initial().cloned()];
    let encoded = candidates.into_iter().chain(within).flatten();
    let encoded = encoded.map(|value| (parameter.encode(&value, Some(NODE)), parameter.excluded(&value, Some(NODE))));
    let mut possible = encoded.filter_map(|(bytes, excluded)| excluded.is_none().then_some(bytes)?);
    possible.next().unwrap_or_else(|| match parameter.basic() {
        Type::TimeOfDay | Type::TimeDifference => vec![0; 6],
        _ => vec![0; parameter.length().unwrap_or(0)],
    })
}

impl Connection for Mirror {
    fn network(&self) -> Network {
        Network::CanOpen
    }

    fn read(&mut self, address: Address, _: usize) -> Result<Vec<u8>, Failure> {
        let Address::Object(object) = address else { unreachable!("CANopen") };
        if self.write_only.contains(&object) {
            return Err(Failure::Abort(AbortCode::WRITE_ONLY));
        }
        let has_index = self.values.keys().any(|known| known.index == object.index);
        let missing = if has_index { AbortCode::NO_SUB_INDEX } else { AbortCode::NO_OBJECT };
        self.values.get(&object).cloned().ok_or(Failure::Abort(missing))
    }

    fn write(&mut self, address: Address, data: &[u8]) -> Result<(), Failure> {
        let Address::Object(object) = address else { unreachable!("CANopen") };
        self.values.insert(object, data.to_vec());
        Ok(())
    }
}

/// Returns the names of the EDS, DCF and XDD files: a sample of the corpus, or all if `LEXIBUS_LANE` is `full`.
fn names() -> Vec<String> {
    if std::env::var("LEXIBUS_LANE").is_ok_and(|lane| lane == "full") {
        let folder = std::fs::read_dir(repository("../shared/corpus/eds")).into_iter().flatten().flatten();
        let mut names: Vec<String> = folder.map(|file| format!("eds/{}", file.file_name().to_string_lossy())).collect();
        names.sort();
        return names;
    }
    let list = std::fs::read_to_string(repository("tests/corpus-sample.txt")).expect("the sample");
    list.lines().filter(|line| line.starts_with("eds/")).map(str::to_owned).collect()
}

/// Returns the descriptions of the files in [`names`] that describe exactly one CANopen device.
fn descriptions() -> Vec<(String, Description)> {
    let read = |name: &str| {
        let source = Source::read(&repository("../shared/corpus").join(name)).ok()?;
        let description = Description::compile(source, Network::CanOpen, &CompileOptions::default()).ok()?;
        Some((name.to_owned(), description))
    };
    let found: Vec<_> = names().iter().filter_map(|name| read(name)).collect();
    if found.is_empty() {
        println!("skipped: the corpus is not next to the repository");
    }
    found
}

/// Runs `verify`, `backup` and `restore` for a description, and returns their wrong results.
fn faults(description: &Description) -> Vec<String> {
    let mut device = Mirror::new(description);
    let options = VerifyOptions { node_id: Some(NODE), ..VerifyOptions::default() };
    let report = verify(description, &mut device, &options).expect("a report");
    let mut faults: Vec<String> = report.deviations().map(ToString::to_string).collect();

    let options = Options { node_id: Some(NODE), ..Options::default() };
    let saved = backup(description, &mut device, &options).expect("a backup");
    match Backup::from_toml(&saved.toml(description), description) {
        Ok(read) => faults.extend(difference(description, &saved, &read).iter().map(|found| format!("TOML: {found}"))),
        Err(error) => faults.push(format!("TOML: {error}")),
    }
    let dcf = saved.dcf(description).expect("a DCF");
    // CiA 306 has no notation for the content of domains and of unknown types, and none for an empty byte string.
    let is_bytes = |address: &str| description.find(address).is_ok_and(|parameter| parameter.basic().is_bytes());
    let lost = dcf.lost.iter().filter(|lost| !is_bytes(&lost.address));
    faults.extend(lost.map(|lost| format!("DCF: {lost}")));
    let read = Backup::of_description(&described("backup.dcf", &dcf.text, Network::CanOpen));
    let plan = Plan::new(description, &read, Some(NODE), &[]);
    let outcome = plan.execute(&mut device, &mut |_| true);
    if !outcome.is_complete() {
        faults.push(format!("restore: {outcome}"));
    }
    let again = backup(description, &mut device, &options).expect("a backup");
    faults.extend(difference(description, &saved, &again).iter().map(|found| format!("restored: {found}")));
    faults
}

#[test]
fn a_device_that_matches_its_description_has_no_deviations_and_keeps_its_parameters() {
    let mut wrong = Vec::new();
    let descriptions = descriptions();
    assert!(descriptions.is_empty() || descriptions.len() > 20, "{} descriptions", descriptions.len());
    for (name, description) in descriptions {
        let faults = faults(&description);
        if !faults.is_empty() {
            wrong.push(format!("{name}: {}\n  {}", faults.len(), faults[..faults.len().min(4)].join("\n  ")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

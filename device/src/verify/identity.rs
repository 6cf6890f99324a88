//! The identity of a Modbus device: vendor name and order code, compared with its device identification (function 43).

use super::finding::{Finding, FindingKind};
use super::session::Run;
use crate::connection::Connection;
use crate::protection::letters;

/// Address of the findings in the report.
const IDENTITY: &str = "identity";

/// Compares the vendor name and the order code that the description states. Reports the identity as unverifiable if the description
/// states neither, or if the device identification cannot be read. Reports each fact that only the description states as unverifiable.
pub(super) fn check<C: Connection>(run: &mut Run<'_, C>) {
    let identity = &run.description.device().identity;
    // The product name of a register table is often that of a series, so the order code is compared instead.
    let facts = [(0, "vendor name", identity.vendor_name.as_str()), (1, "product code", identity.order_code.as_str())];
    let stated = || facts.into_iter().filter(|(_, _, declared)| !letters(declared).is_empty());
    if stated().next().is_none() {
        return unverifiable(run, "the description states neither vendor nor order code".to_owned());
    }
    let objects = match run.connection.identification() {
        Ok(objects) => objects,
        Err(failure) => return unverifiable(run, format!("no device identification (function 43): {failure}")),
    };
    for (id, fact, declared) in stated() {
        match objects.iter().find(|(object, text)| *object == id && !letters(text).is_empty()) {
            None => unverifiable(run, format!("the device identification has no {fact}")),
            Some((_, actual)) if agrees(declared, actual) => {}
            Some((_, actual)) => {
                let finding = Finding::of_device(FindingKind::Different, IDENTITY, fact);
                run.add(finding.compared(declared, actual));
            }
        }
    }
}

fn unverifiable<C: Connection>(run: &mut Run<'_, C>, message: String) {
    run.add(Finding::of_device(FindingKind::Unverifiable, IDENTITY, message));
}

/// Returns whether two names are the same, or one contains the other. Compares only letters and digits, and ignores case:
/// `AEC s.r.l.` and `AEC SRL` are the same.
fn agrees(one: &str, other: &str) -> bool {
    let (one, other) = (letters(one), letters(other));
    one.contains(&other) || other.contains(&one)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::address::{Address, Network};
    use crate::failure::Failure;
    use crate::testing::described;
    use crate::verify::Options;
    use lexibus_codegen::source::Source;

    const TABLE: &str = "lexibus = 1\n[device]\nname = \"Heater\"\nvendor = \"Warm s.r.l.\"\nbuses = [\"modbus\"]\n\
        [spaces.register]\nmodbus = { table = \"holding\", first = 0 }\n[[chapters]]\ntitle = \"Values\"\n\
        [chapters.registers]\nSpeed = { reg = 1, type = \"i16\" }\n";

    /// A device with this device identification.
    struct Identified(Result<Vec<(u8, String)>, Failure>);

    impl Connection for Identified {
        fn network(&self) -> Network {
            Network::Modbus
        }

        fn read(&mut self, _: Address, _: usize) -> Result<Vec<u8>, Failure> {
            Ok(vec![0; 2])
        }

        fn write(&mut self, _: Address, _: &[u8]) -> Result<(), Failure> {
            panic!("nothing is written")
        }

        fn identification(&mut self) -> Result<Vec<(u8, String)>, Failure> {
            self.0.clone()
        }
    }

    #[track_caller]
    fn reported(table: &str, identification: Result<&[(u8, &str)], Failure>, expected: &[&str]) {
        let description = described(Source::new("heater.toml", table.into()), Network::Modbus);
        let objects = |list: &[(u8, &str)]| list.iter().map(|(id, text)| (*id, (*text).to_owned())).collect();
        let (mut device, options) = (Identified(identification.map(objects)), Options::default());
        let mut run = Run::new(&description, &mut device, &options);
        check(&mut run);
        let found: Vec<String> = run.report.findings.iter().map(ToString::to_string).collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn vendor_and_product_are_compared() {
        reported(TABLE, Ok(&[(0, "WARM SRL"), (1, "H-1")]), &[]);
        let different = "different: identity: vendor name: declared Warm s.r.l., found Cold AG";
        reported(TABLE, Ok(&[(0, "Cold AG")]), &[different]);
        let missing = "unverifiable: identity: the device identification has no vendor name";
        reported(TABLE, Ok(&[(1, "H-1")]), &[missing]);
        reported(TABLE, Ok(&[(0, "")]), &[missing]);
        let refused =
            format!("unverifiable: identity: no device identification (function 43): {}", Failure::Exception(1));
        reported(TABLE, Err(Failure::Exception(1)), &[&refused]);
        let ordered = TABLE.replace("buses =", "order_code = \"H-1\"\nbuses =");
        reported(&ordered, Ok(&[(0, "Warm"), (1, "H-1/24V")]), &[]);
        let different = "different: identity: product code: declared H-1, found H-2";
        reported(&ordered, Ok(&[(0, "Warm"), (1, "H-2")]), &[different]);
        let unstated = "unverifiable: identity: the description states neither vendor nor order code";
        reported(&TABLE.replace("vendor = \"Warm s.r.l.\"\n", ""), Ok(&[(0, "Cold AG")]), &[unstated]);
    }
}

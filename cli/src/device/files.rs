//! Description files and backups.

use std::path::Path;

use lexibus_codegen::compile::Options;
use lexibus_codegen::ir::IdentityNumber;
use lexibus_codegen::selection::Selection;
use lexibus_device::backup::Backup;
use lexibus_device::{Address, Description, Network};

use crate::args::DescriptionOptions;
use crate::files::read;
use crate::Failure;

/// Reads a description.
pub(super) fn description(path: &Path, given: &DescriptionOptions, network: Network) -> Result<Description, Failure> {
    let overlays = given.overlay.iter().map(|path| read(path)).collect::<Result<_, _>>()?;
    let select = Selection { devices: given.device.iter().cloned().collect(), ..Selection::default() };
    let options = Options { overlays, select, choices: given.option.clone(), ..Options::default() };
    compiled(path, network, &options)
}

/// Reads a description without overlays and without the selection of a device.
pub(super) fn plain(path: &Path, network: Network) -> Result<Description, Failure> {
    compiled(path, network, &Options::default())
}

fn compiled(path: &Path, network: Network, options: &Options) -> Result<Description, Failure> {
    let found = Description::compile(read(path)?, network, options);
    found.map_err(|error| Failure::Failed(format!("{}: {error}", path.display())))
}

/// Reads a backup: a TOML file, or a description file with configured values. The vendor ID and product code of a
/// description file must not differ from those of `description`.
pub(super) fn backup(path: &Path, description: &Description) -> Result<Backup, Failure> {
    let is_toml = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    if is_toml {
        let found = Backup::from_toml(read(path)?.text(), description);
        return found.map_err(|error| Failure::Failed(format!("{}: {error}", path.display())));
    }
    let configured = plain(path, description.network())?;
    let differs = |number: &IdentityNumber| {
        let [device, backup] = [description, &configured].map(|one| one.device().identity.number(*number));
        device.zip(backup).is_some_and(|(device, backup)| device != backup)
    };
    if let Some(number) = [IdentityNumber::VendorId, IdentityNumber::ProductCode].into_iter().find(differs) {
        let (path, name) = (path.display(), number.name());
        let text = format!("{path} is for another product: its {name} differs from that of the description");
        return Err(Failure::Failed(text));
    }
    let backup = Backup::of_description(&configured);
    match backup.entries.is_empty() {
        true => Err(Failure::Failed(format!("{} is not a backup: it contains no configured values", path.display()))),
        false => Ok(backup),
    }
}

/// Returns the addresses of the parameters that the user named.
pub(super) fn addresses(names: &[String], description: &Description) -> Result<Vec<Address>, Failure> {
    let found = names.iter().map(|name| description.find(name).map(|parameter| parameter.address()));
    found.collect::<Result<_, _>>().map_err(|error| Failure::Usage(error.to_string()))
}

//! The folder of the repository, for the tests of any crate in it.

use std::path::Path;

/// The folder of the repository: the one above this crate that contains the profiles.
pub fn root() -> &'static Path {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    crate_folder.ancestors().find(|folder| folder.join("dictionaries/profiles").is_dir()).expect("the repository")
}

//! Finds the root folder of the repository for the tests of all crates.

use std::path::Path;

/// Returns the root folder of the repository. The root folder is the ancestor of this crate that contains the profiles.
pub fn root() -> &'static Path {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    crate_folder.ancestors().find(|folder| folder.join("dictionaries/profiles").is_dir()).expect("the repository")
}

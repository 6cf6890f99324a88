//! Compiles and runs programs that contain the generated Rust of networks.

use std::path::Path;
use std::process::Command;

/// Compiles a program, runs it with `arguments`, and returns its output. `files` contains the paths below `src`, and the contents.
pub fn run(name: &str, files: &[(String, String)], arguments: &[&Path]) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    for (path, text) in files {
        let path = folder.join("src").join(path);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder for temporary files");
        std::fs::write(path, text).expect("a temporary file");
    }
    let manifest = format!(
        "[package]\nname = \"{name}\"\nversion = \"0.0.0\"\nedition = \"2021\"\n[workspace]\n[profile.dev]\ndebug = false\n[dependencies]\n\
         lexibus = {{ path = {root:?}, features = [\"canopen\", \"std\"] }}\n"
    );
    std::fs::write(folder.join("Cargo.toml"), manifest).expect("a manifest");
    // Use the dependency versions of the workspace, so that nothing is downloaded.
    std::fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).expect("the workspace's Cargo.lock");
    let output = Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--"])
        .args(arguments)
        .current_dir(&folder)
        // Share the target folder with the drive crates of other tests, because they have the same dependencies.
        .env("CARGO_TARGET_DIR", folder.with_file_name("drive-crate"))
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

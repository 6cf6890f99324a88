//! Generates the object dictionaries of the nodes. Each node has its own statics, so each test has its own node.

fn main() {
    println!("cargo::rerun-if-changed=node.toml");
    for name in ["BLOCKS", "REFUSALS", "LSS"] {
        zencan_build::build_node_from_device_config(name, "node.toml").expect("an object dictionary");
    }
}

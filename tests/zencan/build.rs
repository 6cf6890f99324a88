//! Generates the object dictionaries of the nodes. The statics of a dictionary belong to a single node, so each test has a separate
//! dictionary.

fn main() {
    println!("cargo::rerun-if-changed=node.toml");
    for name in ["BLOCKS", "REFUSALS", "LSS"] {
        zencan_build::build_node_from_device_config(name, "node.toml").expect("an object dictionary");
    }
}

//! Unpacks frames with the generated Rust, and compares the physical values with those of `cantools`.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;

use lexibus_codegen::ir::Scale;
use lexibus_codegen::source::Source;
use lexibus_codegen::RustOptions;
use lexibus_network::model::{NetworkNode, NetworkPdo};
use lexibus_network::output::rust;

use crate::corpus_support::{folder_of, lane, python, root};
use crate::random::Random;
use crate::{compare, generated, pdos, samples, signals, Sample};

/// A field of a generated PDO struct.
struct Field<'t> {
    name: &'t str,
    ty: &'t str,
    /// Path of the item in the link of the field's documentation, or an empty text if there is no link.
    item: &'t str,
}

/// Returns the name of the PDO struct that has a mapping index, and the fields of the struct by bit offset.
fn fields(text: &str, mapping_index: u16) -> (&str, HashMap<u32, Field<'_>>) {
    let index = format!("const INDEX: u16 = 0x{mapping_index:04X};");
    let mut implementations = text.split("impl rt::Pdo for ").skip(1).filter_map(|part| part.split_once(" {"));
    let found = implementations.find(|(_, rest)| rest.trim_start().starts_with(&index));
    let (name, _) = found.unwrap_or_else(|| panic!("no PDO has {index}"));
    let (_, body) = text.split_once(&format!("pub struct {name} {{\n")).expect("a struct");
    let (body, _) = body.split_once("    }\n").expect("an end");
    let (mut fields, mut item, mut start) = (HashMap::new(), "", 0);
    for line in body.lines().map(str::trim) {
        if let Some((documentation, bit)) = line.rsplit_once(" bits at bit offset ") {
            start = bit.trim_end_matches('.').parse().expect("a bit");
            item =
                documentation.rsplit_once("](").and_then(|(_, path)| path.split_once(')')).map_or("", |(path, _)| path);
        } else if let Some((name, ty)) = line.strip_prefix("pub ").and_then(|field| field.split_once(": ")) {
            fields.insert(start, Field { name, ty: ty.trim_end_matches(','), item });
        }
    }
    (name, fields)
}

/// Returns Rust code that unpacks a PDO and collects the values of its signals as texts.
fn values(text: &str, module: &str, node: &NetworkNode, pdo: &NetworkPdo) -> String {
    let (name, fields) = fields(text, pdo.index() + 0x200);
    let mut code = format!("let pdo = {module}::pdo::{name}::unpack(data).expect(\"enough bytes\"); vec![");
    for (start, entry) in signals(node, pdo) {
        let Field { name, ty, item } = &fields[&start];
        let quantity = node.item((entry.index, entry.sub_index)).and_then(|item| item.quantity.as_ref());
        let is_scaled = quantity.is_some_and(|quantity| matches!(quantity.scale, Some(Scale::Linear { .. })));
        let _ = match (is_scaled, ty.contains("types::")) {
            (true, _) => {
                write!(code, "physical({module}::{}.physical(pdo.{name})), ", item.trim_start_matches("super::"))
            }
            (false, true) => write!(code, "pdo.{name}.raw().text(), "),
            (false, false) => write!(code, "pdo.{name}.text(), "),
        };
    }
    code + "]"
}

/// Returns the files of the program that unpacks the frames of all samples.
fn program(samples: &[Sample]) -> Vec<(String, String)> {
    let options = RustOptions { accessors: false, ..RustOptions::default() };
    let (mut files, mut modules, mut arms) = (Vec::new(), String::new(), String::new());
    for (number, sample) in samples.iter().enumerate() {
        let network = sample.network();
        let bindings: HashMap<String, String> = rust(network, &options).into_iter().collect();
        for (node, pdo) in pdos(network) {
            let text = &bindings[&format!("network/{}.rs", node.name.value)];
            let values = values(text, &format!("n{number}::{}", node.name.value), node, pdo);
            let _ = writeln!(arms, "        ({number}, {}) => {{ {values} }}", pdo.can_id());
        }
        let _ = writeln!(modules, "mod n{number} {{");
        for node in &network.nodes {
            let _ = writeln!(modules, "    pub mod {};", node.name.value);
            let text = bindings[&format!("network/{}.rs", node.name.value)].clone();
            files.push((format!("n{number}/{}.rs", node.name.value), text));
        }
        modules += "}\n";
    }
    let main = format!(
        "{}{modules}\nfn unpacked(network: usize, can_id: u32, data: &[u8]) -> Vec<String> {{\n    match (network, can_id) {{\n{arms}        \
         _ => panic!(\"no PDO {{can_id}}\"),\n    }}\n}}\n",
        include_str!("program.rs")
    );
    files.push(("main.rs".to_owned(), main));
    files
}

#[test]
fn generated_rust_unpacks_the_values_of_cantools() {
    if lane::skips("a program with the bindings of networks") {
        return;
    }
    let (Some(python), Some(corpus)) = (python::with(&["cantools"]), folder_of("eds")) else { return };
    // Add the example network, because the files of the corpus have no scales.
    let mut samples = samples("dbc-unpacked", &corpus);
    let folder = samples[0].folder.parent().expect("a folder").to_owned();
    let example = Source::read(&root::root().join("examples/network/network.toml")).expect("the example");
    samples.extend(Sample::new(&folder, example));
    let mut random = Random(31);
    samples.iter().for_each(|sample| sample.write_frames(&mut random, &|_, _, _| String::new()));
    let folders: Vec<&Path> = samples.iter().map(|sample| sample.folder.as_path()).collect();
    generated::run("dbc-program", &program(&samples), &folders);
    assert!(samples.len() >= 51 && compare(&python, &samples) > 5_000_000);
}

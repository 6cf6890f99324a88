//! Tests for COB-IDs that the compiler chooses.

use crate::support::{compiled, example_file, messages, node, valid, with_tpdo_5, written};

#[test]
fn automatic_cob_ids_keep_the_rtr_bit_of_a_tpdo() {
    let drive = example_file("drive.eds")
        .replace("$NODEID+0x180", "$NODEID+0x40000180")
        .replace("$NODEID+0x80000280", "$NODEID+0xC0000280")
        .replace("$NODEID+0x80000300", "$NODEID+0xC0000300");
    let text = r#"
[master]
id = 127

[nodes.axis1]
id = 1
device = "drive.eds"
tpdo = { 1 = { cob_id = "auto" }, 2 = { map = ["Position actual value"] } }
rpdo = { 2 = { map = ["Target position"] } }

[nodes.axis2]
id = 2
device = "drive.eds"
rpdo = { 2 = { cob_id = "axis1.tpdo2", map = ["Target position"] } }
"#;
    let compilation = compiled("cob-ids-rtr", &[("drive.eds", drive), ("network.toml", text.to_owned())]);
    let network = valid(&compilation);
    let axis1 = node(network, "axis1");
    assert_eq!(written(axis1, (0x1800, 1)), [0xC000_0181, 0x4000_0181]);
    assert_eq!(written(axis1, (0x1801, 1)), [0x4000_0281]);
    assert_eq!(written(axis1, (0x1401, 1)), [0x8000_0301, 0x301], "bit 30 of an RPDO has no meaning");
    assert_eq!(written(node(network, "axis2"), (0x1401, 1)).last(), Some(&0x281));
}

#[test]
fn automatic_cob_ids_are_not_in_use() {
    let text = r#"
[master]
id = 127
time_cob_id = 0x680

[nodes.axis1]
id = 1
device = "drive.eds"
tpdo = { 5 = { map = ["Position actual value"] } }
rpdo = { 1 = { cob_id = "axis3.tpdo5" } }

[nodes.axis2]
id = 2
device = "drive.eds"
tpdo = { 1 = { cob_id = 0x681 } }
parameters = { "0x1014" = 0x682, "0x1400:1" = 0x683 }

[nodes.axis3]
id = 3
device = "other.eds"
tpdo = { 5 = { cob_id = "auto", map = ["Position actual value"] } }
"#;
    let drive = with_tpdo_5(&example_file("drive.eds"));
    // In the description of the other drive, TPDO 1 is enabled, and RPDO 2 is disabled.
    let other = drive.replace("$NODEID+0x180", "$NODEID+0x681").replace("$NODEID+0x80000300", "0x80000685");
    let compilation =
        compiled("cob-ids-free", &[("drive.eds", drive), ("other.eds", other), ("network.toml", text.to_owned())]);
    let network = valid(&compilation);
    assert_eq!(written(node(network, "axis1"), (0x1804, 1)).last(), Some(&0x685));
    assert_eq!(written(node(network, "axis3"), (0x1804, 1)).last(), Some(&0x686));
    assert_eq!(written(node(network, "axis1"), (0x1400, 1)).last(), Some(&0x686));
}

#[test]
fn receivers_use_the_cob_id_that_parameters_set() {
    let text = r#"
[master]
id = 127

[nodes.axis1]
id = 1
device = "drive.eds"
tpdo = { 1 = { map = ["Position actual value"] } }
parameters = { "0x1800:1" = 0x1C1 }

[nodes.axis2]
id = 2
device = "drive.eds"
rpdo = { 1 = { cob_id = "axis1.tpdo1", map = ["Target position"] } }
"#;
    let files = |text: String| [("drive.eds", example_file("drive.eds")), ("network.toml", text)];
    let compilation = compiled("cob-ids-parameters", &files(text.to_owned()));
    assert_eq!(written(node(valid(&compilation), "axis2"), (0x1400, 1)).last(), Some(&0x1C1));
    let disabled = text.replace("0x1C1", "0x800001C1");
    let compilation = compiled("cob-ids-disabled", &files(disabled));
    assert_eq!(messages(&compilation), ["NET015 TPDO 1 of `axis1` is missing or disabled"]);
}

#[test]
fn only_an_enabled_rpdo_needs_an_enabled_tpdo() {
    let compile = |tpdo: &str, rpdo: &str, parameters: &str| {
        let text = format!(
            "[master]\nid = 127\n\n[nodes.axis1]\nid = 1\ndevice = \"drive.eds\"\ntpdo = {{ 1 = {{ {tpdo} }} }}\n\
             parameters = {{ {parameters} }}\n\n[nodes.axis2]\nid = 2\ndevice = \"drive.eds\"\n\
             rpdo = {{ 1 = {{ {rpdo} cob_id = \"axis1.tpdo1\", map = [\"Target position\"] }} }}\n"
        );
        compiled("cob-ids-enabled", &[("drive.eds", example_file("drive.eds")), ("network.toml", text)])
    };
    let tpdo = |enabled| format!("enabled = {enabled}, map = [\"Position actual value\"]");
    let found = messages(&compile(&tpdo(false), "", ""));
    assert_eq!(found, ["NET015 TPDO 1 of `axis1` is missing or disabled"]);
    for (enabled, rpdo, parameters, cob_id) in [
        (true, "", "", 0x181),
        (false, "enabled = false,", "", 0x8000_0181),
        (false, "", "\"0x1800:1\" = 0x1C1", 0x1C1),
    ] {
        let compilation = compile(&tpdo(enabled), rpdo, parameters);
        assert_eq!(written(node(valid(&compilation), "axis2"), (0x1400, 1)).last(), Some(&cob_id), "{rpdo}");
    }
}

#[test]
fn the_cob_id_of_time_is_not_restricted() {
    let compile = |cob_id: &str| {
        let text =
            format!("[master]\nid = 127\ntime_cob_id = {cob_id}\n[nodes.axis]\nid = 1\ndevice = \"drive.eds\"\n");
        compiled("cob-ids-time", &[("drive.eds", example_file("drive.eds")), ("network.toml", text)])
    };
    let time = |cob_id: &str| messages(&compile(cob_id));
    assert_eq!(time("0x4000_0100"), Vec::<String>::new());
    assert_eq!(time("0x601"), ["NET023 TIME cannot use the CAN-ID 0x601"]);
    assert_eq!(time("0x81"), ["NET019 TIME and the EMCY of `axis` use the same CAN-ID 0x81"]);
    assert_eq!(compile("0x81").diagnostics.list()[0].help.as_deref(), Some("choose another COB-ID"));
}

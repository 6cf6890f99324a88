//! Lists the 48 items in section 4 of the notes on the Kollmorgen AKD manual. Each item is covered by the diagnostics of a
//! verbatim transcription (the `manual-akd` cases in `tests/ui`), or by a `doubt` entry in dictionaries/kollmorgen-akd.toml.
//!
//! The tests compare the list with these cases and entries. If the manual is available, the tests also compare the list with
//! the manual.

use crate::cases;
use crate::items;
use crate::manual_text;

use std::collections::BTreeSet;

use How::{Doubt, Finding};

/// Folder of the test cases in `tests/ui`.
const AREA: &str = "manual-akd";

/// Test case or `doubt` entry that covers an item.
enum How {
    /// A test case, with codes or words that its diagnostics must contain.
    Finding(&'static str, &'static [&'static str]),
    /// Lines of the manual that a `doubt` entry cites, each with a part of the line's text. This variant is for contradictions
    /// that the compiler cannot detect.
    Doubt(&'static [(usize, &'static str)]),
}

#[rustfmt::skip]
const ITEMS: &[(u8, How)] = &[
    // Section 4.1: registers of the slave controller.
    (1, Finding("item-01-access-that-is-none", &["TAB004"])),
    (2, Finding("item-02-two-tables-with-another-access", &["TAB021"])),
    (2, Doubt(&[(533, "R/W\tR/O"), (609, "SENZA"), (621, "SENZA"), (633, "SENZA")])),
    (3, Doubt(&[(532, "ZA ECAT*\tZA Drive*"), (566, "ZA Drive\tZA ECAT"), (608, "ZA Drive\tZA ECAT")])),
    (4, Finding("item-04-reserved-bits-that-have-names", &["TAB014"])),
    (4, Doubt(&[(573, "Da 3 a 7")])),
    (5, Finding("items-05-06-bytes-outside-of-the-register", &["TAB013"])),
    (5, Doubt(&[(593, "0x201"), (594, "0x201")])),
    (6, Finding("items-05-06-bytes-outside-of-the-register", &["TAB013"])),
    (6, Finding("item-06-length-of-the-type", &["TAB020"])),
    (6, Doubt(&[(598, "0x222")])),
    (7, Doubt(&[(595, "SyncManager 4"), (597, "SyncManager 8"), (610, "0x02"), (622, "0x02")])),
    (8, Finding("item-08-bit-without-a-row", &["TAB036"])),
    (8, Doubt(&[(585, "0x220\t0"), (586, "0x220\t2")])),
    (9, Doubt(&[(537, "R/W\tR/O"), (585, "R/O\tR/W")])),
    (10, Doubt(&[(650, "(BI)\t-"), (648, "Controllo AL I")])),
    (11, Doubt(&[(546, "Sync Manager 8"), (598, "SyncManager 15")])),
    (12, Doubt(&[(542, "Sync Manager 4"), (538, "SyncManager 0")])),
    // Section 4.2: state machine of the drive.
    (13, Finding("item-13-command-that-is-two-others-as-well", &["TAB029"])),
    (13, Doubt(&[(697, "Accensione"), (700, "Disabilitazione operazione")])),
    (14, Doubt(&[(671, "Disabilitazione accensione"), (744, "Accensione disabilitata"), (674, "Abilitazione operazione"), (747, "Operazione abilitata"), (732, "Accesa"), (742, "Accensione")])),
    (15, Doubt(&[(708, "solo modalità specifiche del produttore")])),
    (16, Finding("item-16-mode-without-bit-4", &["TAB037"])),
    (16, Doubt(&[(715, "07h\t\t")])),
    (17, Finding("item-17-object-that-is-no-index", &["TAB006"])),
    (17, Doubt(&[(758, "20subindex")])),
    (18, Doubt(&[(785, "sincrono ciclico"), (716, "08h"), (1006, "dati: 3")])),
    (19, Finding("item-19-two-modes-with-the-same-parameters", &["TAB045"])),
    (19, Doubt(&[(1006, "DRC.CMDSOURCE"), (1007, "DRV.OPMODE 2")])),
    (20, Doubt(&[(702, "Ripristino errore"), (614, "fronte positivo")])),
    (21, Doubt(&[(663, "pagina)")])),
    // Section 4.3: PDOs.
    (22, Finding("item-22-assigned-pdo-that-is-not-described", &["TAB034"])),
    (22, Doubt(&[(889, "0x1704"), (1209, "0x1704"), (768, "0x1703")])),
    (23, Doubt(&[(796, "0x1B02"), (768, "0x1B20"), (800, "0x1703")])),
    (24, Doubt(&[(785, "Posizione di obiettivo"), (783, "max. coppia"), (784, "reset di informazioni"), (800, "coppia di torsione"), (789, "blocco negativo"), (790, "positivo/negativo"), (786, "Valore effettivo di posizione"), (791, "Valore effettivo di posizione"), (796, "Valore effettivo di posizione")])),
    (25, Doubt(&[(787, "seconde risposte"), (992, "Valore effettivo interno"), (995, "Seconda retroazione"), (997, "errore seguente"), (781, "parola del controllo del blocco"), (786, "Status word")])),
    (26, Finding("item-26-object-of-32-bits-in-two-bytes", &["PDO005"])),
    (26, Doubt(&[(987, "UINT32"), (781, "uscite digitali (2 byte)"), (783, "uscite digitali (2 byte)"), (784, "uscite digitali (2 byte)")])),
    (27, Doubt(&[(780, "Valore di comando di posizione"), (982, "0x60C1")])),
    (28, Doubt(&[(808, "4 PDO con 8 byte"), (547, "Massimo 64")])),
    (29, Finding("item-29-mapping-that-is-not-assigned", &["TAB035"])),
    (29, Doubt(&[(942, "0x1B01"), (926, "0x1A00")])),
    (30, Doubt(&[(813, "p. 37")])),
    (31, Doubt(&[(801, "--------"), (817, "The screenshot"), (844, "<input"), (850, "0x1703")])),
    (32, Doubt(&[(791, "(2 byte),")])),
    // Section 4.4: objects.
    (33, Finding("item-33-indices-without-a-prefix", &["TAB012", "TAB006"])),
    (33, Doubt(&[(985, "0x20a4"), (995, "2050"), (998, "20a0"), (996, "60FD"), (708, "6060h"), (924, "0x1C12:00")])),
    (34, Finding("item-34-index-in-a-byte", &["TAB033"])),
    (34, Doubt(&[(945, "0x02"), (946, "0xFD"), (773, "0x1701"), (940, "0x1600")])),
    (35, Doubt(&[(1016, "indice di tempo"), (945, "Cycle time"), (946, "Cycle exp")])),
    (36, Doubt(&[(1028, "massime"), (1035, "≥ 0,25 ms")])),
    (37, Doubt(&[(299, "sinusoidale²: 4 giri/min"), (295, "7.500")])),
    (38, Doubt(&[(1064, "x[ms]")])),
    (39, Doubt(&[(760, "RS232")])),
    // Section 4.5: latch words.
    (40, Finding("items-40-41-bit-that-is-left-out", &["TAB036"])),
    (40, Doubt(&[(1081, "8-12"), (1096, "8-11")])),
    (41, Finding("items-40-41-bit-that-is-left-out", &["TAB036"])),
    (41, Doubt(&[(1079, "4"), (1094, "4")])),
    // The documentation of the field states that it contains a number from 1 to 4, and not one bit per latch. The test `akd`
    // checks the values of this field.
    (42, Doubt(&[(1096, "z1zz")])),
    (43, Doubt(&[(1100, "12-15"), (1103, "stato 1")])),
    // Section 4.6: the mailbox.
    (44, Doubt(&[(1211, "dal byte 2 al byte 11")])),
    (45, Finding("items-45-46-reply-of-the-mailbox", &["has the value 14 in the length field `length` instead of 10"])),
    (45, Doubt(&[(1230, "0x0E")])),
    (46, Finding("items-45-46-reply-of-the-mailbox", &["always 0x3000"])),
    (46, Doubt(&[(1237, "0x20"), (1149, "richiesta SDO"), (1150, "risposta SDO")])),
    (47, Doubt(&[(1154, "7: richiesta"), (1193, "7: richiesta"), (1203, "codice di errore"), (1204, "valore dei dati")])),
    (48, Finding("item-48-buffer-of-another-length-than-its-frames", &["TAB020"])),
    (48, Doubt(&[(1125, "16 byte"), (549, "512")])),
];

#[test]
fn every_item_is_accounted_for() {
    let listed: BTreeSet<u8> = ITEMS.iter().map(|(item, _)| *item).collect();
    assert!((1..=48).eq(listed), "an item is missing");
}

#[test]
fn the_cases_report_what_the_list_says() {
    for (item, how) in ITEMS {
        let Finding(name, marks) = how else { continue };
        let text = cases::diagnostics(AREA, name);
        for mark in *marks {
            assert!(text.contains(mark), "item {item}: `{name}` does not report {mark}");
        }
    }
}

#[test]
fn the_list_has_every_case_of_an_item() {
    let is_listed = |number: u8, case: &str| {
        ITEMS.iter().any(|(item, how)| *item == number && matches!(how, Finding(name, _) if *name == case))
    };
    cases::all_are_listed(AREA, is_listed);
}

#[test]
fn the_doubts_name_the_lines() {
    let doubted = items::doubted("kollmorgen-akd.toml");
    let mut missing = Vec::new();
    for (item, how) in ITEMS {
        let Doubt(lines) = how else { continue };
        missing.extend(
            lines.iter().filter(|line| !doubted.contains(&line.0)).map(|line| format!("{item}: line {}", line.0)),
        );
    }
    assert_eq!(missing, [""; 0]);
}

#[test]
fn the_lines_say_so() {
    let Some(manual) = manual_text::text("kollmorgen-akd-ethercat.it.txt") else { return };
    let manual: Vec<&str> = manual.lines().collect();
    let mut wrong = Vec::new();
    for (item, how) in ITEMS {
        let Doubt(lines) = how else { continue };
        for (line, part) in *lines {
            if !manual.get(line - 1).is_some_and(|text| text.contains(part)) {
                wrong.push(format!("{item}: line {line} has no `{part}`"));
            }
        }
    }
    assert_eq!(wrong, [""; 0]);
}

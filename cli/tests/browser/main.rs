//! Tests the output of `lexibus docs` and `lexibus diff --format html` in a headless browser. The scripts in this folder operate
//! the pages like a reader. See README.md in this folder.

#[path = "../../../codegen/site/tests/docs_support/hostile.rs"]
mod hostile;
#[path = "../../../tests/support/lane.rs"]
mod lane;
mod node;
mod sites;

use node::run;

#[test]
fn faults_of_pages_are_noticed() {
    if lane::skips("a test of the other scripts") {
        return;
    }
    run("guard.mjs", || [sites::folder("guard")]);
}

#[test]
fn each_page_loads_with_no_error_and_no_request_to_elsewhere() {
    run("pages.mjs", || [sites::drives(), sites::networks()]);
}

#[test]
fn the_search_finds_what_is_typed_and_leads_there() {
    run("search.mjs", || [sites::drives(), sites::modular(), sites::many()]);
}

#[test]
fn tasks_of_a_commissioning_engineer_need_few_keys() {
    run("tasks.mjs", || [sites::drives(), sites::terminals()]);
}

#[test]
fn the_decoder_converts_values_in_both_directions() {
    run("values.mjs", || [sites::drives(), sites::ethercat(), sites::station()]);
}

#[test]
fn labels_in_diagrams_are_not_crossed_by_arrows() {
    run("diagrams.mjs", || [sites::drives()]);
}

#[test]
fn a_large_screen_shows_many_lines() {
    run("density.mjs", || [sites::drives()]);
}

#[test]
fn the_keyboard_is_enough() {
    run("keyboard.mjs", || [sites::drives()]);
}

#[test]
fn addresses_of_other_pages_lead_there() {
    run("addresses.mjs", || [sites::drives(), sites::alone()]);
}

#[test]
fn theme_and_language_are_kept() {
    run("choices.mjs", || [sites::drives()]);
}

#[test]
fn pages_fit_on_a_phone() {
    run("phone.mjs", || [sites::drives(), sites::networks()]);
}

#[test]
fn pages_are_printed_black_on_white() {
    if lane::skips("printing") {
        return;
    }
    run("print.mjs", || [sites::drives()]);
}

#[test]
fn pages_are_accessible_in_both_themes() {
    if lane::skips("accessibility") {
        return;
    }
    run("accessibility.mjs", || [sites::drives(), sites::networks()]);
}

#[test]
fn nothing_of_a_description_runs() {
    run("hostile.mjs", || [sites::hostile()]);
}

#[test]
fn two_thousand_registers_are_usable() {
    if lane::skips("a large site") {
        return;
    }
    run("large.mjs", || [sites::large()]);
}

#[test]
fn pictures_are_kept() {
    if lane::skips("taking pictures") {
        return;
    }
    run("screenshots.mjs", || {
        [sites::drives(), sites::terminals(), sites::ethercat(), sites::station(), sites::networks(), node::pictures()]
    });
}

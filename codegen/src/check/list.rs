//! The list of lints, in the order in which they run.

use super::lint::{Lint, Need, Run};
#[cfg(feature = "messages")]
use super::message_examples;
#[cfg(feature = "table")]
use super::table::{
    conversions, declared_pdos, item_names, limits as row_limits, mentions, modbus_examples, names as row_names,
    number_gaps, quantities, window_numbers, window_widths,
};
#[cfg(feature = "messages")]
use super::table::{message_shapes, messages};
use super::{
    access, aliases, availability, bit_fields, conditions, enumerations, identity, lengths, limits, mapping_steps,
    modules, named_values, names, objects, pdo_directions, pdo_entries, pdo_mapping, procedures, process_image,
    records, subslots, titles,
};
use crate::diagnostics::codes::*;
use crate::diagnostics::Code;
use crate::ir::Format;

/// The format that the lints assume for a catalog without a file.
pub(super) const WITHOUT_FILE: Format = Format::Eds;

/// Creates a lint that runs for all formats and all devices.
const fn lint(name: &'static str, codes: &'static [&'static Code], run: Run) -> Lint {
    Lint { name, codes, formats: Format::ALL, on_request: false, needs: None, run }
}

impl Lint {
    const fn of(self, formats: &'static [Format]) -> Self {
        Lint { formats, ..self }
    }

    const fn on_request(self) -> Self {
        Lint { on_request: true, ..self }
    }

    const fn needs(self, need: Need) -> Self {
        Lint { needs: Some(need), ..self }
    }
}

/// All lints. Diagnostics of a device at the same location appear in the order of this list.
pub static LINTS: &[Lint] = &[
    #[cfg(feature = "table")]
    lint(
        "declared-pdos",
        &[&MAPPED_OBJECT_MISSING, &MAPPED_LENGTH, &NOT_MAPPABLE, &WRONG_DIRECTION, &PDO_TOO_LONG],
        Run::Device(declared_pdos::check),
    )
    .of(Format::TABLES),
    lint("identity", &[&IDENTITY_MISMATCH], Run::Device(identity::check)),
    lint("objects", OBJECTS, Run::Device(objects::check)).of(Format::OF_VENDORS),
    lint("rows-of-objects", OBJECTS, Run::Device(objects::rows)).of(Format::TABLES),
    lint("limits", &[&DEFAULT_OUT_OF_LIMITS, &LIMITS_SWAPPED], Run::ItemsAndRecords(limits::check)),
    lint("entry-lengths", &[&ENTRY_TOO_LONG], Run::Pdos(pdo_mapping::lengths)),
    lint("pdo-mapping", PDO_MAPPING, Run::Device(pdo_mapping::check)).needs(Need::CanOpen),
    lint("pdo-entries", &[&DUPLICATE_PDO, &MAPPED_LENGTH], Run::Pdos(pdo_entries::check)).needs(Need::EtherCat),
    lint("pdo-directions", &[&NOT_MAPPABLE, &WRONG_DIRECTION, &MAPPED_READ_ONLY], Run::Pdos(pdo_directions::check))
        .of(Format::OF_VENDORS)
        .needs(Need::EtherCat),
    lint("excluded-pdos", &[&EXCLUDED_PDO_MISSING], Run::Pdos(process_image::excluded)).needs(Need::EtherCat),
    lint(
        "process-image",
        &[&NO_SUCH_SYNC_MANAGER, &DEFAULT_PDOS_CONFLICT, &TOO_MANY_PDOS, &IMAGE_TOO_LONG],
        Run::Device(process_image::check),
    )
    .needs(Need::EtherCat),
    lint("bit-fields", &[&BIT_OUTSIDE_TYPE, &BITS_OVERLAP, &UNNAMED_BITS], Run::Items(bit_fields::check)),
    lint("enumerations", &[&VALUE_NAMED_TWICE, &NAME_OUTSIDE_TYPE], Run::Items(enumerations::check)),
    lint("named-values", &[&UNNAMED_VALUE, &NAME_OUTSIDE_LIMITS, &RESERVED_BITS], Run::Items(named_values::check)),
    lint("lengths", &[&LENGTH_MISMATCH, &REGISTER_SPAN], Run::Items(lengths::check)),
    lint("code-tables", &[&VALUE_NAMED_TWICE], Run::Device(enumerations::code_tables)),
    lint("access-conflicts", &[&ACCESS_CONFLICT], Run::Device(access::conflicts)).of(Format::TABLES).on_request(),
    lint("readings", &[&READING_LIMITS], Run::Device(access::readings)),
    lint("single-limits", &[&ONE_LIMIT], Run::Device(limits::one_given)),
    #[cfg(feature = "table")]
    lint("empty-limits", &[&EMPTY_LIMIT], Run::Device(row_limits::check)).of(Format::TABLES),
    lint("conditions", &[&UNNAMED_VALUE, &MODE_WITHOUT_BITS], Run::Device(conditions::check)),
    #[cfg(feature = "table")]
    lint("row-names", &[&NAME_TWICE, &BROKEN_NAME, &EMPTY_NAME], Run::Device(row_names::check)).of(Format::TABLES),
    lint("names", &[&NAME_TWICE], Run::Device(names::check)).of(Format::TABLES).on_request(),
    lint("titles", &[&BROKEN_NAME], Run::Device(titles::check)),
    lint("availability", &[&VERSION_FORM, &FIRMWARE_WINDOW], Run::Device(availability::check)),
    lint("aliases", &[&SAME_VALUE_DIFFERS], Run::Device(aliases::check)),
    #[cfg(feature = "messages")]
    lint("message-examples", &[&EXAMPLE_DIFFERS], Run::Device(message_examples::check)).needs(Need::Messages),
    lint(
        "procedures",
        &[&STEP_IMPOSSIBLE, &MAPPED_NOT_ASSIGNED, &ASSIGNED_PDO_MISSING],
        Run::Device(procedures::check),
    )
    .needs(Need::Procedures),
    lint("default-assignments", &[&ASSIGNED_PDO_MISSING], Run::Device(procedures::default_assignments))
        .of(Format::TABLES),
    lint(
        "mapping-steps",
        &[&STEP_IMPOSSIBLE, &MAPPED_OBJECT_MISSING, &MAPPED_LENGTH, &NOT_MAPPABLE, &WRONG_DIRECTION, &PDO_TOO_LONG],
        Run::Device(mapping_steps::check),
    )
    .needs(Need::Procedures),
    #[cfg(feature = "messages")]
    lint("message-shapes", &[&MESSAGE_UNSHAPED, &PARAMETERS_ALIKE], Run::Device(message_shapes::check))
        .of(Format::TABLES)
        .needs(Need::Messages),
    #[cfg(feature = "messages")]
    lint("messages", MESSAGES, Run::Device(messages::check)).of(Format::TABLES).needs(Need::Messages),
    #[cfg(feature = "table")]
    lint("quantities", &[&QUANTITIES_DIFFER], Run::Device(quantities::check)).of(Format::TABLES),
    #[cfg(feature = "table")]
    lint("conversions", &[&CONVERSION_DIFFERS], Run::Device(conversions::check)).of(Format::TABLES),
    #[cfg(feature = "table")]
    lint("modbus-examples", &[&EXAMPLE_DIFFERS], Run::Device(modbus_examples::check))
        .of(Format::TABLES)
        .needs(Need::ModbusExamples),
    #[cfg(feature = "table")]
    lint("number-gaps", &[&NUMBER_GAP], Run::Device(number_gaps::check)).of(Format::TABLES),
    #[cfg(feature = "table")]
    lint("mentioned-objects", &[&MENTIONED_OBJECT], Run::Device(mentions::check)).of(Format::TABLES),
    #[cfg(feature = "table")]
    lint("names-in-texts", &[&MENTIONED_OBJECT], Run::Device(item_names::check)).of(Format::TABLES),
    #[cfg(feature = "table")]
    lint("window-widths", &[&NARROW_WINDOW, &WINDOW_ORDER], Run::Device(window_widths::check))
        .of(Format::TABLES)
        .needs(Need::Windows),
    #[cfg(feature = "table")]
    lint("window-numbers", &[&TABLE_VALUE, &TABLE_PLACE], Run::Device(window_numbers::check))
        .of(Format::TABLES)
        .needs(Need::Windows),
    lint("records", &[&RECORD_BOUNDS, &PARAMETERS_OVERLAP], Run::Records(records::check)),
    lint("modules", &[&IO_LENGTH, &RECORD_SIZE, &SLOT_RANGE], Run::Catalog(modules::check)),
    lint("subslots", &[&SUBSLOT_TAKEN], Run::Catalog(subslots::check)),
];

const OBJECTS: &[&Code] =
    &[&EMPTY_NAME, &NO_SUBS, &NO_SUB0, &SUB0_MISMATCH, &SUB0_ACCESS, &ARRAY_TYPES, &MISSING_MANDATORY_OBJECT];

const PDO_MAPPING: &[&Code] = &[
    &HALF_A_PDO,
    &PDO_TOO_LONG,
    &MULTIPLEXED_PDO,
    &MAPPING_GAP,
    &MAPPING_UNREADABLE,
    &MAPPING_COUNT,
    &MAPPED_OBJECT_MISSING,
    &GRANULARITY,
    &DUMMY_IN_TPDO,
    &DUMMY_NOT_SUPPORTED,
    &NOT_MAPPABLE,
    &UNCLEAR_DIRECTION,
    &WRONG_DIRECTION,
    &MAPPED_LENGTH,
    &UNMAPPABLE_TYPE,
    &PDO_COUNT,
    &PDO_COUNT_1004,
];

#[cfg(feature = "messages")]
const MESSAGES: &[&Code] =
    &[&MESSAGE_LENGTH, &REPLY_OF_ANOTHER, &ERROR_ALIKE, &MESSAGES_ALIKE, &ODD_REQUEST, &STATES_DIFFER];

//! Procedures that are nothing but writes.

use crate::backend::rust::code::{line, list, open, Code};
use crate::backend::rust::procedure::ProcedureModel;

pub(super) fn write(code: &mut Code, procedures: &[ProcedureModel]) {
    if procedures.is_empty() {
        return;
    }
    code.doc("Sequences of writes, in their order. Each is sent with `SdoWrite::send`.");
    open!(code, "pub mod procedures {");
    code.use_runtime();
    for own in procedures {
        code.docs(&own.docs);
        let writes = list("[", &own.writes, "]");
        line!(code, "pub const ", own.name, ": [rt::SdoWrite; ", own.writes.len(), "] = ", writes, ";");
    }
    code.close("}");
}

//! Prints procedures that consist only of object writes.

use crate::backend::rust::code::{line, list, open, Code};
use crate::backend::rust::procedure::ProcedureModel;

pub(super) fn write(code: &mut Code, procedures: &[ProcedureModel]) {
    if procedures.is_empty() {
        return;
    }
    code.doc("Sequences of SDO writes. Send the writes of a sequence in order with `SdoWrite::send`.");
    open!(code, "pub mod procedures {");
    code.use_runtime();
    for procedure in procedures {
        code.docs(&procedure.docs);
        let writes = list("[", &procedure.writes, "]");
        line!(code, "pub const ", procedure.name, ": [rt::SdoWrite; ", procedure.writes.len(), "] = ", writes, ";");
    }
    code.close("}");
}

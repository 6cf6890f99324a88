//! Prints the method that returns the CiA 402 operations, and the implementations of the traits that these operations
//! need.

use crate::backend::rust::cia402::{Cia402Model, FunctionModel};
use crate::backend::rust::code::{call, generic, line, open, seq, Code, MARGIN};

/// Writes the method of the type `device` that returns the CiA 402 operations.
pub(super) fn method(code: &mut Code, device: &str, model: &Cia402Model) {
    code.docs(&model.docs);
    let result = generic!("rt::cia402::Drive", "'_", "C", seq![device, "<()>"]);
    let function = seq![call!(seq!["pub fn ", model.method], "&mut self"), " -> ", result];
    code.block(function, call!("rt::cia402::Drive::new", "&mut self.client"));
}

/// Writes the implementations of the traits for the type `device<()>`, which has no client.
pub(super) fn objects(code: &mut Code, device: &str, model: &Cia402Model) {
    for implementation in &model.traits {
        let (bound, ty) = (format!("impl<B: rt::Bus> {}<B>", implementation.path), format!("for {device}<()>"));
        // Unlike other constructs, the second line of a long header isn't indented.
        if bound.len() + 1 + ty.len() <= MARGIN {
            line!(code, bound, " ", ty);
        } else {
            line!(code, bound);
            line!(code, ty);
        }
        open!(code, "where");
        code.lines(&implementation.bounds);
        code.reopen("{");
        implementation.functions.iter().for_each(|function| self::function(code, function));
        code.close("}");
    }
}

fn function(code: &mut Code, function: &FunctionModel) {
    let result = match function.access {
        (true, true) => "impl rt::cia402::ReadInteger<B> + rt::cia402::WriteInteger<B>",
        (true, false) => "impl rt::cia402::ReadInteger<B>",
        (false, _) => "impl rt::cia402::WriteInteger<B>",
    };
    code.block(seq!["fn ", function.name, "() -> ", result], &function.path);
}

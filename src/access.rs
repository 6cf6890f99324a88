//! Access rights as types. An access that the device doesn't allow causes a compile-time error.

/// Read-only access (`ro`).
#[derive(Clone, Copy, Debug, Default)]
pub struct Ro;

/// Write-only access (`wo`).
#[derive(Clone, Copy, Debug, Default)]
pub struct Wo;

/// Read and write access (`rw`, `rwr`, `rww`).
#[derive(Clone, Copy, Debug, Default)]
pub struct Rw;

/// Read-only access to a value that never changes (`const`).
#[derive(Clone, Copy, Debug, Default)]
pub struct Const;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Ro {}
    impl Sealed for super::Wo {}
    impl Sealed for super::Rw {}
    impl Sealed for super::Const {}
}

/// Access rights that allow reading: [`Ro`], [`Rw`] and [`Const`]. The trait is sealed: other crates cannot implement
/// it.
#[diagnostic::on_unimplemented(
    message = "this item cannot be read: its access is `{Self}`",
    label = "the device doesn't allow reading this item"
)]
pub trait Readable: sealed::Sealed {}

impl Readable for Ro {}
impl Readable for Rw {}
impl Readable for Const {}

/// Access rights that allow writing: [`Wo`] and [`Rw`]. The trait is sealed: other crates cannot implement it.
#[diagnostic::on_unimplemented(
    message = "this item cannot be written: its access is `{Self}`",
    label = "the device doesn't allow writing this item"
)]
pub trait Writable: sealed::Sealed {}

impl Writable for Wo {}
impl Writable for Rw {}

#[cfg(test)]
mod tests {
    use super::*;

    fn readable<A: Readable>() {}
    fn writable<A: Writable>() {}

    #[test]
    fn rights_are_what_their_names_say() {
        readable::<Ro>();
        readable::<Rw>();
        readable::<Const>();
        writable::<Wo>();
        writable::<Rw>();
    }
}

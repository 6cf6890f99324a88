//! Tests items whose values differ between models.

use std::convert::Infallible;

use lexibus::{Client, Error, Initial, Parameter, Range, Serial};
use lexibus_drives::hsd::{models, objects};

/// A client that accepts all writes.
struct Anything;

impl Client for Anything {
    type Bus = Serial;
    type Error = Infallible;

    fn read(&mut self, _: Parameter, _: &mut [u8]) -> Result<usize, Error<Infallible>> {
        Ok(0)
    }

    fn write(&mut self, _: Parameter, _: &[u8]) -> Result<(), Error<Infallible>> {
        Ok(())
    }
}

#[test]
fn each_model_has_its_own_range_and_initial_value() {
    use models::{sm137_rev_c, sm140};
    let (one, other) = (sm137_rev_c::objects::PIMIN_VEL, sm140::objects::PIMIN_VEL);
    assert_ne!(one.range(), other.range());
    assert_eq!((one.location(), one.name()), (objects::PIMIN_VEL.location(), objects::PIMIN_VEL.name()));
    let Range::Between(low, _) = *objects::PIMIN_VEL.range() else { panic!("{:?}", objects::PIMIN_VEL.range()) };
    let is_allowed = |range: &Range<i16>| matches!(range, Range::Between(minimum, _) if *minimum <= low);
    // The range in `objects` is the widest range of all models. Only one of the two tested models allows the minimum of
    // this range.
    assert_eq!([one.range(), other.range()].map(is_allowed), [false, true]);
    assert!(objects::PIMIN_VEL.at(&mut Anything).write(low).is_ok());
    assert!(matches!(one.at(&mut Anything).write(low).map_err(Error::from), Err(Error::OutOfRange(_))));
    assert!(other.at(&mut Anything).write(low).is_ok());
    assert_ne!(one.initial(), other.initial());
    assert!(matches!(sm140::objects::KP_I.initial(), Initial::Value(_)));
}

//! Tests of the book as mdBook builds it, in `tests`.

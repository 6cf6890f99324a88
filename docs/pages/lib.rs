//! Tests of the book as built by mdBook, in `tests`.

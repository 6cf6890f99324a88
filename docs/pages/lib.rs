//! The folder `tests` of this package tests the book as built by mdBook.

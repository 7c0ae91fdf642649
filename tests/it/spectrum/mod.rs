//! Spectra, colours and the library of data.

mod color;
mod formats;
mod library;

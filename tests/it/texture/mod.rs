//! Pictures that come in, and pictures on surfaces.

mod files;
mod surfaces;

//! What is measured, as tables and pages for people and for programs.

pub mod f0;

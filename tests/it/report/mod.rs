//! What pages and tables say of pictures and materials.

mod compare_statistics;
mod f0_check;
mod f0_formats;
mod f0_tables;

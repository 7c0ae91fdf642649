//! The library of spectra and materials is compiled in: a changed file must be noticed.

fn main() {
    println!("cargo:rerun-if-changed=spectra");
    println!("cargo:rerun-if-changed=materials");
}

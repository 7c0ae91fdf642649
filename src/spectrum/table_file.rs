//! A table of a user as text: an index, a reflectance, an absorption or a light in two or three
//! columns.
//!
//! `wavelength_nm,n,k` or `wavelength_um,n` (an index), `wavelength_nm,value` (a reflectance or a
//! light), `wavelength_nm,alpha_1/cm` (an absorption; see `absorbing`). How columns are parted,
//! named and ordered is for `rows` and `columns` to find out; `docs/data-files.md` tells users all
//! of it.

use super::absorbing::{as_share, coefficient};
use super::columns::{Column, Columns};
use super::error::Fault;
use super::table::{Bound, Outside};
use super::{About, Quantity, Sample, Source, Spectrum};

/// The names that the columns of an index go by; the first is the one that errors tell.
const N: &[&str] = &["n", "n(λ)", "refractive index", "index", "index of refraction", "eta", "re(n)", "real"];
const K: &[&str] = &["k", "k(λ)", "kappa", "extinction coefficient", "extinction", "im(n)", "imag"];

/// Those of a curve.
const VALUE: &[&str] = &[
    "value",
    "r",
    "reflectance",
    "reflectivity",
    "power",
    "intensity",
    "relative intensity",
    "relative power",
    "spd",
    "relative spd",
    "radiance",
    "irradiance",
    "spectral power",
    "spectral radiance",
    "spectral irradiance",
    "counts",
];

/// What is surely neither a reflectance nor a light.
const OTHERS: &[&str] = &["n", "k", "transmittance", "transmission", "t", "absorbance", "absorption", "alpha"];

/// (n, k) of an index of refraction.
pub(super) fn read_ior(text: &str, name: &str) -> Result<(Spectrum, Spectrum, About), Fault> {
    let Columns { mut columns, mut notes, .. } = Columns::of(text)?;
    name_columns(&mut columns, &["n", "k"], &mut notes);
    let n = find(&columns, N)?.table("n", Bound::Positive, Outside::Hold, &mut notes)?;
    let k = match find(&columns, K) {
        Ok(k) => Spectrum::Table(k.table("k", Bound::NonNegative, Outside::Hold, &mut notes)?),
        Err(_) => Spectrum::Constant(0.0),
    };
    refuse_others(&columns, &["n", "k"], &[N, K].concat())?;
    Ok((Spectrum::Table(n), k, about(name, notes)))
}

/// A reflectance, an absorption coefficient (m⁻¹, natural base) or a light.
pub(super) fn read_curve(text: &str, name: &str, quantity: Quantity) -> Result<(Spectrum, About), Fault> {
    let mut file = Columns::of(text)?;
    let (spectrum, range_nm) = match quantity {
        Quantity::Absorption => coefficient(&mut file)?,
        _ => (values(&mut file, quantity)?, None),
    };
    Ok((spectrum, About { range_nm, ..about(name, file.notes) }))
}

fn values(file: &mut Columns, quantity: Quantity) -> Result<Spectrum, Fault> {
    let Columns { columns, notes, .. } = file;
    name_columns(columns, &["value"], notes);
    let column = match columns.as_slice() {
        // An instrument calls the only column after the sample.
        [only] if !OTHERS.contains(&only.plain().as_str()) => {
            if !VALUE.contains(&only.plain().as_str()) {
                notes.push(format!("the column `{}` is taken for the {quantity}", only.name));
            }
            only
        }
        _ => {
            refuse_others(columns, &VALUE[..5], VALUE)?;
            find(columns, VALUE)?
        }
    };
    let table = match quantity {
        Quantity::Illuminant => column.table("a spectral power", Bound::Power, Outside::Zero, notes)?,
        _ => as_share(column).table("a reflectance", Bound::Fraction, Outside::Hold, notes)?,
    };
    Ok(Spectrum::Table(table))
}

fn about(name: &str, notes: Vec<String>) -> About {
    let source = Source { origin: name.to_owned(), ..Source::default() };
    About { name: name.to_owned(), source, sample: Sample::default(), range_nm: None, notes }
}

/// Names columns that have no header, in their order.
fn name_columns(columns: &mut [Column], names: &[&str], notes: &mut Vec<String>) {
    if columns.len() > names.len() || columns.iter().any(|column| !column.name.is_empty()) {
        return;
    }
    for (column, name) in columns.iter_mut().zip(names) {
        column.name = (*name).to_owned();
    }
    let named = names[..columns.len()].join("` and `");
    notes.push(format!("the columns have no names: after the wavelength they are taken for `{named}`"));
}

fn find<'a>(columns: &'a [Column], names: &[&str]) -> Result<&'a Column, Fault> {
    let is = |column: &&Column| names.contains(&column.plain().as_str()) || names.contains(&column.name.as_str());
    columns
        .iter()
        .find(is)
        .ok_or_else(|| Fault::at(0, format!("no column `{}` in the header", names.first().unwrap_or(&""))))
}

/// `told` of the names that a column may have are told.
fn refuse_others(columns: &[Column], told: &[&str], names: &[&str]) -> Result<(), Fault> {
    let known = |column: &Column| names.contains(&column.plain().as_str()) || names.contains(&column.name.as_str());
    match columns.iter().find(|column| !known(column)) {
        None => Ok(()),
        Some(column) => {
            let message = format!("the column `{}`, expected one of `{}`", column.name, told.join("`, `"));
            Err(Fault::at(column.offset, message))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_an_index_in_either_unit() {
        let (n, k, _) = read_ior("# gold\nwavelength_um,n,k\n0.0517,1.5,2\n0.6,0.2,3\n", "a.csv").unwrap();
        assert_eq!((n.at(600.0), k.at(600.0)), (0.2, 3.0));
        assert_eq!(n.range_nm(), Some((51.7, 600.0)));
        let (n, k, _) = read_ior("Wavelength (nm);n\r\n400;1.5\r\n700;1.6\r\n", "a.csv").unwrap();
        assert_eq!((n.at(550.0), k.at(550.0)), (1.55, 0.0));
        let (n, k, _) = read_ior("wl,n\n0.4,1.5\n0.7,1.6\n\nwl,k\n0.5,0.1\n", "a.csv").unwrap();
        assert_eq!((n.at(700.0), k.at(550.0)), (1.6, 0.1));
    }

    /// n and k at 600 nm, and how many notes.
    fn gold(text: &str) -> (f64, f64, usize) {
        let (n, k, about) = read_ior(text, "a").unwrap_or_else(|fault| panic!("{text}: {}", fault.message));
        assert_eq!(n.range_nm(), Some((400.0, 700.0)), "{text}");
        (n.at(600.0), k.at(600.0), about.notes.len())
    }

    #[test]
    fn reads_columns_as_other_tools_write_them() {
        let blanks = "400 1.5 1.9\n600 0.25 3.0\n700 0.16 3.9\n";
        for (text, notes) in [
            (format!("wavelength_nm n k\n{blanks}"), 0),
            (format!("Wavelength (nm) n (-) k (-)\n{blanks}"), 0),
            (format!("Gold, evaporated\n\nWavelength (nm) n k\n{blanks}"), 0),
            (format!("lambda n k\n(nm) (-) (-)\n{blanks}"), 0),
            (format!("# Au\n# wavelength_nm n k\n{blanks}"), 0),
            (format!("; Au\n{blanks}"), 2),
            (blanks.to_owned(), 2),
            (blanks.replace(' ', "\t"), 2),
            (blanks.replace('.', ",").replace(' ', ";"), 2),
            (format!("wavelength n k\n{}", blanks.replace('.', ",")), 1),
            ("nm,n,k,\n700,0.16,3.9,\n600,0.25,3.0,\n400,1.5,1.9,\n".to_owned(), 0),
            ("4000 1.5 1.9\n6000 0.25 3.0\n7000 0.16 3.9\n".to_owned(), 2),
            ("0.4 1.5 1.9\n0.6 0.25 3.0\n0.7 0.16 3.9\nend of file\n".to_owned(), 2),
            ("\"Wavelength, nm\",\"n\",\"k\"\n400,1.5,1.9\n600,0.25,3\n700,0.16,3.9\n".to_owned(), 0),
        ] {
            assert_eq!(gold(&text), (0.25, 3.0, notes), "{text}");
        }
    }

    #[test]
    fn reads_curves() {
        let (light, _) = read_curve("wavelength_nm,value\n400,1\n500,2\n", "a.csv", Quantity::Illuminant).unwrap();
        assert_eq!((light.at(450.0), light.at(300.0)), (1.5, 0.0));
        let (alpha, _) = read_curve("wavelength_nm,alpha_1/cm\n400,1\n", "a.csv", Quantity::Absorption).unwrap();
        assert_eq!(alpha.at(500.0), 100.0);
        let reflectance = |text: &str| read_curve(text, "a.txt", Quantity::Reflectance).map(|read| read.0.at(450.0));
        assert_eq!(reflectance("400 0.5\n500 0.7\n").unwrap(), 0.6);
        assert_eq!(reflectance("nm\tR (%)\n400\t50\n500\t70\n").unwrap(), 0.6);
        assert_eq!(reflectance("nm;Sample 12\n400;0,5\n500;0,7\n").unwrap(), 0.6);
        assert!(reflectance("nm;transmittance\n400;0,5\n500;0,7\n").is_err());
    }

    #[test]
    fn errors_have_their_place() {
        let place = |text: &str| read_ior(text, "a.csv").unwrap_err().in_file("a.csv", text).to_string();
        let starts = |text: &str, start: &str| assert!(place(text).starts_with(start), "{}", place(text));
        starts("", "a.csv: the file is empty");
        starts("some words\n", "a.csv:1:1: no numbers in the file");
        starts("0.3,1,2\n2.5,1,2\n", "a.csv:1:1: numbers without a header");
        starts("wavelength,n\n0.3,1\n2.5,1\n", "a.csv:1:1: the first column `wavelength` states no unit");
        starts("wavelength_nm,n\n400,1\n500,1,2\n", "a.csv:3:1: 3 columns");
        starts("wavelength_nm,n\n400,1\n500,one\n", "a.csv:3:5: `one`");
        starts("wavelength_nm,n\n400,1\n5o0,one\n", "a.csv:3:1: `5o0`");
        starts("wavelength_nm,n\n400,1\n500,-1\n", "a.csv:3:5: n is -1 at 500 nm");
        starts("wavelength_nm,n\n400,1\n400,2\n", "a.csv:3:1: the wavelength 400 nm follows");
        starts("wavelength_nm,m\n400,1\n", "a.csv:1:1: no column `n`");
        starts("wavelength_nm,n,q\n400,1,1\n", "a.csv:1:17: the column `q`");
        starts("wl,n\n400,1\n", "a.csv:2:1: a wavelength of 400 µm");
        starts("400,1,2,3\n500,1,2,3\n", "a.csv:1:1: no column `n`");
    }
}

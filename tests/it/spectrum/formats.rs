//! Files of users, good and bad: what they mean, and that an error says where and what was expected.

use std::path::Path;

use spectrel::spectrum::{Library, SpectrumError};

const HEAD: &str = "[source]\ntitle = \"t\"\nauthors = \"a\"\nlicence = \"l\"\norigin = \"o\"\n[sample]\ndescription = \"d\"\nconfidence = \"low\"\n";

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn write(&self, name: &str, text: &str) -> &Path {
        std::fs::write(self.0.path().join(name), text).unwrap();
        self.0.path()
    }
}

/// The message of reading a file as an index, without the folder.
fn ior_error(name: &str, text: &str) -> String {
    let folder = Folder::new();
    let base = folder.write(name, text);
    message(&folder, Library::new(Vec::new()).ior(name, base).map(drop))
}

fn message(folder: &Folder, result: Result<(), SpectrumError>) -> String {
    let error = result.expect_err("the file is wrong");
    error.to_string().replace(&format!("{}/", folder.0.path().display()), "")
}

fn ior_toml(numbers: &str) -> String {
    format!("quantity = \"ior\"\n{HEAD}{numbers}\n")
}

#[test]
fn toml_errors_name_place_and_expectation() {
    let error = |numbers: &str| ior_error("own.toml", &ior_toml(numbers));
    let begins = |numbers: &str, start: &str| {
        let message = error(numbers);
        assert!(message.starts_with(start), "{message}\nexpected: {start}");
    };
    begins(
        "[table]\nwavelength_nm = [400, 500]\nn = [1, 2]\nk = [0, -1]",
        "own.toml:13:9: k is -1 at 500 nm, expected a number of 0 or more",
    );
    begins(
        "[table]\nwavelength_nm = [400, 500]\nn = [1, 0]",
        "own.toml:12:9: n is 0 at 500 nm, expected a number above 0",
    );
    begins("[table]\nwavelength_nm = [400, 500]\nn = [1, nan]", "own.toml:12:9: n is NaN at 500 nm");
    begins(
        "[table]\nwavelength_nm = [400, 600, 500, 700]\nn = [1, 1, 1, 1]",
        "own.toml:11:28: the wavelength 500 nm follows 600 nm",
    );
    begins("[table]\nwavelength_nm = [400, 500]\nn = [1]", "own.toml:11:18: 2 wavelengths but 1 values of n");
    begins("[table]\nwavelength_nm = []\nn = []", "own.toml:10:1: the table is empty");
    begins("[table]\nwavelength_nm = [400]", "own.toml:10:1: the table has no n");
    begins(
        "[table]\nwavelength_nm = [400]\nn = [1]\nvalue = [1]",
        "own.toml:10:1: a table of `ior` has no column `value`",
    );
    begins("[tabel]\nwavelength_nm = [400]\nn = [1]", "own.toml:10:2: unknown field `tabel`");
    assert!(error("[tabel]\nn = [1]").ends_with("did you mean `table`?"), "{}", error("[tabel]\nn = [1]"));
    begins(
        "[formula]\ntype = \"selmeier\"\ncoefficients = [0]\nrange_nm = [400, 500]",
        "own.toml:11:8: unknown variant `selmeier`",
    );
    begins(
        "[formula]\ntype = \"cauchy\"\ncoefficients = [-1]\nrange_nm = [400, 500]",
        "own.toml:10:1: the formula gives n = -1",
    );
    begins("", "own.toml: there are no numbers");
    begins("[absorption]\nunit = \"1/m\"\nbase = \"e\"", "own.toml: `absorption` has no meaning");
    begins("[table]\nwavelength_nm = [400", "own.toml:11:");
    let other = ior_error(
        "own.toml",
        &format!("quantity = \"reflectance\"\n{HEAD}[table]\nwavelength_nm = [1]\nvalue = [1]\n"),
    );
    assert!(other.starts_with("own.toml:1:12: this is a data set of `reflectance`, expected one of `ior`"), "{other}");
}

#[test]
fn other_quantities_have_their_bounds() {
    let folder = Folder::new();
    let library = Library::new(Vec::new());
    let base = folder.write(
        "r.toml",
        &format!("quantity = \"reflectance\"\n{HEAD}[table]\nwavelength_nm = [400]\nvalue = [1.02]\n"),
    );
    let bad = message(&folder, library.reflectance("r.toml", base).map(drop));
    assert!(bad.starts_with("r.toml:12:10: a reflectance is 1.02 at 400 nm, expected a number from 0 to 1"), "{bad}");

    let absorption = |unit: &str| {
        format!("quantity = \"absorption\"\n{HEAD}[absorption]\n{unit}\n[table]\nwavelength_nm = [400]\nvalue = [2]\n")
    };
    folder.write("a.toml", &absorption("unit = \"1/cm\"\nbase = \"10\""));
    let alpha = library.absorption("a.toml", base).unwrap().spectrum.at(500.0);
    assert!((alpha - 200.0 * std::f64::consts::LN_10).abs() < 1e-9);
    folder.write("b.toml", &absorption("unit = \"cm\"\nbase = \"10\""));
    let bad = message(&folder, library.absorption("b.toml", base).map(drop));
    assert!(bad.contains("b.toml:11:8: unknown variant `cm`"), "{bad}");

    // α = 4πk/λ of a page of refractiveindex.info.
    folder.write("k.yml", "DATA:\n  - type: tabulated k\n    data: |\n        0.5 1e-6\n        0.7 1e-6\n");
    let alpha = library.absorption("k.yml", base).unwrap().spectrum.at(500.0);
    assert!((alpha - 4.0 * std::f64::consts::PI * 1e-6 / 500e-9).abs() < 1e-9);
    assert!(library.ior("k.yml", base).is_err() && library.reflectance("k.yml", base).is_err());
}

/// n and k at 600 nm of a file, its range, and its notes.
fn gold(name: &str, bytes: &[u8]) -> (f64, f64, Option<(f64, f64)>, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    let ior = Library::new(Vec::new()).ior(name, folder.path()).unwrap_or_else(|error| panic!("{error}"));
    (ior.n.at(600.0), ior.k.at(600.0), ior.about.range_nm, ior.about.notes.clone())
}

#[test]
fn files_of_other_tools_are_read_whatever_their_columns_and_encoding() {
    let range = Some((400.0, 700.0));
    let samples: [(&str, &[u8]); 3] = [
        ("space_nk.csv", include_bytes!("../../data/space_nk.csv")),
        ("unitsrow2_nk.csv", include_bytes!("../../data/unitsrow2_nk.csv")),
        ("latin1_um_nk.csv", include_bytes!("../../data/latin1_um_nk.csv")),
    ];
    for (name, bytes) in samples {
        assert_eq!(gold(name, bytes), (0.25, 3.0, range, Vec::new()), "{name}");
    }
    let text = "Wavelength (µm)\tn\tk\r700e-3\t0,16\t3,9\r0,6\t0,25\t3\r0,4\t1,5\t1,9\r";
    let utf16: Vec<u8> =
        "\u{FEFF}".chars().chain(text.chars()).collect::<String>().encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (name, bytes) in [
        ("a.txt", text.as_bytes().to_vec()),
        ("a.dat", format!("\u{FEFF}{text}").into_bytes()),
        ("a.nk", utf16),
        ("a.TSV", text.chars().map(|letter| u8::try_from(letter).unwrap()).collect()),
    ] {
        assert_eq!(gold(name, &bytes), (0.25, 3.0, range, Vec::new()), "{name}");
    }
    let (n, k, range, notes) = gold("a.spd", b"# from another renderer\n400 1.5\n600 0.25\n700 0.16\n");
    assert_eq!((n, k, range), (0.25, 0.0, Some((400.0, 700.0))));
    assert_eq!(
        notes,
        [
            "no unit of wavelength is stated: by their numbers they are nm",
            "the columns have no names: after the wavelength they are taken for `n`"
        ]
    );
    let (_, _, _, notes) = gold("a.csv", b"wavelength_nm,n,k\n0.4,1.5,1.9\n0.7,0.25,3\n");
    assert_eq!(notes, ["`wavelength_nm` runs from 0.4 to 0.7 nm, outside the visible: is it in µm?"]);
}

#[test]
fn a_page_with_a_coefficient_missing_is_told() {
    let all = "0 1.03961212 0.00600069867 0.231792344 0.0200179144 1.01046945 103.560653";
    let page = |coefficients: &str| {
        format!("DATA:\n  - type: formula 2\n    wavelength_range: 0.3 2.5\n    coefficients: {coefficients}\n")
    };
    let folder = Folder::new();
    let base = folder.write("own.yml", &page(all));
    assert!((Library::new(Vec::new()).ior("own.yml", base).unwrap().n.at(587.5618) - 1.5168).abs() < 1e-5);
    let message = ior_error("own.yml", &page(all.rsplit_once(' ').unwrap().0));
    assert_eq!(message, "own.yml:2:11: 6 coefficients of this formula, expected an odd number: a constant and pairs");
}

#[test]
fn noise_is_set_right_and_told() {
    let page = "DATA:\n  - type: tabulated nk\n    data: |\n        0.2 -6.2 4e-5\n        0.4 1.5 -3.7e-7\n        0.5 1.5 0.5\n        0.5 1.5 0.50390625\n        0.9 1.4 0\n        0.89 1.4 0\n        1.0 1.4 0\n";
    let folder = Folder::new();
    let library = Library::new(Vec::new());
    let ior = library.ior("own.yml", folder.write("own.yml", page)).unwrap();
    assert_eq!((ior.n.range_nm(), ior.at(400.0), ior.k.at(500.0)), (Some((400.0, 1000.0)), (1.5, 0.0), 0.501953125));
    assert_eq!(
        ior.about.notes,
        [
            "1 row outside 360–830 nm passed over: n is -6.2 at 200 nm",
            "1 row outside 360–830 nm passed over: 890 nm follows 900 nm",
            "k is -3.7e-7 at 400 nm: noise, taken for 0",
            "two values at 500 nm: they agree and are averaged",
        ]
    );
    let base = folder.write("r.csv", "wavelength_nm,r\n400,1.01\n500,-0.001\n");
    let white = library.reflectance("r.csv", base).unwrap();
    assert_eq!((white.spectrum.at(400.0), white.spectrum.at(500.0), white.about.notes.len()), (1.0, 0.0, 1));
    // Twins that disagree: of a page the first counts, as ever; of a table nobody knows which.
    let twins = "DATA:\n  - type: tabulated n\n    data: |\n        0.5 1.5\n        0.5 2.5\n        0.6 1.5\n";
    assert_eq!(library.ior("twins.yml", folder.write("twins.yml", twins)).unwrap().n.at(500.0), 1.5);
    assert!(
        ior_error("own.csv", "wavelength_nm,n\n500,1.5\n500,2.5\n").starts_with("own.csv:3:1: the wavelength 500 nm")
    );
}

#[test]
fn what_is_there_but_cannot_be_read_is_told_with_what_can() {
    for (name, text, says) in [
        ("Au.xlsx", "PK", "`Au.xlsx` is a file of a kind that is not read; read are two or three columns of text"),
        ("Au.csv", "PK\0\0", "Au.csv: this is no text; read are two or three columns of text"),
        ("Au.spdx", "<a/>", "Au.spdx: this is not an index of refraction"),
    ] {
        let message = ior_error(name, text);
        assert!(message.starts_with(says), "{message}");
    }
    #[cfg(unix)]
    {
        let folder = Folder::new();
        let pipe = folder.0.path().join("pipe.csv");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let error = Library::new(Vec::new()).ior("pipe.csv", folder.0.path()).map(drop);
        let says = "cannot read pipe.csv: it is a pipe or a device, expected a regular file";
        assert_eq!(message(&folder, error), says);
    }
}

#[test]
fn glass_catalogues_and_lamps_are_read() {
    let folder = Folder::new();
    let library = Library::new(Vec::new());
    let base = folder.write(
        "own.AGF",
        "NM N-BK7 2 517642.251 1.5168 64.17\nCD 1.03961212 0.00600069867 0.231792344 0.0200179144 1.01046945 103.560653\nLD 0.3 2.5\nIT 0.5 0.9 10\n",
    );
    let glass = library.ior("own.AGF#n-bk7", base).unwrap();
    assert!((glass.n.at(587.5618) - 1.5168).abs() < 1e-5);
    let alpha = library.absorption("own.AGF#N-BK7", base).unwrap().spectrum.at(500.0);
    assert!((alpha / (-0.9_f64.ln() / 0.01) - 1.0).abs() < 1e-12, "{alpha}");
    let lamp = "<IESTM2714><SpectralDistribution><SpectralData wavelength='400'>1</SpectralData><SpectralData wavelength='500'>2</SpectralData></SpectralDistribution></IESTM2714>";
    let base = folder.write("lamp.spdx", lamp);
    assert_eq!(library.illuminant("lamp.spdx", base).unwrap().spectrum.at(450.0), 1.5);
}

#[test]
fn a_sample_of_a_chart_is_a_reflectance() {
    let chart = "CTI3\nBEGIN_DATA_FORMAT\nSAMPLE_ID NM_400 NM_500\nEND_DATA_FORMAT\nBEGIN_DATA\nA1 0.1 0.3\nA2 0.5 0.5\nEND_DATA\n";
    let folder = Folder::new();
    let library = Library::new(Vec::new());
    for name in ["chart.ti3", "chart.txt"] {
        let base = folder.write(name, chart);
        let sample = library.reflectance(&format!("{name}#A1"), base).unwrap_or_else(|error| panic!("{error}"));
        assert!((sample.spectrum.at(450.0) - 0.2).abs() < 1e-15);
    }
    let says = message(&folder, library.reflectance("chart.ti3", folder.0.path()).map(drop));
    assert_eq!(says, "chart.ti3: 2 samples: name one, as `chart.ti3#A1`");
}

#[test]
fn bad_yaml_and_csv_are_told() {
    let yaml = |text: &str| ior_error("own.yml", text);
    assert!(yaml("DATA: [\n").starts_with("own.yml:"), "{}", yaml("DATA: [\n"));
    assert!(yaml("\tDATA: 1\n").starts_with("own.yml:"), "{}", yaml("\tDATA: 1\n"));
    assert!(yaml("").starts_with("own.yml"), "{}", yaml(""));
    let csv = ior_error("own.csv", "wavelength_nm,n\n400,one\n");
    assert_eq!(csv, "own.csv:2:5: `one`, expected a number");
}

#[test]
fn formulas_agree_with_an_independent_evaluation() {
    let folder = Folder::new();
    let library = Library::new(Vec::new());
    let mut seen = [false; 9];
    for (row, line) in include_str!("../../data/dispersion_formulas.csv").lines().skip(1).enumerate() {
        let [formula, page, low, high, coefficients, nm, n] = line.split(',').collect::<Vec<_>>().try_into().unwrap();
        let text = format!(
            "REFERENCES: {page}\nDATA:\n  - type: formula {formula}\n    wavelength_range: {low} {high}\n    coefficients: {coefficients}\n"
        );
        let name = format!("{row}.yml");
        let base = folder.write(&name, &text);
        let ior = library.ior(&name, base).unwrap_or_else(|error| panic!("{error}"));
        let (nm, n): (f64, f64) = (nm.parse().unwrap(), n.parse().unwrap());
        assert!((ior.n.at(nm) / n - 1.0).abs() < 1e-14, "{line}: {}", ior.n.at(nm));
        seen[formula.parse::<usize>().unwrap() - 1] = true;
    }
    assert_eq!(seen, [true; 9]);
}

/// A page as the database has it: HTML in the citation, a formula, a k table, keys that we do not read.
const BK7: &str = "# this file is part of refractiveindex.info database

REFERENCES: |
    <a href=\"https://doi.org/10.1000/example\">A catalogue</a><br>
    See also <a href=\"https://example.org/sheets.pdf\">its sheets</a>
COMMENTS: |
    step 0.5 available
DATA:
  - type: formula 2
    wavelength_range: 0.3 2.5
    coefficients: 0 1.03961212 0.00600069867 0.231792344 0.0200179144 1.01046945 103.560653
  - type: tabulated k
    data: |
        0.300 2.8607E-06
        0.310 1.3679E-06
        0.310 1.3679E-06
        2.500 8.1300E-06
CONDITIONS:
    temperature: 293
PROPERTIES:
    thermal_dispersion:
      - type: formula A
        coefficients: 1.86e-06 1.31e-08 -1.37e-11 4.34e-07 6.27e-10 0.17
    nd: 1.5168
";

#[test]
fn a_page_of_the_database_reads() {
    let folder = Folder::new();
    let library = Library::new(Vec::new());
    let base = folder.write("N-BK7.yml", BK7);
    let ior = library.ior("N-BK7.yml", base).unwrap_or_else(|error| panic!("{error}"));
    assert!((ior.n.at(587.5618) - 1.5168).abs() < 1e-5);
    assert_eq!(ior.k.at(310.0), 1.3679e-6);
    assert_eq!(ior.about.source.doi.as_deref(), Some("10.1000/example"));
    assert_eq!(ior.about.source.title, "A catalogue See also its sheets");
    assert_eq!(ior.about.range_nm, Some((300.0, 2500.0)));
    assert!(ior.about.covers_nm(360.0, 830.0));
    let _: &(dyn Send + Sync) = &library;
}

mod damaged {
    //! No file makes the readers panic, and a damaged one reads or is refused with its name.

    use proptest::prelude::*;

    use super::*;

    const TOML: &str = "quantity = \"ior\"\n[source]\ntitle = \"t\"\nauthors = \"é\"\nlicence = \"l\"\norigin = \"o\"\n[sample]\ndescription = \"d\"\nconfidence = \"low\"\n[table]\nwavelength_nm = [400, 500]\nn = [1, 2]\nk = [0, 1]\n";
    const CSV: &str = "# µ\nwavelength_um,n,k\n0.4,1.5,0\n0.5,1.6,1e-3\n";

    proptest! {
        #[test]
        fn files_are_read_or_refused(
            file in 0..3_usize,
            cuts in prop::collection::vec((0.0..1.0_f64, 0..4_usize, "[ -~\\n\\tµ]{0,4}"), 1..5),
        ) {
            let (name, text) = [("own.toml", TOML), ("own.yml", BK7), ("own.csv", CSV)][file];
            let mut chars: Vec<char> = text.chars().collect();
            for (place, length, insert) in cuts {
                let start = (place * chars.len() as f64) as usize;
                let end = (start + length).min(chars.len());
                chars.splice(start..end, insert.chars());
            }
            let folder = Folder::new();
            let base = folder.write(name, &chars.into_iter().collect::<String>());
            match Library::new(Vec::new()).ior(name, base) {
                Ok(ior) => prop_assert!(ior.n.at(550.0) > 0.0 && ior.k.at(550.0) >= 0.0),
                Err(error) => prop_assert!(error.to_string().contains(name), "{error}"),
            }
        }
    }
}

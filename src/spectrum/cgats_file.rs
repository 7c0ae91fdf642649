//! Reflectances of many samples in the text of CGATS.17, as profilers write it (`.ti3`, `.cgats`,
//! `.it8`).
//!
//! ```text
//! BEGIN_DATA_FORMAT  SAMPLE_ID SPEC_380 SPEC_390 …  END_DATA_FORMAT
//! BEGIN_DATA
//! A1 0.05 0.06 …
//! END_DATA
//! ```
//!
//! Fields that end in a wavelength and speak of `nm` or `spec` are the spectrum; a sample is told
//! by its name or its place, as `chart.ti3#A1`. `SPECTRAL_NORM 100` says that values are percent; where nothing is said, values beyond what
//! any reflectance has say so.

use super::error::Fault;
use super::rows::Separator;
use super::table::{Bound, Number, Outside};
use super::words::Word;
use super::{About, Sample, Source, Spectrum, Table, nearest};

/// Fields that name a sample.
const NAMES: [&str; 5] = ["sample_id", "sample_name", "sampleid", "samplename", "sample_loc"];

/// Above this no reflectance is a share of 1, fluorescence included.
const MOST: f64 = 1.5;

/// What a file holds before a sample is chosen.
struct Chart<'a> {
    fields: Vec<Word<'a>>,
    rows: Vec<Vec<Word<'a>>>,
    /// What a perfect reflector has, if it is said.
    whole: Option<f64>,
}

/// Whether a text is of this kind, whatever its name.
pub(super) fn is_cgats(text: &str) -> bool {
    text.lines().any(|line| line.trim_start().starts_with("BEGIN_DATA_FORMAT"))
}

/// The reflectance of a sample; without a name, of the only one.
pub(super) fn read(text: &str, name: &str, sample: Option<&str>) -> Result<(Spectrum, About), Fault> {
    // Blanks and tabs alike, byte for byte, so that places stay.
    let text = text.replace('\t', " ");
    let chart = Chart::of(&text)?;
    let columns = chart.wavelengths();
    if columns.is_empty() {
        let message = "no spectra in the file, expected fields such as `SPEC_380` or `NM_380`";
        return Err(Fault::new(message));
    }
    let row = chart.sample(name, sample)?;
    let mut notes = Vec::new();
    let whole = chart.whole.unwrap_or_else(|| {
        let values = chart.rows.iter().flat_map(|row| columns.iter().filter_map(|(column, _)| row.get(*column)));
        let largest = values.filter_map(|word| word.number().ok()).map(|number| number.value).fold(0.0, f64::max);
        if largest > MOST {
            notes.push(format!("no SPECTRAL_NORM is stated: values of up to {largest} are taken for percent"));
            return 100.0;
        }
        1.0
    });
    if row.len() != chart.fields.len() {
        let message = format!("{} fields, expected {}", row.len(), chart.fields.len());
        return Err(Fault::at(row.first().map_or(0, |word| word.offset), message));
    }
    let (mut nm, mut values) = (Vec::new(), Vec::new());
    for (column, wavelength) in columns {
        let number = row[column].number()?;
        nm.push(Number { value: wavelength, ..number });
        values.push(Number { value: number.value / whole, ..number });
    }
    let what = "a reflectance";
    let table = Table::from_numbers(&nm, &values, what, Bound::Fraction, Outside::Hold, &mut notes)?;
    let source = Source { origin: name.to_owned(), ..Source::default() };
    let about = About { name: name.to_owned(), source, sample: Sample::default(), range_nm: None, notes };
    Ok((Spectrum::Table(table), about))
}

impl<'a> Chart<'a> {
    fn of(text: &'a str) -> Result<Self, Fault> {
        let mut chart = Chart { fields: Vec::new(), rows: Vec::new(), whole: None };
        let (mut in_format, mut in_data, mut start) = (false, false, 0);
        for line in text.split_inclusive('\n') {
            let mut words = Separator::Mark(' ').words(line, start);
            // Two blanks are no word, a quoted name without letters is one.
            words.retain(|word| !word.text.is_empty() || text[..word.offset].ends_with('"'));
            start += line.len();
            match words.first().map(|word| word.text) {
                None => {}
                Some("BEGIN_DATA") => in_data = true,
                Some("END_DATA") => in_data = false,
                Some("SPECTRAL_NORM") if words.len() > 1 => chart.whole = Some(words[1].number()?.value),
                _ if in_data => chart.rows.push(words),
                Some(first) => {
                    // The fields may stand on the line of the keyword or below it.
                    in_format |= first == "BEGIN_DATA_FORMAT";
                    let marks = ["BEGIN_DATA_FORMAT", "END_DATA_FORMAT"];
                    let ends = words.iter().any(|word| word.text == marks[1]);
                    let fields = words.into_iter().filter(|word| !marks.contains(&word.text));
                    chart.fields.extend(fields.filter(|_| in_format));
                    in_format &= !ends;
                }
            }
        }
        match chart.whole.is_none_or(|whole| whole > 0.0) {
            true => Ok(chart),
            false => Err(Fault::new("SPECTRAL_NORM is not above 0")),
        }
    }

    /// The places of spectral fields and their wavelengths, nm.
    fn wavelengths(&self) -> Vec<(usize, f64)> {
        let fields = self.fields.iter().enumerate();
        fields.filter_map(|(place, field)| Some((place, wavelength(field.text)?))).collect()
    }

    fn sample(&self, name: &str, wanted: Option<&str>) -> Result<&[Word<'a>], Fault> {
        let places =
            self.fields.iter().enumerate().filter(|(_, field)| NAMES.contains(&field.text.to_lowercase().as_str()));
        let places: Vec<usize> = places.map(|(place, _)| place).collect();
        let names = |row: &[Word<'a>]| -> Vec<&'a str> {
            places.iter().filter_map(|place| row.get(*place)).map(|word| word.text).collect()
        };
        let all: Vec<&str> = self.rows.iter().flat_map(|row| names(row)).collect();
        match (wanted, self.rows.as_slice()) {
            (_, []) => Err(Fault::new("no samples in the file, expected rows after BEGIN_DATA")),
            (None, [only]) => Ok(only),
            (None, rows) => {
                let first = all.first().unwrap_or(&"A1");
                let message = format!("{} samples: name one, as `{name}#{first}`", rows.len());
                Err(Fault::new(message))
            }
            (Some(wanted), rows) => {
                let found = rows.iter().find(|row| names(row).contains(&wanted));
                found.map(Vec::as_slice).ok_or_else(|| {
                    let hint = nearest(wanted, all.iter().copied());
                    let hint = hint.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
                    Fault::new(format!("no sample of the file is called `{wanted}`{hint}"))
                })
            }
        }
    }
}

/// The wavelength that a field names, such as `SPECTRAL_NM_380`, `SPEC_380`, `nm380`.
fn wavelength(field: &str) -> Option<f64> {
    let digits = field.find(|letter: char| letter.is_ascii_digit())?;
    let (word, number) = field.split_at(digits);
    let word = word.to_lowercase();
    let spectral = word.contains("nm") || word.contains("spec");
    number.parse().ok().filter(|_| spectral)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHART: &str = "CTI3\nSPECTRAL_NORM \"100\"\nNUMBER_OF_FIELDS 5\nBEGIN_DATA_FORMAT\n\
        SAMPLE_ID SAMPLE_NAME\tXYZ_X SPEC_400 SPEC_500\nEND_DATA_FORMAT\nNUMBER_OF_SETS 2\n\
        BEGIN_DATA\n1 \"dark red\" 5 10 20\n2\tA2\t5\t30\t50\nEND_DATA\n";

    #[test]
    fn a_sample_is_found_by_its_name() {
        let at = |sample| read(CHART, "a.ti3", sample).map(|read| read.0.at(450.0));
        assert!((at(Some("dark red")).unwrap() - 0.15).abs() < 1e-15);
        assert!((at(Some("2")).unwrap() - 0.4).abs() < 1e-15);
        let says = |sample| at(sample).unwrap_err().message;
        assert_eq!(says(None), "2 samples: name one, as `a.ti3#1`");
        assert!(says(Some("dark rad")).contains("did you mean `dark red`"));
        assert!(read("BEGIN_DATA_FORMAT\n", "a", None).unwrap_err().message.contains("no spectra"));
        let short = CHART.replace("\t30\t50", "\t30");
        let message = read(&short, "a.ti3", Some("2")).unwrap_err().in_file("a.ti3", &short);
        assert!(message.to_string().starts_with("a.ti3:10:1: 4 fields, expected 5"), "{message}");
        // Percent without a word of it, a name without letters, and a name of two words that shifts the row.
        let (percent, about) = read(&CHART.replace("SPECTRAL_NORM \"100\"\n", ""), "a.ti3", Some("A2")).unwrap();
        assert!((percent.at(450.0) - 0.4).abs() < 1e-15 && about.notes[0].contains("percent"));
        let nameless = CHART.replace("\"dark red\"", "\"\"");
        assert!((read(&nameless, "a.ti3", Some("1")).unwrap().0.at(450.0) - 0.15).abs() < 1e-15);
        let shifted = CHART.replace("\"dark red\"", "dark red");
        assert!(read(&shifted, "a.ti3", Some("1")).unwrap_err().message.contains("6 fields, expected 5"));
    }
}

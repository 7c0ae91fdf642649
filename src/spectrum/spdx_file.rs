//! A light or a reflectance in the XML of IES TM-27 (`.spdx`): `SpectralData` with its wavelength
//! in nm, in any namespace.

use roxmltree::{Document, Node};

use super::error::Fault;
use super::table::{Bound, Number, Outside};
use super::{About, Quantity, Sample, Source, Spectrum, Table};

/// A curve of a quantity.
pub(super) fn read(text: &str, name: &str, quantity: Quantity) -> Result<(Spectrum, About), Fault> {
    let document = Document::parse(text).map_err(|error| {
        let place = error.pos();
        Fault::at_line(place.row as usize, place.col as usize, error)
    })?;
    let named = |node: &Node, name: &str| node.tag_name().name() == name;
    let stated = document.descendants().find(|node| named(node, "SpectralQuantity"));
    let stated = stated.and_then(|node| node.text()).unwrap_or_default().trim().to_lowercase();
    let is_reflectance = stated == "reflectance";
    if !stated.is_empty() && is_reflectance != (quantity == Quantity::Reflectance)
        || ["transmittance", "absorptance"].contains(&stated.as_str())
    {
        return Err(Fault::new(format!("its spectral quantity is `{stated}`, expected one of {}", quantity.as_str())));
    }
    let (mut nm, mut values) = (Vec::new(), Vec::new());
    for node in document.descendants().filter(|node| named(node, "SpectralData")) {
        let place = node.range().start;
        let number = |text: Option<&str>, what: &str| {
            let value = text.and_then(|text| text.trim().parse().ok());
            let message = || Fault::at(place, format!("`SpectralData` without {what}, expected a number"));
            value.map(|value| Number { value, offset: place }).ok_or_else(message)
        };
        nm.push(number(node.attribute("wavelength"), "a wavelength")?);
        values.push(number(node.text(), "a value")?);
    }
    let mut notes = Vec::new();
    let table = match quantity {
        Quantity::Illuminant => {
            Table::from_numbers(&nm, &values, "a spectral power", Bound::Power, Outside::Zero, &mut notes)?
        }
        _ => Table::from_numbers(&nm, &values, "a reflectance", Bound::Fraction, Outside::Hold, &mut notes)?,
    };
    let described = document.descendants().find(|node| named(node, "Description")).and_then(|node| node.text());
    let sample = Sample { description: described.unwrap_or_default().trim().to_owned(), ..Sample::default() };
    let source = Source { origin: name.to_owned(), ..Source::default() };
    Ok((Spectrum::Table(table), About { name: name.to_owned(), source, sample, range_nm: None, notes }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAMP: &str = "<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"http://www.ies.org/iestm2714\" version=\"1.0\">\n\
        <Header><Description>a lamp</Description></Header>\n<SpectralDistribution>\n\
        <SpectralQuantity>flux</SpectralQuantity>\n<SpectralData wavelength=\"400\">0.5</SpectralData>\n\
        <SpectralData wavelength=\"500.0\"> 1.5 </SpectralData>\n</SpectralDistribution></IESTM2714>\n";

    #[test]
    fn a_lamp_is_read() {
        let (lamp, about) = read(LAMP, "a.spdx", Quantity::Illuminant).unwrap();
        assert_eq!((lamp.at(450.0), lamp.at(501.0)), (1.0, 0.0));
        assert_eq!(about.sample.description, "a lamp");
        let says = |text: &str| read(text, "a", Quantity::Illuminant).unwrap_err().in_file("a.spdx", text).to_string();
        let bad = LAMP.replace("0.5", "half");
        assert!(says(&bad).starts_with("a.spdx:6:1: `SpectralData` without a value"), "{}", says(&bad));
        let as_reflectance = read(LAMP, "a.spdx", Quantity::Reflectance).unwrap_err().message;
        assert!(as_reflectance.contains("`flux`"), "{as_reflectance}");
        for other in ["reflectance", "transmittance"] {
            assert!(says(&LAMP.replace(">flux<", &format!(">{other}<"))).contains(other));
        }
        assert!(says("<a>").starts_with("a.spdx:1:"), "{}", says("<a>"));
        assert!(says("<a/>").contains("the table is empty"), "{}", says("<a/>"));
    }
}

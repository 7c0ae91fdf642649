//! Numbers and texts as a page shows them.

/// Text that stands for itself in HTML, between tags and in quoted attributes.
pub fn escaped(text: &str) -> String {
    let sign = |c: char| match c {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        '\'' => "&#39;".to_owned(),
        c => c.to_string(),
    };
    text.chars().map(sign).collect()
}

/// Three significant digits.
pub fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return "∞".into();
    }
    let exponent = libm::floor(libm::log10(value.abs())) as i32;
    match exponent {
        -4..=2 => format!("{value:.*}", (2 - exponent) as usize),
        3..=5 => format!("{value:.0}"),
        _ => format!("{value:.1e}"),
    }
}

/// The same with its sign.
pub fn signed(value: f64) -> String {
    let sign = if value > 0.0 {
        "+"
    } else if value < 0.0 {
        "−"
    } else {
        ""
    };
    format!("{sign}{}", short(value.abs()))
}

/// A share in percent with its sign: `+1.23 %`.
pub fn percent(share: f64) -> String {
    format!("{} %", signed(100.0 * share))
}

/// Seconds, as long as people want to read.
pub fn seconds(value: f64) -> String {
    format!("{} s", short(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stand_for_themselves() {
        assert_eq!(escaped("<a href=\"x\">'&'"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;");
    }

    #[test]
    fn numbers_have_three_digits() {
        let cases =
            [(0.0, "0"), (1.2345, "1.23"), (123.4, "123"), (0.012345, "0.0123"), (4567.8, "4568"), (1e-9, "1.0e-9")];
        for (value, expected) in cases {
            assert_eq!(short(value), expected);
        }
        assert_eq!((percent(0.01234), percent(-0.5), percent(0.0)), ("+1.23 %".into(), "−50.0 %".into(), "0 %".into()));
    }
}

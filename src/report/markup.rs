//! Texts and values as the languages of reports take them: a name stays a name, whatever is in it.

use serde::Serialize;

/// Text that stands for itself in HTML and SVG, between tags and in quoted attributes.
pub fn html(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            other => escaped.push(other),
        }
    }
    escaped
}

/// Text without what Markdown reads as a table, markup or HTML.
pub fn markdown(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '|' | '\\' | '*' | '_' | '`' | '[' | ']' | '<' | '>' => escaped.extend(['\\', character]),
            '\n' | '\r' => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}

/// A value as JSON for programs that people look at, too. JSON has no NaN and no infinity: they are null.
pub fn json(value: &impl Serialize) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stand_for_themselves() {
        assert_eq!(html("<a href=\"x\">'&'"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;");
        assert_eq!(markdown("a|b\n*c* `d` [e] <f> g_h \\"), "a\\|b \\*c\\* \\`d\\` \\[e\\] \\<f\\> g\\_h \\\\");
    }

    #[test]
    fn numbers_that_are_none_are_null() {
        assert_eq!(json(&[1.5, f64::NAN, f64::INFINITY]).unwrap(), "[\n  1.5,\n  null,\n  null\n]");
    }
}

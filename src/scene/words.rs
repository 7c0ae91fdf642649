//! What serde and the TOML parser say, in the words of the person who wrote the file.

use super::describe::TOP_KEYS;
use crate::spectrum::nearest;

/// A parser's message without its jargon.
pub fn plain(message: &str) -> String {
    let message = message.trim_end();
    if let Some((unknown, known)) = unknown_name(message) {
        let what = if message.starts_with("unknown field") { "key" } else { "name" };
        return format!("unknown {what} `{unknown}`; known here: `{}`", known.join("`, `"));
    }
    if message == "invalid type: map, expected enum" {
        return "this table is empty: it must say one kind".to_owned();
    }
    if let Some(rest) = message.strip_prefix("invalid type: ").or_else(|| message.strip_prefix("invalid value: "))
        && let Some((found, expected)) = rest.split_once(", expected ")
    {
        return format!("expected {}, found {}", plain_expected(expected), plain_found(found));
    }
    if let Some(field) = message.strip_prefix("missing field ") {
        return format!("{field} is missing");
    }
    match message {
        "duplicate key" => "this is given twice: it stands further up already".to_owned(),
        "wanted string or table" => "expected a text in quotes".to_owned(),
        "recursion limit" | "cannot recurse further; max recursion depth met" => {
            "nested too deeply: no scene needs more than a few levels".to_owned()
        }
        other => other.to_owned(),
    }
}

/// What was probably meant by an unknown key or name.
pub fn meant(message: &str) -> Option<String> {
    let (unknown, known) = unknown_name(message)?;
    if TOP_KEYS.contains(&unknown) && !known.contains(&unknown) {
        return Some(format!("`{unknown}` belongs at the top of the file, above the first [table]"));
    }
    nearest(unknown, known).map(|name| format!("did you mean `{name}`?"))
}

/// What was probably meant by a slip of notation, given the line and how many of its bytes stand before the place of the error.
pub fn slip(message: &str, (line, before): (&str, usize)) -> Option<String> {
    let (unit, commas) = (
        "a number stands alone: its key says what it counts in",
        "numbers in a list stand apart by commas: [0, -8, 4]",
    );
    if message.starts_with("missing comma between array elements") {
        return Some(commas.to_owned());
    }
    if message.starts_with("string values must be quoted") {
        let words: Vec<&str> = line.get(before..)?.split([',', ']', '}', '#']).next()?.split_whitespace().collect();
        let number = |word: &&str| word.parse::<f64>().is_ok();
        return match words[..] {
            [_, _, ..] if words.iter().all(&number) => Some(commas.to_owned()),
            [first, _, ..] if number(&first) => Some(unit.to_owned()),
            _ => None,
        };
    }
    let text = message.strip_prefix("invalid type: string \"").and_then(|rest| rest.split_once("\", expected f64"));
    if let Some((text, _)) = text {
        return measured(text).then(|| unit.to_owned());
    }
    let value = line.get(..before)?.rsplit(['=', ',', '[', '{']).next()?;
    let follows = line.get(before..)?.trim_start().starts_with(char::is_alphabetic);
    (follows && value.trim().parse::<f64>().is_ok()).then(|| unit.to_owned())
}

/// Whether a text is a number with something behind it, such as "200 cd".
fn measured(text: &str) -> bool {
    let number = text.trim().split(|c: char| c.is_whitespace() || c.is_alphabetic()).next().unwrap_or("");
    number.parse::<f64>().is_ok()
}

/// "unknown field `x`, expected one of `a`, `b`" as x and [a, b].
fn unknown_name(message: &str) -> Option<(&str, Vec<&str>)> {
    let (unknown, expected) = message.strip_prefix("unknown ")?.split_once(", expected ")?;
    Some((unknown.split('`').nth(1)?, expected.split('`').skip(1).step_by(2).collect()))
}

fn plain_expected(expected: &str) -> &str {
    match expected {
        "f64" => "a number",
        "u32" => "a whole number from 0 to 4294967295",
        "i32" => "a whole number",
        "u64" => "a whole number, not negative",
        "a string" => "a text in quotes",
        "a boolean" => "true or false",
        "a sequence" => "a list",
        "a map" => "a table",
        _ if expected.starts_with("struct ") => "a table",
        other => other,
    }
}

fn plain_found(found: &str) -> String {
    if let Some(text) = found.strip_prefix("string ") {
        return format!("the text {text}");
    }
    match found {
        "map" => "a table".to_owned(),
        "sequence" => "a list".to_owned(),
        // integer `5`, floating point `4.5`, boolean `true`
        other => other.split('`').nth(1).unwrap_or(other).to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jargon_becomes_english() {
        for (jargon, english) in [
            (
                "invalid type: string \"four\", expected u32",
                "expected a whole number from 0 to 4294967295, found the text \"four\"",
            ),
            ("invalid value: integer `-4`, expected u64", "expected a whole number, not negative, found -4"),
            ("invalid type: floating point `4.5`, expected struct Emission", "expected a table, found 4.5"),
            ("invalid type: map, expected f64", "expected a number, found a table"),
            ("missing field `camera`", "`camera` is missing"),
            ("unknown field `q`, expected `n` or `k`", "unknown key `q`; known here: `n`, `k`"),
            ("unknown variant `q`, expected one of `a`, `b`, `c`", "unknown name `q`; known here: `a`, `b`, `c`"),
            ("unclosed array, expected `]`", "unclosed array, expected `]`"),
        ] {
            assert_eq!(plain(jargon), english);
        }
    }

    #[test]
    fn slips_of_notation_are_told() {
        let comma = slip("missing comma between array elements, expected `,`", ("position = [0 -8 4]", 14));
        assert!(comma.is_some_and(|help| help.contains("[0, -8, 4]")));
        let comma = slip("string values must be quoted, expected literal string", ("position = [0 -8 4]", 12));
        assert!(comma.is_some_and(|help| help.contains("[0, -8, 4]")));
        let said = |help: Option<String>| help.is_some_and(|help| help.contains("stands alone"));
        assert!(said(slip("unexpected key or value", ("luminance = 200 cd", 16))));
        assert!(said(slip("string values must be quoted", ("luminance = 200 cd", 12))));
        assert!(said(slip("unexpected", ("emission = { luminance = 200 cd }", 29))));
        assert!(said(slip("invalid type: string \"200 cd/m²\", expected f64", ("luminance = \"200 cd/m²\"", 12))));
        assert_eq!(slip("invalid type: string \"bright\", expected f64", ("luminance = \"bright\"", 12)), None);
        assert_eq!(slip("unexpected key or value", ("name = \"a\" b", 11)), None);
    }

    #[test]
    fn unknown_names_give_a_suggestion() {
        let message = "unknown field `radus`, expected one of `center`, `radius`";
        assert_eq!(meant(message).as_deref(), Some("did you mean `radius`?"));
        assert_eq!(meant("unknown field `zzz`, expected `center`"), None);
        assert_eq!(meant("invalid type: string"), None);
        let late = meant("unknown field `meters_per_unit`, expected one of `name`, `material`").unwrap();
        assert!(late.contains("top of the file"), "{late}");
    }
}

//! Reads the structures of `describe.rs`: names, doc comments, fields and variants. It knows the few forms used there.

/// A structure or a choice.
pub struct Item {
    pub name: String,
    pub doc: String,
    pub kind: Kind,
}

pub enum Kind {
    Keys(Vec<Entry>),
    Choices(Vec<Entry>),
}

/// A key of a table, or one of several.
pub struct Entry {
    pub name: String,
    pub doc: String,
    /// As in the source; empty for a word that stands for itself.
    ty: String,
    defaults: bool,
}

/// Types that are written as plain values, and how people call these.
const VALUES: &[(&str, &str)] = &[
    ("Number", "number"),
    ("Finite", "number"),
    ("Spanned<f64>", "number"),
    ("Length", "length"),
    ("Spanned<u32>", "whole number"),
    ("u32", "whole number"),
    ("u64", "whole number"),
    ("bool", "`true` or `false`"),
    ("String", "text"),
    ("Spanned<String>", "name"),
    ("Vector", "[x, y, z]"),
    ("Numbers<3>", "three numbers"),
    ("Lengths<2>", "[width, height]"),
    ("Lengths<3>", "[x, y, z]"),
    ("Vec<String>", "list of names"),
    ("Vec<Spanned<f64>>", "list of numbers"),
    ("Vec<Spanned<Numbers<2>>>", "list of [nm, power]"),
    ("Vec<Spanned<Numbers<4>>>", "list of [nx, ny, nz, d]"),
    ("FresnelModel", "name of a [model](fresnel.md)"),
    ("Spanned<FresnelModel>", "name of a [model](fresnel.md)"),
    ("Spanned<ExposureValue>", "`\"auto\"` or EV"),
    ("Spanned<IndexSource>", "name or [file](data-files.md), n, or [own index](#own-index)"),
    ("OneOrThree", "number, or [r, g, b]"),
    ("f64", "number"),
    ("Vec<f64>", "list of numbers"),
    ("Spanned<AbsorptionSource>", "name, or number in 1/m"),
    ("Spanned<ReflectanceSource>", "name, number 0…1, `{ rgb = [r, g, b] }`, or [image](#image-texture)"),
    ("Spanned<RoughnessSource>", "number, or [image](#image-texture)"),
    ("Numbers<2>", "[u, v]"),
    ("Spanned<Scale>", "factor, or [x, y, z]"),
    ("Spanned<LightSpectrum>", "illuminant's name or file, or [own light](#own-light)"),
];

impl Item {
    /// Forms of a single value are explained where they are used.
    pub fn shown(&self) -> bool {
        !VALUES.iter().any(|(ty, _)| *ty == self.name || *ty == format!("Spanned<{}>", self.name))
    }

    /// "StepCut" as "Step cut".
    pub fn title(&self) -> String {
        let mut title = String::new();
        for letter in self.name.chars() {
            if letter.is_uppercase() && !title.is_empty() {
                title.push(' ');
                title.extend(letter.to_lowercase());
            } else {
                title.push(letter);
            }
        }
        title
    }
}

impl Entry {
    /// What stands at the key, with a link where that is a table of its own.
    pub fn value(&self, items: &[Item]) -> String {
        let ty = self.ty.strip_prefix("Option<").and_then(|ty| ty.strip_suffix('>')).unwrap_or(&self.ty);
        if let Some((_, words)) = VALUES.iter().find(|(known, _)| *known == ty) {
            return (*words).to_owned();
        }
        let inner = ["Spanned<", "Box<", "Vec<Spanned<", "BTreeMap<String, Spanned<"]
            .into_iter()
            .find_map(|open| ty.strip_prefix(open).map(|rest| rest.trim_end_matches('>')).map(|rest| (open, rest)));
        let (open, name) = inner.unwrap_or(("", ty));
        let Some(item) = items.iter().find(|item| item.name == name) else { return String::new() };
        let link = format!("[{}](#{})", item.title().to_lowercase(), item.title().to_lowercase().replace(' ', "-"));
        match open {
            "Vec<Spanned<" => format!("list of {link}s"),
            "BTreeMap<String, Spanned<" => format!("by name, a {link} each"),
            _ => link,
        }
    }

    pub fn need(&self) -> &'static str {
        if self.ty.starts_with("Option<") || self.defaults { "" } else { ", **needed**" }
    }
}

pub fn items(source: &str) -> Vec<Item> {
    let mut items = Vec::new();
    let mut lines = source.lines().peekable();
    let mut doc = String::new();
    let (mut kebab, mut is_read) = (false, false);
    while let Some(line) = lines.next() {
        if let Some(words) = line.strip_prefix("///") {
            join(&mut doc, words);
        } else if line.starts_with("#[serde") {
            kebab |= line.contains("kebab-case");
        } else if line.starts_with("#[derive") {
            is_read |= line.contains("Deserialize");
        } else if let Some(rest) = line.strip_prefix("pub struct ").or(line.strip_prefix("pub enum ")) {
            let body: Vec<&str> =
                if rest.ends_with('{') { lines.by_ref().take_while(|line| *line != "}").collect() } else { vec![] };
            let name = rest.split([' ', '(']).next().unwrap_or_default().to_owned();
            let kind = if line.starts_with("pub struct") {
                Kind::Keys(entries(&body, false))
            } else {
                Kind::Choices(entries(&body, kebab))
            };
            // What is only made of files is described elsewhere.
            let doc = std::mem::take(&mut doc);
            if is_read {
                items.push(Item { name, doc, kind });
            }
            (kebab, is_read) = (false, false);
        } else if !line.starts_with("#[") {
            doc.clear();
            (kebab, is_read) = (false, false);
        }
    }
    items
}

fn join(doc: &mut String, words: &str) {
    if !doc.is_empty() {
        doc.push(' ');
    }
    doc.push_str(words.trim());
}

fn entries(body: &[&str], kebab: bool) -> Vec<Entry> {
    let (mut entries, mut doc, mut renamed, mut defaults) = (Vec::new(), String::new(), None, false);
    for line in body.iter().map(|line| line.trim().trim_end_matches(',')) {
        if let Some(words) = line.strip_prefix("///") {
            join(&mut doc, words);
        } else if line.starts_with('#') {
            defaults |= line.contains("default");
            renamed =
                line.split("rename = \"").nth(1).and_then(|rest| rest.split('"').next()).map(str::to_owned).or(renamed);
        } else {
            let (name, ty) = match line.strip_prefix("pub ").and_then(|field| field.split_once(": ")) {
                Some((name, ty)) => (name.to_owned(), ty.to_owned()),
                None => {
                    let (name, rest) = line.split_once('(').unwrap_or((line, ""));
                    (if kebab { dashed(name) } else { name.to_owned() }, rest.trim_end_matches(')').to_owned())
                }
            };
            let name = renamed.take().unwrap_or(name);
            entries.push(Entry { name, doc: std::mem::take(&mut doc), ty, defaults: std::mem::take(&mut defaults) });
        }
    }
    entries
}

fn dashed(name: &str) -> String {
    let mut dashed = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !dashed.is_empty() {
            dashed.push('-');
        }
        dashed.extend(letter.to_lowercase());
    }
    dashed
}

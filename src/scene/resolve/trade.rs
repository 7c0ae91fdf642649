//! What jewellers and dealers call materials that have data under another name.

/// Names of the trade, the material that stands for them, and why.
const TRADE: &[(&[&str], &str, &str)] = &[
    (&["aquamarine", "morganite", "heliodor", "bixbite"], "beryl", "it is a beryl, which is here without its colour"),
    (
        &["citrine", "rose quartz", "smoky quartz", "prasiolite", "ametrine"],
        "quartz",
        "it is a quartz, which is here without its colour",
    ),
    (&["tsavorite", "hessonite"], "grossular", "it is a grossular, which is here without its colour"),
    (&["rhodolite"], "pyrope", "it is a garnet of pyrope and almandine"),
    (&["paraiba", "rubellite", "indicolite", "verdelite"], "tourmaline", "it is a tourmaline"),
    (&["olivine", "chrysolite"], "peridot", "the gem of olivine is peridot"),
    (&["zoisite"], "tanzanite", "the blue zoisite is tanzanite"),
    (&["padparadscha", "star sapphire"], "sapphire", "it is a sapphire"),
    (&["cz", "zirconia"], "cubic-zirconia", "it is cubic zirconia"),
    (&["yag garnet"], "yag", "it is yttrium aluminium garnet"),
    (&["white gold"], "rhodium", "white gold is plated with rhodium as a rule, which is what is seen"),
    (&["sterling silver", "sterling"], "silver", "sterling is silver with 7.5 % of copper"),
    (&["crown glass", "window glass"], "soda-lime-clear", "a common clear glass"),
];

/// The material that stands for a name of the trade, in words.
pub fn traded(name: &str) -> Option<String> {
    let plain = |text: &str| text.chars().filter(char::is_ascii_alphanumeric).collect::<String>().to_lowercase();
    let wanted = plain(name);
    let (_, material, why) = TRADE.iter().find(|(names, ..)| names.iter().any(|known| plain(known) == wanted))?;
    Some(format!("{why}: `material = \"{material}\"`"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::Library;

    #[test]
    fn every_name_of_the_trade_stands_for_a_material_that_is_there() {
        let library = Library::default();
        for (names, material, _) in TRADE {
            assert!(library.material(material).is_ok(), "{material}");
            for name in *names {
                assert!(library.material(name).is_err(), "{name} has data of its own");
            }
        }
        assert!(traded("White-Gold").is_some_and(|hint| hint.contains("`material = \"rhodium\"`")));
        assert_eq!(traded("gold"), None);
    }
}

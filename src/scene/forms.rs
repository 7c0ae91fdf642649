//! Values that may be written in more than one form: a name, a number, a list or a table.
//!
//! Untagged serde enums would do it too, but they lose the place of what is wrong inside a table; one visitor keeps it.

use super::describe::{
    Environment, ExposureValue, ImageTexture, LightSpectrum, OwnLight, Scale, Shape, TextureSpaceName,
};
use super::materials::{AbsorptionSource, IndexSource, ReflectanceSource, RoughnessSource};
use super::numbers::{Finite, Numbers};
use super::own_index::{OneOrThree, OwnIndex};
use super::pictures::WrapName;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;
use toml::Spanned;

/// The forms a value takes; those that are not overridden are type errors that say what was expected.
trait Forms<'de>: Sized {
    const EXPECTED: &'static str;

    fn name<E: Error>(name: &str) -> Result<Self, E> {
        Err(unexpected::<Self, E>(&format!("the text \"{name}\"")))
    }

    fn number<E: Error>(number: f64) -> Result<Self, E> {
        Err(unexpected::<Self, E>(&number.to_string()))
    }

    fn list<A: SeqAccess<'de>>(_: A) -> Result<Self, A::Error> {
        Err(unexpected::<Self, A::Error>("a list"))
    }

    fn table<A: MapAccess<'de>>(_: A) -> Result<Self, A::Error> {
        Err(unexpected::<Self, A::Error>("a table"))
    }
}

fn unexpected<'de, T: Forms<'de>, E: Error>(found: &str) -> E {
    E::custom(format!("expected {}, found {found}", T::EXPECTED))
}

/// An externally tagged enum whose table holds one kind and nothing else; serde alone would ignore what follows the first.
fn one_kind<'de, T: Forms<'de>, A: MapAccess<'de>>(
    mut table: A,
    read: impl FnOnce(MapAccessDeserializer<&mut A>) -> Result<T, A::Error>,
) -> Result<T, A::Error> {
    let kind = read(MapAccessDeserializer::new(&mut table))?;
    match table.next_key::<String>()? {
        None => Ok(kind),
        Some(second) => Err(unexpected::<T, A::Error>(&format!("`{second}` beside another one"))),
    }
}

struct FormVisitor<T>(PhantomData<T>);

impl<'de, T: Forms<'de>> Visitor<'de> for FormVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(T::EXPECTED)
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<T, E> {
        T::name(value)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<T, E> {
        T::number(value as f64)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<T, E> {
        T::number(value)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<T, A::Error> {
        T::list(list)
    }

    fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<T, A::Error> {
        T::table(table)
    }
}

macro_rules! deserialize_by_form {
    ($($type:ty),*) => {$(
        impl<'de> Deserialize<'de> for $type {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.deserialize_any(FormVisitor::<Self>(PhantomData))
            }
        }
    )*};
}

deserialize_by_form!(
    AbsorptionSource,
    Environment,
    ExposureValue,
    IndexSource,
    LightSpectrum,
    OneOrThree,
    ReflectanceSource,
    RoughnessSource,
    Scale,
    Shape
);

impl<'de> Forms<'de> for Environment {
    const EXPECTED: &'static str = "one kind of environment: `constant`, `gradient` or `image`";

    fn table<A: MapAccess<'de>>(table: A) -> Result<Self, A::Error> {
        one_kind(table, |table| Self::deserialize(table))
    }
}

impl<'de> Forms<'de> for Shape {
    const EXPECTED: &'static str = "one kind of shape with its sizes, such as { sphere = { radius = 1 } }";

    fn table<A: MapAccess<'de>>(table: A) -> Result<Self, A::Error> {
        one_kind(table, |table| Self::deserialize(table))
    }
}

impl<'de> Forms<'de> for ExposureValue {
    const EXPECTED: &'static str = "\"auto\" or an exposure value";

    fn name<E: Error>(name: &str) -> Result<Self, E> {
        if name == "auto" { Ok(Self::Auto) } else { Err(unexpected::<Self, E>(&format!("the text \"{name}\""))) }
    }

    fn number<E: Error>(ev: f64) -> Result<Self, E> {
        Ok(Self::Ev(ev))
    }
}

impl<'de> Forms<'de> for LightSpectrum {
    const EXPECTED: &'static str =
        "an illuminant's name or file, or one of { blackbody = K }, { daylight = K }, { table = … } and { lines = … }";

    fn name<E: Error>(name: &str) -> Result<Self, E> {
        Ok(Self::Name(name.to_owned()))
    }

    fn table<A: MapAccess<'de>>(table: A) -> Result<Self, A::Error> {
        one_kind(table, |table| OwnLight::deserialize(table).map(Self::Own))
    }
}

impl<'de> Forms<'de> for IndexSource {
    const EXPECTED: &'static str =
        "a data set's name or file, an index, or a table such as { n = …, k = … } or { n_d = …, abbe = … }";

    fn name<E: Error>(name: &str) -> Result<Self, E> {
        Ok(Self::Name(name.to_owned()))
    }

    fn number<E: Error>(n: f64) -> Result<Self, E> {
        Ok(Self::Constant { n, k: 0.0 })
    }

    fn table<A: MapAccess<'de>>(table: A) -> Result<Self, A::Error> {
        let own = OwnIndex::deserialize(MapAccessDeserializer::new(table))?;
        Ok(match (own.n, own.k.unwrap_or(OneOrThree::One(0.0))) {
            (Some(OneOrThree::One(n)), OneOrThree::One(k)) if own.is_plain() => Self::Constant { n, k },
            _ => Self::Own(Box::new(own)),
        })
    }
}

impl<'de> Forms<'de> for OneOrThree {
    const EXPECTED: &'static str = "a number, or three for red, green and blue";

    fn number<E: Error>(value: f64) -> Result<Self, E> {
        Ok(Self::One(value))
    }

    fn list<A: SeqAccess<'de>>(list: A) -> Result<Self, A::Error> {
        Numbers::deserialize(SeqAccessDeserializer::new(list)).map(Self::Three)
    }
}

impl<'de> Forms<'de> for AbsorptionSource {
    const EXPECTED: &'static str = "an absorption data set's name or file, or a coefficient in 1/m";

    fn name<E: Error>(name: &str) -> Result<Self, E> {
        Ok(Self::Name(name.to_owned()))
    }

    fn number<E: Error>(per_metre: f64) -> Result<Self, E> {
        Ok(Self::PerMetre(per_metre))
    }
}

impl<'de> Forms<'de> for ReflectanceSource {
    const EXPECTED: &'static str =
        "a reflectance data set's name or file, a number 0…1, { rgb = [r, g, b] }, or { image = \"…\" }";

    fn name<E: Error>(name: &str) -> Result<Self, E> {
        Ok(Self::Name(name.to_owned()))
    }

    fn number<E: Error>(value: f64) -> Result<Self, E> {
        Ok(Self::Constant(value))
    }

    fn table<A: MapAccess<'de>>(table: A) -> Result<Self, A::Error> {
        /// The keys of both kinds, so that unknown ones are told with all that could be meant.
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Either {
            rgb: Option<Numbers<3>>,
            image: Option<Spanned<String>>,
            color_space: Option<Spanned<TextureSpaceName>>,
            scale: Option<Numbers<2>>,
            wrap: Option<WrapName>,
        }
        let Either { rgb, image, color_space, scale, wrap } = Either::deserialize(MapAccessDeserializer::new(table))?;
        let plain = color_space.is_none() && scale.is_none() && wrap.is_none();
        match (rgb, image) {
            (Some(rgb), None) if plain => Ok(Self::Rgb(rgb.values())),
            (None, Some(image)) => {
                Ok(Self::Image(ImageTexture { image, color_space, scale, wrap: wrap.unwrap_or_default() }))
            }
            (Some(_), _) => Err(unexpected::<Self, A::Error>("keys of both")),
            (None, None) => Err(unexpected::<Self, A::Error>("a table with neither")),
        }
    }
}

impl<'de> Forms<'de> for RoughnessSource {
    const EXPECTED: &'static str = "a number 0…1, or { image = \"…\" }";

    fn number<E: Error>(value: f64) -> Result<Self, E> {
        Ok(Self::Constant(value))
    }

    fn table<A: MapAccess<'de>>(table: A) -> Result<Self, A::Error> {
        ImageTexture::deserialize(MapAccessDeserializer::new(table)).map(Self::Image)
    }
}

impl<'de> Forms<'de> for Scale {
    const EXPECTED: &'static str = "a factor, or three of them for x, y and z";

    fn number<E: Error>(factor: f64) -> Result<Self, E> {
        let number = Finite::deserialize(serde::de::value::F64Deserializer::<E>::new(factor))?;
        Ok(Self(Numbers::new([number.0; 3])))
    }

    fn list<A: SeqAccess<'de>>(list: A) -> Result<Self, A::Error> {
        Numbers::deserialize(SeqAccessDeserializer::new(list)).map(Self)
    }
}

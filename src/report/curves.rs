//! Lines in a small SVG: reflectance against the angle, one line a variant.

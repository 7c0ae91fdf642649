//! Random numbers and Pearson's χ² for the tests of samplers; each test file uses what it needs.
#![allow(dead_code, reason = "each test binary uses a part")]

pub mod directions;

/// SplitMix64 (G. Steele et al., 2014).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1), 24 bits.
    pub fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 * (1.0 / (1 << 24) as f32)
    }

    pub fn point(&mut self) -> [f32; 2] {
        [self.unit(), self.unit()]
    }
}

/// p-value of `counts` out of `samples` against probabilities `expected`; cells that expect fewer than ten are pooled.
pub fn chi_squared(counts: &[f64], expected: &[f64], samples: f64) -> f64 {
    let (mut statistic, mut cells, mut pool) = (0.0, 0.0, (0.0, 0.0));
    let mut add = |count: f64, mean: f64| {
        statistic += (count - mean) * (count - mean) / mean;
        cells += 1.0;
    };
    for (&count, &probability) in counts.iter().zip(expected) {
        let mean = probability * samples;
        if mean < 10.0 { pool = (pool.0 + count, pool.1 + mean) } else { add(count, mean) }
    }
    if pool.1 > 1.0 || pool.0 > 0.0 {
        add(pool.0, pool.1.max(1.0));
    }
    upper_gamma(0.5 * (cells - 1.0), 0.5 * statistic)
}

/// Q(a, x) = Γ(a, x)/Γ(a), by series below a + 1 and Lentz's continued fraction above
/// (Press et al., *Numerical Recipes*, 2007, 6.2).
fn upper_gamma(a: f64, x: f64) -> f64 {
    let scale = (a * x.ln() - x - libm::lgamma(a)).exp();
    if x < a + 1.0 { 1.0 - scale * series(a, x) } else { scale * fraction(a, x) }
}

fn series(a: f64, x: f64) -> f64 {
    let (mut term, mut sum) = (1.0 / a, 1.0 / a);
    for n in 1..10_000 {
        term *= x / (a + n as f64);
        sum += term;
        if term < sum * 1e-15 {
            break;
        }
    }
    sum
}

fn fraction(a: f64, x: f64) -> f64 {
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (1e300, 1.0 / b);
    let mut h = d;
    for n in 1..10_000 {
        let coefficient = -(n as f64) * (n as f64 - a);
        b += 2.0;
        d = 1.0 / (coefficient * d + b);
        c = b + coefficient / c;
        h *= d * c;
        if (d * c - 1.0).abs() < 1e-15 {
            break;
        }
    }
    h
}

#[test]
fn p_values_are_those_of_tables() {
    // χ² = 18.307 with 10 degrees of freedom and 124.342 with 100: p = 0.05 (Abramowitz & Stegun, 1964, table 26.8).
    assert!((upper_gamma(5.0, 0.5 * 18.307) - 0.05).abs() < 1e-5);
    assert!((upper_gamma(50.0, 0.5 * 124.342) - 0.05).abs() < 1e-5);
}

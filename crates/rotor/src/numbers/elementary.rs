//! Elementary functions of multiply, add, divide and square root, which have the same bits in any
//! lanes and on every platform.
//!
//! The polynomials and rational functions are those of FDLIBM (Sun Microsystems 1993, k_sin.c,
//! k_cos.c, e_acos.c, e_log.c) and of Cephes (Moshier 1992, atan.c); the exponential is its Taylor
//! series up to r^13 for |r| <= ln(2)/2. Low words of intermediate results are left out, so that
//! results are within 2 ulp of those of `libm` instead of 1; the tests hold them to that.
//!
//! A few arguments are outside of what the lanes are made for (angles beyond 10^5 rad, logarithms
//! of subnormal numbers). If any lane is outside, `libm` computes all lanes: the last bits of a
//! lane can depend on its neighbours, but not on the processor.

// The digits are those in print.
#![allow(clippy::excessive_precision)]

use super::{LANES, Mask, Plain};
use core::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LOG2_E, PI};

/// 1.5 2^52: added to a number below 2^51 it rounds to an integer, which then stands in the last
/// bits.
pub const INTEGERS: f64 = 6_755_399_441_055_744.0;

/// Bits of the number nearest to sqrt(1/2), at which the mantissas of `split` begin.
pub const SQRT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;

/// Takes the bits of `SQRT_HALF` to those of 1.
pub const TO_SQRT_HALF: u64 = 0x3ff0_0000_0000_0000 - SQRT_HALF;

/// The bits of a mantissa.
pub const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;

/// Takes a biased exponent to the bits of `INTEGERS` plus the exponent.
pub const TO_EXPONENT: u64 = 0x4338_0000_0000_0000 - 1023;

/// ln 2 in two words; multiples of the first up to 2^20 are exact.
const LN_2: [f64; 2] = [
    6.931_471_803_691_238_164_90e-1,
    1.908_214_929_270_587_700_02e-10,
];

/// pi/2 in three words of 33 bits (FDLIBM's pio2_1 to pio2_3): multiples up to 2^20 are exact.
const HALF_PI: [f64; 3] = [
    1.570_796_326_734_125_614_17,
    6.077_100_506_303_965_976_60e-11,
    2.022_266_248_711_166_455_80e-21,
];

/// Beyond this angle, rad, `libm` takes over.
const MAX_ANGLE: f64 = 1e5;

/// The range of exponents of `exp`.
const EXPONENTS: (f64, f64) = (-708.0, 709.0);

/// A function of each lane, outside of what the lanes are made for.
#[cold]
#[inline(never)]
fn of_each(mut values: [f64; LANES], function: fn(f64) -> f64) -> [f64; LANES] {
    for value in &mut values {
        *value = function(*value);
    }
    values
}

/// `of_each` in lanes.
#[inline(always)]
fn by_lane<V: Plain>(x: V, function: fn(f64) -> f64) -> V {
    V::load(&of_each(x.store(), function))
}

/// Horner's scheme.
macro_rules! polynomial {
    ($V:ident, $x:expr; $last:expr) => { $V::splat($last) };
    ($V:ident, $x:expr; $first:expr, $($rest:expr),+) => {
        $x * polynomial!($V, $x; $($rest),+) + $first
    };
}

/// Sine and cosine of an angle, rad.
#[inline(always)]
pub fn sin_cos<V: Plain>(x: V) -> (V, V) {
    if !(!x.abs().above(V::splat(MAX_ANGLE))).all() {
        return (by_lane(x, libm::sin), by_lane(x, libm::cos));
    }
    // x = quarter pi/2 + r
    let quarter = (x * FRAC_2_PI + INTEGERS) - INTEGERS;
    let r = x - quarter * HALF_PI[0] - quarter * HALF_PI[1] - quarter * HALF_PI[2];
    let z = r * r;
    let sin = r + r
        * z
        * polynomial!(V, z;
            -1.666_666_666_666_663_243_48e-1, 8.333_333_333_322_489_461_24e-3,
            -1.984_126_982_985_794_931_34e-4, 2.755_731_370_707_006_767_89e-6,
            -2.505_076_025_340_686_341_95e-8, 1.589_690_995_211_550_102_21e-10);
    let cos = polynomial!(V, z;
        4.166_666_666_666_660_190_37e-2, -1.388_888_888_887_410_957_49e-3,
        2.480_158_728_947_672_941_78e-5, -2.755_731_435_139_066_330_35e-7,
        2.087_572_321_298_174_827_90e-9, -1.135_964_755_778_819_482_65e-11);
    let half = z * 0.5;
    let one = V::splat(1.0);
    // 1 - z/2 rounds; what it loses is added again.
    let rounded = one - half;
    let cos = rounded + (((one - rounded) - half) + z * z * cos);
    // quarter modulo 4: 0 sin, 1 cos, 2 -sin, 3 -cos
    let turns = (quarter * 0.25 + INTEGERS) - INTEGERS;
    let part = quarter - turns * 4.0; // -2, -1, 0, 1 or 2
    let is_odd = (part.abs() - 1.0).is_negligible(0.0);
    let is_half_turn = part.abs().is_above(1.5);
    let swapped = (V::select(is_odd, cos, sin), V::select(is_odd, sin, cos));
    let sine_negative = is_half_turn | part.is_below(-0.5);
    let cosine_negative = is_half_turn | (is_odd & part.is_above(0.5));
    (
        V::select(sine_negative, -swapped.0, swapped.0),
        V::select(cosine_negative, -swapped.1, swapped.1),
    )
}

/// Inverse cosine of -1 to 1; NaN beyond.
#[inline(always)]
pub fn acos<V: Plain>(y: V) -> V {
    let size = y.abs();
    let is_small = size.is_below(0.5);
    let one = V::splat(1.0);
    let z = V::select(is_small, y * y, (one - size) * 0.5);
    let p = z * polynomial!(V, z;
        1.666_666_666_666_666_574_15e-1, -3.255_658_186_224_009_154_05e-1,
        2.012_125_321_348_629_258_81e-1, -4.005_553_450_067_941_140_27e-2,
        7.915_349_942_898_145_321_76e-4, 3.479_331_075_960_211_675_70e-5);
    let q = polynomial!(V, z;
        1.0, -2.403_394_911_734_414_218_78, 2.020_945_760_233_505_694_71,
        -6.882_839_716_054_532_930_30e-1, 7.703_815_055_590_193_527_91e-2);
    let r = p / q;
    let root = z.sqrt();
    let far = (root + root * r) * 2.0;
    let far = V::select(y.is_below(0.0), V::splat(PI) - far, far);
    let near = V::splat(FRAC_PI_2) - (y - (V::splat(6.123_233_995_736_766_035_87e-17) - y * r));
    V::select(is_small, near, far)
}

/// e to the power of x, from -708 to 709. Below it is 0; above, that of 709.
#[inline(always)]
pub fn exp<V: Plain>(x: V) -> V {
    let is_gone = x.is_below(EXPONENTS.0);
    let x = x.at_least(EXPONENTS.0).at_most(EXPONENTS.1);
    let k = (x * LOG2_E + INTEGERS) - INTEGERS;
    let r = x - k * LN_2[0] - k * LN_2[1];
    let series = polynomial!(V, r;
        1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0, 1.0 / 5040.0,
        1.0 / 40_320.0, 1.0 / 362_880.0, 1.0 / 3_628_800.0, 1.0 / 39_916_800.0,
        1.0 / 479_001_600.0, 1.0 / 6_227_020_800.0);
    let value = ((r + r * r * series) + 1.0) * k.exp2();
    V::select(is_gone, V::nil(), value)
}

/// Natural logarithm of a number > 0; -infinity of 0, NaN below.
#[inline(always)]
pub fn ln<V: Plain>(x: V) -> V {
    let is_normal = x.is_above(f64::MIN_POSITIVE) & x.is_below(f64::MAX);
    if !is_normal.all() {
        return by_lane(x, libm::log);
    }
    let (m, k) = x.split();
    let f = m - 1.0;
    let s = f / (f + 2.0);
    let z = s * s;
    let r = z * polynomial!(V, z;
        6.666_666_666_666_735_130e-1, 3.999_999_999_940_941_908e-1,
        2.857_142_874_366_239_149e-1, 2.222_219_843_214_978_396e-1,
        1.818_357_216_161_805_012e-1, 1.531_383_769_920_937_332e-1,
        1.479_819_860_510_658_591e-1);
    let half = f * f * 0.5;
    k * LN_2[0] - ((half - (s * (half + r) + k * LN_2[1])) - f)
}

/// Angle of the point (x, y), -pi to pi; 0 or pi with the sign of y on the x axis and at the
/// origin.
#[inline(always)]
pub fn atan2<V: Plain>(y: V, x: V) -> V {
    let (rise, run) = (y.abs(), x.abs());
    // An angle up to 45 deg, and one up to 22.5 deg of that.
    let is_steep = run.below(rise);
    let small = V::select(is_steep, run, rise);
    let large = V::select(is_steep, rise, run);
    let is_middle = (large * 0.414_213_562_373_095).below(small);
    let numerator = V::select(is_middle, small - large, small);
    let denominator = V::select(is_middle, small + large, large);
    let denominator = V::select(denominator.is_negligible(0.0), V::splat(1.0), denominator);
    let t = numerator / denominator;
    let z = t * t;
    let p = z * polynomial!(V, z;
        -6.485_021_904_942_025_371_773e1, -1.228_866_684_490_136_173_410e2,
        -7.500_855_792_314_704_667_340e1, -1.615_753_718_733_365_076_637e1,
        -8.750_608_600_031_904_122_785e-1);
    let q = polynomial!(V, z;
        1.945_506_571_482_613_964_425e2, 4.853_903_996_359_136_964_868e2,
        4.328_810_604_912_902_668_951e2, 1.650_270_098_316_988_542_046e2,
        2.485_846_490_142_306_297_962e1, 1.0);
    let angle = t + t * (p / q);
    let angle = V::select(is_middle, angle + FRAC_PI_4, angle);
    let angle = V::select(is_steep, V::splat(FRAC_PI_2) - angle, angle);
    let angle = V::select(x.is_below(0.0), V::splat(PI) - angle, angle);
    angle.with_sign_of(y)
}

/// The functions, each compiled once for each kind of lanes: copies in each place are large.
pub mod compiled {
    use super::Plain;

    macro_rules! functions {
        ($($name:ident($($argument:ident),+) -> $result:ty),*) => {$(
            #[inline(never)]
            pub fn $name<V: Plain>($($argument: V),+) -> $result {
                super::$name($($argument),+)
            }
        )*};
    }
    functions!(sin_cos(x) -> (V, V), acos(y) -> V, exp(x) -> V, ln(x) -> V, atan2(y, x) -> V);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Difference in units of the last place of the exact result.
    fn ulps(found: f64, exact: f64) -> f64 {
        let ulp = f64::from_bits(exact.abs().to_bits() + 1) - exact.abs();
        (found - exact).abs() / ulp
    }

    /// The largest difference to `libm`, which is within 1 ulp itself, over many arguments.
    fn largest(range: (f64, f64), found: fn(f64) -> f64, exact: fn(f64) -> f64) -> f64 {
        let count = 200_000;
        (0..=count)
            .map(|i| range.0 + (range.1 - range.0) * f64::from(i) / f64::from(count))
            .map(|x| ulps(found(x), exact(x)))
            .fold(0.0, f64::max)
    }

    #[test]
    fn functions_are_within_2_ulp() {
        let sin: fn(f64) -> f64 = |x| sin_cos(x).0;
        let cos: fn(f64) -> f64 = |x| sin_cos(x).1;
        let below: fn(f64) -> f64 = |x| atan2(x, -1.7);
        let above: fn(f64) -> f64 = |x| atan2(2.0, x);
        type Function = fn(f64) -> f64;
        let cases: [(&str, (f64, f64), Function, Function); 12] = [
            ("sin", (-10.0, 10.0), sin, libm::sin),
            ("cos", (-10.0, 10.0), cos, libm::cos),
            ("sin", (-1e5, 1e5), sin, libm::sin),
            ("cos", (-1e5, 1e5), cos, libm::cos),
            ("acos", (-1.0, 1.0), acos, libm::acos),
            ("acos", (0.999_999, 1.0), acos, libm::acos),
            ("exp", (-708.0, 709.0), exp, libm::exp),
            ("exp", (-1.0, 1.0), exp, libm::exp),
            ("ln", (1e-6, 2.0), ln, libm::log),
            ("ln", (1.0, 1e10), ln, libm::log),
            ("atan2", (-30.0, 30.0), below, |x| libm::atan2(x, -1.7)),
            ("atan2", (-30.0, 30.0), above, |x| libm::atan2(2.0, x)),
        ];
        for (name, range, found, exact) in cases {
            let error = largest(range, found, exact);
            assert!(error <= 2.0, "{name} from {range:?}: {error} ulp");
        }
    }

    #[test]
    fn ends_and_special_numbers_are_those_of_libm() {
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        assert_eq!(sin_cos(3e5), (libm::sin(3e5), libm::cos(3e5)));
        assert!(sin_cos(f64::NAN).0.is_nan() && sin_cos(f64::INFINITY).1.is_nan());
        assert_eq!((acos(1.0), acos(-1.0), acos(0.0)), (0.0, PI, FRAC_PI_2));
        assert!(acos(1.1).is_nan() && acos(f64::NAN).is_nan());
        assert_eq!((exp(0.0), exp(-1e4), exp(1e4)), (1.0, 0.0, exp(709.0)));
        assert!(exp(f64::NAN).is_nan());
        assert_eq!(
            (ln(1.0), ln(0.0), ln(f64::INFINITY)),
            (0.0, f64::NEG_INFINITY, f64::INFINITY)
        );
        assert!(ln(-1.0).is_nan() && ln(f64::NAN).is_nan());
        assert_eq!(ln(1e-310), libm::log(1e-310));
        assert_eq!(atan2(0.0, 0.0), 0.0);
        assert_eq!((atan2(0.0, -1.0), atan2(-0.0, -1.0)), (PI, -PI));
        assert_eq!((atan2(1.0, 0.0), atan2(-1.0, 0.0)), (FRAC_PI_2, -FRAC_PI_2));
        assert!(atan2(f64::NAN, 1.0).is_nan());
    }
}

//! Air: the standard atmosphere, or given values; viscosity and speed of sound.

use super::numbers::{C, Scalar};

/// Specific gas constant of air, J/(kg K) (ISO 2533:1975).
const GAS_CONSTANT: f64 = 287.052_87;

/// Ratio of specific heats of air (ISO 2533:1975).
const HEAT_RATIO: f64 = 1.4;

/// Acceleration of gravity, m/s2 (ISO 2533:1975).
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// The state of the air around the rotor. SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Air<S = f64> {
    /// Density, kg/m3.
    pub density: S,
    /// Speed of sound, m/s.
    pub speed_of_sound: S,
    /// Dynamic viscosity, Pa s.
    pub viscosity: S,
}

impl<S: Scalar> Air<S> {
    /// The air with `function` applied to each of its numbers.
    pub fn map<T: Scalar>(&self, function: impl Fn(S) -> T) -> Air<T> {
        Air {
            density: function(self.density),
            speed_of_sound: function(self.speed_of_sound),
            viscosity: function(self.viscosity),
        }
    }

    /// Air of a given density (kg/m3, > 0) and temperature (K, > 0).
    ///
    /// The speed of sound is that of the ideal gas, sqrt(gamma R T). The viscosity follows
    /// Sutherland's law with the constants of ISO 2533:1975, eq. (22):
    /// mu = 1.458e-6 T^1.5/(T + 110.4).
    pub fn new(density: S, temperature: S) -> Self {
        Self {
            density,
            speed_of_sound: (C(HEAT_RATIO * GAS_CONSTANT) * temperature).sqrt(),
            viscosity: C(1.458e-6) * temperature * temperature.sqrt() / (temperature + 110.4),
        }
    }

    /// International Standard Atmosphere (ISO 2533:1975) at a geometric altitude above mean sea
    /// level, -2,000 to 20,000 m.
    ///
    /// Up to a geopotential altitude of 11 km the temperature falls by 6.5 K/km; above, it is
    /// constant.
    pub fn standard(altitude: S) -> Self {
        const EARTH_RADIUS: f64 = 6_356_766.0;
        const SEA_LEVEL_TEMPERATURE: f64 = 288.15;
        const SEA_LEVEL_PRESSURE: f64 = 101_325.0;
        const LAPSE_RATE: f64 = 0.0065;
        const TROPOPAUSE: f64 = 11_000.0;

        let geopotential = C(EARTH_RADIUS) * altitude / (C(EARTH_RADIUS) + altitude);
        let below = geopotential.at_most(TROPOPAUSE);
        let temperature = C(SEA_LEVEL_TEMPERATURE) - C(LAPSE_RATE) * below;
        let exponent = STANDARD_GRAVITY / (GAS_CONSTANT * LAPSE_RATE);
        let mut pressure =
            C(SEA_LEVEL_PRESSURE) * (temperature / SEA_LEVEL_TEMPERATURE).power(exponent);
        if geopotential.is_above(TROPOPAUSE) {
            let scale_height = C(GAS_CONSTANT) * temperature / STANDARD_GRAVITY;
            pressure *= ((C(TROPOPAUSE) - geopotential) / scale_height).exp();
        }
        Self::new(pressure / (C(GAS_CONSTANT) * temperature), temperature)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ISO 2533:1975, table of the standard atmosphere by geopotential altitude.
    #[test]
    fn standard_atmosphere_matches_the_published_table() {
        for (geopotential, density, speed_of_sound) in [
            (-2000.0, 1.4782, 347.89),
            (0.0, 1.2250, 340.29),
            (5000.0, 0.736_12, 320.53),
            (11_000.0, 0.36392, 295.07),
            (15_000.0, 0.19367, 295.07),
            (20_000.0, 0.088_035, 295.07),
        ] {
            let geometric = 6_356_766.0 * geopotential / (6_356_766.0 - geopotential);
            let air = Air::standard(geometric);
            assert!(
                (air.density / density - 1.0).abs() < 1e-4,
                "{geopotential} m: {air:?}"
            );
            assert!(
                (air.speed_of_sound - speed_of_sound).abs() < 0.01,
                "{geopotential} m: {air:?}"
            );
        }
        // Table value of the viscosity at sea level.
        assert!((Air::standard(0.0).viscosity / 1.7894e-5 - 1.0).abs() < 1e-4);
    }
}

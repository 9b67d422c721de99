//! The generalised dynamic wake: Peters, Boyd & He 1989 (J. Am. Helicopter Soc. 34(4), p. 5), He
//! 1989 (thesis, Georgia Tech) and Peters & He 1991 (J. Am. Helicopter Soc. 36(3), p. 59).
//! Equations are numbered as in the freely available Moriarty & Hansen 2005, NREL/TP-500-36881.
//!
//! The induced velocity (60), positive down, with x = r/R and psi from downwind,
//!
//! ```text
//! v(x, psi) = sum over m, j of phi_j^m(x) (alpha_j^m cos m psi + beta_j^m sin m psi),
//! j = m+1, m+3, ...
//! ```
//!
//! follows the loading tau by (68) to (73)
//!
//! ```text
//! R K dalpha/dt + V Lc^-1 alpha = tau_c/2      R K dbeta/dt + V Ls^-1 beta = tau_s/2
//! ```
//!
//! This is the usual form times (Omega R)^2, so that a rotor at standstill is no special case. The
//! functions are phi = P/nu, nu = sqrt(1 - x^2), with the normalised Legendre functions P. They are
//! orthogonal with the weight x nu.
//!
//! L follows from the steady linear equations in a few lines. The Fourier transform over the plane
//! of the disc of V dw/ds = -grad p/rho is
//!
//! ```text
//! v(k) = p(k)/(2 rho V) / (cos chi + i sin chi cos phi),   k in the direction phi from downwind
//! 1/(cos chi + i sin chi cos phi) = 1 + 2 sum over n > 0 of (-i X)^n cos n phi,   X = tan(chi/2)
//! ```
//!
//! so that harmonic m of the pressure makes harmonic r of the velocity by X^|m-r| +- X^(m+r). Gamma
//! (79) to (81) is the integral over k of the product of the Hankel transforms. Its factor
//! i^r (-i)^m (-i)^|m-r| is 1 for r >= m and (-1)^(r+m) for r < m. Hence Gamma is antisymmetric
//! between harmonics of unlike parity, Pitt & Peters' 15 pi/64 among them.
//!
//! The order of V and L^-1 is that of Peters & HaQuang 1988. Only the first pressure carries
//! thrust, and V divides the pressures. So the whole thrust is 2 rho A VT v, with VT of the mean
//! velocity v, in a steady state with enough functions. With few functions the mean is too large at
//! the same VT. Under a uniform loading it is too large by 12.5 % with one function of the mean
//! (order 1), 5.0 % with two (orders 2, 3), 2.7 % with three (4, 5) and 1.7 % with four (6); under
//! a loading like nu by 12.5, 1.6, 0.5 and 0.2 %.
//!
//! The power p v that the disc puts into its wake is never negative: with L scaled so that its
//! parts of like parity are symmetric, L + L^T has no negative eigenvalue, and no zero eigenvalue
//! for X < 1. So L has an inverse and all modes decay. In edgewise flow, X = 1, some eigenvalues of
//! L + L^T are zero, but the odd parts of L give it an inverse there too: from X = 0 to 1 the
//! condition number of Lc grows from 1.2 ... 3.3 to 3.3, 9.6, 13, 27, 29, 47 for orders 1 ... 6. X
//! needs no limit.

use super::{descent::MassFlow, dynamic::Stream};
use crate::{
    induced::Field,
    numbers::{C, LANES, Lanes, Plain, Scalar},
};
use core::f64::consts::PI;

/// Maximum power of the radius.
pub const MAX_ORDER: usize = 6;
/// Maximum harmonic of the azimuth.
pub const MAX_HARMONICS: usize = 4;
/// Number of states at the maximum order.
pub const MAX_STATES: usize = 24;
/// Number of cosines among them.
const MAX_COSINES: usize = 14;

type Matrix<S = f64> = [[S; MAX_COSINES]; MAX_COSINES];

/// cos(m psi) and sin(m psi), m from 0 to `MAX_HARMONICS`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonics<S = f64> {
    /// cos(m psi).
    pub cos: [S; MAX_HARMONICS + 1],
    /// sin(m psi).
    pub sin: [S; MAX_HARMONICS + 1],
}

/// The wake of a rotor up to a power of the radius.
///
/// Its states, m/s, are first the alpha and then the beta, each by m and then by j. The first is
/// alpha_1^0, a uniform velocity of sqrt(3) times its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Wake {
    order: usize,
    /// (m, j) of the cosines.
    indices: Vec<(usize, usize)>,
    /// Number of the cosines with m = 0, which have no sines.
    axial: usize,
    /// phi at blocks of blade elements, function by function in each block. The last block repeats
    /// the last element.
    radial: Vec<[f64; LANES]>,
    /// K of the cosines.
    mass: [f64; MAX_COSINES],
    /// Mean over the disc of the cosines with m = 0.
    means: [f64; MAX_COSINES],
    /// Gamma, rows (r, j), columns (m, n).
    coupling: Matrix,
}

/// Bounds of the eigenvalues of the equations, for one order.
struct Bounds {
    /// Largest 2-norm of K^-1/2 L^-1 K^-1/2 at all X, L scaled as described at the top of this
    /// file.
    wake: f64,
    /// Largest eigenvalue of K^-1 times the integral of phi phi x dx over 4, the blades' speed
    /// being x times that of the tip, and the same without x for the edgewise flow.
    turning: f64,
    edgewise: f64,
    /// Traces of the same two.
    turning_trace: f64,
    edgewise_trace: f64,
}

/// Computed as `Bounds` says, with all harmonics, and rounded up. With fewer harmonics `wake` is up
/// to 3 % larger, which the margin of the steps in time covers.
const BOUNDS: [Bounds; MAX_ORDER] = [
    bounds([5.07, 1.11, 1.48, 2.80, 4.13]),
    bounds([11.32, 1.90, 3.70, 7.83, 11.60]),
    bounds([14.82, 2.71, 3.70, 16.98, 23.48]),
    bounds([25.48, 3.82, 6.94, 31.63, 43.70]),
    bounds([29.23, 4.96, 6.94, 47.01, 64.50]),
    bounds([44.96, 6.41, 11.20, 69.83, 96.74]),
];

const fn bounds(by_column: [f64; 5]) -> Bounds {
    let [wake, turning, edgewise, turning_trace, edgewise_trace] = by_column;
    Bounds {
        wake,
        turning,
        edgewise,
        turning_trace,
        edgewise_trace,
    }
}

/// The parameters of the flow through the rotor: VT, Vm, m/s, and X.
struct Flow<S> {
    total: S,
    changes: S,
    skew: S,
}

impl Wake {
    /// With all harmonics up to the fourth: 3, 6, 10, 15, 19, 24 states for orders 1 to 6.
    ///
    /// * `order`: highest power of the radius, 1 to 6; others are taken as the nearest
    /// * `radius_ratios`: r/R of the middles of the blade elements, above 0 and below 1
    pub fn new(order: usize, radius_ratios: &[f64]) -> Self {
        Self::with_harmonics(order, MAX_HARMONICS, radius_ratios)
    }

    /// With fewer harmonics than the rotor has blades, at least the mean.
    ///
    /// Blades carry a load that turns with them, and its harmonics N, 2 N ... remain in the sum
    /// over N blades even in hover. There the blades would sit in a wave of downwash of their own.
    /// That is the wake between the blades, which tip losses stand for.
    pub fn of_blades(order: usize, blades: usize, radius_ratios: &[f64]) -> Self {
        Self::with_harmonics(order, blades.saturating_sub(1), radius_ratios)
    }

    fn with_harmonics(order: usize, harmonics: usize, radius_ratios: &[f64]) -> Self {
        let order = order.clamp(1, MAX_ORDER);
        let harmonics = 0..=order.min(MAX_HARMONICS).min(harmonics);
        let indices: Vec<_> = harmonics
            .flat_map(|m| (m + 1..=order + 1).step_by(2).map(move |j| (m, j)))
            .collect();
        let phi = |m: usize, j: usize, x: f64| {
            let mut power = (0..m).fold(1.0, |power, _| power * x);
            let mut sum = 0.0;
            for coefficient in phi_coefficients(m, j) {
                sum += coefficient * power;
                power *= x * x;
            }
            sum
        };
        let mut radial = Vec::new();
        for block in radius_ratios.chunks(LANES) {
            let x = |lane: usize| block[lane.min(block.len() - 1)];
            for (m, j) in &indices {
                radial.push(core::array::from_fn(|lane| phi(*m, *j, x(lane))));
            }
        }
        let axial = indices.iter().filter(|(m, _)| *m == 0).count();
        let mut mass = [0.0; MAX_COSINES];
        let mut means = [0.0; MAX_COSINES];
        let mut coupling = [[0.0; MAX_COSINES]; MAX_COSINES];
        for (i, (m, j)) in indices.iter().enumerate() {
            mass[i] = 2.0 / PI * h(*m, *j); // (71)
            for (k, (m, n)) in indices.iter().enumerate() {
                let (r, j) = indices[i];
                coupling[i][k] = gamma(r, *m, j, *n);
            }
        }
        // 2 integral of phi x dx.
        for (mean, (m, j)) in means.iter_mut().zip(&indices[..axial]) {
            *mean = phi_coefficients(*m, *j)
                .enumerate()
                .map(|(i, coefficient)| coefficient / (i + 1) as f64)
                .sum();
        }
        Self {
            order,
            indices,
            axial,
            radial,
            mass,
            means,
            coupling,
        }
    }

    /// Number of states.
    pub fn len(&self) -> usize {
        2 * self.indices.len() - self.axial
    }

    /// Always false: the smallest wake has one state.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Harmonics of the azimuth with the cosine `cos` and the sine `sin`. With both zero, which
    /// stands for all azimuths of an axially symmetric disc, only m = 0 is left.
    pub fn harmonics<S: Scalar>(cos: S, sin: S) -> Harmonics<S> {
        let mut all = Harmonics {
            cos: [S::one(); MAX_HARMONICS + 1],
            sin: [S::zero(); MAX_HARMONICS + 1],
        };
        for m in 0..MAX_HARMONICS {
            all.cos[m + 1] = all.cos[m] * cos - all.sin[m] * sin;
            all.sin[m + 1] = all.sin[m] * cos + all.cos[m] * sin;
        }
        all
    }

    /// The velocity induced at a block of blade elements, positive down, m/s.
    ///
    /// * `states`: `len()` or more, m/s
    /// * `block`: of four neighbouring radius ratios, by its index
    #[inline(always)]
    pub fn velocity<L: Lanes>(
        &self,
        states: &[L::One],
        block: usize,
        harmonics: &Harmonics<L::One>,
    ) -> L {
        let (axial, radial) = self.radial_at(block).split_at(self.axial);
        let (means, others) = states.split_at(self.axial);
        let (cosines, sines) = others.split_at(radial.len());
        let mut velocity = L::nil();
        for (phi, state) in axial.iter().zip(means) {
            velocity += L::splat(*state).times(L::Real::load(phi));
        }
        let indices = &self.indices[self.axial..];
        for (((phi, cosine), sine), (m, _)) in radial.iter().zip(cosines).zip(sines).zip(indices) {
            let wave = *cosine * harmonics.cos[*m] + *sine * harmonics.sin[*m];
            velocity += L::splat(wave).times(L::Real::load(phi));
        }
        velocity
    }

    /// Adds the loads of a block of blade elements at an azimuth to the loading tau, m2/s2; (92) to
    /// (94).
    ///
    /// * `force`: thrust of each element over rho R^2, m2/s2; where the loads are averaged over the
    ///   azimuth, its share of the mean
    #[inline(always)]
    pub fn add_load<L: Lanes>(
        &self,
        loading: &mut [L],
        block: usize,
        harmonics: &Harmonics<L::One>,
        force: L,
    ) {
        let (axial, radial) = self.radial_at(block).split_at(self.axial);
        let (means, others) = loading.split_at_mut(self.axial);
        let (cosines, sines) = others.split_at_mut(radial.len());
        let force = force / PI;
        for (tau, phi) in means.iter_mut().zip(axial) {
            *tau += (C(0.5) * force).times(L::Real::load(phi));
        }
        let indices = &self.indices[self.axial..];
        for (((phi, cosine), sine), (m, _)) in radial.iter().zip(cosines).zip(sines).zip(indices) {
            let part = force.times(L::Real::load(phi));
            *cosine += part * L::splat(harmonics.cos[*m]);
            *sine += part * L::splat(harmonics.sin[*m]);
        }
    }

    /// Rates of change of the states, m/s2, under a loading tau, m2/s2. Each slice has `len()`
    /// entries or more.
    pub fn rate<S: Scalar>(
        &self,
        states: &[S],
        loading: &[S],
        stream: &Stream<S>,
        rates: &mut [S],
    ) {
        let (states, loading) = (&states[..self.len()], &loading[..self.len()]);
        let flow = self.flow(states, stream);
        let cosines = self.indices.len();
        let mut pressures = [S::zero(); MAX_STATES];
        pressures[..states.len()].copy_from_slice(states);
        if flow.total.is_above(0.0) {
            let (of_cosines, of_sines) = pressures.split_at_mut(cosines);
            solve(&mut self.gains(flow.skew, 0), &mut of_cosines[..cosines]);
            let sines = cosines - self.axial;
            solve(
                &mut self.gains(flow.skew, self.axial),
                &mut of_sines[..sines],
            );
        }
        let masses = self.mass[..cosines]
            .iter()
            .chain(&self.mass[self.axial..cosines]);
        for (i, (rate, mass)) in rates.iter_mut().zip(masses).enumerate() {
            let speed = if i == 0 { flow.total } else { flow.changes }; // (84), (85)
            *rate = (C(0.5) * loading[i] - speed * pressures[i]) / (*mass * stream.radius);
        }
    }

    /// The same field or loading in axes turned by an angle about the shaft, psi' = psi - angle, in
    /// the sense of `WindAxes::into_wind`. The cosine and sine are those of the angle; -sin
    /// turns back.
    pub fn rotated<S: Scalar>(&self, states: &[S], cos: S, sin: S) -> [S; MAX_STATES] {
        let turn = Self::harmonics(cos, sin);
        let cosines = self.indices.len();
        let mut turned = [S::zero(); MAX_STATES];
        turned[..self.axial].copy_from_slice(&states[..self.axial]);
        for (i, (m, _)) in self.indices.iter().enumerate().skip(self.axial) {
            let k = i + cosines - self.axial;
            turned[i] = states[i] * turn.cos[*m] + states[k] * turn.sin[*m];
            turned[k] = states[k] * turn.cos[*m] - states[i] * turn.sin[*m];
        }
        turned
    }

    /// A bound on the rates of the modes, 1/s, for steps in time: what the wake carries away, and
    /// the damping by blades with a lift slope of 2 pi.
    ///
    /// * `solidity`: N c/(pi R)
    /// * `tip_speed`: >= 0, m/s
    /// * `is_blades`: whether the blades act one by one, in any number and at any azimuth; else
    ///   their loads are averaged over the azimuth
    pub fn fastest_rate(
        &self,
        states: &[f64],
        solidity: f64,
        tip_speed: f64,
        stream: &Stream,
        is_blades: bool,
    ) -> f64 {
        let bounds = &BOUNDS[self.order - 1];
        let (turning, edgewise) = if is_blades {
            (bounds.turning_trace, bounds.edgewise_trace)
        } else {
            (bounds.turning, bounds.edgewise)
        };
        let blades = solidity * (turning * tip_speed + edgewise * stream.edgewise);
        let flow = self.flow(states, stream);
        // V changes with the states as well, which matters where V nearly vanishes.
        let carried = flow.total.max(flow.changes) + 2.0 * self.mean(states).abs();
        (bounds.wake * carried + 2.0 * PI * blades) / stream.radius
    }

    /// Mean of v over the disc, m/s.
    pub fn mean<S: Scalar>(&self, states: &[S]) -> S {
        let means = &self.means[..self.axial];
        means.iter().zip(states).map(|(mean, x)| *x * *mean).sum()
    }

    /// Mean of v around the annuli of a block of blade elements, m/s.
    #[inline(always)]
    pub fn mean_at<L: Lanes>(&self, states: &[L::One], block: usize) -> L {
        let mut mean = L::nil();
        for (phi, state) in self.radial_at(block).iter().take(self.axial).zip(states) {
            mean += L::splat(*state).times(L::Real::load(phi));
        }
        mean
    }

    /// Whether all azimuths are alike: each state of a harmonic m > 0 is at most `limit`, m/s.
    pub fn is_axisymmetric<S: Scalar>(&self, states: &[S], limit: f64) -> bool {
        let others = states.iter().take(self.len()).skip(self.axial);
        others.into_iter().all(|state| state.is_negligible(limit))
    }

    /// The states of a field close to a linear one: the same mean, and the first functions for its
    /// slopes.
    pub fn like(&self, field: &Field) -> [f64; MAX_STATES] {
        let mut states = [0.0; MAX_STATES];
        states[0] = field.mean / self.means[0];
        if self.len() == self.axial {
            return states;
        }
        let slope = libm::sqrt(7.5); // phi_2^1 at the tip
        states[self.axial] = field.cosine / slope;
        states[self.indices.len()] = field.sine / slope;
        states
    }

    fn radial_at(&self, block: usize) -> &[[f64; LANES]] {
        let count = self.indices.len();
        &self.radial[block * count..(block + 1) * count]
    }

    /// (78), (86), (87), with the mean over the disc for the induced velocity.
    fn flow<S: Scalar>(&self, states: &[S], stream: &Stream<S>) -> Flow<S> {
        let induced = self.mean(states);
        let MassFlow { speed, slope } = stream.mass_flow(induced);
        Flow {
            total: speed,
            changes: slope,
            skew: stream.skew(induced),
        }
    }

    /// L: (74) and (75) of all cosines, or (76) of the sines, where `first` leaves m = 0 out.
    fn gains<S: Scalar>(&self, skew: S, first: usize) -> Matrix<S> {
        let sign = if first == 0 { 1.0 } else { -1.0 };
        let mut powers = [S::one(); 2 * MAX_HARMONICS + 1];
        for m in 1..powers.len() {
            powers[m] = powers[m - 1] * skew;
        }
        let mut factors = [[S::zero(); MAX_HARMONICS + 1]; MAX_HARMONICS + 1];
        for (r, row) in factors.iter_mut().enumerate() {
            for (m, factor) in row.iter_mut().enumerate() {
                let sign = if r.min(m).is_multiple_of(2) {
                    sign
                } else {
                    -sign
                };
                *factor = match r {
                    0 => powers[m],
                    _ => powers[m.abs_diff(r)] + C(sign) * powers[m + r],
                };
            }
        }
        let mut gains = [[S::zero(); MAX_COSINES]; MAX_COSINES];
        let indices = &self.indices[first..];
        for (i, (r, _)) in indices.iter().enumerate() {
            for (k, (m, _)) in indices.iter().enumerate() {
                gains[i][k] = factors[*r][*m] * self.coupling[first + i][first + k];
            }
        }
        gains
    }
}

/// n!!, which is 1 for n <= 0; (63).
fn double_factorial(n: usize) -> f64 {
    (1..=n).rev().step_by(2).map(|x| x as f64).product()
}

/// H_n^m, n > m; (62).
fn h(m: usize, n: usize) -> f64 {
    double_factorial(n + m - 1) * double_factorial(n - m - 1)
        / (double_factorial(n + m) * double_factorial(n - m))
}

/// The coefficients of x^m, x^(m+2), ... x^(j-1) in phi_j^m; (61).
fn phi_coefficients(m: usize, j: usize) -> impl Iterator<Item = f64> {
    let norm = libm::sqrt((2 * j + 1) as f64 * h(m, j));
    (m..j).step_by(2).map(move |q| {
        let sign = if (q - m).is_multiple_of(4) {
            norm
        } else {
            -norm
        };
        sign * double_factorial(j + q)
            / (double_factorial(q - m) * double_factorial(q + m) * double_factorial(j - q - 1))
    })
}

/// Gamma_jn^rm; (79) to (81). The text prints (j + n)^2 - 1 in (79), but it must be (j - n)^2 - 1:
/// for r = m Gamma is the integral of phi_j phi_n (1 - x^2) x dx.
fn gamma(r: usize, m: usize, j: usize, n: usize) -> f64 {
    let scale = 1.0 / libm::sqrt(h(m, n) * h(r, j));
    let degrees = libm::sqrt(((2 * n + 1) * (2 * j + 1)) as f64);
    if (r + m).is_multiple_of(2) {
        let difference = j.abs_diff(n) as f64;
        // The text's n + j - 2 r can be negative; n + j + 2 r gives the power the same sign.
        let sign = if (n + j + 2 * r).is_multiple_of(4) {
            1.0
        } else {
            -1.0
        };
        let sum = (j + n) as f64;
        sign * scale * 2.0 * degrees / (sum * (sum + 2.0) * (difference * difference - 1.0))
    } else if j.abs_diff(n) == 1 {
        let sign = if r > m { 1.0 } else { -1.0 };
        sign * scale * PI / (2.0 * degrees)
    } else {
        0.0
    }
}

/// Replaces the right side by the solution: Gaussian elimination with row exchanges (Golub & Van
/// Loan 2013, algorithm 3.4.1).
fn solve<S: Scalar>(matrix: &mut Matrix<S>, right: &mut [S]) {
    let size = right.len();
    for i in 0..size {
        let mut pivot = i;
        for k in i + 1..size {
            if matrix[k][i].value().abs() > matrix[pivot][i].value().abs() {
                pivot = k;
            }
        }
        matrix.swap(i, pivot);
        right.swap(i, pivot);
        let row = matrix[i];
        let inverse = C(1.0) / row[i];
        for k in i + 1..size {
            let factor = matrix[k][i] * inverse;
            if factor.is_negligible(0.0) {
                continue; // Gamma is sparse
            }
            for (entry, above) in matrix[k][i + 1..size].iter_mut().zip(&row[i + 1..size]) {
                *entry -= factor * *above;
            }
            let above = right[i];
            right[k] -= factor * above;
        }
    }
    for i in (0..size).rev() {
        let mut sum = right[i];
        for k in i + 1..size {
            sum -= matrix[i][k] * right[k];
        }
        right[i] = sum / matrix[i][i];
    }
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)] // the expectations are independent of libm
mod tests;

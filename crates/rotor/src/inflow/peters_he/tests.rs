//! The dynamic wake against its own theory, momentum theory and Pitt & Peters.

use super::super::pitt_peters::{self, Loading};
use super::*;
use crate::disc::WindAxes;
use crate::inflow::Descent;
use crate::numbers::Portable;
use nalgebra::DMatrix;

const SKEWS: [f64; 5] = [0.0, 0.3, 0.7, 0.95, 1.0];

/// The integral over x from 0 to 1, by Simpson's rule in the angle of x = sin.
fn integral(of: impl Fn(f64) -> f64) -> f64 {
    let intervals = 240;
    let step = PI / 2.0 / intervals as f64;
    let at = |i: usize| {
        let angle = i as f64 * step;
        let weight = match i {
            0 => 1.0,
            _ if i == intervals => 1.0,
            _ if i % 2 == 1 => 4.0,
            _ => 2.0,
        };
        weight * of(angle.sin()) * angle.cos()
    };
    (0..=intervals).map(at).sum::<f64>() * step / 3.0
}

/// The velocity induced at one element, m/s.
fn velocity(wake: &Wake, states: &[f64], element: usize, harmonics: &Harmonics) -> f64 {
    let block = wake.velocity::<Portable>(states, element / LANES, harmonics);
    block.lane(element % LANES)
}

/// Adds the load of one element.
fn add_load(wake: &Wake, loading: &mut [f64], element: usize, harmonics: &Harmonics, force: f64) {
    let mut block = [Portable::nil(); MAX_STATES];
    let in_lane = |lane: usize| if lane == element % LANES { force } else { 0.0 };
    let force = Portable::from_lanes(in_lane);
    wake.add_load(&mut block, element / LANES, harmonics, force);
    for (sum, added) in loading.iter_mut().zip(block) {
        *sum += added.sum_of_lanes();
    }
}

fn phi(m: usize, j: usize, x: f64) -> f64 {
    let power = |i: usize| x.powi((m + 2 * i) as i32);
    let coefficients = phi_coefficients(m, j).enumerate();
    coefficients.map(|(i, c)| c * power(i)).sum()
}

fn nu(x: f64) -> f64 {
    (1.0 - x * x).max(0.0).sqrt()
}

/// The loading tau of an axially symmetrical pressure over rho.
fn axial_loading(wake: &Wake, pressure: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut loading = vec![0.0; wake.len()];
    for (tau, (m, j)) in loading.iter_mut().zip(&wake.indices[..wake.axial]) {
        *tau = integral(|x| pressure(x) * phi(*m, *j, x) * x);
    }
    loading
}

fn matrix(wake: &Wake, skew: f64, first: usize) -> DMatrix<f64> {
    let size = wake.indices.len() - first;
    let gains = wake.gains(skew, first);
    DMatrix::from_fn(size, size, |i, k| gains[i][k])
}

/// With the even parts symmetric.
fn balanced(wake: &Wake, skew: f64, first: usize) -> DMatrix<f64> {
    let scale = |i: usize| {
        if first + i < wake.axial {
            2.0_f64.sqrt()
        } else {
            1.0
        }
    };
    let gains = matrix(wake, skew, first);
    DMatrix::from_fn(gains.nrows(), gains.ncols(), |i, k| {
        gains[(i, k)] * scale(i) / scale(k)
    })
}

fn stream(edgewise: f64, climb: f64, radius: f64) -> Stream {
    Stream {
        edgewise,
        climb,
        radius,
        descent: Descent::Momentum.unstretched(),
    }
}

/// The states, as small as `size`, that `loading` (times `size`) holds in a flow that they do not
/// change: L tau/(2 V).
fn steady(wake: &Wake, loading: &[f64], skew: f64, speed: f64) -> Vec<f64> {
    let cosines = wake.indices.len();
    let mut states = vec![0.0; wake.len()];
    for first in [0, wake.axial] {
        let gains = matrix(wake, skew, first);
        let from = if first == 0 { 0 } else { cosines };
        for i in 0..gains.nrows() {
            states[from + i] = (0..gains.ncols())
                .map(|k| gains[(i, k)] * loading[from + k] / (2.0 * speed))
                .sum();
        }
    }
    states
}

#[test]
fn numbers_of_states() {
    for (order, states) in (1..).zip([3, 6, 10, 15, 19, 24]) {
        assert_eq!(Wake::new(order, &[]).len(), states);
    }
    assert_eq!(Wake::new(9, &[]).len(), MAX_STATES);
}

/// Moriarty & Hansen 2005, eqs. (64) to (67), and the orthogonality that follows from (59).
#[test]
fn radial_functions_are_those_published_and_orthonormal() {
    for x in [0.0, 0.3, 0.8, 1.0] {
        let root = 7.0_f64.sqrt();
        let published = [
            (0, 1, 3.0_f64.sqrt()),
            (0, 3, root - 2.5 * root * x * x),
            (1, 2, 7.5_f64.sqrt() * x),
            (2, 3, 210.0_f64.sqrt() / 4.0 * x * x),
        ];
        for (m, j, expected) in published {
            assert!((phi(m, j, x) - expected).abs() < 1e-14, "{m} {j} {x}");
        }
    }
    for (m, j) in Wake::new(6, &[]).indices {
        for n in (m + 1..8).step_by(2) {
            let product = integral(|x| phi(m, j, x) * phi(m, n, x) * x * nu(x));
            let expected = if j == n { 1.0 } else { 0.0 };
            assert!((product - expected).abs() < 1e-6, "{m} {j} {n}: {product}");
        }
    }
}

/// In axial flow v = p/(2 rho V) everywhere, so that Gamma for r = m is the product of the
/// functions of pressure and velocity.
#[test]
fn gains_of_one_harmonic_are_momentum_theory_in_axial_flow() {
    for (m, j) in Wake::new(6, &[]).indices {
        for n in (m + 1..8).step_by(2) {
            let expected = integral(|x| phi(m, j, x) * phi(m, n, x) * (1.0 - x * x) * x);
            assert!((gamma(m, m, j, n) - expected).abs() < 1e-6, "{m} {j} {n}");
        }
    }
}

/// The derivation in the head of the file, with the integrals done by number: all signs and values.
#[test]
fn gains_between_harmonics_are_the_fourier_solution() {
    let indices = Wake::new(6, &[]).indices;
    let step = 0.15;
    let transform = |(m, j): &(usize, usize)| -> Vec<f64> {
        let at = |i: usize| {
            let k = i as f64 * step;
            integral(|x| nu(x) * phi(*m, *j, x) * libm::jn(*m as i32, k * x) * x)
        };
        (0..=800).map(at).collect()
    };
    let transforms: Vec<_> = indices.iter().map(transform).collect();
    for ((r, j), velocity) in indices.iter().zip(&transforms) {
        for ((m, n), pressure) in indices.iter().zip(&transforms) {
            let product = velocity.iter().zip(pressure).enumerate();
            let sum: f64 = product.map(|(i, (a, b))| a * b * i as f64 * step).sum();
            let sign = if r < m && (r + m) % 2 == 1 { -1.0 } else { 1.0 };
            let (found, expected) = (gamma(*r, *m, *j, *n), sign * sum * step);
            assert!(
                (found - expected).abs() < 2e-3,
                "{r} {m} {j} {n}: {found} {expected}"
            );
        }
    }
}

/// The other half of that derivation: the harmonics of 1/(cos chi + i sin chi cos phi), by number,
/// i^(r-m)/pi (for r = 0 by 2 pi) times its integral with cos r phi cos m phi, or with the sines.
#[test]
fn skew_couples_harmonics_as_the_fourier_solution_does() {
    let wake = Wake::new(6, &[]);
    let points = 400;
    for degrees in [0.0_f64, 25.0, 60.0, 80.0] {
        let (sin_chi, cos_chi) = degrees.to_radians().sin_cos();
        let skew = (degrees.to_radians() / 2.0).tan();
        let factor = |r: usize, m: usize, first: usize| {
            let at = |i: usize| {
                let phi = 2.0 * PI * i as f64 / points as f64;
                let along = sin_chi * phi.cos();
                let part = match (r + 4 - m) % 4 {
                    0 => cos_chi,
                    1 => along,
                    2 => -cos_chi,
                    _ => -along,
                };
                let (r, m) = (r as f64 * phi, m as f64 * phi);
                let harmonics = match first {
                    0 => r.cos() * m.cos(),
                    _ => r.sin() * m.sin(),
                };
                part / (cos_chi * cos_chi + along * along) * harmonics
            };
            let mean = (0..points).map(at).sum::<f64>() / points as f64;
            if r == 0 { mean } else { 2.0 * mean }
        };
        for first in [0, wake.axial] {
            let gains = matrix(&wake, skew, first);
            for (i, (r, j)) in wake.indices[first..].iter().enumerate() {
                for (k, (m, n)) in wake.indices[first..].iter().enumerate() {
                    let sign = if r < m && (r + m) % 2 == 1 { -1.0 } else { 1.0 };
                    let expected = factor(*r, *m, first) * sign * gamma(*r, *m, *j, *n);
                    assert!(
                        (gains[(i, k)] - expected).abs() < 1e-12,
                        "{degrees} {first}: {r} {m} {j} {n}"
                    );
                }
            }
        }
    }
}

/// He 1989: Gamma is symmetric between harmonics of like parity and antisymmetric between others.
#[test]
fn coupling_of_unlike_parity_is_antisymmetric() {
    let indices = Wake::new(6, &[]).indices;
    let mut coupled = 0;
    for (r, j) in &indices {
        for (m, n) in &indices {
            let sign = if (r + m) % 2 == 1 { -1.0 } else { 1.0 };
            assert_eq!(gamma(*r, *m, *j, *n), sign * gamma(*m, *r, *n, *j));
            coupled += usize::from((r + m) % 2 == 1 && gamma(*r, *m, *j, *n) != 0.0);
        }
    }
    assert!(coupled > 40);
}

/// The steady gains of three states, as velocities at the tip by (T, moments)/(rho A V), are those
/// of Pitt & Peters 1981 times 9/8, 8/5 and 75/64. They solve the same equations with fewer
/// functions: here thrust and moments come as pressures like nu and x nu, and the velocities that
/// these make (also like nu and x nu in axial flow) are projected on 1 and x with the weight x nu.
/// Pitt & Peters take the thrust as a pressure with two functions and get 15 pi/64, as order 2 does
/// in the next test.
#[test]
fn three_states_against_pitt_and_peters() {
    let wake = Wake::new(1, &[]);
    let (mean, slope) = (3.0_f64.sqrt(), 7.5_f64.sqrt());
    // tau_1^0 = sqrt(3)/2 T/(rho A), tau_2^1 = sqrt(15/2) M/(rho A).
    let load = [mean / 2.0, slope];
    for degrees in [0.0_f64, 20.0, 50.0, 85.0] {
        let skew = (degrees.to_radians() / 2.0).tan();
        let gains = matrix(&wake, skew, 0);
        let gain = |i: usize, k: usize| [mean, slope][i] * gains[(i, k)] * load[k] / 2.0;
        let coupling = 15.0 * PI / 64.0 * skew * 8.0 / 5.0;
        let along = 2.0 * (1.0 - skew * skew) * 75.0 / 64.0;
        let across = 2.0 * (1.0 + skew * skew) * 75.0 / 64.0;
        let sine = slope * matrix(&wake, skew, 1)[(0, 0)] * load[1] / 2.0;
        for (found, expected) in [
            (gain(0, 0), 0.5 * 9.0 / 8.0),
            (gain(0, 1), -coupling),
            (gain(1, 0), coupling),
            (gain(1, 1), along),
            (sine, across),
        ] {
            assert!(
                (found - expected).abs() < 1e-12,
                "{degrees}: {found} {expected}"
            );
        }
    }
}

/// A uniform pressure makes the slope 15 pi/64 tan(chi/2) p/(rho V) of Pitt & Peters 1981, and the
/// rates vanish there.
#[test]
fn uniform_pressure_in_forward_flight_has_the_slope_of_pitt_and_peters() {
    let wake = Wake::new(2, &[]);
    let loading: Vec<_> = axial_loading(&wake, |_| 1e-9);
    for (edgewise, climb) in [(0.0, 5.0), (3.0, 4.0), (12.0, 5.0), (10.0, 0.0)] {
        let speed = f64::hypot(edgewise, climb);
        let skew = edgewise / (speed + climb);
        let states = steady(&wake, &loading, skew, speed);
        let slope = 7.5_f64.sqrt() * states[2] * speed / 1e-9;
        assert_eq!(wake.indices[2], (1, 2));
        assert!((slope - 15.0 * PI / 64.0 * skew).abs() < 1e-7, "{slope}");
        let mut rates = [0.0; 6];
        wake.rate(&states, &loading, &stream(edgewise, climb, 2.0), &mut rates);
        for rate in rates {
            assert!(rate.abs() < 1e-16, "{edgewise}: {rates:?}");
        }
    }
}

/// The excess of the mean over momentum theory that the head of the file states, p/(2 rho V).
#[test]
fn mean_in_axial_flow_goes_to_momentum_theory() {
    let stated = [
        [0.125, 0.125],
        [0.0498, 0.0156],
        [0.0498, 0.0156],
        [0.0273, 0.0049],
        [0.0273, 0.0049],
        [0.0175, 0.0021],
    ];
    for (order, [uniform, rounded]) in (1..).zip(stated) {
        let wake = Wake::new(order, &[]);
        let excess = |loading: &[f64]| wake.mean(&steady(&wake, loading, 0.0, 0.5)) - 1.0;
        let found = excess(&axial_loading(&wake, |_| 1.0));
        assert!((found - uniform).abs() < 1e-4, "{order}: {found}");
        let found = excess(&axial_loading(&wake, |x| 1.5 * nu(x)));
        assert!((found - rounded).abs() < 1e-4, "{order}: {found}");
    }
}

/// Uniformly loaded in hover the disc as a whole keeps to T = 2 rho A v^2 although VT = v for the
/// first pressure and V = 2 v for the others. Half of what is not like nu is then left, so that the
/// excess is half way between the two of the last test.
#[test]
fn thrust_in_hover_is_that_of_momentum_theory() {
    for (order, excess) in [(1, 0.125), (2, 0.0327), (4, 0.0161), (6, 0.0098)] {
        let wake = Wake::new(order, &[]);
        let loading = axial_loading(&wake, |_| 50.0);
        let mut divided: Vec<_> = loading.iter().map(|tau| tau / 2.0).collect();
        divided[0] = loading[0];
        let square = wake.mean(&steady(&wake, &divided, 0.0, 1.0));
        assert!((square / 25.0 - 1.0 - excess).abs() < 1e-4, "{square}");
        let states = steady(&wake, &divided, 0.0, square.sqrt());
        let mut rates = vec![0.0; wake.len()];
        wake.rate(&states, &loading, &stream(0.0, 0.0, 2.0), &mut rates);
        for rate in &rates {
            assert!(rate.abs() < 1e-11, "{rates:?}");
        }
    }
}

/// v = p/(2 rho V) at each radius for the loading p = x^2 nu, whose thrust is 4/15.
#[test]
fn field_in_axial_flow_converges_to_the_pressure() {
    let mut before = f64::INFINITY;
    for order in [1, 2, 4, 6] {
        let wake = Wake::new(order, &[]);
        let states = steady(&wake, &axial_loading(&wake, |x| x * x * nu(x)), 0.0, 0.5);
        let velocity = |x: f64| -> f64 {
            let functions = wake.indices[..wake.axial].iter().zip(&states);
            functions
                .map(|((m, j), state)| phi(*m, *j, x) * state)
                .sum()
        };
        let error = integral(|x| (velocity(x) - x * x * nu(x)).powi(2) * x * nu(x)).sqrt();
        assert!(error < 0.6 * before, "{order}: {error}");
        before = error;
    }
    assert!(before < 0.01, "{before}");
}

/// 8/(3 pi) and 16/(45 pi), the apparent mass and inertia of a disc (Tuckerman 1925, NACA TR 210):
/// with three states a rotor in still air starts its wake like Pitt & Peters', from any loads.
#[test]
fn start_in_still_air_is_that_of_pitt_and_peters() {
    let ratios = [0.3, 0.6, 0.9];
    let wake = Wake::new(1, &ratios);
    let still = stream(0.0, 0.0, 1.7);
    let (mut loading, mut sums) = ([0.0; 3], Loading::default());
    for (element, x) in ratios.iter().enumerate() {
        for (psi, force) in [(0.3_f64, 2.0), (2.0, -0.7), (4.0, 5.0)] {
            let force = force * (element + 1) as f64;
            let harmonics = Wake::harmonics(psi.cos(), psi.sin());
            add_load(&wake, &mut loading, element, &harmonics, force);
            sums.thrust += force / PI;
            sums.cosine += force / PI * x * psi.cos();
            sums.sine += force / PI * x * psi.sin();
        }
    }
    let mut rates = [0.0; 3];
    wake.rate(&[0.0; 3], &loading, &still, &mut rates);
    let expected = pitt_peters::rate(&still, &Field::default(), &sums);
    let found = [
        3.0_f64.sqrt() * rates[0],
        7.5_f64.sqrt() * rates[1],
        7.5_f64.sqrt() * rates[2],
    ];
    for (found, expected) in found.iter().zip(expected.to_array()) {
        assert!((found / expected - 1.0).abs() < 1e-13);
    }
}

fn some_states(wake: &Wake) -> Vec<f64> {
    (0..wake.len())
        .map(|i| (1.0 + i as f64 * 1.7).sin())
        .collect()
}

/// A field is the same seen from turned axes, and with three states turns as `Field` does.
#[test]
fn turned_axes() {
    let (forward, left): (f64, f64) = (3.0, -1.0);
    let speed = forward.hypot(left);
    let (cos, sin) = (forward / speed, left / speed);
    let wake = Wake::new(6, &[0.2, 0.8]);
    let states = some_states(&wake);
    let turned = wake.rotated(&states, cos, sin);
    let back = wake.rotated(&turned, cos, -sin);
    for (state, back) in states.iter().zip(&back) {
        assert!((state - back).abs() < 1e-14);
    }
    for psi in [0.1_f64, 1.5, 4.0] {
        let before = Wake::harmonics(psi.cos(), psi.sin());
        let psi = psi - sin.atan2(cos);
        let after = Wake::harmonics(psi.cos(), psi.sin());
        for element in 0..2 {
            let change = velocity(&wake, &states, element, &before)
                - velocity(&wake, &turned[..wake.len()], element, &after);
            assert!(change.abs() < 1e-12, "{change}");
        }
    }
    let field = Field {
        mean: 1.0,
        cosine: 0.6,
        sine: 0.3,
    };
    let expected = field.into_wind(&WindAxes::new(forward, left));
    let found = Wake::new(1, &[]).rotated(&[1.0, 0.6, 0.3], cos, sin);
    assert!((found[1] - expected.cosine).abs() < 1e-15);
    assert!((found[2] - expected.sine).abs() < 1e-15);
}

/// Against sums of (60) with cosines of the angle. An azimuth without a direction has m = 0 only.
#[test]
fn velocity_at_an_element() {
    let wake = Wake::new(4, &[0.25, 0.7]);
    let states = some_states(&wake);
    let (cosines, sines) = states.split_at(wake.indices.len());
    for psi in [0.0_f64, 2.5] {
        let harmonics = Wake::harmonics(psi.cos(), psi.sin());
        let mut expected = 0.0;
        for (i, (m, j)) in wake.indices.iter().enumerate() {
            let angle = *m as f64 * psi;
            expected += phi(*m, *j, 0.7) * cosines[i] * angle.cos();
            if *m > 0 {
                expected += phi(*m, *j, 0.7) * sines[i - wake.axial] * angle.sin();
            }
        }
        let found = velocity(&wake, &states, 1, &harmonics);
        assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    }
    let around = |i: usize| {
        let psi = i as f64 * PI / 6.0;
        velocity(&wake, &states, 1, &Wake::harmonics(psi.cos(), psi.sin()))
    };
    let mean = (0..12).map(around).sum::<f64>() / 12.0;
    let found = velocity(&wake, &states, 1, &Wake::harmonics(0.0, 0.0));
    assert!((found - mean).abs() < 1e-13);
    let disc = integral(|x| {
        let functions = wake.indices[..wake.axial].iter().zip(&states);
        let at: f64 = functions.map(|((m, j), a)| phi(*m, *j, x) * a).sum();
        2.0 * x * at
    });
    assert!((wake.mean(&states) - disc).abs() < 1e-7);
}

/// Also in edgewise flow. The condition numbers are those that the head of the file states.
#[test]
fn gains_have_an_inverse_and_take_no_power_from_the_wake() {
    for (order, stated) in (1..).zip([3.34, 9.63, 12.9, 27.3, 29.0, 46.5]) {
        let wake = Wake::new(order, &[]);
        for first in [0, wake.axial] {
            for skew in SKEWS {
                let gains = balanced(&wake, skew, first);
                let least = (&gains + gains.transpose()).symmetric_eigenvalues().min();
                assert!(least > if skew < 1.0 { 0.002 } else { -1e-12 }, "{least}");
            }
        }
        let singular = matrix(&wake, 1.0, 0).singular_values();
        let condition = singular.max() / singular.min();
        assert!((condition / stated - 1.0).abs() < 0.01, "{condition}");
        let singular = matrix(&wake, 1.0, wake.axial).singular_values();
        assert!(singular.max() / singular.min() < condition);
    }
}

#[test]
fn bounds_are_as_described() {
    for (order, bounds) in (1..).zip(BOUNDS) {
        let wake = Wake::new(order, &[]);
        let count = wake.indices.len();
        let mut norm = 0.0_f64;
        for first in [0, wake.axial] {
            for i in 0..=20 {
                let gains = balanced(&wake, 0.05 * i as f64, first);
                let mut inverse = gains.try_inverse().unwrap();
                for i in 0..inverse.nrows() {
                    for k in 0..inverse.ncols() {
                        let masses = wake.mass[first + i] * wake.mass[first + k];
                        inverse[(i, k)] /= masses.sqrt();
                    }
                }
                norm = norm.max(inverse.singular_values().max());
            }
        }
        let blades = |power: i32| {
            let damping = DMatrix::from_fn(count, count, |i, k| {
                let ((r, j), (m, n)) = (wake.indices[i], wake.indices[k]);
                if r != m {
                    return 0.0;
                }
                let gram = integral(|x| phi(r, j, x) * phi(m, n, x) * x.powi(power));
                0.25 * gram / (wake.mass[i] * wake.mass[k]).sqrt()
            });
            let harmonics = |i: usize| if i < wake.axial { 1.0 } else { 2.0 };
            let trace: f64 = (0..count).map(|i| harmonics(i) * damping[(i, i)]).sum();
            [damping.symmetric_eigenvalues().max(), trace]
        };
        let [turning, turning_trace] = blades(1);
        let [edgewise, edgewise_trace] = blades(0);
        for (found, stated) in [
            (norm, bounds.wake),
            (turning, bounds.turning),
            (edgewise, bounds.edgewise),
            (turning_trace, bounds.turning_trace),
            (edgewise_trace, bounds.edgewise_trace),
        ] {
            assert!(
                found < stated && found > 0.995 * stated,
                "{order}: {found} {stated}"
            );
        }
    }
}

/// Eigenvalues of the rates, by differences, with the loads of individual blades or with their
/// azimuth average: all are slower than the bounds, and in hover they die away.
#[test]
fn fastest_rate_bounds_the_modes() {
    let ratios: Vec<_> = (0..40).map(|i| (i as f64 + 0.5) / 40.0).collect();
    let (solidity, tip_speed, radius) = (0.1, 100.0, 2.0);
    for order in 1..=MAX_ORDER {
        let wake = Wake::new(order, &ratios);
        let count = wake.len();
        for (edgewise, climb, mean) in [
            (0.0, 0.0, 6.0),
            (0.0, 0.0, 0.0),
            (40.0, 0.0, 1.0),
            (4.0, 0.0, 6.0),
            (0.0, -7.0, 6.9),
            (1.0, -9.0, 5.0),
            (0.0, 20.0, 2.0),
        ] {
            let stream = stream(edgewise, climb, radius);
            let mut states = vec![0.0; count];
            states[0] = mean / 3.0_f64.sqrt();
            for (azimuths, blades) in [(1, 1.0), (2, 1.0), (4, 1.0), (36, 1.0), (36, 0.0)] {
                // Around the equilibrium of the loads that hold the field.
                let rates = |states: &[f64]| {
                    let mut loading = vec![0.0; count];
                    for i in 0..azimuths {
                        let psi = 0.3 + 2.0 * PI * i as f64 / azimuths as f64;
                        let harmonics = Wake::harmonics(psi.cos(), psi.sin());
                        for (element, x) in ratios.iter().enumerate() {
                            let speed = tip_speed * x + edgewise * psi.sin();
                            let v = velocity(&wake, states, element, &harmonics) - mean;
                            let lift = -PI * speed.abs() * v * blades;
                            let area = solidity * PI / 40.0 / azimuths as f64;
                            add_load(&wake, &mut loading, element, &harmonics, lift * area);
                        }
                    }
                    let mut rates = vec![0.0; count];
                    wake.rate(states, &loading, &stream, &mut rates);
                    rates
                };
                let small = 1e-6;
                let slopes = DMatrix::from_fn(count, count, |i, k| {
                    let mut moved = states.clone();
                    moved[k] += small;
                    let up = rates(&moved)[i];
                    moved[k] -= 2.0 * small;
                    (up - rates(&moved)[i]) / (2.0 * small)
                });
                let modes = slopes.complex_eigenvalues();
                let fastest = modes
                    .iter()
                    .map(|mode| mode.norm_sqr().sqrt())
                    .fold(0.0, f64::max);
                let bound = if azimuths == 36 {
                    wake.fastest_rate(&states, solidity * blades, tip_speed, &stream, false)
                } else {
                    wake.fastest_rate(&states, solidity, tip_speed, &stream, true)
                };
                let case =
                    format!("{order} {edgewise} {climb} {mean} {azimuths}: {fastest} {bound}");
                assert!(fastest < bound * (1.0 + 1e-6) + 1e-5, "{case}");
                if azimuths == 36 && mean > 0.0 && climb == 0.0 {
                    assert!(fastest > bound / 5.0, "{case}");
                    assert!(modes.iter().all(|mode| mode.re < 0.0), "{case}");
                }
            }
        }
    }
}

/// Small changes of the mean in hover, without other loads, die away with R 8/(3 pi)/(4 v) times
/// the 9/8 of the gain: see `three_states_against_pitt_and_peters`.
#[test]
fn time_constant_of_the_mean_in_hover() {
    let (mean, radius, small) = (4.0, 2.0, 1e-6);
    let wake = Wake::new(1, &[]);
    let loading = [3.0_f64.sqrt() / 2.0 * 2.0 * mean * mean / 1.125, 0.0, 0.0];
    let rate = |mean: f64| {
        let mut rates = [0.0; 3];
        let states = [mean / 3.0_f64.sqrt(), 0.0, 0.0];
        wake.rate(&states, &loading, &stream(0.0, 0.0, radius), &mut rates);
        3.0_f64.sqrt() * rates[0]
    };
    assert!(rate(mean).abs() < 1e-12);
    let constant = -2.0 * small / (rate(mean + small) - rate(mean - small));
    let expected = radius * 8.0 / (3.0 * PI) / (4.0 * mean) * 1.125;
    assert!((constant / expected - 1.0).abs() < 1e-6, "{constant}");
}

#[test]
fn all_flows_have_finite_rates() {
    for order in 1..=MAX_ORDER {
        let wake = Wake::new(order, &[]);
        let states = some_states(&wake);
        for states in [&states, &vec![0.0; wake.len()]] {
            let induced = wake.mean(states);
            for edgewise in [0.0, 1e-300, 1e-9, 1.0, 1e4] {
                for climb in [0.0, -induced, -induced + 1e-12, -5.0, 1e4] {
                    let mut rates = [f64::NAN; MAX_STATES];
                    let flow = stream(edgewise, climb, 1.0);
                    wake.rate(states, &vec![1.0; wake.len()], &flow, &mut rates);
                    for rate in &rates[..wake.len()] {
                        assert!(rate.is_finite(), "{order} {edgewise} {climb}");
                    }
                    let bound = wake.fastest_rate(states, 0.1, 100.0, &flow, false);
                    assert!(bound.is_finite());
                }
            }
        }
    }
}

//! The periodic motion by Fourier collocation: the equations of motion hold at equally spaced
//! azimuths, between which flapping and inflow are trigonometric polynomials (Trefethen 2000,
//! "Spectral Methods in MATLAB", ch. 3). Nothing is integrated in time, so that stiff blades and
//! slow rotors cost no more than others.
//!
//! All blades make the same motion, so that one function of azimuth over a revolution describes
//! their flapping. The inflow repeats itself in each blade passage.

use super::unknowns::Unknowns;
use crate::numbers::Dual64;
use crate::{
    error::SolveError, inflow::Number, operating_point::OperatingPoint, rotor::Rotor, state::State,
    work::Work, workspace::Workspace,
};
use core::f64::consts::PI;
use nalgebra::{DMatrix, DVector};

/// Minimum number of azimuths in a revolution, which resolves 11 harmonics.
const MIN_AZIMUTHS: usize = 24;
/// Minimum number of azimuths in a blade passage.
const MIN_IN_PASSAGE: usize = 5;
/// Maximum number of Newton steps.
const MAX_STEPS: usize = 15;
/// Maximum number of steps that leave more than half of the residual. Where corners, as of stops,
/// keep it from falling, more steps are of no use.
const MAX_SLOW_STEPS: usize = 4;
/// Maximum number of halvings of a step that does not come closer.
const MAX_HALVINGS: usize = 4;
/// Length of a step, in unknowns of order 1, at which the search ends. The motion itself is not
/// more exact than the polynomials.
const TOLERANCE: f64 = 1e-9;
/// Residual up to which a motion counts as found although corners of the section data keep the
/// steps from becoming small; in units of the centrifugal acceleration of 1 rad.
const SMALL_RESIDUAL: f64 = 1e-6;

/// Computations in plain numbers that cost as much as one in dual numbers.
const DUAL_WORK: u64 = 2;

/// The equations at the azimuths of one blade passage.
pub(super) struct Collocation<'a> {
    rotor: &'a Rotor,
    unknowns: Unknowns,
    /// Omega, rad/s.
    speed: f64,
    /// Azimuths in a blade passage.
    nodes: usize,
    blades: usize,
    /// First derivative by azimuth over the azimuths of a revolution.
    turn: DMatrix<f64>,
    /// The second derivative of the flap angles and the first of the inflow states.
    derivatives: DMatrix<f64>,
}

impl<'a> Collocation<'a> {
    /// For a rotor that turns; none for one that is stopped.
    pub(super) fn new(rotor: &'a Rotor, point: &OperatingPoint) -> Option<Self> {
        if point.speed <= 0.0 {
            return None;
        }
        let blades = rotor.geometry().blades as usize;
        let nodes = MIN_AZIMUTHS.div_ceil(blades).max(MIN_IN_PASSAGE);
        let azimuths = nodes * blades;
        let flapping = if rotor.flapping_blades() > 0 {
            azimuths
        } else {
            0
        };
        let states = rotor.models().inflow.state_count();
        let size = flapping + states * nodes;
        let mut derivatives = DMatrix::zeros(size, size);
        if flapping > 0 {
            let second = second_derivative(azimuths);
            derivatives
                .view_mut((0, 0), (azimuths, azimuths))
                .copy_from(&second);
        }
        let passage = first_derivative(nodes) * blades as f64;
        for from in (0..states).map(|s| flapping + s * nodes) {
            derivatives
                .view_mut((from, from), (nodes, nodes))
                .copy_from(&passage);
        }
        Some(Self {
            rotor,
            unknowns: Unknowns::of_periodic_state(rotor, point),
            speed: point.speed,
            nodes,
            blades,
            turn: first_derivative(azimuths),
            derivatives,
        })
    }

    /// Whether the blades flap; all do or none.
    fn flaps(&self) -> bool {
        self.rotor.flapping_blades() > 0
    }

    fn inflow_states(&self) -> usize {
        self.rotor.models().inflow.state_count()
    }

    /// Number of flap angles among the values.
    fn angles(&self) -> usize {
        if self.flaps() {
            self.nodes * self.blades
        } else {
            0
        }
    }

    /// Place of an inflow state at a node among the values.
    fn place(&self, state: usize, node: usize) -> usize {
        self.angles() + state * self.nodes + node
    }

    /// The values of a motion that is `state` at all azimuths: flap angles, and inflow states over
    /// their scale.
    fn constant(&self, state: &State) -> DVector<f64> {
        let mut values = DVector::zeros(self.angles() + self.inflow_states() * self.nodes);
        let unknowns = self.unknowns.of(state);
        let blades = self.rotor.flapping_blades();
        for k in 0..blades {
            for node in 0..self.nodes {
                values[k * self.nodes + node] = state.flaps[k].angle;
            }
        }
        for s in 0..self.inflow_states() {
            for node in 0..self.nodes {
                values[self.place(s, node)] = unknowns[s];
            }
        }
        values
    }

    /// Unknowns at a node of a motion: inflow states, and each blade's angle and rate over Omega.
    fn at(&self, values: &DVector<f64>, node: usize) -> DVector<f64> {
        let states = self.inflow_states();
        let blades = self.rotor.flapping_blades();
        let mut there = DVector::zeros(states + 2 * blades);
        for s in 0..states {
            there[s] = values[self.place(s, node)];
        }
        let angles = values.rows(0, self.angles());
        for k in 0..blades {
            let l = k * self.nodes + node;
            there[states + 2 * k] = angles[l];
            there[states + 2 * k + 1] = (self.turn.row(l) * angles)[0];
        }
        there
    }

    /// The state at the first azimuth, with blade 1 at the tail.
    fn first_state(&self, values: &DVector<f64>) -> State {
        self.unknowns.state(&self.at(values, 0))
    }

    /// Rates at a node over Omega: of the inflow states in their scale, and the accelerations of
    /// the blades over Omega^2.
    fn rates<S: Number>(
        &self,
        point: &OperatingPoint<S>,
        there: &DVector<S>,
        node: usize,
        workspace: &mut Workspace<S>,
    ) -> Result<DVector<S>, SolveError> {
        let mut state = self.unknowns.state(there);
        state.azimuth = S::constant(2.0 * PI * node as f64 / (self.nodes * self.blades) as f64);
        state.speed = point.speed;
        let rates = self.rotor.rates(point, &state, workspace)?;
        let scaled = self.unknowns.of(&rates).map(|rate| rate / self.speed);
        let states = self.inflow_states();
        let blades = self.rotor.flapping_blades();
        let accelerations = (0..blades).map(|k| scaled[states + 2 * k + 1]);
        let inflow = (0..states).map(|s| scaled[s]);
        Ok(DVector::from_iterator(
            states + blades,
            inflow.chain(accelerations),
        ))
    }

    /// Derivatives of the motion by azimuth less what the equations of motion say, at all azimuths.
    fn residual(
        &self,
        point: &OperatingPoint,
        values: &DVector<f64>,
        workspace: &mut Workspace,
    ) -> Result<DVector<f64>, SolveError> {
        let mut residual = &self.derivatives * values;
        for node in 0..self.nodes {
            let rates = self.rates(point, &self.at(values, node), node, workspace)?;
            for (row, rate) in self.rows(node).into_iter().zip(rates.iter()) {
                residual[row] -= rate;
            }
        }
        Ok(residual)
    }

    /// Places of the equations at a node, in the order of `rates`.
    fn rows(&self, node: usize) -> Vec<usize> {
        let inflow = (0..self.inflow_states()).map(|s| self.place(s, node));
        let blades = (0..self.rotor.flapping_blades()).map(|k| k * self.nodes + node);
        inflow.chain(blades).collect()
    }

    /// The slopes of the residual by the values.
    fn slopes(
        &self,
        point: &OperatingPoint<Dual64>,
        values: &DVector<f64>,
        workspace: &mut Workspace<Dual64>,
    ) -> Result<DMatrix<f64>, SolveError> {
        let mut slopes = self.derivatives.clone();
        let states = self.inflow_states();
        let angles = self.angles();
        for node in 0..self.nodes {
            let there = self.at(values, node).map(Dual64::from_re);
            let rows = self.rows(node);
            for i in 0..there.len() {
                let mut moving = there.clone();
                moving[i].eps = 1.0;
                let rates = self.rates(point, &moving, node, workspace)?;
                for (row, rate) in rows.iter().zip(rates.iter()) {
                    if i < states {
                        slopes[(*row, self.place(i, node))] -= rate.eps;
                        continue;
                    }
                    let l = (i - states) / 2 * self.nodes + node;
                    if (i - states).is_multiple_of(2) {
                        slopes[(*row, l)] -= rate.eps;
                    } else {
                        for m in 0..angles {
                            slopes[(*row, m)] -= rate.eps * self.turn[(l, m)];
                        }
                    }
                }
            }
        }
        Ok(slopes)
    }

    /// The motion that repeats itself, searched from a constant one, and whether it was found; if
    /// not, the closest that was met. None where the equations cannot be computed.
    fn solve(
        &self,
        point: &OperatingPoint,
        guess: &State,
        plain: &mut Workspace,
    ) -> Option<(DVector<f64>, bool)> {
        let mut dual = Workspace::new(self.rotor);
        let dual_point = point.map(Dual64::from_re);
        let mut values = self.constant(guess);
        let mut residual = self.residual(point, &values, plain).ok()?;
        let mut slow_steps = 0;
        for _ in 0..MAX_STEPS {
            dual.work = Work::up_to(plain.work.left() / DUAL_WORK);
            let slopes = self.slopes(&dual_point, &values, &mut dual);
            plain.work.count(DUAL_WORK * dual.work.done());
            let slopes = slopes.ok()?;
            let step = slopes.lu().solve(&-&residual);
            let Some(step) = step.filter(|step| step.norm().is_finite()) else {
                return Some((values, false));
            };
            let before = residual.norm();
            let mut part = 1.0;
            let mut closer = None;
            for _ in 0..=MAX_HALVINGS {
                let next = &values + &step * part;
                // Too long a step may lead to where the rates cannot be computed.
                if let Ok(found) = self.residual(point, &next, plain)
                    && found.norm() < before
                {
                    closer = Some((next, found));
                    break;
                }
                part *= 0.5;
            }
            let is_small = step.amax() <= TOLERANCE;
            match closer {
                Some(next) => (values, residual) = next,
                None => return Some((values, is_small || before <= SMALL_RESIDUAL)),
            }
            if is_small {
                return Some((values, true));
            }
            slow_steps += usize::from(residual.norm() > 0.5 * before);
            if slow_steps > MAX_SLOW_STEPS {
                break;
            }
        }
        Some((values, residual.norm() <= SMALL_RESIDUAL))
    }

    /// The state with blade 1 at the tail in the motion that repeats itself, searched from a state,
    /// and whether it was found; if not, a state close to it where there is one.
    pub(super) fn find(
        &self,
        point: &OperatingPoint,
        guess: &State,
        workspace: &mut Workspace,
    ) -> (State, bool) {
        match self.solve(point, guess, workspace) {
            Some((values, is_found)) => (self.first_state(&values), is_found),
            None => (*guess, false),
        }
    }

    /// How that state moves with the operating point, in the direction of the derivatives of
    /// `dual`; none if the search fails. `found` is the state that `find` returned.
    pub(super) fn derivative(
        &self,
        (plain, dual): (&OperatingPoint, &OperatingPoint<Dual64>),
        found: &State,
        workspace: &mut Workspace<Dual64>,
    ) -> Option<State> {
        let mut plain_workspace = Workspace::new(self.rotor);
        plain_workspace.work = Work::up_to(workspace.work.left());
        let solved = self.solve(plain, found, &mut plain_workspace);
        workspace.work.count(plain_workspace.work.done());
        let (values, is_found) = solved?;
        if !is_found {
            return None;
        }
        let mut by_point = DVector::zeros(values.len());
        for node in 0..self.nodes {
            let there = self.at(&values, node).map(Dual64::from_re);
            let rates = self.rates(dual, &there, node, workspace).ok()?;
            for (row, rate) in self.rows(node).into_iter().zip(rates.iter()) {
                by_point[row] = rate.eps;
            }
        }
        let slopes = self.slopes(&plain.map(Dual64::from_re), &values, workspace);
        let moved = slopes.ok()?.lu().solve(&by_point)?;
        Some(self.first_state(&moved))
    }
}

/// The matrix of the first derivative over `count` equally spaced angles of a circle (Trefethen
/// 2000, eq. 3.10 for even numbers; for odd ones with 1/sin in place of cot).
fn first_derivative(count: usize) -> DMatrix<f64> {
    circulant(count, 0.0, |half| {
        let slope = 0.5 / libm::sin(half);
        if count.is_multiple_of(2) {
            slope * libm::cos(half)
        } else {
            slope
        }
    })
}

/// The same of the second derivative (Trefethen 2000, eq. 3.12); for odd numbers the square of the
/// first, which loses no harmonic there.
fn second_derivative(count: usize) -> DMatrix<f64> {
    if !count.is_multiple_of(2) {
        let first = first_derivative(count);
        return &first * &first;
    }
    let diagonal = -((count * count) as f64 / 12.0 + 1.0 / 6.0);
    circulant(count, diagonal, |half| {
        let sin = libm::sin(half);
        -0.5 / (sin * sin)
    })
}

/// A matrix whose entries depend on half of the angle from column to row, with the sign that
/// alternates from neighbour to neighbour.
fn circulant(count: usize, diagonal: f64, entry: impl Fn(f64) -> f64) -> DMatrix<f64> {
    DMatrix::from_fn(count, count, |row, column| {
        if row == column {
            return diagonal;
        }
        let sign = if (row + column).is_multiple_of(2) {
            1.0
        } else {
            -1.0
        };
        sign * entry(PI * (row as f64 - column as f64) / count as f64)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 25 azimuths, as of a rotor with five blades: nalgebra with its feature `std` takes other
    /// code from a size of 6.
    #[test]
    fn products_of_matrices_have_no_fused_multiply_add() {
        let (first, second) = (first_derivative(25), second_derivative(25));
        for row in 0..25 {
            for column in 0..25 {
                let sum: f64 = (0..25).map(|i| first[(row, i)] * first[(i, column)]).sum();
                assert_eq!(second[(row, column)], sum, "row {row}, column {column}");
            }
        }
    }

    /// Of cos 2 psi + sin 3 psi, which both numbers of angles resolve.
    #[test]
    fn derivatives_of_harmonics_are_exact() {
        for count in [9, 10] {
            let angles = |i: usize| 2.0 * PI * i as f64 / count as f64;
            let values = DVector::from_fn(count, |i, _| {
                libm::cos(2.0 * angles(i)) + libm::sin(3.0 * angles(i))
            });
            let (first, second) = (
                first_derivative(count) * &values,
                second_derivative(count) * &values,
            );
            for i in 0..count {
                let psi = angles(i);
                let slope = -2.0 * libm::sin(2.0 * psi) + 3.0 * libm::cos(3.0 * psi);
                let curvature = -4.0 * libm::cos(2.0 * psi) - 9.0 * libm::sin(3.0 * psi);
                assert!((first[i] - slope).abs() < 1e-12);
                assert!((second[i] - curvature).abs() < 1e-11);
            }
        }
    }
}

//! Exact derivatives along a direction: the physics computed once with dual numbers.

use super::{
    BlockError, RotorBlock, Stage,
    flight_condition::FlightCondition,
    inputs,
    outputs::{write_outputs, write_stations},
    references::{Names, Reals},
    setup,
    state_vector::{read_states, write_derivatives, write_states},
    values::ValueError,
    variables::{Causality, RealRef, STATES, real},
};
use num_dual::Dual64;
use rotor::{OperatingPoint, Response, Rotor, State};
use thiserror::Error;

/// Why a derivative was not computed.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum DerivativeError {
    #[error(transparent)]
    Reference(#[from] ValueError),
    #[error("{name} is not computed, so that it has no derivative; ask for outputs or der(...)")]
    NotUnknown { name: &'static str },
    #[error(
        "there are no derivatives by {name}; they are by inputs, tunable parameters and, once initialised, states"
    )]
    NotKnown { name: &'static str },
    #[error("{name} has no derivative by {knowns} in this state ({change}); move away from it")]
    NoDerivative {
        name: &'static str,
        knowns: String,
        change: f64,
    },
    #[error(transparent)]
    Block(#[from] BlockError),
}

impl RotorBlock {
    /// The derivatives of what is computed (outputs, stations, derivatives of the states) along a
    /// direction that `knowns` (inputs, states, tunable parameters) take with the seeds `along`:
    /// for each unknown the sum of (d unknown/d known) times seed, unit of the unknown. At the
    /// present inputs and states; while the block is configured, with the states that the start
    /// finds, which move with the inputs. At a corner of a table or of the model, the one-sided
    /// derivative towards the side to which the direction leads; within rounding of one, that of
    /// either side. Where a value jumps, at the standstill of the rotor or of all air, the
    /// derivative knows nothing of what lies beyond: coefficients and induced velocity of a rotor
    /// at rest stay 0. All or nothing.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[impl Names<RealRef>],
        knowns: &[impl Names<RealRef>],
        along: &[f64],
    ) -> Result<impl Iterator<Item = f64>, DerivativeError> {
        let mut reals = self.values.reals.map(Dual64::from_re);
        for (known, seed) in knowns.iter().zip(along) {
            let known = known.reference()?;
            let variable = known.variable();
            let has_state = known.is_state() && self.stage != Stage::Configuring;
            let may_change = variable.causality == Causality::Input
                || (variable.causality == Causality::Parameter && variable.tunable);
            if !may_change && !has_state {
                let name = variable.name;
                return Err(DerivativeError::NotKnown { name });
            }
            reals[known].eps += seed;
        }
        for unknown in unknowns {
            let variable = unknown.reference()?.variable();
            if !variable.causality.is_computed() {
                let name = variable.name;
                return Err(DerivativeError::NotUnknown { name });
            }
        }
        self.respond_along(&mut reals)?;
        let knowns = knowns.iter().flat_map(|known| known.reference());
        changes(reals, unknowns, knowns.map(|known| known.variable().name))
    }

    /// The derivatives of outputs in time, per second, at the present, as a step ends there: with
    /// the states' own rates, and with those of the inputs in the last step. All or nothing.
    pub fn output_rates(
        &mut self,
        outputs: &[impl Names<RealRef>],
    ) -> Result<impl Iterator<Item = f64>, DerivativeError> {
        for output in outputs {
            let variable = output.reference()?.variable();
            if variable.causality != Causality::Output {
                let name = variable.name;
                return Err(DerivativeError::NotUnknown { name });
            }
        }
        let rates = self.derivatives()?;
        let mut reals = self.values.reals.map(Dual64::from_re);
        for (input, slope) in reals.iter_mut().zip(self.ramp.past) {
            input.eps = slope;
        }
        for (row, rate) in STATES.iter().zip(rates) {
            reals[row.value].eps = rate;
        }
        self.respond_along(&mut reals)?;
        changes(reals, outputs, ["time"].into_iter())
    }

    /// Replaces the computed variables in `reals` by what the inputs, states and parameters in it
    /// make of them.
    fn respond_along(&mut self, reals: &mut Reals<Dual64>) -> Result<(), DerivativeError> {
        if self.stage == Stage::Configuring {
            self.update()?;
        }
        let condition =
            FlightCondition::with_reals(&self.values, reals).map_err(BlockError::from)?;
        let rotor = self.rotor()?;
        let state = self.state_along(&rotor, &condition.point, reals)?;
        let response = rotor.respond(&condition.point, &state, &mut self.dual_workspace);
        let Response { hub, rates, blade } = match response {
            Ok(response) => response,
            Err(error) => return Err(BlockError::Unsolved(error, inputs(&self.values)).into()),
        };
        write_outputs(reals, &rotor, &hub, &condition, &state);
        write_stations(reals, &rotor, &blade);
        write_states(reals, &state);
        write_derivatives(reals, &rates);
        Ok(())
    }

    /// The states at an operating point: those among `reals` or, while the block is configured,
    /// those of the start.
    fn state_along(
        &mut self,
        rotor: &Rotor,
        point: &OperatingPoint<Dual64>,
        reals: &Reals<Dual64>,
    ) -> Result<State<Dual64>, BlockError> {
        if self.stage != Stage::Configuring {
            return Ok(read_states(reals));
        }
        let plain = FlightCondition::new(&self.values)?.point;
        let start = setup::start(&self.values)?;
        let azimuth_step = self.values.reals[real::NUMERICS__AZIMUTH_STEP];
        let found = &self.memory.state;
        let workspace = &mut self.dual_workspace;
        rotor
            .start_along((&plain, point), found, start, azimuth_step, workspace)
            .map_err(|e| self.unsolved(e))
    }
}

/// The changes of some of the variables, if all are finite; `along`: what they are derivatives by.
fn changes<'a>(
    reals: Reals<Dual64>,
    unknowns: &'a [impl Names<RealRef>],
    along: impl Iterator<Item = &'static str>,
) -> Result<impl Iterator<Item = f64> + 'a, DerivativeError> {
    let unknowns = unknowns.iter().flat_map(|unknown| unknown.reference());
    let mut not_finite = unknowns.clone().filter(|u| !reals[*u].eps.is_finite());
    if let Some(bad) = not_finite.next() {
        return Err(DerivativeError::NoDerivative {
            name: bad.variable().name,
            knowns: along.collect::<Vec<_>>().join(", "),
            change: reals[bad].eps,
        });
    }
    drop(not_finite);
    Ok(unknowns.map(move |unknown| reals[unknown].eps))
}

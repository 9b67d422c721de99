//! Exact derivatives along a direction: one computation of the physics in dual numbers.

use super::{
    BlockError, RotorBlock, Stage,
    computation::unsolved,
    flight_condition::FlightCondition,
    outputs::write_response,
    references::{Names, Reals},
    setup,
    state_vector::read_states,
    values::ValueError,
    variables::{Causality, RealRef, STATES, real},
};
use crate::host::memory::Watch;
use rotor::numbers::Dual64;
use rotor::{OperatingPoint, Rotor, SolveError, State, Workspace};
use thiserror::Error;

/// Why a derivative was not computed.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum DerivativeError {
    #[error(transparent)]
    Reference(#[from] ValueError),
    #[error(
        "{name} is not computed and has no derivative; ask for the derivative of an output or of der(...)"
    )]
    NotUnknown { name: &'static str },
    #[error(
        "there is no derivative with respect to {name}; ask for those with respect to inputs, tunable parameters or, after initialisation, states"
    )]
    NotKnown { name: &'static str },
    #[error(
        "the derivative of {name} with respect to {knowns} is {change} in this state, which is not finite; move away from this state"
    )]
    NoDerivative {
        name: &'static str,
        knowns: String,
        change: f64,
    },
    #[error(transparent)]
    Block(#[from] BlockError),
}

impl RotorBlock {
    /// The derivatives of `unknowns` (outputs, stations, derivatives of the states) along a
    /// direction, at the present inputs and states. The direction is given by `knowns` (inputs,
    /// states, tunable parameters) and one seed for each in `along`. The result for each unknown is
    /// the sum of (d unknown/d known) times seed, in the unit of the unknown. An error means that
    /// none was computed.
    ///
    /// While the block is being configured, the states are those at the start, which depend on the
    /// inputs.
    ///
    /// At a corner of a table or of a model, the result is the one-sided derivative to the side to
    /// which the direction points. Within rounding of a corner it may be that of either side. Where
    /// a value jumps, with the rotor stopped or all air at rest, the derivative does not see the
    /// value beyond the jump: coefficients and induced velocity of a stopped rotor stay 0.
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

    /// The time derivatives of outputs, per second, at the end of the last step: with the rates of
    /// the states, and with the rates that the inputs had in that step. An error means that none
    /// was computed.
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

    /// Computes the outputs and derivatives in `reals` from the inputs, states and parameters in
    /// it.
    fn respond_along(&mut self, reals: &mut Reals<Dual64>) -> Result<(), DerivativeError> {
        if self.stage == Stage::Configuring {
            self.update()?;
        }
        let condition =
            FlightCondition::with_reals(&self.values, reals).map_err(BlockError::from)?;
        let rotor = self.rotor()?;
        let watch = Watch::begin();
        if self.dual_workspace.is_empty() {
            self.dual_workspace = Workspace::new(&rotor);
            if watch.is_short() {
                self.dual_workspace = Workspace::default();
                return Err(BlockError::NoMemory.into());
            }
        }
        self.dual_workspace.work = self.budget();
        let state = self.state_along(&rotor, &condition.point, reals)?;
        let response = rotor
            .respond(&condition.point, &state, &mut self.dual_workspace)
            .map_err(|error| unsolved(error, &self.values))?;
        write_response(reals, &rotor, &condition, &state, &response);
        Ok(())
    }

    /// The states at an operating point: those in `reals` or, while the block is being configured,
    /// those at the start.
    fn state_along(
        &mut self,
        rotor: &Rotor,
        point: &OperatingPoint<Dual64>,
        reals: &Reals<Dual64>,
    ) -> Result<State<Dual64>, BlockError> {
        if self.stage != Stage::Configuring {
            return Ok(read_states(reals));
        }
        if !self.has_start {
            // The state does not follow from a condition that could be differentiated.
            return Err(self.unsolved(SolveError::NoSteadyState));
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

/// The derivatives of `unknowns`, if all are finite. `along` names the knowns for the error.
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

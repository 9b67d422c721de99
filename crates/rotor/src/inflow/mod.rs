//! Inflow: the velocity that the rotor induces at its own blades.
//!
//! `Inflow` is the choice of model with its data. Each question about a model is one method here
//! with one `match`, so that the compiler lists what a new model has to answer. A static model is a
//! file and an arm of `induction` and of `Induction::load`; a dynamic one has states, and an arm in
//! each method.

mod annulus;
mod closed_form;
mod descent;
mod disc_momentum;
mod dynamic;
mod finite_blades;
mod ground;
mod linear;
mod momentum;
mod peters_he;
mod pitt_peters;
mod uniform;

pub use descent::{Descent, FlowState};
pub use dynamic::{DiscLoading, Stream};
pub use ground::{Ground, GroundEffect};
pub use linear::Skew;
pub use momentum::Momentum;
pub use peters_he::{MAX_ORDER, Wake};

use super::{
    blade::Blade,
    disc::{AZIMUTHS, BladePosition, DiscFlow, WindAxes},
    element::{Element, LossIn},
    error::SolveError,
    induced::{Field, Induced},
    scalar::Scalar,
    sweep::Sweep,
};
use peters_he::Harmonics;
use std::cell::Cell;

/// Maximum number of states of an inflow model.
pub const MAX_STATES: usize = peters_he::MAX_STATES;

/// States of an inflow model, or their rates; 0 beyond those that the model has.
pub type InflowStates<S = f64> = [S; MAX_STATES];

/// An inflow model with its data.
#[derive(Debug, Clone, PartialEq)]
pub enum Inflow {
    /// Blade-element momentum theory in each annulus, all angles.
    Annulus,
    /// Small angles and a linear lift slope, axial flow only: thesis eq. (94).
    AnnulusClosedForm,
    /// Glauert's momentum theory for the disc as a whole, with a linear distribution over it.
    Linear(Skew),
    /// Each blade sweeps its own air: Knight & Hefner, Dahl.
    FiniteBlades,
    /// Pitt & Peters' three states, which take time to build up.
    PittPetersDynamic,
    /// Peters & He's generalised dynamic wake.
    PetersHe(Box<Wake>),
}

/// The disc at an operating point: all that an inflow model needs to know of the rotor.
#[derive(Debug, Clone, Copy)]
pub struct Disc<'a, S = f64> {
    /// The blade, element by element.
    pub blade: Blade<'a, S>,
    /// Motion of the disc through the air, in wind axes.
    pub flow: &'a DiscFlow<S>,
    /// Blades, or stations on the azimuth over which the disc is averaged.
    pub positions: &'a [BladePosition<S>],
    /// Whether the positions are those of the blades.
    pub is_individual: bool,
    /// Momentum theory in descent and near the ground.
    pub momentum: Momentum<S>,
}

/// What is induced at the blades at an operating point, in wind axes.
pub(crate) enum Induction<'a, S> {
    /// Each annulus has its own momentum balance.
    Annulus,
    /// Each annulus by the closed form.
    ClosedForm,
    /// Each blade has its own momentum balance.
    FiniteBlades,
    /// A linear distribution over the disc.
    Field(Field<S>),
    /// Peters & He's series.
    Series {
        wake: &'a Wake,
        states: InflowStates<S>,
        /// One for each position.
        harmonics: [Harmonics<S>; AZIMUTHS],
    },
}

impl Inflow {
    /// Peters & He's wake up to the power `order` (1 to 6) of the radius, for a rotor of so many
    /// blades whose elements lie at these radii r/R.
    pub fn peters_he(order: usize, blades: usize, radius_ratios: &[f64]) -> Self {
        Self::PetersHe(Box::new(Wake::of_blades(order, blades, radius_ratios)))
    }

    /// Number of states.
    pub fn state_count(&self) -> usize {
        match self {
            Self::Annulus | Self::AnnulusClosedForm | Self::Linear(_) | Self::FiniteBlades => 0,
            Self::PittPetersDynamic => pitt_peters::STATES,
            Self::PetersHe(wake) => wake.len(),
        }
    }

    /// Whether the model holds only for axial flow past rigid blades, and answers all else as if it
    /// were that.
    pub fn is_axial_only(&self) -> bool {
        match self {
            Self::AnnulusClosedForm => true,
            Self::Annulus
            | Self::Linear(_)
            | Self::FiniteBlades
            | Self::PittPetersDynamic
            | Self::PetersHe(_) => false,
        }
    }

    /// Whether all azimuths are alike in these states, but for `limit` m/s.
    pub fn is_axisymmetric<S: Scalar>(&self, states: &InflowStates<S>, limit: f64) -> bool {
        match self {
            Self::Annulus | Self::AnnulusClosedForm | Self::Linear(_) | Self::FiniteBlades => true,
            Self::PittPetersDynamic => Field::from_states(states).is_axisymmetric(limit),
            Self::PetersHe(wake) => wake.is_axisymmetric(states, limit),
        }
    }

    /// States (or rates) in the axes of the hub as those in wind axes.
    pub fn into_wind<S: Scalar>(
        &self,
        states: &InflowStates<S>,
        axes: &WindAxes<S>,
    ) -> InflowStates<S> {
        match self {
            Self::Annulus | Self::AnnulusClosedForm | Self::Linear(_) | Self::FiniteBlades => {
                [S::zero(); MAX_STATES]
            }
            Self::PittPetersDynamic => {
                pitt_peters::to_states(&Field::from_states(states).into_wind(axes))
            }
            Self::PetersHe(wake) => wake.rotated(states, axes.cos, axes.sin),
        }
    }

    /// States (or rates) in wind axes as those in the axes of the hub.
    pub fn out_of_wind<S: Scalar>(
        &self,
        states: &InflowStates<S>,
        axes: &WindAxes<S>,
    ) -> InflowStates<S> {
        match self {
            Self::Annulus | Self::AnnulusClosedForm | Self::Linear(_) | Self::FiniteBlades => {
                [S::zero(); MAX_STATES]
            }
            Self::PittPetersDynamic => {
                pitt_peters::to_states(&Field::from_states(states).out_of_wind(axes))
            }
            Self::PetersHe(wake) => wake.rotated(states, axes.cos, -axes.sin),
        }
    }

    /// States whose induced velocity is about that of a linear field, in the same axes.
    pub fn first_guess(&self, field: &Field) -> InflowStates {
        match self {
            Self::Annulus | Self::AnnulusClosedForm | Self::Linear(_) | Self::FiniteBlades => {
                [0.0; MAX_STATES]
            }
            Self::PittPetersDynamic => pitt_peters::to_states(field),
            Self::PetersHe(wake) => wake.like(field),
        }
    }

    /// What is induced at the blades; `states` in wind axes. Fails where the momentum equation has
    /// no solution.
    pub(crate) fn induction<S: Scalar>(
        &self,
        disc: &Disc<S>,
        states: &InflowStates<S>,
    ) -> Result<Induction<'_, S>, SolveError> {
        let edgewise = disc.flow.edgewise;
        Ok(match self {
            Self::Annulus => Induction::Annulus,
            Self::AnnulusClosedForm => Induction::ClosedForm,
            Self::FiniteBlades => Induction::FiniteBlades,
            Self::Linear(skew) => Induction::Field(disc.momentum_field(*skew)?),
            Self::PittPetersDynamic => {
                let field = Field::from_states(states);
                Induction::Field(disc.momentum.at_the_blades(edgewise, field.mean, field))
            }
            Self::PetersHe(wake) => {
                let mut harmonics = [Wake::harmonics(S::one(), S::zero()); AZIMUTHS];
                for (slot, position) in harmonics.iter_mut().zip(disc.positions) {
                    *slot = Wake::harmonics(position.azimuth.cos, position.azimuth.sin);
                }
                let mean = wake.mean(states);
                let states = disc.momentum.at_the_blades(edgewise, mean, *states);
                Induction::Series {
                    wake,
                    states,
                    harmonics,
                }
            }
        })
    }

    /// Rates of the states, m/s2, under the loading of the disc; states and rates in wind axes.
    pub fn rates<S: Scalar>(
        &self,
        states: &InflowStates<S>,
        loading: &DiscLoading<S>,
        stream: &Stream<S>,
    ) -> InflowStates<S> {
        match self {
            Self::Annulus | Self::AnnulusClosedForm | Self::Linear(_) | Self::FiniteBlades => {
                [S::zero(); MAX_STATES]
            }
            Self::PittPetersDynamic => {
                let loading = pitt_peters::Loading::of(loading, stream.radius);
                pitt_peters::to_states(&pitt_peters::rate(
                    stream,
                    &Field::from_states(states),
                    &loading,
                ))
            }
            Self::PetersHe(wake) => {
                let mut rates = [S::zero(); MAX_STATES];
                wake.rate(states, &loading.series, stream, &mut rates);
                rates
            }
        }
    }

    /// An estimate of how fast the states move towards their equilibrium, 1/s. `solidity` is N
    /// c/(pi R), `tip_speed` in m/s; `is_individual` where the blades act one by one.
    pub fn fastest_rate(
        &self,
        states: &InflowStates,
        solidity: f64,
        tip_speed: f64,
        stream: &Stream,
        is_individual: bool,
    ) -> f64 {
        match self {
            Self::Annulus | Self::AnnulusClosedForm | Self::Linear(_) | Self::FiniteBlades => 0.0,
            Self::PittPetersDynamic => {
                pitt_peters::fastest_rate(stream, states[0], solidity, tip_speed)
            }
            Self::PetersHe(wake) => {
                wake.fastest_rate(states, solidity, tip_speed, stream, is_individual)
            }
        }
    }
}

impl<S: Scalar> Induction<'_, S> {
    /// Computes the loads of element `i`, which `sweep` takes around the disc; answers the mean
    /// induced velocity around its annulus, m/s.
    pub(crate) fn load(
        &self,
        disc: &Disc<S>,
        i: usize,
        element: &Element<S>,
        sweep: &mut Sweep<S>,
    ) -> Result<S, SolveError> {
        let unsolved = |cause| SolveError::Annulus {
            radius_ratio: element.radius_ratio(),
            cause,
        };
        match self {
            Self::Annulus => {
                let answer = annulus::solve(element, disc.flow, disc.positions, &disc.momentum)
                    .map_err(unsolved)?;
                sweep.load_in(LossIn::Momentum, |_, _| Ok(answer.induced))?;
                Ok(answer.mean_axial)
            }
            Self::ClosedForm => {
                let rotation = disc.flow.rotation * element.radius;
                let answer = closed_form::solve(element, rotation, disc.flow.climb);
                let answer = answer.map_err(unsolved)?;
                sweep.take(&answer.load, answer.induced);
                Ok(answer.mean_induced)
            }
            Self::FiniteBlades => {
                let mean = Cell::new(S::zero());
                sweep.load_in(LossIn::Momentum, |_, position| {
                    let section = disc.flow.at_section(element.radius, position);
                    let answer = finite_blades::solve(element, &section, disc.flow, &disc.momentum)
                        .map_err(unsolved)?;
                    mean.set(mean.get() + answer.mean_axial / disc.positions.len() as f64);
                    Ok(answer.induced)
                })?;
                Ok(mean.get())
            }
            Self::Field(field) => {
                sweep.load_in(LossIn::Lift, |_, position| {
                    Ok(field.at(element.radius_ratio(), position.azimuth))
                })?;
                Ok(field.mean)
            }
            Self::Series {
                wake,
                states,
                harmonics,
            } => {
                sweep.load_in(LossIn::Lift, |k, _| {
                    Ok(Induced::axial(wake.velocity(states, i, &harmonics[k])))
                })?;
                Ok(wake.mean_at(states, i))
            }
        }
    }

    /// Adds the thrust of element `i` to the loading that drives the states of a series.
    pub(crate) fn add_loading(
        &self,
        disc: &Disc<S>,
        i: usize,
        sweep: &Sweep<S>,
        loading: &mut InflowStates<S>,
    ) {
        match self {
            Self::Annulus | Self::ClosedForm | Self::FiniteBlades | Self::Field(_) => {}
            Self::Series {
                wake, harmonics, ..
            } => {
                let blade = &disc.blade;
                let radius = blade.geometry.radius;
                let blades = f64::from(blade.geometry.blades) / disc.positions.len() as f64;
                let positions = sweep.thrust_at.iter().zip(harmonics);
                for (thrust, harmonics) in positions.take(disc.positions.len()) {
                    let force =
                        *thrust * blades * blade.width() / (blade.air.density * (radius * radius));
                    wake.add_load(loading, i, harmonics, force);
                }
            }
        }
    }
}

//! Inflow: the velocity that the rotor induces at its own blades.
//!
//! `Inflow` is the choice of model with its data. Each property of a model is one method with
//! one `match`, so that the compiler lists what a new model has to define:
//!
//! * a model in which each element finds its induced velocity is a file and an arm of
//!   `ElementInflow::load`;
//! * a linear distribution over the disc is an arm of `Skew::coefficients`;
//! * a model with states is a file and an arm in each method of `Inflow`.

mod annulus;
mod closed_form;
mod descent;
mod disc_momentum;
mod disc_problem;
mod dynamic;
mod element_inflow;
mod finite_blades;
mod ground;
mod linear;
mod momentum;
mod peters_he;
mod pitt_peters;
mod uniform;

pub use descent::{Descent, DescentLaw, FlowState, ThrustRadius};
pub use disc_problem::Disc;
pub use dynamic::{DiscLoading, Stream};
pub use element_inflow::ElementInflow;
pub use ground::{Ground, GroundEffect};
pub use linear::Skew;
pub use momentum::Momentum;
pub use peters_he::{MAX_ORDER, Wake};

use super::{
    disc::{AZIMUTHS, WindAxes},
    element::Element,
    error::SolveError,
    induced::{Field, Induced},
    scalar::Scalar,
    sweep::{InducedAt, Sweep},
};
use peters_he::Harmonics;

/// Maximum number of states of an inflow model.
pub const MAX_STATES: usize = peters_he::MAX_STATES;

/// States of an inflow model, or their rates; 0 beyond those that the model has.
pub type InflowStates<S = f64> = [S; MAX_STATES];

/// An inflow model with its data.
#[derive(Debug, Clone, PartialEq)]
pub enum Inflow {
    /// Each element has its own momentum balance.
    Elements(ElementInflow),
    /// Glauert's momentum theory for the disc as a whole, with a linear distribution over it.
    Linear(Skew),
    /// Pitt & Peters' three states, which take time to build up.
    PittPetersDynamic,
    /// Peters & He's generalised dynamic wake.
    PetersHe(Box<Wake>),
}

/// What is induced at the blades at an operating point, in wind axes.
pub(crate) enum Induction<'a, S> {
    /// Found element by element.
    Elements(ElementInflow),
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
    /// Peters & He's wake up to the power `order` (1 to 6) of the radius, for a rotor with
    /// `blades` blades whose elements lie at `radius_ratios`, r/R.
    pub fn peters_he(order: usize, blades: usize, radius_ratios: &[f64]) -> Self {
        Self::PetersHe(Box::new(Wake::of_blades(order, blades, radius_ratios)))
    }

    /// Number of states.
    pub fn state_count(&self) -> usize {
        match self {
            Self::Elements(_) | Self::Linear(_) => 0,
            Self::PittPetersDynamic => pitt_peters::STATES,
            Self::PetersHe(wake) => wake.len(),
        }
    }

    /// Whether the model holds only for axial flow past rigid blades. It treats any other flight as
    /// axial flow past rigid blades.
    pub fn is_axial_only(&self) -> bool {
        match self {
            Self::Elements(model) => model.is_axial_only(),
            Self::Linear(_) | Self::PittPetersDynamic | Self::PetersHe(_) => false,
        }
    }

    /// Whether all azimuths are alike in these states, but for `limit` m/s.
    pub fn is_axisymmetric<S: Scalar>(&self, states: &InflowStates<S>, limit: f64) -> bool {
        match self {
            Self::Elements(_) | Self::Linear(_) => true,
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
            Self::Elements(_) | Self::Linear(_) => [S::zero(); MAX_STATES],
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
            Self::Elements(_) | Self::Linear(_) => [S::zero(); MAX_STATES],
            Self::PittPetersDynamic => {
                pitt_peters::to_states(&Field::from_states(states).out_of_wind(axes))
            }
            Self::PetersHe(wake) => wake.rotated(states, axes.cos, -axes.sin),
        }
    }

    /// States whose induced velocity is about that of a linear field, in the same axes.
    pub fn first_guess(&self, field: &Field) -> InflowStates {
        match self {
            Self::Elements(_) | Self::Linear(_) => [0.0; MAX_STATES],
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
            Self::Elements(model) => Induction::Elements(*model),
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
            Self::Elements(_) | Self::Linear(_) => [S::zero(); MAX_STATES],
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
            Self::Elements(_) | Self::Linear(_) => 0.0,
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
    /// Computes the loads of element `i`, which `sweep` moves around the azimuth. Returns the mean
    /// induced velocity around its annulus, m/s.
    pub(crate) fn load(
        &self,
        disc: &Disc<S>,
        i: usize,
        element: &Element<S>,
        sweep: &mut Sweep<S>,
    ) -> Result<S, SolveError> {
        match self {
            Self::Elements(model) => {
                let load = model.load(disc, element, sweep);
                load.map_err(|cause| SolveError::Annulus {
                    radius_ratio: element.radius_ratio(),
                    cause,
                })
            }
            Self::Field(field) => {
                sweep.load_in(InducedAt::Annulus, |_, position| {
                    Ok(field.at(element.radius_ratio(), position.azimuth))
                })?;
                Ok(field.mean)
            }
            Self::Series {
                wake,
                states,
                harmonics,
            } => {
                sweep.load_in(InducedAt::Annulus, |k, _| {
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
            Self::Elements(_) | Self::Field(_) => {}
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

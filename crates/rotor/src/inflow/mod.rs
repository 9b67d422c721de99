//! Inflow: the velocity that the rotor induces at its own blades.
//!
//! `Inflow` is the choice of model with its data. Each property of a model is one method with
//! one `match`, so that the compiler lists what a new model has to define:
//!
//! * a model in which each element finds its induced velocity is a file and an arm of
//!   `Induction::load`;
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
mod loads;
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
pub use loads::{AllElements, DiscLoads, Number};
pub use momentum::Momentum;
pub use peters_he::{MAX_ORDER, Wake};

use super::{
    disc::{OfPositions, WindAxes},
    error::SolveError,
    induced::{Field, Induced},
    numbers::{LANES, Lanes, Scalar, converted},
    sweep::{InducedAt, Sweep},
};
use annulus::AnnulusInflow;
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
        harmonics: OfPositions<Harmonics<S>>,
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
    pub(crate) fn induction<S: Number>(
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
                let positions = disc.positions.iter();
                let harmonics = positions
                    .map(|p| Wake::harmonics(p.azimuth.cos, p.azimuth.sin))
                    .collect();
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
    /// Number of states that the loading of the disc drives one by one.
    pub(crate) fn loading_len(&self) -> usize {
        match self {
            Self::Elements(_) | Self::Field(_) => 0,
            Self::Series { wake, .. } => wake.len(),
        }
    }

    /// Computes the loads of a block of elements, which `sweep` moves around the azimuth, and adds
    /// their thrust to the loading that drives the states of a series. Returns the mean induced
    /// velocity around its annuli, m/s.
    #[inline(always)]
    pub(crate) fn load<L: Lanes<One = S>>(
        &self,
        disc: &Disc<S>,
        sweep: &mut Sweep<L>,
        loading: &mut [L],
    ) -> Result<L, SolveError> {
        let blades = sweep.blades;
        let block_index = sweep.block.first / LANES;
        let radius_ratio = sweep.element.radius_ratio();
        let failed = |cause| SolveError::Annulus {
            radius_ratio: radius_ratio.lane(0),
            cause,
        };
        let (at, annuli, mut mean) = match self {
            Self::Elements(ElementInflow::AnnulusClosedForm) => {
                let solution = closed_form::find(disc, sweep.block, sweep.element);
                let solution = solution.map_err(failed)?;
                sweep.element.count_work();
                sweep.take(&solution.load, solution.induced);
                return Ok(solution.mean_induced);
            }
            Self::Elements(ElementInflow::Annulus) => {
                let inflow = annulus::find(disc, sweep.block, sweep.element, blades);
                let inflow = inflow.map_err(failed)?;
                (InducedAt::Blade, inflow, inflow.mean_axial)
            }
            Self::Elements(ElementInflow::FiniteBlades) => {
                (InducedAt::Blade, AnnulusInflow::zero(), L::nil())
            }
            Self::Field(field) => {
                let mean = L::splat(field.mean);
                (InducedAt::Annulus, AnnulusInflow::zero(), mean)
            }
            Self::Series { wake, states, .. } => {
                let mean = wake.mean_at(states, block_index);
                (InducedAt::Annulus, AnnulusInflow::zero(), mean)
            }
        };
        // One place in the code that computes loads, which is long.
        for (position, blade) in blades.iter().enumerate() {
            let induced = match self {
                Self::Elements(ElementInflow::FiniteBlades) => {
                    let inflow = finite_blades::search(disc, sweep.block, blade);
                    let inflow = inflow.map_err(failed)?;
                    mean += converted::<_, L>(inflow.mean_axial) / blades.len() as f64;
                    Induced::axial(converted(inflow.induced.axial))
                }
                Self::Elements(_) => annuli.at(blade.azimuth),
                Self::Field(field) => field.at(radius_ratio, blade.azimuth),
                Self::Series {
                    wake,
                    states,
                    harmonics,
                } => Induced::axial(wake.velocity(states, block_index, &harmonics[position])),
            };
            let thrust = sweep.load_at(position, at, induced);
            if let Self::Series {
                wake, harmonics, ..
            } = self
            {
                let blade = &disc.blade;
                let radius = blade.geometry.radius;
                let share = f64::from(blade.geometry.blades) / blades.len() as f64;
                let scale = S::constant(share * blade.width());
                let force = thrust * L::splat(scale / (blade.air.density * (radius * radius)));
                wake.add_load(loading, block_index, &harmonics[position], force);
            }
        }
        Ok(mean)
    }
}

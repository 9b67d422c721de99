//! The aerodynamic loads of the disc: all elements at all blade positions, in the induced velocity
//! of the inflow model.

use super::{
    blade_loads::ElementLoads,
    disc::AZIMUTHS,
    error::SolveError,
    evaluation::Evaluation,
    inflow::{InflowStates, MAX_STATES},
    scalar::Scalar,
    sweep::Sweep,
    work::Work,
};
use nalgebra::Vector3;

/// The aerodynamic loads summed over elements and averaged over blade positions, in wind axes.
#[derive(Debug, Clone)]
pub(crate) struct DiscLoads<S = f64> {
    /// Force, N.
    pub(crate) force: Vector3<S>,
    /// Moment about the hub's centre, N.m.
    pub(crate) moment: Vector3<S>,
    /// Moment about one blade's hinge at each position, N.m.
    pub(crate) hinge_moments: [S; AZIMUTHS],
    /// The loading that drives the states of Peters & He's wake, m2/s2; 0 in other models.
    pub(crate) inflow_loading: InflowStates<S>,
    /// Sum over the elements of mean induced velocity times radius, m2/s.
    pub(crate) flux: S,
    /// Sum over the elements of the radius, m.
    pub(crate) area: f64,
    /// Number of stalled elements, averaged over the positions.
    pub(crate) stalled: f64,
    /// r/R of the outermost element that is stalled anywhere.
    pub(crate) stalled_radius: f64,
}

impl<S: Scalar> DiscLoads<S> {
    /// Computes the loads and writes those of each element to `elements`. `lifting_shares` are the
    /// fractions of the elements that carry lift. Fails where a momentum equation has no solution,
    /// or if no work is left.
    pub(crate) fn new(
        evaluation: &Evaluation<S>,
        lifting_shares: &[S],
        work: &Work,
        elements: &mut [ElementLoads<S>],
    ) -> Result<Self, SolveError> {
        let mut sums = Self {
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
            hinge_moments: [S::zero(); AZIMUTHS],
            inflow_loading: [S::zero(); MAX_STATES],
            flux: S::zero(),
            area: 0.0,
            stalled: 0.0,
            stalled_radius: 0.0,
        };
        let disc = evaluation.disc(lifting_shares, work);
        work.check((disc.positions.len() * elements.len()) as u64)?;
        let inflow = &evaluation.rotor.models().inflow;
        let induction = inflow.induction(&disc, &evaluation.inflow_states)?;
        for (i, load) in elements.iter_mut().enumerate() {
            let element = disc.blade.element(i);
            let mut sweep = Sweep::new(&element, disc.flow, disc.positions, disc.is_individual);
            let mean_induced = induction.load(&disc, i, &element, &mut sweep)?;
            induction.add_loading(&disc, i, &sweep, &mut sums.inflow_loading);
            sums.add(&sweep, disc.blade.width(), disc.positions.len());
            sums.flux += mean_induced * element.radius;
            sums.area += element.radius;
            if sweep.stalled > 0.0 {
                sums.stalled_radius = element.radius_ratio();
            }
            *load = sweep.loads(mean_induced);
        }
        Ok(sums)
    }

    /// Adds an element of a width, m.
    fn add(&mut self, sweep: &Sweep<S>, width: f64, positions: usize) {
        self.force += sweep.force * S::constant(width);
        self.moment += sweep.moment * S::constant(width);
        let moments = &sweep.hinge_moment_at[..positions];
        for (sum, moment) in self.hinge_moments.iter_mut().zip(moments) {
            *sum += *moment * width;
        }
        self.stalled += sweep.stalled;
    }
}

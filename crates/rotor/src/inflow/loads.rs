//! The aerodynamic loads of the disc in an induced velocity: all elements at all blade positions.

use super::{Disc, Induction, InflowStates, MAX_STATES};
use crate::{
    blade_loads::ElementLoads,
    disc::{AZIMUTHS, Azimuth, OfPositions},
    error::SolveError,
    numbers::{self, Dual64, Kernel, Lanes, Mask, Plain, Scalar},
    sweep::{BladeSums, Sweep, Wanted},
};
use arrayvec::ArrayVec;
use nalgebra::Vector3;

/// The aerodynamic loads summed over elements and averaged over blade positions, in wind axes.
#[derive(Debug, Clone)]
pub struct DiscLoads<S = f64> {
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
    /// Number of stalled elements, averaged over the positions; 0 unless the distribution is
    /// wanted.
    pub(crate) stalled: f64,
    /// r/R of the outermost element that is stalled anywhere; 0 unless the distribution is wanted.
    pub(crate) stalled_radius: f64,
}

/// Numbers in which a rotor is computed: plain ones and dual ones. The long code of the elements is
/// compiled once for each, in this crate.
pub trait Number: Scalar {
    /// Computes the loads.
    #[doc(hidden)]
    fn disc_loads(elements: AllElements<Self>) -> Result<DiscLoads<Self>, SolveError>;
}

impl Number for f64 {
    #[inline(never)]
    fn disc_loads(elements: AllElements<Self>) -> Result<DiscLoads<Self>, SolveError> {
        numbers::run(elements.disc.width, elements)
    }
}

impl Number for Dual64 {
    #[inline(never)]
    fn disc_loads(elements: AllElements<Self>) -> Result<DiscLoads<Self>, SolveError> {
        numbers::run(elements.disc.width, elements)
    }
}

/// All elements of the disc, side by side.
pub struct AllElements<'a, S> {
    pub(crate) disc: &'a Disc<'a, S>,
    pub(crate) induction: &'a Induction<'a, S>,
    pub(crate) wanted: Wanted,
    /// Where the loads along the blade go; empty if they are not wanted.
    pub(crate) elements: &'a mut [ElementLoads<S>],
}

impl<S: Scalar> Kernel for AllElements<'_, S> {
    type Output = Result<DiscLoads<S>, SolveError>;

    #[inline(always)]
    fn run<V: Plain>(self) -> Self::Output {
        let Self {
            disc,
            induction,
            wanted,
            elements,
        } = self;
        let blades = disc.blade_flows;
        let mut sums: OfPositions<_> = blades
            .iter()
            .map(|_| BladeSums::<S::In<V>>::zero())
            .collect();
        let mut loading: ArrayVec<_, MAX_STATES> = ArrayVec::new();
        for _ in 0..induction.loading_len() {
            loading.push(S::In::<V>::nil());
        }
        let (mut flux, mut area) = (S::In::<V>::nil(), V::nil());
        let (mut stalled, mut stalled_radius) = (V::nil(), 0.0);
        for block in &disc.blade.elements.blocks {
            let element = disc.blade.block::<S::In<V>>(block);
            let sums = &mut sums[..];
            let mut sweep = Sweep::new((&element, block), blades, sums, disc.is_individual, wanted);
            let mean_induced = induction.load(disc, &mut sweep, &mut loading)?;
            let counted_radius = element.radius * V::load(&block.counts);
            flux += mean_induced.times(counted_radius);
            area += counted_radius;
            if wanted == Wanted::Distribution {
                let is_stalled = sweep.stalled.is_above(0.0);
                for lane in 0..block.count {
                    if is_stalled.lane(lane) {
                        stalled_radius = block.radius[lane] / disc.blade.geometry.radius;
                    }
                }
                stalled += sweep.stalled;
                sweep.write(mean_induced, elements);
            }
        }
        let element_width = disc.blade.width();
        let mut loads = DiscLoads {
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
            hinge_moments: [S::zero(); AZIMUTHS],
            inflow_loading: [S::zero(); MAX_STATES],
            flux: flux.sum_of_lanes(),
            area: area.sum_of_lanes(),
            stalled: stalled.sum_of_lanes() / blades.len() as f64,
            stalled_radius,
        };
        for (sum, tau) in loads.inflow_loading.iter_mut().zip(&loading) {
            *sum = tau.sum_of_lanes();
        }
        let share = f64::from(disc.blade.geometry.blades) / blades.len() as f64 * element_width;
        for (k, (blade, sums)) in blades.iter().zip(sums.iter()).enumerate() {
            let Azimuth { sin, cos } = blade.azimuth;
            let total = |sum: S::In<V>| sum.sum_of_lanes() * share;
            let (inwards, tangential) = (total(sums.inwards), total(sums.tangential));
            loads.force += Vector3::new(
                inwards * cos - tangential * sin,
                inwards * sin + tangential * cos,
                total(sums.thrust),
            );
            let (up, twisting) = (total(sums.up), total(sums.twisting));
            loads.moment += Vector3::new(
                -up * sin - twisting * cos,
                up * cos - twisting * sin,
                -total(sums.torque),
            );
            loads.hinge_moments[k] = sums.hinge_moment.sum_of_lanes() * element_width;
        }
        Ok(loads)
    }
}

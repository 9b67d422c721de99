//! The definition of a rotor: geometry, airfoils, blade elements and models.

use super::{
    airfoil::Airfoil,
    disc::{AZIMUTHS, Azimuth, Flap, evenly_spaced},
    geometry::{Elements, Geometry, Rotation},
    inflow::ThrustRadius,
    models::Models,
    numbers::Scalar,
    operating_point::OperatingPoint,
    state::State,
    tip_loss::lifting_share,
};

/// A rotor: its shape, airfoils, blade elements and models. It never changes; instances share it by
/// `Arc`, and each computes in a `Workspace` of its own.
#[derive(Debug, Clone)]
pub struct Rotor {
    geometry: Geometry,
    airfoils: Vec<Airfoil>,
    elements: Elements,
    models: Models,
    /// Fraction of each element that carries lift, where the blade's shape alone decides where the
    /// lift ends.
    lifting_shares: Vec<f64>,
    /// Where along the blades the thrust acts.
    thrust_radius: ThrustRadius,
    /// The azimuths over which a disc without axial symmetry is averaged.
    azimuths: [Azimuth; AZIMUTHS],
}

// Threads may share a rotor.
const _: () = {
    const fn is_shared<T: Send + Sync>() {}
    is_shared::<Rotor>();
};

impl Rotor {
    /// From a checked geometry, its elements, its airfoils (one for each of `geometry.airfoils`)
    /// and models. A rotor whose blades flap has at most `state::MAX_FLAPPING_BLADES`.
    pub fn new(
        geometry: Geometry,
        elements: Elements,
        airfoils: Vec<Airfoil>,
        models: Models,
    ) -> Self {
        debug_assert_eq!(airfoils.len(), geometry.airfoils.len());
        let mut lifting_shares = vec![1.0; elements.len()];
        if let Some(end) = models.tip_loss.fixed_end(&geometry) {
            end_lift_at(end, &geometry, &elements, &mut lifting_shares);
        }
        let thrust_radius = ThrustRadius::new(&geometry, &elements);
        Self {
            geometry,
            airfoils,
            elements,
            models,
            lifting_shares,
            thrust_radius,
            azimuths: evenly_spaced(),
        }
    }

    /// Shape of the rotor.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// One for each of `geometry().airfoils`.
    pub fn airfoils(&self) -> &[Airfoil] {
        &self.airfoils
    }

    /// Where the blade elements are.
    pub fn elements(&self) -> &Elements {
        &self.elements
    }

    /// The models with which the rotor is computed.
    pub fn models(&self) -> &Models {
        &self.models
    }

    /// Fraction of each element that carries lift, 0 to 1, where the blade's shape alone decides
    /// where the lift ends.
    pub(crate) fn lifting_shares(&self) -> &[f64] {
        &self.lifting_shares
    }

    /// Where along the blades the thrust acts.
    pub(crate) fn thrust_radius(&self) -> &ThrustRadius {
        &self.thrust_radius
    }

    /// The azimuths over which a disc without axial symmetry is averaged.
    pub(crate) fn azimuths(&self) -> &[Azimuth] {
        &self.azimuths
    }

    /// -1 for a clockwise rotor, which is computed as its mirror image; else 1.
    pub(crate) fn mirror(&self) -> f64 {
        match self.geometry.rotation {
            Rotation::CounterClockwise => 1.0,
            Rotation::Clockwise => -1.0,
        }
    }

    /// Whether the rotor has states other than the azimuth.
    pub fn has_memory<S: Scalar>(&self, point: &OperatingPoint<S>) -> bool {
        point.is_driven()
            || self.models.hinge.freedom.is_some()
            || self.models.inflow.state_count() > 0
    }

    /// Number of blades that flap.
    pub fn flapping_blades(&self) -> usize {
        match self.models.hinge.freedom {
            Some(_) => self.geometry.blades as usize,
            None => 0,
        }
    }

    /// The state with 0 for all states that the rotor does not have: the speed unless a torque
    /// drives it, and inflow states and flapping beyond those of the models.
    pub fn used<S: Scalar>(&self, is_driven: bool, state: &State<S>) -> State<S> {
        let mut used = *state;
        if !is_driven {
            used.speed = S::zero();
        }
        used.inflow[self.models.inflow.state_count()..].fill(S::zero());
        used.flaps[self.flapping_blades()..].fill(Flap::rigid(0.0));
        used
    }
}

/// Ends the lift of the blades at r/R = `end`.
pub(crate) fn end_lift_at<S: Scalar>(
    end: S,
    geometry: &Geometry,
    elements: &Elements,
    lifting_shares: &mut [S],
) {
    let half = 0.5 * elements.width;
    let end = end * geometry.radius;
    for (share, radius) in lifting_shares.iter_mut().zip(&elements.radius) {
        *share = lifting_share(radius - half, radius + half, end);
    }
}

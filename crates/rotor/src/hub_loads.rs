//! Hub loads: force and moment on the hub, and quantities of the rotor as a whole.

use super::{
    disc::BladePosition,
    evaluation::Evaluation,
    inflow::{DiscLoads, FlowState},
    numbers::Scalar,
    operating_point::Drive,
    tip_path::TipPath,
};
use core::f64::consts::PI;
use nalgebra::Vector3;

/// Hub loads at the present azimuth, or averaged over one revolution. SI units, vectors in the hub
/// frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HubLoads<S = f64> {
    /// Force on the hub, N.
    pub force: Vector3<S>,
    /// Moment on the hub about its centre, N.m.
    pub moment: Vector3<S>,
    /// Torque that the rotor absorbs, N.m.
    pub torque: S,
    /// Mean induced velocity over the swept annulus from cutout to tip, positive down, m/s.
    pub induced_velocity: S,
    /// r/R of the middle of the outermost element that is stalled at any azimuth; 0 if none is.
    pub stalled_radius: f64,
    /// Fraction of the blade span that is stalled.
    pub stalled_fraction: f64,
    /// The cone of the blades.
    pub tip_path: TipPath<S>,
    /// State of the flow through the disc.
    pub flow_state: FlowState,
}

impl<S: Scalar> HubLoads<S> {
    /// From the aerodynamic loads of the disc.
    ///
    /// A clockwise rotor is computed as the mirror image of a counter-clockwise one, and mirrored
    /// back here.
    pub(crate) fn new(evaluation: &Evaluation<S>, loads: &DiscLoads<S>) -> Self {
        let Evaluation {
            rotor,
            point,
            axes,
            flow,
            positions,
            ..
        } = evaluation;
        let mut moment = loads.moment;
        let hinge = &rotor.models().hinge;
        let about = |position: &BladePosition<S>| {
            Vector3::new(-position.azimuth.sin, position.azimuth.cos, S::zero())
        };
        if evaluation.freedom.is_some() {
            for (position, hinge_moment) in positions.iter().zip(loads.hinge_moments) {
                let action = evaluation.action(hinge_moment);
                moment += about(position) * hinge.hub_moment_excess(flow, position, &action);
            }
        } else if !flow.is_hub_steady() {
            // As many blades as the rotor has, at these positions or averaged over them.
            let blades = f64::from(rotor.geometry().blades) / positions.len() as f64;
            for position in positions.iter() {
                moment += about(position) * (hinge.rigid_moment(flow, position) * blades);
            }
        }
        // A shaft that a torque drives transmits only this torque to the hub; the difference to the
        // rotor's torque changes the rotor speed.
        let around = match point.drive {
            Drive::Speed => moment.z,
            Drive::Torque { torque, .. } => -torque,
        };
        let mirror = rotor.mirror();
        let (force_x, force_y) = axes.out_of_wind(loads.force.x, loads.force.y);
        let (moment_x, moment_y) = axes.out_of_wind(moment.x, moment.y);
        let radius = rotor.geometry().radius;
        let induced_velocity = loads.flux / loads.area;
        let flow_state = FlowState::of(
            flow.edgewise.value(),
            flow.climb.value(),
            induced_velocity.value(),
            (loads.force.z / (point.air.density * PI * radius * radius)).value(),
        );
        Self {
            force: Vector3::new(force_x, force_y * mirror, loads.force.z),
            moment: Vector3::new(moment_x * mirror, moment_y, around * mirror),
            torque: -moment.z,
            induced_velocity,
            stalled_radius: loads.stalled_radius,
            stalled_fraction: loads.stalled / rotor.elements().len() as f64,
            tip_path: TipPath::new(evaluation, loads),
            flow_state,
        }
    }
}

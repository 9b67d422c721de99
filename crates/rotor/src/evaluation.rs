//! A rotor at an operating point in a state: wind axes, the disc's flow in them, and the positions
//! of the blades.

use super::{
    blade::Blade,
    disc::{Azimuth, BladeFlow, BladePosition, DiscFlow, Flap, OfPositions, WindAxes},
    flapping::{Action, Freedom},
    inflow::{DescentLaw, Disc, Ground, InflowStates, Momentum, Stream},
    models::Blades,
    numbers::{Scalar, Width},
    operating_point::OperatingPoint,
    rotor::Rotor,
    state::State,
    work::Work,
};
use core::f64::consts::PI;
use nalgebra::Vector3;

/// Asymmetry of the inflow states below which the disc counts as symmetric, as a fraction of the
/// speeds in the problem.
const SYMMETRIC: f64 = 1e-12;

/// A rotor at an operating point in a state, with what every computation there needs.
#[derive(Debug, Clone)]
pub struct Evaluation<'a, S = f64> {
    pub(crate) rotor: &'a Rotor,
    /// At the rotor speed that belongs to the state.
    pub(crate) point: OperatingPoint<S>,
    pub(crate) state: &'a State<S>,
    pub(crate) axes: WindAxes<S>,
    pub(crate) flow: DiscFlow<S>,
    pub(crate) descent: DescentLaw<S>,
    /// In wind axes.
    pub(crate) gravity: Vector3<S>,
    /// In wind axes.
    pub(crate) inflow_states: InflowStates<S>,
    pub(crate) positions: OfPositions<BladePosition<S>>,
    /// Whether the positions are those of the blades, rather than those of an azimuth average.
    pub(crate) is_individual: bool,
    /// None for rigid blades.
    pub(crate) freedom: Option<&'a Freedom>,
}

impl Rotor {
    /// The rotor at an operating point in a state.
    pub fn evaluate<'a, S: Scalar>(
        &'a self,
        point: &OperatingPoint<S>,
        state: &'a State<S>,
    ) -> Evaluation<'a, S> {
        let models = self.models();
        Evaluation::new(
            self,
            point,
            state,
            models.blades,
            models.hinge.freedom.as_ref(),
        )
    }

    /// The same with rigid blades, averaged over one revolution.
    pub(crate) fn evaluate_as_disc<'a, S: Scalar>(
        &'a self,
        point: &OperatingPoint<S>,
        state: &'a State<S>,
    ) -> Evaluation<'a, S> {
        Evaluation::new(self, point, state, Blades::Disc, None)
    }
}

impl<'a, S: Scalar> Evaluation<'a, S> {
    fn new(
        rotor: &'a Rotor,
        point: &OperatingPoint<S>,
        state: &'a State<S>,
        blades: Blades,
        freedom: Option<&'a Freedom>,
    ) -> Self {
        let point = point.at_speed_of(state);
        let mirror = rotor.mirror();
        let inflow = &rotor.models().inflow;
        let OperatingPoint {
            airspeed,
            angular_velocity,
            gravity,
            ..
        } = point;
        let axes = WindAxes::new(airspeed.x, airspeed.y * mirror);
        let (roll_rate, pitch_rate) =
            axes.into_wind(angular_velocity.x * mirror, angular_velocity.y);
        let (gravity_x, gravity_y) = axes.into_wind(gravity.x, gravity.y * mirror);
        // Cyclic pitch is -cos(psi) and -sin(psi) times these, so that it turns like (x, y).
        let (cyclic_cos, cyclic_sin) =
            axes.into_wind(point.cyclic_lateral, point.cyclic_longitudinal);
        let flow = DiscFlow {
            rotation: point.speed + angular_velocity.z * mirror,
            speed: point.speed,
            edgewise: airspeed.x.hypot(airspeed.y),
            climb: airspeed.z,
            roll_rate,
            pitch_rate,
            cyclic_cos,
            cyclic_sin,
            hinge: rotor.models().hinge.offset,
        };
        let tip_speed = flow.rotation.abs() * rotor.geometry().radius;
        let descent = rotor
            .models()
            .descent
            .of_rotor(rotor.thrust_radius(), flow.climb, tip_speed);
        // A decaying asymmetry never becomes exactly 0.
        let speeds = tip_speed + flow.edgewise + flow.climb.abs();
        let limit = SYMMETRIC * speeds.value();
        let is_symmetric = flow.is_axisymmetric() && inflow.is_axisymmetric(&state.inflow, limit);
        let is_individual = !inflow.is_axial_only()
            && (freedom.is_some()
                || match blades {
                    Blades::Automatic => !is_symmetric,
                    Blades::Disc => false,
                    Blades::Individual => true,
                });
        let positions = if is_individual {
            blade_positions(rotor, &axes, state, freedom)
        } else {
            averaging_positions(rotor, is_symmetric)
        };
        Self {
            rotor,
            point,
            state,
            axes,
            flow,
            descent,
            gravity: Vector3::new(gravity_x, gravity_y, gravity.z),
            inflow_states: inflow.into_wind(&state.inflow, &axes),
            positions,
            is_individual,
            freedom,
        }
    }

    /// Whether the response is that of blades at their azimuths, rather than an average over one
    /// revolution.
    pub fn is_individual(&self) -> bool {
        self.is_individual
    }

    /// Whether the states never become constant: the flow at each blade varies with azimuth, or a
    /// torque drives the rotor.
    pub fn never_settles(&self) -> bool {
        let turns =
            self.point.speed.value() != 0.0 && self.is_individual && !self.flow.is_axisymmetric();
        turns || self.point.is_driven()
    }

    /// The flow at each blade position.
    pub(crate) fn blade_flows(&self) -> OfPositions<BladeFlow<S>> {
        let flow = |position| self.flow.at_blade(position);
        self.positions.iter().map(flow).collect()
    }

    /// The disc as the inflow models see it, with the lift of the elements ending as
    /// `lifting_shares` say, with sections counted by `work`, and computed in lanes of a width.
    pub(crate) fn disc<'b>(
        &'b self,
        lifting_shares: &'b [S],
        work: &'b Work,
        blade_flows: &'b [BladeFlow<S>],
        width: Width,
    ) -> Disc<'b, S> {
        let rotor = self.rotor;
        let models = rotor.models();
        Disc {
            blade: Blade {
                geometry: rotor.geometry(),
                elements: rotor.elements(),
                airfoils: rotor.airfoils(),
                section: &models.section,
                tip_loss: models.tip_loss,
                air: &self.point.air,
                collective: self.point.collective,
                lifting_shares,
                work,
            },
            flow: &self.flow,
            positions: &self.positions,
            blade_flows,
            width,
            is_individual: self.is_individual,
            momentum: Momentum {
                descent: self.descent,
                ground: Ground {
                    effect: models.ground_effect,
                    height_ratio: self.point.height / rotor.geometry().radius,
                    upright: self.point.upright(),
                },
            },
        }
    }

    /// The flow that carries the wake of dynamic inflow away.
    pub(crate) fn stream(&self) -> Stream<S> {
        Stream {
            edgewise: self.flow.edgewise,
            climb: self.flow.climb,
            radius: self.rotor.geometry().radius,
            descent: self.descent,
        }
    }

    /// beta'' of each blade, rad/s2, under these aerodynamic moments about the hinges, N.m.
    pub(crate) fn flap_accelerations(&self, moments: &[S]) -> OfPositions<S> {
        let models = self.rotor.models();
        let blades = self.positions.iter().zip(moments);
        if let (Some(seesaw), [one, two]) = (&models.seesaw, self.positions.as_slice())
            && let [first, second, ..] = moments
        {
            let actions = [self.action(*first), self.action(*second)];
            let blades = [(one, &actions[0]), (two, &actions[1])];
            let both = seesaw.accelerations(&models.hinge, &self.flow, blades);
            return both.into_iter().collect();
        }
        let of = |(position, moment): (&BladePosition<S>, &S)| {
            let action = self.action(*moment);
            models.hinge.acceleration(&self.flow, position, &action)
        };
        blades.map(of).collect()
    }

    /// What acts on a blade whose aerodynamic loads have this moment about the hinge, N.m.
    pub(crate) fn action(&self, moment: S) -> Action<S> {
        Action {
            moment,
            spring: self.point.hinge_spring,
            gravity: self.gravity,
        }
    }
}

/// The positions of the blades.
fn blade_positions<S: Scalar>(
    rotor: &Rotor,
    axes: &WindAxes<S>,
    state: &State<S>,
    freedom: Option<&Freedom>,
) -> OfPositions<BladePosition<S>> {
    let count = rotor.geometry().blades as usize;
    let step = 2.0 * PI / count as f64;
    let position = |k: usize| {
        let psi = state.azimuth + step * k as f64;
        let (cos, sin) = axes.into_wind(psi.cos(), psi.sin());
        let azimuth = Azimuth { sin, cos };
        match (freedom, state.flaps.get(k)) {
            (Some(freedom), Some(flap)) => {
                let above = flap.angle - rotor.models().hinge.precone;
                BladePosition::new(azimuth, *flap, above * -freedom.pitch_flap)
            }
            _ => rigid(rotor, azimuth),
        }
    };
    (0..count).map(position).collect()
}

/// The positions over which the disc is averaged: a single one without direction where all azimuths
/// are alike.
fn averaging_positions<S: Scalar>(
    rotor: &Rotor,
    is_symmetric: bool,
) -> OfPositions<BladePosition<S>> {
    if is_symmetric {
        return [rigid(rotor, Azimuth::any())].into_iter().collect();
    }
    let position = |azimuth: &Azimuth| {
        let (sin, cos) = (S::constant(azimuth.sin), S::constant(azimuth.cos));
        rigid(rotor, Azimuth { sin, cos })
    };
    rotor.azimuths().iter().map(position).collect()
}

fn rigid<S: Scalar>(rotor: &Rotor, azimuth: Azimuth<S>) -> BladePosition<S> {
    BladePosition::new(
        azimuth,
        Flap::rigid(rotor.models().hinge.precone),
        S::zero(),
    )
}

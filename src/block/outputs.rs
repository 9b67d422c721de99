//! What the rotor answers, as values of the outputs.

use super::{flight_condition::FlightCondition, references::Reals, variables::real};
use core::f64::consts::{PI, SQRT_2};
use rotor::{BladeLoads, Drive, HubLoads, Rotor, State, scalar::Scalar};

/// Number of stations along the blade.
const STATIONS: usize = real::STATION__RADIUS.len();

/// Tip speed, m/s, up to which a rotor counts as standing still, where coefficients mean nothing.
const STANDSTILL: f64 = 1e-6;

/// Writes the outputs among the Real variables.
pub fn write_outputs<S: Scalar>(
    reals: &mut Reals<S>,
    rotor: &Rotor,
    hub: &HubLoads<S>,
    condition: &FlightCondition<S>,
    state: &State<S>,
) {
    let shaft = &condition.shaft;
    let point = &condition.point.at_speed_of(state);
    let HubLoads {
        force: hub_force,
        moment: hub_moment,
        torque,
        ..
    } = *hub;
    let thrust = hub_force.z;
    let force = shaft.hub_to_ground * hub_force;
    let moment = shaft.hub_to_ground * hub_moment;
    for (places, vector) in [
        ([real::FORCE_1, real::FORCE_2, real::FORCE_3], force),
        ([real::MOMENT_1, real::MOMENT_2, real::MOMENT_3], moment),
        (
            [real::HUB_FORCE_1, real::HUB_FORCE_2, real::HUB_FORCE_3],
            hub_force,
        ),
        (
            [real::HUB_MOMENT_1, real::HUB_MOMENT_2, real::HUB_MOMENT_3],
            hub_moment,
        ),
    ] {
        for (place, component) in places.into_iter().zip(vector.iter()) {
            reals[place] = *component;
        }
    }

    let air = &point.air;
    let geometry = rotor.geometry();
    let radius = geometry.radius;
    let tip_speed = point.speed.abs() * radius;
    let reference_force = air.density * PI * radius * radius * tip_speed * tip_speed;
    let per = |quantity: S, reference: S| {
        if tip_speed.value() > STANDSTILL {
            quantity / reference
        } else {
            S::zero()
        }
    };
    let thrust_coefficient = per(thrust, reference_force);
    let torque_coefficient = per(torque, reference_force * radius);
    reals[real::THRUST] = thrust;
    reals[real::TORQUE] = torque;
    reals[real::POWER] = torque * point.speed;
    reals[real::THRUST_COEFFICIENT] = thrust_coefficient;
    reals[real::TORQUE_COEFFICIENT] = torque_coefficient;
    // CP = CQ in these units, but for a rotor that turns backwards.
    reals[real::POWER_COEFFICIENT] = torque_coefficient * point.speed.value().signum();
    reals[real::FIGURE_OF_MERIT] =
        if thrust_coefficient.value() > 0.0 && torque_coefficient.value() > 0.0 {
            thrust_coefficient * thrust_coefficient.sqrt() / (torque_coefficient * SQRT_2)
        } else {
            S::zero()
        };
    reals[real::INDUCED_VELOCITY] = hub.induced_velocity;
    let airspeed = &point.airspeed;
    reals[real::INFLOW_RATIO] = per(airspeed.z + hub.induced_velocity, tip_speed);
    reals[real::ADVANCE_RATIO] = per(airspeed.x.hypot(airspeed.y), tip_speed);
    reals[real::ROTOR_SPEED] = match point.drive {
        Drive::Speed => reals[real::RPM],
        Drive::Torque { .. } => point.speed * 30.0 / PI,
    };
    reals[real::CONING] = hub.tip_path.coning;
    reals[real::LONGITUDINAL_FLAPPING] = hub.tip_path.longitudinal;
    reals[real::LATERAL_FLAPPING] = hub.tip_path.lateral;
    reals[real::STALLED_RADIUS] = S::constant(hub.stalled_radius);
    reals[real::STALLED_FRACTION] = S::constant(hub.stalled_fraction);
    reals[real::TIP_MACH] = tip_speed / air.speed_of_sound;
    reals[real::TIP_REYNOLDS] = air.density * tip_speed * geometry.tip_chord / air.viscosity;
    reals[real::AIR_DENSITY] = air.density;
}

/// Writes what goes on along the blade, at the middles of equal parts from cutout to tip.
pub fn write_stations<S: Scalar>(reals: &mut Reals<S>, rotor: &Rotor, blade: &BladeLoads<S>) {
    let geometry = rotor.geometry();
    let (cutout, blades) = (geometry.cutout(), f64::from(geometry.blades));
    for i in 0..STATIONS {
        let part = (i as f64 + 0.5) / STATIONS as f64;
        let radius = cutout + part * (1.0 - cutout);
        let load = blade.at(radius);
        for (places, value) in [
            (real::STATION__RADIUS, S::constant(radius)),
            (real::STATION__ANGLE_OF_ATTACK, load.angle_of_attack),
            (real::STATION__LIFT_COEFFICIENT, load.lift_coefficient),
            (real::STATION__DRAG_COEFFICIENT, load.drag_coefficient),
            (real::STATION__INDUCED_VELOCITY, load.induced_velocity),
            (real::STATION__REYNOLDS, load.reynolds),
            (real::STATION__MACH, load.mach),
            (real::STATION__THRUST_PER_LENGTH, load.thrust / blades),
        ] {
            reals[places[i]] = value;
        }
    }
}

//! From the response of the rotor to the values of the computed variables.

use super::{
    flight_condition::FlightCondition,
    references::Reals,
    state_vector::{write_derivatives, write_states},
    variables::real,
};
use core::f64::consts::{PI, SQRT_2};
use nalgebra::Matrix3;
use rotor::{BladeLoads, Drive, HubLoads, OperatingPoint, Response, Rotor, State, numbers::Scalar};

/// Number of stations along the blade.
const STATIONS: usize = real::STATION__RADIUS.len();

/// Tip speed, m/s, up to which a rotor counts as stopped. Coefficients have no meaning there.
const STANDSTILL: f64 = 1e-6;

/// Writes all computed variables: the response of the rotor in a state, and the state itself.
pub fn write_response<S: Scalar>(
    reals: &mut Reals<S>,
    rotor: &Rotor,
    condition: &FlightCondition<S>,
    state: &State<S>,
    response: &Response<S>,
) {
    write_outputs(reals, rotor, &response.hub, condition, state);
    write_stations(reals, rotor, &response.blade);
    write_states(reals, state);
    write_derivatives(reals, &response.rates);
}

/// Writes the outputs of the rotor as a whole.
fn write_outputs<S: Scalar>(
    reals: &mut Reals<S>,
    rotor: &Rotor,
    hub: &HubLoads<S>,
    condition: &FlightCondition<S>,
    state: &State<S>,
) {
    let point = &condition.point.at_speed_of(state);
    let geometry = rotor.geometry();
    let air = &point.air;
    let tip_speed = point.speed.abs() * geometry.radius;
    write_forces_and_moments(reals, hub, &condition.shaft.hub_to_ground);
    write_coefficients(reals, hub, point, geometry.radius);
    write_propeller(reals, hub, point, geometry.radius);
    reals[real::THRUST] = hub.force.z;
    reals[real::TORQUE] = hub.torque;
    reals[real::POWER] = hub.torque * point.speed;
    reals[real::INDUCED_VELOCITY] = hub.induced_velocity;
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

/// Writes force and moment on the hub, in the ground frame and in the hub frame.
fn write_forces_and_moments<S: Scalar>(
    reals: &mut Reals<S>,
    hub: &HubLoads<S>,
    hub_to_ground: &Matrix3<S>,
) {
    let force = hub_to_ground * hub.force;
    let moment = hub_to_ground * hub.moment;
    for (references, vector) in [
        ([real::FORCE_1, real::FORCE_2, real::FORCE_3], force),
        ([real::MOMENT_1, real::MOMENT_2, real::MOMENT_3], moment),
        (
            [real::HUB_FORCE_1, real::HUB_FORCE_2, real::HUB_FORCE_3],
            hub.force,
        ),
        (
            [real::HUB_MOMENT_1, real::HUB_MOMENT_2, real::HUB_MOMENT_3],
            hub.moment,
        ),
    ] {
        for (reference, component) in references.into_iter().zip(vector.iter()) {
            reals[reference] = *component;
        }
    }
}

/// Writes the quantities over tip speed and disc area. All are 0 at standstill.
fn write_coefficients<S: Scalar>(
    reals: &mut Reals<S>,
    hub: &HubLoads<S>,
    point: &OperatingPoint<S>,
    radius: f64,
) {
    let tip_speed = point.speed.abs() * radius;
    let reference_force = point.air.density * PI * radius * radius * tip_speed * tip_speed;
    let per = |quantity: S, reference: S| {
        if tip_speed.value() > STANDSTILL {
            quantity / reference
        } else {
            S::zero()
        }
    };
    let thrust_coefficient = per(hub.force.z, reference_force);
    let torque_coefficient = per(hub.torque, reference_force * radius);
    reals[real::THRUST_COEFFICIENT] = thrust_coefficient;
    reals[real::TORQUE_COEFFICIENT] = torque_coefficient;
    // CP = CQ in this convention. A rotor that turns backwards changes the sign.
    reals[real::POWER_COEFFICIENT] = torque_coefficient * point.speed.value().signum();
    reals[real::FIGURE_OF_MERIT] =
        if thrust_coefficient.value() > 0.0 && torque_coefficient.value() > 0.0 {
            thrust_coefficient * thrust_coefficient.sqrt() / (torque_coefficient * SQRT_2)
        } else {
            S::zero()
        };
    let airspeed = &point.airspeed;
    reals[real::INFLOW_RATIO] = per(airspeed.z + hub.induced_velocity, tip_speed);
    reals[real::ADVANCE_RATIO] = per(airspeed.x.hypot(airspeed.y), tip_speed);
}

/// Writes the coefficients by which propellers are known, with revolutions per second and the
/// diameter, as the UIUC Propeller Data Site has them. All are 0 at standstill.
fn write_propeller<S: Scalar>(
    reals: &mut Reals<S>,
    hub: &HubLoads<S>,
    point: &OperatingPoint<S>,
    radius: f64,
) {
    let diameter = 2.0 * radius;
    let revolutions = point.speed.abs() / (2.0 * PI);
    let is_turning = (point.speed.abs() * radius).value() > STANDSTILL;
    let per = |quantity: S, reference: S| {
        if is_turning {
            quantity / reference
        } else {
            S::zero()
        }
    };
    let velocity = revolutions * diameter;
    let force = point.air.density * velocity * velocity * (diameter * diameter);
    let thrust = hub.force.z;
    let power = hub.torque * point.speed;
    let climb = point.airspeed.z;
    reals[real::PROPELLER_THRUST_COEFFICIENT] = per(thrust, force);
    reals[real::PROPELLER_POWER_COEFFICIENT] = per(power, force * velocity);
    reals[real::PROPELLER_ADVANCE_RATIO] = per(climb, velocity);
    // At standstill in the air, or without thrust, the efficiency has a corner.
    let propels = thrust.is_above(0.0) && climb.is_above(0.0) && power.value() > 0.0;
    reals[real::PROPELLER_EFFICIENCY] = if propels && is_turning {
        thrust * climb / power
    } else {
        S::zero()
    };
}

/// Writes the stations along the blade, which are the middles of equal parts from cutout to tip.
fn write_stations<S: Scalar>(reals: &mut Reals<S>, rotor: &Rotor, blade: &BladeLoads<S>) {
    let geometry = rotor.geometry();
    let (cutout, blades) = (geometry.cutout(), f64::from(geometry.blades));
    for i in 0..STATIONS {
        let part = (i as f64 + 0.5) / STATIONS as f64;
        let radius = cutout + part * (1.0 - cutout);
        let load = blade.at(radius);
        for (references, value) in [
            (real::STATION__RADIUS, S::constant(radius)),
            (real::STATION__ANGLE_OF_ATTACK, load.angle_of_attack),
            (real::STATION__LIFT_COEFFICIENT, load.lift_coefficient),
            (real::STATION__DRAG_COEFFICIENT, load.drag_coefficient),
            (real::STATION__INDUCED_VELOCITY, load.induced_velocity),
            (real::STATION__REYNOLDS, load.reynolds),
            (real::STATION__MACH, load.mach),
            (real::STATION__THRUST_PER_LENGTH, load.thrust / blades),
        ] {
            reals[references[i]] = value;
        }
    }
}

//! The flight condition: the operating point that the inputs describe, and the attitude of the
//! shaft.

use super::{
    references::Reals,
    setup::{self, SetupError},
    values::Values,
    variables::{Atmosphere, DriveMode, RealRef, integer, real},
};
use core::f64::consts::PI;
use nalgebra::{Matrix3, Vector3};
use rotor::{
    Drive, OperatingPoint,
    air::{Air, STANDARD_GRAVITY},
    numbers::Scalar,
};

/// The operating point that the inputs describe, and the attitude of the shaft.
pub struct FlightCondition<S = f64> {
    pub shaft: Shaft<S>,
    pub point: OperatingPoint<S>,
}

impl FlightCondition {
    pub fn new(values: &Values) -> Result<Self, SetupError> {
        Self::with_reals(values, &values.reals)
    }
}

impl<S: Scalar> FlightCondition<S> {
    /// The condition for the Real variables `reals`. All others are those of `values`.
    pub fn with_reals(values: &Values, reals: &Reals<S>) -> Result<Self, SetupError> {
        let shaft = Shaft::new(reals);
        let point = OperatingPoint {
            collective: reals[real::COLLECTIVE],
            cyclic_longitudinal: reals[real::CYCLIC_LONGITUDINAL],
            cyclic_lateral: reals[real::CYCLIC_LATERAL],
            speed: reals[real::RPM] * PI / 30.0,
            airspeed: shaft.airspeed,
            angular_velocity: shaft.angular_velocity,
            gravity: shaft.gravity,
            hinge_spring: reals[real::FLAPPING__HINGE_SPRING],
            height: reals[real::HEIGHT_ABOVE_GROUND],
            drive: match setup::choice(values, integer::DRIVE__MODE, DriveMode::from_integer)? {
                DriveMode::Speed => Drive::Speed,
                DriveMode::Torque => Drive::Torque {
                    torque: reals[real::DRIVE_TORQUE],
                    inertia: reals[real::DRIVE__INERTIA].value(),
                },
            },
            air: air(values, reals)?,
        };
        Ok(Self { shaft, point })
    }
}

/// The attitude of the hub frame to the ground, and the motion of the hub in the hub frame.
pub struct Shaft<S = f64> {
    pub hub_to_ground: Matrix3<S>,
    /// Velocity through the air, m/s.
    pub airspeed: Vector3<S>,
    /// rad/s.
    pub angular_velocity: Vector3<S>,
    /// m/s2.
    pub gravity: Vector3<S>,
}

impl<S: Scalar> Shaft<S> {
    /// The hub frame is the ground frame (x forward, y left, z up) turned by `tilt` about its y
    /// axis, and then by `lateralTilt` about the new x axis. Positive tilt leans the shaft forward,
    /// positive lateral tilt leans it to the right.
    pub fn new(reals: &Reals<S>) -> Self {
        let (zero, one) = (S::zero(), S::one());
        let turn = |angle: RealRef| (reals[angle].sin(), reals[angle].cos());
        let (sin_y, cos_y) = turn(real::TILT);
        let (sin_x, cos_x) = turn(real::LATERAL_TILT);
        let tilt = Matrix3::new(cos_y, zero, sin_y, zero, one, zero, -sin_y, zero, cos_y);
        let lateral = Matrix3::new(one, zero, zero, zero, cos_x, -sin_x, zero, sin_x, cos_x);
        let hub_to_ground = tilt * lateral;

        let vector =
            |x: RealRef, y: RealRef, z: RealRef| Vector3::new(reals[x], reals[y], reals[z]);
        let velocity = vector(real::VELOCITY_1, real::VELOCITY_2, real::VELOCITY_3);
        let wind = vector(real::WIND_1, real::WIND_2, real::WIND_3);
        let angular_velocity = vector(
            real::ANGULAR_VELOCITY_1,
            real::ANGULAR_VELOCITY_2,
            real::ANGULAR_VELOCITY_3,
        );
        Self {
            hub_to_ground,
            airspeed: hub_to_ground.tr_mul(&(velocity - wind)),
            angular_velocity: hub_to_ground.tr_mul(&angular_velocity),
            gravity: hub_to_ground.tr_mul(&Vector3::new(
                zero,
                zero,
                S::constant(-STANDARD_GRAVITY),
            )),
        }
    }
}

/// The air at the altitude, or of the given density and temperature.
fn air<S: Scalar>(values: &Values, reals: &Reals<S>) -> Result<Air<S>, SetupError> {
    Ok(
        match setup::choice(values, integer::AIR__ATMOSPHERE, Atmosphere::from_integer)? {
            Atmosphere::Isa => Air::standard(reals[real::ALTITUDE]),
            Atmosphere::UserDefined => {
                Air::new(reals[real::AIR__DENSITY], reals[real::AIR__TEMPERATURE])
            }
        },
    )
}

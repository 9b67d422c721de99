//! What the inputs ask of the rotor.

use super::{
    setup::{self, SetupError},
    values::Values,
    variables::{AirModel, DriveMode, integer, real},
};
use crate::rotor::{
    Drive, Operation,
    air::{Air, STANDARD_GRAVITY},
};
use core::f64::consts::PI;
use nalgebra::{Matrix3, Vector3};

/// What the inputs ask of the rotor, and where its hub is turned to.
pub struct Flight {
    pub shaft: Shaft,
    pub operation: Operation,
}

impl Flight {
    pub fn new(values: &Values) -> Result<Self, SetupError> {
        let reals = &values.reals;
        let shaft = Shaft::new(reals);
        let operation = Operation {
            collective: reals[real::COLLECTIVE],
            cyclic_longitudinal: reals[real::CYCLIC_LONGITUDINAL],
            cyclic_lateral: reals[real::CYCLIC_LATERAL],
            speed: reals[real::RPM] * PI / 30.0,
            airspeed: shaft.airspeed,
            angular_velocity: shaft.angular_velocity,
            gravity: shaft.gravity,
            hinge_spring: reals[real::FLAPPING__HINGE_SPRING],
            height: reals[real::HEIGHT_ABOVE_GROUND],
            drive: match setup::choice(values, integer::DRIVE_MODE, DriveMode::from_integer)? {
                DriveMode::Speed => Drive::Speed,
                DriveMode::Torque => Drive::Torque {
                    torque: reals[real::DRIVE_TORQUE],
                    inertia: reals[real::DRIVE_INERTIA],
                },
            },
            air: air(values)?,
        };
        Ok(Self { shaft, operation })
    }
}

/// The hub frame against the ground, and the hub's motion in the hub frame.
pub struct Shaft {
    pub hub_to_ground: Matrix3<f64>,
    /// Velocity through the air, m/s.
    pub airspeed: Vector3<f64>,
    /// rad/s.
    pub angular_velocity: Vector3<f64>,
    /// m/s2.
    pub gravity: Vector3<f64>,
}

impl Shaft {
    /// The hub frame is the ground frame (x forward, y left, z up) turned by `tilt` about its y
    /// axis, so that positive tilt leans the shaft forward, and then by `lateralTilt` about the x
    /// axis that came of it, so that positive lateral tilt leans the shaft to the right.
    pub fn new(reals: &[f64]) -> Self {
        let turn = |place: usize| (libm::sin(reals[place]), libm::cos(reals[place]));
        let (sin_y, cos_y) = turn(real::TILT);
        let (sin_x, cos_x) = turn(real::LATERAL_TILT);
        let tilt = Matrix3::new(cos_y, 0.0, sin_y, 0.0, 1.0, 0.0, -sin_y, 0.0, cos_y);
        let lateral = Matrix3::new(1.0, 0.0, 0.0, 0.0, cos_x, -sin_x, 0.0, sin_x, cos_x);
        let hub_to_ground = tilt * lateral;

        let vector = |x: usize, y: usize, z: usize| Vector3::new(reals[x], reals[y], reals[z]);
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
            gravity: hub_to_ground.tr_mul(&Vector3::new(0.0, 0.0, -STANDARD_GRAVITY)),
        }
    }
}

fn air(values: &Values) -> Result<Air, SetupError> {
    let reals = &values.reals;
    Ok(
        match setup::choice(values, integer::AIR__MODEL, AirModel::from_integer)? {
            AirModel::Isa => Air::standard(reals[real::ALTITUDE]),
            AirModel::Constant => {
                Air::new(reals[real::AIR__DENSITY], reals[real::AIR__TEMPERATURE])
            }
        },
    )
}

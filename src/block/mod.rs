//! The rotor as a block of named variables: which variable feeds which quantity of the physics.
//! Neutral of the FMI version.

mod coverage;
mod integrate;
mod location;
mod setup;
mod shown;
mod values;
pub mod variables;

pub use location::path_from_uri;
pub use setup::SetupError;
pub use values::{Stage, ValueError, Values};

use crate::rotor::{
    self, Drive, Operation, Performance, Rotor, SolveError, Start,
    air::{Air, STANDARD_GRAVITY},
};
use core::f64::consts::{PI, SQRT_2};
use coverage::Coverage;
use integrate::Memory;
use nalgebra::{Matrix3, Vector3};
use std::path::PathBuf;
use thiserror::Error;
use variables::{AirModel, Causality, DriveMode, FlowState, Initialization, REALS, integer, real};

/// Why the outputs could not be computed; they keep their last values.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum BlockError {
    #[error(transparent)]
    Setup(#[from] SetupError),
    #[error("{0}; check the inputs: {1}")]
    Unsolved(SolveError, String),
    #[error("{name} would be {value}, which is not finite; check the inputs: {inputs}")]
    NotFinite {
        name: &'static str,
        value: f64,
        inputs: String,
    },
}

/// One rotor with the values of all of its variables.
#[derive(Debug)]
pub struct RotorBlock {
    values: Values,
    stage: Stage,
    resources: PathBuf,
    /// None until it is needed, and again when a parameter that shapes it has changed.
    rotor: Option<Rotor>,
    /// The states of the rotor, as of the last step.
    memory: Memory,
    /// Whether the outputs belong to the present inputs and parameters.
    current: bool,
    /// What is worth a line in the log since the last call of `take_notes`.
    notes: Vec<String>,
    coverage: Coverage,
}

impl RotorBlock {
    /// A rotor with default values; `resources` is the folder of the FMU's resources.
    pub fn new(resources: PathBuf) -> Self {
        Self {
            values: Values::default(),
            stage: Stage::Configuring,
            resources,
            rotor: None,
            memory: Memory::default(),
            current: false,
            notes: Vec::new(),
            coverage: Coverage::default(),
        }
    }

    /// Back to the state after `new`.
    pub fn reset(&mut self) {
        *self = Self::new(std::mem::take(&mut self.resources));
    }

    pub fn values(&self) -> &Values {
        &self.values
    }

    /// Sets Real variables: all, or none if one is refused.
    pub fn set_reals(&mut self, references: &[u32], values: &[f64]) -> Result<(), ValueError> {
        self.values.set_reals(self.stage, references, values)?;
        let shapes = |r: &u32| {
            let variable = &REALS[*r as usize];
            variable.causality == Causality::Parameter && !variable.tunable
        };
        let shape_changes = self.stage == Stage::Configuring && references.iter().any(shapes);
        self.invalidate(shape_changes);
        Ok(())
    }

    /// Sets Integer and Enumeration variables: all, or none if one is refused.
    pub fn set_integers(&mut self, references: &[u32], values: &[i32]) -> Result<(), ValueError> {
        self.values.set_integers(self.stage, references, values)?;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    /// Sets Boolean variables, 0 being false and 1 true: all, or none if one is refused.
    pub fn set_booleans(&mut self, references: &[u32], values: &[i32]) -> Result<(), ValueError> {
        self.values.set_booleans(self.stage, references, values)?;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    /// Sets String variables: all, or none if one is refused.
    pub fn set_strings(&mut self, references: &[u32], values: &[&str]) -> Result<(), ValueError> {
        self.values.set_strings(self.stage, references, values)?;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    fn invalidate(&mut self, shape_changes: bool) {
        self.current = false;
        if shape_changes {
            self.rotor = None;
        }
    }

    /// Ends the time in which fixed parameters may change.
    pub fn start(&mut self) -> Result<(), BlockError> {
        self.update()?;
        self.stage = Stage::Running;
        Ok(())
    }

    /// Lets go of the rotor, of which a panic may have left a part undone; the next call makes it anew.
    pub fn forget_rotor(&mut self) {
        self.rotor = None;
        self.current = false;
    }

    /// What was read from which file, and whether the flow went beyond what was read, since the last
    /// call.
    pub fn take_notes(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notes)
    }

    /// Makes the outputs those of the present inputs, parameters and states. While the block is being
    /// configured, the states are those of the start.
    pub fn update(&mut self) -> Result<(), BlockError> {
        if self.current {
            return Ok(());
        }
        let flight = Flight::new(&self.values)?;
        let memory = match self.stage {
            Stage::Running => self.memory,
            Stage::Configuring => {
                let values = &self.values;
                let start = setup::choice(
                    values,
                    integer::INITIALIZATION,
                    Initialization::from_integer,
                )?;
                let start = match start {
                    Initialization::Steady => Start::Steady,
                    Initialization::Rest => Start::Rest,
                };
                let azimuth_step = values.reals[real::NUMERICS__AZIMUTH_STEP];
                let rotor = self.rotor()?;
                let state = rotor.start(&flight.operation, start, azimuth_step);
                Memory::starting(state.map_err(|e| self.unsolved(e))?)
            }
        };
        self.publish(&flight, memory)
    }

    /// Moves on by `duration` s (> 0) with the present inputs, which are constant during it. If that
    /// fails, the states and outputs keep their values.
    pub fn step(&mut self, duration: f64) -> Result<(), BlockError> {
        let flight = Flight::new(&self.values)?;
        let azimuth_step = self.values.reals[real::NUMERICS__AZIMUTH_STEP];
        let (memory, is_current) = (self.memory, self.current);
        let rotor = self.rotor()?;
        let advanced =
            integrate::advance(rotor, &flight.operation, &memory, duration, azimuth_step);
        if is_current
            && !rotor.has_memory(&flight.operation)
            && !rotor.shows_blades(&flight.operation, &memory.state)
            && let Ok(advanced) = advanced
        {
            // A disc that nothing changes answers the same.
            self.memory = advanced;
            self.values.reals[real::AZIMUTH] = advanced.state.azimuth;
            return Ok(());
        }
        let memory = advanced.map_err(|e| self.unsolved(e))?;
        self.publish(&flight, memory)
    }

    /// The rotor of the present parameters.
    fn rotor(&mut self) -> Result<&mut Rotor, BlockError> {
        let rotor = match self.rotor.take() {
            Some(rotor) => rotor,
            None => {
                let (rotor, notes) = setup::rotor(&self.values, &self.resources)?;
                self.notes.extend(notes);
                self.coverage = Coverage::default();
                rotor
            }
        };
        Ok(self.rotor.insert(rotor))
    }

    fn unsolved(&self, error: SolveError) -> BlockError {
        BlockError::Unsolved(error, inputs(&self.values))
    }

    /// Computes the outputs in a flight and takes them and the states over, if all are finite.
    fn publish(&mut self, flight: &Flight, memory: Memory) -> Result<(), BlockError> {
        let mut reals = self.values.reals;
        let rotor = self.rotor()?;
        let performance = match rotor.performance(&flight.operation, &memory.state) {
            Ok(performance) => performance,
            Err(error) => return Err(self.unsolved(error)),
        };
        let turning = flight.operation.at_speed_of(&memory.state);
        write_outputs(&mut reals, rotor, &performance, &flight.shaft, &turning);
        reals[real::AZIMUTH] = memory.state.azimuth;
        write_stations(&mut reals, rotor);
        for (variable, value) in REALS.iter().zip(reals) {
            if variable.causality.is_computed() && !value.is_finite() {
                let inputs = inputs(&self.values);
                return Err(BlockError::NotFinite {
                    name: variable.name,
                    value,
                    inputs,
                });
            }
        }
        self.values.reals = reals;
        let flow_state = match performance.flow_state {
            rotor::inflow::descent::FlowState::Normal => FlowState::Normal,
            rotor::inflow::descent::FlowState::VortexRing => FlowState::VortexRing,
            rotor::inflow::descent::FlowState::TurbulentWake => FlowState::TurbulentWake,
            rotor::inflow::descent::FlowState::WindmillBrake => FlowState::WindmillBrake,
        };
        self.values.integers[integer::FLOW_STATE] = flow_state as i32;
        self.memory = memory;
        self.current = true;
        let rotor = self.rotor.as_ref();
        let note = rotor.and_then(|rotor| self.coverage.note(rotor));
        self.notes.extend(note);
        Ok(())
    }
}

/// What the inputs ask of the rotor, and where its hub is turned to.
struct Flight {
    shaft: Shaft,
    operation: Operation,
}

impl Flight {
    fn new(values: &Values) -> Result<Self, SetupError> {
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
struct Shaft {
    hub_to_ground: Matrix3<f64>,
    /// Velocity through the air, m/s.
    airspeed: Vector3<f64>,
    /// rad/s.
    angular_velocity: Vector3<f64>,
    /// m/s2.
    gravity: Vector3<f64>,
}

impl Shaft {
    /// The hub frame is the ground frame (x forward, y left, z up) turned by `tilt` about its y
    /// axis, so that positive tilt leans the shaft forward, and then by `lateralTilt` about the x
    /// axis that came of it, so that positive lateral tilt leans the shaft to the right.
    fn new(reals: &[f64]) -> Self {
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

/// Number of stations along the blade: of each quantity so many variables stand in a row.
const STATIONS: usize = real::STATION_20__RADIUS - real::STATION_1__RADIUS + 1;

/// Tip speed, m/s, up to which a rotor counts as standing still, where coefficients mean nothing.
const STANDSTILL: f64 = 1e-6;

/// Writes the outputs among the Real variables.
fn write_outputs(
    reals: &mut [f64],
    rotor: &Rotor,
    performance: &Performance,
    shaft: &Shaft,
    operation: &Operation,
) {
    let Performance {
        force: hub_force,
        moment: hub_moment,
        torque,
        ..
    } = *performance;
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

    let air = &operation.air;
    let geometry = rotor.geometry();
    let radius = geometry.radius;
    let tip_speed = operation.speed.abs() * radius;
    let reference_force = air.density * PI * radius * radius * tip_speed * tip_speed;
    let per = |quantity: f64, reference: f64| {
        if tip_speed > STANDSTILL {
            quantity / reference
        } else {
            0.0
        }
    };
    let thrust_coefficient = per(thrust, reference_force);
    let torque_coefficient = per(torque, reference_force * radius);
    reals[real::THRUST] = thrust;
    reals[real::TORQUE] = torque;
    reals[real::POWER] = torque * operation.speed;
    reals[real::THRUST_COEFFICIENT] = thrust_coefficient;
    reals[real::TORQUE_COEFFICIENT] = torque_coefficient;
    // CP = CQ in these units, but for a rotor that turns backwards.
    reals[real::POWER_COEFFICIENT] = torque_coefficient * operation.speed.signum();
    reals[real::FIGURE_OF_MERIT] = if thrust_coefficient > 0.0 && torque_coefficient > 0.0 {
        thrust_coefficient * libm::sqrt(thrust_coefficient) / (SQRT_2 * torque_coefficient)
    } else {
        0.0
    };
    reals[real::INDUCED_VELOCITY] = performance.induced_velocity;
    let airspeed = &operation.airspeed;
    reals[real::INFLOW_RATIO] = per(airspeed.z + performance.induced_velocity, tip_speed);
    reals[real::ADVANCE_RATIO] = per(libm::hypot(airspeed.x, airspeed.y), tip_speed);
    reals[real::ROTOR_SPEED] = match operation.drive {
        Drive::Speed => reals[real::RPM],
        Drive::Torque { .. } => operation.speed * 30.0 / PI,
    };
    reals[real::CONING] = performance.tip_path.coning;
    reals[real::LONGITUDINAL_FLAPPING] = performance.tip_path.longitudinal;
    reals[real::LATERAL_FLAPPING] = performance.tip_path.lateral;
    reals[real::STALLED_RADIUS] = performance.stalled_radius;
    reals[real::STALLED_FRACTION] = performance.stalled_fraction;
    reals[real::TIP_MACH] = tip_speed / air.speed_of_sound;
    reals[real::TIP_REYNOLDS] = air.density * tip_speed * geometry.tip_chord / air.viscosity;
    reals[real::AIR_DENSITY] = air.density;
}

/// Writes what goes on along the blade, at the middles of equal parts from cutout to tip.
fn write_stations(reals: &mut [f64], rotor: &Rotor) {
    let geometry = rotor.geometry();
    let (cutout, blades) = (geometry.cutout(), f64::from(geometry.blades));
    for i in 0..STATIONS {
        let part = (i as f64 + 0.5) / STATIONS as f64;
        let radius = cutout + part * (1.0 - cutout);
        let load = rotor.load_at(radius);
        for (first, value) in [
            (real::STATION_1__RADIUS, radius),
            (real::STATION_1__ANGLE_OF_ATTACK, load.angle_of_attack),
            (real::STATION_1__LIFT_COEFFICIENT, load.lift_coefficient),
            (real::STATION_1__DRAG_COEFFICIENT, load.drag_coefficient),
            (real::STATION_1__INDUCED_VELOCITY, load.induced_velocity),
            (real::STATION_1__REYNOLDS, load.reynolds),
            (real::STATION_1__MACH, load.mach),
            (real::STATION_1__THRUST_PER_LENGTH, load.thrust / blades),
        ] {
            reals[first + i] = value;
        }
    }
}

/// The inputs as a text for errors.
fn inputs(values: &Values) -> String {
    let inputs = REALS
        .iter()
        .zip(values.reals)
        .filter(|(v, _)| v.causality == Causality::Input);
    let texts = inputs.map(|(v, value)| format!("{} = {} {}", v.name, shown::shown(value), v.unit));
    texts.collect::<Vec<_>>().join(", ")
}

//! Everything that a simulation needs to continue from: copied from a block and put back into one.

use super::{
    BlockError, Fresh, RotorBlock,
    computation::MadeRotor,
    files::FileHash,
    integrate::{LONGEST_CELL, Memory, Since, Step},
    ramp::Slopes,
    state_vector::{from_vector, read_states, to_vector, write_states},
    values::{MAX_TEXT, Stage, Values},
    variables::{Causality, INTEGERS, REALS, STRINGS, integer},
};
use crate::host::memory::Watch;
use nalgebra::Vector3;
use rotor::{Drive, OperatingPoint, State, air::Air};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A copy of what a block knows, without its rotor, which follows from the parameters and from the
/// files that they name. Hashes of these files tell whether they have changed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    values: Values,
    stage: Stage,
    slopes: Slopes,
    past_slopes: Slopes,
    #[serde(with = "vector")]
    state: State,
    since: Option<GridPoint>,
    fresh: Fresh,
    flow_state: i32,
    has_start: bool,
    /// Of the rotor; empty if it has not been made yet.
    files: Vec<FileHash>,
}

/// Why a deserialized snapshot was not written by a block.
#[derive(Debug, Error, Clone, PartialEq, Eq)]
#[error("it holds a value that {0} cannot have")]
pub struct Contradiction(&'static str);

impl RotorBlock {
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            values: self.values.clone(),
            stage: self.stage,
            slopes: self.ramp.slopes,
            past_slopes: self.ramp.past,
            state: self.memory.state,
            since: self.memory.since.map(GridPoint),
            fresh: self.fresh,
            flow_state: self.flow_state,
            has_start: self.has_start,
            files: if self.rotor.is_some() {
                self.files.iter().map(|file| file.content.clone()).collect()
            } else {
                self.saved_files.clone()
            },
        }
    }

    /// Continues from a copy, which may be another block's. If its fixed parameters differ from
    /// this block's, the rotor is built again from the files that they name; if that fails, nothing
    /// has changed.
    ///
    /// A file whose content is not that of the copy is a warning in the notes, now or, before
    /// initialisation, when the rotor is built. It is no error: by the FMI standard the call is
    /// legal, and a user may have improved the file on purpose. But without a word the simulation
    /// would continue with other loads.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), BlockError> {
        let watch = Watch::begin();
        let is_same = have_equal_shape(&self.values, &snapshot.values);
        let (values, files) = (snapshot.values.clone(), snapshot.files.clone());
        let is_configuring = snapshot.stage == Stage::Configuring;
        let made = if is_configuring || (is_same && self.rotor.is_some()) {
            None
        } else {
            Some(MadeRotor::of(&values, None, &self.resources)?)
        };
        if watch.is_short() {
            return Err(BlockError::NoMemory);
        }
        if let Some(made) = made {
            // Those of a state that was restored before this one do not count.
            self.saved_files.clear();
            self.take_over(made);
        } else if is_configuring && !is_same {
            // As before initialisation, the rotor is built when it is needed.
            self.forget_rotor();
        }
        if self.rotor.is_some() {
            self.compare_files(&snapshot.files);
        } else {
            self.saved_files = files;
        }
        self.values = values;
        self.stage = snapshot.stage;
        self.ramp.slopes = snapshot.slopes;
        self.ramp.past = snapshot.past_slopes;
        self.memory = Memory {
            state: snapshot.state,
            since: snapshot.since.as_ref().map(|since| since.0),
        };
        self.fresh = snapshot.fresh;
        self.flow_state = snapshot.flow_state;
        self.has_start = snapshot.has_start;
        Ok(())
    }
}

/// Whether the fixed parameters are equal, so that they describe the same rotor.
fn have_equal_shape(a: &Values, b: &Values) -> bool {
    let reals = REALS.iter().zip(a.reals.iter().zip(&b.reals));
    let integers = INTEGERS.iter().zip(a.integers.iter().zip(&b.integers));
    reals.into_iter().all(|(v, (a, b))| {
        v.causality != Causality::Parameter || v.tunable || a.to_bits() == b.to_bits()
    }) && integers
        .into_iter()
        .all(|(v, (a, b))| v.causality != Causality::Parameter || a == b)
        && a.booleans == b.booleans
        && a.strings == b.strings
}

impl Snapshot {
    pub fn stage(&self) -> Stage {
        self.stage
    }

    /// Refuses a deserialized snapshot that no block can have written: values that are out of their
    /// ranges, not finite or that contradict each other.
    pub fn check(&self) -> Result<(), Contradiction> {
        let wrong = |name| Err(Contradiction(name));
        for (variable, value) in REALS.iter().zip(self.values.reals) {
            let is_in_range =
                variable.causality.is_computed() || (variable.min..=variable.max).contains(&value);
            if !value.is_finite() || !is_in_range {
                return wrong(variable.name);
            }
        }
        for slopes in [&self.slopes, &self.past_slopes] {
            for (variable, slope) in REALS.iter().zip(slopes) {
                if !slope.is_finite() {
                    return wrong(variable.name);
                }
            }
        }
        for (variable, value) in INTEGERS.iter().zip(self.values.integers) {
            if !(variable.min..=variable.max).contains(&value) {
                return wrong(variable.name);
            }
        }
        let flow = integer::FLOW_STATE.variable();
        if !(flow.min..=flow.max).contains(&self.flow_state) {
            return wrong(flow.name);
        }
        for (variable, text) in STRINGS.iter().zip(&self.values.strings) {
            if text.contains('\0') || text.len() > MAX_TEXT {
                return wrong(variable.name);
            }
        }
        if !self.values.from_file.is_sound() {
            return wrong("a variable that a rotor file gave");
        }
        if !is_finite(&self.state) {
            return wrong("a continuous state");
        }
        if let Some(GridPoint(since)) = &self.since
            && (!is_finite(&since.state)
                || !is_point_finite(&since.point)
                || !(0.0..=LONGEST_CELL).contains(&since.elapsed)
                || !(0.0..=LONGEST_CELL).contains(&since.step.duration)
                || (since.left > 0 && since.step.duration == 0.0)
                || (since.left > 0 && since.elapsed > since.step.duration)
                || (since.left == 0 && since.elapsed > 0.0))
        {
            return wrong("the integration");
        }
        // Once initialised, the block shows its states among the values.
        let mut reals = self.values.reals;
        write_states(&mut reals, &self.state);
        let is_shown = read_states(&self.values.reals) == read_states(&reals);
        if self.stage != Stage::Configuring && !is_shown {
            return wrong("a continuous state");
        }
        Ok(())
    }
}

fn is_finite(state: &State) -> bool {
    to_vector(state).iter().all(|value| value.is_finite())
}

fn is_point_finite(point: &OperatingPoint) -> bool {
    let OperatingPoint {
        collective,
        cyclic_longitudinal,
        cyclic_lateral,
        speed,
        airspeed,
        angular_velocity,
        gravity,
        hinge_spring,
        height,
        drive,
        air,
    } = *point;
    let (torque, inertia) = match drive {
        Drive::Speed => (0.0, 0.0),
        Drive::Torque { torque, inertia } => (torque, inertia),
    };
    let controls = [collective, cyclic_longitudinal, cyclic_lateral, speed];
    let others = [hinge_spring, height, torque, inertia];
    let air = [air.density, air.speed_of_sound, air.viscosity];
    let vectors = [airspeed, angular_velocity, gravity];
    let components = vectors.iter().flat_map(|vector| vector.iter());
    let numbers = controls.iter().chain(&others).chain(&air);
    numbers.chain(components).all(|number| number.is_finite())
}

// ------------------------------------------------------------------ serialized types of rotor

/// A state as the vector of the continuous states.
mod vector {
    use super::*;
    use serde::{Deserializer, Serializer, de::Error};

    pub fn serialize<S: Serializer>(state: &State, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(to_vector(state))
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<State, D::Error> {
        let vector = Vec::<f64>::deserialize(deserializer)?.try_into();
        let vector = vector.map_err(|_| D::Error::custom("another number of states"))?;
        Ok(from_vector(&vector))
    }
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct GridPoint(#[serde(with = "SinceFields")] Since);

#[derive(Serialize, Deserialize)]
#[serde(remote = "Since")]
struct SinceFields {
    #[serde(with = "OperatingPointFields")]
    point: OperatingPoint,
    #[serde(with = "vector")]
    state: State,
    elapsed: f64,
    #[serde(with = "StepFields")]
    step: Step,
    left: u32,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Step")]
struct StepFields {
    duration: f64,
    is_stiff: bool,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "OperatingPoint")]
struct OperatingPointFields {
    collective: f64,
    cyclic_longitudinal: f64,
    cyclic_lateral: f64,
    speed: f64,
    #[serde(with = "VectorFields")]
    airspeed: Vector3<f64>,
    #[serde(with = "VectorFields")]
    angular_velocity: Vector3<f64>,
    #[serde(with = "VectorFields")]
    gravity: Vector3<f64>,
    hinge_spring: f64,
    height: f64,
    #[serde(with = "DriveFields")]
    drive: Drive,
    #[serde(with = "AirFields")]
    air: Air,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Vector3<f64>")]
struct VectorFields {
    #[serde(getter = "components")]
    components: [f64; 3],
}

fn components(vector: &Vector3<f64>) -> [f64; 3] {
    (*vector).into()
}

impl From<VectorFields> for Vector3<f64> {
    fn from(fields: VectorFields) -> Self {
        fields.components.into()
    }
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Drive")]
enum DriveFields {
    Speed,
    Torque { torque: f64, inertia: f64 },
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Air")]
struct AirFields {
    density: f64,
    speed_of_sound: f64,
    viscosity: f64,
}

#[cfg(test)]
mod tests {
    use super::super::variables::{real, string};
    use super::*;

    fn operating_point() -> OperatingPoint {
        OperatingPoint {
            collective: 0.1,
            cyclic_longitudinal: 0.2,
            cyclic_lateral: 0.3,
            speed: 4.0,
            airspeed: Vector3::new(5.0, 6.0, 7.0),
            angular_velocity: Vector3::new(8.0, 9.0, 10.0),
            gravity: Vector3::new(11.0, 12.0, 13.0),
            hinge_spring: 14.0,
            height: 15.0,
            drive: Drive::Torque {
                torque: 16.0,
                inertia: 17.0,
            },
            air: Air {
                density: 18.0,
                speed_of_sound: 19.0,
                viscosity: 20.0,
            },
        }
    }

    #[test]
    fn a_snapshot_is_read_as_it_was_written() {
        let mut block = RotorBlock::new("/nowhere".into());
        block.set_reals(&[real::COLLECTIVE], &[0.2]).unwrap();
        block.set_input_slopes(&[real::RPM], &[0.25]).unwrap();
        block.set_strings(&[string::AIRFOIL__FILE], &["ü"]).unwrap();
        let mut snapshot = block.snapshot();
        snapshot.since = Some(GridPoint(Since {
            point: operating_point(),
            state: from_vector(&core::array::from_fn(|i| i as f64)),
            elapsed: 0.01,
            step: Step {
                duration: 0.015,
                is_stiff: true,
            },
            left: 3,
        }));
        let written = postcard::to_allocvec(&snapshot).unwrap();
        let read: Snapshot = postcard::from_bytes(&written).unwrap();
        assert_eq!(read, snapshot);
        assert_eq!(read.check(), Ok(()));
        for end in 0..written.len() {
            assert!(postcard::from_bytes::<Snapshot>(&written[..end]).is_err());
        }
    }

    /// Each kind of value that no block can hold.
    #[test]
    fn values_that_no_block_has_are_refused_by_name() {
        let good = RotorBlock::new("/nowhere".into()).snapshot();
        assert_eq!(good.check(), Ok(()));
        let refused = |change: &dyn Fn(&mut Snapshot)| {
            let mut bad = good.clone();
            change(&mut bad);
            bad.check().unwrap_err().0
        };
        let blades = integer::GEOMETRY__NUMBER_OF_BLADES;
        assert_eq!(
            refused(&|s| s.values.reals[real::COLLECTIVE] = f64::NAN),
            "collective"
        );
        assert_eq!(refused(&|s| s.values.reals[real::RPM] = -1.0), "rpm");
        assert_eq!(refused(&|s| s.slopes[1] = f64::INFINITY), "rpm");
        assert_eq!(refused(&|s| s.past_slopes[0] = f64::NAN), "collective");
        assert_eq!(
            refused(&|s| s.values.integers[blades] = 0),
            blades.variable().name
        );
        assert_eq!(refused(&|s| s.flow_state = 9), "flowState");
        assert_eq!(
            refused(&|s| s.values.strings[string::AIRFOIL__FILE] = "\0".into()),
            string::AIRFOIL__FILE.variable().name
        );
        assert_eq!(
            refused(&|s| s.state.azimuth = f64::NAN),
            "a continuous state"
        );
        let late = |s: &mut Snapshot, (elapsed, duration, left)| {
            s.since = Some(GridPoint(Since {
                point: operating_point(),
                state: State::default(),
                elapsed,
                step: Step {
                    duration,
                    is_stiff: false,
                },
                left,
            }));
        };
        // Elapsed time, duration of the step and steps left.
        for wrong in [
            (2.0 * LONGEST_CELL, LONGEST_CELL, 1),
            (0.0, 2.0 * LONGEST_CELL, 1),
            (0.0, f64::NAN, 1),
            (0.01, 0.005, 1),
            (0.01, 0.02, 0),
            (0.0, 0.0, 1),
        ] {
            assert_eq!(refused(&|s| late(s, wrong)), "the integration");
        }
        let nowhere = |s: &mut Snapshot| {
            let mut point = operating_point();
            point.airspeed.y = f64::NAN;
            s.since = Some(GridPoint(Since {
                point,
                state: State::default(),
                elapsed: 0.0,
                step: Step::default(),
                left: 0,
            }));
        };
        assert_eq!(refused(&nowhere), "the integration");
        let contradicting = |s: &mut Snapshot| {
            s.stage = Stage::Running;
            s.state.azimuth = 1.0;
        };
        assert_eq!(refused(&contradicting), "a continuous state");
    }
}

//! All of a block that a simulation needs to go on from: copied, put back, and as bytes.

use super::{
    BlockError, Fresh, RotorBlock,
    bytes::{DecodeError, Reader},
    integrate::{LONGEST_CELL, Memory, Since},
    ramp::Slopes,
    references::Reals,
    setup,
    state_vector::{from_vector, read_states, to_vector, write_states},
    values::{Stage, Values},
    variables::{Causality, INTEGERS, REALS, STRINGS, integer},
};
use nalgebra::Vector3;
use rotor::{Drive, OperatingPoint, State, air::Air};

/// A copy of what a block knows, without its rotor, which follows from the parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    values: Values,
    stage: Stage,
    slopes: Slopes,
    past_slopes: Slopes,
    memory: Memory,
    fresh: Fresh,
    flow_state: i32,
}

impl RotorBlock {
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            values: self.values.clone(),
            stage: self.stage,
            slopes: self.ramp.slopes,
            past_slopes: self.ramp.past,
            memory: self.memory,
            fresh: self.fresh,
            flow_state: self.flow_state,
        }
    }

    /// Goes on from a copy, also from another block's. If its fixed parameters differ from those of
    /// this block, the rotor is made anew from the files that they name; if that fails, nothing has
    /// changed.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), BlockError> {
        let is_same = have_equal_shape(&self.values, &snapshot.values);
        if snapshot.stage == Stage::Configuring {
            // As before any initialisation: the rotor is made when it is needed.
            if !is_same {
                self.rotor = None;
            }
        } else if !is_same || self.rotor.is_none() {
            let (rotor, notes) = setup::rotor(&snapshot.values, &self.resources)?;
            self.take_over(rotor, notes);
        }
        self.values.clone_from(&snapshot.values);
        self.stage = snapshot.stage;
        self.ramp.slopes = snapshot.slopes;
        self.ramp.past = snapshot.past_slopes;
        self.memory = snapshot.memory;
        self.fresh = snapshot.fresh;
        self.flow_state = snapshot.flow_state;
        Ok(())
    }
}

/// Whether the fixed parameters are equal, so that they make the same rotor.
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

    /// Appends the copy as bytes, the same on every platform: numbers in little-endian order, texts
    /// with their length before them.
    pub fn write(&self, out: &mut Vec<u8>) {
        let mut reals = |values: &[f64]| {
            values
                .iter()
                .for_each(|v| out.extend_from_slice(&v.to_le_bytes()));
        };
        reals(&*self.values.reals);
        reals(&self.slopes);
        reals(&self.past_slopes);
        reals(&to_vector(&self.memory.state));
        if let Some(since) = &self.memory.since {
            reals(&[1.0]);
            reals(&operation_to_numbers(&since.point));
            reals(&to_vector(&since.state));
            reals(&[since.elapsed]);
        } else {
            reals(&[0.0]);
        }
        for value in self.values.integers.iter().chain([&self.flow_state]) {
            out.extend_from_slice(&value.to_le_bytes());
        }
        out.extend(self.values.booleans.map(u8::from));
        out.push(match self.stage {
            Stage::Configuring => 0,
            Stage::Running => 1,
            Stage::Integrating => 2,
        });
        out.push(match self.fresh {
            Fresh::Nothing => 0,
            Fresh::Derivatives => 1,
            Fresh::All => 2,
        });
        for text in &self.values.strings {
            out.extend_from_slice(&(text.len() as u32).to_le_bytes());
            out.extend_from_slice(text.as_bytes());
        }
    }

    /// Reads what `write` wrote. Bytes that no block can have written are refused: values that are
    /// out of their ranges, not finite or that contradict each other.
    pub fn read(reader: &mut Reader) -> Result<Self, DecodeError> {
        let mut values = Values {
            reals: Reals::new(reader.reals()?),
            ..Values::default()
        };
        let slopes = reader.reals()?;
        let past_slopes = reader.reals()?;
        let state = from_vector(&reader.reals()?);
        let [is_since] = reader.reals()?;
        let since = match is_since {
            0.0 => None,
            1.0 => Some(read_since(reader)?),
            _ => return Err(DecodeError::Value("the integration".into())),
        };
        for value in values.integers.iter_mut() {
            *value = reader.integer()?;
        }
        let flow_state = reader.integer()?;
        for value in values.booleans.iter_mut() {
            *value = match reader.byte()? {
                0 => false,
                1 => true,
                _ => return Err(DecodeError::Value("a Boolean variable".into())),
            };
        }
        let stage = match reader.byte()? {
            0 => Stage::Configuring,
            1 => Stage::Running,
            2 => Stage::Integrating,
            _ => return Err(DecodeError::Value("the stage".into())),
        };
        let fresh = match reader.byte()? {
            0 => Fresh::Nothing,
            1 => Fresh::Derivatives,
            2 => Fresh::All,
            _ => return Err(DecodeError::Value("the outputs".into())),
        };
        for text in values.strings.iter_mut() {
            *text = reader.text()?;
        }
        let snapshot = Self {
            values,
            stage,
            slopes,
            past_slopes,
            memory: Memory { state, since },
            fresh,
            flow_state,
        };
        snapshot.check()?;
        Ok(snapshot)
    }

    /// What holds for every block.
    fn check(&self) -> Result<(), DecodeError> {
        let wrong = |name: &str| Err(DecodeError::Value(name.to_owned()));
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
            if text.contains('\0') {
                return wrong(variable.name);
            }
        }
        if !is_finite(&self.memory.state) {
            return wrong("a continuous state");
        }
        // The states stand among the values from the end of the initialisation on.
        let mut reals = self.values.reals;
        write_states(&mut reals, &self.memory.state);
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

fn read_since(reader: &mut Reader) -> Result<Since, DecodeError> {
    let operation = operation_from_numbers(&reader.reals()?)?;
    let state = from_vector(&reader.reals()?);
    let [elapsed] = reader.reals()?;
    if !is_finite(&state) || !(0.0..=LONGEST_CELL).contains(&elapsed) {
        return Err(DecodeError::Value("the integration".into()));
    }
    Ok(Since {
        point: operation,
        state,
        elapsed,
    })
}

/// How many numbers an operation is.
const OPERATION: usize = 21;

fn operation_to_numbers(operation: &OperatingPoint) -> [f64; OPERATION] {
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
    } = *operation;
    let (is_driven, torque, inertia) = match drive {
        Drive::Speed => (0.0, 0.0, 0.0),
        Drive::Torque { torque, inertia } => (1.0, torque, inertia),
    };
    [
        collective,
        cyclic_longitudinal,
        cyclic_lateral,
        speed,
        airspeed.x,
        airspeed.y,
        airspeed.z,
        angular_velocity.x,
        angular_velocity.y,
        angular_velocity.z,
        gravity.x,
        gravity.y,
        gravity.z,
        hinge_spring,
        height,
        is_driven,
        torque,
        inertia,
        air.density,
        air.speed_of_sound,
        air.viscosity,
    ]
}

/// What `operation_to_numbers` made numbers of. The block only compares it with the present
/// operation.
fn operation_from_numbers(numbers: &[f64; OPERATION]) -> Result<OperatingPoint, DecodeError> {
    let vector = |first: usize| Vector3::from_column_slice(&numbers[first..first + 3]);
    let drive = match numbers[15] {
        0.0 => Drive::Speed,
        1.0 => Drive::Torque {
            torque: numbers[16],
            inertia: numbers[17],
        },
        _ => return Err(DecodeError::Value("the integration".into())),
    };
    Ok(OperatingPoint {
        collective: numbers[0],
        cyclic_longitudinal: numbers[1],
        cyclic_lateral: numbers[2],
        speed: numbers[3],
        airspeed: vector(4),
        angular_velocity: vector(7),
        gravity: vector(10),
        hinge_spring: numbers[13],
        height: numbers[14],
        drive,
        air: Air {
            density: numbers[18],
            speed_of_sound: numbers[19],
            viscosity: numbers[20],
        },
    })
}

#[cfg(test)]
mod tests {
    use super::super::variables::{real, string};
    use super::*;

    fn bytes(snapshot: &Snapshot) -> Vec<u8> {
        let mut bytes = Vec::new();
        snapshot.write(&mut bytes);
        bytes
    }

    #[test]
    fn an_operation_makes_the_numbers_of_which_it_was_made() {
        let mut numbers: [f64; OPERATION] = core::array::from_fn(|i| i as f64 + 0.5);
        numbers[15] = 1.0;
        let operation = operation_from_numbers(&numbers).unwrap();
        assert_eq!(operation_to_numbers(&operation), numbers);
        numbers[15] = 2.0;
        assert!(operation_from_numbers(&numbers).is_err());
    }

    #[test]
    fn bytes_make_the_snapshot_of_which_they_were_made_and_end_with_it() {
        let mut block = RotorBlock::new("/nowhere".into());
        block.set_reals(&[real::COLLECTIVE], &[0.2]).unwrap();
        block.set_input_slopes(&[real::RPM], &[0.25]).unwrap();
        block.set_strings(&[string::AIRFOIL__FILE], &["ü"]).unwrap();
        let snapshot = block.snapshot();
        let written = bytes(&snapshot);
        let mut reader = Reader::new(&written);
        assert_eq!(Snapshot::read(&mut reader).unwrap(), snapshot);
        assert!(reader.end().is_ok());
        for end in 0..written.len() {
            let error = Snapshot::read(&mut Reader::new(&written[..end])).unwrap_err();
            assert_eq!(error, DecodeError::Short);
        }
    }

    /// Each kind of value that no block can hold.
    #[test]
    fn values_that_no_block_has_are_refused_by_name() {
        let good = RotorBlock::new("/nowhere".into()).snapshot();
        let refused = |change: &dyn Fn(&mut Snapshot)| {
            let mut bad = good.clone();
            change(&mut bad);
            match Snapshot::read(&mut Reader::new(&bytes(&bad))) {
                Err(DecodeError::Value(name)) => name,
                other => panic!("{other:?}"),
            }
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
            refused(&|s| s.memory.state.azimuth = f64::NAN),
            "a continuous state"
        );
        let contradicting = |s: &mut Snapshot| {
            s.stage = Stage::Running;
            s.memory.state.azimuth = 1.0;
        };
        assert_eq!(refused(&contradicting), "a continuous state");
    }
}

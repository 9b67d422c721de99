//! The same bits on every platform: flights that one platform records and the others repeat.
//! `.ci/platforms` runs these tests on each platform, with the libraries of one .fmu.

use crate::support::{Instance, c, instance::reference};
use helicopter_rotor::block::variables::{REALS, STATES};
use std::{env, ffi::c_int, fs, path::PathBuf};

/// Where the flights are recorded.
const FLIGHTS: &str = "HELICOPTER_ROTOR_FLIGHTS";
/// Items of `models.inflow`: 1 to this.
const INFLOW_MODELS: c_int = 13;
/// `annulusClosedForm`.
const CLOSED_FORM: c_int = 1;
/// Communication steps of a flight, and their size: 1 s.
const STEPS: u32 = 100;
const STEP: f64 = 0.01;
/// Steps from another platform's state.
const STEPS_ON: u32 = 10;
/// Larger than usual, in rad: an emulator takes its time.
const AZIMUTH_STEP: f64 = 0.3;

/// A flight: an inflow model, and whether the blades flap.
#[derive(Clone, Copy)]
struct Flight {
    inflow: c_int,
    flapping: bool,
}

fn flights() -> impl Iterator<Item = Flight> {
    let of_model = |inflow| [false, true].map(|flapping| Flight { inflow, flapping });
    // It holds for blades that do not flap only, and refuses others.
    let is_refused = |flight: &Flight| flight.flapping && flight.inflow == CLOSED_FORM;
    let all = (1..=INFLOW_MODELS).flat_map(of_model);
    all.filter(move |flight| !is_refused(flight))
}

/// What a flight gives: the state in its middle, and the numbers before and after it, all as bytes.
#[derive(PartialEq)]
struct Record {
    before: Vec<u8>,
    middle: Vec<u8>,
    after: Vec<u8>,
}

impl Flight {
    fn begin(self) -> Instance<'static> {
        let instance = Instance::new();
        self.choose(&instance);
        instance.initialize();
        instance
    }

    fn choose(self, instance: &Instance) {
        let inflow = instance.set_integer("models.inflow", self.inflow);
        let flapping = instance.set_boolean("flapping.enabled", self.flapping.into());
        assert_eq!((inflow, flapping), (c::OK, c::OK));
        for (name, value) in [
            ("velocity[1]", 15.3),
            ("numerics.azimuthStep", AZIMUTH_STEP),
        ] {
            assert_eq!(instance.set_real(name, value), c::OK, "{name}");
        }
    }

    /// Steps with moving inputs. Returns all numbers after each of them.
    fn steps(self, instance: &Instance, steps: std::ops::Range<u32>) -> Vec<u8> {
        let mut bytes = Vec::new();
        for i in steps {
            // Up and down, twice.
            let height = f64::from((i % 50).abs_diff(25)) / 25.0;
            let inputs = [
                ("collective", 0.1 + 0.08 * height),
                ("cyclicLongitudinal", 0.03 - 0.05 * height),
                ("tilt", 0.1 * height),
                ("wind[3]", 2.0 - 3.0 * height),
            ];
            for (name, value) in inputs {
                assert_eq!(instance.set_real(name, value), c::OK, "{name}");
            }
            assert_eq!(instance.set_slope("velocity[1]", 0.7), c::OK);
            let status = instance.step(STEP * f64::from(i), STEP);
            assert_eq!(status, c::OK, "{self}: {:?}", instance.take_log());
            put(&mut bytes, &instance.reals());
        }
        bytes
    }

    /// Derivatives of outputs by inputs and time, and the state.
    fn derivatives_and_state(instance: &Instance) -> Vec<u8> {
        let mut bytes = Vec::new();
        for unknown in ["thrust", "hubMoment[1]", "power"] {
            let by = ["collective", "velocity[3]", "rpm"];
            put(
                &mut bytes,
                &by.map(|known| instance.derivative(unknown, known)),
            );
        }
        let mut slope = [0.0];
        let thrust = [reference(&REALS, "thrust")];
        let status = instance.output_derivatives(&thrust, &[1], &mut slope);
        assert_eq!(status, c::OK);
        put(&mut bytes, &slope);
        bytes.extend(instance.state().serialize());
        bytes
    }

    /// Derivatives of the states in Model Exchange, in the state and with the inputs of an instance
    /// in Co-Simulation.
    fn rates(self, other: &Instance) -> Vec<u8> {
        let instance = Instance::for_model_exchange();
        self.choose(&instance);
        instance.begin_integration();
        let reals = other.reals();
        let states: Vec<f64> = STATES
            .iter()
            .map(|s| reals[s.value.number() as usize])
            .collect();
        assert_eq!(instance.set_states(&states), c::OK);
        let mut bytes = Vec::new();
        put(&mut bytes, &instance.derivatives());
        bytes
    }

    fn fly(self) -> Record {
        let instance = self.begin();
        let mut before = Vec::new();
        put(&mut before, &instance.reals());
        before.extend(self.steps(&instance, 0..STEPS / 2));
        let middle = instance.state().serialize();
        let mut after = self.steps(&instance, STEPS / 2..STEPS);
        after.extend(Self::derivatives_and_state(&instance));
        after.extend(self.rates(&instance));
        Record {
            before,
            middle,
            after,
        }
    }

    /// The begin of the second half, from a state that another platform has written.
    fn go_on(self, middle: &[u8]) -> Vec<u8> {
        let instance = Instance::new();
        {
            let state = instance.deserialize(middle);
            let state = state.unwrap_or_else(|_| panic!("{self}: {:?}", instance.take_log()));
            assert_eq!(instance.set_state(&state), c::OK);
        }
        self.steps(&instance, STEPS / 2..STEPS / 2 + STEPS_ON)
    }

    fn files(self) -> [PathBuf; 3] {
        let folder = env::var_os(FLIGHTS).unwrap_or_else(|| panic!("set {FLIGHTS} to a folder"));
        let folder = PathBuf::from(folder);
        ["before", "middle", "after"].map(|part| folder.join(format!("{self}.{part}")))
    }
}

impl std::fmt::Display for Flight {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let blades = if self.flapping { "flapping" } else { "rigid" };
        write!(f, "inflow-{}-{blades}", self.inflow)
    }
}

fn put(bytes: &mut Vec<u8>, numbers: &[f64]) {
    bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
}

#[test]
#[ignore = "writes files for the other platforms; see .ci/platforms"]
fn flights_are_recorded() {
    for flight in flights() {
        let record = flight.fly();
        let parts = [record.before, record.middle, record.after];
        for (file, bytes) in flight.files().iter().zip(parts) {
            fs::write(file, bytes).unwrap();
        }
    }
}

#[test]
#[ignore = "needs the flights of another platform; see .ci/platforms"]
fn flights_have_the_bits_of_those_recorded_and_go_on_from_their_states() {
    for flight in flights() {
        let [before, middle, after] = flight.files().map(|file| fs::read(file).unwrap());
        let record = flight.fly();
        assert_same(&record.before, &before, flight);
        assert!(record.middle == middle, "{flight}: another state");
        assert_same(&record.after, &after, flight);
        let on = flight.go_on(&middle);
        assert_same(&on, &after[..on.len()], flight);
    }
}

fn assert_same(bytes: &[u8], recorded: &[u8], flight: Flight) {
    assert_eq!(bytes.len(), recorded.len(), "{flight}");
    if let Some(place) = bytes.iter().zip(recorded).position(|(a, b)| a != b) {
        let number = place / 8;
        panic!(
            "{flight}: another bit in number {} of step {}",
            number % REALS.len(),
            number / REALS.len()
        );
    }
}

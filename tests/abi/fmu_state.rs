//! The complete state of an instance: taken, set, freed, and gone on from as if it had never been
//! left.

use crate::support::{
    Creation, Fmu, Instance,
    c::{self, Status},
    fmu::{scratch, uri},
    instance::{State, bits, reference},
};
use helicopter_rotor::block::variables::{BOOLEANS, INTEGERS, REALS, STATES, STRINGS};
use std::{fs, ptr};

/// A rotor with everything that can have a memory, or nothing.
#[derive(Clone, Copy, Debug)]
pub struct Rotor {
    pub inflow: &'static str,
    pub flapping: bool,
    pub is_driven: bool,
    pub tip_loss: i32,
}

/// Every inflow model, with and without flapping and drive by torque; the tip losses in turn.
pub fn rotors() -> Vec<Rotor> {
    let mut rotors = Vec::new();
    for inflow in INTEGERS[reference(&INTEGERS, "models.inflow") as usize].choices {
        for (flapping, is_driven) in [(false, false), (true, false), (false, true), (true, true)] {
            if *inflow != "annulusClosedForm" || !flapping {
                let tip_loss = 1 + rotors.len() as i32 % 7;
                rotors.push(Rotor {
                    inflow,
                    flapping,
                    is_driven,
                    tip_loss,
                });
            }
        }
    }
    rotors
}

pub fn configure(instance: &Instance, rotor: Rotor) {
    let choices = INTEGERS[reference(&INTEGERS, "models.inflow") as usize].choices;
    let inflow = choices.iter().position(|c| *c == rotor.inflow).unwrap() as i32 + 1;
    for (name, value) in [
        ("models.inflow", inflow),
        ("drive.mode", 1 + i32::from(rotor.is_driven)),
        ("models.tipLoss", rotor.tip_loss),
        ("numerics.elements", 15),
        ("geometry.numberOfBlades", 3),
        // From rest, which takes no search for the start.
        ("initialization", 2),
    ] {
        assert_eq!(instance.set_integer(name, value), c::OK);
    }
    let flapping = rotor.flapping.into();
    assert_eq!(instance.set_boolean("flapping.enabled", flapping), c::OK);
    let file = "airfoils/naca0015.polar";
    assert_eq!(instance.set_string("airfoil.file", file), c::OK);
    for (name, value) in [
        ("velocity[1]", 12.0),
        ("driveTorque", 4.0),
        ("flapping.hingeOffset", 0.04),
        ("tilt", 0.1),
    ] {
        assert_eq!(instance.set_real(name, value), c::OK);
    }
}

/// A fresh instance for one of the interfaces, configured.
pub fn fresh(kind: i32, rotor: Rotor) -> Instance<'static> {
    let creation = Creation {
        kind,
        ..Creation::default()
    };
    let instance = Instance::create(Fmu::shared(), &creation).unwrap();
    configure(&instance, rotor);
    instance
}

/// All that can be read of a Co-Simulation or Model Exchange instance.
#[derive(Debug, PartialEq)]
pub struct Seen {
    reals: Vec<u64>,
    integers: Vec<i32>,
    strings: Vec<String>,
}

pub fn seen(instance: &Instance) -> Seen {
    let integers = INTEGERS.iter().map(|v| instance.integer(v.name));
    let booleans = BOOLEANS.iter().map(|v| instance.boolean(v.name));
    Seen {
        reals: bits(&instance.reals()),
        integers: integers.chain(booleans).collect(),
        strings: STRINGS.iter().map(|v| instance.string(v.name)).collect(),
    }
}

/// Goes on from the third step of a flight with changing inputs; what is seen on the way.
fn fly_on(instance: &Instance) -> Vec<Seen> {
    let mut all = vec![];
    for (i, (size, collective)) in [(0.013, None), (0.004, Some(0.12)), (0.03, None)]
        .into_iter()
        .enumerate()
    {
        if let Some(collective) = collective {
            assert_eq!(instance.set_real("collective", collective), c::OK);
        }
        let time = instance.last_time();
        assert_eq!(
            instance.step(time, size),
            c::OK,
            "{i}: {:?}",
            instance.take_log()
        );
        all.push(seen(instance));
    }
    assert_eq!(instance.terminate(), c::OK);
    all.push(seen(instance));
    all
}

/// An instance in the middle of a flight, between two points of its inner grid.
fn in_flight(rotor: Rotor) -> Instance<'static> {
    let instance = fresh(c::CO_SIMULATION, rotor);
    assert_eq!(instance.set_up(2.0, Some(3.0)), c::OK);
    assert_eq!(instance.enter_initialization(), c::OK);
    assert_eq!(
        instance.exit_initialization(),
        c::OK,
        "{rotor:?}: {:?}",
        instance.take_log()
    );
    assert_eq!(instance.step(2.0, 0.0117), c::OK);
    assert_eq!(instance.set_real("collective", 0.15), c::OK);
    assert_eq!(instance.step(2.0117, 0.0071), c::OK);
    instance
}

/// Asserts that from the state of `leave`, on the same instance after other steps and on another
/// one, what follows is what follows without leaving.
fn comes_back(rotor: Rotor, leave: impl Fn(&Instance)) {
    let undisturbed = in_flight(rotor);
    leave(&undisturbed);
    let expected = fly_on(&undisturbed);

    let instance = in_flight(rotor);
    leave(&instance);
    let state = instance.state();
    assert_eq!(instance.set_real("collective", 0.05), c::OK);
    assert_eq!(instance.set_real("velocity[3]", -3.0), c::OK);
    let time = instance.last_time();
    assert_eq!(instance.step(time, 0.05), c::OK);
    for _ in 0..2 {
        assert_eq!(instance.set_state(&state), c::OK);
        assert_eq!(fly_on(&instance), expected, "{rotor:?}");
    }
    let other = Instance::new();
    assert_eq!(other.set_state(&state), c::OK);
    assert_eq!(fly_on(&other), expected, "{rotor:?}");
    assert_eq!([instance.take_log(), other.take_log()], [vec![], vec![]]);
}

#[test]
fn a_flight_goes_on_from_its_state_to_the_bit_in_every_inflow_model() {
    for rotor in rotors() {
        comes_back(rotor, |_| ());
    }
}

#[test]
fn inputs_and_their_derivatives_that_wait_for_the_next_step_belong_to_the_state() {
    for rotor in rotors().into_iter().filter(|r| r.flapping) {
        comes_back(rotor, |instance| {
            assert_eq!(instance.set_real("velocity[2]", 3.0), c::OK);
            assert_eq!(instance.set_slope("collective", 0.5), c::OK);
            assert_eq!(instance.set_slope("tilt", -0.2), c::OK);
        });
    }
}

/// Model Exchange: what is seen on the way on from the modes in turn, and when events are asked
/// for.
fn integrate_on(instance: &Instance, is_continuous: bool) -> (Vec<Seen>, Vec<bool>) {
    let (mut all, mut events) = (vec![], vec![]);
    if is_continuous {
        // Before anything is computed anew.
        events.push(instance.completed_step());
    }
    all.push(seen(instance));
    if !is_continuous {
        assert_eq!(instance.set_real("air.density", 1.0), c::OK);
        instance.new_discrete_states();
        all.push(seen(instance));
        assert_eq!(instance.enter_continuous_time(), c::OK);
    }
    for i in 0..3 {
        let (mut x, rates) = (instance.states(), instance.derivatives());
        for (x, rate) in x.iter_mut().zip(rates) {
            *x += 1e-3 * rate;
        }
        assert_eq!(instance.set_time(1e-3 * f64::from(i + 1)), c::OK);
        assert_eq!(instance.set_states(&x), c::OK);
        events.push(instance.completed_step());
        all.push(seen(instance));
    }
    assert_eq!(instance.terminate(), c::OK);
    all.push(seen(instance));
    (all, events)
}

#[test]
fn an_integration_goes_on_from_its_state_to_the_bit_in_every_mode() {
    for (i, rotor) in rotors().into_iter().enumerate() {
        let (is_continuous, is_asked) = (i % 2 == 0, i % 3 == 0);
        let reach = || {
            let instance = fresh(c::MODEL_EXCHANGE, rotor);
            instance.begin_integration();
            let mut x = instance.states();
            (x[0], x[1], x[2]) = (0.3, 95.0, 4.0);
            assert_eq!(instance.set_states(&x), c::OK);
            // A flow state that waits for its event.
            assert_eq!(instance.set_real("velocity[3]", -30.0), c::OK);
            if is_asked {
                assert_eq!(instance.derivatives().len(), STATES.len());
                instance.completed_step();
            }
            if !is_continuous {
                assert_eq!(instance.enter_event_mode(), c::OK);
            }
            instance
        };
        let expected = integrate_on(&reach(), is_continuous);
        let instance = reach();
        let state = instance.state();
        integrate_on(&instance, is_continuous);
        let other = Instance::for_model_exchange();
        for instance in [&instance, &other] {
            assert_eq!(instance.set_state(&state), c::OK);
            let found = integrate_on(instance, is_continuous);
            assert_eq!(found, expected, "{rotor:?}");
        }
    }
}

const ROTOR: Rotor = Rotor {
    inflow: "pittPetersDynamic",
    flapping: true,
    is_driven: true,
    tip_loss: 2,
};

/// To the end of a Co-Simulation from one of the states before it.
fn finish(instance: &Instance, step: usize) -> Seen {
    if step < 1 {
        assert_eq!(instance.enter_initialization(), c::OK);
    }
    if step < 2 {
        assert_eq!(instance.exit_initialization(), c::OK);
    }
    if step < 3 {
        assert_eq!(instance.step(5.0, 0.01), c::OK, "{:?}", instance.take_log());
        // The stop time is part of the state.
        let message = instance.refused(instance.step(5.01, 1.0));
        assert!(message.contains("stopTime = 5.5 s"), "{message}");
        assert_eq!(instance.terminate(), c::OK);
    }
    seen(instance)
}

#[test]
fn every_state_of_the_call_sequence_can_be_taken_and_returned_to_from_every_other() {
    let reach = |step: usize| {
        let instance = fresh(c::CO_SIMULATION, ROTOR);
        assert_eq!(instance.set_up(5.0, Some(5.5)), c::OK);
        let ways: [fn(&Instance) -> Status; 3] = [
            |i| i.enter_initialization(),
            |i| i.exit_initialization(),
            |i| i.step(5.0, 0.01) | i.terminate(),
        ];
        for way in &ways[..step] {
            assert_eq!(way(&instance), c::OK);
        }
        instance
    };
    let expected = finish(&reach(0), 0);
    for from in 0..4 {
        let source = reach(from);
        let state = source.state();
        for to in 0..4 {
            let instance = reach(to);
            assert_eq!(instance.set_state(&state), c::OK, "{from} {to}");
            assert_eq!(finish(&instance, from), expected, "{from} {to}");
        }
        let instance = Instance::new();
        assert_eq!(instance.set_state(&state), c::OK);
        assert_eq!(finish(&instance, from), expected, "{from}");
    }
}

/// With fixed parameters that differ the rotor is made anew at once.
#[test]
fn the_rotor_follows_the_fixed_parameters_of_the_state_at_once() {
    let creation = Creation {
        logging_on: true,
        ..Creation::default()
    };
    let other = Instance::create(Fmu::shared(), &creation).unwrap();
    other.initialize();
    other.take_log();
    let source = in_flight(ROTOR);
    let state = source.state();
    assert_eq!(other.set_state(&state), c::OK);
    let log = other.take_log();
    assert!(
        log.iter()
            .any(|line| line.message.contains("naca0015.polar")),
        "{log:?}"
    );
    assert_eq!(seen(&other), seen(&source));
    // Not again, as nothing differs.
    assert_eq!(other.set_state(&state), c::OK);
    assert_eq!(other.take_log(), []);
    assert_eq!(fly_on(&other), fly_on(&source));
}

/// An instance with other resources has no such file: the state is refused, and the instance goes
/// on.
#[test]
fn a_state_with_a_file_that_is_missing_is_refused_and_nothing_changes() {
    let file = scratch().join("fmu-state.polar");
    let resources = Fmu::shared().resources();
    fs::copy(resources.join("airfoils/naca0015.polar"), &file).unwrap();
    let source = Instance::new();
    let name = uri(&file);
    assert_eq!(source.set_string("airfoil.file", &name), c::OK);
    let early = source.state();
    source.initialize();
    assert_eq!(source.step(0.0, 0.01), c::OK);
    let state = source.state();
    fs::remove_file(&file).unwrap();

    let instance = in_flight(ROTOR);
    let before = seen(&instance);
    let message = instance.refused(instance.set_state(&state));
    assert!(
        message.contains("airfoil.file") && message.contains("fmu-state.polar"),
        "{message}"
    );
    assert_eq!(seen(&instance), before);
    assert_eq!(fly_on(&instance), fly_on(&in_flight(ROTOR)));
    // The source has its rotor still.
    assert_eq!(source.step(0.01, 0.01), c::OK);
    assert_eq!(source.set_state(&state), c::OK);
    // Before the initialisation a file may be missing, and another be named.
    assert_eq!(instance.set_state(&early), c::OK);
    assert!(
        instance
            .refused(initialized(&instance))
            .contains("fmu-state.polar")
    );
    let default = STRINGS[reference(&STRINGS, "airfoil.file") as usize].start;
    assert_eq!(instance.set_string("airfoil.file", default), c::OK);
    assert_eq!(instance.exit_initialization(), c::OK);
}

fn initialized(instance: &Instance) -> Status {
    assert_eq!(instance.enter_initialization(), c::OK);
    instance.exit_initialization()
}

#[test]
fn a_state_is_overwritten_where_there_is_one_and_freed_once() {
    let instance = in_flight(ROTOR);
    let mut pointer = ptr::null_mut();
    assert_eq!(instance.get_state(&mut pointer), c::OK);
    let first = pointer;
    let time = instance.last_time();
    assert_eq!(instance.step(time, 0.01), c::OK);
    let then = seen(&instance);
    assert_eq!(instance.get_state(&mut pointer), c::OK);
    assert_eq!(pointer, first, "the memory is used again");
    let (f, component) = (instance.functions, instance.component);
    assert_eq!(instance.reset(), c::OK);
    let set = |state| {
        // SAFETY: the instance lives, and the state is null or lives.
        unsafe { (f.fmi2SetFMUstate)(component, state) }
    };
    assert_eq!(set(pointer), c::OK);
    assert_eq!(seen(&instance), then);
    let free = |pointer: *mut c::FmuState| {
        // SAFETY: the instance lives, and the pointer is null or points to null or a living state.
        unsafe { (f.fmi2FreeFMUstate)(component, pointer) }
    };
    assert_eq!(free(&mut pointer), c::OK);
    assert!(pointer.is_null());
    assert_eq!(free(&mut pointer), c::OK, "twice");
    assert_eq!(free(ptr::null_mut()), c::OK, "nothing");
    let message = instance.refused(set(pointer));
    assert!(message.contains("null pointer"), "{message}");
    // Something else of the importer's, as large as it may be asked for.
    let mut other = [7_u64; 2000];
    let other = other.as_mut_ptr();
    for foreign in [other, other.wrapping_byte_add(1)] {
        let message = instance.refused(set(foreign.cast()));
        assert!(message.contains("not a state of this FMU"), "{message}");
    }
    let message = instance.refused({
        // SAFETY: null is refused.
        unsafe { (f.fmi2GetFMUstate)(component, ptr::null_mut()) }
    });
    assert!(message.contains("null pointer"), "{message}");
}

#[test]
fn a_state_of_the_other_interface_is_refused() {
    let (one, other) = (Instance::new(), Instance::for_model_exchange());
    for (source, target) in [(&one, &other), (&other, &one)] {
        let state: State = source.state();
        let message = target.refused(target.set_state(&state));
        assert!(message.contains("other interface"), "{message}");
    }
    one.initialize();
    other.begin_integration();
}

/// The state lives on when values change and when the instance is reset.
#[test]
fn a_state_is_a_copy() {
    let instance = in_flight(ROTOR);
    let before = seen(&instance);
    let state = instance.state();
    let bytes = state.serialize();
    assert_eq!(instance.reset(), c::OK);
    for v in REALS
        .iter()
        .filter(|v| !v.causality.is_computed() && v.max == f64::INFINITY)
    {
        assert_eq!(instance.set_real(v.name, v.start + 0.5), c::OK);
    }
    assert_eq!(state.serialize(), bytes);
    assert_eq!(instance.set_state(&state), c::OK);
    assert_eq!(seen(&instance), before);
}

/// The warnings with which a state is set on a new instance. Each names the file and is logged with
/// fmi2Warning, but the call succeeds.
fn warnings_of_a_new_instance(bytes: &[u8]) -> (Vec<String>, Instance<'static>) {
    let instance = Instance::new();
    let state = instance.deserialize(bytes).unwrap();
    assert_eq!(instance.set_state(&state), c::OK);
    drop(state);
    let log = instance.take_log().into_iter();
    let warnings = log.map(|line| {
        assert_eq!(line.status, c::WARNING, "{line:?}");
        assert_eq!(line.category, "logStatusWarning", "{line:?}");
        line.message
    });
    (warnings.collect(), instance)
}

/// Otherwise the simulation would continue with another drag or another blade without a word.
#[test]
fn a_file_that_has_changed_since_the_state_was_taken_is_named() {
    let folder = scratch().join("changed-files");
    fs::create_dir_all(&folder).unwrap();
    let (airfoil, rotor) = (folder.join("x.polar"), folder.join("x.toml"));
    let polar = "polar 1\nreynolds 5e5\n-180 0 0.03\n0 0 0.01\n20 1 0.02\n180 0 0.03\n";
    let shape = "numberOfBlades = 2\nradius = 1.0\nstation = [\n{ r = 0.2, chord = 0.1 },\n{ r = 1.0, chord = 0.1 },\n]\n";
    let write = |polar: &str, shape: &str| {
        fs::write(&airfoil, polar).unwrap();
        fs::write(&rotor, shape).unwrap();
    };
    write(polar, shape);
    let instance = Instance::new();
    for (name, file) in [("airfoil.file", &airfoil), ("geometry.file", &rotor)] {
        let file = file.to_str().unwrap();
        assert_eq!(instance.set_string(name, file), c::OK);
    }
    instance.begin_initialization();
    instance.real("thrust");
    let initializing = instance.state().serialize();
    assert_eq!(instance.exit_initialization(), c::OK);
    assert_eq!(instance.step(0.0, 0.01), c::OK);
    instance.take_log();
    let running = instance.state().serialize();
    assert_eq!(warnings_of_a_new_instance(&running).0, [""; 0]);

    for (new_polar, new_shape, changed) in [
        (
            polar.replace("0.02\n", "0.05\n"),
            shape.to_owned(),
            vec![&airfoil],
        ),
        (polar.to_owned(), shape.replace("0.2", "0.3"), vec![&rotor]),
        (
            polar.replace("20 1 ", "20 2 "),
            shape.replace("0.2", "0.3"),
            vec![&rotor, &airfoil],
        ),
    ] {
        write(&new_polar, &new_shape);
        let expect = |warnings: &[String]| {
            assert_eq!(warnings.len(), changed.len(), "{warnings:?}");
            for (warning, file) in warnings.iter().zip(&changed) {
                let named = format!("{} has changed", file.display());
                assert!(warning.contains(&named), "{warning}");
            }
        };
        let (warnings, other) = warnings_of_a_new_instance(&running);
        expect(&warnings);
        // What continues is another simulation, whose state is restored without a warning.
        let present = other.state().serialize();
        assert_eq!(warnings_of_a_new_instance(&present).0, [""; 0]);
        // Before initialisation ends the files are read when they are needed.
        let (warnings, other) = warnings_of_a_new_instance(&initializing);
        assert_eq!(warnings, [""; 0]);
        assert_eq!(other.state().serialize(), initializing);
        assert_eq!(other.exit_initialization(), c::OK);
        assert_eq!(other.step(0.0, 0.01), c::OK);
        let log: Vec<String> = other
            .take_log()
            .into_iter()
            .map(|line| line.message)
            .collect();
        expect(&log);
        // The instance that took the state keeps its rotor.
        let state = instance.deserialize(&running).unwrap();
        assert_eq!(instance.set_state(&state), c::OK);
        assert_eq!(instance.take_log(), []);
    }
    write(polar, shape);
    assert_eq!(warnings_of_a_new_instance(&running).0, [""; 0]);
}

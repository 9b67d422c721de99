//! Flapping blades against what is known on paper: frequency, damping, coning, cyclic pitch, hub rates, hub
//! moments. The blade's Lock number is gamma = rho a c R^4/I with a = 2 pi.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

use nalgebra::Vector3;
use rotor::{
    Blades, Drive, Models, Operation, Performance, Rotor, Start, State,
    air::{Air, STANDARD_GRAVITY},
    airfoil::{Airfoil, Lift, SectionModel},
    compressibility::Compressibility,
    flapping::{Flap, Freedom, Hinge},
    geometry::{Geometry, Rotation},
    inflow::{Descent, Inflow, Skew, ground::GroundEffect},
    tip_loss::TipLoss,
};
use std::{f64::consts::PI, path::Path};

const SPEED: f64 = 100.0;
const CHORD: f64 = 0.05;
const BLADES: u32 = 4;
const INERTIA: f64 = 0.1;
const STEP: f64 = PI / 180.0;

/// R = 1 m, untwisted, thin-airfoil lift without drag and tip loss.
struct Build {
    inflow: Inflow,
    offset: f64,
    pitch_flap: f64,
    precone: f64,
    blades: u32,
    rotation: Rotation,
    elements: usize,
}

impl Default for Build {
    fn default() -> Self {
        Self {
            inflow: Inflow::Disc(Skew::Uniform),
            offset: 0.0,
            pitch_flap: 0.0,
            precone: 0.0,
            blades: BLADES,
            rotation: Rotation::CounterClockwise,
            elements: 100,
        }
    }
}

impl Build {
    fn rotor(&self) -> Rotor {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data");
        let airfoil = Airfoil::read(&folder.join("frictionless.polar")).unwrap();
        let mut geometry = Geometry::linear(self.blades, 1.0, 0.01, CHORD, 1.0, 0.0);
        geometry.rotation = self.rotation;
        let models = Models {
            inflow: self.inflow,
            descent: Descent::Momentum,
            ground_effect: GroundEffect::None,
            blades: Blades::Automatic,
            hinge: Hinge {
                offset: self.offset,
                precone: self.precone,
                freedom: Some(Freedom {
                    inertia: INERTIA,
                    pitch_flap: self.pitch_flap,
                    length: 1.0 - self.offset,
                }),
            },
            tip_loss: TipLoss::None,
            section: SectionModel {
                lift: Lift::TwoPi,
                compressibility: Compressibility::None,
                drag_reynolds_exponent: 0.0,
            },
        };
        Rotor::new(geometry, vec![airfoil], models, self.elements)
    }
}

fn hover(density: f64, collective: f64) -> Operation {
    Operation {
        collective,
        cyclic_longitudinal: 0.0,
        cyclic_lateral: 0.0,
        speed: SPEED,
        airspeed: Vector3::zeros(),
        angular_velocity: Vector3::zeros(),
        gravity: Vector3::zeros(),
        hinge_spring: 0.0,
        height: 0.0,
        drive: Drive::Speed,
        air: Air::new(density, 288.15),
    }
}

fn lock_number(density: f64) -> f64 {
    density * 2.0 * PI * CHORD / INERTIA
}

fn steady(rotor: &mut Rotor, operation: &Operation) -> (State, Performance) {
    let state = rotor.start(operation, Start::Steady, STEP).unwrap();
    (state, rotor.performance(operation, &state).unwrap())
}

fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{what}: {found:e}, expected {expected:e}"
    );
}

/// Blades 1 and 3 up, 2 and 4 down: the thrust and with it the inflow stay as they are.
fn opposed(amplitude: f64) -> State {
    let mut state = State::default();
    for (k, flap) in state.flaps.iter_mut().take(4).enumerate() {
        flap.angle = if k % 2 == 0 { amplitude } else { -amplitude };
    }
    state
}

/// Angle of blade 1 at each step of a free motion.
fn free_motion(rotor: &mut Rotor, operation: &Operation, amplitude: f64, count: usize) -> Vec<f64> {
    let mut state = opposed(amplitude);
    let mut angles = vec![amplitude];
    for _ in 0..count {
        state = rotor.step(|_| *operation, &state, STEP / SPEED).unwrap();
        angles.push(state.flaps[0].angle);
    }
    angles
}

/// Johnson 1980, "Helicopter Theory", eq. 5-145: nu^2 = 1 + 3/2 e/(1 - e) + k/(I Omega^2).
#[test]
fn the_frequency_of_a_free_blade_is_that_of_offset_and_spring() {
    for (offset, spring) in [(0.0, 0.0), (0.1, 0.0), (0.0, 300.0), (0.05, 150.0)] {
        let mut rotor = Build {
            offset,
            elements: 10,
            ..Build::default()
        }
        .rotor();
        let mut operation = hover(1e-9, 0.0);
        operation.hinge_spring = spring;
        let angles = free_motion(&mut rotor, &operation, 1e-3, 1500);
        let nu =
            (1.0_f64 + 1.5 * offset / (1.0 - offset) + spring / (INERTIA * SPEED * SPEED)).sqrt();
        for (i, angle) in angles.iter().enumerate() {
            let expected = 1e-3 * (nu * STEP * i as f64).cos();
            close(
                *angle,
                expected,
                1e-6,
                &format!("e {offset}, k {spring}, step {i}"),
            );
        }
    }
}

/// Johnson 1980, section 5-5: beta'' + gamma/8 beta' + beta = 0, a damping ratio of gamma/16.
#[test]
fn free_flapping_is_damped_by_a_sixteenth_of_the_lock_number() {
    let density = 1.2;
    let zeta = lock_number(density) / 16.0;
    let angles = free_motion(
        &mut Build::default().rotor(),
        &hover(density, 0.0),
        1e-3,
        720,
    );
    let damped = (1.0 - zeta * zeta).sqrt();
    for (i, angle) in angles.iter().enumerate() {
        let psi = STEP * i as f64;
        let expected = 1e-3
            * (-zeta * psi).exp()
            * ((damped * psi).cos() + zeta / damped * (damped * psi).sin());
        close(*angle, expected, 2e-6, &format!("step {i}, zeta {zeta}"));
    }
}

/// Johnson 1980, section 5-5: a0 = gamma (theta/8 - lambda/6), less the weight's S g/(I Omega^2), with a
/// spring over nu^2; delta3 takes gamma/8 tan(delta3) a0 from the pitch.
#[test]
fn coning_in_hover() {
    for (spring, pitch_flap, gravity) in [
        (0.0, 0.0, 0.0),
        (500.0, 0.0, 0.0),
        (0.0, 0.5, 0.0),
        (0.0, 0.0, 20.0 * STANDARD_GRAVITY),
    ] {
        let mut rotor = Build {
            pitch_flap,
            ..Build::default()
        }
        .rotor();
        let theta = 0.1;
        let mut operation = hover(1.2, theta);
        operation.hinge_spring = spring;
        operation.gravity.z = -gravity;
        let (_, p) = steady(&mut rotor, &operation);
        let gamma = lock_number(1.2);
        let lambda = p.induced_velocity / SPEED;
        let stiffness = 1.0 + spring / (INERTIA * SPEED * SPEED) + gamma / 8.0 * pitch_flap;
        let weight = 1.5 * gravity / (SPEED * SPEED);
        let expected = (gamma * (theta / 8.0 - lambda / 6.0) - weight) / stiffness;
        close(
            p.tip_path.coning,
            expected,
            0.01 * expected.abs(),
            &format!("k {spring}, delta3 {pitch_flap}, g {gravity}"),
        );
        close(p.tip_path.longitudinal, 0.0, 1e-9, "a1");
        close(p.tip_path.lateral, 0.0, 1e-9, "b1");
    }
}

/// Gessow & Myers 1952, ch. 7: without offset and spring the tip path leans by the cyclic pitch, 90 deg
/// later than the pitch: pitch that is lowest on the right leans it forward, pitch that is lowest at the
/// tail leans it to the right.
///
/// Exactly so where nothing is induced. The inflow of a thrusting rotor stays along the shaft here, so that a
/// leaning tip path meets some of it edgewise, which adds half a percent.
#[test]
fn cyclic_pitch_in_hover_leans_the_tip_path_by_as_much_a_quarter_turn_later() {
    let small = 1e-3;
    for (collective, tolerance) in [(0.0, 2e-6), (0.1, 0.01)] {
        let mut operation = hover(1.2, collective);
        operation.cyclic_longitudinal = small;
        let (_, forward) = steady(&mut Build::default().rotor(), &operation);
        let path = forward.tip_path;
        close(path.longitudinal, -small, tolerance * small, "a1");
        close(path.lateral, 0.0, tolerance * small, "b1");
        // The thrust leans with the tip path, and a hub without spring and offset feels no moment
        let thrust = forward.force.z;
        close(
            forward.force.x,
            small * thrust,
            0.05 * small * thrust.abs(),
            "force",
        );
        // But for the torque, which leans as well.
        let moment = forward.moment.x.hypot(forward.moment.y);
        assert!(moment <= 1.5 * small * forward.torque + 1e-9, "{moment}");

        let mut operation = hover(1.2, collective);
        operation.cyclic_lateral = small;
        let (_, right) = steady(&mut Build::default().rotor(), &operation);
        let path = right.tip_path;
        close(path.lateral, small, tolerance * small, "b1");
        close(path.longitudinal, 0.0, tolerance * small, "a1");
        let thrust = right.force.z;
        close(
            right.force.y,
            -small * thrust,
            0.05 * small * thrust.abs(),
            "force",
        );
    }
}

/// Johnson 1980, section 5-12 (Amer 1950, NACA TN 2136): the tip path lags behind a hub that turns by 16/gamma
/// q/Omega, and leans across by q/Omega.
#[test]
fn hub_rates_lag_and_cross_couple() {
    let gamma = lock_number(1.2);
    let rate = 0.1;
    let fly = |rates: Vector3<f64>| {
        let mut operation = hover(1.2, 0.08);
        operation.angular_velocity = rates;
        let (_, p) = steady(&mut Build::default().rotor(), &operation);
        (
            p.tip_path.longitudinal * SPEED / rate,
            p.tip_path.lateral * SPEED / rate,
        )
    };
    // About y the nose goes down: the tip path stays back.
    let (a1, b1) = fly(Vector3::new(0.0, rate, 0.0));
    close(a1, 16.0 / gamma, 0.005 * 16.0 / gamma, "lag in pitch");
    close(b1, 1.0, 0.02, "cross of pitch");
    // About x the right side goes down: the tip path stays left.
    let (a1, b1) = fly(Vector3::new(rate, 0.0, 0.0));
    close(b1, -16.0 / gamma, 0.005 * 16.0 / gamma, "lag in roll");
    close(a1, 1.0, 0.02, "cross of roll");
}

/// A cone that leans by a1 pulls at the hub with N/2 (k + h S nu^2 Omega^2) a1 through the springs and the
/// offset hinges, in airless space (Johnson 1980, section 5-13, h S Omega^2 there for small offsets).
#[test]
fn hub_moments_of_a_leaning_tip_path() {
    for (offset, spring) in [(0.0, 200.0), (0.1, 0.0), (0.1, 200.0)] {
        let mut rotor = Build {
            offset,
            ..Build::default()
        }
        .rotor();
        let mut operation = hover(1e-12, 0.0);
        operation.hinge_spring = spring;
        let lean = 1e-4;
        let mut state = State::default();
        for (k, flap) in state.flaps.iter_mut().take(4).enumerate() {
            let psi = PI / 2.0 * k as f64;
            *flap = Flap {
                angle: -lean * psi.cos(),
                rate: lean * SPEED * psi.sin(),
            };
        }
        let p = rotor.performance(&operation, &state).unwrap();
        let first = 1.5 * INERTIA / (1.0 - offset);
        let nu_square = 1.0 + 1.5 * offset / (1.0 - offset) + spring / (INERTIA * SPEED * SPEED);
        let expected = 2.0 * (spring + offset * first * nu_square * SPEED * SPEED) * lean;
        close(
            p.moment.y,
            -expected,
            1e-6 * expected,
            &format!("e {offset}, k {spring}"),
        );
        close(p.moment.x, 0.0, 1e-6 * expected, "roll");
        close(p.tip_path.longitudinal, lean, 1e-12, "a1");
    }
}

/// The angular momentum that a hub's turn gives to free blades at the shaft comes from the air alone; with an
/// offset the hub must turn their mass: in airless space a pitch rate q at an instant with flat blades needs
/// the gyroscopic moment of what lies at the offset.
#[test]
fn flat_blades_on_a_turning_hub_feel_the_gyroscopic_moment_twice_omega_q() {
    let offset = 0.2;
    let mut rotor = Build {
        offset,
        ..Build::default()
    }
    .rotor();
    let mut operation = hover(1e-12, 0.0);
    let rate = 1e-3;
    operation.angular_velocity.y = rate;
    let p = rotor.performance(&operation, &State::default()).unwrap();
    // Of each blade: -2 Omega w_r acts up on its mass m at h + l/2, of which the hinge carries what does not
    // turn the blade: m (h + l/2) - S (I + h S)/I. Twice the mean square of the sine: N/2.
    let length = 1.0 - offset;
    let (mass, first) = (3.0 * INERTIA / length.powi(2), 1.5 * INERTIA / length);
    let carried = mass * (offset + length / 2.0) - first * (INERTIA + offset * first) / INERTIA;
    let expected = 2.0 * 2.0 * SPEED * rate * offset * carried;
    close(
        p.moment.x.abs(),
        expected.abs(),
        1e-6 * expected.abs(),
        "roll",
    );
    close(p.moment.y, 0.0, 1e-9 * expected.abs(), "pitch");
}

/// Found by shooting, the motion goes on repeating itself.
#[test]
fn a_steady_start_in_forward_flight_repeats_itself() {
    for inflow in [
        Inflow::Annulus,
        Inflow::Disc(Skew::Drees),
        Inflow::FiniteBlades,
        Inflow::PittPetersDynamic,
        Inflow::PetersHe { order: 3 },
    ] {
        let mut rotor = Build {
            inflow,
            elements: 10,
            ..Build::default()
        }
        .rotor();
        let mut operation = hover(1.2, 0.1);
        operation.airspeed = Vector3::new(25.0, 3.0, 1.0);
        operation.cyclic_longitudinal = 0.04;
        let (start, _) = steady(&mut rotor, &operation);
        let mut state = start;
        for _ in 0..360 {
            state = rotor.step(|_| operation, &state, STEP / SPEED).unwrap();
        }
        close(state.azimuth, 2.0 * PI, 1e-12, "a whole turn");
        let mut expected = start;
        expected.azimuth = state.azimuth;
        let change = state.largest_change(&expected);
        assert!(change < 1e-7, "{inflow:?}: {change:e}");
        // The next blade does a quarter turn later what this one does.
        let mut state = start;
        for _ in 0..90 {
            state = rotor.step(|_| operation, &state, STEP / SPEED).unwrap();
        }
        close(
            state.flaps[0].angle,
            start.flaps[1].angle,
            1e-8,
            "next blade",
        );
        assert!((start.flaps[0].angle - start.flaps[2].angle).abs() > 1e-3);
    }
}

/// Both outputs of `performance` and all rates, with the blades turned together with everything else.
#[test]
fn turning_the_whole_problem_and_the_blades_turns_forces_and_moments() {
    let angle = 0.7_f64;
    let turned = |v: Vector3<f64>| {
        let (sin, cos) = angle.sin_cos();
        Vector3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z)
    };
    for inflow in [
        Inflow::Annulus,
        Inflow::Disc(Skew::Drees),
        Inflow::FiniteBlades,
        Inflow::PittPetersDynamic,
        Inflow::PetersHe { order: 4 },
    ] {
        let mut rotor = Build {
            inflow,
            offset: 0.05,
            pitch_flap: 0.2,
            precone: 0.03,
            ..Build::default()
        }
        .rotor();
        let mut operation = hover(1.2, 0.1);
        operation.airspeed = Vector3::new(18.0, 4.0, -1.0);
        operation.angular_velocity = Vector3::new(1.0, -0.5, 0.3);
        operation.gravity = Vector3::new(1.0, 2.0, -9.0);
        operation.hinge_spring = 50.0;
        operation.cyclic_longitudinal = 0.03;
        operation.cyclic_lateral = -0.02;
        let mut state = opposed(0.02);
        state.azimuth = 0.3;
        state.flaps[1].rate = 0.5;
        state.inflow[0] = 1.0;
        let cyclic = turned(Vector3::new(
            operation.cyclic_lateral,
            operation.cyclic_longitudinal,
            0.0,
        ));
        let other = Operation {
            cyclic_lateral: cyclic.x,
            cyclic_longitudinal: cyclic.y,
            airspeed: turned(operation.airspeed),
            angular_velocity: turned(operation.angular_velocity),
            gravity: turned(operation.gravity),
            ..operation
        };
        let mut other_state = state;
        other_state.azimuth += angle;
        let a = rotor.performance(&operation, &state).unwrap();
        let b = rotor.performance(&other, &other_state).unwrap();
        assert!(
            (turned(a.force) - b.force).norm() < 1e-12 * a.force.norm(),
            "{inflow:?}"
        );
        assert!(
            (turned(a.moment) - b.moment).norm() < 1e-11 * a.force.norm(),
            "{inflow:?}"
        );
        let a = rotor.rates(&operation, &state).unwrap();
        let b = rotor.rates(&other, &other_state).unwrap();
        for (a, b) in a.flaps.iter().zip(b.flaps) {
            close(b.rate, a.rate, 1e-8, "beta''");
        }
        close(b.inflow[0], a.inflow[0], 1e-9 * a.inflow[0].abs(), "inflow");
    }
}

#[test]
fn a_clockwise_rotor_flaps_as_the_mirror_image() {
    let mirrored = |v: Vector3<f64>| Vector3::new(v.x, -v.y, v.z);
    let mut operation = hover(1.2, 0.1);
    operation.airspeed = Vector3::new(18.0, 4.0, -1.0);
    operation.angular_velocity = Vector3::new(1.0, -0.5, 0.3);
    operation.gravity = Vector3::new(1.0, 2.0, -9.0);
    let other = Operation {
        airspeed: mirrored(operation.airspeed),
        angular_velocity: -mirrored(operation.angular_velocity),
        gravity: mirrored(operation.gravity),
        ..operation
    };
    let build = |rotation| Build {
        offset: 0.05,
        rotation,
        inflow: Inflow::PittPetersDynamic,
        ..Build::default()
    };
    let (state, a) = steady(&mut build(Rotation::CounterClockwise).rotor(), &operation);
    let (other_state, b) = steady(&mut build(Rotation::Clockwise).rotor(), &other);
    assert_eq!(state, other_state);
    assert_eq!(mirrored(a.force), b.force);
    assert_eq!(-mirrored(a.moment), b.moment);
    assert_eq!(a.tip_path, b.tip_path);
}

/// One or two blades tell coning and lean as many do.
#[test]
fn few_blades_show_the_same_cone() {
    let cone = |blades| {
        let mut rotor = Build {
            blades,
            elements: 20,
            ..Build::default()
        }
        .rotor();
        let mut operation = hover(1.2, 0.08);
        operation.cyclic_lateral = 0.02;
        operation.cyclic_longitudinal = 0.01;
        steady(&mut rotor, &operation).1.tip_path
    };
    for blades in [1, 2, 3, 8] {
        let path = cone(blades);
        assert!(path.coning > 0.0);
        close(path.longitudinal, -0.01, 1e-4, &format!("a1 of {blades}"));
        close(path.lateral, 0.02, 2e-4, &format!("b1 of {blades}"));
    }
}

/// Blades that hang, fall, are blown about or held by the stiffest spring stay finite.
#[test]
fn blades_of_a_stopped_rotor_fall_and_swing() {
    let mut rotor = Build {
        elements: 10,
        ..Build::default()
    }
    .rotor();
    let mut operation = hover(1.2, 0.1);
    operation.speed = 0.0;
    operation.gravity.z = -STANDARD_GRAVITY;
    let mut state = rotor.start(&operation, Start::Steady, STEP).unwrap();
    let mut lowest = 0.0_f64;
    for _ in 0..2000 {
        let steps = rotor.steps(&operation, &state, 0.005);
        for _ in 0..steps as u32 {
            state = rotor.step(|_| operation, &state, 0.005 / steps).unwrap();
        }
        lowest = lowest.min(state.flaps[0].angle);
    }
    assert!(lowest < -PI / 2.0, "it swings through: {lowest}");
    assert!(
        lowest > -PI - 1e-3,
        "and not beyond where it began: {lowest}"
    );
}

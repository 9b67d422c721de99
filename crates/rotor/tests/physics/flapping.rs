//! Flapping blades against what is known on paper: frequency, damping, coning, cyclic pitch, hub
//! rates, hub moments. The blade's Lock number is gamma = rho a c R^4/I with a = 2 pi.

use crate::support::{
    DENSITY, SPEED, STEP, air, flight, hover, hub_loads, ideal_models, ideal_rotor, peters_he,
    steady,
};
use nalgebra::Vector3;
use rotor::{
    Blades, Models, OperatingPoint, Rotor, Start, Started, State, Workspace,
    air::STANDARD_GRAVITY,
    disc::Flap,
    flapping::{BladeMass, Freedom, Hinge, Stops},
    geometry::{Geometry, Rotation},
    inflow::{ElementInflow, Inflow, Skew},
    seesaw::Seesaw,
};
use std::f64::consts::PI;

const CHORD: f64 = 0.05;
const BLADES: u32 = 4;
const INERTIA: f64 = 0.1;

/// Untwisted blades without drag and tip loss.
struct Build {
    inflow: Inflow,
    offset: f64,
    pitch_flap: f64,
    precone: f64,
    blades: u32,
    rotation: Rotation,
    elements: usize,
    /// kg.m2.
    inertia: f64,
    flaps: bool,
    blades_model: Blades,
    stops: Stops,
    seesaw: Option<Seesaw>,
}

impl Default for Build {
    fn default() -> Self {
        Self {
            inflow: Inflow::Linear(Skew::Uniform),
            offset: 0.0,
            pitch_flap: 0.0,
            precone: 0.0,
            blades: BLADES,
            rotation: Rotation::CounterClockwise,
            elements: 100,
            inertia: INERTIA,
            flaps: true,
            blades_model: Blades::Automatic,
            stops: Stops::default(),
            seesaw: None,
        }
    }
}

impl Build {
    fn rotor(self) -> Rotor {
        let mut geometry = geometry(self.blades);
        geometry.rotation = self.rotation;
        let length = 1.0 - self.offset;
        let freedom = Freedom {
            pitch_flap: self.pitch_flap,
            length,
            stops: self.stops,
        };
        let models = Models {
            seesaw: self.seesaw,
            hinge: Hinge {
                offset: self.offset,
                precone: self.precone,
                mass: BladeMass::rod(self.inertia, length),
                freedom: self.flaps.then_some(freedom),
            },
            blades: self.blades_model,
            ..ideal_models(self.inflow)
        };
        ideal_rotor(geometry, models, self.elements)
    }
}

fn geometry(blades: u32) -> Geometry {
    Geometry::linear(blades, 1.0, 0.01, CHORD, 1.0, 0.0)
}

/// Blades without pitch in next to no air.
fn airless(density: f64) -> OperatingPoint {
    OperatingPoint {
        air: air(density),
        ..hover(0.0)
    }
}

/// Flight in which motion and gravity have no symmetry.
fn unsymmetrical() -> OperatingPoint {
    OperatingPoint {
        angular_velocity: Vector3::new(1.0, -0.5, 0.3),
        gravity: Vector3::new(1.0, 2.0, -9.0),
        ..flight(0.1, Vector3::new(18.0, 4.0, -1.0))
    }
}

fn lock_number() -> f64 {
    DENSITY * 2.0 * PI * CHORD / INERTIA
}

fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{what}: {found:e}, expected {expected:e}"
    );
}

/// Blades 1 and 3 up, 2 and 4 down: this changes neither the thrust nor the inflow.
fn opposed(amplitude: f64) -> State {
    let mut state = State::default();
    for (k, flap) in state.flaps.iter_mut().take(4).enumerate() {
        flap.angle = if k % 2 == 0 { amplitude } else { -amplitude };
    }
    state
}

/// The states at so many steps of the azimuth, from `state` on.
fn motion(rotor: &Rotor, point: &OperatingPoint, mut state: State, count: usize) -> Vec<State> {
    let mut workspace = Workspace::new(rotor);
    let mut states = vec![state];
    for _ in 0..count {
        let next = rotor.step(|_| *point, &state, STEP / SPEED, &mut workspace);
        state = next.unwrap();
        states.push(state);
    }
    states
}

/// Angle of blade 1 at each step of the azimuth after the blades were let go at `amplitude`.
fn free_motion(rotor: &Rotor, point: &OperatingPoint, amplitude: f64, count: usize) -> Vec<f64> {
    let states = motion(rotor, point, opposed(amplitude), count);
    states.iter().map(|state| state.flaps[0].angle).collect()
}

/// Johnson 1980, "Helicopter Theory", eq. 5-145: nu^2 = 1 + 3/2 e/(1 - e) + k/(I Omega^2).
#[test]
fn the_frequency_of_a_free_blade_is_that_of_offset_and_spring() {
    for (offset, spring) in [(0.0, 0.0), (0.1, 0.0), (0.0, 300.0), (0.05, 150.0)] {
        let rotor = Build {
            offset,
            elements: 10,
            ..Build::default()
        }
        .rotor();
        let point = OperatingPoint {
            hinge_spring: spring,
            ..airless(1e-9)
        };
        let angles = free_motion(&rotor, &point, 1e-3, 1500);
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
    let zeta = lock_number() / 16.0;
    let angles = free_motion(&Build::default().rotor(), &hover(0.0), 1e-3, 720);
    let damped = (1.0 - zeta * zeta).sqrt();
    for (i, angle) in angles.iter().enumerate() {
        let psi = STEP * i as f64;
        let expected = 1e-3
            * (-zeta * psi).exp()
            * ((damped * psi).cos() + zeta / damped * (damped * psi).sin());
        close(*angle, expected, 2e-6, &format!("step {i}, zeta {zeta}"));
    }
}

/// Johnson 1980, section 5-5: a0 = gamma (theta/8 - lambda/6) less S g/(I Omega^2) of the weight. A
/// spring divides it by nu^2; delta3 takes gamma/8 tan(delta3) a0 from the pitch.
#[test]
fn coning_in_hover() {
    for (spring, pitch_flap, gravity) in [
        (0.0, 0.0, 0.0),
        (500.0, 0.0, 0.0),
        (0.0, 0.5, 0.0),
        (0.0, 0.0, 20.0 * STANDARD_GRAVITY),
    ] {
        let rotor = Build {
            pitch_flap,
            ..Build::default()
        }
        .rotor();
        let theta = 0.1;
        let point = OperatingPoint {
            hinge_spring: spring,
            gravity: Vector3::new(0.0, 0.0, -gravity),
            ..hover(theta)
        };
        let (_, loads) = steady(&rotor, &point);
        let gamma = lock_number();
        let lambda = loads.induced_velocity / SPEED;
        let stiffness = 1.0 + spring / (INERTIA * SPEED * SPEED) + gamma / 8.0 * pitch_flap;
        let weight = 1.5 * gravity / (SPEED * SPEED);
        let expected = (gamma * (theta / 8.0 - lambda / 6.0) - weight) / stiffness;
        close(
            loads.tip_path.coning,
            expected,
            0.01 * expected.abs(),
            &format!("k {spring}, delta3 {pitch_flap}, g {gravity}"),
        );
        close(loads.tip_path.longitudinal, 0.0, 1e-9, "a1");
        close(loads.tip_path.lateral, 0.0, 1e-9, "b1");
    }
}

/// Gessow & Myers 1952, ch. 7: without offset and spring the tip path leans by the cyclic pitch, 90
/// deg later than the pitch: pitch that is lowest on the right leans it forward, pitch that is
/// lowest at the tail leans it to the right.
///
/// This is exact where nothing is induced. The inflow of a thrusting rotor stays along the shaft
/// here, so that a leaning tip path meets some of it edgewise, which adds half a percent.
#[test]
fn cyclic_pitch_in_hover_leans_the_tip_path_by_as_much_90_degrees_later() {
    let small = 1e-3;
    for (collective, tolerance) in [(0.0, 2e-6), (0.1, 0.01)] {
        let point = OperatingPoint {
            cyclic_longitudinal: small,
            ..hover(collective)
        };
        let (_, forward) = steady(&Build::default().rotor(), &point);
        let path = forward.tip_path;
        close(path.longitudinal, -small, tolerance * small, "a1");
        close(path.lateral, 0.0, tolerance * small, "b1");
        // The thrust leans with the tip path.
        let thrust = forward.force.z;
        close(
            forward.force.x,
            small * thrust,
            0.05 * small * thrust.abs(),
            "force",
        );
        // A hub without spring and offset feels no moment except the torque, which leans as well.
        let moment = forward.moment.x.hypot(forward.moment.y);
        assert!(moment <= 1.5 * small * forward.torque + 1e-9, "{moment}");

        let point = OperatingPoint {
            cyclic_lateral: small,
            ..hover(collective)
        };
        let (_, right) = steady(&Build::default().rotor(), &point);
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

/// Johnson 1980, section 5-12 (Amer 1950, NACA TN 2136): on a hub that turns at the rate q the tip
/// path lags by 16/gamma q/Omega, and leans across by q/Omega.
#[test]
fn hub_rates_lag_and_cross_couple() {
    let gamma = lock_number();
    let rate = 0.1;
    let steady_tip_path = |angular_velocity: Vector3<f64>| {
        let point = OperatingPoint {
            angular_velocity,
            ..hover(0.08)
        };
        let (_, loads) = steady(&Build::default().rotor(), &point);
        (
            loads.tip_path.longitudinal * SPEED / rate,
            loads.tip_path.lateral * SPEED / rate,
        )
    };
    // About y the nose goes down: the tip path stays back.
    let (a1, b1) = steady_tip_path(Vector3::new(0.0, rate, 0.0));
    close(a1, 16.0 / gamma, 0.005 * 16.0 / gamma, "lag in pitch");
    close(b1, 1.0, 0.02, "cross of pitch");
    // About x the right side goes down: the tip path stays left.
    let (a1, b1) = steady_tip_path(Vector3::new(rate, 0.0, 0.0));
    close(b1, -16.0 / gamma, 0.005 * 16.0 / gamma, "lag in roll");
    close(a1, 1.0, 0.02, "cross of roll");
}

/// Without air, a cone that leans by a1 pulls at the hub with N/2 (k + h S nu^2 Omega^2) a1 through
/// the springs and the offset hinges. Johnson 1980, section 5-13, has h S Omega^2 for small
/// offsets.
#[test]
fn hub_moments_of_a_leaning_tip_path() {
    for (offset, spring) in [(0.0, 200.0), (0.1, 0.0), (0.1, 200.0)] {
        let rotor = Build {
            offset,
            ..Build::default()
        }
        .rotor();
        let point = OperatingPoint {
            hinge_spring: spring,
            ..airless(1e-12)
        };
        let lean = 1e-4;
        let mut state = State::default();
        for (k, flap) in state.flaps.iter_mut().take(4).enumerate() {
            let psi = PI / 2.0 * k as f64;
            *flap = Flap {
                angle: -lean * psi.cos(),
                rate: lean * SPEED * psi.sin(),
            };
        }
        let loads = hub_loads(&rotor, &point, &state);
        let first = 1.5 * INERTIA / (1.0 - offset);
        let nu_square = 1.0 + 1.5 * offset / (1.0 - offset) + spring / (INERTIA * SPEED * SPEED);
        let expected = 2.0 * (spring + offset * first * nu_square * SPEED * SPEED) * lean;
        close(
            loads.moment.y,
            -expected,
            1e-6 * expected,
            &format!("e {offset}, k {spring}"),
        );
        close(loads.moment.x, 0.0, 1e-6 * expected, "roll");
        close(loads.tip_path.longitudinal, lean, 1e-12, "a1");
    }
}

/// Blades hinged at the shaft follow a turning hub by the moment of the air alone. With an offset
/// the hub must turn their mass, too: without air, a pitch rate q while the blades are flat needs
/// the gyroscopic moment of what lies at the offset.
#[test]
fn flat_blades_on_a_turning_hub_feel_the_gyroscopic_moment_twice_omega_q() {
    let offset = 0.2;
    let rotor = Build {
        offset,
        ..Build::default()
    }
    .rotor();
    let rate = 1e-3;
    let point = OperatingPoint {
        angular_velocity: Vector3::new(0.0, rate, 0.0),
        ..airless(1e-12)
    };
    let loads = hub_loads(&rotor, &point, &State::default());
    // In each blade -2 Omega w_r acts up on the mass m at h + l/2. The hinge carries what does not
    // turn the blade: m (h + l/2) - S (I + h S)/I. The squares of the sine add up to N/2.
    let length = 1.0 - offset;
    let (mass, first) = (3.0 * INERTIA / length.powi(2), 1.5 * INERTIA / length);
    let carried = mass * (offset + length / 2.0) - first * (INERTIA + offset * first) / INERTIA;
    let expected = 2.0 * 2.0 * SPEED * rate * offset * carried;
    close(
        loads.moment.x.abs(),
        expected.abs(),
        1e-6 * expected.abs(),
        "roll",
    );
    close(loads.moment.y, 0.0, 1e-9 * expected.abs(), "pitch");
}

/// Rigid blades in individual mode (`true`) or averaged.
fn rigid(blades: u32, is_individual: bool, rotation: Rotation, inertia: f64) -> Build {
    Build {
        blades,
        rotation,
        inertia,
        flaps: false,
        blades_model: if is_individual {
            Blades::Individual
        } else {
            Blades::Disc
        },
        elements: 10,
        ..Build::default()
    }
}

/// Euler's equations of a flat disc with the moment of inertia J = N I about the shaft and J/2
/// across: the hub feels J (Omega + r/2) (-q, p), in the other direction of rotation with -Omega.
/// It does no work on the turning hub. Averaged over one revolution so do one and two blades.
#[test]
fn rigid_blades_exert_the_gyroscopic_moment() {
    let rates = Vector3::new(0.7, -0.4, 3.0);
    for (rotation, sense) in [
        (Rotation::CounterClockwise, 1.0),
        (Rotation::Clockwise, -1.0),
    ] {
        for (blades, is_individual) in [
            (3, true),
            (4, true),
            (7, true),
            (1, false),
            (2, false),
            (4, false),
        ] {
            let what = format!("{blades} blades, individual {is_individual}, {rotation:?}");
            let point = OperatingPoint {
                angular_velocity: rates,
                ..airless(1e-12)
            };
            let state = State {
                azimuth: 0.6,
                ..State::default()
            };
            let rotor = rigid(blades, is_individual, rotation, INERTIA).rotor();
            let moment = hub_loads(&rotor, &point, &state).moment;
            let momentum = f64::from(blades) * INERTIA * (sense * SPEED + rates.z / 2.0);
            let scale = momentum.abs();
            close(moment.x, -momentum * rates.y, 1e-9 * scale, &what);
            close(moment.y, momentum * rates.x, 1e-9 * scale, &what);
            let work = moment.x * rates.x + moment.y * rates.y;
            close(work, 0.0, 1e-9 * scale, &what);
        }
    }
}

/// One and two blades: -2 I Omega w_r of each blade, with w_r = -p cos(psi) along it for a roll
/// rate p, varies twice per revolution.
#[test]
fn the_gyroscopic_moment_of_few_rigid_blades_varies_twice_per_revolution() {
    let rate = 0.5;
    let point = OperatingPoint {
        angular_velocity: Vector3::new(rate, 0.0, 0.0),
        ..airless(1e-12)
    };
    for blades in [1, 2] {
        let rotor = rigid(blades, true, Rotation::CounterClockwise, INERTIA).rotor();
        let peak = f64::from(blades) * 2.0 * INERTIA * SPEED * rate;
        for psi in [0.0, 0.4, 1.3, 2.9_f64] {
            let state = State {
                azimuth: psi,
                ..State::default()
            };
            let moment = hub_loads(&rotor, &point, &state).moment;
            let (sin, cos) = psi.sin_cos();
            close(moment.y, peak * cos * cos, 1e-9 * peak, "pitch");
            close(moment.x, -peak * cos * sin, 1e-9 * peak, "roll");
        }
    }
}

/// The stiffer the springs, the closer the hub moment comes to that of rigid blades.
#[test]
fn stiff_springs_tend_to_the_rigid_rotor() {
    for (blades, precone, rotation) in [
        (1, 0.0, Rotation::CounterClockwise),
        (2, 0.03, Rotation::Clockwise),
        (3, 0.03, Rotation::CounterClockwise),
        (4, 0.03, Rotation::Clockwise),
    ] {
        let build = |flaps| Build {
            precone,
            flaps,
            offset: 0.06,
            ..rigid(blades, true, rotation, INERTIA)
        };
        let stiff = Build {
            blades_model: Blades::Automatic,
            ..build(true)
        };
        let (stiff, rigid) = (stiff.rotor(), build(false).rotor());
        let point = OperatingPoint {
            gravity: Vector3::zeros(),
            ..unsymmetrical()
        };
        let limit = hub_loads(&rigid, &point, &State::default()).moment;
        let without = OperatingPoint {
            angular_velocity: Vector3::zeros(),
            ..point
        };
        let change = (limit - hub_loads(&rigid, &without, &State::default()).moment).norm();
        let errors = [1e4, 4e4].map(|hinge_spring| {
            let point = OperatingPoint {
                hinge_spring,
                ..point
            };
            (steady(&stiff, &point).1.moment - limit).norm()
        });
        println!("{blades} blades: {limit:?}, {errors:?}, gyroscopic {change}");
        assert!(errors[1] < 0.35 * errors[0], "{blades} blades: {errors:?}");
        assert!(
            errors[1] < 0.1 * change,
            "{blades} blades: {errors:?}, {change}"
        );
    }
}

/// While the hub neither rolls nor pitches, the inertia of rigid blades changes no bit.
#[test]
fn the_inertia_of_rigid_blades_has_no_effect_on_a_steady_hub() {
    for (blades, is_individual) in [(1, true), (2, true), (4, true), (4, false)] {
        let at = |inertia: f64| {
            let build = Build {
                precone: 0.05,
                ..rigid(blades, is_individual, Rotation::Clockwise, inertia)
            };
            let point = OperatingPoint {
                angular_velocity: Vector3::new(0.0, 0.0, 0.4),
                ..unsymmetrical()
            };
            hub_loads(&build.rotor(), &point, &State::default())
        };
        let moment = at(0.0).moment;
        assert_eq!(moment.map(f64::to_bits), at(0.3).moment.map(f64::to_bits));
        assert_eq!(at(0.0), at(0.3));
    }
}

#[test]
fn a_steady_start_in_forward_flight_repeats_itself() {
    for inflow in [
        Inflow::Elements(ElementInflow::Annulus),
        Inflow::Linear(Skew::Drees),
        Inflow::Elements(ElementInflow::FiniteBlades),
        Inflow::PittPetersDynamic,
        peters_he(3, &geometry(BLADES), 10),
    ] {
        let rotor = Build {
            inflow: inflow.clone(),
            elements: 10,
            ..Build::default()
        }
        .rotor();
        let point = OperatingPoint {
            cyclic_longitudinal: 0.04,
            ..flight(0.1, Vector3::new(25.0, 3.0, 1.0))
        };
        let (start, _) = steady(&rotor, &point);
        let states = motion(&rotor, &point, start, 360);
        let state = states[360];
        close(state.azimuth, 2.0 * PI, 1e-12, "one revolution");
        let mut expected = start;
        expected.azimuth = state.azimuth;
        let change = state.largest_change(&expected);
        assert!(change < 1e-7, "{inflow:?}: {change:e}");
        // After a quarter of a revolution blade 1 is where blade 2 was.
        close(
            states[90].flaps[0].angle,
            start.flaps[1].angle,
            1e-8,
            "next blade",
        );
        assert!((start.flaps[0].angle - start.flaps[2].angle).abs() > 1e-3);
    }
}

/// The stiffer the blades, the less they bend: k beta is the moment of the lift. Springs at which
/// blades vibrate in time with their passage are among these.
#[test]
fn a_steady_start_is_found_however_stiff_the_blades_are() {
    let rotor = Build {
        inflow: Inflow::PittPetersDynamic,
        elements: 10,
        ..Build::default()
    }
    .rotor();
    let mut previous = None;
    for spring in [0.0, 1e2, 1e4, 1e5, 2e5, 5e5, 1e6, 1e8, 1e10] {
        let point = OperatingPoint {
            hinge_spring: spring,
            ..flight(0.1, Vector3::new(25.0, 0.0, 1.0))
        };
        let mut workspace = Workspace::new(&rotor);
        let started = rotor.start(&point, Start::Steady, STEP, &mut workspace);
        let Started { state, is_found } = started.unwrap();
        assert!(is_found, "spring {spring}");
        let largest = state
            .flaps
            .iter()
            .map(|f| f.angle.abs())
            .fold(0.0, f64::max);
        if let Some((spring_before, largest_before)) = previous.replace((spring, largest))
            && spring_before >= 1e5
        {
            close(
                largest * spring / (largest_before * spring_before),
                1.0,
                0.03,
                "stiffness",
            );
        }
    }
}

/// The flap angle of the start is that to which the blades settle in time.
#[test]
fn a_rotor_too_slow_to_integrate_over_a_blade_passage_starts_in_its_motion() {
    let rotor = Build {
        inflow: Inflow::Linear(Skew::Uniform),
        elements: 6,
        ..Build::default()
    }
    .rotor();
    // A blade passage of 0.16 s takes 5,000 steps at 32,000 rad/s.
    let point = OperatingPoint {
        speed: 0.1 * SPEED,
        hinge_spring: 1e9 * INERTIA,
        ..flight(0.1, Vector3::new(3.0, 0.0, 0.0))
    };
    let mut workspace = Workspace::new(&rotor);
    let started = rotor
        .start(&point, Start::Steady, STEP, &mut workspace)
        .unwrap();
    assert!(started.is_found);
    let rates = rotor.rates(&point, &started.state, &mut workspace).unwrap();
    let [angle, acceleration] = [started.state.flaps[0].angle, rates.flaps[0].rate];
    assert!(angle.abs() > 1e-9);
    // The blade follows its load: what is left of k beta/I in its acceleration is small.
    assert!(
        (acceleration / (1e9 * angle)).abs() < 1e-3,
        "{acceleration} {angle}"
    );
}

/// Hub loads and rates, with the blades turned together with everything else.
#[test]
fn turning_the_whole_problem_and_the_blades_turns_forces_and_moments() {
    let angle = 0.7_f64;
    let turned = |v: Vector3<f64>| {
        let (sin, cos) = angle.sin_cos();
        Vector3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z)
    };
    for inflow in [
        Inflow::Elements(ElementInflow::Annulus),
        Inflow::Linear(Skew::Drees),
        Inflow::Elements(ElementInflow::FiniteBlades),
        Inflow::PittPetersDynamic,
        peters_he(4, &geometry(BLADES), 100),
    ] {
        let rotor = Build {
            inflow: inflow.clone(),
            offset: 0.05,
            pitch_flap: 0.2,
            precone: 0.03,
            ..Build::default()
        }
        .rotor();
        let point = OperatingPoint {
            hinge_spring: 50.0,
            cyclic_longitudinal: 0.03,
            cyclic_lateral: -0.02,
            ..unsymmetrical()
        };
        let mut state = opposed(0.02);
        state.azimuth = 0.3;
        state.flaps[1].rate = 0.5;
        state.inflow[0] = 1.0;
        let cyclic = turned(Vector3::new(
            point.cyclic_lateral,
            point.cyclic_longitudinal,
            0.0,
        ));
        let other = OperatingPoint {
            cyclic_lateral: cyclic.x,
            cyclic_longitudinal: cyclic.y,
            airspeed: turned(point.airspeed),
            angular_velocity: turned(point.angular_velocity),
            gravity: turned(point.gravity),
            ..point
        };
        let mut other_state = state;
        other_state.azimuth += angle;
        let mut workspaces = [Workspace::new(&rotor), Workspace::new(&rotor)];
        let [first, second] = &mut workspaces;
        let one = rotor.respond(&point, &state, first).unwrap();
        let two = rotor.respond(&other, &other_state, second).unwrap();
        let (a, b) = (one.hub, two.hub);
        assert!(
            (turned(a.force) - b.force).norm() < 1e-12 * a.force.norm(),
            "{inflow:?}"
        );
        assert!(
            (turned(a.moment) - b.moment).norm() < 1e-11 * a.force.norm(),
            "{inflow:?}"
        );
        let (a, b) = (one.rates, two.rates);
        for (a, b) in a.flaps.iter().zip(b.flaps) {
            close(b.rate, a.rate, 1e-8, "beta''");
        }
        close(b.inflow[0], a.inflow[0], 1e-9 * a.inflow[0].abs(), "inflow");
    }
}

#[test]
fn a_clockwise_rotor_flaps_as_the_mirror_image() {
    let mirrored = |v: Vector3<f64>| Vector3::new(v.x, -v.y, v.z);
    let point = unsymmetrical();
    let other = OperatingPoint {
        airspeed: mirrored(point.airspeed),
        angular_velocity: -mirrored(point.angular_velocity),
        gravity: mirrored(point.gravity),
        ..point
    };
    let build = |rotation| Build {
        offset: 0.05,
        rotation,
        inflow: Inflow::PittPetersDynamic,
        ..Build::default()
    };
    let (state, a) = steady(&build(Rotation::CounterClockwise).rotor(), &point);
    let (other_state, b) = steady(&build(Rotation::Clockwise).rotor(), &other);
    assert_eq!(state, other_state);
    assert_eq!(mirrored(a.force), b.force);
    assert_eq!(-mirrored(a.moment), b.moment);
    assert_eq!(a.tip_path, b.tip_path);
}

/// One or two blades show the same lean as three or more.
#[test]
fn few_blades_show_the_same_cone() {
    let cone = |blades| {
        let rotor = Build {
            blades,
            elements: 20,
            ..Build::default()
        }
        .rotor();
        let point = OperatingPoint {
            cyclic_lateral: 0.02,
            cyclic_longitudinal: 0.01,
            ..hover(0.08)
        };
        steady(&rotor, &point).1.tip_path
    };
    for blades in [1, 2, 3, 8] {
        let path = cone(blades);
        assert!(path.coning > 0.0);
        close(path.longitudinal, -0.01, 1e-4, &format!("a1 of {blades}"));
        close(path.lateral, 0.02, 2e-4, &format!("b1 of {blades}"));
    }
}

/// In still air at a pitch of 0.1 rad, from flat blades.
#[test]
fn blades_of_a_stopped_rotor_fall_and_swing() {
    let rotor = Build {
        elements: 10,
        ..Build::default()
    }
    .rotor();
    let point = OperatingPoint {
        speed: 0.0,
        gravity: Vector3::new(0.0, 0.0, -STANDARD_GRAVITY),
        ..hover(0.1)
    };
    let (mut state, _) = steady(&rotor, &point);
    let mut workspace = Workspace::new(&rotor);
    let mut lowest = 0.0_f64;
    for _ in 0..2000 {
        let steps = rotor.division(&point, &state, 0.005).plain;
        for _ in 0..steps as u32 {
            let next = rotor.step(|_| point, &state, 0.005 / steps, &mut workspace);
            state = next.unwrap();
        }
        lowest = lowest.min(state.flaps[0].angle);
    }
    assert!(lowest < -PI / 2.0, "it swings through: {lowest}");
    assert!(
        lowest > -PI - 1e-3,
        "and no higher than where it began: {lowest}"
    );
}

const STOPS: Stops = Stops {
    lowest: -0.1,
    highest: 0.2,
};

fn stopped(gravity: f64) -> OperatingPoint {
    OperatingPoint {
        speed: 0.0,
        gravity: Vector3::new(0.0, 0.0, gravity),
        ..hover(0.0)
    }
}

/// The weight S g cos(beta) of a blade presses it 0.01 rad cos(beta) into the stop. The stop
/// carries its moment to the hub.
#[test]
fn a_blade_rests_on_its_stop_under_its_weight() {
    for (gravity, stop) in [(-STANDARD_GRAVITY, -0.1), (STANDARD_GRAVITY, 0.2)] {
        let rotor = Build {
            blades: 1,
            stops: STOPS,
            elements: 10,
            ..Build::default()
        }
        .rotor();
        let (state, loads) = steady(&rotor, &stopped(gravity));
        let angle = state.flaps[0].angle;
        let depth = 0.01 * angle.cos() * f64::signum(stop);
        close(angle, stop + depth, 1e-12, "angle");
        let weight = 1.5 * INERTIA * gravity * angle.cos();
        close(loads.moment.y, weight, 1e-9, "moment on the hub");
    }
}

/// beta'' of blade 1 at a flap angle and rate.
fn acceleration(rotor: &Rotor, point: &OperatingPoint, angle: f64, rate: f64) -> f64 {
    let mut state = State::default();
    state.flaps[0] = Flap { angle, rate };
    let mut workspace = Workspace::new(rotor);
    rotor.rates(point, &state, &mut workspace).unwrap().flaps[0].rate
}

/// In next to no air: the moment begins at 0, whatever the speed of the impact, and the stop never
/// pulls.
#[test]
fn a_stop_pushes_only_and_without_a_jump() {
    let rotor = Build {
        blades: 1,
        stops: STOPS,
        elements: 10,
        ..Build::default()
    }
    .rotor();
    let point = OperatingPoint {
        air: air(1e-9),
        ..stopped(0.0)
    };
    for (stop, out) in [(-0.1, -1.0), (0.2, 1.0)] {
        for rate in [-5.0, 0.0, 5.0] {
            let push = |depth: f64| {
                let found = acceleration(&rotor, &point, stop + out * depth, out * rate);
                assert!(found * out < 1e-9, "it pulls: {found}");
                found.abs()
            };
            assert!(push(-1e-6) < 1e-9, "between the stops");
            assert!(push(1e-9) < 1e-4, "a jump at {rate} rad/s");
            if rate > 0.0 {
                // K/I = 1.5 g/l/0.01 rad and C = 2 sqrt(K I).
                let stiffness = 150.0 * STANDARD_GRAVITY;
                let expected = stiffness * 0.02 + 2.0 * stiffness.sqrt() * rate;
                close(push(0.02), expected, 1e-6 * expected, "spring and damper");
            }
        }
    }
}

/// A blade that falls onto its droop stop comes to rest there, without jumping back to where it
/// was.
#[test]
fn a_falling_blade_comes_to_rest_on_its_stop() {
    let rotor = Build {
        stops: STOPS,
        elements: 10,
        ..Build::default()
    }
    .rotor();
    let point = stopped(-STANDARD_GRAVITY);
    let mut workspace = Workspace::new(&rotor);
    let mut state = State::default();
    let (mut lowest, mut rebound, mut most) = (0.0_f64, -0.1_f64, 0.0_f64);
    for _ in 0..400 {
        let steps = rotor.division(&point, &state, 0.005).plain;
        most = most.max(steps);
        for _ in 0..steps as u32 {
            let next = rotor.step(|_| point, &state, 0.005 / steps, &mut workspace);
            state = next.unwrap();
        }
        let angle = state.flaps[0].angle;
        lowest = lowest.min(angle);
        if lowest < -0.1 {
            rebound = rebound.max(angle);
        }
    }
    close(
        state.flaps[0].angle,
        -0.1 - 0.01 * 0.1_f64.cos(),
        1e-4,
        "rest",
    );
    assert!(lowest > -0.16 && rebound < -0.05, "{lowest} {rebound}");
    assert!(most <= 2.0, "{most} steps");
}

/// Flapping between the stops has the bits of flapping without stops.
#[test]
fn stops_that_are_not_met_change_no_bit() {
    let at = |stops: Stops| {
        let rotor = Build {
            stops,
            elements: 10,
            offset: 0.05,
            ..Build::default()
        }
        .rotor();
        steady(&rotor, &unsymmetrical())
    };
    let wide = Stops {
        lowest: -0.4,
        highest: 0.6,
    };
    let (with, without) = (at(wide), at(Stops::default()));
    assert!(without.0.flaps[0].angle.abs() > 0.01);
    assert_eq!(with, without);
}

// ------------------------------------------------------------------ seesaw

/// Two blades on one hinge at the shaft.
fn seesaw(precone: f64, undersling: f64, inertia: f64) -> Rotor {
    Build {
        precone,
        inertia,
        blades: 2,
        seesaw: Some(Seesaw { undersling }),
        ..Build::default()
    }
    .rotor()
}

/// The lever of a rod: its mass lies at 2/3 of the length that has its moments.
const FIRST_MOMENT: f64 = 1.5 * INERTIA;
const MASS: f64 = 3.0 * INERTIA;

/// The teeter angle at each step of the azimuth, of a seesaw let go at an angle.
fn teetering(rotor: &Rotor, point: &OperatingPoint, precone: f64, count: usize) -> Vec<f64> {
    let mut state = State::default();
    let amplitude = 1e-3;
    (state.flaps[0].angle, state.flaps[1].angle) = (precone + amplitude, precone - amplitude);
    let states = motion(rotor, point, state, count);
    let angles = states.iter().map(|state| {
        let [one, two] = [0, 1].map(|k| state.flaps[k].angle);
        close(one + two, 2.0 * precone, 1e-14, "the blades are one body");
        (one - two) / 2.0
    });
    angles.collect()
}

/// A rigid body of the moments A about the teeter axis, B along the blades and C about the shaft
/// teeters at Omega sqrt((C - B)/A) (Goldstein 1980, eq. 5-39). The moments are integrals over two
/// rods that rise at the precone from a point below the hinge.
#[test]
fn a_seesaw_teeters_at_the_frequency_of_its_moments_of_inertia() {
    for (precone, undersling, spring) in [
        (0.0, 0.0, 0.0),
        (0.0, 0.0, 100.0),
        (0.1, 0.0, 0.0),
        (0.1, 0.05, 0.0),
        (0.1, 0.05, 100.0),
        (0.05, -0.03, 0.0),
    ] {
        let rotor = seesaw(precone, undersling, INERTIA);
        let point = OperatingPoint {
            hinge_spring: spring,
            ..airless(1e-9)
        };
        let (sin, cos) = f64::sin_cos(precone);
        let high = INERTIA * sin * sin - 2.0 * undersling * FIRST_MOMENT * sin
            + MASS * undersling * undersling;
        let wide = INERTIA * cos * cos;
        let stiffness = (wide - high) * SPEED * SPEED + spring;
        let nu = (stiffness / (wide + high)).sqrt() / SPEED;
        let angles = teetering(&rotor, &point, precone, 1500);
        for (i, angle) in angles.iter().enumerate() {
            let expected = 1e-3 * (nu * STEP * i as f64).cos();
            let what = format!("precone {precone}, u {undersling}, k {spring}, step {i}");
            close(*angle, expected, 2e-6, &what);
        }
    }
}

/// Euler's equation about the teeter axis, A w_2' = (C - B) w_3 w_1 + M_2 (Goldstein 1980, eq.
/// 5-39), for a hub that rolls, pitches and yaws, a shaft that leans and a teeter angle that is not
/// small. The moments of inertia and that of the weight are sums over masses along the blades.
#[test]
fn a_seesaw_on_a_turning_hub_obeys_eulers_equation() {
    let (precone, undersling, teeter, azimuth) = (0.1, 0.05, 0.2, 0.7_f64);
    let rotor = seesaw(precone, undersling, INERTIA);
    let gravity = Vector3::new(1.0, 2.0, -9.0);
    let hub = Vector3::new(1.5, -2.5, 0.8);
    let point = OperatingPoint {
        angular_velocity: hub,
        gravity,
        ..airless(1e-9)
    };
    let mut state = State {
        azimuth,
        ..State::default()
    };
    for (k, angle) in [precone + teeter, precone - teeter].into_iter().enumerate() {
        state.flaps[k] = Flap { angle, rate: 0.0 };
    }
    let mut workspace = Workspace::new(&rotor);
    let rates = rotor.rates(&point, &state, &mut workspace).unwrap();
    let found = [rates.flaps[0].rate, rates.flaps[1].rate];
    close(found[0] + found[1], 0.0, 1e-9, "the blades are one body");

    let out = Vector3::new(-azimuth.cos(), -azimuth.sin(), 0.0);
    let up = Vector3::new(0.0, 0.0, 1.0);
    let across = up.cross(&out);
    let along = out * teeter.cos() + up * teeter.sin();
    let normal = along.cross(&across);
    // Rods of the same moments as the blades, cut into pieces.
    let (mut a, mut b, mut c, mut weight) = (0.0, 0.0, 0.0, 0.0);
    let count = 20_000;
    let mass = MASS / f64::from(count);
    for side in [1.0, -1.0] {
        for i in 0..count {
            let s = (f64::from(i) + 0.5) / f64::from(count);
            let (x, z) = (side * s * precone.cos(), s * precone.sin() - undersling);
            a += mass * (x * x + z * z);
            b += mass * z * z;
            c += mass * x * x;
            weight += (along * x + normal * z).cross(&gravity).dot(&across) * mass;
        }
    }
    let total = hub + up * SPEED;
    let (one, three) = (total.dot(&along), total.dot(&normal));
    // The teeter axis turns with the rotor against the hub: w_t' = (Omega x e_t) . w.
    let axis_turns = (up * SPEED).cross(&across).dot(&hub);
    let expected = axis_turns - ((c - b) * three * one + weight) / a;
    close(found[0], expected, 1e-6 * expected.abs(), "b''");
}

/// On a rotor that does not turn it swings as a compound pendulum about the hinge: its weight times
/// the depth of its centre of mass over its moment of inertia.
#[test]
fn an_underslung_seesaw_hangs_as_a_pendulum() {
    let undersling = 0.2;
    let rotor = seesaw(0.0, undersling, INERTIA);
    let point = OperatingPoint {
        speed: 0.0,
        gravity: Vector3::new(0.0, 0.0, -STANDARD_GRAVITY),
        ..airless(1e-9)
    };
    let depth = MASS * STANDARD_GRAVITY * undersling;
    let frequency = (depth / (INERTIA + MASS * undersling * undersling)).sqrt();
    let angles = teetering(&rotor, &point, 0.0, 2000);
    for (i, angle) in angles.iter().enumerate() {
        let expected = 1e-3 * (frequency * STEP / SPEED * i as f64).cos();
        close(*angle, expected, 2e-6, &format!("step {i}"));
    }
    // On a shaft that leans by 0.1 rad it still hangs straight down.
    let lean = 0.1_f64;
    let point = OperatingPoint {
        gravity: Vector3::new(lean.sin(), 0.0, -lean.cos()) * STANDARD_GRAVITY,
        ..point
    };
    let mut workspace = Workspace::new(&rotor);
    let started = rotor
        .start(&point, Start::Steady, STEP, &mut workspace)
        .unwrap();
    // What hangs below the hinge swings forward, so that blade 1, over the tail, goes down.
    close(started.state.flaps[0].angle, -lean, 1e-9, "blade 1");
    close(started.state.flaps[1].angle, lean, 1e-9, "blade 2");
}

/// Harmonic balance of the blade's moment in linear aerodynamics and uniform inflow, without
/// reversed flow: with U_T = r + mu sin psi and U_P = lambda + r beta' + mu beta cos psi, the first
/// harmonics of the integral of (theta U_T^2 - U_P U_T) r dr are 0 for a flapping frequency of
/// 1/rev, so that
///
/// ```text
/// a1 = mu (8/3 theta - 2 lambda)/(1 - mu^2/2),   b1 = 4/3 mu a0/(1 + mu^2/2)
/// ```
///
/// (as in Bramwell 1976, "Helicopter Dynamics", ch. 5). They do not depend on the Lock number: the
/// coning a0 of a seesaw is its precone. The theory's inflow is constant; that of two blades varies
/// twice per revolution with their thrust, for which 1 % of a1 is allowed.
#[test]
fn a_seesaw_flaps_at_mu_0_2_as_in_theory_whatever_its_lock_number() {
    let (mu, theta) = (0.2, 0.1);
    for precone in [0.0, 0.04] {
        let mut found = Vec::new();
        for inertia in [0.5 * INERTIA, INERTIA, 2.0 * INERTIA] {
            let rotor = seesaw(precone, 0.0, inertia);
            let point = flight(theta, Vector3::new(mu * SPEED, 0.0, 0.0));
            let mut workspace = Workspace::new(&rotor);
            let started = rotor
                .start(&point, Start::Steady, STEP, &mut workspace)
                .unwrap();
            assert!(started.is_found);
            let states = motion(&rotor, &point, started.state, 0);
            let turns = motion(
                &rotor,
                &point,
                states[0],
                (2.0 * PI / STEP).round() as usize,
            );
            let count = turns.len() - 1;
            let (mut a1, mut b1, mut lambda) = (0.0, 0.0, 0.0);
            for state in &turns[..count] {
                let loads = hub_loads(&rotor, &point, state);
                let psi = state.azimuth;
                a1 -= 2.0 * (state.flaps[0].angle - precone) * psi.cos() / count as f64;
                b1 -= 2.0 * (state.flaps[0].angle - precone) * psi.sin() / count as f64;
                lambda += loads.induced_velocity / SPEED / count as f64;
                // Only a spring could hold the hub. The torque of the tilted disc is left out.
                let moment = loads.moment.x.hypot(loads.moment.y);
                let scale = loads.force.z * 1.0;
                assert!(moment <= 2e-3 * scale, "{moment} N.m of {scale}");
                close(loads.tip_path.coning, precone, 1e-12, "coning");
            }
            found.push((a1, b1));
            let expected = mu * (8.0 / 3.0 * theta - 2.0 * lambda) / (1.0 - mu * mu / 2.0);
            close(a1, expected, 0.03 * expected, &format!("a1, I {inertia}"));
            let expected = 4.0 / 3.0 * mu * precone / (1.0 + mu * mu / 2.0);
            let tolerance = 0.03 * expected + 0.01 * a1;
            close(b1, expected, tolerance, &format!("b1, I {inertia}"));
        }
        let small = 0.01 * found[1].0;
        for (a1, b1) in &found {
            close(*a1, found[1].0, small, "a1 by Lock number");
            close(*b1, found[1].1, small, "b1 by Lock number");
        }
    }
}

/// The seesaw's spring alone holds the hub: N/2 k a1 on average, with N = 2 (Johnson 1980, section
/// 5-13, without offset).
#[test]
fn the_steady_hub_moment_of_a_seesaw_is_that_of_its_springs() {
    for spring in [0.0, 60.0] {
        let rotor = seesaw(0.03, 0.02, INERTIA);
        let point = OperatingPoint {
            hinge_spring: spring,
            ..flight(0.1, Vector3::new(0.2 * SPEED, 0.0, 0.0))
        };
        let mut workspace = Workspace::new(&rotor);
        let started = rotor
            .start(&point, Start::Steady, STEP, &mut workspace)
            .unwrap();
        assert!(started.is_found);
        let turns = motion(
            &rotor,
            &point,
            started.state,
            (2.0 * PI / STEP).round() as usize,
        );
        let count = turns.len() - 1;
        let (mut moment, mut spring_moment) = (Vector3::zeros(), Vector3::zeros());
        let (mut a1, mut thrust) = (0.0, 0.0);
        for state in &turns[..count] {
            let loads = hub_loads(&rotor, &point, state);
            moment += loads.moment / count as f64;
            thrust += loads.force.z / count as f64;
            let teeter = (state.flaps[0].angle - state.flaps[1].angle) / 2.0;
            a1 -= 2.0 * teeter * state.azimuth.cos() / count as f64;
            // About the teeter axis, which turns with the blades.
            let (sin, cos) = state.azimuth.sin_cos();
            let axis = Vector3::new(-sin, cos, 0.0);
            spring_moment += axis * (2.0 * spring * teeter) / count as f64;
        }
        assert!(a1 > 0.01, "{a1}");
        for i in [0, 1] {
            close(
                moment[i],
                spring_moment[i],
                2e-3 * thrust,
                &format!("moment {i}"),
            );
        }
        if spring > 0.0 {
            close(moment.y, -spring * a1, 0.1 * spring * a1, "N/2 k a1");
        }
    }
}

/// A stiff spring takes the exponential method, whose slopes are those of the seesaw.
#[test]
fn a_stiff_seesaw_is_integrated_as_exactly_as_a_soft_one() {
    let rotor = Build {
        blades: 2,
        elements: 10,
        seesaw: Some(Seesaw::default()),
        ..Build::default()
    }
    .rotor();
    let point = OperatingPoint {
        hinge_spring: 1e6 * INERTIA * SPEED * SPEED,
        ..flight(0.05, Vector3::new(0.1 * SPEED, 0.0, 0.0))
    };
    let mut workspace = Workspace::new(&rotor);
    let mut state = State {
        azimuth: 0.3,
        ..State::default()
    };
    state.flaps[0].angle = 1e-3;
    state.flaps[1].angle = -1e-3;
    let duration = STEP / SPEED;
    assert!(rotor.division(&point, &state, duration).is_stiff());
    let first = rotor.rates(&point, &state, &mut workspace).unwrap();
    let step = rotor.stiff_step_from(&first, |_| point, &state, duration, &mut workspace);
    let step = step.unwrap().expect("accurate");
    let count = 2000;
    let mut fine = state;
    for _ in 0..count {
        let part = duration / f64::from(count);
        fine = rotor.step(|_| point, &fine, part, &mut workspace).unwrap();
    }
    for k in [0, 1] {
        close(
            step.end.flaps[k].angle,
            fine.flaps[k].angle,
            1e-6,
            &format!("blade {k}"),
        );
    }
}

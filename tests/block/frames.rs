//! Frames: from the ground to the hub and back, wind, and the direction of rotation.

use crate::support::block::{computed, default_block, get, set, thrust};
use helicopter_rotor::block::variables::{RealRef, integer, real};
use nalgebra::Vector3;
use std::f64::consts::PI;

fn close(found: f64, expected: f64, part: f64, what: &str) {
    let scale = expected.abs();
    assert!(
        (found - expected).abs() <= part * scale,
        "{what}: {found:e}, expected {expected:e}"
    );
}

#[test]
fn tilt_turns_the_hub_forces_into_the_ground_frame_and_the_flow_into_the_disc() {
    let tilt = 0.3_f64;
    let block = computed(&[(real::TILT, tilt)], &[]);
    let (t, q) = (get(&block, real::THRUST), get(&block, real::TORQUE));
    for (reference, expected) in [
        (real::FORCE_1, t * tilt.sin()),
        (real::FORCE_2, 0.0),
        (real::FORCE_3, t * tilt.cos()),
        (real::MOMENT_1, -q * tilt.sin()),
        (real::MOMENT_3, -q * tilt.cos()),
        (real::HUB_FORCE_3, t),
        (real::HUB_MOMENT_3, -q),
    ] {
        assert!(
            (get(&block, reference) - expected).abs() < 1e-12 * t,
            "{}",
            reference.variable().name
        );
    }
    // Motion along the tilted shaft is climb, apart from the rounding of the edgewise flow.
    let climb = thrust(&[(real::VELOCITY_3, 3.0)]);
    let along = thrust(&[
        (real::TILT, tilt),
        (real::VELOCITY_1, 3.0 * tilt.sin()),
        (real::VELOCITY_3, 3.0 * tilt.cos()),
    ]);
    assert!((along / climb - 1.0).abs() < 1e-12);
}

#[test]
fn wind_is_the_same_as_moving_against_it_to_the_last_bit() {
    for speed in [-7.0, 0.1, 4.0] {
        let moving = thrust(&[(real::VELOCITY_3, speed), (real::TILT, 0.1)]);
        let blown = thrust(&[(real::WIND_3, -speed), (real::TILT, 0.1)]);
        assert_eq!(moving.to_bits(), blown.to_bits());
    }
}

#[test]
fn clockwise_rotation_mirrors_the_moment_only() {
    let other = computed(&[], &[(integer::GEOMETRY__ROTATION, 2)]);
    let block = computed(&[], &[]);
    for reference in [real::THRUST, real::TORQUE, real::POWER, real::FORCE_3] {
        assert_eq!(get(&other, reference), get(&block, reference));
    }
    assert_eq!(get(&other, real::MOMENT_3), -get(&block, real::MOMENT_3));
}

#[test]
fn the_block_turns_motion_into_the_hub_frame_and_loads_out_of_it() {
    let mut block = default_block();
    let (tilt, lateral) = (0.2_f64, -0.1_f64);
    for (reference, value) in [
        (real::TILT, tilt),
        (real::LATERAL_TILT, lateral),
        (real::VELOCITY_1, 12.0),
        (real::VELOCITY_2, 3.0),
        (real::WIND_3, 1.0),
        (real::ANGULAR_VELOCITY_2, 0.2),
    ] {
        set(&mut block, reference, value);
    }
    block.update().unwrap();
    let out = |reference: RealRef| get(&block, reference);
    let axis = Vector3::new(
        tilt.sin() * lateral.cos(),
        -lateral.sin(),
        tilt.cos() * lateral.cos(),
    );
    let force = Vector3::new(out(real::FORCE_1), out(real::FORCE_2), out(real::FORCE_3));
    let moment = Vector3::new(
        out(real::MOMENT_1),
        out(real::MOMENT_2),
        out(real::MOMENT_3),
    );
    close(
        force.dot(&axis),
        out(real::THRUST),
        1e-12,
        "thrust is the force along the shaft",
    );
    close(
        moment.dot(&axis),
        -out(real::TORQUE),
        1e-12,
        "torque is the moment along the shaft",
    );
    let airspeed = Vector3::new(12.0, 3.0, -1.0);
    let edgewise = (airspeed - axis * airspeed.dot(&axis)).norm();
    close(
        out(real::ADVANCE_RATIO),
        edgewise / (960.0 * PI / 30.0 * 0.762),
        1e-12,
        "mu",
    );
    let hub = Vector3::new(
        out(real::HUB_FORCE_1),
        out(real::HUB_FORCE_2),
        out(real::HUB_FORCE_3),
    );
    close(hub.norm(), force.norm(), 1e-12, "turning keeps the length");
}

/// The default rotor, rolling to the right at 1 rad/s: N I Omega p = 20.1 N.m lower the nose, those
/// of a clockwise rotor raise it; also with a torque that drives the shaft, at the speed that it
/// has then. The rest is what the air does.
#[test]
fn rigid_blades_exert_their_gyroscopic_moment_on_a_rolling_hub() {
    let gyroscopic = 4.0 * 0.05 * 960.0 * PI / 30.0;
    assert!((gyroscopic - 20.1).abs() < 0.01);
    let with = |inertia: f64, rotation: i32, drive: i32| {
        computed(
            &[
                (real::ANGULAR_VELOCITY_1, 1.0),
                (real::FLAPPING__INERTIA, inertia),
            ],
            &[
                (integer::GEOMETRY__ROTATION, rotation),
                (integer::DRIVE__MODE, drive),
            ],
        )
    };
    for (rotation, sense) in [(1, 1.0), (2, -1.0)] {
        for drive in [1, 2] {
            let (block, light) = (with(0.0, rotation, drive), with(1e-15, rotation, drive));
            let moment = |reference: RealRef| get(&block, reference) - get(&light, reference);
            close(
                moment(real::HUB_MOMENT_2),
                sense * gyroscopic,
                1e-9,
                "pitch",
            );
            close(moment(real::MOMENT_2), sense * gyroscopic, 1e-9, "ground");
            assert!(moment(real::HUB_MOMENT_1).abs() < 1e-9);
            assert_eq!(moment(real::HUB_MOMENT_3), 0.0);
            assert_eq!(moment(real::TORQUE), 0.0);
        }
    }
}

//! Every model gives finite numbers in every flow. Each test computes thousands of operating
//! points.

use crate::support::block::{default_block, set, set_integer};
use helicopter_rotor::block::variables::{integer, real};

#[test]
fn every_model_is_finite_in_every_direction_of_flow_and_pitch() {
    let mut count = 0;
    let mut block = default_block();
    set_integer(&mut block, integer::NUMERICS__ELEMENTS, 8);
    for models in (0..9 * 2 * 3 * 4).map(|i| [1 + i % 9, 1 + i / 9 % 2, 1 + i / 18 % 3, 1 + i / 54])
    {
        let references = [
            integer::MODELS__INFLOW,
            integer::MODELS__LIFT,
            integer::MODELS__TIP_LOSS,
            integer::MODELS__COMPRESSIBILITY,
        ];
        block.set_integers(&references, &models).unwrap();
        for rpm in [0.0, 1.0, 960.0, 1440.0, 20_000.0] {
            for climb in [-60.0, -9.0, -4.0, -1.0, 0.0, 1e-9, 2.0, 12.0, 30.0] {
                for degrees in (-168..=168).step_by(16) {
                    let reals = [f64::from(degrees).to_radians(), rpm, climb];
                    let references = [real::COLLECTIVE, real::RPM, real::VELOCITY_3];
                    block.set_reals(&references, &reals).unwrap();
                    // Outputs that are not finite are an error.
                    block
                        .update()
                        .unwrap_or_else(|e| panic!("{models:?} {reals:?}: {e}"));
                    count += 1;
                }
            }
        }
    }
    println!("{count} combinations");
}

#[test]
fn every_inflow_model_without_states_is_finite_at_every_advance_climb_pitch_and_speed() {
    let mut block = default_block();
    set_integer(&mut block, integer::NUMERICS__ELEMENTS, 8);
    let mut count = 0;
    let choices = integer::MODELS__INFLOW.variable().choices;
    for (inflow, name) in (1..).zip(choices) {
        // Models with states need a steady start, which may not exist. all_combinations.rs has
        // them.
        if ["pittPetersDynamic", "petersHe"].contains(name) {
            continue;
        }
        set_integer(&mut block, integer::MODELS__INFLOW, inflow);
        for rpm in [0.0, 1.0, 480.0, 1440.0] {
            set(&mut block, real::RPM, rpm);
            for edgewise in [0.0, 1e-6, 4.0, 40.0] {
                set(&mut block, real::VELOCITY_1, edgewise);
                for climb in [-12.0, -6.0, -3.0, 0.0, 3.0, 12.0] {
                    set(&mut block, real::VELOCITY_3, climb);
                    for degrees in [-20.0_f64, -3.0, 0.0, 8.0, 25.0, 90.0] {
                        set(&mut block, real::COLLECTIVE, degrees.to_radians());
                        // Outputs that are not finite are an error.
                        block.update().unwrap_or_else(|e| panic!("{name}: {e}"));
                        count += 1;
                    }
                }
            }
        }
    }
    println!("{count} flights");
}

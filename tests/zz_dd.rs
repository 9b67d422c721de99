//! scratch
mod support {
    pub mod block;
}
use helicopter_rotor::block::{
    RotorBlock,
    variables::{Causality, INTEGERS, REALS, STATES, boolean, integer, is_state, real, string},
};
use support::block::*;
fn outputs(b: &mut RotorBlock) -> Vec<f64> {
    b.update().unwrap();
    b.values().reals.to_vec()
}
#[test]
fn dd() {
    let mut worst_all = 0.0f64;
    let filter = std::env::var("ONLY").unwrap_or_default();
    for model in INTEGERS[integer::MODEL__INFLOW].choices.iter() {
        for blades in ["automatic", "disc", "flap"] {
            for descent in ["momentum", "measured", "johnson"] {
                for (vi, v) in [
                    [0.0, 0.0, 0.0],
                    [0.0, 0.0, 4.0],
                    [0.0, 0.0, -5.0],
                    [17.0, 3.0, 1.0],
                    [12.0, -2.0, -4.0],
                ]
                .iter()
                .enumerate()
                {
                    if v[2] >= 0.0 && descent != "measured" {
                        continue;
                    }
                    if *model == "annulusClosedForm" && blades == "flap" {
                        continue;
                    }
                    let name = format!("{model} {blades} {descent} {vi}");
                    if !name.contains(&filter) {
                        continue;
                    }
                    let mut b = default_block();
                    let path = std::env::var("AIRFOIL").unwrap();
                    if path != "default" {
                        b.set_strings(&[string::AIRFOIL__FILE as u32], &[&path])
                            .unwrap();
                        choose(&mut b, integer::MODEL__LIFT, "thesisSlope");
                    }
                    choose(&mut b, integer::MODEL__INFLOW, model);
                    choose(&mut b, integer::MODEL__DESCENT, descent);
                    if blades == "flap" {
                        b.set_booleans(&[boolean::FLAPPING__ENABLED as u32], &[1])
                            .unwrap();
                        set(&mut b, real::FLAPPING__HINGE_OFFSET, 0.05);
                        set(&mut b, real::FLAPPING__DELTA3, 0.2);
                    } else {
                        choose(&mut b, integer::MODEL__BLADES, blades);
                    }
                    if vi == 1 {
                        choose(&mut b, integer::DRIVE_MODE, "torque");
                        set(&mut b, real::DRIVE_TORQUE, 3.0);
                    }
                    if vi == 3 && *model != "annulusClosedForm" {
                        choose(&mut b, integer::MODEL__GROUND_EFFECT, "cheesemanBennett");
                        set(&mut b, real::HEIGHT_ABOVE_GROUND, 1.9);
                    }
                    if vi == 4 {
                        choose(&mut b, integer::GEOMETRY__ROTATION, "clockwise");
                        set(&mut b, real::CYCLIC_LATERAL, 0.03);
                        set(&mut b, real::CYCLIC_LONGITUDINAL, 0.02);
                        set(&mut b, real::TILT, 0.1);
                        set(&mut b, real::ANGULAR_VELOCITY_1, 0.2);
                        set(&mut b, real::ANGULAR_VELOCITY_2, 0.2);
                    }
                    for k in 0..3 {
                        set(
                            &mut b,
                            [real::VELOCITY_1, real::VELOCITY_2, real::VELOCITY_3][k],
                            v[k],
                        );
                    }
                    set(&mut b, real::COLLECTIVE, 0.15);
                    if b.start().is_err() {
                        println!("no start {name}");
                        continue;
                    }
                    b.step(0.003).unwrap();
                    b.begin_integration().unwrap();
                    let base = outputs(&mut b);
                    let knowns: Vec<usize> = (0..REALS.len())
                        .filter(|i| REALS[*i].causality == Causality::Input || is_state(*i as u32))
                        .collect();
                    let unknowns: Vec<usize> = (0..REALS.len())
                        .filter(|i| {
                            REALS[*i].causality == Causality::Output
                                || STATES.iter().any(|s| s.derivative == *i)
                        })
                        .collect();
                    let refs: Vec<u32> = unknowns.iter().map(|u| *u as u32).collect();
                    let scale = |k: usize| {
                        if is_state(k as u32) {
                            STATES.iter().find(|s| s.place == k).unwrap().nominal
                        } else {
                            match REALS[k].unit {
                                "rad" => 0.1,
                                "rev/min" => 1000.0,
                                "m/s" => 10.0,
                                "rad/s" => 1.0,
                                "N.m" => 5.0,
                                "m" => {
                                    if k == real::ALTITUDE {
                                        1000.0
                                    } else {
                                        1.0
                                    }
                                }
                                u => panic!("{u}"),
                            }
                        }
                    };
                    let mut table = vec![];
                    for k in &knowns {
                        let h = 1e-4 * scale(*k);
                        let mut at = |d: f64| -> Vec<f64> {
                            b.set_reals(&[*k as u32], &[base[*k] + d]).unwrap();
                            let o = outputs(&mut b);
                            unknowns.iter().map(|u| o[*u]).collect()
                        };
                        let r = std::env::var("H")
                            .map(|x| x.parse::<f64>().unwrap())
                            .unwrap_or(1.0);
                        let h = h * r;
                        let (p1, m1, p2, m2) = (at(h), at(-h), at(2.0 * h), at(-2.0 * h));
                        at(0.0);
                        let mut dd = vec![0.0; unknowns.len()];
                        if let Err(e) =
                            b.directional_derivative(&refs, &[*k as u32], &[1.0], &mut dd)
                        {
                            println!("ERR {name} {}: {e}", REALS[*k].name);
                            dd.fill(f64::NAN);
                        }
                        let fd: Vec<f64> = (0..unknowns.len())
                            .map(|i| (8.0 * (p1[i] - m1[i]) - (p2[i] - m2[i])) / (12.0 * h))
                            .collect();
                        table.push((dd, fd));
                    }
                    let mut worst = (0.0, String::new());
                    for (j, u) in unknowns.iter().enumerate() {
                        let row = knowns
                            .iter()
                            .enumerate()
                            .map(|(i, k)| table[i].0[j].abs() * scale(*k))
                            .fold(
                                match REALS[*u].unit {
                                    "N" | "N.m" | "W" => 1.0,
                                    "1" => 1e-4,
                                    _ => 0.01,
                                },
                                f64::max,
                            );
                        if vi < 3 && *u == real::ADVANCE_RATIO {
                            continue;
                        }
                        for (i, k) in knowns.iter().enumerate() {
                            let (dd, fd) = (table[i].0[j], table[i].1[j]);
                            let e = (dd - fd).abs() * scale(*k) / row;
                            let e = if e.is_nan() { 1e9 } else { e };
                            if e > worst.0 {
                                worst = (
                                    e,
                                    format!(
                                        "d {} / d {}: {dd:e} fd {fd:e}",
                                        REALS[*u].name, REALS[*k].name
                                    ),
                                );
                            }
                        }
                    }
                    worst_all = worst_all.max(worst.0);
                    println!("DD {name}: {:.1e} {}", worst.0, worst.1);
                }
            }
        }
    }
    println!("worst {worst_all:e}");
}

//! Section data: any text is an airfoil whose coefficients are finite, or an error of limited
//! length. The first byte chooses the format by the name of the file.

#![no_main]

use fuzz::{finite, promise};
use libfuzzer_sys::fuzz_target;
use rotor::{
    airfoil::{Airfoil, Axis, Lift, SectionModel, Similarity},
    compressibility::Compressibility,
};
use std::path::Path;

fuzz_target!(|data: &[u8]| {
    let Some((first, rest)) = data.split_first() else {
        return;
    };
    let Ok(text) = std::str::from_utf8(rest) else {
        return;
    };
    let name = ["a.polar", "a.c81", "a.txt"][usize::from(*first) % 3];
    let airfoil = match Airfoil::from_text(text, Path::new(name)) {
        Ok(airfoil) => airfoil,
        Err(error) => {
            let message = error.to_string();
            promise(message.chars().count() <= 500, || message.clone());
            return;
        }
    };
    promise(airfoil.name().chars().count() <= 80, || {
        airfoil.name().into()
    });
    for lift in [Lift::Table, Lift::TwoPi, Lift::SlopesByReynolds] {
        let model = SectionModel {
            lift,
            compressibility: Compressibility::PrandtlGlauert,
            drag_reynolds_exponent: 0.2,
        };
        for i in -40_i32..=40 {
            let alpha = 0.1 * f64::from(i);
            let flow = Similarity {
                reynolds: f64::from(i.pow(4)),
                mach: f64::from(i.abs()) / 40.0,
            };
            let (slope, zero) = airfoil.lift_line(&model, alpha, flow);
            let (negative, positive) = airfoil.stall_angles(flow);
            finite(&[
                airfoil.lift_coefficient(&model, 0.1, alpha, flow),
                airfoil.drag_coefficient(&model, alpha, flow),
                slope,
                zero,
                negative,
                positive,
            ]);
        }
    }
    for axis in [Axis::Reynolds, Axis::Mach] {
        if let Some((low, high)) = airfoil.range(axis) {
            finite(&[low, high]);
        }
    }
});

//! The readers answer any file with an airfoil or an error, and never panic.

use super::{Airfoil, Lift, SectionModel, Similarity, formats::FORMATS};
use crate::compressibility::Compressibility;
use proptest::{prelude::*, sample::Index};
use std::path::Path;

/// A good file of each format.
const SAMPLES: [&str; FORMATS.len()] = [
    "#1\ndouble airfoil(2, 7)\n2e4 6.2 3.0 0.175 0.032 0 1.1\n1e6 6.3, 4.6; 0.297 0.0096 0 0.36 # x\n",
    "polar 1\nname x\nreynolds 1e5\n-180 0 0.02\n0 0 0.01 # note\n10 1 0.02 -0.1\n180 0 0.02\n",
    "Test section                   1 3 1 3 1 2\n          0.00\n-180.00   0.00\n   0.00   0.10\n 180.00   0.00\n          0.00\n-180.00   0.03\n   0.00   0.01\n 180.00   0.03\n",
];

/// Good files in other forms, and files of other programs, which are recognised.
const OTHERS: [&str; 6] = [
    "POLAR 1\nNAME; x\nMach,0.3\n-180;0;2d-2\n0\t0\t0.01\n180,0,0.02\nmach 0.7\n-180 0 0.02\n180 0 0.02\n",
    "1 0 0\n0 1\n0.158 0.158\nCOMMENT#1\n1000000.0    0.200\n 010201020102\n 0.2\n-180 0\n180 0\n0.2\n-180 0.1\n180 0.1\n0.2\n-180 0\n180 0\n",
    "# FREE FORMAT\nx; 1 2 1 2 1 2\n0.2\n-180 0\n180 0\n0.2\n-180 0.1\n180 0.1\n",
    "       XFOIL         Version 6.99\n Calculated polar for: x\n Mach =   0.000     Re =     0.500 e 6\n  alpha    CL        CD\n  0.000   0.1000   0.01000\n",
    "x\n1000000\n0\n-0.1\t-0.5\t0.02\n0.1\t0.5\t0.02\n",
    "x\n1 0\n.8 .1\n.6 .1\n.4 .1\n.2 .1\n0 0\n.2 -.1\n.4 -.1\n.6 -.1\n.8 -.1\n1 0\n",
];

/// What is put into a good file.
fn piece() -> impl Strategy<Value = String> {
    prop_oneof![
        Just(String::new()),
        prop::sample::select(vec![
            " ",
            "\n",
            "\t",
            "\r\n",
            "-",
            "#",
            "(",
            ")",
            ",",
            ";",
            "1e999",
            "nan",
            "99",
            "999999999999",
            "-180.00",
            "double a(9,9)",
            "reynolds 1",
            "\u{feff}",
            "\0",
            "ü",
            "1d5",
            "e",
            ".",
            "0.0",
        ])
        .prop_map(str::to_owned),
        "\\PC{0,4}",
    ]
}

/// A good file with some pieces of it replaced.
fn damaged() -> impl Strategy<Value = String> {
    let change = (any::<Index>(), 0..12_usize, piece());
    let changes = prop::collection::vec(change, 1..4);
    let samples = [&SAMPLES[..], &OTHERS[..]].concat();
    (prop::sample::select(samples), changes).prop_map(|(sample, changes)| {
        let mut text: Vec<char> = sample.chars().collect();
        for (place, length, piece) in changes {
            let begin = place.index(text.len() + 1);
            let end = (begin + length).min(text.len());
            text.splice(begin..end, piece.chars());
        }
        text.into_iter().collect()
    })
}

#[allow(clippy::disallowed_methods)] // the last bits of these numbers do not matter
fn check(text: &str) {
    for name in ["x.polar", "x.c81", "x.txt"] {
        if let Err(error) = Airfoil::from_text(text, Path::new(name)) {
            assert!(error.to_string().chars().count() <= 500, "{error}");
        }
    }
    let _ = Airfoil::raw_polars(text, "x");
    let _ = Airfoil::raw_c81(text, "x");
    for format in &FORMATS {
        let Ok(airfoil) = (format.parse)(text, "x") else {
            continue;
        };
        let model = SectionModel {
            lift: Lift::Table,
            compressibility: Compressibility::PrandtlGlauert,
            drag_reynolds_exponent: 0.2,
        };
        for i in -40_i32..=40 {
            let alpha = f64::from(i) * 0.1;
            let flow = Similarity {
                reynolds: libm::pow(10.0, f64::from(i.abs() / 4)),
                mach: f64::from(i.abs()) / 40.0,
            };
            // The values themselves may be as absurd as the file.
            let _ = airfoil.lift_coefficient(&model, 0.1, alpha, flow);
            let _ = airfoil.drag_coefficient(&model, alpha, flow);
            let _ = airfoil.stall_angles(flow);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 1000, ..ProptestConfig::default() })]

    #[test]
    fn damaged_files_never_panic(text in damaged()) {
        check(&text);
    }

    #[test]
    fn any_text_never_panics(text in "(?s).{0,200}") {
        check(&text);
        check(&format!("#1\ndouble x(2,5)\n{text}"));
        check(&format!("polar 1\nreynolds 1\n{text}"));
        check(&format!("name 2 3 1 3\n{text}"));
        check(&format!("2 0 0\n0 1\n0 0\n{text}"));
    }
}

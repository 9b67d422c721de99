//! The corrected section tables against assessed measurements.
//!
//! The numbers and their sources are in `provenance/airfoil-tables`.

use crate::support::published_airfoil;
use rotor::{
    airfoil::{Airfoil, Lift, SectionModel, Similarity},
    compressibility::Compressibility,
};

const MODEL: SectionModel = SectionModel {
    lift: Lift::Table,
    compressibility: Compressibility::None,
    drag_reynolds_exponent: 0.2,
};

fn at(reynolds: f64) -> Similarity<f64> {
    Similarity {
        reynolds,
        mach: 0.0,
    }
}

/// At an angle of attack in deg.
fn lift(airfoil: &Airfoil, reynolds: f64, alpha: f64) -> f64 {
    airfoil.lift_coefficient(&MODEL, 0.0, alpha.to_radians(), at(reynolds))
}

/// At zero lift.
fn least_drag(airfoil: &Airfoil, reynolds: f64) -> f64 {
    airfoil.drag_coefficient(&MODEL, 0.0, at(reynolds))
}

/// 1/rad, by least squares over 4 deg.
fn slope(airfoil: &Airfoil, reynolds: f64) -> f64 {
    let (mut product, mut square) = (0.0, 0.0);
    for step in 1..=8 {
        let alpha = 0.5 * f64::from(step);
        product += alpha * lift(airfoil, reynolds, alpha);
        square += alpha * alpha;
    }
    (product / square).to_degrees()
}

/// The largest lift up to 25 deg and its angle, deg.
fn largest_lift(airfoil: &Airfoil, reynolds: f64) -> (f64, f64) {
    (0..=250)
        .map(|step| 0.1 * f64::from(step))
        .map(|alpha| (lift(airfoil, reynolds, alpha), alpha))
        .fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a })
}

fn assert_near(computed: f64, measured: f64, tolerance: f64, what: &str) {
    let error = computed / measured - 1.0;
    assert!(
        error.abs() <= tolerance,
        "{what}: {computed:.5} against {measured:.5}, {:+.1} %",
        100.0 * error
    );
}

/// W. J. McCroskey, "A Critical Assessment of Wind Tunnel Results for the NACA 0012 Airfoil", NASA
/// TM 100019 (1987), Fig. 3, at Mach 0; 1/rad. Stated in the data of NASA's Turbulence Modeling
/// Resource.
fn mccroskey(reynolds: f64) -> f64 {
    (0.1025 + 0.00485 * (reynolds / 1e6).log10()).to_degrees()
}

#[test]
fn the_lift_slope_is_that_of_mccroskeys_fit() {
    for file in ["naca0012.polar", "naca0015.polar"] {
        let airfoil = published_airfoil(file);
        for reynolds in [1e6, 2e6, 3e6, 5e6, 1e7] {
            let what = format!("{file} at Re {reynolds}");
            assert_near(slope(&airfoil, reynolds), mccroskey(reynolds), 0.03, &what);
        }
    }
}

/// Knight & Hefner (1937), NACA TN 626, the only measured section data at the Reynolds numbers of
/// model rotors that could be read.
#[test]
fn naca_0015_agrees_with_the_measurements_at_low_reynolds_number() {
    let reynolds = 242_000.0;
    let measured = published_airfoil("naca0015-knight-hefner.polar");
    let table = published_airfoil("naca0015.polar");
    // The points up to 4 deg, and what Knight & Hefner themselves take (Castles & Gray 1951, NACA
    // TN 2474, Table VIII).
    for measured in [5.55, 5.73] {
        assert_near(slope(&table, reynolds), measured, 0.03, "lift slope");
    }
    assert_near(
        least_drag(&table, reynolds),
        least_drag(&measured, reynolds),
        0.01,
        "drag at zero lift",
    );
    // From 20 deg on lift rises again to a second maximum.
    let peak = |airfoil| {
        (0..=40)
            .map(|step| lift(airfoil, reynolds, 0.5 * f64::from(step)))
            .fold(0.0, f64::max)
    };
    assert_near(peak(&table), peak(&measured), 0.01, "largest lift");
    for step in 0..=12 {
        let alpha = f64::from(step);
        let difference = lift(&table, reynolds, alpha) - lift(&measured, reynolds, alpha);
        assert!(difference.abs() < 0.05, "{alpha} deg: {difference}");
    }
}

/// Gregory & O'Reilly (1970), R&M 3726, and Ladson (1988), NASA TM 4074, both with fixed
/// transition, from the data of NASA's Turbulence Modeling Resource; of Ladson's three grits the
/// mean.
#[test]
fn naca_0012_stalls_as_measured() {
    let airfoil = published_airfoil("naca0012.polar");
    for (reynolds, measured, angle) in [(3e6, 1.561, 16.1), (6e6, 1.623, 17.2)] {
        let (largest, stall) = largest_lift(&airfoil, reynolds);
        assert_near(largest, measured, 0.03, &format!("Re {reynolds}"));
        assert!((stall - angle).abs() <= 1.0, "Re {reynolds}: {stall} deg");
    }
}

/// Sheldahl & Klimas (1981), SAND80-2114: the middle of the two angles between which the pitching
/// moment breaks. The tables are not made from these.
#[test]
fn naca_0012_stalls_at_the_angle_at_which_the_moment_was_measured_to_break() {
    let airfoil = published_airfoil("naca0012.polar");
    for (reynolds, angle) in [
        (360e3, 11.5),
        (500e3, 11.5),
        (700e3, 11.5),
        (860e3, 13.5),
        (1.36e6, 14.0),
        (1.76e6, 14.5),
    ] {
        let (_, stall) = airfoil.stall_angles(at(reynolds));
        let stall = stall.to_degrees();
        assert!((stall - angle).abs() <= 1.5, "Re {reynolds}: {stall} deg");
    }
}

/// Free transition: Abbott & von Doenhoff (1959). Fixed: Ladson (1988). In the turbulent stream of
/// the variable-density tunnel, by effective Reynolds number: Jacobs & Sherman (1937), NACA Report
/// 586, Table I.
#[test]
fn the_least_drag_of_naca_0012_is_that_in_a_turbulent_stream() {
    let airfoil = published_airfoil("naca0012.polar");
    let drag = least_drag(&airfoil, 6e6);
    let (free, fixed) = (0.0059, 0.0081);
    assert!((free..fixed).contains(&drag), "{drag}");
    for (reynolds, measured) in [(3.54e6, 0.0077), (6.28e6, 0.0073), (8.37e6, 0.0069)] {
        let what = format!("Re {reynolds}");
        assert_near(least_drag(&airfoil, reynolds), measured, 0.03, &what);
    }
}

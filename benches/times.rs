//! How long typical flights take. Absolute times depend on the machine and on its load: compare
//! them with each other in one run. `benches/instructions.rs` counts the same flights.
//!
//!     cargo bench --bench times

mod flights;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use flights::{AZIMUTH_STEP, Begin, Flight, REAL_TIME_RPM, blades::Blades};

/// Steps with the collective that moves.
fn steps(criterion: &mut Criterion) {
    let flapping = Begin::flapping;
    for (name, begin, duration) in [
        ("hover, annuli", Begin::hover(""), 1e-3),
        (
            "hover, closed form",
            Begin::hover("models.inflow = annulusClosedForm"),
            1e-3,
        ),
        (
            "hover, closed form, 4 elements",
            Begin::hover("models.inflow = annulusClosedForm; numerics.elements = 4"),
            1e-3,
        ),
        ("descent, annuli, measured", Begin::descent(""), 1e-3),
        (
            "descent, annuli, Johnson",
            Begin::descent("models.descent = johnson"),
            1e-3,
        ),
        (
            "azimuth step, Pitt & Peters",
            flapping("pittPetersDynamic"),
            AZIMUTH_STEP,
        ),
        (
            "azimuth step, Peters & He",
            flapping("petersHe"),
            AZIMUTH_STEP,
        ),
        ("azimuth step, uniform", flapping("uniform"), AZIMUTH_STEP),
        ("azimuth step, annuli", flapping("annulus"), AZIMUTH_STEP),
        (
            "azimuth step, finite blades",
            flapping("finiteBlades"),
            AZIMUTH_STEP,
        ),
        (
            "azimuth step, lift ends by the thrust",
            flapping("pittPetersDynamic; models.tipLoss = prandtlThrust"),
            AZIMUTH_STEP,
        ),
    ] {
        let mut flight = Flight::under_way(begin);
        criterion.bench_function(name, |bencher| bencher.iter(|| flight.exchange(duration)));
    }
}

/// How much faster than real time a flapping rotor is at 430 rev/min, in steps of 3 deg. Elements
/// are simulated microseconds: Melem/s is the factor.
fn real_time(criterion: &mut Criterion) {
    let duration = 3.0 / (6.0 * REAL_TIME_RPM);
    let mut group = criterion.benchmark_group("real-time factor in Melem per s");
    group.throughput(Throughput::Elements((duration * 1e6).round() as u64));
    for inflow in [
        "pittPetersDynamic",
        "petersHe",
        "uniform",
        "annulus",
        "finiteBlades",
    ] {
        let mut flight = Flight::under_way(Begin::flapping(inflow).at(REAL_TIME_RPM));
        group.bench_function(inflow, |bencher| bencher.iter(|| flight.exchange(duration)));
    }
}

/// One evaluation of 4 x 40 elements.
fn evaluation(criterion: &mut Criterion) {
    let mut blades = Blades::new();
    let name = "evaluation of 4 x 40 elements, Pitt & Peters";
    criterion.bench_function(name, |bencher| bencher.iter(|| blades.rates()));
}

/// One directional derivative.
fn derivatives(criterion: &mut Criterion) {
    for (name, begin) in [
        ("derivative, hover, annuli", Begin::hover("")),
        (
            "derivative, Pitt & Peters",
            Begin::flapping("pittPetersDynamic"),
        ),
    ] {
        let mut flight = Flight::begun(begin);
        criterion.bench_function(name, |bencher| bencher.iter(|| flight.derivative()));
    }
}

/// The end of the initialization.
fn starts(criterion: &mut Criterion) {
    for (name, begin) in [
        ("start, hover, annuli", Begin::hover("")),
        (
            "start, 12 Reynolds numbers",
            Begin::hover("airfoil.file = airfoils/naca0015.polar"),
        ),
        ("start, Pitt & Peters", Begin::flapping("pittPetersDynamic")),
        ("start, uniform", Begin::flapping("uniform")),
    ] {
        criterion.bench_function(name, |bencher| {
            let prepared = || Flight::prepared(begin.clone());
            let start = |mut flight: Flight| {
                flight.initialize();
                flight
            };
            bencher.iter_batched(prepared, start, BatchSize::SmallInput);
        });
    }
}

criterion_group!(benches, steps, real_time, evaluation, derivatives, starts);
criterion_main!(benches);

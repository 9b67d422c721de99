//! What the rotor costs in instructions, counted by valgrind, so that the machine's load makes no
//! difference. `benches/instructions.py` runs it, writes the counts and compares them.

mod flights;

use flights::{AZIMUTH_STEP, Begin, Flight};
use gungraun::{library_benchmark, library_benchmark_group, main};

/// Hover in still air.
const fn hover(settings: &'static str) -> Begin {
    Begin {
        settings,
        forward: 0.0,
        climb: 0.0,
    }
}

/// Forward flight at an advance ratio of 0.2.
const fn forward(settings: &'static str) -> Begin {
    Begin {
        settings,
        forward: 15.3,
        climb: 0.0,
    }
}

/// Descent in the vortex ring state.
const fn descent(settings: &'static str) -> Begin {
    Begin {
        settings,
        forward: 0.0,
        climb: -4.0,
    }
}

#[library_benchmark(setup = Flight::under_way)]
#[bench::annulus(hover(""))]
#[bench::closed_form(hover("models.inflow = annulusClosedForm"))]
#[bench::four_elements(hover("models.inflow = annulusClosedForm; numerics.elements = 4"))]
fn hover_step(mut flight: Flight) -> Flight {
    flight.set(8.1, 0.0);
    flight.step(1e-3);
    flight.get();
    flight
}

#[library_benchmark(setup = Flight::under_way)]
#[bench::annulus(hover(""))]
fn set_3_and_get_6(mut flight: Flight) -> Flight {
    flight.set(8.0, 0.0);
    flight.get();
    flight
}

#[library_benchmark(setup = Flight::under_way)]
#[bench::annulus_johnson(descent("models.descent = johnson"))]
#[bench::annulus_measured(descent(""))]
fn descent_step(mut flight: Flight) -> Flight {
    flight.set(8.1, 0.0);
    flight.step(1e-3);
    flight.get();
    flight
}

#[library_benchmark(setup = Flight::under_way)]
#[bench::pitt_peters(forward("flapping.enabled = true; models.inflow = pittPetersDynamic"))]
#[bench::peters_he(forward("flapping.enabled = true; models.inflow = petersHe"))]
#[bench::uniform(forward("flapping.enabled = true; models.inflow = uniform"))]
#[bench::annulus(forward("flapping.enabled = true"))]
#[bench::finite_blades(forward("flapping.enabled = true; models.inflow = finiteBlades"))]
#[bench::prandtl_thrust(forward(
    "flapping.enabled = true; models.inflow = pittPetersDynamic; models.tipLoss = prandtlThrust"
))]
fn azimuth_step(mut flight: Flight) -> Flight {
    flight.set(8.1, 15.3);
    flight.step(AZIMUTH_STEP);
    flight.get();
    flight
}

#[library_benchmark(setup = Flight::begun)]
#[bench::hover(hover(""))]
#[bench::pitt_peters(forward("flapping.enabled = true; models.inflow = pittPetersDynamic"))]
fn derivative(mut flight: Flight) -> Flight {
    flight.derivative();
    flight
}

#[library_benchmark(setup = Flight::prepared)]
#[bench::default(hover(""))]
#[bench::twelve_layers(hover("airfoil.file = airfoils/naca0015.polar"))]
#[bench::flapping_pitt_peters(forward(
    "flapping.enabled = true; models.inflow = pittPetersDynamic"
))]
#[bench::flapping_uniform(forward("flapping.enabled = true; models.inflow = uniform"))]
fn start(mut flight: Flight) -> Flight {
    flight.initialize();
    flight
}

library_benchmark_group!(
    name = rows,
    benchmarks = [
        hover_step,
        set_3_and_get_6,
        descent_step,
        azimuth_step,
        derivative,
        start
    ]
);
main!(library_benchmark_groups = rows);

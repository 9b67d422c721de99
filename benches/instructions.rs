//! What the rotor costs in instructions, counted by valgrind, so that the machine's load makes no
//! difference. `benches/instructions.py` runs it, writes the counts and compares them.

mod flights;

use flights::{AZIMUTH_STEP, Begin, Flight, blades::Blades};
use gungraun::{library_benchmark, library_benchmark_group, main};

#[library_benchmark(setup = Flight::under_way)]
#[bench::annulus(Begin::hover(""))]
#[bench::closed_form(Begin::hover("models.inflow = annulusClosedForm"))]
#[bench::four_elements(Begin::hover("models.inflow = annulusClosedForm; numerics.elements = 4"))]
#[bench::elements_10(Begin::hover("numerics.elements = 10"))]
#[bench::elements_100(Begin::hover("numerics.elements = 100"))]
#[bench::elements_1000(Begin::hover("numerics.elements = 1000"))]
fn hover_step(mut flight: Flight) -> Flight {
    flight.exchange(1e-3);
    flight
}

#[library_benchmark(setup = Flight::under_way)]
#[bench::annulus(Begin::hover(""))]
fn set_3_and_get_6(mut flight: Flight) -> Flight {
    flight.set(8.0);
    flight.get();
    flight
}

#[library_benchmark(setup = Flight::under_way)]
#[bench::annulus_johnson(Begin::descent("models.descent = johnson"))]
#[bench::annulus_measured(Begin::descent(""))]
fn descent_step(mut flight: Flight) -> Flight {
    flight.exchange(1e-3);
    flight
}

#[library_benchmark(setup = Flight::under_way)]
#[bench::pitt_peters(Begin::flapping("pittPetersDynamic"))]
#[bench::peters_he(Begin::flapping("petersHe"))]
#[bench::uniform(Begin::flapping("uniform"))]
#[bench::annulus(Begin::flapping("annulus"))]
#[bench::finite_blades(Begin::flapping("finiteBlades"))]
#[bench::prandtl_thrust(Begin::flapping("pittPetersDynamic; models.tipLoss = prandtlThrust"))]
#[bench::blades_2(Begin::flapping("pittPetersDynamic; geometry.numberOfBlades = 2"))]
#[bench::blades_8(Begin::flapping("pittPetersDynamic; geometry.numberOfBlades = 8"))]
#[bench::elements_10(Begin::flapping("pittPetersDynamic; numerics.elements = 10"))]
#[bench::elements_1000(Begin::flapping("pittPetersDynamic; numerics.elements = 1000"))]
fn azimuth_step(mut flight: Flight) -> Flight {
    flight.exchange(AZIMUTH_STEP);
    flight
}

#[library_benchmark(setup = Blades::new)]
#[bench::pitt_peters()]
fn evaluation(mut blades: Blades) -> Blades {
    blades.rates();
    blades
}

#[library_benchmark(setup = Flight::begun)]
#[bench::hover(Begin::hover(""))]
#[bench::pitt_peters(Begin::flapping("pittPetersDynamic"))]
fn derivative(mut flight: Flight) -> Flight {
    flight.derivative();
    flight
}

#[library_benchmark(setup = Flight::prepared)]
#[bench::default(Begin::hover(""))]
#[bench::twelve_layers(Begin::hover("airfoil.file = airfoils/naca0015.polar"))]
#[bench::flapping_pitt_peters(Begin::flapping("pittPetersDynamic"))]
#[bench::flapping_uniform(Begin::flapping("uniform"))]
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
        evaluation,
        derivative,
        start
    ]
);
main!(library_benchmark_groups = rows);

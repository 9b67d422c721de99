//! Every width of lanes gives the same bits: over many random flights, in every model, with
//! derivatives.

use crate::{
    air::Air,
    airfoil::{Airfoil, Lift, SectionModel},
    compressibility::Compressibility,
    error::SolveError,
    flapping::{BladeMass, Freedom, Hinge, Stops},
    geometry::{Elements, Geometry, Station},
    hub_loads::HubLoads,
    inflow::{Descent, ElementInflow, GroundEffect, Inflow, Number, Skew},
    models::{Blades, Models},
    numbers::{Dual64, Width},
    operating_point::{Drive, OperatingPoint},
    rotor::Rotor,
    seesaw::Seesaw,
    state::State,
    tip_loss::TipLoss,
    workspace::Workspace,
};
use nalgebra::Vector3;
use std::{cell::Cell, path::Path};

/// Number of rotors, and of flights with each: half of them carry a derivative.
const ROTORS: u32 = 500;
const FLIGHTS: u32 = 200;

/// Knuth's linear congruential generator (1998, The Art of Computer Programming 2, 3.3.4).
struct Random(Cell<u64>);

impl Random {
    /// From 0 to 1.
    fn part(&self) -> f64 {
        let next = self.0.get().wrapping_mul(6_364_136_223_846_793_005);
        self.0.set(next.wrapping_add(1_442_695_040_888_963_407));
        (self.0.get() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.part()
    }

    fn below(&self, count: usize) -> usize {
        (self.part() * count as f64) as usize
    }

    fn any<T: Copy>(&self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// A number in a range; in a part of all cases exactly one that makes a corner.
    fn with_corner(&self, low: f64, high: f64, corner: f64) -> f64 {
        if self.part() < 0.3 {
            corner
        } else {
            self.between(low, high)
        }
    }

    fn rotor(&self, airfoils: &[Airfoil; 4]) -> Rotor {
        let blades = 1 + self.below(4) as u32;
        let mut geometry = Geometry::linear(blades, 1.5, 0.2, 0.12, self.between(0.5, 1.2), -0.1);
        let inner = self.below(airfoils.len());
        let outer = self.any(&[inner, self.below(airfoils.len())]);
        let twist = geometry.stations[0].twist;
        geometry.airfoils = vec!["inner".to_owned(), "outer".to_owned()];
        geometry.stations.insert(
            1,
            Station {
                radius_ratio: 0.6,
                chord: 0.12,
                twist: 0.5 * twist,
                airfoil: 1,
            },
        );
        let elements = Elements::new(&geometry, 1 + self.below(11));
        let airfoils = vec![airfoils[inner].clone(), airfoils[outer].clone()];
        let ratios = elements.radius_ratios(geometry.radius);
        let element_models = [
            ElementInflow::Annulus,
            ElementInflow::AnnulusClosedForm,
            ElementInflow::FiniteBlades,
        ];
        let inflow = match self.below(4) {
            0 => Inflow::Elements(self.any(&element_models)),
            1 => Inflow::Linear(self.any(&Skew::ALL)),
            2 => Inflow::PittPetersDynamic,
            _ => Inflow::peters_he(1 + self.below(6), blades as usize, &ratios),
        };
        let freedom = Freedom {
            pitch_flap: self.between(-0.2, 0.2),
            length: 1.4,
            stops: Stops::default(),
        };
        let models = Models {
            inflow,
            descent: self.any(&[Descent::Momentum, Descent::Measured, Descent::Johnson]),
            ground_effect: self.any(&[
                GroundEffect::None,
                GroundEffect::CheesemanBennett,
                GroundEffect::Hayden,
            ]),
            blades: self.any(&[Blades::Automatic, Blades::Disc, Blades::Individual]),
            hinge: Hinge {
                offset: self.any(&[0.0, 0.1, 0.5]),
                precone: self.any(&[0.0, 0.05]),
                mass: BladeMass::rod(0.5, 1.4),
                freedom: self.any(&[None, Some(freedom)]),
            },
            seesaw: (blades == 2).then(Seesaw::default),
            tip_loss: self.any(&[
                TipLoss::None,
                TipLoss::Prandtl,
                TipLoss::PrandtlTipAndRoot,
                TipLoss::HalfTipChord,
                TipLoss::Sissingh,
                TipLoss::PrandtlThrust,
            ]),
            section: SectionModel {
                lift: self.any(&[
                    Lift::Table,
                    Lift::Table,
                    Lift::TwoPi,
                    Lift::SlopesByReynolds,
                ]),
                compressibility: self.any(&[
                    Compressibility::None,
                    Compressibility::PrandtlGlauert,
                    Compressibility::KarmanTsien,
                    Compressibility::Laitone,
                ]),
                drag_reynolds_exponent: self.any(&[0.0, 0.2]),
            },
        };
        Rotor::new(geometry, elements, airfoils, models)
    }

    fn point(&self) -> OperatingPoint {
        OperatingPoint {
            cyclic_longitudinal: self.with_corner(-0.1, 0.1, 0.0),
            cyclic_lateral: self.with_corner(-0.1, 0.1, 0.0),
            airspeed: Vector3::new(
                self.with_corner(-40.0, 40.0, 0.0),
                self.with_corner(-10.0, 10.0, 0.0),
                self.with_corner(-15.0, 15.0, 0.0),
            ),
            angular_velocity: Vector3::new(
                self.with_corner(-0.5, 0.5, 0.0),
                self.with_corner(-0.5, 0.5, 0.0),
                self.with_corner(-0.5, 0.5, 0.0),
            ),
            height: self.between(0.0, 6.0),
            drive: self.any(&[
                Drive::Speed,
                Drive::Torque {
                    torque: 20.0,
                    inertia: 2.0,
                },
            ]),
            ..OperatingPoint::hover(
                self.with_corner(-0.3, 0.5, 0.0),
                self.with_corner(0.0, 80.0, 0.0),
                Air::standard(self.between(0.0, 3000.0)),
            )
        }
    }

    fn state(&self, point: &OperatingPoint) -> State {
        let mut state = State {
            azimuth: self.between(-7.0, 7.0),
            speed: point.speed,
            ..State::default()
        };
        let is_quiet = self.part() < 0.3;
        for v in &mut state.inflow {
            *v = if is_quiet {
                0.0
            } else {
                self.between(-2.0, 4.0)
            };
        }
        for flap in &mut state.flaps {
            flap.angle = self.between(-0.2, 0.4);
            flap.rate = self.between(-5.0, 5.0);
        }
        state
    }
}

/// What a flight gives, or the sentence that it gives instead.
fn bits<S: Number>(
    rotor: &Rotor,
    point: &OperatingPoint<S>,
    state: &State<S>,
    workspace: &mut Workspace<S>,
    write: fn(S) -> [u64; 2],
) -> Result<Vec<[u64; 2]>, SolveError> {
    let response = rotor.respond(point, state, workspace)?;
    let HubLoads {
        force,
        moment,
        torque,
        induced_velocity,
        ..
    } = response.hub;
    let rates = &response.rates;
    let flaps = rates.flaps.iter().flat_map(|flap| [flap.angle, flap.rate]);
    let elements = response.blade.elements().iter().flat_map(|load| {
        [
            load.thrust,
            load.torque,
            load.angle_of_attack,
            load.induced_velocity,
            load.mean_induced_velocity,
            load.lift_coefficient,
            load.drag_coefficient,
        ]
    });
    let hub = force.iter().chain(&moment).copied();
    let all = hub
        .chain([torque, induced_velocity, rates.speed])
        .chain(rates.inflow)
        .chain(flaps)
        .chain(elements);
    Ok(all.map(write).collect())
}

/// The bits, and one NaN for all.
fn plain(value: f64) -> u64 {
    if value.is_nan() { f64::NAN } else { value }.to_bits()
}

#[test]
fn every_width_of_lanes_gives_the_same_bits() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = folder.join("../../modelDescription/resources/airfoils");
    let airfoils = [
        "naca0015-knight-hefner.polar",
        "naca0015.polar",
        "naca0015.txt",
        "goettingen429.polar",
    ];
    let airfoils = airfoils.map(|file| Airfoil::read(&folder.join(file)).unwrap());
    let random = Random(Cell::new(20_261_126));
    let (mut solved, mut failed) = (0, 0);
    for _ in 0..ROTORS {
        let rotor = random.rotor(&airfoils);
        let in_width = |width: Width| Workspace {
            width,
            ..Workspace::new(&rotor)
        };
        let dual_in_width = |width: Width| Workspace::<Dual64> {
            width,
            ..Workspace::new(&rotor)
        };
        let widths = [Width::Single, Width::Portable, Width::Widest];
        let mut workspaces = widths.map(in_width);
        let mut duals = widths.map(dual_in_width);
        for flight in 0..FLIGHTS {
            let point = random.point();
            let state = random.state(&point);
            let [single, others @ ..] = if flight % 2 == 0 {
                [0, 1, 2].map(|i| {
                    let write = |x: f64| [plain(x), 0];
                    bits(&rotor, &point, &state, &mut workspaces[i], write)
                })
            } else {
                let along = |x: f64| Dual64::new(x, random.any(&[0.0, 0.0, 1.0, -1.0]));
                let (point, state) = (point.map(along), state.map(along));
                [0, 1, 2].map(|i| {
                    let write = |x: Dual64| [plain(x.re), plain(x.eps)];
                    bits(&rotor, &point, &state, &mut duals[i], write)
                })
            };
            match &single {
                Ok(_) => solved += 1,
                Err(_) => failed += 1,
            }
            for other in others {
                assert_eq!(single, other, "{:?}\n{point:?}\n{state:?}", rotor.models());
            }
        }
    }
    assert!(solved > 100 * failed, "{failed} flights without a solution");
}

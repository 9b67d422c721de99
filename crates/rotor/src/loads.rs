//! The loads of the rotor: all elements at all places, in what the inflow models induce.

use super::{
    Drive, Operation, Performance, Response, Rotor, SolveError, State,
    airfoil::Similarity,
    disc::{AZIMUTHS, Place},
    element::{Element, LossIn, Section},
    flapping::Action,
    inflow::{
        Field, Induced, Inflow, Skew, annulus, closed_form,
        descent::FlowState,
        finite_blades,
        ground::Ground,
        linear::Coefficients,
        peters_he::{Harmonics, Wake},
        uniform,
    },
    root::RootError,
    scalar::Scalar,
    scene::Scene,
    state::MOST_INFLOW_STATES,
    turn::{Turn, mean_thrust},
};
use core::{cell::Cell, f64::consts::PI};
use nalgebra::Vector3;

/// Sums over elements and places, in the axes of the disc's flow.
pub(super) struct Sums<S = f64> {
    /// Of the air.
    pub force: Vector3<S>,
    pub moment: Vector3<S>,
    /// Moment of the air about one blade's hinge, N.m, at each place.
    pub hinge_moments: [S; AZIMUTHS],
    /// What drives the states of Peters & He, m2/s2.
    pub loading: [S; MOST_INFLOW_STATES],
    flux: S,
    area: f64,
    stalled: f64,
    stalled_radius: f64,
}

/// What induces the velocity at the blades.
enum Induction<'a, S> {
    /// The elements themselves.
    Elements,
    /// A distribution over the disc.
    Field(Field<S>),
    /// The states of Peters & He, in the axes of the disc's flow, with the azimuths' harmonics.
    Series {
        wake: &'a Wake,
        states: &'a [S],
        harmonics: &'a [Harmonics<S>],
    },
}

impl<S: Scalar> Rotor<S> {
    /// What the rotor does in a state, and how the state changes. Allocates nothing.
    ///
    /// A clockwise rotor is computed as the mirror image of a counter-clockwise one.
    pub fn respond(
        &mut self,
        operation: &Operation<S>,
        state: &State<S>,
    ) -> Result<Response<S>, SolveError> {
        let operation = &operation.at_speed_of(state);
        let scene = self.scene(operation, state);
        let sums = self.fly(&scene, operation, state)?;
        Ok(Response {
            performance: self.performance_in(operation, state, &scene, &sums),
            rates: self.rates_in(operation, state, &scene, &sums),
        })
    }

    /// What the rotor does in a state.
    pub fn performance(
        &mut self,
        operation: &Operation<S>,
        state: &State<S>,
    ) -> Result<Performance<S>, SolveError> {
        Ok(self.respond(operation, state)?.performance)
    }

    fn performance_in(
        &self,
        operation: &Operation<S>,
        state: &State<S>,
        scene: &Scene<S>,
        sums: &Sums<S>,
    ) -> Performance<S> {
        let mut moment = sums.moment;
        if let Some(freedom) = &self.models.hinge.freedom {
            for (place, hinge_moment) in scene.places.iter().zip(sums.hinge_moments) {
                let action = self.action(operation, scene, hinge_moment);
                let hinge = &self.models.hinge;
                let up = freedom.hub_moment_excess(hinge, &scene.flow, place, &action);
                moment += Vector3::new(-place.azimuth.sin, place.azimuth.cos, S::zero()) * up;
            }
        }
        // A free shaft hands on to the hub what drives it; the rest speeds the rotor up.
        let around = match operation.drive {
            Drive::Speed => moment.z,
            Drive::Torque { torque, .. } => -torque,
        };
        let mirror = self.mirror();
        let (force_x, force_y) = scene.axes.out_of_wind(sums.force.x, sums.force.y);
        let (moment_x, moment_y) = scene.axes.out_of_wind(moment.x, moment.y);
        let radius = self.geometry.radius;
        let induced_velocity = sums.flux / sums.area;
        let flow_state = FlowState::of(
            scene.flow.edgewise.value(),
            scene.flow.climb.value(),
            induced_velocity.value(),
            (sums.force.z / (operation.air.density * PI * radius * radius)).value(),
        );
        Performance {
            force: Vector3::new(force_x, force_y * mirror, sums.force.z),
            moment: Vector3::new(moment_x * mirror, moment_y, around * mirror),
            torque: -moment.z,
            induced_velocity,
            stalled_radius: sums.stalled_radius,
            stalled_fraction: sums.stalled / self.elements.len() as f64,
            tip_path: self.tip_path(operation, state, scene, sums),
            flow_state,
        }
    }

    /// What acts on a blade's hinge.
    pub(super) fn action(
        &self,
        operation: &Operation<S>,
        scene: &Scene<S>,
        moment: S,
    ) -> Action<S> {
        Action {
            moment,
            spring: operation.hinge_spring,
            gravity: scene.gravity,
        }
    }

    pub(super) fn fly_with_shares(
        &mut self,
        scene: &Scene<S>,
        operation: &Operation<S>,
        state: &State<S>,
    ) -> Result<Sums<S>, SolveError> {
        match self.models.inflow {
            Inflow::Annulus | Inflow::AnnulusClosedForm | Inflow::FiniteBlades => {
                self.sums(scene, operation, &Induction::Elements)
            }
            Inflow::Disc(skew) => {
                let field = self.field(skew, scene, operation)?;
                self.sums(scene, operation, &Induction::Field(field))
            }
            Inflow::PittPetersDynamic => {
                let field = scene.axes.field_into_wind(&state.field());
                let left = self
                    .ground(operation)
                    .factor(scene.flow.edgewise, field.mean);
                let field = field.scaled(left);
                self.sums(scene, operation, &Induction::Field(field))
            }
            Inflow::PetersHe { .. } => {
                // Out of the rotor while the sums borrow it.
                let Some(wake) = self.peters_he.take() else {
                    return Err(SolveError::Disc(RootError::NotFinite));
                };
                let mut states = wake.rotated(&state.inflow, scene.axes.cos, scene.axes.sin);
                let mean = wake.mean(&states);
                let left = self.ground(operation).factor(scene.flow.edgewise, mean);
                states.iter_mut().for_each(|state| *state *= left);
                let mut harmonics = [Wake::harmonics(S::one(), S::zero()); AZIMUTHS];
                for (slot, place) in harmonics.iter_mut().zip(scene.places.iter()) {
                    *slot = Wake::harmonics(place.azimuth.cos, place.azimuth.sin);
                }
                let series = Induction::Series {
                    wake: &wake,
                    states: &states,
                    harmonics: &harmonics,
                };
                let sums = self.sums(scene, operation, &series);
                self.peters_he = Some(wake);
                sums
            }
        }
    }

    fn sums(
        &mut self,
        scene: &Scene<S>,
        operation: &Operation<S>,
        induction: &Induction<S>,
    ) -> Result<Sums<S>, SolveError> {
        let mut sums = Sums {
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
            hinge_moments: [S::zero(); AZIMUTHS],
            loading: [S::zero(); MOST_INFLOW_STATES],
            flux: S::zero(),
            area: 0.0,
            stalled: 0.0,
            stalled_radius: 0.0,
        };
        let (flow, places) = (&scene.flow, &scene.places);
        let descent = self.models.descent;
        let ground = self.ground(operation);
        let width = self.elements.width;
        let square = self.geometry.radius * self.geometry.radius;
        for i in 0..self.elements.len() {
            let element = self.element(i, operation);
            let mut turn = Turn::new(&element, flow, places, scene.is_blades);
            let unsolved = |cause| SolveError::Annulus {
                radius_ratio: element.radius_ratio(),
                cause,
            };
            let mean_induced = match induction {
                Induction::Field(field) => {
                    turn.fly(LossIn::Lift, |_, place| {
                        Ok(field.at(element.radius_ratio(), place.azimuth))
                    })?;
                    field.mean
                }
                Induction::Series {
                    wake,
                    states,
                    harmonics,
                } => {
                    turn.fly(LossIn::Lift, |k, _| {
                        Ok(Induced::axial(wake.velocity(states, i, &harmonics[k])))
                    })?;
                    let blades = element.blades / places.len() as f64;
                    for (thrust, harmonics) in
                        turn.thrust_at.iter().zip(*harmonics).take(places.len())
                    {
                        let force = *thrust * blades * width / (operation.air.density * square);
                        wake.add_load(&mut sums.loading, i, harmonics, force);
                    }
                    wake.mean_at(states, i)
                }
                Induction::Elements => match self.models.inflow {
                    Inflow::AnnulusClosedForm => {
                        let rotation = flow.rotation * element.radius;
                        let answer =
                            closed_form::solve(&element, rotation, flow.climb).map_err(unsolved)?;
                        turn.take(&answer.load, answer.induced);
                        answer.mean_induced
                    }
                    Inflow::FiniteBlades => {
                        let mean = Cell::new(S::zero());
                        turn.fly(LossIn::Momentum, |_, place| {
                            let meets = flow.meets(element.radius, place);
                            let answer =
                                finite_blades::solve(&element, &meets, flow, descent, ground)
                                    .map_err(unsolved)?;
                            mean.set(mean.get() + answer.mean_axial / places.len() as f64);
                            Ok(answer.induced)
                        })?;
                        mean.get()
                    }
                    _ => {
                        let answer = annulus::solve(&element, flow, places, descent, ground)
                            .map_err(unsolved)?;
                        turn.fly(LossIn::Momentum, |_, _| Ok(answer.induced))?;
                        answer.mean_axial
                    }
                },
            };
            sums.force += turn.force * S::constant(width);
            sums.moment += turn.moment * S::constant(width);
            let moments = &turn.hinge_moment_at[..places.len()];
            for (sum, moment) in sums.hinge_moments.iter_mut().zip(moments) {
                *sum += *moment * width;
            }
            sums.flux += mean_induced * element.radius;
            sums.area += element.radius;
            sums.stalled += turn.stalled;
            if turn.stalled > 0.0 {
                sums.stalled_radius = element.radius_ratio();
            }
            self.loads[i] = turn.load(mean_induced);
        }
        Ok(sums)
    }

    /// Glauert's mean inflow and its distribution, in the axes of the disc's flow.
    pub(super) fn field(
        &self,
        skew: Skew,
        scene: &Scene<S>,
        operation: &Operation<S>,
    ) -> Result<Field<S>, SolveError> {
        let flow = &scene.flow;
        let radius = self.geometry.radius;
        let tip_speed = flow.rotation.abs() * radius;
        let ground = self.ground(operation);
        let distributed = |mean: S| {
            let through = flow.climb + mean;
            let coefficients = skew.coefficients(flow.edgewise, through, tip_speed);
            let Coefficients { kx, ky } = coefficients;
            let field = Field {
                mean,
                cosine: mean * kx,
                sine: mean * ky,
            };
            field.scaled(ground.factor(flow.edgewise, mean))
        };
        let density_area = operation.air.density * PI * radius * radius;
        let thrust = |mean: S| {
            let field = distributed(mean);
            let mut thrust = S::zero();
            for i in 0..self.elements.len() {
                let element = self.element(i, operation);
                let induced = |place: &Place<S>| field.at(element.radius_ratio(), place.azimuth);
                let per_length = mean_thrust(&element, flow, LossIn::Lift, &scene.places, induced);
                thrust += per_length * self.elements.width;
            }
            thrust / density_area
        };
        let scale = (tip_speed + flow.edgewise + flow.climb.abs()).value();
        if scale == 0.0 {
            return Ok(Field::none());
        }
        let descent = self.models.descent;
        let mass_flow = |v: S| descent.speed(flow.edgewise, flow.climb, v);
        let mean = uniform::mean_velocity(mass_flow, flow.climb, scale, thrust)
            .map_err(SolveError::Disc)?;
        Ok(distributed(mean))
    }

    fn ground(&self, operation: &Operation<S>) -> Ground<S> {
        Ground {
            effect: self.models.ground_effect,
            height_ratio: operation.height / self.geometry.radius,
        }
    }

    fn element(&self, i: usize, operation: &Operation<S>) -> Element<'_, S> {
        let (elements, air) = (&self.elements, &operation.air);
        let chord = elements.chord[i];
        Element {
            blades: f64::from(self.geometry.blades),
            radius: elements.radius[i],
            root_radius: self.geometry.cutout() * self.geometry.radius,
            tip_radius: self.geometry.radius,
            chord,
            pitch: operation.collective + elements.twist[i],
            lifting_share: self.lifting_share[i],
            tip_loss: self.models.tip_loss,
            section: Section {
                inner: &self.airfoils[elements.inner_airfoil[i]],
                outer: &self.airfoils[elements.outer_airfoil[i]],
                outer_share: elements.outer_share[i],
            },
            model: &self.models.section,
            unit_flow: Similarity {
                reynolds: air.density * chord / air.viscosity,
                mach: S::one() / air.speed_of_sound,
            },
            density: air.density,
        }
    }
}

//! The loads of the rotor: all elements at all places, in what the inflow models induce.

use super::{
    Blades, Drive, Operation, Performance, Rotor, SolveError, State, TipPath,
    airfoil::Similarity,
    disc::{AZIMUTHS, Azimuth, DiscFlow, Place, Places, WindAxes},
    element::{Element, LossIn, Section},
    flapping::{Action, Flap},
    geometry::Rotation,
    inflow::{
        Field, Induced, Inflow, Skew, annulus, closed_form,
        descent::FlowState,
        finite_blades,
        ground::Ground,
        linear::Coefficients,
        peters_he::{Harmonics, Wake},
        uniform,
    },
    root::{End, RootError, bracketed},
    state::MOST_INFLOW_STATES,
    tip_loss::lifting_share,
    turn::{Turn, mean_thrust},
};
use core::f64::consts::PI;
use nalgebra::Vector3;

/// To which the thrust coefficient is found on which the end of the lift depends.
const THRUST_TOLERANCE: f64 = 1e-13;

/// States of the inflow that break the symmetry about the shaft, as a part of the speeds in the problem, up to
/// which they do not count.
const SYMMETRIC: f64 = 1e-12;

/// Lean of the tip path beyond which one or two blades count as swinging, rad.
const LARGEST_LEAN: f64 = 1.0;

/// The rotor's motion in axes turned into the wind, and where its blades are.
pub(super) struct Scene {
    pub axes: WindAxes,
    pub flow: DiscFlow,
    pub gravity: Vector3<f64>,
    pub places: Places,
    /// Whether the places are those of the blades, rather than of a mean over the turn.
    pub is_blades: bool,
}

/// Sums over elements and places, in the axes of the disc's flow.
pub(super) struct Sums {
    /// Of the air.
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
    /// Moment of the air about one blade's hinge, N.m, at each place.
    pub hinge_moments: [f64; AZIMUTHS],
    /// What drives the states of Peters & He, m2/s2.
    pub loading: [f64; MOST_INFLOW_STATES],
    flux: f64,
    area: f64,
    stalled: f64,
    stalled_radius: f64,
}

/// What induces the velocity at the blades.
enum Induction<'a> {
    /// The elements themselves.
    Elements,
    /// A distribution over the disc.
    Field(Field),
    /// The states of Peters & He, in the axes of the disc's flow, with the azimuths' harmonics.
    Series {
        wake: &'a Wake,
        states: &'a [f64],
        harmonics: &'a [Harmonics],
    },
}

impl Rotor {
    /// What the rotor does in a state. Allocates nothing.
    ///
    /// A clockwise rotor is computed as the mirror image of a counter-clockwise one.
    pub fn performance(
        &mut self,
        operation: &Operation,
        state: &State,
    ) -> Result<Performance, SolveError> {
        let operation = &operation.at_speed_of(state);
        let scene = self.scene(operation, state);
        let sums = self.fly(&scene, operation, state)?;
        let mut moment = sums.moment;
        if let Some(freedom) = &self.models.hinge.freedom {
            for (place, hinge_moment) in scene.places.iter().zip(sums.hinge_moments) {
                let action = self.action(operation, &scene, hinge_moment);
                let hinge = &self.models.hinge;
                let up = freedom.hub_moment_excess(hinge, &scene.flow, place, &action);
                moment += Vector3::new(-place.azimuth.sin, place.azimuth.cos, 0.0) * up;
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
            scene.flow.edgewise,
            scene.flow.climb,
            induced_velocity,
            sums.force.z / (operation.air.density * PI * radius * radius),
        );
        Ok(Performance {
            force: Vector3::new(force_x, mirror * force_y, sums.force.z),
            moment: Vector3::new(mirror * moment_x, moment_y, mirror * around),
            torque: -moment.z,
            induced_velocity,
            stalled_radius: sums.stalled_radius,
            stalled_fraction: sums.stalled / self.elements.len() as f64,
            tip_path: self.tip_path(operation, state, &scene, &sums),
            flow_state,
        })
    }

    /// Whether `performance` is that of blades at their azimuths, rather than a mean over a turn.
    pub fn shows_blades(&self, operation: &Operation, state: &State) -> bool {
        let operation = &operation.at_speed_of(state);
        self.scene(operation, state).is_blades
    }

    /// What acts on a blade's hinge.
    pub(super) fn action(&self, operation: &Operation, scene: &Scene, moment: f64) -> Action {
        Action {
            moment,
            spring: operation.hinge_spring,
            gravity: scene.gravity,
        }
    }

    /// Axes into the wind, the disc's flow in them, and the places of the blades.
    pub(super) fn scene(&self, operation: &Operation, state: &State) -> Scene {
        let mirror = self.mirror();
        let Operation {
            airspeed,
            angular_velocity,
            gravity,
            ..
        } = operation;
        let axes = WindAxes::new(airspeed.x, mirror * airspeed.y);
        let (roll_rate, pitch_rate) =
            axes.into_wind(mirror * angular_velocity.x, angular_velocity.y);
        let (gravity_x, gravity_y) = axes.into_wind(gravity.x, mirror * gravity.y);
        // Cyclic pitch is -cos(psi) and -sin(psi) times these: it turns like (x, y) as well.
        let (cyclic_cos, cyclic_sin) =
            axes.into_wind(operation.cyclic_lateral, operation.cyclic_longitudinal);
        let flow = DiscFlow {
            rotation: operation.speed + mirror * angular_velocity.z,
            speed: operation.speed,
            edgewise: libm::hypot(airspeed.x, airspeed.y),
            climb: airspeed.z,
            roll_rate,
            pitch_rate,
            cyclic_cos,
            cyclic_sin,
            hinge: self.models.hinge.offset,
        };
        // What is left of an asymmetry that dies away is none.
        let speeds = flow.rotation.abs() * self.geometry.radius + flow.edgewise + flow.climb.abs();
        let none = SYMMETRIC * speeds;
        let is_inflow_symmetric = match &self.peters_he {
            Some(wake) => wake.is_axisymmetric(&state.inflow, none),
            None => state.field().is_axisymmetric(none),
        };
        let is_symmetric = flow.is_axisymmetric() && is_inflow_symmetric;
        let is_blades = match self.models.blades {
            _ if self.models.hinge.freedom.is_some() => true,
            Blades::Automatic => !is_symmetric,
            Blades::Disc => false,
            Blades::Individual => true,
        } && self.models.inflow != Inflow::AnnulusClosedForm;
        let places = if is_blades {
            self.blades(&axes, state)
        } else {
            self.turn(is_symmetric)
        };
        Scene {
            axes,
            flow,
            gravity: Vector3::new(gravity_x, gravity_y, gravity.z),
            places,
            is_blades,
        }
    }

    /// The blades where they are.
    fn blades(&self, axes: &WindAxes, state: &State) -> Places {
        let count = self.geometry.blades as usize;
        let step = 2.0 * PI / count as f64;
        Places::new((0..count).map(|k| {
            let psi = state.azimuth + step * k as f64;
            let (cos, sin) = axes.into_wind(libm::cos(psi), libm::sin(psi));
            let azimuth = Azimuth { sin, cos };
            match (&self.models.hinge.freedom, state.flaps.get(k)) {
                (Some(freedom), Some(flap)) => {
                    let above = flap.angle - self.models.hinge.precone;
                    Place::new(azimuth, *flap, -freedom.pitch_flap * above)
                }
                _ => self.rigid(azimuth),
            }
        }))
    }

    /// The azimuths to average over: one without a direction where all are alike.
    fn turn(&self, is_symmetric: bool) -> Places {
        if is_symmetric {
            return Places::new([self.rigid(Azimuth::default())].into_iter());
        }
        Places::new(self.around.iter().map(|azimuth| self.rigid(*azimuth)))
    }

    fn rigid(&self, azimuth: Azimuth) -> Place {
        let flap = Flap {
            angle: self.models.hinge.precone,
            rate: 0.0,
        };
        Place::new(azimuth, flap, 0.0)
    }

    /// -1 for a clockwise rotor, which is computed as its mirror image.
    fn mirror(&self) -> f64 {
        match self.geometry.rotation {
            Rotation::CounterClockwise => 1.0,
            Rotation::Clockwise => -1.0,
        }
    }

    /// The cone of the blades, in the axes of the hub.
    ///
    /// From three blades on, the mean of the flap angles and twice their means with cos psi and sin psi (the
    /// multiblade coordinates, Johnson 1980, ch. 8.4). One or two blades say too little: for each, beta =
    /// a0 - a1 cos psi - b1 sin psi with its first two derivatives gives the cone, and the mean is taken. Blades
    /// that swing too fast for that are on no cone: their angle counts as coning.
    fn tip_path(
        &self,
        operation: &Operation,
        state: &State,
        scene: &Scene,
        sums: &Sums,
    ) -> TipPath {
        let Some(freedom) = &self.models.hinge.freedom else {
            return TipPath {
                coning: self.models.hinge.precone,
                ..TipPath::default()
            };
        };
        let count = scene.places.len() as f64;
        let mut path = TipPath::default();
        for (k, place) in scene.places.iter().enumerate() {
            let psi = state.azimuth + 2.0 * PI * k as f64 / count;
            let (sin, cos) = (libm::sin(psi), libm::cos(psi));
            let Flap { angle, rate } = place.flap;
            let (coning, longitudinal, lateral) = if count > 2.0 {
                (angle, -2.0 * angle * cos, -2.0 * angle * sin)
            } else {
                let action = self.action(operation, scene, sums.hinge_moments[k]);
                let hinge = &self.models.hinge;
                let second = freedom.acceleration(hinge, &scene.flow, place, &action)
                    / (operation.speed * operation.speed);
                let first = rate / operation.speed;
                // Not so where the rotor stands still, either.
                if libm::hypot(first, second) < LARGEST_LEAN {
                    (
                        angle + second,
                        second * cos + first * sin,
                        second * sin - first * cos,
                    )
                } else {
                    (angle, 0.0, 0.0)
                }
            };
            path.coning += coning / count;
            path.longitudinal += longitudinal / count;
            path.lateral += lateral / count;
        }
        path
    }

    /// The loads in a state, with the lift ending where the tip loss says.
    pub(super) fn fly(
        &mut self,
        scene: &Scene,
        operation: &Operation,
        state: &State,
    ) -> Result<Sums, SolveError> {
        let tip_loss = self.models.tip_loss;
        let blades = f64::from(self.geometry.blades);
        if tip_loss.end_at_thrust(blades, 0.0).is_none() {
            return self.fly_with_shares(scene, operation, state);
        }
        // The more thrust, the sooner the lift ends, the less thrust. A rotor that hardly turns has the
        // airspeed in its coefficient instead of a tip speed, which the formula does not know.
        let radius = self.geometry.radius;
        let tip_speed = operation.speed * radius;
        let square = tip_speed * tip_speed + operation.airspeed.norm_squared();
        let reference = operation.air.density * PI * radius * radius * square;
        let mut failure = None;
        let mut surplus = |coefficient: f64| {
            let end = tip_loss.end_at_thrust(blades, coefficient).unwrap_or(1.0);
            self.end_lift_at(end);
            match self.fly_with_shares(scene, operation, state) {
                Ok(sums) if reference > 0.0 => sums.force.z.abs() / reference - coefficient,
                Ok(_) => -coefficient,
                Err(error) => {
                    failure = Some(error);
                    f64::NAN
                }
            }
        };
        let mut end = |at: f64| End {
            at,
            residual: surplus(at),
        };
        // With no lift lost the thrust is largest. At the largest coefficient no lift is left.
        let first = end(0.0);
        let mut last = end(first.residual.clamp(0.0, blades * blades));
        if last.residual > 0.0 {
            last = end(blades * blades);
        }
        let ends = (first, last);
        let solved = if ends.0.residual <= 0.0 {
            Ok(0.0)
        } else if ends.1.residual >= 0.0 {
            Ok(blades * blades) // a drag that alone exceeds it
        } else {
            bracketed(&mut surplus, ends.0, ends.1, THRUST_TOLERANCE)
        };
        let coefficient = match (failure, solved) {
            (Some(error), _) => return Err(error),
            (None, Err(cause)) => return Err(SolveError::LiftEnd(cause)),
            (None, Ok(coefficient)) => coefficient,
        };
        self.end_lift_at(tip_loss.end_at_thrust(blades, coefficient).unwrap_or(1.0));
        self.fly_with_shares(scene, operation, state)
    }

    /// Ends the lift of the blades at r/R = `end`.
    pub(super) fn end_lift_at(&mut self, end: f64) {
        let half = 0.5 * self.elements.width;
        let end = end * self.geometry.radius;
        for (share, radius) in self.lifting_share.iter_mut().zip(&self.elements.radius) {
            *share = lifting_share(radius - half, radius + half, end);
        }
    }

    fn fly_with_shares(
        &mut self,
        scene: &Scene,
        operation: &Operation,
        state: &State,
    ) -> Result<Sums, SolveError> {
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
                let mut harmonics = [Wake::harmonics(1.0, 0.0); AZIMUTHS];
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
        scene: &Scene,
        operation: &Operation,
        induction: &Induction,
    ) -> Result<Sums, SolveError> {
        let mut sums = Sums {
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
            hinge_moments: [0.0; AZIMUTHS],
            loading: [0.0; MOST_INFLOW_STATES],
            flux: 0.0,
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
                        Ok(Induced {
                            axial: wake.velocity(states, i, &harmonics[k]),
                            swirl: 0.0,
                        })
                    })?;
                    let blades = element.blades / places.len() as f64;
                    for (thrust, harmonics) in
                        turn.thrust_at.iter().zip(*harmonics).take(places.len())
                    {
                        let force = blades * thrust * width / (operation.air.density * square);
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
                        turn.fly(LossIn::Momentum, |_, place| {
                            let meets = flow.meets(element.radius, place);
                            let axial =
                                finite_blades::velocity(&element, &meets, flow, descent, ground);
                            Ok(Induced {
                                axial: axial.map_err(unsolved)?,
                                swirl: 0.0,
                            })
                        })?;
                        turn.mean_induced
                    }
                    _ => {
                        let answer = annulus::solve(&element, flow, places, descent, ground)
                            .map_err(unsolved)?;
                        turn.fly(LossIn::Momentum, |_, _| Ok(answer.induced))?;
                        answer.mean_axial
                    }
                },
            };
            sums.force += turn.force * width;
            sums.moment += turn.moment * width;
            for (sum, moment) in sums.hinge_moments.iter_mut().zip(turn.hinge_moment_at) {
                *sum += moment * width;
            }
            sums.flux += mean_induced * element.radius;
            sums.area += element.radius;
            sums.stalled += turn.stalled;
            if turn.stalled > 0.0 {
                sums.stalled_radius = element.radius_ratio();
            }
            let load = turn.load(mean_induced);
            self.loads[i] = load;
        }
        Ok(sums)
    }

    /// Glauert's mean inflow and its distribution, in the axes of the disc's flow.
    pub(super) fn field(
        &self,
        skew: Skew,
        scene: &Scene,
        operation: &Operation,
    ) -> Result<Field, SolveError> {
        let flow = &scene.flow;
        let radius = self.geometry.radius;
        let tip_speed = flow.rotation.abs() * radius;
        let ground = self.ground(operation);
        let distributed = |mean: f64| {
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
        let thrust = |mean: f64| {
            let field = distributed(mean);
            let mut thrust = 0.0;
            for i in 0..self.elements.len() {
                let element = self.element(i, operation);
                let induced = |place: &Place| field.at(element.radius_ratio(), place.azimuth);
                let per_length = mean_thrust(&element, flow, LossIn::Lift, &scene.places, induced);
                thrust += per_length * self.elements.width;
            }
            thrust / density_area
        };
        let scale = tip_speed + flow.edgewise + flow.climb.abs();
        if scale == 0.0 {
            return Ok(Field::default());
        }
        let descent = self.models.descent;
        let mass_flow = |v: f64| descent.speed(flow.edgewise, flow.climb, v);
        let mean = uniform::mean_velocity(mass_flow, flow.climb, scale, thrust)
            .map_err(SolveError::Disc)?;
        Ok(distributed(mean))
    }

    fn ground(&self, operation: &Operation) -> Ground {
        Ground {
            effect: self.models.ground_effect,
            height_ratio: operation.height / self.geometry.radius,
        }
    }

    fn element(&self, i: usize, operation: &Operation) -> Element<'_> {
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
                mach: 1.0 / air.speed_of_sound,
            },
            density: air.density,
        }
    }
}

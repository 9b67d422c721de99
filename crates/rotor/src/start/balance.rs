//! The flap angles at which blades that do not move against the hub are in balance: under the air,
//! their weight, springs, stops and the inertia forces of the turning rotor.

use crate::{
    disc::{AZIMUTHS, BladePosition, Flap},
    error::SolveError,
    evaluation::Evaluation,
    flapping::Freedom,
    inflow::Number,
    lift_end::disc_loads,
    numbers::Scalar,
    operating_point::OperatingPoint,
    root::{self, End},
    rotor::Rotor,
    seesaw::Seesaw,
    state::State,
    sweep::Wanted,
    workspace::Workspace,
};
use core::f64::consts::FRAC_PI_2;

/// Tolerance of the angles, rad.
const TOLERANCE: f64 = 1e-13;

/// How far beyond the stops an angle is searched, rad.
const BEYOND_STOPS: f64 = 1.0;

/// Maximum number of computations of the moments of the air.
const MAX_COMPUTATIONS: usize = 20;

/// The state with each blade in balance at its azimuth.
///
/// The moment of the air is computed again at the angles that balance the last one, until they
/// stay. They always do on a stop, which is far stiffer than the air; where they do not, the last
/// angles are the result. Fails if the loads cannot be computed.
pub(super) fn find<S: Number>(
    rotor: &Rotor,
    point: &OperatingPoint<S>,
    state: &State<S>,
    workspace: &mut Workspace<S>,
) -> Result<State<S>, SolveError> {
    let mut balanced = without_air(rotor, point, state);
    for _ in 0..MAX_COMPUTATIONS {
        let evaluation = rotor.evaluate(point, &balanced);
        let moments = disc_loads(&evaluation, workspace, Wanted::Sums)?.hinge_moments;
        let next = under(&evaluation, &moments);
        let flaps = next.flaps.iter().zip(&balanced.flaps);
        let change = flaps.map(|(a, b)| (a.angle - b.angle).value().abs());
        let change = change.fold(0.0, f64::max);
        balanced = next;
        if change <= 10.0 * TOLERANCE {
            break;
        }
    }
    Ok(balanced)
}

/// The same without the moments of the air.
pub(super) fn without_air<S: Scalar>(
    rotor: &Rotor,
    point: &OperatingPoint<S>,
    state: &State<S>,
) -> State<S> {
    under(&rotor.evaluate(point, state), &[S::zero(); AZIMUTHS])
}

/// The state of an evaluation with the angles that balance these moments of the air, N.m.
fn under<S: Scalar>(evaluation: &Evaluation<S>, moments: &[S]) -> State<S> {
    let mut balanced = *evaluation.state;
    let Some(freedom) = evaluation.freedom else {
        return balanced;
    };
    if let (Some(seesaw), [one, two]) = (
        &evaluation.rotor.models().seesaw,
        evaluation.positions.as_slice(),
    ) && let [first, second, ..] = moments
    {
        if let Some(angle) = teeter(evaluation, freedom, seesaw, [(one, *first), (two, *second)]) {
            let precone = evaluation.rotor.models().hinge.precone;
            for (flap, angle) in balanced.flaps.iter_mut().zip([angle, -angle]) {
                *flap = Flap {
                    angle: angle + precone,
                    rate: S::zero(),
                };
            }
        }
        return balanced;
    }
    let blades = evaluation.positions.iter().zip(moments);
    for (flap, (position, moment)) in balanced.flaps.iter_mut().zip(blades) {
        if let Some(angle) = angle(evaluation, freedom, position, *moment) {
            *flap = Flap {
                angle,
                rate: S::zero(),
            };
        }
    }
    balanced
}

/// The teeter angle that balances the moments of the air on both blades of a seesaw.
fn teeter<S: Scalar>(
    evaluation: &Evaluation<S>,
    freedom: &Freedom,
    seesaw: &Seesaw,
    blades: [(&BladePosition<S>, S); 2],
) -> Option<S> {
    let hinge = &evaluation.rotor.models().hinge;
    let actions = blades.map(|(_, moment)| evaluation.action(moment));
    let acceleration = |angle: S| {
        let position = |k: usize, angle: S| {
            let still = Flap {
                angle: angle + hinge.precone,
                rate: S::zero(),
            };
            BladePosition::new(blades[k].0.azimuth, still, S::zero())
        };
        let (one, two) = (position(0, angle), position(1, -angle));
        let blades = [(&one, &actions[0]), (&two, &actions[1])];
        seesaw.acceleration(hinge, &evaluation.flow, blades)
    };
    // Either blade may meet either stop.
    let stops = &freedom.stops;
    let most = (stops.highest - hinge.precone).min(hinge.precone - stops.lowest);
    let most = most.min(FRAC_PI_2) + BEYOND_STOPS;
    root_of(acceleration, -most, most)
}

/// The angle that balances the moment of the air on a blade at a position; none if no angle between
/// straight down and straight up does. Where weight acts along the blade, there may be several, of
/// which this is one.
fn angle<S: Scalar>(
    evaluation: &Evaluation<S>,
    freedom: &Freedom,
    position: &BladePosition<S>,
    moment: S,
) -> Option<S> {
    let hinge = &evaluation.rotor.models().hinge;
    let action = evaluation.action(moment);
    let acceleration = |angle: S| {
        let still = Flap {
            angle,
            rate: S::zero(),
        };
        let position = BladePosition::new(position.azimuth, still, S::zero());
        hinge.acceleration(&evaluation.flow, &position, &action)
    };
    let low = freedom.stops.lowest.max(-FRAC_PI_2) - BEYOND_STOPS;
    let high = freedom.stops.highest.min(FRAC_PI_2) + BEYOND_STOPS;
    root_of(acceleration, low, high)
}

/// The angle between two others at which the acceleration is 0, if there is one.
fn root_of<S: Scalar>(acceleration: impl Fn(S) -> S, low: f64, high: f64) -> Option<S> {
    let value = |angle: f64| acceleration(S::constant(angle)).value();
    let end = |at: f64| End {
        at,
        residual: value(at),
    };
    let angle = root::bracketed(value, end(low), end(high), TOLERANCE).ok()?;
    Some(S::at_root(angle, acceleration))
}

//! Steady inflow states, for rigid blades averaged over one revolution.

use super::{TOLERANCE, unknowns::Unknowns};
use crate::{
    error::SolveError,
    inflow::Number,
    inflow::{InflowStates, Skew},
    lift_end::disc_loads,
    newton,
    operating_point::OperatingPoint,
    rates,
    rotor::Rotor,
    state::State,
    sweep::Wanted,
    workspace::Workspace,
};
use nalgebra::DVector;

/// Inflow states at the start.
pub(super) struct SteadyInflow {
    /// In the axes of the hub.
    pub(super) states: InflowStates,
    /// Whether they are steady. If not, they are about those of momentum theory.
    pub(super) is_found: bool,
}

/// The steady inflow states.
pub(super) fn find(
    rotor: &Rotor,
    point: &OperatingPoint,
    workspace: &mut Workspace,
) -> Result<SteadyInflow, SolveError> {
    let inflow = &rotor.models().inflow;
    let radius = rotor.geometry().radius;
    let at_rest = State::default();
    let evaluation = rotor.evaluate_as_disc(point, &at_rest);
    let flow = &evaluation.flow;
    let speed = flow.rotation.abs() * radius + flow.edgewise + flow.climb.abs();
    if speed == 0.0 {
        return Ok(SteadyInflow {
            states: at_rest.inflow,
            is_found: true,
        });
    }
    // The search starts from the static inflow model: the slopes of the field, which are 0 in axial
    // symmetry, then have their order of magnitude in edgewise flow.
    workspace.prepare(rotor);
    let blade_flows = evaluation.blade_flows();
    let Workspace {
        lifting_shares,
        work,
        width,
        ..
    } = workspace;
    let disc = evaluation.disc(lifting_shares, work, &blade_flows, *width);
    let field = disc.momentum_field(Skew::PittPeters)?;
    let guess = State {
        inflow: inflow.first_guess(&field.out_of_wind(&evaluation.axes)),
        ..State::default()
    };
    let count = inflow.state_count();
    let per_rate = radius / (speed * speed);
    let unknowns = Unknowns::of_inflow(rotor, speed);
    let found = newton::solve::<SolveError>(unknowns.of(&guess), TOLERANCE, |x, _| {
        let rates = rates(rotor, point, &unknowns.state(x), workspace)?;
        let scaled = rates.inflow[..count].iter().map(|r| r * per_rate);
        Ok(DVector::from_iterator(count, scaled))
    });
    // An error here comes from a guess far off: the momentum equation was solved above.
    Ok(match found {
        Ok(Some(found)) => SteadyInflow {
            states: unknowns.state(&found).inflow,
            is_found: true,
        },
        Ok(None) | Err(_) => SteadyInflow {
            states: guess.inflow,
            is_found: false,
        },
    })
}

/// Rates of the states, averaged over one revolution.
pub(super) fn rates<S: Number>(
    rotor: &Rotor,
    point: &OperatingPoint<S>,
    state: &State<S>,
    workspace: &mut Workspace<S>,
) -> Result<State<S>, SolveError> {
    let evaluation = rotor.evaluate_as_disc(point, state);
    let loads = disc_loads(&evaluation, workspace, Wanted::Sums)?;
    Ok(rates::of(&evaluation, &loads))
}

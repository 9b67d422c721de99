//! The response of the rotor at an operating point in a state.

use super::{
    blade_loads::BladeLoads, error::SolveError, hub_loads::HubLoads, inflow::Number,
    lift_end::disc_loads, operating_point::OperatingPoint, rates, rotor::Rotor, state::State,
    sweep::Wanted, workspace::Workspace,
};

/// The response of the rotor: hub loads, rates of the states, and blade loads.
///
/// The loads along the blade lie in the workspace in which the response was computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response<'a, S = f64> {
    /// Hub loads.
    pub hub: HubLoads<S>,
    /// Rates of the states, per second.
    pub rates: State<S>,
    /// Loads along the blade.
    pub blade: BladeLoads<'a, S>,
}

impl Rotor {
    /// The response at an operating point in a state. Allocates nothing, except in a workspace that
    /// was made for another rotor.
    ///
    /// Fails where a momentum equation has no solution, which happens only if numbers are not
    /// finite or overflow.
    pub fn respond<'a, S: Number>(
        &'a self,
        point: &OperatingPoint<S>,
        state: &State<S>,
        workspace: &'a mut Workspace<S>,
    ) -> Result<Response<'a, S>, SolveError> {
        let evaluation = self.evaluate(point, state);
        let loads = disc_loads(&evaluation, workspace, Wanted::Distribution)?;
        Ok(Response {
            hub: HubLoads::new(&evaluation, &loads),
            rates: rates::of(&evaluation, &loads),
            blade: BladeLoads {
                elements: self.elements(),
                tip_radius: self.geometry().radius,
                loads: workspace.elements(),
            },
        })
    }

    /// Rates of the states alone, per second. Fails as `respond` does.
    pub fn rates<S: Number>(
        &self,
        point: &OperatingPoint<S>,
        state: &State<S>,
        workspace: &mut Workspace<S>,
    ) -> Result<State<S>, SolveError> {
        if !self.has_memory(point) {
            return Ok(State {
                azimuth: point.speed,
                ..State::default()
            });
        }
        let evaluation = self.evaluate(point, state);
        let loads = disc_loads(&evaluation, workspace, Wanted::Sums)?;
        Ok(rates::of(&evaluation, &loads))
    }
}

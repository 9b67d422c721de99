//! The aerodynamic loads of the disc in the induced velocity of the inflow model.

use super::{
    error::SolveError,
    evaluation::Evaluation,
    inflow::{AllElements, DiscLoads, Number},
    sweep::Wanted,
    workspace::Workspace,
};

/// The loads, and those of each element if they are wanted, which are written to the workspace.
/// The workspace says which fractions of the elements carry lift. Fails where a momentum equation
/// has no solution, or if no work is left.
pub(crate) fn of_all_elements<S: Number>(
    evaluation: &Evaluation<S>,
    workspace: &mut Workspace<S>,
    wanted: Wanted,
) -> Result<DiscLoads<S>, SolveError> {
    let Workspace {
        lifting_shares,
        work,
        elements,
        width,
    } = workspace;
    let blade_flows = evaluation.blade_flows();
    let disc = evaluation.disc(lifting_shares, work, &blade_flows, *width);
    work.check((disc.positions.len() * elements.len()) as u64)?;
    let inflow = &evaluation.rotor.models().inflow;
    let induction = inflow.induction(&disc, &evaluation.inflow_states)?;
    S::disc_loads(AllElements {
        disc: &disc,
        induction: &induction,
        wanted,
        elements,
    })
}

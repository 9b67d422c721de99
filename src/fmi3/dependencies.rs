//! On which variables a variable depends: fmi3Functions.h, "Getting Variable Dependency
//! Information".

#![allow(non_snake_case)]

use super::{types::*, variables::variable};
use crate::{
    block::variables::{DEPENDENCIES, Dependency, TIME_REFERENCE},
    fmi::{
        arguments::{fill, room, room_for_one},
        instance::{Instance, Message, call, refuse},
        legality::{Function, INITIALIZATION_MODE, INSTANTIATED},
    },
};

impl Instance {
    /// The dependencies of a variable now; none of one that is not computed.
    fn dependencies(
        &self,
        reference: fmi3ValueReference,
    ) -> Result<&'static [Dependency], Message> {
        if reference != TIME_REFERENCE {
            variable(reference)?;
        }
        let row = DEPENDENCIES.iter().find(|row| row.of == reference);
        let is_initial = self.state & (INSTANTIATED | INITIALIZATION_MODE);
        Ok(match row {
            None => &[],
            Some(row) if is_initial != 0 => row.initial,
            Some(row) => row.running,
        })
    }
}

/// # Safety
/// As in the standard: `nDependencies` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfVariableDependencies(
    instance: fmi3Instance,
    valueReference: fmi3ValueReference,
    nDependencies: *mut usize,
) -> fmi3Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let count = unsafe { room_for_one(nDependencies, "nDependencies")? };
        count.write(instance.dependencies(valueReference)?.len());
        Ok(())
    };
    let function = Function::fmi3GetNumberOfVariableDependencies;
    // SAFETY: passed on from the caller.
    unsafe { call(instance, function, body) }
}

/// # Safety
/// As in the standard: the arrays have `nDependencies` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetVariableDependencies(
    instance: fmi3Instance,
    dependent: fmi3ValueReference,
    elementIndicesOfDependent: *mut usize,
    independents: *mut fmi3ValueReference,
    elementIndicesOfIndependents: *mut usize,
    dependencyKinds: *mut fmi3DependencyKind,
    nDependencies: usize,
) -> fmi3Status {
    let body = |instance: &mut Instance| {
        let rows = instance.dependencies(dependent)?;
        let count = rows.len();
        if nDependencies != count {
            return refuse(format!(
                "nDependencies = {nDependencies}, but the variable has {count}; pass what fmi3GetNumberOfVariableDependencies answers"
            ));
        }
        // SAFETY: passed on from the caller. Each answer is written before the next room is made,
        // because an importer may pass the same place twice.
        unsafe {
            let of = || {
                let name = "elementIndicesOfDependent";
                room(elementIndicesOfDependent, count, name)
            };
            let knowns = || room(independents, count, "independents");
            let of_knowns = || {
                let name = "elementIndicesOfIndependents";
                room(elementIndicesOfIndependents, count, name)
            };
            let kinds = || room(dependencyKinds, count, "dependencyKinds");
            of()?;
            knowns()?;
            of_knowns()?;
            kinds()?;
            fill(of()?, rows.iter().map(|row| row.element.into()));
            fill(knowns()?, rows.iter().map(|row| row.on));
            fill(of_knowns()?, rows.iter().map(|row| row.element_on.into()));
            fill(kinds()?, rows.iter().map(|_| FMI3_DEPENDENT));
        }
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3GetVariableDependencies, body) }
}

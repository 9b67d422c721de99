//! The value references of FMI 3.0, which are unique over all types. Each type has a block of them;
//! within it, a variable has the value reference that it, or the first element of its array, has in
//! FMI 2.0.

use super::types::fmi3ValueReference;
use crate::{
    block::variables::{
        ARRAYS, BLOCK_OF_REFERENCES, BOOLEANS, Causality, INTEGERS, REALS, STRINGS, TIME_REFERENCE,
    },
    fmi::{
        arguments::elements,
        instance::{Instance, Message, Outcome, no_memory, refuse},
        legality::{INTERMEDIATE_GET, INTERMEDIATE_SET},
        types::ValueReference,
    },
};

/// The types of the variables, by the functions that get and set them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Float64,
    Int32,
    /// Enumerations.
    Int64,
    Boolean,
    String,
}

/// A variable of FMI 3.0.
#[derive(Debug, PartialEq)]
pub struct Variable {
    pub kind: Kind,
    pub name: &'static str,
    /// The value reference in FMI 2.0 of its first element.
    pub first: ValueReference,
    /// Number of its elements; 1 for a scalar.
    pub count: u32,
}

/// The variable with a value reference.
pub fn find(reference: fmi3ValueReference) -> Option<Variable> {
    let first = reference % BLOCK_OF_REFERENCES;
    let index = first as usize;
    let mut count = 1;
    let (kind, name) = match reference / BLOCK_OF_REFERENCES {
        0 => {
            let before = ARRAYS.partition_point(|array| array.first <= first);
            let array = before.checked_sub(1).map(|i| &ARRAYS[i]);
            match array.filter(|array| first < array.first + array.count) {
                Some(array) if array.first == first => {
                    count = array.count;
                    (Kind::Float64, array.name)
                }
                // Another element of an array.
                Some(_) => return None,
                None => (Kind::Float64, REALS.get(index)?.name),
            }
        }
        1 => {
            let variable = INTEGERS.get(index)?;
            match variable.choices {
                [] => (Kind::Int32, variable.name),
                _ => (Kind::Int64, variable.name),
            }
        }
        2 => (Kind::Boolean, BOOLEANS.get(index)?.name),
        3 => (Kind::String, STRINGS.get(index)?.name),
        _ => return None,
    };
    Some(Variable {
        kind,
        name,
        first,
        count,
    })
}

/// As `find`, with an error if there is no such variable.
pub fn variable(reference: fmi3ValueReference) -> Result<Variable, Message> {
    find(reference).ok_or_else(|| {
        Message::Error(format!(
            "this FMU has no variable with the value reference {reference}; see modelDescription.xml"
        ))
    })
}

/// Whether `time` may be among the variables that a function is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Time {
    Allowed,
    Refused,
}

/// The importer's array of value references.
pub type References = (*const fmi3ValueReference, usize);

impl Instance {
    /// Calls `then` with the value references in FMI 2.0 of all elements of variables. An error if
    /// the variables are of another kind, may not be accessed now, or have another number of
    /// elements than there are values. `then` may write where the value references were.
    ///
    /// # Safety
    /// `references` has as many elements as its count says.
    pub unsafe fn with_elements(
        &mut self,
        (kind, time): (Kind, Time),
        (references, name): (References, &str),
        values: (usize, &str),
        then: &mut dyn FnMut(&mut Self, &[ValueReference]) -> Outcome,
    ) -> Outcome {
        let mut all = std::mem::take(&mut self.references);
        all.clear();
        // SAFETY: passed on from the caller.
        let outcome = unsafe { elements(references.0, references.1, name) }
            .and_then(|references| self.push_elements(kind, time, references, &mut all))
            .and_then(|()| check_values(values, all.len()))
            .and_then(|()| then(self, &all));
        self.references = all;
        outcome
    }

    fn push_elements(
        &self,
        kind: Kind,
        time: Time,
        references: &[fmi3ValueReference],
        elements: &mut Vec<ValueReference>,
    ) -> Outcome {
        let is_update = (INTERMEDIATE_SET | INTERMEDIATE_GET) & self.state != 0;
        for reference in references {
            let variable = match *reference {
                TIME_REFERENCE if kind == Kind::Float64 && time == Time::Allowed => Variable {
                    kind,
                    name: "time",
                    first: TIME_REFERENCE,
                    count: 1,
                },
                TIME_REFERENCE => {
                    return refuse("time is the independent variable, which is only read".into());
                }
                reference => variable(reference)?,
            };
            let name = variable.name;
            if variable.kind != kind {
                return refuse(format!(
                    "{name} has the type {:?}; use the functions of that type",
                    variable.kind
                ));
            }
            if is_update && !has_intermediate_values(*reference) {
                return refuse(format!(
                    "{name} cannot be accessed during a step; modelDescription.xml does not say intermediateUpdate = true of it"
                ));
            }
            if is_update && !self.options.required.contains(reference) {
                return refuse(format!(
                    "{name} is not among the requiredIntermediateVariables of the instance; name it there"
                ));
            }
            let range = variable.first..variable.first + variable.count;
            elements.try_reserve(range.len()).map_err(no_memory)?;
            elements.extend(range);
        }
        Ok(())
    }
}

/// An error if the importer's array does not have as many values as the variables.
fn check_values((given, name): (usize, &str), count: usize) -> Outcome {
    if given == count {
        return Ok(());
    }
    refuse(format!(
        "{name} = {given}, but the variables have {count} elements; pass that number"
    ))
}

/// Whether a variable can be read or set during an intermediate update: inputs and outputs that are
/// continuous.
pub fn has_intermediate_values(reference: fmi3ValueReference) -> bool {
    let is_input_or_output = |variable: Variable| {
        let causality = REALS[variable.first as usize].causality;
        matches!(causality, Causality::Input | Causality::Output)
    };
    let variable = find(reference).filter(|variable| variable.kind == Kind::Float64);
    variable.is_some_and(is_input_or_output)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_reference_of_a_2_0_variable_is_found_once_and_elements_have_none() {
        let mut elements = 0;
        for reference in 0..REALS.len() as u32 {
            match find(reference) {
                Some(variable) => elements += variable.count as usize,
                None => assert!(REALS[reference as usize].name.contains('[')),
            }
        }
        assert_eq!(elements, REALS.len());
        let velocity = find(6).unwrap();
        assert_eq!((velocity.name, velocity.count), ("velocity", 3));
        assert_eq!(find(7), None);
        let kinds = [(1, INTEGERS.len()), (2, BOOLEANS.len()), (3, STRINGS.len())];
        for (block, length) in kinds {
            let begin = block * BLOCK_OF_REFERENCES;
            assert!((0..length as u32).all(|i| find(begin + i).is_some()));
            assert_eq!(find(begin + length as u32), None);
        }
        assert_eq!(find(TIME_REFERENCE), None);
        assert_eq!(find(u32::MAX), None);
    }
}

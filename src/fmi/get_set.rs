//! Getting and setting the values of variables, which are named by the value references of FMI 2.0.

use super::{
    arguments::text,
    instance::{Instance, Message, Outcome, no_memory},
    legality::{CONTINUOUS_TIME_MODE, INITIALIZATION_MODE},
    logger::printable,
    types::{Text, ValueReference},
};
use crate::{
    block::{
        Names,
        variables::{IntegerRef, RealRef, StringRef},
    },
    host::memory::Watch,
};

/// Those of the importer's value references that exist.
fn references<R>(vr: &[ValueReference]) -> impl Iterator<Item = R>
where
    ValueReference: Names<R>,
{
    vr.iter().flat_map(|number| number.reference())
}

impl Instance {
    /// Computes Real variables if they are to be read and out of date.
    pub fn refresh_reals(&mut self, vr: &[ValueReference]) -> Outcome {
        // The states have their values already, except in Initialization Mode.
        let is_initializing = self.state == INITIALIZATION_MODE;
        let must_be_computed = |real: RealRef| {
            real.variable().causality.is_computed() && (is_initializing || !real.is_state())
        };
        if references(vr).any(must_be_computed) {
            self.refresh()?;
        }
        Ok(())
    }

    /// As `refresh_reals`, for Integer and Enumeration variables.
    pub fn refresh_integers(&mut self, vr: &[ValueReference]) -> Outcome {
        // Discrete variables keep their values in Continuous-Time Mode.
        let is_held = self.state == CONTINUOUS_TIME_MODE;
        let is_computed = |integer: IntegerRef| integer.variable().causality.is_computed();
        if !is_held && references(vr).any(is_computed) {
            self.refresh()?;
        }
        Ok(())
    }

    /// The text of a String variable, which lives until the next call.
    pub fn kept_string(&mut self, reference: ValueReference) -> Result<Text, Message> {
        let reference: StringRef = reference.reference()?;
        let kept = &mut self.strings[reference];
        // An unchanged text keeps its address, also where one call names it twice.
        let present = &self.block.values().strings[reference];
        if kept.as_bytes() != present.as_bytes() {
            let watch = Watch::begin();
            let changed = printable(present);
            if watch.is_short() {
                return Err(no_memory(()));
            }
            *kept = changed;
        }
        Ok(kept.as_ptr())
    }

    /// Sets String variables; if one value is refused, none is set.
    ///
    /// # Safety
    /// The values are null or C strings.
    pub unsafe fn set_strings(&mut self, vr: &[ValueReference], values: &[Text]) -> Outcome {
        let mut texts = Vec::new();
        texts.try_reserve_exact(values.len()).map_err(no_memory)?;
        for value in values {
            // SAFETY: passed on from the caller.
            texts.push(unsafe { text(*value, "a value")? });
        }
        Ok(self.block.set_strings(vr, &texts)?)
    }
}

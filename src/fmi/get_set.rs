//! Getting and setting the values of variables, which are named by the value references of FMI 2.0.

use super::{
    arguments::{fill, text},
    instance::{Instance, Message, Outcome, no_memory, refuse},
    legality::{CONTINUOUS_TIME_MODE, INITIALIZATION_MODE, Version},
    logger::printable,
    types::{Text, ValueReference},
};
use crate::{
    block::{
        Names,
        variables::{IntegerRef, RealRef, StringRef, TIME_REFERENCE},
    },
    host::memory::Watch,
};
use core::mem::MaybeUninit;

/// The importer's memory for values.
pub type Room<'a, T> = &'a mut [MaybeUninit<T>];

/// Those of the importer's value references that exist.
fn references<R>(vr: &[ValueReference]) -> impl Iterator<Item = R>
where
    ValueReference: Names<R>,
{
    vr.iter().flat_map(|number| number.reference())
}

impl Instance {
    /// Computes Real variables if they are to be read and out of date.
    fn refresh_reals(&mut self, vr: &[ValueReference]) -> Outcome {
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
    fn refresh_integers(&mut self, vr: &[ValueReference]) -> Outcome {
        // Discrete variables keep their values in Continuous-Time Mode.
        let is_held = self.state == CONTINUOUS_TIME_MODE;
        let is_computed = |integer: IntegerRef| integer.variable().causality.is_computed();
        if !is_held && references(vr).any(is_computed) {
            self.refresh()?;
        }
        Ok(())
    }

    /// Reads Real variables, and `time` of FMI 3.0.
    pub fn get_reals(&mut self, vr: &[ValueReference], room: Room<'_, f64>) -> Outcome {
        self.refresh_reals(vr)?;
        for (reference, slot) in vr.iter().zip(room) {
            slot.write(match *reference {
                TIME_REFERENCE if self.version == Version::Three => self.experiment.time,
                reference => self.block.values().real(reference)?,
            });
        }
        Ok(())
    }

    /// Reads Integer and Enumeration variables.
    pub fn get_integers<T: From<i32>>(
        &mut self,
        vr: &[ValueReference],
        room: Room<'_, T>,
    ) -> Outcome {
        self.refresh_integers(vr)?;
        for (reference, slot) in vr.iter().zip(room) {
            slot.write(self.block.values().integer(*reference)?.into());
        }
        Ok(())
    }

    pub fn get_booleans<T: From<bool>>(
        &mut self,
        vr: &[ValueReference],
        room: Room<'_, T>,
    ) -> Outcome {
        for (reference, slot) in vr.iter().zip(room) {
            slot.write(self.block.values().boolean(*reference)?.into());
        }
        Ok(())
    }

    pub fn get_strings(&mut self, vr: &[ValueReference], room: Room<'_, Text>) -> Outcome {
        for (reference, slot) in vr.iter().zip(room) {
            slot.write(self.kept_string(*reference)?);
        }
        Ok(())
    }

    /// Reads time derivatives of outputs.
    pub fn output_rates(
        &mut self,
        vr: &[ValueReference],
        orders: &[i32],
        room: Room<'_, f64>,
    ) -> Outcome {
        if let Some(other) = orders.iter().find(|order| **order != 1) {
            return refuse(format!(
                "order = {other}, but this FMU has only first derivatives of its outputs; pass 1"
            ));
        }
        fill(room, self.block.output_rates(vr)?);
        Ok(())
    }

    /// The text of a String variable, which lives until the next call.
    fn kept_string(&mut self, reference: ValueReference) -> Result<Text, Message> {
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

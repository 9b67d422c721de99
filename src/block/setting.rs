//! Values into the block. A value that is set makes computed values out of date.

use super::{
    Fresh, Note, RotorBlock, Stage, ValueError, Values,
    integrate::Memory,
    references::Names,
    settings::{self, SetStringsError},
    state_vector::read_states,
    variables::{BooleanRef, Causality, IntegerRef, RealRef, StringRef, string},
};
use crate::host::memory::Watch;
use rotor::Workspace;

impl RotorBlock {
    /// Sets Real variables. If one value is refused, none is set. Inputs are limited to their
    /// range, with one warning of each.
    pub fn set_reals(
        &mut self,
        names: &[impl Names<RealRef>],
        values: &[f64],
    ) -> Result<(), ValueError> {
        let is_parameter =
            |reference: RealRef| reference.variable().causality == Causality::Parameter;
        let mut references = names.iter().flat_map(|name| name.reference());
        if self.stage == Stage::Configuring && references.any(is_parameter) {
            self.withdraw_file();
        }
        self.values.set_reals(self.stage, names, values)?;
        let mut references = names.iter().flat_map(|name| name.reference());
        for (reference, value) in references.clone().zip(values) {
            let warning = self.limited_inputs.next(reference, *value);
            self.notes.extend(warning.map(Note::Warning));
        }
        let defines_rotor = |reference: RealRef| {
            let variable = reference.variable();
            variable.causality == Causality::Parameter && !variable.tunable
        };
        let rotor_changes =
            self.stage == Stage::Configuring && references.clone().any(defines_rotor);
        self.invalidate(rotor_changes);
        if references.any(RealRef::is_state) {
            self.memory = Memory::starting(read_states(&self.values.reals));
        }
        Ok(())
    }

    /// Sets the time derivatives of inputs, per second. If one is refused, none is set. During the
    /// next step the inputs move linearly from their present values, and afterwards they keep the
    /// values at its end.
    pub fn set_input_slopes(
        &mut self,
        names: &[impl Names<RealRef>],
        slopes: &[f64],
    ) -> Result<(), ValueError> {
        Values::set_slopes(names, slopes, &mut self.ramp.slopes)
    }

    /// Sets Integer and Enumeration variables. If one value is refused, none is set.
    pub fn set_integers(
        &mut self,
        names: &[impl Names<IntegerRef>],
        values: &[i32],
    ) -> Result<(), ValueError> {
        self.withdraw_file();
        self.values.set_integers(self.stage, names, values)?;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    /// Sets Boolean variables: 0 is false and 1 is true. If one value is refused, none is set.
    pub fn set_booleans(
        &mut self,
        names: &[impl Names<BooleanRef>],
        values: &[i32],
    ) -> Result<(), ValueError> {
        self.withdraw_file();
        self.values.set_booleans(self.stage, names, values)?;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    /// Sets String variables in their order; if one value is refused, none is set. Until
    /// initialisation ends, setting `settings` also makes its assignments. Afterwards only its
    /// present text may be set, which changes nothing.
    pub fn set_strings(
        &mut self,
        names: &[impl Names<StringRef>],
        values: &[&str],
    ) -> Result<(), SetStringsError> {
        self.withdraw_file();
        let watch = Watch::begin();
        let mut changed = self.values.clone();
        for (name, value) in names.iter().zip(values) {
            let reference = name.reference()?;
            changed.set_strings(self.stage, &[reference], &[value])?;
            if reference == string::SETTINGS && self.stage == Stage::Configuring {
                settings::assign(&mut changed, value)?;
            }
        }
        if watch.is_short() {
            return Err(ValueError::NoMemory.into());
        }
        self.values = changed;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    /// Marks all computed values as out of date, after a panic that may have left them
    /// half-written.
    pub fn forget_results(&mut self) {
        self.invalidate(false);
    }

    /// Before a parameter is set: it is compared with the others as the importer has set them, and
    /// the rotor file's values follow when the rotor is made again.
    fn withdraw_file(&mut self) {
        if self.stage == Stage::Configuring && self.values.has_file_values() {
            // Its references were those of variables, and exist.
            let _ = self.values.withdraw_file();
            self.invalidate(true);
        }
    }

    /// The rotor is made again when it is needed, from the files as they are then.
    pub(super) fn forget_rotor(&mut self) {
        self.rotor = None;
        self.workspace = Workspace::default();
        self.dual_workspace = Workspace::default();
        self.files = Vec::new();
        self.saved_files = Vec::new();
    }

    fn invalidate(&mut self, rotor_changes: bool) {
        self.fresh = Fresh::Nothing;
        if rotor_changes {
            self.forget_rotor();
        }
    }
}

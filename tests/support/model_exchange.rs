//! The functions of Model Exchange of an instance.

use super::{
    Instance,
    c::{self, Component, Status},
};
use helicopter_rotor::block::variables::STATES;

// SAFETY in all of these: the component is living, and pointers are valid for their counts.
impl Instance<'_> {
    /// From before the initialisation to Continuous-Time Mode.
    #[track_caller]
    pub fn begin_integration(&self) {
        self.initialize();
        self.new_discrete_states();
        assert_eq!(self.enter_continuous_time(), c::OK);
    }

    pub fn enter_event_mode(&self) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2EnterEventMode)(self.component) }
    }

    /// Asserts that nothing but the discrete states changes.
    #[track_caller]
    pub fn new_discrete_states(&self) {
        let mut info = c::EventInfo {
            flags: [9; 5],
            next_event_time: -1.0,
        };
        // SAFETY: see above.
        let status = unsafe { (self.functions.fmi2NewDiscreteStates)(self.component, &mut info) };
        assert_eq!(status, c::OK, "{:?}", self.take_log());
        assert_eq!(info.flags, [0; 5]);
    }

    pub fn enter_continuous_time(&self) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2EnterContinuousTimeMode)(self.component) }
    }

    pub fn set_time(&self, time: f64) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2SetTime)(self.component, time) }
    }

    /// Whether Event Mode is asked for.
    #[track_caller]
    pub fn completed_step(&self) -> bool {
        let (mut event, mut end) = (9, 9);
        let completed = self.functions.fmi2CompletedIntegratorStep;
        // SAFETY: see above.
        let status = unsafe { completed(self.component, 1, &mut event, &mut end) };
        assert_eq!(status, c::OK, "{:?}", self.take_log());
        assert!([0, 1].contains(&event) && end == 0, "{event} {end}");
        event == 1
    }

    pub fn set_states(&self, x: &[f64]) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2SetContinuousStates)(self.component, x.as_ptr(), x.len()) }
    }

    #[track_caller]
    pub fn states(&self) -> Vec<f64> {
        self.state_vector(self.functions.fmi2GetContinuousStates)
    }

    #[track_caller]
    pub fn derivatives(&self) -> Vec<f64> {
        self.state_vector(self.functions.fmi2GetDerivatives)
    }

    #[track_caller]
    pub fn nominals(&self) -> Vec<f64> {
        self.state_vector(self.functions.fmi2GetNominalsOfContinuousStates)
    }

    #[track_caller]
    fn state_vector(
        &self,
        get: unsafe extern "C" fn(Component, *mut f64, usize) -> Status,
    ) -> Vec<f64> {
        let mut x = vec![f64::NAN; STATES.len()];
        // SAFETY: see above.
        let status = unsafe { get(self.component, x.as_mut_ptr(), x.len()) };
        assert_eq!(status, c::OK, "{:?}", self.take_log());
        x
    }
}

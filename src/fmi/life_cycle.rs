//! From the initialisation to the end.

use super::{
    communication_time::Experiment,
    instance::{Instance, Outcome},
    legality::INSTANTIATED,
};

impl Instance {
    /// Ends the initialisation.
    pub fn start(&mut self) -> Outcome {
        self.block.start()?;
        self.state = self.initialized();
        Ok(())
    }

    /// Returns to the state after the instantiation.
    pub fn reset(&mut self) -> Outcome {
        self.block.reset();
        self.experiment = Experiment::default();
        self.state = INSTANTIATED;
        Ok(())
    }
}

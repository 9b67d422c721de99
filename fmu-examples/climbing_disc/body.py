"""The body as an FMU: pythonfmu makes it from this file and parts.py."""

from parts import Body
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class BodyFmu(Fmi2Slave):
    description = "A mass that moves up and down, carried by a thrust"

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.mass = 1.0
        self.thrust = 0.0
        self.height = 0.0
        self.climb = 0.0
        fixed = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.fixed}
        self.register_variable(Real("mass", **fixed))
        self.register_variable(Real("thrust", causality=Fmi2Causality.input))
        self.register_variable(Real("height", causality=Fmi2Causality.output))
        self.register_variable(Real("climb", causality=Fmi2Causality.output))

    def exit_initialization_mode(self):
        self.body = Body(self.mass)

    def do_step(self, current_time, step_size):
        self.body.step(self.thrust, step_size)
        self.height, self.climb = self.body.height, self.body.climb
        return True

"""The controller as an FMU: pythonfmu makes it from this file and parts.py."""

from parts import Pid
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

PARAMETERS = {
    "gain": 1.0,
    "integral_time": 1.0,
    "derivative_time": 1.0,
    "weight": 1.0,
    "trim": 0.0,
    "low": -1.0,
    "high": 1.0,
}


class PidFmu(Fmi2Slave):
    description = "A PID controller with a limited output"

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.wanted = 0.0
        self.measured = 0.0
        self.output = 0.0
        fixed = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.fixed}
        for name, value in PARAMETERS.items():
            setattr(self, name, value)
            self.register_variable(Real(name, **fixed))
        self.register_variable(Real("wanted", **fixed))
        self.register_variable(Real("measured", causality=Fmi2Causality.input))
        self.register_variable(Real("output", causality=Fmi2Causality.output))

    def enter_initialization_mode(self):
        self.output = self.trim

    def exit_initialization_mode(self):
        self.pid = Pid(**{name: getattr(self, name) for name in PARAMETERS})

    def do_step(self, current_time, step_size):
        self.output = self.pid.step(self.wanted, self.measured, step_size)
        return True

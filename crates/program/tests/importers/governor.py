"""A controller as an FMU of FMI 3.0, made by pythonfmu3: an integrator that holds a thrust by the
collective pitch."""

from pythonfmu3 import Float64, Fmi3Causality, Fmi3Slave, Fmi3Variability


class Governor(Fmi3Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.time = 0.0
        # N
        self.thrust = 60.0
        self.wanted = 80.0
        # rad
        self.collective = 0.14
        for name, causality in [
            ("time", Fmi3Causality.independent),
            ("thrust", Fmi3Causality.input),
            ("collective", Fmi3Causality.output),
        ]:
            continuous = Fmi3Variability.continuous
            self.register_variable(Float64(name, causality=causality, variability=continuous))

    def do_step(self, current_time, step_size):
        self.collective += 0.01 * (self.wanted - self.thrust) * step_size
        self.time = current_time + step_size
        return True

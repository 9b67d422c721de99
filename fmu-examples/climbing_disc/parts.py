"""The parts of the climbing disc beside the rotor: a body that moves up and down, and a controller.

They are plain Python. climb.py calls them directly; body.py and pid.py make them FMUs.
"""

GRAVITY = 9.81  # m/s2


class Body:
    """A mass that the rotor carries. It moves vertically and begins at rest at height 0."""

    def __init__(self, mass):
        self.mass = mass
        self.height, self.climb = 0.0, 0.0

    def step(self, thrust, duration):
        """Moves on with a constant thrust, exactly."""
        acceleration = thrust / self.mass - GRAVITY
        self.height += (self.climb + 0.5 * acceleration * duration) * duration
        self.climb += acceleration * duration


class Pid:
    """A PID controller with a limited output, like Modelica.Blocks.Continuous.LimPID.

    It begins in balance with the output `trim` at the measurement 0. The derivative is that of the
    measurement, through a first-order filter. `weight` is the part of the wanted value that acts
    through the gain at once (wp of LimPID); less of it, less overshoot. While the output is at a
    limit the integral stands still.
    """

    def __init__(self, gain, integral_time, derivative_time, weight, trim, low, high):
        self.gain, self.integral_time, self.derivative_time = gain, integral_time, derivative_time
        self.weight, self.low, self.high = weight, low, high
        self.integral = trim
        self.output = trim
        self.filtered = None

    def step(self, wanted, measured, duration):
        if self.filtered is None:
            self.filtered = measured
        # Ten times as fast as the derivative, as in LimPID. The filter is solved implicitly.
        filter_time = self.derivative_time / 10.0
        rate = (measured - self.filtered) / (filter_time + duration)
        self.filtered += rate * duration
        action = self.weight * wanted - measured - self.derivative_time * rate
        free = self.integral + self.gain * action
        self.output = min(max(free, self.low), self.high)
        if self.output == free:
            self.integral += self.gain / self.integral_time * (wanted - measured) * duration
        return self.output

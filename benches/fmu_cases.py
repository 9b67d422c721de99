"""What peers.py times of HelicopterRotor.fmu, through its C interface, without an importer."""

import ctypes
import itertools
import math
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass

# The rotor, the defaults of the FMU; dynbem and CCBlade compute it, too.
BLADES, ELEMENTS = 4, 40
RADIUS, CUTOUT, CHORD = 0.762, 0.127, 0.0508  # m
POLAR = "resources/airfoils/naca0015-knight-hefner.polar"
RPM, COLLECTIVE, SPEED = 960.0, math.radians(8.0), 15.3  # rev/min, rad, m/s
# The collective moves a little at each call, so that no result can be used again.
MOVING = [COLLECTIVE + 1e-4 * k for k in range(7)]

AZIMUTH_STEP = math.radians(3.0)
# An azimuth step takes three evaluations of all blades: two stages of Heun's method, and that of
# the outputs, which is also the first stage of the next step. If the inputs change, it is not,
# and the step takes a fourth.
EVALUATIONS, EVALUATIONS_MOVING = 3, 4
FULL_SCALE_RPM = 430.0  # rev/min, for the real-time factor


class PeerError(Exception):
    """What failed and what to do, in a sentence."""


@dataclass
class Case:
    """Something to time. `run(n)` does it n times."""

    what: str
    run: Callable[[int], None]
    note: str  # what is alike to the case that it is compared with, and what is not
    elements: int = 0  # that a call evaluates; 0: there are no blade elements
    simulated: float = 0.0  # time that a call simulates, s
    thrust: float | None = None  # N; it shows that the cases compute the same thing
    beside: "Case | None" = None  # the case of the FMU to compare with
    overhead: Callable[[int], None] | None = None  # to subtract from `run`
    runs: int = 1  # how many runs a call stands for


class Fmu:
    """The library and the description of an FMU that is unpacked in a folder."""

    def __init__(self, folder):
        if not (folder / "modelDescription.xml").is_file():
            raise PeerError("the FMU has no modelDescription.xml; name a HelicopterRotor.fmu")
        description = ET.parse(folder / "modelDescription.xml").getroot()
        model = description.get("modelName")
        if model != "HelicopterRotor":
            raise PeerError(f"the FMU is {model}; name a HelicopterRotor.fmu")
        self.version = description.get("version")
        self.guid = description.get("guid").encode()
        self.resources = (folder / "resources").as_uri().encode()
        variables = description.iter("ScalarVariable")
        self.reference = {v.get("name"): int(v.get("valueReference")) for v in variables}
        name = description.find("CoSimulation").get("modelIdentifier")
        try:
            self.library = ctypes.CDLL(str(folder / "binaries" / "linux64" / f"{name}.so"))
        except OSError as error:
            hint = "make the FMU on this machine with `cargo run --release -- package`"
            raise PeerError(f"the library of the FMU cannot be loaded: {error}; {hint}") from error
        self.library.fmi2Instantiate.restype = ctypes.c_void_p
        texts = ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p
        self.messages = []
        self.logger = ctypes.CFUNCTYPE(None, ctypes.c_void_p, *texts)(self._log)
        # fmi2CallbackFunctions, of which the FMU needs only the first.
        self.callbacks = (ctypes.c_void_p * 5)(ctypes.cast(self.logger, ctypes.c_void_p).value)

    def _log(self, _environment, _instance, _status, _category, message):
        self.messages.append(message.decode(errors="replace").replace("%%", "%"))

    def refusal(self):
        said = " ".join(self.messages) or "and logged no reason"
        return PeerError(f"the FMU refused a call: {said}")

    def references(self, *names):
        return (ctypes.c_uint * len(names))(*(self.reference[name] for name in names))

    def started(self, settings, inputs, values):
        """An instance after its initialisation, with the values of three inputs."""
        library, zero = self.library, ctypes.c_double(0.0)
        component = ctypes.c_void_p(
            library.fmi2Instantiate(b"rotor", 1, self.guid, self.resources, self.callbacks, 0, 0)
        )
        parameter, text = self.references("settings"), (ctypes.c_char_p * 1)(settings.encode())
        if (
            not component
            or library.fmi2SetString(component, parameter, ctypes.c_size_t(1), text)
            or library.fmi2SetReal(component, inputs, ctypes.c_size_t(3), values)
            or library.fmi2SetupExperiment(component, 0, zero, zero, 0, zero)
            or library.fmi2EnterInitializationMode(component)
            or library.fmi2ExitInitializationMode(component)
        ):
            raise self.refusal()
        return component

    def case(self, what, note, settings, collectives, speed, duration, **details):
        """Sets 3 inputs, makes a step and gets 6 outputs; the arrays are made beforehand."""
        inputs = self.references("collective", "rpm", "velocity[1]")
        outputs = self.references(*(f"{q}[{k}]" for q in ("force", "moment") for k in (1, 2, 3)))
        values = [(ctypes.c_double * 3)(collective, RPM, speed) for collective in collectives]
        component = self.started(settings, inputs, values[0])
        library, three, six = self.library, ctypes.c_size_t(3), ctypes.c_size_t(6)
        set_real, do_step, get_real = library.fmi2SetReal, library.fmi2DoStep, library.fmi2GetReal
        now, step = ctypes.c_double(0.0), ctypes.c_double(duration)
        results, turns = (ctypes.c_double * 6)(), itertools.cycle(values)

        def run(count):
            for _ in range(count):
                if (
                    set_real(component, inputs, three, next(turns))
                    or do_step(component, now, step, 1)
                    or get_real(component, outputs, six, results)
                ):
                    raise self.refusal()
                now.value += duration

        run(1)
        return Case(what, run, note, thrust=results[2], **details)


def fmu_cases(fmu):
    evaluation = BLADES * ELEMENTS
    # A step that rounding makes longer than that of the azimuth grid would begin a second one.
    step = AZIMUTH_STEP / (RPM * math.pi / 30.0) * (1.0 - 1e-12)
    simulated = AZIMUTH_STEP / (FULL_SCALE_RPM * math.pi / 30.0)
    annulus = fmu.case(
        "The FMU: hover in annuli, collective moving",
        f"""{ELEMENTS} annuli solved with swirl and Prandtl's tip loss. The section table is
        corrected for Mach and Reynolds number. A step writes all outputs, also those of 20 blade
        stations.""",
        *("", MOVING, 0.0, 1e-3),
        elements=ELEMENTS,
    )
    yield annulus
    yield fmu.case(
        "The FMU: hover in closed form, collective moving",
        """Alike: the rotor, the elements, the outputs. Not alike: the inflow, which holds for
        small angles and a linear lift slope, and has no iteration.""",
        *("models.inflow = annulusClosedForm", MOVING, 0.0, 1e-3),
        elements=ELEMENTS,
        beside=annulus,
    )
    what = f"The FMU: 3 deg of azimuth, {BLADES} flapping blades, Pitt-Peters, {SPEED} m/s"
    dynamic = "models.inflow = pittPetersDynamic; flapping.enabled = true"
    constant = fmu.case(
        f"{what}, inputs constant",
        f"""{EVALUATIONS} evaluations of {evaluation} elements: two stages of Heun's method, and
        that of the outputs, which begins the next step. Timed at {RPM:g} rev/min; the real-time
        factor is that of the same step at {FULL_SCALE_RPM:g} rev/min. The thrust is that of one
        moment.""",
        *(dynamic, [COLLECTIVE], SPEED, step),
        elements=EVALUATIONS * evaluation,
        simulated=simulated,
    )
    yield constant
    yield fmu.case(
        f"{what}, collective moving",
        f"""The same with {EVALUATIONS_MOVING} evaluations: after a change of the inputs the rates
        at the beginning of the step must be computed again.""",
        *(dynamic, MOVING, SPEED, step),
        elements=EVALUATIONS_MOVING * evaluation,
        simulated=simulated,
        beside=constant,
    )


def section(folder):
    """Angles of attack (deg), lift and drag coefficients of the section that the FMU uses."""
    rows = []
    for line in (folder / POLAR).read_text(encoding="utf-8").splitlines():
        fields = line.split()
        if len(fields) == 3 and fields[0].lstrip("-")[0].isdigit():
            rows.append([float(field) for field in fields])
    if not rows:
        raise PeerError(f"{POLAR} in the FMU has no rows of alpha, cl and cd; make the FMU again")
    return list(zip(*rows))

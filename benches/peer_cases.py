"""What peers.py times of dynbem, CCBlade and JSBSim."""

import ctypes
import itertools
import math
import sys
import types
from pathlib import Path

from fmu_cases import (
    BLADES,
    CHORD,
    CUTOUT,
    ELEMENTS,
    MOVING,
    RADIUS,
    RPM,
    SPEED,
    Case,
    PeerError,
)

AIR_DENSITY, AIR_VISCOSITY = 1.225, 1.81e-5  # kg/m3, Pa s
AZIMUTHS = 36  # dynbem's default
WIND, TURBINE_PITCH = 10.0, 2.0  # m/s, deg; of CCBlade

SCRIPT = "scripts/ah1s_flight_test.xml"
HOVERING = 60.0  # s, when the script hovers out of ground effect
HOVER_ONLY = 5  # none of the script's tests, so it goes on hovering
POUND = 4.448222  # N


def peer_cases(annulus, step, polar):
    """The cases of all peers, compared with these two of the FMU."""
    yield from dynbem_cases(annulus, step, polar)
    yield from ccblade_cases(annulus, polar)
    yield from jsbsim_cases(step)


# ---------------------------------------------------------------- dynbem


def dynbem_cases(annulus, step, polar):
    import dynbem
    import numpy as np

    alpha, lift, drag = polar
    blade = dynbem.BladeGeometry(BLADES, RADIUS, CUTOUT, CHORD, n_elements=ELEMENTS)
    # Required, but the table takes its place.
    linear = dynbem.LinearPolarParameters(0.0, 5.7, 0.011, 12.0)
    rotor = dynbem.RotorDefinition(blade=blade, airfoil=linear)
    table = dynbem.TabulatedPolar(np.radians(alpha), np.array(lift), np.array(drag))

    def inputs(collective, speed):
        return dynbem.RotorInputs(
            collective_rad=collective,
            tilt_lon=0.0,
            tilt_lat=0.0,
            R_hub=np.eye(3),
            v_hub_world=np.array([speed, 0.0, 0.0]),
            wind_world=np.zeros(3),
            omega_rad_s=RPM * math.pi / 30.0,
            rho_kg_m3=AIR_DENSITY,
        )

    def case(what, note, model, speed, **details):
        values = [inputs(collective, speed) for collective in MOVING]
        state = model.initial_rotor_state()
        if len(state.to_array()):
            state = dynbem.relax_inflow(model, state, values[0])
        thrust = -model.compute_forces(values[0], state)[0].F_world[2]
        turns, compute_forces = itertools.cycle(values), model.compute_forces

        def run(count):
            for _ in range(count):
                compute_forces(next(turns), state)

        return Case(f"dynbem: {what}", run, note, thrust=thrust, **details)

    yield case(
        "hover, QuasiStaticBEM, collective moving",
        f"""Alike: the rotor, {ELEMENTS} annuli solved with swirl and Prandtl's tip loss, the
        section table. Not alike: it has a root loss; it has no Mach or Reynolds number in the
        section data and no outputs along the blade.""",
        *(dynbem.QuasiStaticBEM(rotor, table), 0.0),
        elements=ELEMENTS,
        beside=annulus,
    )
    as_many = "; it has as many elements as an evaluation of the FMU"
    for azimuths, more in ((AZIMUTHS, ""), (BLADES, as_many)):
        yield case(
            f"{SPEED} m/s, PittPetersModel, {azimuths} azimuths, one evaluation, collective moving",
            f"""Alike: the rotor, {ELEMENTS} elements at each azimuth, three inflow states, the
            section table{more}. Not alike: it averages rigid blades over the azimuths, the FMU
            moves flapping blades; it has no tip loss, and no Mach or Reynolds number in the
            section data. Its time is that of forces and inflow rates only; that of the FMU has the
            integration and the outputs along the blade in it.""",
            *(dynbem.PittPetersModel(rotor, table, azimuths), SPEED),
            elements=azimuths * ELEMENTS,
            beside=step,
        )


# ---------------------------------------------------------------- CCBlade


def import_ccblade():
    """CCBlade, and the path of its Fortran library, without the rest of WISDEM: CCBlade needs only
    NumPy and SciPy, but wisdem/__init__.py imports over a hundred packages. An empty package takes
    its place.
    """
    folders = [Path(p) / "wisdem" for p in sys.path if (Path(p) / "wisdem/ccblade").is_dir()]
    if not folders:
        raise ModuleNotFoundError(name="wisdem")
    sys.modules["wisdem"] = types.ModuleType("wisdem")
    sys.modules["wisdem"].__path__ = [str(folders[0])]
    from wisdem.ccblade import _bem, ccblade

    return ccblade, _bem.__file__


def ccblade_cases(annulus, polar):
    import numpy as np

    ccblade, library = import_ccblade()
    alpha, lift, drag = polar
    radii = CUTOUT + (np.arange(ELEMENTS) + 0.5) * (RADIUS - CUTOUT) / ELEMENTS
    # Without Reynolds numbers, as the table has only one.
    airfoil = ccblade.CCAirfoil(alpha, [], np.array(lift)[:, None], np.array(drag)[:, None])
    rotor = ccblade.CCBlade(
        *(radii, np.full(ELEMENTS, CHORD), np.zeros(ELEMENTS), [airfoil] * ELEMENTS),
        *(CUTOUT, RADIUS, BLADES, AIR_DENSITY, AIR_VISCOSITY),
        shearExp=0.0,
    )
    wind, rpm = np.array([WIND]), np.array([RPM])
    pitches = [np.array([TURBINE_PITCH + math.degrees(1e-4 * k)]) for k in range(7)]
    turns = itertools.cycle(pitches)

    def run(count):
        for _ in range(count):
            rotor.evaluate(wind, rpm, next(turns))

    # The section data are read once for each residual.
    residuals, evaluate = 0, airfoil.evaluate

    def counted(*arguments):
        nonlocal residuals
        residuals += 1
        return evaluate(*arguments)

    airfoil.evaluate = counted
    thrust = float(rotor.evaluate(wind, rpm, pitches[0])[0]["T"][0])
    airfoil.evaluate = evaluate

    yield Case(
        f"CCBlade: wind turbine at {WIND:g} m/s, whole, pitch moving",
        run,
        f"""Alike: the rotor, {ELEMENTS} annuli solved with swirl and Prandtl's tip loss, the
        section table. Not alike: the operating point, because CCBlade solves wind turbines, and
        its loads are 0 without wind; it has a root loss, smooths the table with a spline and has
        no Mach number. Its loop over the elements, its root finder and its splines are called from
        Python, which takes most of its time.""",
        elements=ELEMENTS,
        thrust=thrust,
        beside=annulus,
    )
    kernel, nothing = ccblade_kernel(ctypes.CDLL(library), rotor)
    yield Case(
        f"CCBlade: the same, Fortran kernel only, {residuals} residuals",
        kernel,
        """What the compiled part takes of that: angle of attack and induction factors. Section
        data and root finder are not in it, nor the calls from Python, whose cost is measured with
        a function that does nothing, and subtracted. It cannot compute a rotor alone. The time of
        the FMU is the whole, with its calls from Python.""",
        elements=ELEMENTS,
        beside=annulus,
        overhead=nothing,
        runs=residuals,
    )


def ccblade_kernel(library, rotor):
    """What computes a residual in Fortran at the middle of the blade, and as many calls to a
    function that does nothing."""
    loads, _ = rotor.distributedAeroLoads(WIND, RPM, TURBINE_PITCH, 0.0)
    middle = ELEMENTS // 2
    radius = float(rotor.r[middle])
    attack, lift, drag = (float(loads[key][middle]) for key in ("alpha", "Cl", "Cd"))
    pitch, across = math.radians(TURBINE_PITCH), RPM * math.pi / 30.0 * radius
    angle = math.radians(attack) + pitch

    def pointers(*values):
        kinds = {int: ctypes.c_int, float: ctypes.c_double}
        return [ctypes.byref(kinds[type(value)](value)) for value in values]

    air = (AIR_DENSITY, AIR_VISCOSITY)
    switches, results = (1, 1, 1, 1), (0.0, 0.0, 0.0)
    relative = pointers(angle, 0.0, 0.0, WIND, across, pitch, CHORD, 0.0, *air, *results)
    element = (radius, CHORD, CUTOUT, RADIUS, angle, lift, drag, BLADES, WIND, across)
    induction = pointers(*element, *switches, *results)

    def calls(of_relative, of_induction):
        of_relative.restype = of_induction.restype = None

        def run(count):
            for _ in range(count):
                of_relative(*relative)
                of_induction(*induction)

        return run

    nothing = ctypes.CDLL(None).labs
    return calls(library.relativewind_, library.inductionfactors_), calls(nothing, nothing)


# ---------------------------------------------------------------- JSBSim


def jsbsim_cases(step):
    import jsbsim

    jsbsim.set_logger(jsbsim.DefaultLogger(jsbsim.LogLevel.FATAL))
    aircraft = jsbsim.FGFDMExec(None)
    aircraft.set_debug_level(0)
    duration = aircraft.get_delta_t()
    if not aircraft.load_script(SCRIPT, duration) or not aircraft.run_ic():
        raise PeerError(f"JSBSim cannot load {SCRIPT}; install the version in requirements.txt")
    aircraft["simulation/test-variant"] = HOVER_ONLY

    def run(count):
        advance = aircraft.run
        for _ in range(count):
            if not advance():
                raise PeerError(
                    f"{SCRIPT} came to its end; take a smaller --repeat or --milliseconds"
                )

    run(round(HOVERING / duration))
    yield Case(
        f"JSBSim: the whole ah1s in hover, its default step of 1/{round(1.0 / duration)} s",
        run,
        """Nothing is alike but the purpose. JSBSim has no blade elements: thrust, torque and
        flapping of its rotors are closed formulae of the whole disc, with a first-order lag of the
        inflow. Its time is that of a whole aircraft with main and tail rotor, fuselage, engines,
        controls and autopilot; that of the FMU is one rotor.""",
        simulated=duration,
        thrust=POUND * aircraft["propulsion/engine/thrust-lbs"],
        beside=step,
    )

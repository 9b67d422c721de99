"""The helicopter: a light twin, the Agusta A109, and the forces of the air on its airframe.

The numbers are those of the example in Heffley & Mnich (1988), "Minimum-Complexity Helicopter
Simulation Math Model", NASA CR-177476, in the units of the report: feet, pounds, slugs, inches for
stations (aft) and water lines (up). They were read from two public programs that copy the report's
table and agree with each other (heli-gym, and Minimum-Complexity-Helicopter-Model by straycat11),
not from the report itself. Weight, rotors and speeds are those of the A109A; the programs give no
name. What the table does not say is assumed, and called so.

Body axes: x forward, y left, z up from the centre of gravity, as in the FMU.
"""

import math

import numpy as np

FOOT, INCH, POUND, SLUG = 0.3048, 0.0254, 4.4482216, 14.5939029  # SI
GRAVITY = 9.80665  # m/s2
DENSITY = 1.225  # kg/m3

MASS = 5401.0 * POUND / GRAVITY  # kg
_ROLL, _PITCH, _YAW, _CROSS = np.array([1300.0, 6760.0, 6407.0, 800.0]) * SLUG * FOOT**2
# The report's axes point right and down, which turns the sign of the product of inertia twice; the
# element of the tensor is minus the product.
INERTIA = np.array([[_ROLL, 0.0, _CROSS], [0.0, _PITCH, 0.0], [_CROSS, 0.0, _YAW]])  # kg.m2


def _place(station, water_line):
    return np.array([132.7 - station, 0.0, water_line - 38.5]) * INCH


HUB = _place(132.4, 98.2)  # m, from the centre of gravity
TAIL_HUB = _place(391.0, 70.0)
FUSELAGE = _place(132.0, 38.0)
HORIZONTAL_TAIL = _place(330.0, 54.0)
VERTICAL_TAIL = _place(380.0, 80.0)

RPM, TAIL_RPM = 385.0, 2080.0
SHAFT = 0.11  # rad, forward
_COMMON = {
    "geometry.rootCutout": 0.2,  # assumed
    # NACA 0012 is assumed. The table has lift slopes of 6 and 3 per rad for the two rotors and a
    # drag coefficient of 0.010.
    "airfoil.file": "airfoils/naca0012.polar",
    "air.atmosphere": "userDefined",
    "air.density": DENSITY,
}
MAIN_ROTOR = _COMMON | {
    "geometry.numberOfBlades": 4,
    "geometry.radius": 18.0 * FOOT,
    "geometry.chord": 1.10 * FOOT,
    "geometry.twist": -0.105,
    "flapping.enabled": True,
    "flapping.hingeOffset": 0.50 / 18.0,
    "flapping.inertia": 212.0 * SLUG * FOOT**2,
    "models.inflow": "pittPetersDynamic",
    # Half as many elements and half as many steps as by default cost 0.2 % of the thrust, and save
    # three quarters of the time.
    "numerics.elements": 20,
    "numerics.azimuthStep": math.radians(6.0),
}
# Two blades (assumed), whose chord follows from the solidity of 0.134. They teeter: the FMU's rigid
# blades without cyclic pitch give the averages of thrust and torque, and the hub passes on no other
# moment. It pulls to the right, against the torque of a main rotor that turns counter-clockwise.
TAIL_ROTOR = _COMMON | {
    "geometry.numberOfBlades": 2,
    "geometry.radius": 3.1 * FOOT,
    "geometry.chord": 0.134 * math.pi * 3.1 / 2.0 * FOOT,
    "geometry.twist": -0.137,
    "models.inflow": "uniform",
    "models.blades": "disc",
}

# The drag table: force over dynamic pressure along each axis, ft2.
_FORWARD, _SIDE, _VERTICAL = 10.8, 167.0, 85.0
# Tails: lift over dynamic pressure at zero incidence, its slope, and its largest value, ft2.
_H_ZERO, _H_SLOPE, _H_MOST = 0.4, 34.0, 22.0
_V_ZERO, _V_SLOPE, _V_MOST = 3.3, 47.0, 17.0


def airframe(velocity, rates, induced):
    """Force (N) and moment (N.m) on fuselage and tails, in body axes, from the velocity (m/s)
    and the rates (rad/s) of the body. The fuselage is in the wake of the main rotor, with the
    induced velocity (m/s); at the tails it is left out."""
    half = 0.5 * DENSITY * FOOT**2
    u, v, w = velocity + np.cross(rates, FUSELAGE)
    w += induced
    body = -half * np.array([_FORWARD * abs(u) * u, _SIDE * abs(v) * v, _VERTICAL * abs(w) * w])
    u, _, w = velocity + np.cross(rates, HORIZONTAL_TAIL)
    level = np.array([0.0, 0.0, -half * _tail(u, w, _H_ZERO, _H_SLOPE, _H_MOST)])
    u, v, _ = velocity + np.cross(rates, VERTICAL_TAIL)
    fin = np.array([0.0, -half * _tail(u, v, _V_ZERO, _V_SLOPE, _V_MOST), 0.0])
    force = body + level + fin
    places = (FUSELAGE, HORIZONTAL_TAIL, VERTICAL_TAIL)
    return force, sum(np.cross(place, part) for place, part in zip(places, (body, level, fin)))


def _tail(along, across, zero, slope, most):
    """Force over half the density: linear in the incidence up to 0.3 rad, then stalled."""
    if abs(across) > 0.3 * abs(along):
        return most * math.hypot(along, across) * across
    return zero * abs(along) * along + slope * abs(along) * across

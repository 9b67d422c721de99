"""The rotors that are flown and the air in which they were measured. Nothing here is fitted."""

import math
import re
import tempfile
from pathlib import Path


def air(density, temperature):
    """Parameters for air of a density, kg/m3, and a temperature, K."""
    return {"air.atmosphere": "userDefined", "air.density": density, "air.temperature": temperature}


# Knight & Hefner give 960 rpm and a tip Reynolds number of 242,000: air of 30 degrees Celsius at
# sea-level pressure.
KNIGHT_HEFNER_RPM = 960.0
KNIGHT_HEFNER_RADIUS = 0.762
KNIGHT_HEFNER_AIR = air(1.164, 303.15)
SLOPES = "airfoils/naca0015.txt"


def knight_hefner(blades):
    return {
        "geometry.file": f"knight-hefner-{blades}.toml",
        "rpm": KNIGHT_HEFNER_RPM,
        **KNIGHT_HEFNER_AIR,
    }


def knight_hefner_slopes(blades, resources, folder):
    """The same rotor with the section of airfoil.file along the whole blade and without the root
    fairing, because lift slopes are given only for NACA 0015 and the fairing ends in a circle."""
    text = (resources / "rotors" / f"knight-hefner-{blades}.toml").read_text(encoding="utf-8")
    text = re.sub(r"^.*circle\.polar.*\n", "", text, flags=re.MULTILINE)
    text = re.sub(r', airfoil = "[^"]*"', "", text)
    file = folder / f"knight-hefner-{blades}-slopes.toml"
    file.write_text(text, encoding="utf-8")
    return {
        "geometry.file": str(file),
        "airfoil.file": SLOPES,
        "rpm": KNIGHT_HEFNER_RPM,
        **KNIGHT_HEFNER_AIR,
    }


def of_study(case, resources, folder):
    """The rotor of a case in the studies of the thesis, with lift slopes along the whole blade: the
    thesis' own rotor, or Knight & Hefner's with the number of blades in the name of the case."""
    if case.startswith("thesis"):
        return THESIS
    blades = case.removeprefix("Knight & Hefner, ").split()[0]
    return knight_hefner_slopes(blades, resources, Path(folder))


def own_folder():
    """A temporary folder for rotor definitions."""
    return tempfile.TemporaryDirectory(prefix="rotors-")


# Castles & Gray give a Mach number of 0.248 and a Reynolds number of 256,000 at 0.75 R and 1200
# rpm. The speed of sound is then 347 m/s and the kinematic viscosity 1.62e-5 m2/s: air of 27
# degrees Celsius at sea-level pressure.
CASTLES_GRAY_RADIUS = 0.9144
CASTLES_GRAY = {"geometry.file": "castles-gray-6ft.toml", **air(1.177, 300.0)}
CASTLES_GRAY_TWISTED = {**CASTLES_GRAY, "geometry.file": "castles-gray-6ft-twist12.toml"}

# The rotor of the thesis, with a tip speed of 55 m/s. The chord in its file is ASSUMED.
THESIS_RADIUS = 1.22
THESIS_RPM = 55.0 / THESIS_RADIUS * 30.0 / math.pi
THESIS_PITCHES = (15.3, 16.9)
THESIS_CHOICES = {
    "models.inflow": "annulusClosedForm",
    "models.lift": "slopesByReynolds",
    "models.compressibility": "karmanTsien",
    "models.tipLoss": "prandtl",
}
THESIS = {"geometry.file": "thesis.toml", "airfoil.file": SLOPES, "rpm": THESIS_RPM}


def hover_speed(thrust_coefficient, radius, rpm):
    """v_h = Omega R sqrt(CT/2), the induced velocity of hover by momentum theory, m/s."""
    return rpm * math.pi / 30.0 * radius * math.sqrt(0.5 * thrust_coefficient)

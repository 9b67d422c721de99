"""The importers, and why they cannot do what they cannot."""

from dataclasses import dataclass


@dataclass
class Importer:
    name: str
    # The package in PyPI, or the crate.
    package: str
    # The script or the Rust program.
    program: str
    # Whether it installs within a minute.
    is_quick: bool = False
    # Oldest version of Python for which there is a package.
    python: tuple = (3, 10)
    # Otherwise its script has a mode "workaround", in which it can.
    sets_strings: bool = True

    @property
    def is_rust(self):
        return not self.program.endswith(".py")


@dataclass
class Note:
    # What the failing run prints.
    evidence: str
    # Whose fault it is, and what helps.
    text: str


FMPY = Importer("FMPy", "fmpy", "with_fmpy.py", is_quick=True)
PATHSIM = Importer(
    "PathSim (pathsim-fmi)", "pathsim-fmi", "with_pathsim.py", is_quick=True, sets_strings=False
)
LIBCOSIM = Importer("libcosimpy", "libcosimpy", "with_libcosimpy.py", is_quick=True, python=(3, 11))
ECOS = Importer("Ecos", "ecospy", "with_ecos.py")
FMULOADER = Importer("fmuloader", "fmuloader", "with_fmuloader.py", is_quick=True, python=(3, 11))
CONTAINER = Importer(
    "fmucontainer", "fmu-manipulation-toolbox", "with_fmucontainer.py", is_quick=True
)
FMI_SIM = Importer("fmi-sim", "fmi-sim", "with_fmi_sim.py")
RUST_FMI = Importer("fmi", "fmi", "with-fmi")
FMI_RS = Importer("fmi-rs", "fmi-rs", "with-fmi-rs")
FMU_RUNNER = Importer("fmu-runner", "fmu-runner", "with-fmu-runner", sets_strings=False)

IMPORTERS = [
    FMPY,
    PATHSIM,
    LIBCOSIM,
    ECOS,
    FMULOADER,
    CONTAINER,
    FMI_SIM,
    RUST_FMI,
    FMI_RS,
    FMU_RUNNER,
]

# Those that are flown with the file of FMI 3.0, too.
OF_FMI3 = [FMPY, LIBCOSIM, ECOS, FMI_SIM]

# What a program prints if the importer has no function for a kind of flight: no gap in it.
NO_FUNCTION = "no function to fly"

# By importer and column of the table.
NOTES = {
    ("FMPy", "SSP"): Note(
        "Unsupported type: String",
        "FMPy: `simulate_ssp` ignores the parameters in an .ssp file; a set of parameters that is "
        "passed to it cannot contain strings. Numbers work.",
    ),
    ("PathSim (pathsim-fmi)", "strings"): Note(
        "Unsupported variable type: String",
        "PathSim: `start_values` refuses strings.",
    ),
    ("PathSim (pathsim-fmi)", "enumerations"): Note(
        "Unsupported variable type: Enumeration",
        "PathSim: `start_values` refuses enumerations, which it could set as integers.",
    ),
    ("PathSim (pathsim-fmi)", "`settings`"): Note(
        "Unsupported variable type: String",
        "With the lines below, as PathSim refuses strings.",
    ),
    ("libcosimpy", "enumerations"): Note(
        "FMI 2.0 Enumeration variable type not supported",
        "libcosim ignores enumerations when it reads an FMU. Use `settings`.",
    ),
    ("Ecos", "enumerations"): Note(
        "No variable named 'models.inflow' of type int",
        "Ecos has no enumerations: it warns and flies with the default. Use `settings`.",
    ),
    ("fmu-runner", "strings"): Note(
        "no function to set a String",
        "fmu-runner has no function to set strings. Enumerations are set as integers.",
    ),
    ("fmu-runner", "`settings`"): Note(
        "no function to set a String",
        "fmu-runner has no function to set strings. Enumerations are set as integers.",
    ),
}

# The same for the file of FMI 3.0.
NOTES_OF_FMI3 = {
    ("Ecos", "enumerations"): Note(
        "No variable named 'models.inflow' of type int",
        "Ecos has no enumerations: it warns and flies with the default. Use `settings`.",
    ),
}
for column in ["loads", "CS", "numbers", "strings", "enumerations", "`settings`"]:
    NOTES_OF_FMI3["fmi-sim", column] = Note(
        'unknown field "K" in element "BaseUnit"',
        "fmi-sim, like the crate fmi on which it is built, does not know the attributes `K` and "
        "`unit` of the standard and refuses the description. Without them it asks each array for "
        "one value, which the FMU refuses. Use the file of FMI 2.0.",
    )
    NOTES_OF_FMI3["libcosimpy", column] = Note(
        "ended by signal 11",
        "libcosim ends with a segmentation fault while it reads any description of FMI 3.0, also "
        "that of an FMU without a library. Use the file of FMI 2.0.",
    )
NOTES_OF_FMI3["fmi-sim", "ME"] = NOTES_OF_FMI3["fmi-sim", "CS"]
NOTES_OF_FMI3["libcosimpy", "second run"] = NOTES_OF_FMI3["libcosimpy", "CS"]

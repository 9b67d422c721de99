"""Holds the reference files in an FMU against the rules of their formats.

Prints what breaks the rules, or "Conforms.".

FMI Layered Standard References: elements, attributes and roles of the manifest and the experiments
file, and where files lie. Parameter sets are validated by the schema of SSP that comes with FMPy.
CSV files keep the rules of the FMI cross-check, version 4.1, appendix B, and one of this project:
there is a row of inputs at each communication point.

    python layered_standard.py HelicopterRotor.fmu
"""

import re
import sys
import zipfile
from pathlib import Path
from posixpath import dirname, join, normpath

import fmpy
from lxml import etree

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
NAMESPACE = "{http://fmi-standard.org/fmi-ls-manifest}"
ROOT = {
    f"{NAMESPACE}fmi-ls-name": "org.fmi-standard.fmi-ls-ref",
    f"{NAMESPACE}fmi-ls-version": "1.0.0-alpha.1",
    f"{NAMESPACE}fmi-ls-description": (
        "Layered Standard providing information on related files included in an FMU."
    ),
}
ROLES = (
    "document|requirement|specification|model|parameter|system|testcase"
    "|experiment(/(smoke-test|validation|uncertainty-analysis))?|result|method|rationale|report|request|delivery"
    "|configuration|signature|serialized-state(/.*)?|meta-data|other"
)
PARTS = ["Parameters", "Stimuli", "References"]
NUMBER = re.compile(r"-?\d+(\.\d+)?(e[-+]\d+)?")

problems = []


def expect(condition, problem):
    if not condition:
        problems.append(problem)


def manifest(archive):
    """Path in the archive and role of each related file."""
    root = etree.fromstring(archive.read(f"{FOLDER}/fmi-ls-manifest.xml"))
    expect(root.tag == "fmiReferences", f"the manifest's root is {root.tag}")
    expect(dict(root.attrib) == ROOT, f"the manifest's root has the attributes {dict(root.attrib)}")
    related = {}
    for element in root:
        source = normpath(join(FOLDER, element.get("source", "")))
        expect(element.tag == "Related", f"the manifest has an element {element.tag}")
        expect(
            set(element.attrib) == {"type", "source", "role", "description"},
            f"{source}: {dict(element.attrib)}",
        )
        expect(
            re.fullmatch(ROLES, element.get("role", "")),
            f"{source} has the role {element.get('role')}",
        )
        expect(source in archive.namelist(), f"{source} is not in the archive")
        expect(source not in related, f"{source} is named twice")
        related[source] = element.get("role")
    for name in archive.namelist():
        if name.startswith("extra/") and not name.endswith("fmi-ls-manifest.xml"):
            expect(name in related, f"the manifest does not name {name}")
    return related


def table(archive, path, variables, causality):
    text = archive.read(path).decode("ascii")
    expect(len(text) < 1_000_000 and text.endswith("\n"), f"{path} has {len(text)} characters")
    header, *lines = text.splitlines()
    names = header.split(",")
    expect(all(re.fullmatch('"[^"]+"', name) for name in names), f"{path}: the header is {header}")
    names = [name.strip('"') for name in names]
    expect(names[0] == "time", f"{path}: the first column is {names[0]}")
    for name in names[1:]:
        found = variables.get(name)
        expect(
            found and found.causality == causality, f"{path}: {name} is no {causality} of the FMU"
        )
    rows = [line.split(",") for line in lines]
    for row in rows:
        fits = len(row) == len(names) and all(NUMBER.fullmatch(field) for field in row)
        expect(fits, f"{path}: {row} is not a row of numbers")
    return [float(row[0]) for row in rows]


def experiments(archive, path, variables):
    root = etree.fromstring(archive.read(path))
    expect(root.tag == "Experiments", f"{path}: the root is {root.tag}")
    expect(set(root.attrib) == {"name", "description"}, f"{path}: {dict(root.attrib)}")
    names = [element.get("name") for element in root]
    expect(len(set(names)) == len(names) >= 4, f"{path}: the experiments are {names}")
    for element in root:
        name = element.get("name")
        attributes = {"name", "description", "startTime", "stopTime", "stepSize"}
        expect(
            element.tag == "Experiment" and set(element.attrib) == attributes,
            f"{path}: {dict(element.attrib)}",
        )
        parts = [child.tag for child in element]
        expect(parts == [part for part in PARTS if part in parts], f"{name} has the parts {parts}")
        source = {
            child.tag: normpath(join(dirname(path), child.get("source"))) for child in element
        }
        start, stop, step = (
            float(element.get(key)) for key in ("startTime", "stopTime", "stepSize")
        )
        times = table(archive, source["Stimuli"], variables, "input")
        points = [start + i * step for i in range(round((stop - start) / step) + 1)]
        expect(
            len(times) == len(points),
            f"{name}: {len(times)} rows of inputs, {len(points)} communication points",
        )
        expect(
            all(abs(t - p) < 1e-9 for t, p in zip(times, points)),
            f"{name}: inputs are not at communication points",
        )
        times = table(archive, source["References"], variables, "output")
        expect(
            (times[0], times[-1]) == (start, stop),
            f"{name}: references from {times[0]} to {times[-1]} s",
        )
        on_points = all(abs(t / step - round(t / step)) < 1e-6 for t in times)
        expect(
            on_points and times == sorted(set(times)),
            f"{name}: references are not at communication points",
        )


def parameter_set(archive, path, variables):
    schema = Path(fmpy.__file__).parent / "ssp" / "schema" / "SystemStructureParameterValues.xsd"
    schema = etree.XMLSchema(etree.parse(str(schema)))
    root = etree.fromstring(archive.read(path))
    expect(schema.validate(root), f"{path}: {schema.error_log}")
    for parameter in root.iter("{*}Parameter"):
        variable = variables.get(parameter.get("name"))
        kind = etree.QName(parameter[0]).localname
        fits = variable and variable.causality == "parameter" and variable.type == kind
        expect(fits, f"{path}: {parameter.get('name')} is no parameter of type {kind}")


def main(fmu):
    description = fmpy.read_model_description(fmu)
    variables = {v.name: v for v in description.modelVariables}
    with zipfile.ZipFile(fmu) as archive:
        related = manifest(archive)
        roles = list(related.values())
        expect(roles.count("experiment/smoke-test") == 1, f"the roles are {roles}")
        for path, role in related.items():
            if role.startswith("experiment"):
                experiments(archive, path, variables)
            elif role == "parameter":
                parameter_set(archive, path, variables)
    print("\n".join(problems) or "Conforms.")


main(sys.argv[1])

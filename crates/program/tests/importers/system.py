"""A system with the rotor as its only component, as an .ssp file (System Structure and
Parameterization 1.0)."""

import zipfile
from pathlib import Path
from xml.sax.saxutils import quoteattr

SSD = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription name="System" version="1.0"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="root">
    {connector}
    <ssd:Elements>
      <ssd:Component name="rotor" type="application/x-fmu-sharedlibrary"
          source="resources/HelicopterRotor.fmu" implementation="CoSimulation">
        <ssd:Connectors>
          <ssd:Connector name="thrust" kind="output"><ssc:Real/></ssd:Connector>
        </ssd:Connectors>
        <ssd:ParameterBindings>
          <ssd:ParameterBinding>
            <ssd:ParameterValues>
              <ssv:ParameterSet name="start" version="1.0">
                <ssv:Parameters>{parameters}</ssv:Parameters>
              </ssv:ParameterSet>
            </ssd:ParameterValues>
          </ssd:ParameterBinding>
        </ssd:ParameterBindings>
      </ssd:Component>
    </ssd:Elements>
    {connection}
  </ssd:System>
  <ssd:DefaultExperiment startTime="0" stopTime="1"/>
</ssd:SystemStructureDescription>
"""
CONNECTOR = """<ssd:Connectors>
      <ssd:Connector name="thrust" kind="output"><ssc:Real/></ssd:Connector>
    </ssd:Connectors>"""
CONNECTION = """<ssd:Connections>
      <ssd:Connection startElement="rotor" startConnector="thrust" endConnector="thrust"/>
    </ssd:Connections>"""


def write(fmu, variables, folder, connector=True):
    """Writes the file into a folder and returns its path. With `connector` the thrust is an output
    of the system, too."""
    parameters = "".join(
        f"<ssv:Parameter name={quoteattr(v.name)}><ssv:{v.kind} value={quoteattr(as_text(v))}/>"
        "</ssv:Parameter>"
        for v in variables
    )
    text = SSD.format(
        parameters=parameters,
        connector=CONNECTOR if connector else "",
        connection=CONNECTION if connector else "",
    )
    file = Path(folder) / "system.ssp"
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("SystemStructure.ssd", text)
        archive.write(fmu, "resources/HelicopterRotor.fmu")
    return str(file)


def as_text(variable):
    return str(variable.value).lower() if variable.kind == "Boolean" else str(variable.value)


def unpacked(file):
    """Unpacks the file beside itself and returns the path of the folder."""
    folder = Path(file).parent / "system"
    with zipfile.ZipFile(file) as archive:
        archive.extractall(folder)
    return str(folder)

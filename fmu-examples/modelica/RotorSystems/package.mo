package RotorSystems "Systems that contain HelicopterRotor.fmu"
  extends Modelica.Icons.Package;
  annotation (
    version="1.0.0",
    uses(Modelica(version="4.0.0")),
    Documentation(info="<html>
<p>A block around HelicopterRotor.fmu for MultiBody systems, and a test model. Import the FMU first; README.md beside this
file says how, and what was run by which tool.</p>
</html>"));
end RotorSystems;

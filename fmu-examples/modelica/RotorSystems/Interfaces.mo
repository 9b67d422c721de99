within RotorSystems;
package Interfaces "What is alike in all tools"
  extends Modelica.Icons.InterfacesPackage;

  partial block RotorSignals "Inputs and outputs of the FMU that a system needs, under the FMU's names"
    extends Modelica.Blocks.Icons.Block;
    parameter String settings="" "Parameters of the rotor: name = value; name = value";
    Modelica.Blocks.Interfaces.RealInput collective(unit="rad");
    Modelica.Blocks.Interfaces.RealInput cyclicLongitudinal(unit="rad");
    Modelica.Blocks.Interfaces.RealInput cyclicLateral(unit="rad");
    Modelica.Blocks.Interfaces.RealInput rpm(unit="rev/min");
    Modelica.Blocks.Interfaces.RealInput tilt(unit="rad");
    Modelica.Blocks.Interfaces.RealInput lateralTilt(unit="rad");
    Modelica.Blocks.Interfaces.RealInput velocity[3](each unit="m/s");
    Modelica.Blocks.Interfaces.RealInput angularVelocity[3](each unit="rad/s");
    Modelica.Blocks.Interfaces.RealInput wind[3](each unit="m/s");
    Modelica.Blocks.Interfaces.RealInput altitude(unit="m");
    Modelica.Blocks.Interfaces.RealInput heightAboveGround(unit="m");
    Modelica.Blocks.Interfaces.RealOutput hubForce[3](each unit="N");
    Modelica.Blocks.Interfaces.RealOutput hubMoment[3](each unit="N.m");
    Modelica.Blocks.Interfaces.RealOutput power(unit="W");
  end RotorSignals;
end Interfaces;

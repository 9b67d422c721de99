within RotorSystems;
package Imported "The imported FMU, by the names that tools give it"
  extends Modelica.Icons.Package;

  block OpenModelica "As OpenModelica imports it, for Model Exchange: each of . [ ] in a name becomes an underscore"
    extends Interfaces.RotorSignals;
    HelicopterRotor_me_FMU fmu(settings=settings);
  equation
    connect(collective, fmu.collective);
    connect(cyclicLongitudinal, fmu.cyclicLongitudinal);
    connect(cyclicLateral, fmu.cyclicLateral);
    connect(rpm, fmu.rpm);
    connect(tilt, fmu.tilt);
    connect(lateralTilt, fmu.lateralTilt);
    connect(velocity[1], fmu.velocity_1_);
    connect(velocity[2], fmu.velocity_2_);
    connect(velocity[3], fmu.velocity_3_);
    connect(angularVelocity[1], fmu.angularVelocity_1_);
    connect(angularVelocity[2], fmu.angularVelocity_2_);
    connect(angularVelocity[3], fmu.angularVelocity_3_);
    connect(wind[1], fmu.wind_1_);
    connect(wind[2], fmu.wind_2_);
    connect(wind[3], fmu.wind_3_);
    connect(altitude, fmu.altitude);
    connect(heightAboveGround, fmu.heightAboveGround);
    connect(fmu.hubForce_1_, hubForce[1]);
    connect(fmu.hubForce_2_, hubForce[2]);
    connect(fmu.hubForce_3_, hubForce[3]);
    connect(fmu.hubMoment_1_, hubMoment[1]);
    connect(fmu.hubMoment_2_, hubMoment[2]);
    connect(fmu.hubMoment_3_, hubMoment[3]);
    connect(fmu.power, power);
    // The rotor's speed is given, so that no torque drives it.
    fmu.driveTorque = 0;
  end OpenModelica;

  block Structured "As tools import it that keep the names, with arrays, such as System Modeler"
    extends Interfaces.RotorSignals;
    HelicopterRotor fmu(settings=settings) "Of the class that the tool has made; change its name here if it is another";
  equation
    connect(collective, fmu.collective);
    connect(cyclicLongitudinal, fmu.cyclicLongitudinal);
    connect(cyclicLateral, fmu.cyclicLateral);
    connect(rpm, fmu.rpm);
    connect(tilt, fmu.tilt);
    connect(lateralTilt, fmu.lateralTilt);
    connect(velocity, fmu.velocity);
    connect(angularVelocity, fmu.angularVelocity);
    connect(wind, fmu.wind);
    connect(altitude, fmu.altitude);
    connect(heightAboveGround, fmu.heightAboveGround);
    connect(fmu.hubForce, hubForce);
    connect(fmu.hubMoment, hubMoment);
    connect(fmu.power, power);
    fmu.driveTorque = 0;
  end Structured;

  block StandIn "No FMU: the default rotor near hover, to check a system before the FMU is in it"
    extends Interfaces.RotorSignals;
    constant Real thrust=66.0267 "N, at the trim";
    constant Real byCollective=664.214 "N/rad";
    constant Real byClimb=-6.36469 "N/(m/s)";
    constant Real trim=0.14 "rad, of collective";
  equation
    hubForce = {0, 0, thrust + byCollective*(collective - trim) + byClimb*velocity[3]};
    hubMoment = {0, 0, 0};
    power = 0;
    annotation (Documentation(info="<html>
<p>Thrust of HelicopterRotor.fmu with its defaults at 960 rev/min in hover, and its derivatives there, by
<code>check.py</code>. All else is left out: no moment, no power, no force in the disc.</p>
</html>"));
  end StandIn;
end Imported;

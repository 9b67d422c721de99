within RotorSystems;
model Rotor "A rotor on a frame: the FMU with the frame's motion as its input, and its loads on the frame"
  replaceable model Fmu = Imported.OpenModelica constrainedby Interfaces.RotorSignals
    "The imported FMU, by the tool that has imported it"
    annotation (choicesAllMatching=true);
  parameter Modelica.Units.SI.Length groundHeight=0 "Height of the ground in the world, along z";
  parameter Modelica.Units.SI.Length altitudeOfWorld=0 "Altitude above sea level of the world's origin";
  parameter Modelica.Units.SI.Velocity wind[3]={0, 0, 0} "Velocity of the air, resolved in the world";
  Modelica.Mechanics.MultiBody.Interfaces.Frame_a hub
    "The hub, which does not turn with the blades: x forward, y to the left, z up along the shaft"
    annotation (Placement(transformation(extent={{-16,-116},{16,-84}}, rotation=90)));
  Modelica.Blocks.Interfaces.RealInput collective(unit="rad") "Blade pitch"
    annotation (Placement(transformation(extent={{-140,40},{-100,80}})));
  Modelica.Blocks.Interfaces.RealInput cyclicLongitudinal(unit="rad") "Tilts the tip path forward"
    annotation (Placement(transformation(extent={{-140,-10},{-100,30}})));
  Modelica.Blocks.Interfaces.RealInput cyclicLateral(unit="rad") "Tilts the tip path down at psi = 90 deg"
    annotation (Placement(transformation(extent={{-140,-50},{-100,-10}})));
  Modelica.Blocks.Interfaces.RealInput rpm(unit="rev/min") "Rotor speed"
    annotation (Placement(transformation(extent={{-140,-100},{-100,-60}})));
  Modelica.Blocks.Interfaces.RealOutput power(unit="W") "Power that the rotor absorbs"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  Fmu fmu annotation (Placement(transformation(extent={{-20,-20},{20,20}})));
  Attitude attitude "Angles and motion of the hub"
    annotation (Placement(transformation(extent={{-70,-70},{-50,-50}})));
protected
  outer Modelica.Mechanics.MultiBody.World world;
  Modelica.Units.SI.Acceleration gravity[3]=world.gravityAcceleration(hub.r_0);
equation
  attitude.T = hub.R.T;
  attitude.worldVelocity = der(hub.r_0);
  attitude.worldAngularVelocity = Modelica.Mechanics.MultiBody.Frames.angularVelocity1(hub.R);
  attitude.worldWind = wind;
  fmu.tilt = attitude.tilt;
  fmu.lateralTilt = attitude.lateralTilt;
  fmu.velocity = attitude.velocity;
  fmu.angularVelocity = attitude.angularVelocity;
  fmu.wind = attitude.wind;
  fmu.altitude = altitudeOfWorld + hub.r_0[3];
  fmu.heightAboveGround = max(hub.r_0[3] - groundHeight, 0);
  connect(collective, fmu.collective);
  connect(cyclicLongitudinal, fmu.cyclicLongitudinal);
  connect(cyclicLateral, fmu.cyclicLateral);
  connect(rpm, fmu.rpm);
  connect(fmu.power, power);
  // The frame carries what the rotor exerts on the hub; both are resolved in the hub's axes.
  hub.f = -fmu.hubForce;
  hub.t = -fmu.hubMoment;
  assert(gravity[3] <= 0 and abs(gravity[1]) + abs(gravity[2]) <= 1e-6*abs(gravity[3]),
    "Gravity must act against z, which is up for the rotor: set n = {0, 0, -1} in the world");
  annotation (
    Icon(graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={28,39,51}, fillColor={244,246,248}, fillPattern=FillPattern.Solid, radius=12),
      Line(points={{0,-84},{0,36}}, color={28,39,51}, thickness=1),
      Ellipse(extent={{-86,54},{86,18}}, lineColor={11,98,214}, fillColor={220,235,250}, fillPattern=FillPattern.Solid),
      Polygon(points={{-86,42},{-4,38},{-4,34},{-86,36}}, lineColor={28,39,51}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Polygon(points={{86,36},{4,34},{4,38},{86,42}}, lineColor={28,39,51}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Ellipse(extent={{-7,43},{7,29}}, lineColor={28,39,51}, fillColor={28,39,51}, fillPattern=FillPattern.Solid),
      Line(points={{0,44},{0,88}}, color={217,72,15}, thickness=1, arrow={Arrow.None,Arrow.Filled}),
      Text(extent={{-100,-102},{100,-140}}, textString="%name", textColor={0,0,255})}),
    Documentation(info="<html>
<p>A rotor on a MultiBody frame. The motion of <code>hub</code> is the FMU's input, and the FMU's force and moment act on
it: connect it to the body that carries the rotor, through a <code>FixedTranslation</code> or <code>FixedRotation</code>
where the shaft stands. The frame does not turn with the blades; x is forward, y to the left, z up along the shaft.</p>
<p>Set <code>n = {0, 0, -1}</code> in the world, so that z is up. <code>Fmu</code> is the block that your tool has made of
HelicopterRotor.fmu, wrapped in a block of <code>Imported</code>. Parameters of the rotor are set in its string
<code>settings</code>, for example <code>rotor(fmu(settings = \"models.inflow = pittPetersDynamic; flapping.enabled =
true\"))</code>.</p>
<p>The FMU's ground frame has no heading. Here it turns about z with the heading of the hub, so that the hub's axes are
those of the FMU's hub frame, and loads are taken over without being turned.</p>
</html>"));
end Rotor;

within RotorSystems;
package Examples "Systems to start from"
  extends Modelica.Icons.ExamplesPackage;

  partial model PartialClimb "A disc with the rotor climbs 2.5 m and holds the height; a PID controller moves the collective"
    replaceable model Fmu = Imported.StandIn constrainedby Interfaces.RotorSignals
      annotation (choicesAllMatching=true);
    parameter Modelica.Units.SI.Length height=2.5 "Height that the disc is to reach";
    parameter Modelica.Units.SI.Mass mass=66.0267/Modelica.Constants.g_n "Carried at a collective of 0.14 rad";
    inner Modelica.Mechanics.MultiBody.World world(n={0, 0, -1})
      annotation (Placement(transformation(extent={{-80,-80},{-60,-60}})));
    Modelica.Mechanics.MultiBody.Joints.Prismatic guide(
      n={0, 0, 1},
      useAxisFlange=false,
      s(start=0, fixed=true),
      v(start=0, fixed=true))
      annotation (Placement(transformation(extent={{-40,-80},{-20,-60}})));
    Modelica.Mechanics.MultiBody.Parts.Body disc(m=mass, r_CM={0, 0, 0}, I_33=0.1)
      annotation (Placement(transformation(extent={{20,-80},{40,-60}})));
    Rotor rotor(redeclare model Fmu = Fmu)
      annotation (Placement(transformation(extent={{20,-20},{60,20}})));
    Modelica.Blocks.Continuous.LimPID controller(
      k=0.05,
      Ti=2.5,
      Td=0.6,
      wp=0.6,
      wd=0,
      yMax=0.1043461,
      yMin=-0.1050934,
      initType=Modelica.Blocks.Types.Init.InitialState)
      annotation (Placement(transformation(extent={{-70,30},{-50,50}})));
    Modelica.Blocks.Math.Add collective annotation (Placement(transformation(extent={{-30,24},{-10,44}})));
    Modelica.Blocks.Sources.Constant trim(k=0.14)
      annotation (Placement(transformation(extent={{-70,-8},{-50,12}})));
    Modelica.Blocks.Sources.Constant wanted(k=height)
      annotation (Placement(transformation(extent={{-100,30},{-80,50}})));
    Modelica.Blocks.Sources.RealExpression measured(y=guide.s)
      annotation (Placement(transformation(extent={{-100,8},{-80,28}})));
    Modelica.Blocks.Sources.Constant none(k=0)
      annotation (Placement(transformation(extent={{-20,-10},{0,10}})));
    Modelica.Blocks.Sources.Constant rpm(k=960)
      annotation (Placement(transformation(extent={{-20,-44},{0,-24}})));
  equation
    connect(world.frame_b, guide.frame_a);
    connect(guide.frame_b, disc.frame_a);
    connect(guide.frame_b, rotor.hub);
    connect(wanted.y, controller.u_s);
    connect(measured.y, controller.u_m);
    connect(controller.y, collective.u1);
    connect(trim.y, collective.u2);
    connect(collective.y, rotor.collective);
    connect(none.y, rotor.cyclicLongitudinal);
    connect(none.y, rotor.cyclicLateral);
    connect(rpm.y, rotor.rpm);
    annotation (Documentation(info="<html>
<p>The system of <code>climbing_disc/climb.py</code> with the FMU's default models; for those of <code>climb.py</code> set
<code>rotor(fmu(settings = \"models.inflow = pittPetersDynamic; flapping.enabled = true\"))</code>. It begins at
a collective of 0.14 rad, <code>climb.py</code> at 8 deg. The height <code>guide.s</code> reaches 2.5 m and stays. The
guide carries the rotor's torque.</p>
</html>"));
  end PartialClimb;

  model Climb "With the FMU as OpenModelica imports it"
    extends Modelica.Icons.Example;
    extends PartialClimb(redeclare model Fmu = Imported.OpenModelica);
    annotation (experiment(StopTime=8, Interval=0.01, Tolerance=1e-6));
  end Climb;

  model ClimbStructured "With the FMU as tools import it that keep its names"
    extends Modelica.Icons.Example;
    extends PartialClimb(redeclare model Fmu = Imported.Structured);
    annotation (experiment(StopTime=8, Interval=0.01, Tolerance=1e-6));
  end ClimbStructured;

  model ClimbWithoutFmu "With the stand-in for the FMU"
    extends Modelica.Icons.Example;
    extends PartialClimb(redeclare model Fmu = Imported.StandIn);
    annotation (experiment(StopTime=8, Interval=0.01, Tolerance=1e-6));
  end ClimbWithoutFmu;
end Examples;

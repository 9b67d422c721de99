within RotorSystems;
block Attitude "Tilt of the hub, and its motion in a ground frame that turns with its heading"
  input Real T[3, 3] "Turns vectors from the world to the hub";
  input Real worldVelocity[3](each unit="m/s") "Velocity of the hub, in the world";
  input Real worldAngularVelocity[3](each unit="rad/s") "Angular velocity of the hub, in the world";
  input Real worldWind[3](each unit="m/s") "Velocity of the air, in the world";
  output Real heading(unit="rad") "Of x, from the world's x to the left";
  output Real tilt(unit="rad") "About y, after the heading; positive tilts the thrust forward";
  output Real lateralTilt(unit="rad") "About x, after the tilt; positive tilts the thrust to the right";
  output Real velocity[3](each unit="m/s");
  output Real angularVelocity[3](each unit="rad/s");
  output Real wind[3](each unit="m/s");
protected
  Real G[3, 3] "Turns vectors from the world to the ground frame with the hub's heading";
equation
  // T = Rx(lateralTilt) Ry(tilt) Rz(heading)
  heading = atan2(T[1, 2], T[1, 1]);
  tilt = asin(max(-1, min(1, -T[1, 3])));
  lateralTilt = atan2(T[2, 3], T[3, 3]);
  G = [cos(heading), sin(heading), 0; -sin(heading), cos(heading), 0; 0, 0, 1];
  velocity = G*worldVelocity;
  angularVelocity = G*worldAngularVelocity;
  wind = G*worldWind;
  annotation (
    Icon(graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,0,127}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90,40},{90,-40}}, textString="z y x", textColor={0,0,127})}),
    Documentation(info="<html>
<p>Heading, tilt and lateral tilt are the angles of the sequence z, y, x. At a tilt of 90 degrees heading and lateral tilt
cannot be told apart.</p>
</html>"));
end Attitude;

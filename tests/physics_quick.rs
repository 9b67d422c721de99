use helicopter_rotor::rotor::*;
use std::path::Path;
#[test]
fn kh(){
  let res=Path::new("modelDescription/resources");
  for count in [20usize,40,80,160,400] { for n in [0.0,0.2] {
  let mut e=vec![];
  for l in std::fs::read_to_string("tests/data/knight-hefner-1937-tn626-hover.csv").unwrap().lines().filter(|l|!l.starts_with('#')).skip(1){
    let v:Vec<f64>=l.split(',').map(|x|x.parse().unwrap()).collect();
    let g=geometry::Geometry::read(&res.join(format!("rotors/knight-hefner-{}.toml",v[0]))).unwrap();
    let a=g.airfoils.iter().map(|f|airfoil::Airfoil::read(&res.join(f)).unwrap()).collect();
    let m=Models{inflow:inflow::Inflow::Annulus,tip_loss:tip_loss::TipLoss::Prandtl,section:airfoil::SectionModel{lift:airfoil::Lift::Table,compressibility:compressibility::Compressibility::PrandtlGlauert,drag_reynolds_exponent:n}};
    let mut r=Rotor::new(g,a,m,count);
    let om=960.0*std::f64::consts::PI/30.0;
    let air=air::Air::new(1.164,303.15);
    let p=r.axial(&Operation{collective:v[2].to_radians(),speed:om,climb:0.0,air}).unwrap();
    let q=1.164*std::f64::consts::PI*0.762f64.powi(2)*(om*0.762).powi(2);
    let (ct,cq)=(p.thrust/q,p.torque/q/0.762);
    if count==40 && n==0.2 {println!("{} {:4} CT {:.6} {:.6} {:6.1}%  CQ {:.6} {:.6} {:6.1}%  {} {}",v[0],v[2],ct,v[5],100.*(ct/v[5]-1.),cq,v[6],100.*(cq/v[6]-1.), p.stalled_radius, p.induced_velocity);}
    if v[2]>=4.0 { e.push((100.*(ct/v[5]-1.),100.*(cq/v[6]-1.))); }
  }
  let m=|f:fn(&(f64,f64))->f64| e.iter().map(f).sum::<f64>()/e.len() as f64;
  println!("{count} n={n} mean |dCT| {:.2} |dCQ| {:.2} bias {:.2} {:.2} worst {:.1} {:.1}",m(|x|x.0.abs()),m(|x|x.1.abs()),m(|x|x.0),m(|x|x.1), e.iter().map(|x|x.0.abs()).fold(0.,f64::max), e.iter().map(|x|x.1.abs()).fold(0.,f64::max));
  }}
}

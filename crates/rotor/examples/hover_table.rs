//! Prints thrust, torque and figure of merit of a rotor in hover against its collective:
//!
//!     cargo run --release -p rotor --example hover_table

use rotor::{
    Models, OperatingPoint, Rotor,
    air::Air,
    airfoil::Airfoil,
    geometry::{Elements, Geometry},
};
use std::{error::Error, f64::consts::PI, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    // Four blades, R = 0.762 m, root cutout R/6, chord 50.8 mm, no taper, no twist: Knight & Hefner
    // 1937.
    let geometry = Geometry::linear(4, 0.762, 1.0 / 6.0, 0.0508, 1.0, 0.0);
    geometry.check()?;
    let elements = Elements::new(&geometry, 40);
    let airfoils = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../modelDescription/resources/airfoils/naca0015-knight-hefner.polar");
    let airfoil = Airfoil::read(&airfoils)?;
    let rotor = Rotor::new(geometry, elements, vec![airfoil], Models::default());

    let (air, speed, radius) = (Air::standard(0.0), 960.0 * PI / 30.0, 0.762);
    println!("collective, deg   thrust, N   torque, N.m   figure of merit");
    for degrees in (0..=14).step_by(2) {
        let point = OperatingPoint::hover(f64::from(degrees).to_radians(), speed, air);
        let hub = rotor.steady(&point)?;
        let induced_power =
            hub.force.z * (hub.force.z / (2.0 * air.density * PI * radius * radius)).sqrt();
        let merit = induced_power / (hub.torque * speed);
        println!(
            "{degrees:15}{:12.2}{:14.3}{merit:18.3}",
            hub.force.z, hub.torque
        );
    }
    Ok(())
}

//! Rotor files: any text is an error of limited length, or a rotor whose loads in hover and in
//! forward flight are finite or an error.

#![no_main]

use fuzz::{finite, promise};
use libfuzzer_sys::fuzz_target;
use rotor::{
    Models, OperatingPoint, Rotor, Workspace,
    air::Air,
    airfoil::Airfoil,
    geometry::{Elements, Geometry},
};
use std::{path::Path, sync::OnceLock};

fn airfoil() -> &'static Airfoil {
    static AIRFOIL: OnceLock<Airfoil> = OnceLock::new();
    AIRFOIL.get_or_init(|| {
        let text =
            "polar 1\nreynolds 1e5\n-180 0 0.03\n-10 -1 0.03\n0 0 0.01\n10 1 0.03\n180 0 0.03\n";
        Airfoil::from_text(text, Path::new("a.polar")).unwrap()
    })
}

fuzz_target!(|text: &str| {
    let geometry = match Geometry::from_text(text, Path::new("r.toml")) {
        Ok(geometry) => geometry,
        Err(error) => {
            let message = error.to_string();
            promise(message.chars().count() <= 500, || message.clone());
            return;
        }
    };
    finite(&[geometry.solidity(), geometry.cutout(), geometry.tip_chord]);
    let airfoils = vec![airfoil().clone(); geometry.airfoils.len()];
    let elements = Elements::new(&geometry, 8);
    let rotor = Rotor::new(geometry, elements, airfoils, Models::default());
    let mut workspace = Workspace::new(&rotor);
    let mut point = OperatingPoint::hover(0.14, 100.0, Air::standard(0.0));
    for speed in [0.0, 30.0] {
        point.airspeed.x = speed;
        if let Ok(response) = rotor.respond(&point, &Default::default(), &mut workspace) {
            let hub = &response.hub;
            finite(&[hub.force.x, hub.force.y, hub.force.z, hub.moment.z]);
        }
    }
});

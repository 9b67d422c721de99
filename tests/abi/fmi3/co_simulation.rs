//! Steps, and derivatives of outputs in time.

use crate::support::{Instance, Instance3, c, instance::reference, instance3::variable};
use helicopter_rotor::block::variables::REALS;

#[test]
fn a_step_at_another_time_or_past_the_end_is_refused() {
    let instance = Instance3::new();
    let enter = instance.functions.fmi3EnterInitializationMode;
    // SAFETY: the instance lives.
    unsafe {
        let nan = f64::NAN;
        assert!(
            instance
                .refused(enter(instance.pointer, 0, 0.0, nan, 0, 0.0))
                .contains("startTime")
        );
        let before = instance.refused(enter(instance.pointer, 0, 0.0, 1.0, 1, 0.5));
        assert!(before.contains("stopTime"), "{before}");
        instance.ok(enter(instance.pointer, 1, 1e-6, 1.0, 1, 1.1));
    }
    instance.exit_initialization();
    instance.take_log();
    for (time, size, part) in [
        (0.0, 0.01, "continue from there"),
        (1.0, 0.0, "positive"),
        (1.0, -0.01, "positive"),
        (1.0, 0.2, "stopTime"),
        (1.0, f64::NAN, "positive"),
    ] {
        let (status, _) = instance.step_with(time, size, None);
        let message = instance.refused(status);
        assert!(message.contains(part), "{message}");
    }
    assert_eq!(instance.step(1.0, 0.1).time, 1.1);
}

#[test]
fn derivatives_of_outputs_are_those_of_fmi_2_and_those_of_arrays_are_whole() {
    let (two, three) = (Instance::new(), Instance3::new());
    assert_eq!(two.set_integer("models.inflow", 12), c::OK);
    three.ok(three.choose("models.inflow", 12));
    assert_eq!(two.set_real("velocity[1]", 9.0), c::OK);
    three.ok(three.set_floats(&["velocity"], &[9.0, 0.0, 0.0]));
    two.initialize();
    three.initialize();
    assert_eq!(two.set_real("collective", 0.18), c::OK);
    three.set("collective", 0.18);
    assert_eq!(two.step(0.0, 0.01), c::OK);
    three.step(0.0, 0.01);
    let names = ["force[1]", "force[2]", "force[3]", "thrust"].map(|n| reference(&REALS, n));
    let mut expected = [0.0; 4];
    assert_eq!(
        two.output_derivatives(&names, &[1; 4], &mut expected),
        c::OK
    );
    let references = ["force", "thrust"].map(|name| variable(name).reference);
    let mut rates = [0.0; 4];
    let get = three.functions.fmi3GetOutputDerivatives;
    let (p, r, x) = (three.pointer, references.as_ptr(), rates.as_mut_ptr());
    // SAFETY: the pointers are valid for the counts.
    unsafe {
        three.ok(get(p, r, 2, [1, 1].as_ptr(), x, 4));
        assert_eq!(rates, expected);
        for wrong in [2, 3, 5] {
            assert!(
                three
                    .refused(get(p, r, 2, [1, 1].as_ptr(), x, wrong))
                    .contains("4 elements")
            );
        }
        for order in [0, 2, -1] {
            let message = three.refused(get(p, r, 1, &order, x, 3));
            assert!(message.contains(&format!("order = {order}")), "{message}");
        }
    }
}

//! The capability flags of modelDescription.xml, each against what the library does.

use crate::support::{Creation, Fmu, Instance, c, instance::reference};
use helicopter_rotor::block::variables::REALS;
use roxmltree::Document;

fn created(kind: i32) -> Instance<'static> {
    let creation = Creation {
        kind,
        ..Creation::default()
    };
    Instance::create(Fmu::shared(), &creation).unwrap()
}

/// Whether a call is carried out; if not, it must be refused with the flag's name.
fn is_offered(instance: &Instance, status: c::Status, flag: &str) -> bool {
    if status == c::OK {
        return true;
    }
    let message = instance.refused(status);
    assert!(message.contains(flag), "{message}");
    false
}

#[test]
fn the_flags_of_both_interfaces_say_what_the_library_does() {
    let text = Fmu::shared().description();
    let description = Document::parse(&text).unwrap();
    for (kind, name) in [
        (c::MODEL_EXCHANGE, "ModelExchange"),
        (c::CO_SIMULATION, "CoSimulation"),
    ] {
        let mut elements = description.descendants();
        let said = elements.find(|node| node.has_tag_name(name)).unwrap();
        let check = |flag: &str, is: bool| {
            let is = is.to_string();
            assert_eq!(said.attribute(flag), Some(is.as_str()), "{flag}");
        };
        // Two at the same time, without memory functions (see `support::instance::callbacks`).
        let (instance, other) = (created(kind), created(kind));
        check("canBeInstantiatedOnlyOncePerProcess", false);
        check("canNotUseMemoryManagementFunctions", true);
        check("needsExecutionTool", false);
        instance.initialize();
        other.initialize();
        let thrust = instance.real("thrust");

        // A state that is set brings everything back, also by way of bytes.
        let mut pointer = std::ptr::null_mut();
        let status = instance.get_state(&mut pointer);
        let has_state = is_offered(&instance, status, "canGetAndSetFMUstate");
        check("canGetAndSetFMUstate", has_state);
        let (f, component) = (instance.functions, instance.component);
        // SAFETY: the instance lives, and the state lives or is null.
        unsafe { (f.fmi2FreeFMUstate)(component, &mut pointer) };
        let state = instance.state();
        let bytes = state.serialize();
        check("canSerializeFMUstate", bytes.len() > 1000);
        let again = instance.deserialize(&bytes).unwrap();
        for state in [&state, &again] {
            assert_eq!(instance.reset(), c::OK);
            assert_eq!(instance.set_state(state), c::OK);
            assert_eq!(instance.real("thrust"), thrust);
        }

        let thrust_reference = reference(&REALS, "thrust");
        let (first, one, mut answer) = (0, 1.0, 0.0);
        // SAFETY: the instance lives, and the pointers have one element.
        let status = unsafe {
            (f.fmi2GetDirectionalDerivative)(
                component,
                &thrust_reference,
                1,
                &first,
                1,
                &one,
                &mut answer,
            )
        };
        let is = is_offered(&instance, status, "providesDirectionalDerivative");
        check("providesDirectionalDerivative", is);
        if kind == c::MODEL_EXCHANGE {
            check(
                "completedIntegratorStepNotNeeded",
                completed_step_is_not_needed(),
            );
            continue;
        }

        check("canHandleVariableCommunicationStepSize", true);
        check("canRunAsynchronuously", false);
        let steps = [0.01, 0.003, 0.02];
        let mut time = 0.0;
        for size in steps {
            assert_eq!(instance.step(time, size), c::OK);
            time += size;
            assert_eq!(instance.last_time(), time);
            assert_eq!(other.step(time - size, size), c::OK);
        }
        assert_eq!(instance.set_slope("collective", 0.5), c::OK);
        for instance in [&instance, &other] {
            assert_eq!(instance.step(time, 0.01), c::OK);
        }
        let has_effect = instance.real("thrust") != other.real("thrust");
        check("canInterpolateInputs", has_effect);
        let (order, mut slope) = (1, 0.0);
        // SAFETY: the instance lives, and the pointers have one element.
        let status = unsafe {
            (f.fmi2GetRealOutputDerivatives)(component, &thrust_reference, 1, &order, &mut slope)
        };
        let is = is_offered(&instance, status, "maxOutputDerivativeOrder");
        let orders = said.attribute("maxOutputDerivativeOrder");
        assert_eq!(orders, Some(if is { "1" } else { "0" }));
    }
}

/// Whether the importer may leave fmi2CompletedIntegratorStep out: not if it ever asks for an
/// event.
fn completed_step_is_not_needed() -> bool {
    let instance = created(c::MODEL_EXCHANGE);
    instance.begin_integration();
    assert_eq!(instance.set_real("velocity[3]", -30.0), c::OK);
    !instance.completed_step()
}

//! Arrays, and numbers of values that do not fit them.

use crate::support::{
    Instance3,
    c::{self, Reference},
    instance3::{variable, variables},
};
use std::{ffi::CStr, ptr};

#[test]
fn arrays_are_set_and_read_whole() {
    let instance = Instance3::new();
    instance.ok(instance.set_floats(
        &["wind", "collective", "velocity"],
        &[1.0, 2.0, 3.0, 0.1, 4.0, 5.0, 6.0],
    ));
    assert_eq!(instance.floats("wind"), [1.0, 2.0, 3.0]);
    assert_eq!(instance.floats("velocity"), [4.0, 5.0, 6.0]);
    assert_eq!(instance.float("collective"), 0.1);
    instance.initialize();
    assert_eq!(instance.floats("station.radius").len(), 20);
    assert_eq!(instance.floats("force")[2], instance.float("thrust"));
}

/// The numbers of values that are next to the right one, for one array, for several variables, and
/// for none.
#[test]
fn short_and_wrong_numbers_of_values_are_refused_and_nothing_is_touched() {
    let instance = Instance3::new();
    for (names, right) in [
        (vec!["velocity"], 3_usize),
        (vec!["collective", "wind"], 4),
        (vec!["station.mach", "thrust"], 21),
        (vec![], 0),
    ] {
        for wrong in [
            0,
            1,
            right.max(1) - 1,
            right + 1,
            right * 2,
            usize::MAX / 16,
        ] {
            if wrong == right {
                continue;
            }
            let references: Vec<Reference> = names.iter().map(|n| variable(n).reference).collect();
            let mut place = [7.0; 64];
            let get = instance.functions.fmi3GetFloat64;
            let (r, n) = (references.as_ptr(), references.len());
            // SAFETY: the library must not touch more than the variables have, which is less than
            // 64.
            let status = unsafe { get(instance.pointer, r, n, place.as_mut_ptr(), wrong) };
            let message = instance.refused(status);
            let given = format!("nValues = {wrong}");
            assert!(message.contains(&given), "{given}: {message}");
            assert!(message.contains(&format!("{right} elements")), "{message}");
            assert_eq!(place, [7.0; 64]);
        }
    }
    for wrong in [0, 2, 4] {
        let status = instance.set_floats(&["velocity"], &vec![9.0; wrong]);
        assert!(instance.refused(status).contains("3 elements"));
        assert_eq!(instance.floats("velocity"), [0.0; 3]);
    }
}

#[test]
fn wrong_numbers_are_refused_by_every_function_that_takes_one() {
    let instance = Instance3::for_model_exchange();
    instance.initialize();
    let (f, p) = (instance.functions, instance.pointer);
    let one = |name: &str| variable(name).reference;
    let (force, velocity, blades) = (
        one("force"),
        one("velocity"),
        one("geometry.numberOfBlades"),
    );
    let (inflow, flaps, file) = (
        one("models.inflow"),
        one("flapping.enabled"),
        one("settings"),
    );
    let mut x = [7.0; 99];
    let x = x.as_mut_ptr();
    let (mut i, mut l, mut b, mut t) = (7, 7, 7, ptr::null());
    let seeds = [1.0; 8];
    let s = seeds.as_ptr();
    // SAFETY: the pointers are valid for more than the counts that are right.
    let statuses = unsafe {
        [
            (f.fmi3GetInt32)(p, &blades, 1, &mut i, 2),
            (f.fmi3GetInt64)(p, &inflow, 1, &mut l, 0),
            (f.fmi3GetBoolean)(p, &flaps, 1, &mut b, 3),
            (f.fmi3GetString)(p, &file, 1, &mut t, 2),
            (f.fmi3SetInt32)(p, &blades, 1, &4, 2),
            (f.fmi3SetInt64)(p, &inflow, 1, &2, 0),
            (f.fmi3SetBoolean)(p, &flaps, 1, &0, 2),
            (f.fmi3SetString)(p, &file, 1, &c"".as_ptr(), 0),
            (f.fmi3GetDirectionalDerivative)(p, &force, 1, &velocity, 1, s, 2, x, 3),
            (f.fmi3GetDirectionalDerivative)(p, &force, 1, &velocity, 1, s, 3, x, 1),
            (f.fmi3GetAdjointDerivative)(p, &force, 1, &velocity, 1, s, 1, x, 3),
            (f.fmi3GetAdjointDerivative)(p, &force, 1, &velocity, 1, s, 3, x, 4),
            (f.fmi3GetContinuousStates)(p, x, 41),
            (f.fmi3GetContinuousStateDerivatives)(p, x, 43),
            (f.fmi3GetNominalsOfContinuousStates)(p, x, 0),
            (f.fmi3GetEventIndicators)(p, x, 1),
            (f.fmi3GetVariableDependencies)(
                p,
                force,
                ptr::null_mut(),
                ptr::null_mut(),
                ptr::null_mut(),
                ptr::null_mut(),
                1,
            ),
        ]
    };
    assert!(
        statuses.iter().all(|status| *status == c::ERROR),
        "{statuses:?}"
    );
    let log = instance.take_log();
    assert_eq!(log.len(), statuses.len());
    for line in &log {
        let has_number = line.message.chars().any(|c| c.is_ascii_digit());
        assert!(has_number && line.message.contains("pass"), "{line:?}");
    }
    // SAFETY: the first elements of the buffer.
    assert!((0..8).all(|i| unsafe { *x.add(i) } == 7.0));
}

#[test]
fn variables_of_another_type_elements_of_arrays_and_unknown_ones_are_refused_by_name() {
    let instance = Instance3::new();
    let (f, p) = (instance.functions, instance.pointer);
    let (mut x, mut i, mut l) = (7.0, 7, 7);
    let (inflow, blades) = (
        variable("models.inflow").reference,
        variable("geometry.numberOfBlades").reference,
    );
    let second = variable("velocity").reference + 1;
    // SAFETY: the pointers are valid for one element.
    unsafe {
        let message = instance.refused((f.fmi3GetFloat64)(p, &inflow, 1, &mut x, 1));
        assert!(
            message.contains("models.inflow has the type Int64"),
            "{message}"
        );
        let message = instance.refused((f.fmi3GetInt32)(p, &inflow, 1, &mut i, 1));
        assert!(
            message.contains("models.inflow has the type Int64"),
            "{message}"
        );
        let message = instance.refused((f.fmi3GetInt64)(p, &blades, 1, &mut l, 1));
        assert!(
            message.contains("geometry.numberOfBlades has the type Int32"),
            "{message}"
        );
        for unknown in [second, 9_999, 19_999, 29_999, 39_999, 40_001, u32::MAX] {
            let message = instance.refused((f.fmi3GetFloat64)(p, &unknown, 1, &mut x, 1));
            assert!(message.contains(&unknown.to_string()), "{message}");
        }
        let time = variable("time").reference;
        let message = instance.refused((f.fmi3SetFloat64)(p, &time, 1, &1.0, 1));
        assert!(
            message.contains("time is the independent variable"),
            "{message}"
        );
        for value in [i64::from(i32::MAX) + 1, i64::MIN, 99, 0] {
            let message = instance.refused((f.fmi3SetInt64)(p, &inflow, 1, &value, 1));
            let expected = format!("models.inflow = {value} is not allowed");
            assert!(message.contains(&expected), "{message}");
        }
    }
    assert!(
        instance
            .refused(instance.set_boolean("flapping.enabled", 2))
            .contains("= 2")
    );
    assert_eq!((x, i, l), (7.0, 7, 7));
}

#[test]
fn null_pointers_are_refused_where_something_should_be_behind_them() {
    let instance = Instance3::new();
    let (f, p) = (instance.functions, instance.pointer);
    let (reference, mut x) = (variable("collective").reference, 7.0);
    // SAFETY: the pointers are null or valid for one element.
    let statuses = unsafe {
        [
            (f.fmi3GetFloat64)(p, ptr::null(), 1, &mut x, 1),
            (f.fmi3GetFloat64)(p, &reference, 1, ptr::null_mut(), 1),
            (f.fmi3SetFloat64)(p, ptr::null(), 1, &x, 1),
            (f.fmi3SetFloat64)(p, &reference, 1, ptr::null(), 1),
            (f.fmi3GetNumberOfVariableDependencies)(p, reference, ptr::null_mut()),
        ]
    };
    let log = instance.take_log();
    assert_eq!((statuses, log.len()), ([c::ERROR; 5], 5));
    assert!(log.iter().all(|line| line.message.contains("null pointer")));
    // SAFETY: no variables need no memory.
    instance.ok(unsafe { (f.fmi3GetFloat64)(p, ptr::null(), 0, ptr::null_mut(), 0) });
    instance.initialize();
    let (mut flag, mut time) = (0, 0.0);
    // SAFETY: null or valid for one element.
    let statuses = unsafe {
        let (b, t, none) = (&raw mut flag, &raw mut time, ptr::null_mut());
        [
            (f.fmi3DoStep)(p, 0.0, 0.1, 1, none, b, b, t),
            (f.fmi3DoStep)(p, 0.0, 0.1, 1, b, none, b, t),
            (f.fmi3DoStep)(p, 0.0, 0.1, 1, b, b, none, t),
            (f.fmi3DoStep)(p, 0.0, 0.1, 1, b, b, b, ptr::null_mut()),
        ]
    };
    assert_eq!((statuses, instance.take_log().len()), ([c::ERROR; 4], 4));
    // Nothing was done.
    instance.step(0.0, 0.1);
}

#[test]
fn every_variable_is_read_by_the_functions_of_its_type_and_has_its_start_value() {
    let instance = Instance3::new();
    let (f, p) = (instance.functions, instance.pointer);
    let mut count = 0;
    for v in variables().values() {
        let (r, n) = (&v.reference, v.count);
        let (mut x, mut i, mut l) = (vec![f64::NAN; n], vec![0; n], vec![0; n]);
        let (mut b, mut t) = (vec![9; n], vec![ptr::null(); n]);
        // SAFETY: the buffers have as many elements as the variable.
        let status = unsafe {
            match v.kind.as_str() {
                "Float64" => (f.fmi3GetFloat64)(p, r, 1, x.as_mut_ptr(), n),
                "Int32" => (f.fmi3GetInt32)(p, r, 1, i.as_mut_ptr(), n),
                "Enumeration" => (f.fmi3GetInt64)(p, r, 1, l.as_mut_ptr(), n),
                "Boolean" => (f.fmi3GetBoolean)(p, r, 1, b.as_mut_ptr(), n),
                "String" => (f.fmi3GetString)(p, r, 1, t.as_mut_ptr(), n),
                other => panic!("{other}"),
            }
        };
        instance.ok(status);
        // As text, with every digit.
        let values: Vec<String> = match v.kind.as_str() {
            "Float64" => x.iter().map(f64::to_string).collect(),
            "Int32" => i.iter().map(i32::to_string).collect(),
            "Enumeration" => l.iter().map(i64::to_string).collect(),
            "Boolean" => b.iter().map(|b| (*b == 1).to_string()).collect(),
            // SAFETY: the library's strings live until the next call.
            _ => unsafe { vec![CStr::from_ptr(t[0]).to_str().unwrap().to_owned()] },
        };
        let start = match v.start.len() {
            0 => continue,
            1 => vec![v.start[0].clone(); n],
            _ => v.start.clone(),
        };
        let same = |(a, b): (&String, &String)| match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(a), Ok(b)) => a == b,
            _ => a == b,
        };
        let all = values.iter().zip(&start).all(same);
        assert!(values.len() == start.len() && all, "{}: {values:?}", v.name);
        count += 1;
    }
    assert!(count > 50, "{count}");
}

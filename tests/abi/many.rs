//! Many instances, threads, and loading and unloading.

use crate::support::{
    Creation, Instance, c, child,
    fmu::{Fmu, binary, scratch, unpack_into},
    instance::bits,
};
use std::{
    fs,
    sync::{Barrier, Mutex},
    thread,
};

/// Two threads; each warms up, waits until the memory is measured, and goes on.
const WARM_UP: usize = 50;
const EACH: usize = 500;

/// Resident memory may grow by this, in kB, over the 900 instances after the warm-up: 1.1 kB each.
/// An instance holds 10 kB, mostly its airfoil's table, so that a leak of a ninth of it is seen.
/// The C library's allocator itself keeps some 50 kB in the arenas of two threads.
const ALLOWED_GROWTH: u64 = 1024;

#[test]
fn a_thousand_instances_in_two_threads_give_the_same_bits_and_leave_no_memory() {
    if child::run_alone(
        "many::a_thousand_instances_in_two_threads_give_the_same_bits_and_leave_no_memory",
    )
    .is_some()
    {
        return;
    }
    let results = Mutex::new(Vec::new());
    let barrier = Barrier::new(3);
    let (before, after) = thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                let mut thrusts = Vec::with_capacity(EACH);
                let mut simulate = |count: usize| {
                    for _ in 0..count {
                        thrusts.push(simulated());
                    }
                };
                simulate(WARM_UP);
                barrier.wait();
                barrier.wait();
                simulate(EACH - WARM_UP);
                barrier.wait();
                barrier.wait();
                results.lock().unwrap().extend(thrusts);
            });
        }
        // Between two barriers the threads rest.
        let at_rest = || {
            barrier.wait();
            let memory = resident_memory();
            barrier.wait();
            memory
        };
        (at_rest(), at_rest())
    });
    let results = results.into_inner().unwrap();
    assert_eq!(results.len(), 2 * EACH);
    assert!(results.iter().all(|thrust| *thrust == results[0]));
    if let (Some(before), Some(after)) = (before, after) {
        let growth = after.saturating_sub(before);
        assert!(
            growth < ALLOWED_GROWTH,
            "{before} kB resident, then {after} kB"
        );
    }
}

/// The bits of thrust and torque after the short flight of a new instance.
fn simulated() -> [u64; 2] {
    let instance = Instance::running();
    for (i, collective) in [0.1, 0.2, -0.1].into_iter().enumerate() {
        assert_eq!(instance.set_real("collective", collective), c::OK);
        assert_eq!(instance.step(0.125 * i as f64, 0.125), c::OK);
    }
    ["thrust", "torque"].map(|name| instance.real(name).to_bits())
}

/// What this process has in memory, in kB; none on systems without /proc.
fn resident_memory() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().strip_suffix(" kB")?.parse().ok()
}

#[test]
fn instances_side_by_side_do_not_disturb_each_other() {
    let alone = simulated();
    let others: Vec<Instance> = (1..20)
        .map(|i| {
            let instance = Instance::new();
            assert_eq!(
                instance.set_real("geometry.radius", 0.1 * f64::from(i)),
                c::OK
            );
            instance.initialize();
            instance
        })
        .collect();
    assert_eq!(simulated(), alone);
    let before: Vec<_> = others.iter().map(|i| bits(&i.reals())).collect();
    assert_eq!(simulated(), alone);
    assert_eq!(
        before,
        others.iter().map(|i| bits(&i.reals())).collect::<Vec<_>>()
    );
}

#[test]
fn the_library_can_be_loaded_and_unloaded_fifty_times() {
    // A copy of its own, as the shared one stays loaded.
    let folder = scratch().join("unpacked-to-unload");
    unpack_into(&folder);
    let path = binary(&folder).canonicalize().unwrap();
    let path = path.to_str().unwrap();
    let mut thrusts = Vec::new();
    for i in 0..50 {
        let fmu = Fmu::load(&folder);
        assert_eq!(
            is_mapped(path),
            cfg!(target_os = "linux"),
            "loaded, round {i}"
        );
        {
            let instance = Instance::create(&fmu, &Creation::default()).unwrap();
            instance.initialize();
            assert_eq!(instance.step(0.0, 0.1), c::OK);
            assert_eq!(instance.step(0.0, 0.1), c::ERROR, "also the log is used");
            thrusts.push(instance.real("thrust").to_bits());
        }
        fmu.unload();
        assert!(!is_mapped(path), "unloaded, round {i}");
    }
    assert!(thrusts.iter().all(|thrust| *thrust == thrusts[0]));
}

/// Whether a file is part of this process's memory, as far as the system tells.
fn is_mapped(path: &str) -> bool {
    let maps = fs::read_to_string("/proc/self/maps").unwrap_or_default();
    maps.lines().any(|line| line.ends_with(path))
}

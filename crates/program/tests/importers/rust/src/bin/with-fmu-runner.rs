//! fmu-runner: https://crates.io/crates/fmu-runner

use fmu_runner::{Fmu, FmuInstance, FmuLibrary, fmi2Type};
use importers::{Error, STEP, STEPS, Variable, main_with};
use std::{collections::HashMap, path::Path};

type Instance<'l> = FmuInstance<&'l FmuLibrary>;

fn started<'l>(library: &'l FmuLibrary, variables: &[Variable]) -> Result<Instance<'l>, Error> {
    let instance = FmuInstance::instantiate(library, false)?;
    let known = library.variables();
    instance.setup_experiment(0.0, None, None)?;
    for Variable { kind, name, value } in variables {
        let variable = known.get(name).ok_or(format!("no variable {name}"))?;
        match kind.as_str() {
            "Real" => instance.set_reals(&HashMap::from([(variable, value.parse()?)]))?,
            "Integer" | "Enumeration" => {
                instance.set_integers(&HashMap::from([(variable, value.parse()?)]))?;
            }
            "Boolean" => {
                let value = i32::from(value == "true");
                instance.set_booleans(&HashMap::from([(variable, value)]))?;
            }
            _ => return Err(format!("no function to set a {kind}").into()),
        }
    }
    instance.enter_initialization_mode()?;
    instance.exit_initialization_mode()?;
    Ok(instance)
}

fn thrusts(instances: &[Instance]) -> Result<Vec<f64>, Error> {
    for i in 0..STEPS {
        for instance in instances {
            instance.do_step(i as f64 * STEP, STEP, true)?;
        }
    }
    let read = instances.iter().map(|instance| {
        let thrust = &instance.lib.variables()["thrust"];
        Ok(instance.get_reals(&[thrust])?[thrust])
    });
    read.collect()
}

fn fly(fmu: &str, mode: &str, variables: &[Variable]) -> Result<Option<Vec<f64>>, Error> {
    let library = Fmu::unpack(Path::new(fmu))?.load(fmi2Type::fmi2CoSimulation)?;
    let start = |variables| started(&library, variables);
    Ok(Some(match mode {
        "fly" => thrusts(&[start(variables)?])?,
        "two" => thrusts(&[start(variables)?, start(&[])?])?,
        "again" => [
            thrusts(&[start(variables)?])?,
            thrusts(&[start(variables)?])?,
        ]
        .concat(),
        _ => return Ok(None),
    }))
}

fn main() -> Result<(), Error> {
    main_with(fly)
}

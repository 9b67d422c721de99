//! fmi-rs: https://crates.io/crates/fmi-rs

use fmi_rs::{
    fmi2::{FMU2, builder::FMU2Builder, types::fmi2Status},
    model_description::fmi2::ModelDescription,
};
use importers::{Error, STEP, STEPS, Variable, integrate, main_with};

fn ok(status: fmi2Status) -> Result<(), Error> {
    match status {
        fmi2Status::Ok | fmi2Status::Warning => Ok(()),
        _ => Err("a call was refused".into()),
    }
}

fn reference(description: &ModelDescription, name: &str) -> Result<u32, Error> {
    let mut variables = description.modelVariables.iter();
    let found = variables.find(|variable| variable.name == name);
    Ok(found.ok_or(format!("no variable {name}"))?.valueReference)
}

fn start<T>(
    instance: &FMU2<T>,
    description: &ModelDescription,
    variables: &[Variable],
) -> Result<(), Error> {
    for Variable { kind, name, value } in variables {
        let at = [reference(description, name)?];
        ok(match kind.as_str() {
            "Real" => instance.setReal(&at, &[value.parse()?]),
            "Integer" | "Enumeration" => instance.setInteger(&at, &[value.parse()?]),
            "Boolean" => instance.setBoolean(&at, &[i32::from(value == "true")]),
            _ => instance.setString(&at, &[value]),
        })?;
    }
    ok(instance.setupExperiment(None, 0.0, None))?;
    ok(instance.enterInitializationMode())?;
    ok(instance.exitInitializationMode())
}

fn thrust<T>(instance: &FMU2<T>, description: &ModelDescription) -> Result<f64, Error> {
    let mut value = [f64::NAN];
    ok(instance.getReal(&[reference(description, "thrust")?], &mut value))?;
    Ok(value[0])
}

fn main() -> Result<(), Error> {
    main_with(fly)
}

fn fly(fmu: &str, mode: &str, variables: &[Variable]) -> Result<Option<Vec<f64>>, Error> {
    let builder = FMU2Builder::new(&fmu)?;
    let description = &builder.model_description;
    let fly = |rotors: &[&[Variable]], times: usize| -> Result<Vec<f64>, Error> {
        let mut instances = Vec::new();
        for name in ["first", "second"].iter().take(rotors.len()) {
            instances.push(builder.instantiate_cs(name)?);
        }
        let mut thrusts = Vec::new();
        for _ in 0..times {
            for (instance, variables) in instances.iter().zip(rotors) {
                start(instance, description, variables)?;
            }
            for i in 0..STEPS {
                for instance in &instances {
                    ok(instance.doStep(i as f64 * STEP, STEP, 1))?;
                }
            }
            for instance in &instances {
                thrusts.push(thrust(instance, description)?);
                ok(instance.reset())?;
            }
        }
        Ok(thrusts)
    };
    Ok(Some(match mode {
        "fly" => fly(&[variables], 1)?,
        "two" => fly(&[variables, &[]], 1)?,
        "again" => [fly(&[variables], 1)?, fly(&[variables], 1)?].concat(),
        "reset" => fly(&[variables], 2)?,
        "exchange" => vec![exchange(&builder, variables)?],
        _ => return Ok(None),
    }))
}

fn exchange(builder: &FMU2Builder, variables: &[Variable]) -> Result<f64, Error> {
    let description = &builder.model_description;
    let instance = builder.instantiate_me("rotor")?;
    start(&instance, description, variables)?;
    let mut is_needed = true;
    while is_needed {
        let (end, nominals, values) = (&mut false, &mut false, &mut false);
        ok(instance.newDiscreteStates(&mut is_needed, end, nominals, values, &mut None))?;
    }
    ok(instance.enterContinuousTimeMode())?;
    let mut x = vec![0.0; description.derivatives.len()];
    ok(instance.getContinuousStates(&mut x))?;
    let x = integrate(x, |time, x| {
        ok(instance.setTime(time))?;
        ok(instance.setContinuousStates(x))?;
        let mut rates = vec![0.0; x.len()];
        ok(instance.getDerivatives(&mut rates))?;
        Ok(rates)
    })?;
    ok(instance.setContinuousStates(&x))?;
    thrust(&instance, description)
}

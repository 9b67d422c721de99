//! The crate `fmi` of rust-fmi: https://crates.io/crates/fmi

use fmi::{
    fmi2::{
        import::Fmi2Import,
        instance::{CoSimulation, Common, ModelExchange},
    },
    import,
    schema::fmi2::Fmi2ModelDescription,
    traits::FmiImport,
};
use importers::{Error, STEP, STEPS, Variable, integrate, main_with};
use std::ffi::CString;

fn reference(description: &Fmi2ModelDescription, name: &str) -> Result<u32, Error> {
    let mut variables = description.model_variables.variables.iter();
    let found = variables.find(|variable| variable.name == name);
    Ok(found.ok_or(format!("no variable {name}"))?.value_reference)
}

fn start(
    instance: &mut impl Common,
    description: &Fmi2ModelDescription,
    variables: &[Variable],
) -> Result<(), Error> {
    for Variable { kind, name, value } in variables {
        let at = [reference(description, name)?];
        match kind.as_str() {
            "Real" => {
                instance.set_real(&at, &[value.parse()?])?;
            }
            "Integer" | "Enumeration" => {
                instance.set_integer(&at, &[value.parse()?])?;
            }
            "Boolean" => {
                instance.set_boolean(&at, &[i32::from(value == "true")])?;
            }
            _ => instance.set_string(&at, &[CString::new(value.as_str())?])?,
        }
    }
    instance.setup_experiment(None, 0.0, None)?;
    Common::enter_initialization_mode(instance)?;
    Common::exit_initialization_mode(instance)?;
    Ok(())
}

fn thrust(instance: &mut impl Common, description: &Fmi2ModelDescription) -> Result<f64, Error> {
    let mut value = [f64::NAN];
    instance.get_real(&[reference(description, "thrust")?], &mut value)?;
    Ok(value[0])
}

fn main() -> Result<(), Error> {
    main_with(fly)
}

fn fly(fmu: &str, mode: &str, variables: &[Variable]) -> Result<Option<Vec<f64>>, Error> {
    let import: Fmi2Import = import::from_path(fmu)?;
    let description = import.model_description();
    let fly = |rotors: &[&[Variable]], times: usize| -> Result<Vec<f64>, Error> {
        let mut instances = Vec::new();
        for name in ["first", "second"].iter().take(rotors.len()) {
            instances.push(import.instantiate_cs(name, false, false)?);
        }
        let mut thrusts = Vec::new();
        for _ in 0..times {
            for (instance, variables) in instances.iter_mut().zip(rotors) {
                start(instance, description, variables)?;
            }
            for i in 0..STEPS {
                for instance in &mut instances {
                    instance.do_step(i as f64 * STEP, STEP, true)?;
                }
            }
            for instance in &mut instances {
                thrusts.push(thrust(instance, description)?);
                Common::reset(instance)?;
            }
        }
        Ok(thrusts)
    };
    Ok(Some(match mode {
        "fly" => fly(&[variables], 1)?,
        "two" => fly(&[variables, &[]], 1)?,
        "again" => [fly(&[variables], 1)?, fly(&[variables], 1)?].concat(),
        "reset" => fly(&[variables], 2)?,
        "exchange" => vec![exchange(&import, variables)?],
        _ => return Ok(None),
    }))
}

fn exchange(import: &Fmi2Import, variables: &[Variable]) -> Result<f64, Error> {
    let description = import.model_description();
    let mut instance = import.instantiate_me("rotor", false, false)?;
    start(&mut instance, description, variables)?;
    let mut flags = fmi::EventFlags::default();
    loop {
        ModelExchange::new_discrete_states(&mut instance, &mut flags)?;
        if !flags.discrete_states_need_update {
            break;
        }
    }
    ModelExchange::enter_continuous_time_mode(&mut instance)?;
    let mut x = vec![0.0; description.model_structure.derivatives.unknowns.len()];
    ModelExchange::get_continuous_states(&mut instance, &mut x)?;
    let x = integrate(x, |time, x| {
        ModelExchange::set_time(&mut instance, time)?;
        ModelExchange::set_continuous_states(&mut instance, x)?;
        let mut rates = vec![0.0; x.len()];
        ModelExchange::get_derivatives(&mut instance, &mut rates)?;
        Ok(rates)
    })?;
    ModelExchange::set_continuous_states(&mut instance, &x)?;
    thrust(&mut instance, description)
}

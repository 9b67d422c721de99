//! What every importer is asked to fly, and how it is told and answers: as in `flight.py`, in the
//! folder above.

pub type Error = Box<dyn std::error::Error>;

pub const STEP: f64 = 1e-3;
pub const STEPS: usize = 1000;

/// A variable with its value as text.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Its type in FMI.
    pub kind: String,
    pub name: String,
    pub value: String,
}

/// Flies the FMU at a path in the mode of the command line, and returns the thrusts; None if the
/// importer has no function for the mode.
pub type Fly = fn(fmu: &str, mode: &str, variables: &[Variable]) -> Result<Option<Vec<f64>>, Error>;

pub fn main_with(fly: Fly) -> Result<(), Error> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [fmu, mode, rest @ ..] = &arguments[..] else {
        return Err("usage: FMU MODE [TYPE NAME VALUE ...]".into());
    };
    let variables: Vec<Variable> = rest
        .chunks_exact(3)
        .map(|words| Variable {
            kind: words[0].clone(),
            name: words[1].clone(),
            value: words[2].clone(),
        })
        .collect();
    if mode == "load" {
        fly(fmu, "fly", &variables)?;
        return Ok(());
    }
    let thrusts = fly(fmu, mode, &variables)?.ok_or("no function to fly in this mode")?;
    for thrust in thrusts {
        println!("thrust {thrust}");
    }
    Ok(())
}

/// Model Exchange with Heun's method of second order, for importers without a solver: calls
/// `derivatives` with a time and states.
pub fn integrate(
    mut x: Vec<f64>,
    mut derivatives: impl FnMut(f64, &[f64]) -> Result<Vec<f64>, Error>,
) -> Result<Vec<f64>, Error> {
    let moved = |x: &[f64], step: f64, rates: &[f64]| -> Vec<f64> {
        x.iter()
            .zip(rates)
            .map(|(x, rate)| x + step * rate)
            .collect()
    };
    for i in 0..STEPS {
        let first = derivatives(i as f64 * STEP, &x)?;
        let second = derivatives((i + 1) as f64 * STEP, &moved(&x, STEP, &first))?;
        let mean: Vec<f64> = first
            .iter()
            .zip(&second)
            .map(|(a, b)| (a + b) / 2.0)
            .collect();
        x = moved(&x, STEP, &mean);
    }
    Ok(x)
}

//! Which polars become blocks, by Reynolds or by Mach number.

use super::{By, Options, Polar};
use crate::Failure;

/// Numbers this near, as a fraction, are one.
const SAME: f64 = 1e-6;

/// The polars to write with their Reynolds or Mach numbers, which increase.
pub fn select(
    mut polars: Vec<Polar>,
    options: &Options,
    notes: &mut Vec<String>,
) -> Result<(By, Vec<(f64, Polar)>), Failure> {
    fill_reynolds(&mut polars, &options.reynolds)?;
    if let (Some(by), Some(at)) = (options.by, options.at) {
        keep(&mut polars, by, at)?;
    }
    let by = match options.by {
        Some(by) => by,
        None => axis(&polars)?,
    };
    let mut numbered = Vec::new();
    for polar in polars {
        let Some(number) = number(&polar, by) else {
            return Err(missing(&polar, by));
        };
        numbered.push((number, polar));
    }
    numbered.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    for pair in numbered.windows(2) {
        let ((a, first), (b, second)) = (&pair[0], &pair[1]);
        if is_same(*a, *b) {
            return Err(twice(*a, first, second, by));
        }
    }
    warn_of_mach(&numbered, by, notes);
    Ok((by, numbered))
}

fn number(polar: &Polar, by: By) -> Option<f64> {
    match by {
        By::Reynolds => polar.reynolds,
        By::Mach => polar.mach,
    }
}

fn other(by: By) -> By {
    match by {
        By::Reynolds => By::Mach,
        By::Mach => By::Reynolds,
    }
}

fn words(by: By) -> &'static str {
    match by {
        By::Reynolds => "Reynolds number",
        By::Mach => "Mach number",
    }
}

fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.abs().max(b.abs())
}

/// Gives the polars without a Reynolds number those of the command line.
fn fill_reynolds(polars: &mut [Polar], given: &[f64]) -> Result<(), Failure> {
    if given.is_empty() {
        return Ok(());
    }
    let mut without: Vec<&mut Polar> = polars.iter_mut().filter(|p| p.reynolds.is_none()).collect();
    // The Mach numbers of a C81 file have one Reynolds number.
    if let [one] = given {
        for polar in without {
            polar.reynolds = Some(*one);
        }
        return Ok(());
    }
    if without.len() != given.len() {
        return Err(Failure(format!(
            "--reynolds gives {} numbers, but {} polars have none in their files; give one for each of these",
            given.len(),
            without.len()
        )));
    }
    for (polar, reynolds) in without.iter_mut().zip(given) {
        polar.reynolds = Some(*reynolds);
    }
    Ok(())
}

/// Keeps the polars at one number of the other kind.
fn keep(polars: &mut Vec<Polar>, by: By, at: f64) -> Result<(), Failure> {
    let other = other(by);
    let all: Vec<f64> = distinct(polars, other);
    polars.retain(|polar| number(polar, other).is_some_and(|n| is_same(n, at)));
    if polars.is_empty() {
        return Err(Failure(format!(
            "no polar has the {} {at} of --at; they have {}",
            words(other),
            list(&all)
        )));
    }
    Ok(())
}

/// The different numbers of the polars.
fn distinct(polars: &[Polar], by: By) -> Vec<f64> {
    let mut numbers: Vec<f64> = polars.iter().filter_map(|p| number(p, by)).collect();
    numbers.sort_by(f64::total_cmp);
    numbers.dedup_by(|a, b| is_same(*a, *b));
    numbers
}

fn list(numbers: &[f64]) -> String {
    if numbers.is_empty() {
        return "none".into();
    }
    let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
    words.join(", ")
}

/// What the polars differ in.
fn axis(polars: &[Polar]) -> Result<By, Failure> {
    let reynolds = distinct(polars, By::Reynolds);
    let mach = distinct(polars, By::Mach);
    let all_have = |by: By| polars.iter().all(|p| number(p, by).is_some());
    if all_have(By::Reynolds) && reynolds.len() == polars.len() {
        return Ok(By::Reynolds);
    }
    if all_have(By::Mach) && mach.len() == polars.len() {
        return Ok(By::Mach);
    }
    if let Some(polar) = polars.iter().find(|p| p.reynolds.is_none()) {
        return Err(missing(polar, By::Reynolds));
    }
    if mach.len() > 1 && reynolds.len() > 1 {
        return Err(Failure(format!(
            "the files have polars for the Reynolds numbers {} and the Mach numbers {}, and a .polar file has one of the two; choose with `--by reynolds --at MACH` or `--by mach --at REYNOLDS`",
            list(&reynolds),
            list(&mach)
        )));
    }
    // Some number comes twice; `select` says which.
    Ok(if reynolds.len() >= mach.len() {
        By::Reynolds
    } else {
        By::Mach
    })
}

fn missing(polar: &Polar, by: By) -> Failure {
    Failure(match by {
        By::Reynolds => format!(
            "{} does not say for which Reynolds number it is; give it with --reynolds",
            polar.source
        ),
        By::Mach => format!(
            "{} does not say for which Mach number it is; make the blocks by Reynolds number",
            polar.source
        ),
    })
}

fn twice(number: f64, first: &Polar, second: &Polar, by: By) -> Failure {
    let (a, b) = (
        self::number(first, other(by)),
        self::number(second, other(by)),
    );
    let word = words(by);
    match (a, b) {
        (Some(a), Some(b)) if !is_same(a, b) => Failure(format!(
            "{} and {} are both for the {word} {number}, and for the {}s {a} and {b}; choose one of these with --at",
            first.source,
            second.source,
            words(other(by))
        )),
        _ => Failure(format!(
            "{} and {} are both for the {word} {number}; leave one out",
            first.source, second.source
        )),
    }
}

/// A polar at a Mach number already contains what the rules for compressibility add.
fn warn_of_mach(polars: &[(f64, Polar)], by: By, notes: &mut Vec<String>) {
    // Below, the rule changes the lift by about 2 % or less.
    const LOW: f64 = 0.2;
    let machs = polars.iter().filter_map(|(_, polar)| polar.mach);
    let highest = machs.fold(0.0, f64::max);
    let is_by_reynolds = by == By::Reynolds;
    if highest > LOW && (is_by_reynolds || polars.len() == 1) {
        notes.push(format!(
            "these polars are for Mach numbers up to {highest}: the lift already contains the effect of compressibility; set models.compressibility = none, or it is counted twice"
        ));
    }
}

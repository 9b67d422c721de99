//! The variables as FMI 3.0 has them: arrays where FMI 2.0 has one variable for each element.

use crate::table::{Base, Table, Variable};

/// Number of value references for each base type. Within its block a variable has the value
/// reference that it, or its first element, has in FMI 2.0.
pub const BLOCK: u32 = 10_000;
/// The value reference of `time`.
pub const TIME: u32 = 4 * BLOCK;

/// A variable of FMI 3.0.
pub struct Grouped<'a> {
    pub name: String,
    pub description: &'a str,
    pub reference: u32,
    /// One variable, or the elements of an array.
    pub elements: Vec<&'a Variable>,
    pub is_array: bool,
}

impl Grouped<'_> {
    /// The index that means the whole variable in a dependency.
    pub fn whole(&self) -> usize {
        if self.is_array { 0 } else { 1 }
    }
}

/// All variables but `time`.
pub fn grouped(table: &Table) -> Result<Vec<Grouped<'_>>, String> {
    let mut all: Vec<Grouped> = Vec::new();
    for v in &table.variables {
        let reference = reference(table, v)?;
        let Some(name) = array_of(v) else {
            all.push(Grouped {
                name: v.name.clone(),
                description: &v.description,
                reference,
                elements: vec![v],
                is_array: false,
            });
            continue;
        };
        match all.iter_mut().find(|array| array.name == name) {
            Some(array) => {
                if reference != array.reference + array.elements.len() as u32 {
                    return Err(format!("the elements of {name} must follow each other"));
                }
                if !is_alike(array.elements[0], v) {
                    return Err(format!(
                        "{} differs from the first element of {name} in type, unit, range or causality",
                        v.name
                    ));
                }
                array.elements.push(v);
            }
            None => all.push(Grouped {
                description: description(table, v, &name)?,
                name,
                reference,
                elements: vec![v],
                is_array: true,
            }),
        }
    }
    Ok(all)
}

/// The array of which a variable is an element: `station.radius` for `station[1].radius`.
fn array_of(v: &Variable) -> Option<String> {
    if let Some(row) = &v.element_of {
        return Some(row.replace("[#]", ""));
    }
    let (name, index) = v.name.strip_suffix(']')?.rsplit_once('[')?;
    index.parse::<u32>().ok().map(|_| name.to_owned())
}

/// The description of an array: that of its row, or of its `[[array]]`.
fn description<'a>(table: &'a Table, v: &'a Variable, name: &str) -> Result<&'a str, String> {
    if v.element_of.is_some() {
        return Ok(&v.description);
    }
    let array = table.arrays.iter().find(|array| array.name == name);
    array.map(|array| array.description.as_str()).ok_or_else(|| {
        format!(
            "{} is an element of {name}, which FMI 3.0 has as an array; describe it in an [[array]]",
            v.name
        )
    })
}

fn is_alike(a: &Variable, b: &Variable) -> bool {
    (&a.kind, &a.causality, &a.unit, &a.display_unit)
        == (&b.kind, &b.causality, &b.unit, &b.display_unit)
        && (a.min, a.max, a.nominal, a.variability()) == (b.min, b.max, b.nominal, b.variability())
        && a.derivative_of.is_some() == b.derivative_of.is_some()
}

fn reference(table: &Table, v: &Variable) -> Result<u32, String> {
    let block = match v.base() {
        Base::Real => 0,
        Base::Integer => 1,
        Base::Boolean => 2,
        Base::String => 3,
    };
    if block != 0 && array_of(v).is_some() {
        return Err(format!("{}: only Reals can be arrays in FMI 3.0", v.name));
    }
    let index = table.value_reference(v) as u32;
    if index >= BLOCK {
        return Err(format!(
            "there are more than {BLOCK} variables of a base type"
        ));
    }
    Ok(block * BLOCK + index)
}

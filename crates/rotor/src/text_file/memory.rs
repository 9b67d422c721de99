//! Vectors whose length a file decides. Where the memory for one is missing, the reader says so;
//! the vectors of the standard library would end the importer's process.
//!
//! Vectors with a constant limit of a few kB do without.

use thiserror::Error;

/// The memory for something is missing.
#[derive(Debug, Error, Clone, Copy, PartialEq, Eq)]
#[error("there is not enough memory for {0}")]
pub struct NoMemory(pub &'static str);

/// Adds an item to the vector of `what`.
pub fn push<T>(vector: &mut Vec<T>, item: T, what: &'static str) -> Result<(), NoMemory> {
    vector.try_reserve(1).map_err(|_| NoMemory(what))?;
    vector.push(item);
    Ok(())
}

/// The vector of `what` with these items.
pub fn collect<T>(items: impl Iterator<Item = T>, what: &'static str) -> Result<Vec<T>, NoMemory> {
    let mut vector = Vec::new();
    let expected = items.size_hint().0;
    vector
        .try_reserve_exact(expected)
        .map_err(|_| NoMemory(what))?;
    for item in items {
        push(&mut vector, item, what)?;
    }
    Ok(vector)
}

/// Refuses `what` if so many bytes are not there now: for code that cannot do without them.
pub fn ensure(bytes: usize, what: &'static str) -> Result<(), NoMemory> {
    let mut room: Vec<u8> = Vec::new();
    room.try_reserve_exact(bytes).map_err(|_| NoMemory(what))?;
    // Else the compiler may leave the unused room out.
    std::hint::black_box(&mut room);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_are_kept_in_order_and_too_many_are_refused_in_words() {
        let mut vector = collect(0..3, "the numbers").unwrap();
        push(&mut vector, 3, "the numbers").unwrap();
        assert_eq!(vector, [0, 1, 2, 3]);
        let error = collect(0..usize::MAX, "the numbers").unwrap_err();
        let sentence = "there is not enough memory for the numbers";
        assert_eq!(error.to_string(), sentence);
        assert_eq!(ensure(1000, "the numbers"), Ok(()));
        let error = ensure(isize::MAX as usize, "the numbers").unwrap_err();
        assert_eq!(error.to_string(), sentence);
    }
}

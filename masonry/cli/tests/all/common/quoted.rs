//! What a page quotes from the output of a command: its words, and its numbers to 1 %.
//!
//! A page may break a line elsewhere, and may quote the beginning of a sentence; a quotation that ends with a full stop is a
//! whole sentence. Factors of a path on elastic bricks differ by some tenths of a per cent from one
//! version to the next, and from one machine to another.

/// Whether the words of `quoted` stand in `output` one after the other.
pub(crate) fn says(output: &str, quoted: &str) -> bool {
    let output: Vec<&str> = output.split_whitespace().collect();
    let quoted: Vec<&str> = quoted.split_whitespace().collect();
    output
        .windows(quoted.len())
        .any(|words| words.iter().zip(&quoted).all(|(word, quoted)| alike(word, quoted)))
}

fn alike(word: &str, quoted: &str) -> bool {
    let is_end = |it: &str| it.ends_with('.');
    if is_end(quoted) && !is_end(word) {
        return false;
    }
    let [word, quoted] = [word, quoted].map(|it| it.trim_end_matches([',', '.', ';', ':']));
    match (word.parse::<f64>(), quoted.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= 0.01 * b.abs(),
        _ => word == quoted,
    }
}

#[test]
fn words_are_compared_exactly_and_numbers_to_one_per_cent() {
    assert!(says("stands up to 2.49 (path), cannot\nstand", "up to 2.4809 (path), cannot stand"));
    assert!(!says("stands up to 2.52 (path)", "up to 2.4809 (path)"));
    assert!(!says("stands up to 2.48 (path)", "falls up to 2.48 (path)"));
}

#[test]
fn a_quoted_full_stop_is_the_end_of_a_sentence() {
    assert!(says("The wall stands (verified). It rests.", "The wall stands (verified)."));
    assert!(says("The wall stands (verified), and rests.", "The wall stands (verified)"));
    assert!(!says("The wall stands (verified), and rests.", "The wall stands (verified)."));
}

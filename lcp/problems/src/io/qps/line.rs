//! The words of a line.

use crate::io::Position;
use crate::io::tokens::{Token, Tokens};

/// The layout of the words of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Layout {
    /// Words between white space.
    Free,
    /// Words in columns.
    Fixed,
}

/// The beginnings and ends of the fields of the fixed layout, in characters from 0.
const FIELDS: [[usize; 2]; 6] = [[1, 3], [4, 12], [14, 22], [24, 36], [39, 47], [49, 61]];

impl Layout {
    /// The words of a line, without the fields that are empty.
    pub(super) fn words(self, line: &str, number: usize) -> Vec<Token<'_>> {
        let at = |column| Position { line: number, column };
        match self {
            Self::Free => {
                let mut words = Tokens::with_comments(line, '\n');
                let words = std::iter::from_fn(|| words.next());
                words.map(|word| Token { at: at(word.at.column), ..word }).collect()
            }
            Self::Fixed => {
                let byte = |k| line.char_indices().nth(k).map_or(line.len(), |(byte, _)| byte);
                let field = |[begin, end]: [usize; 2]| {
                    let (begin, end) = (byte(begin), byte(end));
                    let field = &line[begin..end];
                    let text = field.trim();
                    let column = begin + field.len() - field.trim_start().len() + 1;
                    (!text.is_empty()).then(|| Token { text, at: at(column) })
                };
                FIELDS.into_iter().filter_map(field).collect()
            }
        }
    }
}

//! Tables whose columns have names, quantities and digits.

use super::{Members, Value};
use crate::format::{InUnits, Quantity};

/// The way in which a report as text writes the numbers of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Digits {
    /// Equally many decimals in this column and in neighbouring columns of the same quantity, so that the largest
    /// number has this many significant digits.
    Aligned(usize),
    /// A fixed number of significant digits for every number.
    Significant(usize),
    /// Two digits and a power of ten.
    Power,
}

/// A column of a table.
#[derive(Debug, Clone)]
pub(crate) struct Column {
    /// The name in JSON and CSV.
    pub(crate) key: String,
    /// The name of the column for readers.
    pub(crate) name: String,
    pub(crate) quantity: Quantity,
    pub(crate) digits: Digits,
    /// Whether a report as text aligns the column on the right.
    pub(crate) is_right: bool,
}

impl Column {
    /// Returns the name of the column with its unit.
    pub(crate) fn head(&self, units: InUnits) -> String {
        match units.unit(self.quantity).as_str() {
            "" => self.name.clone(),
            unit => format!("{} [{unit}]", self.name),
        }
    }
}

/// A function that returns the value in a column for a record, in SI units.
type Entry<'a, T> = Box<dyn Fn(&T) -> Value + 'a>;

/// Columns of a table, each with the function that returns its value for a record.
pub(crate) struct Columns<'a, T>(Vec<(Column, Entry<'a, T>)>);

impl<'a, T> Columns<'a, T> {
    pub(crate) fn new() -> Self {
        Self(Vec::new())
    }

    pub(crate) fn words<V: Into<Value>>(mut self, key: &str, of: impl Fn(&T) -> V + 'a) -> Self {
        self = self.count(key, of);
        self.right(false)
    }

    pub(crate) fn count<V: Into<Value>>(self, key: &str, of: impl Fn(&T) -> V + 'a) -> Self {
        self.number(key, Quantity::Pure, Digits::Power, of)
    }

    pub(crate) fn number<V: Into<Value>>(
        mut self,
        key: &str,
        quantity: Quantity,
        digits: Digits,
        of: impl Fn(&T) -> V + 'a,
    ) -> Self {
        let (key, name) = (key.to_owned(), key.to_owned());
        let column = Column { key, name, quantity, digits, is_right: true };
        self.0.push((column, Box::new(move |it| of(it).into())));
        self
    }

    /// Gives the last column another name for readers; the key stays.
    pub(crate) fn named(self, name: &str) -> Self {
        self.last(|it| name.clone_into(&mut it.name))
    }

    /// Aligns the last column on the right or on the left in reports as text.
    pub(crate) fn right(self, is_right: bool) -> Self {
        self.last(|it| it.is_right = is_right)
    }

    fn last(mut self, change: impl FnOnce(&mut Column)) -> Self {
        if let Some((column, _)) = self.0.last_mut() {
            change(column);
        }
        self
    }

    /// Returns the table with a row for every record.
    pub(crate) fn table(&self, units: InUnits, records: impl IntoIterator<Item = T>) -> Table {
        let value = |column: &Column, value| match value {
            Value::Number(si) => Value::Number(units.of(column.quantity, si)),
            other => other,
        };
        let row = |it: T| self.0.iter().map(|(column, of)| value(column, of(&it))).collect();
        Table {
            units,
            columns: self.0.iter().map(|it| it.0.clone()).collect(),
            rows: records.into_iter().map(row).collect(),
        }
    }
}

/// Rows of values under columns.
#[derive(Debug, Clone)]
pub(crate) struct Table {
    pub(crate) units: InUnits,
    pub(crate) columns: Vec<Column>,
    /// Values in the units of the scene; a row without values is shown as a gap.
    pub(crate) rows: Vec<Vec<Value>>,
}

impl Table {
    /// Returns the table with the columns of these keys (separated by spaces), in the order of the keys.
    pub(crate) fn only(&self, keys: &str) -> Self {
        let positions = keys.split(' ').filter_map(|key| self.position(key));
        self.picked(&positions.collect::<Vec<_>>())
    }

    /// Returns the table without the columns of these keys, which are separated by spaces.
    pub(crate) fn without(&self, keys: &str) -> Self {
        let stays = |k: &usize| keys.split(' ').all(|key| self.columns[*k].key != key);
        self.picked(&(0..self.columns.len()).filter(stays).collect::<Vec<_>>())
    }

    fn position(&self, key: &str) -> Option<usize> {
        self.columns.iter().position(|it| it.key == key)
    }

    fn picked(&self, positions: &[usize]) -> Self {
        let row = |row: &Vec<Value>| {
            positions.iter().filter_map(|k| row.get(*k).cloned()).collect::<Vec<_>>()
        };
        let columns = positions.iter().map(|k| self.columns[*k].clone()).collect();
        Self { units: self.units, columns, rows: self.rows.iter().map(row).collect() }
    }

    /// Returns the table with these names of its columns, one name for each column.
    pub(crate) fn with_names<const N: usize>(mut self, names: [&str; N]) -> Self {
        self.columns.iter_mut().zip(names).for_each(|(it, name)| name.clone_into(&mut it.name));
        self
    }

    /// Returns the table with this many significant digits in all numbers.
    pub(crate) fn with_digits(mut self, digits: usize) -> Self {
        self.columns.iter_mut().for_each(|it| it.digits = Digits::Significant(digits));
        self
    }

    /// Keeps the rows for whose index `stays` returns true.
    pub(crate) fn retain(&mut self, stays: impl Fn(usize) -> bool) {
        let mut position = 0..;
        self.rows.retain(|_| position.next().is_some_and(&stays));
    }

    /// Returns the numbers of a column.
    pub(crate) fn numbers(&self, key: &str) -> Vec<f64> {
        let number = |value: &Value| match value {
            Value::Number(it) => Some(*it),
            Value::Count(it) => Some(*it as f64),
            _ => None,
        };
        let values = self.rows.iter().filter_map(|row| row.get(self.position(key)?));
        values.filter_map(number).collect()
    }

    /// Returns every row as the members of a JSON object.
    pub(crate) fn objects(&self) -> Vec<Members> {
        let keys = || self.columns.iter().map(|it| it.key.clone());
        self.rows.iter().map(|row| keys().zip(row.iter().cloned()).collect()).collect()
    }

    /// Returns a JSON object with a member for every row; the first column gives the names of the members.
    pub(crate) fn by_name(&self) -> Members {
        let named = |mut row: Members| match row.remove(0).1 {
            Value::Words(name) => (name, Value::Object(row)),
            _ => (String::new(), Value::Object(row)),
        };
        self.objects().into_iter().map(named).collect()
    }
}

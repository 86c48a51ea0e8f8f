//! Tables whose columns know their names, quantities and digits.

use super::Value;
use crate::report::format::{InUnits, Quantity};

/// How a text writes the numbers of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::report) enum Digits {
    /// As many decimals as give the largest number so many significant digits, in it and in its neighbours of the same
    /// quantity.
    Aligned(usize),
    /// So many significant digits.
    Significant(usize),
    /// Two digits and a power of ten.
    Power,
}

/// A column of a table.
#[derive(Debug, Clone)]
pub(in crate::report) struct Column {
    /// In JSON and CSV.
    pub(in crate::report) key: String,
    /// For readers.
    pub(in crate::report) name: String,
    pub(in crate::report) quantity: Quantity,
    pub(in crate::report) digits: Digits,
    /// Significant digits on a page.
    pub(in crate::report) on_page: usize,
    /// Whether a text has it on the right.
    pub(in crate::report) is_right: bool,
}

impl Column {
    pub(in crate::report) fn words(key: &str) -> Self {
        Self { is_right: false, ..Self::number(key, Quantity::Pure, Digits::Power) }
    }

    pub(in crate::report) fn count(key: &str) -> Self {
        Self::number(key, Quantity::Pure, Digits::Power)
    }

    pub(in crate::report) fn number(key: &str, quantity: Quantity, digits: Digits) -> Self {
        let on_page = match digits {
            Digits::Aligned(digits) | Digits::Significant(digits) => digits,
            Digits::Power => 2,
        };
        let (key, name) = (key.to_owned(), key.to_owned());
        Self { key, name, quantity, digits, on_page, is_right: true }
    }

    pub(in crate::report) fn named(mut self, name: &str) -> Self {
        name.clone_into(&mut self.name);
        self
    }

    pub(in crate::report) fn on_page(mut self, digits: usize) -> Self {
        self.on_page = digits;
        self
    }

    /// Its name and its unit.
    pub(in crate::report) fn head(&self, units: InUnits) -> String {
        match units.unit(self.quantity).as_str() {
            "" => self.name.clone(),
            unit => format!("{} [{unit}]", self.name),
        }
    }
}

/// Rows of values under columns.
#[derive(Debug, Clone)]
pub(in crate::report) struct Table {
    pub(in crate::report) units: InUnits,
    pub(in crate::report) columns: Vec<Column>,
    /// In the units of the scene; rows without values are gaps.
    pub(in crate::report) rows: Vec<Vec<Value>>,
}

impl Table {
    pub(in crate::report) fn new(units: InUnits, columns: Vec<Column>) -> Self {
        Self { units, columns, rows: Vec::new() }
    }

    /// Adds a row of SI values.
    pub(in crate::report) fn row(&mut self, values: Vec<Value>) {
        let in_units = |(value, column): (Value, &Column)| match value {
            Value::Number(si) => Value::Number(self.units.of(column.quantity, si)),
            other => other,
        };
        let row = values.into_iter().zip(&self.columns).map(in_units).collect();
        self.rows.push(row);
    }

    /// The table with these columns, in this order.
    pub(in crate::report) fn only(&self, keys: &[&str]) -> Self {
        let position = |key: &&str| self.columns.iter().position(|it| it.key == *key);
        self.picked(&keys.iter().filter_map(position).collect::<Vec<_>>())
    }

    /// The table without these columns.
    pub(in crate::report) fn without(&self, keys: &[&str]) -> Self {
        let stays = |k: &usize| !keys.contains(&self.columns[*k].key.as_str());
        self.picked(&(0..self.columns.len()).filter(stays).collect::<Vec<_>>())
    }

    fn picked(&self, positions: &[usize]) -> Self {
        let row = |row: &Vec<Value>| {
            positions.iter().filter_map(|k| row.get(*k).cloned()).collect::<Vec<_>>()
        };
        let columns = positions.iter().map(|k| self.columns[*k].clone()).collect();
        Self { units: self.units, columns, rows: self.rows.iter().map(row).collect() }
    }

    /// Every row as the members of an object.
    pub(in crate::report) fn objects(&self) -> Vec<Vec<(String, Value)>> {
        let keys = || self.columns.iter().map(|it| it.key.clone());
        self.rows.iter().map(|row| keys().zip(row.iter().cloned()).collect()).collect()
    }

    /// An object with a member for every row, which the first column names.
    pub(in crate::report) fn by_name(&self) -> Vec<(String, Value)> {
        let named = |mut row: Vec<(String, Value)>| match row.remove(0).1 {
            Value::Words(name) => (name, Value::Object(row)),
            _ => (String::new(), Value::Object(row)),
        };
        self.objects().into_iter().map(named).collect()
    }
}

//! Reading and writing of `courses` in TOML: a number, or a list of lists.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Unexpected, Visitor};

use super::Courses;

impl<'de> Deserialize<'de> for Courses {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CoursesVisitor)
    }
}

// The visitor is written by hand because an untagged enum would lose the place of a mistake in the list.
struct CoursesVisitor;

impl<'de> Visitor<'de> for CoursesVisitor {
    type Value = Courses;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number of courses, or a list of courses such as [[0.5, 1, 1], [1, 1, 0.5]]")
    }

    fn visit_u64<E: Error>(self, count: u64) -> Result<Courses, E> {
        u32::try_from(count)
            .map(Courses::RunningBond)
            .map_err(|_| E::invalid_value(Unexpected::Unsigned(count), &self))
    }

    fn visit_i64<E: Error>(self, count: i64) -> Result<Courses, E> {
        u32::try_from(count)
            .map(Courses::RunningBond)
            .map_err(|_| E::invalid_value(Unexpected::Signed(count), &self))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Courses, A::Error> {
        let mut courses = Vec::new();
        while let Some(course) = list.next_element()? {
            courses.push(course);
        }
        Ok(Courses::List(courses))
    }
}

/// Implements the schema by hand, as the deserialisation.
#[cfg(test)]
impl schemars::JsonSchema for Courses {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Courses".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let (count, list) =
            (generator.subschema_for::<u32>(), generator.subschema_for::<Vec<Vec<f64>>>());
        schemars::json_schema!({
            "description": "A number of courses in a bond, or a list of courses from bottom to top, each a list of brick \
                            lengths in units of one brick, where a negative number is an opening.",
            "anyOf": [count, list]
        })
    }
}

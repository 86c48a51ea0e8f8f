//! The JSON schema of scene files.

use super::Scene;

impl Scene {
    /// Returns the JSON schema of scene files (draft 2020-12), pretty-printed, with keys, types and their meaning.
    /// Editors use the schema to complete and check TOML. It does not include rules that concern more than one value,
    /// such as names that refer to others: see [`Scene::check`].
    ///
    /// ```
    /// assert!(masonry::Scene::schema().contains("\"title\""));
    /// ```
    pub fn schema() -> &'static str {
        include_str!("schema.json")
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::{env, fs};

    use schemars::Schema;
    use schemars::generate::SchemaSettings;
    use schemars::transform::{Transform, transform_subschemas};
    use serde_json::Value;

    use super::Scene;

    /// A transform of a schema that removes parts of descriptions that only Rust programmers need.
    #[derive(Debug, Clone)]
    struct PlainText;

    impl Transform for PlainText {
        fn transform(&mut self, schema: &mut Schema) {
            if let Some(text) = schema.get("description").and_then(|it| it.as_str()).map(plain) {
                schema.insert("description".to_owned(), text.into());
            }
            // Default values that are empty are left out.
            match schema.get_mut("default") {
                Some(Value::Null) => drop(schema.remove("default")),
                Some(Value::Object(keys)) => keys.retain(|_, value| !value.is_null()),
                _ => {}
            }
            transform_subschemas(self, schema);
        }
    }

    /// Returns a description without examples and without the targets of links, and with plain brackets around units.
    fn plain(text: &str) -> String {
        let text = text.split("\n```").next().unwrap_or(text).trim_end();
        let mut parts = text.split("](");
        let mut plain = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            // The bracket of a link goes with its target.
            if let Some(start) = plain.rfind('[') {
                plain.remove(start);
            }
            plain += part.split_once(')').map_or(part, |(_, after)| after);
        }
        plain.replace("\\[", "[").replace("\\]", "]").replace('\n', " ").replace("  ", "\n\n")
    }

    /// Checks that the schema file is up to date; `UPDATE_SCHEMA=1 cargo test -p masonry --lib schema` writes it.
    #[test]
    fn the_schema_is_that_of_the_types() {
        let settings = SchemaSettings::draft2020_12().with_transform(PlainText);
        let schema = settings.into_generator().into_root_schema_for::<Scene>();
        let text = format!("{:#}\n", schema.as_value());
        if env::var_os("UPDATE_SCHEMA").is_some() {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/scene/schema.json");
            fs::write(path, &text).expect("the file can be written");
            return;
        }
        assert_eq!(Scene::schema(), text, "UPDATE_SCHEMA=1 cargo test -p masonry --lib schema");
    }

    #[test]
    fn descriptions_are_plain() {
        let text = "Length \\[length\\], of a\n[`block`](crate::scene::Block) or [wall](Wall).\n\nMore.\n\n```\nlet x = 1;\n```";
        assert_eq!(plain(text), "Length [length], of a `block` or wall.\n\nMore.");
    }
}

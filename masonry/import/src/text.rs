//! The scene of an import as a commented file.

use std::fmt::Write as _;

use super::Imported;
use masonry::scene::{Block, Contact, Scene, SceneError, Support};

impl Imported {
    /// Returns the scene as TOML text, with the report at the top, and beside each block its place in the drawing.
    ///
    /// # Errors
    /// The errors of [`Scene::to_toml`](masonry::Scene::to_toml).
    pub fn to_toml(&self) -> Result<String, SceneError> {
        let mut rest = self.scene.clone();
        let (blocks, supports) =
            (std::mem::take(&mut rest.blocks), std::mem::take(&mut rest.supports));
        let mut text = String::new();
        for line in self.report().lines() {
            let _ = writeln!(text, "# {line}");
        }
        text.push('\n');
        text.push_str(&without_defaults(&rest)?);
        for support in &supports {
            text.push_str(&support_text(support));
        }
        for (block, place) in blocks.iter().zip(&self.places) {
            text.push_str(&block_text(block, &place.to_string()));
        }
        Ok(text)
    }
}

/// Returns the text of a scene without tables that only repeat default values.
fn without_defaults(scene: &Scene) -> Result<String, SceneError> {
    let mut defaults = vec!["[solver]", "[output]"];
    defaults.extend((scene.contact == Contact::default()).then_some("[contact]"));
    let text = scene.to_toml()?;
    let is_default = |it: &&str| defaults.iter().any(|name| it.starts_with(name));
    let kept: Vec<&str> = text.split("\n\n").filter(|it| !is_default(it)).collect();
    Ok(kept.join("\n\n").trim_end().to_owned() + "\n")
}

fn block_text(block: &Block, place: &str) -> String {
    let corners: Vec<String> = block.corners.iter().map(|it| pair(*it)).collect();
    format!(
        "\n[[blocks]]  # {place}\nname = {}\nmaterial = {}\ncorners = [{}]\n",
        quoted(&block.name),
        quoted(&block.material),
        corners.join(", ")
    )
}

fn support_text(support: &Support) -> String {
    format!(
        "\n[[supports]]\nname = {}\nfrom = {}\nto = {}\njoint = {}\n",
        quoted(&support.name),
        pair(support.from),
        pair(support.to),
        quoted(&support.joint)
    )
}

fn pair([x, y]: [f64; 2]) -> String {
    format!("[{x:?}, {y:?}]")
}

fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

//! COMPAS JSON: assemblies and meshes.
//!
//! The versions of COMPAS nest their data differently, but every mesh has an object `vertex`, whose values are objects
//! with `x`, `y` and `z`, and an object `face`, whose values are lists of keys of vertices. Meshes are therefore
//! searched at all levels.

use nalgebra::Point3;
use serde_json::{Map, Value};

use super::error::shown;
use super::list::json_error;
use super::mesh::{self, Mesh};
use super::shapes::MOST_SHAPES;
use super::{Drawing, DrawingError, DrawingErrorKind, Place};

/// The material of blocks for which the file gives none.
const MATERIAL: &str = "stone";

pub(super) fn read(text: &str) -> Result<Drawing, DrawingError> {
    let value: Value = serde_json::from_str(text).map_err(|error| json_error(&error))?;
    let mut search = Search { path: Vec::new(), meshes: Vec::new() };
    search.look(&value, &About { name: None, is_fixed: false })?;
    let mut drawing = Drawing::default();
    mesh::add(&mut drawing, search.meshes)?;
    Ok(drawing)
}

/// The name of a block, and whether it is fixed, as the objects around its mesh give them.
#[derive(Clone)]
struct About {
    name: Option<String>,
    is_fixed: bool,
}

struct Search {
    path: Vec<String>,
    meshes: Vec<Mesh>,
}

impl Search {
    fn look(&mut self, value: &Value, about: &About) -> Result<(), DrawingError> {
        match value {
            Value::Object(map) => self.look_into(map, about),
            Value::Array(list) => {
                for (k, inner) in list.iter().enumerate() {
                    self.step(&k.to_string(), inner, about)?;
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn look_into(&mut self, map: &Map<String, Value>, about: &About) -> Result<(), DrawingError> {
        let about = about.with(map);
        if let (Some(Value::Object(vertices)), Some(Value::Object(faces))) =
            (map.get("vertex"), map.get("face"))
        {
            let mesh = self.mesh(vertices, faces, about, map)?;
            self.meshes.push(mesh);
            if self.meshes.len() > MOST_SHAPES {
                let kind = DrawingErrorKind::TooMany { what: "meshes", limit: MOST_SHAPES };
                return Err(kind.at(&self.place(None)));
            }
            return Ok(());
        }
        for (key, inner) in in_order(map) {
            self.step(key, inner, &about)?;
        }
        Ok(())
    }

    fn step(&mut self, key: &str, inner: &Value, about: &About) -> Result<(), DrawingError> {
        self.path.push(shown(key));
        self.look(inner, about)?;
        self.path.pop();
        Ok(())
    }

    fn mesh(
        &self,
        vertices: &Map<String, Value>,
        faces: &Map<String, Value>,
        about: About,
        map: &Map<String, Value>,
    ) -> Result<Mesh, DrawingError> {
        let place = self.place(about.name.as_deref());
        let mut corners = Vec::with_capacity(vertices.len());
        let mut numbers = std::collections::BTreeMap::new();
        for (key, vertex) in in_order(vertices) {
            numbers.insert(key.as_str(), corners.len());
            corners.push(corner(vertex, key, &place)?);
        }
        let number = |key: &Value| {
            let key = key.as_str().map_or_else(|| key.to_string(), str::to_owned);
            let unknown = || DrawingErrorKind::UnknownCorner { corner: shown(&key) }.at(&place);
            numbers.get(key.as_str()).copied().ok_or_else(unknown)
        };
        let mut of_corners = Vec::with_capacity(faces.len());
        for (_, face) in in_order(faces) {
            let face = face.as_array().map_or(&[][..], Vec::as_slice);
            of_corners.push(face.iter().map(number).collect::<Result<_, _>>()?);
        }
        let material = map.get("attributes").and_then(|it| it.get("material")?.as_str());
        let layer = material.unwrap_or(MATERIAL).to_owned();
        let About { name, is_fixed } = about;
        Ok(Mesh { name, layer, is_fixed, place, corners, faces: of_corners })
    }

    fn place(&self, name: Option<&str>) -> Place {
        let name = name.map_or(String::new(), |name| format!("block \"{}\" at ", shown(name)));
        let path = if self.path.is_empty() { "the mesh".to_owned() } else { self.path.join(".") };
        Place::new(format!("{name}{path}"), None)
    }
}

impl About {
    /// Returns the data together with those of an inner object.
    fn with(&self, map: &Map<String, Value>) -> Self {
        let attributes = map.get("attributes").and_then(Value::as_object);
        let get = |key| map.get(key).or_else(|| attributes?.get(key));
        // Assemblies have names, too; the innermost name counts, except default names of classes.
        let name = get("name").and_then(Value::as_str).filter(|it| !is_class(it));
        Self {
            name: name.map(str::to_owned).or_else(|| self.name.clone()),
            is_fixed: self.is_fixed || get("is_support") == Some(&Value::Bool(true)),
        }
    }
}

/// Whether a name is that of a COMPAS class, which unnamed objects have as their name.
fn is_class(name: &str) -> bool {
    ["Assembly", "Block", "Graph", "Mesh", "Network", "Datastructure"].contains(&name)
}

fn corner(vertex: &Value, key: &str, place: &Place) -> Result<Point3<f64>, DrawingError> {
    let get = |axis| {
        vertex.get(axis).and_then(Value::as_f64).ok_or_else(|| {
            let message = format!("vertex {} has no number {axis}: save it again", shown(key));
            DrawingErrorKind::Syntax { message }.at(place)
        })
    };
    Ok(Point3::new(get("x")?, get("y")?, get("z")?))
}

/// Returns the entries of an object; numeric keys are sorted by value.
fn in_order(map: &Map<String, Value>) -> Vec<(&String, &Value)> {
    let mut entries: Vec<_> = map.iter().collect();
    entries.sort_by_key(|(key, _)| key.parse::<u64>().unwrap_or(u64::MAX));
    entries
}

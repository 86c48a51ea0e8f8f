//! Scenes made from drawings.

use masonry_drawing::{Drawing, DrawingFormat, Unit};
use masonry_import::{ImportOptions, Joints, import};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::failure::{SceneError, wrong};
use crate::scene::PyScene;
use crate::watch::detached;

/// Options of the import of a drawing; `None` stands for the default.
#[derive(FromPyObject)]
pub(crate) struct GivenImport {
    #[pyo3(item)]
    title: String,
    #[pyo3(item)]
    unit: Option<String>,
    #[pyo3(item)]
    scale: f64,
    #[pyo3(item)]
    tolerance: Option<f64>,
    #[pyo3(item)]
    thickness: Option<f64>,
    #[pyo3(item)]
    joints: Option<String>,
    #[pyo3(item)]
    density: Option<f64>,
    #[pyo3(item)]
    mu: Option<f64>,
    #[pyo3(item)]
    ignore: Vec<String>,
}

impl GivenImport {
    fn options(self) -> PyResult<ImportOptions> {
        let defaults = ImportOptions::default();
        let unit = self.unit.map(|symbol| {
            let names: Vec<&str> = Unit::ALL.iter().map(|unit| unit.symbol()).collect();
            let unknown = || unknown("unit", &symbol, &names);
            Unit::of_symbol(&symbol).ok_or_else(unknown)
        });
        let joints = self.joints.map(|name| match name.as_str() {
            "mortar" => Ok(Joints::Mortar),
            "close" => Ok(Joints::Close),
            "open" => Ok(Joints::Open),
            other => Err(unknown("joints", other, &["mortar", "close", "open"])),
        });
        Ok(ImportOptions {
            title: self.title,
            unit: unit.transpose()?,
            scale: self.scale,
            tolerance: self.tolerance,
            thickness: self.thickness,
            joints: joints.transpose()?,
            density: self.density.unwrap_or(defaults.density),
            mu: self.mu.unwrap_or(defaults.mu),
            ignore: self.ignore,
        })
    }
}

fn unknown(option: &str, given: &str, known: &[&str]) -> PyErr {
    let known = known.join(", ");
    PyValueError::new_err(format!("{option} is {given:?}, but must be one of: {known}"))
}

/// A scene made from a drawing.
#[pyclass(frozen)]
pub(crate) struct Imported {
    imported: masonry_import::Imported,
}

#[pymethods]
impl Imported {
    fn scene(&self) -> PyScene {
        PyScene { scene: self.imported.scene.clone() }
    }

    /// Returns the report: the changes, the parts left out, and the assumptions.
    fn report(&self) -> String {
        self.imported.report()
    }

    /// Returns the text of the scene file, with the report and the places in the drawing as comments.
    fn to_toml(&self) -> PyResult<String> {
        self.imported.to_toml().map_err(wrong)
    }

    /// Returns an SVG picture of the drawing with the imported blocks on top of it.
    fn picture(&self) -> String {
        self.imported.picture()
    }
}

/// Makes a scene from the bytes of a drawing, in the format of a file with the name `name`.
#[pyfunction]
pub(crate) fn import_drawing(
    py: Python<'_>,
    name: &str,
    bytes: &[u8],
    options: GivenImport,
) -> PyResult<Imported> {
    let options = options.options()?;
    let named = |error: &dyn std::fmt::Display| SceneError::new_err(format!("{name}: {error}"));
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
    let format = DrawingFormat::of_ending(ending).ok_or_else(|| {
        named(&"a drawing must be a .dxf, .svg, .obj or .json file: save it as one of these")
    })?;
    detached(py, || {
        let drawing = Drawing::read(bytes, format).map_err(|error| named(&error))?;
        let imported = import(&drawing, &options).map_err(|error| named(&error))?;
        Ok(Imported { imported })
    })?
}

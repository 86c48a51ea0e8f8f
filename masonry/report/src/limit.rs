//! A [limit load](masonry::analysis::limit) as text, JSON and pictures, and the ranges of reactions.

mod json;
mod table;

use std::path::{Path as Folder, PathBuf};

use nalgebra::Vector2;

pub use json::{json, json_both, range_json, thickness_json};
pub use table::{range_table, table, table_both, thickness_table};

use super::cases::Cases;
use super::svg::pictures::Pictures;
use super::svg::{self, Collapse, Growth};
use super::{OutputError, files, write_files};
use masonry::analysis::limit::{Limit, Path, Thickness};
use masonry::data::state::{PointState, Reaction};
use masonry::model::Model;

/// Writes the files of a limit load into `dir`, which is created if it does not exist: `forces.svg` and `mechanism.svg`
/// if forces and a mechanism were found; the same pictures for the path, with its curve; `train.svg` if the cases are
/// the positions of a train; and `limit.json`, which lists the pictures and has a line for each case.
///
/// # Errors
/// [`OutputError`] if the directory cannot be created, or files cannot be written.
pub fn write(
    limit: &Limit,
    cases: Option<&Cases>,
    dir: &Folder,
) -> Result<Vec<PathBuf>, OutputError> {
    let mut list = pictures(limit, false);
    list.extend(cases.and_then(Cases::curve).map(|it| Pictures::one("train.svg", it.to_owned())));
    let list = files(list).collect();
    let object = |names: &[String]| {
        let one = json(limit, names)?;
        cases.map_or_else(|| Ok(one.clone()), |cases| cases.json("limit", &one))
    };
    write_files(dir, list, Some("limit.json"), object)
}

/// Writes the pictures and the JSON object of the least thickness of an arch: the forces at the thickness at which the
/// arch stands, and the mechanism at the thickness at which it falls.
///
/// # Errors
/// As [`write()`].
pub fn write_thickness(thickness: &Thickness, dir: &Folder) -> Result<Vec<PathBuf>, OutputError> {
    let list = files(pictures_of_thickness(thickness, false)).collect();
    write_files(dir, list, Some("limit.json"), |names| thickness_json(thickness, names))
}

/// The result of a limit load by one law of friction.
pub(super) struct ByLaw<'a> {
    /// The name of the law of friction in titles.
    pub(super) of: &'static str,
    /// The names of the files with the pictures of forces and of the mechanism.
    files: [&'static str; 2],
    pub(super) model: &'a Model,
    load_factor: Option<f64>,
    pub(super) forces: Option<&'a [PointState]>,
    pub(super) mechanism: Option<&'a [Vec<Vector2<f64>>]>,
    pub(super) reactions: &'a [Reaction],
    pub(super) path: Option<&'a Path>,
}

/// Returns the results by all laws of friction that were chosen.
pub(super) fn by_law(limit: &Limit) -> impl DoubleEndedIterator<Item = ByLaw<'_>> {
    let associative = limit.associative.as_ref().map(|it| ByLaw {
        of: ", associative flow",
        files: ["forces.svg", "mechanism.svg"],
        model: &limit.model,
        load_factor: it.load_factor,
        forces: it.forces.as_deref(),
        mechanism: it.mechanism.as_deref(),
        reactions: &it.reactions,
        path: None,
    });
    let path = limit.path.as_ref().map(|it| ByLaw {
        of: ", path",
        files: ["path_forces.svg", "path_mechanism.svg"],
        model: &it.model,
        load_factor: it.load_factor,
        forces: it.contacts.as_deref(),
        mechanism: it.mechanism.as_deref(),
        reactions: &it.reactions,
        path: Some(it),
    });
    associative.into_iter().chain(path)
}

/// Returns the pictures of forces and mechanisms by all chosen laws, and the curve of the path.
pub(super) fn pictures(limit: &Limit, for_page: bool) -> Vec<Pictures> {
    let of_law = |ByLaw { of, files, model, load_factor, forces, mechanism, .. }: ByLaw<'_>| {
        let title = &format!("{}{of}", limit.title);
        let growth = load_factor.map(|factor| Growth { group: &limit.group, factor });
        let forces = forces.map(|it| svg::forces(title, model, it));
        let mechanism = mechanism
            .map(|rates| svg::collapse(&Collapse { title, model, rates, growth }, for_page));
        let found = files.into_iter().zip([forces, mechanism]);
        found.filter_map(|(file, picture)| Some(Pictures::one(file, picture?))).collect::<Vec<_>>()
    };
    let curve = limit.path.as_ref().and_then(|it| svg::path(&limit.title, &limit.group, it));
    let curve = curve.map(|it| Pictures::one("path.svg", it));
    by_law(limit).flat_map(of_law).chain(curve).collect()
}

/// Returns the picture of the forces in an arch at the thickness at which the arch stands, and of the mechanism at the
/// thickness at which it falls.
pub(super) fn pictures_of_thickness(thickness: &Thickness, for_page: bool) -> Vec<Pictures> {
    let Thickness { title, model, forces, mechanism, .. } = thickness;
    let forces = forces.as_ref().map(|it| svg::forces(title, model, it));
    let mechanism = mechanism.as_ref().map(|rates| {
        let title = &format!("{title}, at the largest thickness that is proved too small");
        svg::collapse(&Collapse { title, model, rates, growth: None }, for_page)
    });
    let forces = forces.map(|it| Pictures::one("forces.svg", it));
    forces.into_iter().chain(mechanism.map(|it| Pictures::one("mechanism.svg", it))).collect()
}

//! Bodies in space, projected into the plane of a wall: the cross-section of prisms that lie in one layer, or faces
//! that lie in one plane.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Point2, Point3, Vector3};

use super::{Drawing, DrawingError, DrawingErrorKind, Outline, Place};

/// The largest sine of an angle by which faces of a prism may differ from parallel, or from a right angle. Chosen: the
/// faces of blocks of 0.1 m whose corners are rounded to millimetres differ by a hundredth.
const TURNED: f64 = 1e-2;
/// The difference that the ends of blocks may have, divided by the depth of the blocks. Chosen: equal to [`TURNED`].
const UNEVEN: f64 = 1e-2;

/// Corners and faces of a body.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Mesh {
    pub(super) name: Option<String>,
    pub(super) layer: String,
    pub(super) is_fixed: bool,
    pub(super) place: Place,
    pub(super) corners: Vec<Point3<f64>>,
    /// The faces; each is a list of indices into `corners`.
    pub(super) faces: Vec<Vec<usize>>,
}

/// The plane in space into which a drawing is projected.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    right: Vector3<f64>,
    up: Vector3<f64>,
    /// The unit normal of the plane.
    across: Vector3<f64>,
}

/// Adds the projections of bodies with faces to a drawing, and returns the plane of projection: that of x and y if
/// there are no bodies.
///
/// # Errors
/// A body is not a prism perpendicular to one plane for all bodies.
pub(super) fn add(drawing: &mut Drawing, mut meshes: Vec<Mesh>) -> Result<Plane, DrawingError> {
    meshes.retain(|mesh| !mesh.faces.is_empty());
    if meshes.is_empty() {
        return Ok(Plane::GROUND);
    }
    if let Some(plane) = flat(&meshes) {
        meshes.iter().try_for_each(|mesh| add_faces(drawing, mesh, plane))?;
        return Ok(plane);
    }
    let plane = shared_plane(&meshes)?;
    let [from, to] = meshes[0].extent(plane.across);
    drawing.thickness = Some(to - from);
    for mesh in meshes {
        let corners =
            mesh.section(plane).ok_or_else(|| DrawingErrorKind::NotPlane.at(&mesh.place))?;
        let Mesh { name, layer, is_fixed, place, .. } = mesh;
        drawing.add_outline(Outline { corners, layer, name, is_fixed, place })?;
    }
    Ok(plane)
}

/// Adds each face of a flat mesh to the drawing as an outline.
fn add_faces(drawing: &mut Drawing, mesh: &Mesh, plane: Plane) -> Result<(), DrawingError> {
    for (number, face) in (1..).zip(&mesh.faces) {
        let corners = face.iter().map(|k| plane.project(mesh.corners[*k])).collect();
        let place = Place::new(format!("face {number} of {}", mesh.place.entity), mesh.place.line);
        let Mesh { layer, is_fixed, .. } = mesh.clone();
        drawing.add_outline(Outline { corners, layer, name: None, is_fixed, place })?;
    }
    Ok(())
}

/// Returns the plane in which all corners lie, if it is parallel to two axes; a horizontal plane is seen from above.
/// `None` if there is no such plane.
fn flat(meshes: &[Mesh]) -> Option<Plane> {
    let corners = || meshes.iter().flat_map(|mesh| &mesh.corners);
    let extent = |along: Vector3<f64>| extent(corners(), along);
    let [z, y, x] = [Vector3::z(), Vector3::y(), Vector3::x()];
    let planes = [
        Plane::GROUND,
        Plane { right: x, up: z, across: -y },
        Plane { right: y, up: z, across: x },
    ];
    let size = [x, y, z].map(extent).map(|[low, high]| high - low).into_iter().fold(0.0, f64::max);
    planes.into_iter().find(|plane| {
        let [low, high] = extent(plane.across);
        high - low <= f64::from(f32::EPSILON) * size
    })
}

/// Returns the upright plane to which all bodies are perpendicular prisms of the same depth. If there are two such
/// planes, returns the one that is seen along y.
fn shared_plane(meshes: &[Mesh]) -> Result<Plane, DrawingError> {
    /// The largest number of planes that are tried; they come from the faces of the first body. Chosen: stones have
    /// fewer faces.
    const MOST: usize = 64;
    let mut planes: Vec<Plane> = Vec::new();
    for normal in meshes[0].normals().filter(|normal| normal.z.abs() <= TURNED) {
        if planes.len() == MOST {
            break;
        }
        let plane = Plane::across(normal);
        if planes.iter().all(|other| other.across.cross(&plane.across).norm() > TURNED) {
            planes.push(plane);
        }
    }
    planes.sort_by(|a, b| b.across.y.abs().total_cmp(&a.across.y.abs()));
    let mut error = DrawingErrorKind::NotPlane.at(&meshes[0].place);
    let mut most = None;
    for plane in planes {
        let wrong = meshes.iter().position(|mesh| !mesh.is_prism(plane.across));
        let uneven = wrong.map_or_else(|| uneven(meshes, plane), |_| None);
        let Some(at) = wrong.or(uneven) else { return Ok(plane) };
        // The error that is shown is that of the plane that fits most bodies.
        if most < Some((wrong.is_none(), at)) {
            most = Some((wrong.is_none(), at));
            let [from, to] = meshes[at].extent(plane.across);
            let kind = match wrong {
                Some(_) => DrawingErrorKind::NotPlane,
                None => DrawingErrorKind::NotOneLayer { from, to },
            };
            error = kind.at(&meshes[at].place);
        }
    }
    Err(error)
}

/// Returns the index of the first body whose ends perpendicular to the plane differ from those of body 0; `None` if
/// there is no such body.
fn uneven(meshes: &[Mesh], plane: Plane) -> Option<usize> {
    let [from, to] = meshes[0].extent(plane.across);
    meshes.iter().position(|mesh| {
        let [near, far] = mesh.extent(plane.across);
        (near - from).abs().max((far - to).abs()) > UNEVEN * (to - from)
    })
}

fn extent<'a>(corners: impl Iterator<Item = &'a Point3<f64>>, along: Vector3<f64>) -> [f64; 2] {
    corners
        .map(|it| it.coords.dot(&along))
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], s| [a.min(s), b.max(s)])
}

impl Plane {
    /// The plane of x and y, seen from above.
    const GROUND: Self = Self {
        right: Vector3::new(1.0, 0.0, 0.0),
        up: Vector3::new(0.0, 1.0, 0.0),
        across: Vector3::new(0.0, 0.0, 1.0),
    };

    /// Returns the upright plane with this normal; its x axis points to the right if that is possible.
    fn across(normal: Vector3<f64>) -> Self {
        let right = Vector3::new(-normal.y, normal.x, 0.0).normalize();
        let is_back = if right.x.abs() > TURNED { right.x < 0.0 } else { right.y < 0.0 };
        let right = if is_back { -right } else { right };
        Self { right, up: Vector3::z(), across: right.cross(&Vector3::z()) }
    }

    pub(super) fn project(self, point: Point3<f64>) -> Point2<f64> {
        Point2::new(point.coords.dot(&self.right), point.coords.dot(&self.up))
    }
}

impl Mesh {
    /// Returns the unit normals of the faces whose area is not zero.
    fn normals(&self) -> impl Iterator<Item = Vector3<f64>> {
        self.faces.iter().filter_map(|face| self.normal(face))
    }

    fn normal(&self, face: &[usize]) -> Option<Vector3<f64>> {
        let first = self.corners[*face.first()?];
        let sides: Vec<_> = face.iter().map(|k| self.corners[*k] - first).collect();
        let sum = sides.windows(2).map(|pair| pair[0].cross(&pair[1]));
        sum.fold(Vector3::zeros(), |sum, it| sum + it).try_normalize(0.0)
    }

    /// Whether each face is parallel to the direction `across`, or lies at one of the two ends of the body in this
    /// direction.
    fn is_prism(&self, across: Vector3<f64>) -> bool {
        let [from, to] = self.extent(across);
        let is_at_end = |k: &usize| {
            let at = self.corners[*k].coords.dot(&across);
            (at - from).min(to - at) <= UNEVEN * (to - from)
        };
        self.faces.iter().all(|face| {
            self.normal(face).is_none_or(|normal| {
                let is_end = normal.cross(&across).norm() <= TURNED && face.iter().all(is_at_end);
                is_end || normal.dot(&across).abs() <= TURNED
            })
        })
    }

    fn extent(&self, along: Vector3<f64>) -> [f64; 2] {
        extent(self.corners.iter(), along)
    }

    /// Returns, for each corner, the index of the first corner at the same place: some programs give every face its own
    /// corners.
    fn welded(&self) -> Vec<usize> {
        let mut first = BTreeMap::new();
        let key = |it: &Point3<f64>| [it.x, it.y, it.z].map(f64::to_bits);
        let corners = self.corners.iter().enumerate();
        corners.map(|(k, corner)| *first.entry(key(corner)).or_insert(k)).collect()
    }

    /// Returns the outline of the faces at one end of a prism; `None` if these faces have more than one outline.
    fn section(&self, plane: Plane) -> Option<Vec<Point2<f64>>> {
        let caps = self.faces.iter().filter(|face| {
            self.normal(face).is_some_and(|normal| normal.dot(&plane.across) > 1.0 - TURNED)
        });
        let same = self.welded();
        let mut sides = BTreeSet::new();
        for face in caps {
            for (k, from) in face.iter().enumerate() {
                let (from, to) = (same[*from], same[face[(k + 1) % face.len()]]);
                // A side that two faces share lies inside the outline.
                if !sides.remove(&(to, from)) {
                    sides.insert((from, to));
                }
            }
        }
        let count = sides.len();
        let mut sides: BTreeMap<usize, usize> = sides.into_iter().collect();
        if sides.len() < count {
            return None;
        }
        let (&first, _) = sides.first_key_value()?;
        let mut corners = Vec::new();
        let mut at = first;
        while let Some(next) = sides.remove(&at) {
            corners.push(plane.project(self.corners[at]));
            at = next;
        }
        (at == first && sides.is_empty()).then_some(corners)
    }
}

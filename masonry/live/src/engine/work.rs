//! Tasks that take longer than a solve: limit loads, ranges, least thicknesses, studies.

use std::fmt;
use std::ops::ControlFlow;

use masonry::analysis::limit::{growing, train_observed};
use masonry::analysis::study::{self, StudyProgress};
use masonry::scene::Combined;
use masonry::{
    Bracket, Laws, Limit, LimitError, Scene, least_thickness_observed, limit_observed,
    ranges_observed,
};
use masonry_report::cases::Cases;
use masonry_report::{limit as output, page, study as study_output, svg};
use serde::Serialize;

use super::fault::Fault;
use super::watch::Watch;

/// The result of a task.
#[derive(Debug, Serialize)]
pub(super) struct Found {
    sentence: String,
    pictures: Vec<Picture>,
    /// The tables in HTML.
    tables: String,
    /// The report as text.
    text: String,
}

#[derive(Debug, Serialize)]
struct Picture {
    name: String,
    picture: String,
}

impl Found {
    /// Creates a result without tables; pictures that are `None` are left out.
    pub(super) fn new(
        sentence: &str,
        pictures: Vec<(impl Into<String>, Option<String>)>,
        text: String,
    ) -> Self {
        let sentence = sentence.to_owned();
        let drawn = |(name, picture)| {
            let name: String = Into::into(name);
            Some(Picture { name, picture: picture? })
        };
        let pictures = pictures.into_iter().filter_map(drawn).collect();
        Self { sentence, pictures, tables: String::new(), text }
    }
}

/// Computes the limit load of a scene; that of the governing combination if there are combinations.
pub(super) fn limit(scene: &Scene, law: Laws, watch: &mut Watch<'_>) -> Result<Found, Fault> {
    if scene.combinations.is_empty() {
        let limit = limit_observed(scene, law, &mut |at| watch(&Known(at)))?;
        return Ok(of_limit(&limit, None));
    }
    let group = growing(scene)?;
    let (mut list, mut failed) = (Vec::new(), Vec::new());
    for Combined { name, of } in scene.combined() {
        if !of.acts(&group) {
            continue;
        }
        let of = of.limit_group(&group);
        let mut observe = |at| watch(&format_args!("combination \"{name}\": {}", Known(at)));
        match limit_observed(&of, law, &mut observe) {
            Ok(of) => list.push(Combined { name, of }),
            Err(error) => failed.push(format!("Combination \"{name}\" has no answer: {error}. ")),
        }
        if list.last().is_some_and(|it| it.of.is_interrupted) {
            break;
        }
    }
    let Some(cases) = Cases::of_limits(&mut list) else {
        let none = format!(
            "\"{group}\" acts in no combination: name it in one, or another `group` in [limit]"
        );
        return Err(Fault::new(&if failed.is_empty() { none } else { failed.concat() }));
    };
    let mut found = of_limit(&list[cases.governs()].of, Some(&cases));
    found.sentence = failed.concat() + &found.sentence;
    Ok(found)
}

/// Computes the limit load of the train of the scene at the governing position.
pub(super) fn train(scene: &Scene, law: Laws, watch: &mut Watch<'_>) -> Result<Found, LimitError> {
    let crossing = train_observed(scene, law, &mut |at| watch(&Known(at)))?;
    Ok(of_limit(&crossing.limit, Some(&Cases::of_train(&crossing))))
}

/// Returns the result for a limit load, with the table of all cases if the limit load governs several.
fn of_limit(limit: &Limit, cases: Option<&Cases>) -> Found {
    let (title, mut pictures) = (limit.title.as_str(), Vec::new());
    if let Some(path) = &limit.path {
        let rates = path.mechanism.as_ref();
        pictures.extend([
            ("Mechanism", rates.map(|it| svg::mechanism(title, &path.model, it))),
            ("Forces", path.contacts.as_ref().map(|it| svg::forces(title, &path.model, it))),
            ("Path", svg::path(title, &limit.group, path)),
        ]);
    }
    if let Some(found) = &limit.associative {
        let rates = found.mechanism.as_ref();
        let forces = found.forces.as_ref();
        pictures.extend([
            ("Mechanism, associative", rates.map(|it| svg::mechanism(title, &limit.model, it))),
            ("Forces, associative", forces.map(|it| svg::forces(title, &limit.model, it))),
        ]);
    }
    pictures.extend(cases.map(|it| ("Positions", it.curve().map(str::to_owned))));
    let sentence = match cases {
        Some(cases) => format!("{}: {}", cases.governing(), limit.sentence),
        None => limit.sentence.clone(),
    };
    let head = cases.map_or_else(String::new, Cases::head);
    Found {
        tables: page::limit_tables(limit, cases),
        ..Found::new(&sentence, pictures, head + &output::table(limit))
    }
}

pub(super) fn range(scene: &Scene, watch: &mut Watch<'_>) -> Result<Found, LimitError> {
    let range =
        ranges_observed(scene, &mut |at| watch(&format_args!("iteration {}", at.iteration)))?;
    Ok(Found::new(&range.sentence, Vec::<(String, _)>::new(), output::range_table(&range)))
}

pub(super) fn thickness(
    scene: &Scene,
    arch: &str,
    watch: &mut Watch<'_>,
) -> Result<Found, LimitError> {
    let found = least_thickness_observed(scene, arch, &mut |at| watch(&Known(at)))?;
    let (title, model) = (&found.title, &found.model);
    let pictures = vec![
        ("Mechanism", found.mechanism.as_ref().map(|it| svg::mechanism(title, model, it))),
        ("Forces", found.forces.as_ref().map(|it| svg::forces(title, model, it))),
    ];
    Ok(Found {
        tables: page::thickness_tables(&found),
        ..Found::new(&found.sentence, pictures, output::thickness_table(&found))
    })
}

pub(super) fn study(scene: &Scene, watch: &mut Watch<'_>) -> Result<Found, Fault> {
    let mut observe = |at: StudyProgress| -> ControlFlow<()> {
        watch(&format_args!("{} to {:e}, mesh {}", at.route.name(), at.tolerance, at.mesh))
    };
    let settings = study::Settings::default();
    let study = study::study(scene, &settings, &mut observe).map_err(|it| Fault::new(&it))?;
    let pictures = vec![("Accuracy", study_output::accuracy(&study))];
    let sentence = study_output::in_short(&study).unwrap_or_default();
    Ok(Found::new(&sentence, pictures, study_output::table(&study)))
}

/// The bounds of a limit load that are known during its search.
struct Known(Bracket);

impl fmt::Display for Known {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Bracket { stands, falls } = self.0;
        match (stands, falls) {
            (None, None) => f.write_str("searching"),
            (Some(stands), None) => write!(f, "stands at {stands:.5}"),
            (None, Some(falls)) => write!(f, "falls at {falls:.5}"),
            (Some(stands), Some(falls)) => {
                write!(f, "stands at {stands:.5}, falls at {falls:.5}")
            }
        }
    }
}

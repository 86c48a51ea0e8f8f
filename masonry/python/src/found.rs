//! Results of analyses for Python: plans, limit loads, ranges of reactions, least thicknesses, studies.

use masonry::analysis::limit::{CrossingTrain, Directions};
use masonry::analysis::study::Study;
use masonry::{Plan, Range, Thickness};
use masonry_report::cases::Cases;
use masonry_report::{self as report, page};
use pyo3::prelude::*;

use crate::failure::failed;

/// The result of an analysis as text, as JSON and, if it has one, as a page.
#[pyclass(frozen, get_all)]
pub(crate) struct Found {
    text: String,
    json: String,
    page: Option<String>,
}

impl Found {
    pub(crate) fn plan(plan: &Plan) -> PyResult<Self> {
        let json = serde_json::to_string(plan).map_err(failed)?;
        Ok(Self { text: report::table::plan(plan), json, page: None })
    }

    pub(crate) fn limit(limit: &masonry::Limit) -> PyResult<Self> {
        let json = report::limit::json(limit, &[]).map_err(failed)?;
        Ok(Self { text: report::limit::table(limit), json, page: Some(page::limit(limit, None)) })
    }

    pub(crate) fn directions(both: &Directions) -> PyResult<Self> {
        let json = report::limit::json_both(both, &[]).map_err(failed)?;
        let page = Some(page::limit(both.governing(), None));
        Ok(Self { text: report::limit::table_both(both), json, page })
    }

    pub(crate) fn train(crossing: &CrossingTrain) -> PyResult<Self> {
        let (limit, cases) = (&crossing.limit, Cases::of_train(crossing));
        let object = report::limit::json(limit, &[]).map_err(failed)?;
        let json = cases.json("limit", &object).map_err(failed)?;
        let text = cases.head() + &report::limit::table(limit);
        Ok(Self { text, json, page: Some(page::limit(limit, Some(&cases))) })
    }

    pub(crate) fn range(range: &Range) -> PyResult<Self> {
        let json = report::limit::range_json(range).map_err(failed)?;
        Ok(Self { text: report::limit::range_table(range), json, page: None })
    }

    pub(crate) fn thickness(thickness: &Thickness) -> PyResult<Self> {
        let json = report::limit::thickness_json(thickness, &[]).map_err(failed)?;
        let page = Some(page::thickness(thickness));
        Ok(Self { text: report::limit::thickness_table(thickness), json, page })
    }
}

/// The result of a study.
#[pyclass(frozen)]
pub(crate) struct Studied {
    pub(crate) study: Study,
}

#[pymethods]
impl Studied {
    fn report(&self) -> String {
        report::study::table(&self.study)
    }

    fn json(&self) -> PyResult<String> {
        report::study::json(&self.study, &[]).map_err(failed)
    }

    /// Returns the records of the study as CSV.
    fn records(&self) -> String {
        report::study::csv(&self.study)
    }

    /// Draws the algebraic errors of the study against the times as SVG; `None` if no error is known.
    fn picture(&self) -> Option<String> {
        report::study::accuracy(&self.study)
    }
}

//! The report as one page of HTML, which opens without a network. The page has the verdict, key figures, pictures to
//! choose from with a slider for the step and one for the scale of displacements, and tables that can be sorted.
//!
//! The pictures are the same as in the files. Every element in pictures of displacements carries its undeformed place,
//! so that the page can change the magnification. Without scripts, and on paper, all pictures are shown one below the
//! other.
//!
//! The hash of the page's address chooses the picture that is seen first, such as `#picture=deformed&step=3&scale=0.5`.

mod limit;
mod solved;
mod tables;

pub use limit::{limit, tables as limit_tables, thickness, thickness_tables};
pub use solved::{is_framed, solved, tables};

use super::figures::Said;
use super::format::significant;
use super::svg::pictures::Pictures;
use super::svg::{self, counted, escaped};
use masonry::analysis::outcome::PhaseTime;
use masonry::model::Model;

const STYLE: &str = include_str!("page/page.css");
const SCRIPT: &str = include_str!("page/page.js");

/// Files of pictures and the names of their switches on the page, in this order. The first file that exists is shown
/// first.
const CHOICES: [(&str, &str); 8] = [
    ("path_mechanism.svg", "Mechanism, path"),
    ("mechanism.svg", "Mechanism"),
    ("path_forces.svg", "Forces, path"),
    ("forces.svg", "Forces"),
    ("principal_stresses.svg", "Stresses"),
    ("cracks.svg", "Cracks"),
    ("deformed.svg", "Deformed"),
    ("scene.svg", "Scene"),
];

/// The contents of a page.
#[derive(Debug)]
struct Page {
    title: String,
    /// `stands`, `falls` or `undecided`: determines the colour of the head of the page.
    verdict: &'static str,
    sentence: String,
    warnings: Vec<String>,
    /// The names and values of the key figures.
    figures: Vec<Said>,
    /// Pictures of all kinds; pictures whose file is not in [`CHOICES`] are curves, which are always shown.
    pictures: Vec<Pictures>,
    /// The steps of a load history that have pictures; at most one without a history.
    steps: Vec<PictureStep>,
    /// HTML of the tables, one below the other.
    tables: String,
    /// The report as text.
    text: String,
}

/// A step of a load history that has pictures.
#[derive(Debug)]
struct PictureStep {
    name: String,
    /// The index of the step among all steps, from zero; the curves show all steps.
    position: usize,
}

/// Pictures of one kind on a page, one of which is seen: one picture for every step, or one for all steps.
struct Choice<'a> {
    /// The name of the picture in the hash of the page's address.
    key: &'a str,
    /// The name on the switch of the picture.
    name: &'a str,
    pictures: &'a [String],
}

impl Page {
    /// Returns the HTML text of the page.
    fn finish(&self) -> String {
        let title = escaped(&self.title);
        let is_choice = |it: &&Pictures| CHOICES.iter().any(|(file, _)| *file == it.file);
        let curves = self.pictures.iter().filter(|it| !is_choice(it)).flat_map(|it| &it.pictures);
        let curve = |it: &String| {
            format!(
                "<figure class=\"curves\">
{}</figure>
",
                bare(it)
            )
        };
        let curves: Vec<String> = curves.map(curve).collect();
        let body = [
            self.header(),
            self.key_figures(),
            self.choices(),
            curves.concat(),
            self.tables.clone(),
            format!(
                "<details>\n<summary>Report as text</summary>\n<pre>{}</pre>\n</details>\n",
                text_of(&self.text)
            ),
        ]
        .concat();
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
             style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n{}</head>\n<body>\n{body}\
             <script>\n{SCRIPT}</script>\n</body>\n</html>\n",
            svg::STYLE
        )
    }

    fn header(&self) -> String {
        let (verdict, title) = (self.verdict, escaped(&self.title));
        let sentence = escaped(&self.sentence);
        let warning = |it: &String| format!("<p class=\"warning\">{}</p>\n", escaped(it));
        let warnings: String = self.warnings.iter().map(warning).collect();
        format!(
            "<header class=\"{verdict}\">\n<p class=\"scene\">{title}</p>\n<h1>{sentence}</h1>\n{warnings}</header>\n"
        )
    }

    fn key_figures(&self) -> String {
        let figure = |(name, value): &Said| {
            let (name, value) = (escaped(name), escaped(value));
            format!("<div><dt>{name}</dt><dd>{value}</dd></div>\n")
        };
        let figures: String = self.figures.iter().map(figure).collect();
        format!("<dl class=\"figures\">\n{figures}</dl>\n")
    }

    /// Returns the HTML of the pictures to choose from, below their switches and sliders.
    fn choices(&self) -> String {
        let choices: Vec<Choice<'_>> = CHOICES
            .iter()
            .filter_map(|(file, name)| {
                let pictures = &self.pictures.iter().find(|it| it.file == *file)?.pictures;
                Some(Choice { key: file.trim_end_matches(".svg"), name, pictures })
            })
            .collect();
        if choices.is_empty() {
            return String::new();
        }
        let switch = |Choice { key, name, .. }: &Choice<'_>| {
            format!("<button type=\"button\" data-picture=\"{key}\">{name}</button>\n")
        };
        let switches: String = choices.iter().map(switch).collect();
        let steps = match self.steps.len() {
            0 | 1 => String::new(),
            steps => {
                let last = steps - 1;
                format!(
                    "<label id=\"steps\">step <input id=\"step\" type=\"range\" min=\"0\" max=\"{last}\" step=\"1\" \
                     value=\"{last}\"> <output></output></label>\n"
                )
            }
        };
        let figures: String = choices.iter().map(|it| self.figure(it)).collect();
        format!(
            "<section id=\"pictures\">\n<div class=\"controls\">\n\
             <div id=\"switches\" role=\"group\" aria-label=\"picture\">\n{switches}</div>\n{steps}\
             <label id=\"scales\">displacements <input id=\"scale\" type=\"range\" min=\"0\" max=\"2\" \
             step=\"0.01\" value=\"1\"> <output></output></label>\n</div>\n{figures}</section>\n"
        )
    }

    /// Returns the HTML of the pictures of one kind.
    fn figure(&self, Choice { key, name, pictures }: &Choice<'_>) -> String {
        let frame = |(index, picture): (usize, &String)| {
            let step = self.steps.get(index).filter(|_| pictures.len() > 1);
            let attributes = step.map_or_else(String::new, |step| {
                let (position, name) = (step.position, escaped(&step.name));
                format!(" data-step=\"{index}\" data-position=\"{position}\" data-name=\"{name}\"")
            });
            format!("<div class=\"frame\"{attributes}>\n{}</div>\n", bare(picture))
        };
        let frames: String = pictures.iter().enumerate().map(frame).collect();
        format!("<figure data-picture=\"{key}\" aria-label=\"{name}\">\n{frames}</figure>\n")
    }
}

/// Returns the numbers of blocks and joints, in words.
fn size(model: &Model) -> String {
    let (blocks, joints) = (model.blocks.len(), model.joints.len());
    format!("{}, {}", counted(blocks, "block"), counted(joints, "joint"))
}

/// Returns the total time of all phases, in words.
fn taken(times: &[PhaseTime]) -> String {
    let seconds: f64 = times.iter().map(|it| it.seconds).sum();
    format!("{} s", significant(seconds, 2))
}

/// Returns a picture without its style sheet, which the page has only once.
fn bare(picture: &str) -> String {
    picture.replacen(svg::STYLE, "", 1)
}

/// Returns a text as HTML that keeps its line breaks.
fn text_of(text: &str) -> String {
    text.lines().map(|line| escaped(line) + "\n").collect()
}

//! The report as one page of HTML, which opens without a network: verdict, key figures, pictures to choose from with a
//! slider for the step and one for the scale of displacements, and tables that can be sorted.
//!
//! Pictures are those of the files. In pictures of displacements every element knows where it was before, so that the
//! page itself can magnify them otherwise. Without scripts, and on paper, everything is there, one below the other.
//!
//! The hash of the address chooses what is seen first, such as `#picture=deformed&step=3&scale=0.5`.

mod limit;
mod solved;
mod tables;

pub use limit::{limit, thickness};
pub use solved::{is_framed, solved};
use tables::Table;

use super::svg::escaped;

const STYLE: &str = include_str!("page/page.css");
const SCRIPT: &str = include_str!("page/page.js");

/// What a page shows.
#[derive(Debug, Default)]
struct Page {
    title: String,
    /// `stands`, `falls` or `undecided`: the colour of the verdict.
    verdict: &'static str,
    sentence: String,
    warnings: Vec<String>,
    /// Names and values.
    figures: Vec<(String, String)>,
    pictures: Vec<Choice>,
    /// The steps that pictures have, by their names; empty or one without a history.
    steps: Vec<Step>,
    /// Curves, always seen.
    curves: Option<String>,
    tables: Vec<Table>,
    /// The report as text.
    text: String,
}

/// A step that has pictures.
#[derive(Debug)]
struct Step {
    name: String,
    /// Its position among all steps, from zero: the curves have them all.
    position: usize,
}

/// Pictures of one kind, of which one is seen: one for every step, or one for all.
#[derive(Debug)]
struct Choice {
    /// In the address of the page.
    key: String,
    /// On the switch.
    name: String,
    pictures: Vec<String>,
}

impl Choice {
    fn one(key: &str, name: &str, picture: String) -> Self {
        Self { key: key.to_owned(), name: name.to_owned(), pictures: vec![picture] }
    }
}

impl Page {
    /// The text of the file.
    fn finish(&self) -> String {
        let title = escaped(&self.title);
        let mut body = format!(
            "<header class=\"{}\">\n<p class=\"scene\">{title}</p>\n<h1>{}</h1>\n",
            self.verdict,
            escaped(&self.sentence)
        );
        for warning in &self.warnings {
            body += &format!("<p class=\"warning\">{}</p>\n", escaped(warning));
        }
        body += "</header>\n";
        if !self.figures.is_empty() {
            body += "<dl class=\"figures\">\n";
            for (name, value) in &self.figures {
                let (name, value) = (escaped(name), escaped(value));
                body += &format!("<div><dt>{name}</dt><dd>{value}</dd></div>\n");
            }
            body += "</dl>\n";
        }
        body += &self.pictures();
        if let Some(curves) = &self.curves {
            body += &format!("<figure class=\"curves\">\n{curves}</figure>\n");
        }
        self.tables.iter().for_each(|table| body += &table.html());
        body += &format!(
            "<details>\n<summary>Report as text</summary>\n<pre>{}</pre>\n</details>\n",
            text_of(&self.text)
        );
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
             style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{body}\
             <script>\n{SCRIPT}</script>\n</body>\n</html>\n"
        )
    }

    /// The switches and sliders, and the pictures that they choose from.
    fn pictures(&self) -> String {
        if self.pictures.is_empty() {
            return String::new();
        }
        let mut text = "<section id=\"pictures\">\n<div class=\"controls\">\n".to_owned();
        text += "<div id=\"switches\" role=\"group\" aria-label=\"picture\">\n";
        for Choice { key, name, .. } in &self.pictures {
            text += &format!("<button type=\"button\" data-picture=\"{key}\">{name}</button>\n");
        }
        text += "</div>\n";
        if self.steps.len() > 1 {
            let last = self.steps.len() - 1;
            text += &format!(
                "<label id=\"steps\">step <input id=\"step\" type=\"range\" min=\"0\" max=\"{last}\" step=\"1\" \
                 value=\"{last}\"> <output></output></label>\n"
            );
        }
        text += "<label id=\"scales\">displacements <input id=\"scale\" type=\"range\" min=\"0\" max=\"2\" \
                 step=\"0.01\" value=\"1\"> <output></output></label>\n</div>\n";
        for Choice { key, name, pictures } in &self.pictures {
            text += &format!("<figure data-picture=\"{key}\" aria-label=\"{name}\">\n");
            for (index, picture) in pictures.iter().enumerate() {
                let step = self.steps.get(index).filter(|_| pictures.len() > 1);
                let attributes = step.map_or_else(String::new, |step| {
                    format!(
                        " data-step=\"{index}\" data-position=\"{}\" data-name=\"{}\"",
                        step.position,
                        escaped(&step.name)
                    )
                });
                text += &format!("<div class=\"frame\"{attributes}>\n{picture}</div>\n");
            }
            text += "</figure>\n";
        }
        text + "</section>\n"
    }
}

/// Text in which lines stay lines.
fn text_of(text: &str) -> String {
    text.lines().map(|line| escaped(line) + "\n").collect()
}

//! `masonry import`: makes a scene from a drawing.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use crate::end::{Failure, MARK, SOLVED, is_same, keep_foreign, listing, print};
use masonry::files::{read_bounded, write_atomically};
use masonry_drawing::{Drawing, DrawingFormat, LARGEST_FILE, Unit};
use masonry_import::{ImportOptions, Joints, import};

#[derive(Debug, Args)]
pub(super) struct ImportArgs {
    /// The drawing: DXF, SVG, OBJ, or JSON (COMPAS, or a list of blocks).
    file: PathBuf,
    /// The scene file; by default it is printed.
    #[arg(long)]
    out: Option<PathBuf>,
    /// A picture (SVG) of the drawing under the blocks.
    #[arg(long)]
    picture: Option<PathBuf>,
    /// Distance up to which corners and edges are joined [m]; by default a part of the shortest edge.
    #[arg(long)]
    tolerance: Option<f64>,
    /// The unit of the drawing, instead of the unit in the file.
    #[arg(long, value_enum)]
    unit: Option<UnitName>,
    /// A factor of all lengths.
    #[arg(long, default_value_t = 1.0)]
    scale: f64,
    /// Thickness out of the plane [m].
    #[arg(long)]
    thickness: Option<f64>,
    /// The treatment of joints that are drawn open.
    #[arg(long, value_enum)]
    joints: Option<JointsName>,
    /// Density of the blocks [kg/m3].
    #[arg(long, default_value_t = ImportOptions::default().density)]
    density: f64,
    /// Coefficient of friction of all joints.
    #[arg(long, default_value_t = ImportOptions::default().mu)]
    mu: f64,
    /// A layer that is left out; may be given several times.
    #[arg(long, value_name = "LAYER")]
    ignore: Vec<String>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum UnitName {
    Mm,
    Cm,
    M,
    In,
    Ft,
    Km,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum JointsName {
    /// Gaps of one width are filled with mortar.
    Mortar,
    /// Blocks grow until they meet.
    Close,
    /// Gaps stay.
    Open,
}

pub(super) fn run(args: &ImportArgs) -> Result<u8, Failure> {
    for (file, option) in [(&args.out, "--out"), (&args.picture, "--picture")] {
        if let Some(file) = file.as_ref().filter(|file| is_same(file, &args.file)) {
            let file = file.display();
            return Err(format!("{file} is the drawing: choose another {option}").into());
        }
        file.iter().try_for_each(|file| keep_foreign(file, option))?;
    }
    let name = args.file.display();
    let of_file = |error: &dyn std::error::Error| format!("{name}: {error}");
    let drawing = read(&args.file)?;
    let imported = import(&drawing, &args.options()).map_err(|error| of_file(&error))?;
    let text = imported.to_toml()?;
    let mut written = Vec::new();
    let marked = [
        (&args.out, format!("# {MARK}\n{text}")),
        (&args.picture, format!("{}<!-- {MARK} -->\n", imported.picture())),
    ];
    for (file, text) in marked {
        if let Some(file) = file {
            write_atomically(file, text.as_bytes())
                .map_err(|error| format!("cannot write {}: {error}", file.display()))?;
            written.push(file.clone());
        }
    }
    // The text of a printed scene has the report at its top, so that the report is not printed again.
    let shown = if args.out.is_some() { imported.report() + &listing(&written) } else { text };
    print(&shown)?;
    Ok(SOLVED)
}

fn read(path: &Path) -> Result<Drawing, Failure> {
    let name = path.display();
    let ending = path.extension().map_or_else(String::new, |it| it.to_string_lossy().into_owned());
    let format = DrawingFormat::of_ending(&ending).ok_or_else(|| {
        format!(
            "{name}: a drawing must be a .dxf, .svg, .obj or .json file: save it as one of these"
        )
    })?;
    let bytes =
        read_bounded(path, LARGEST_FILE).map_err(|error| format!("cannot read {name}: {error}"))?;
    Ok(Drawing::read(&bytes, format).map_err(|error| format!("{name}: {error}"))?)
}

impl ImportArgs {
    fn options(&self) -> ImportOptions {
        let title =
            self.file.file_stem().map_or_else(String::new, |it| it.to_string_lossy().into());
        ImportOptions {
            title,
            unit: self.unit.map(UnitName::unit),
            scale: self.scale,
            tolerance: self.tolerance,
            thickness: self.thickness,
            joints: self.joints.map(JointsName::joints),
            density: self.density,
            mu: self.mu,
            ignore: self.ignore.clone(),
        }
    }
}

impl UnitName {
    fn unit(self) -> Unit {
        match self {
            Self::Mm => Unit::Millimetre,
            Self::Cm => Unit::Centimetre,
            Self::M => Unit::Metre,
            Self::In => Unit::Inch,
            Self::Ft => Unit::Foot,
            Self::Km => Unit::Kilometre,
        }
    }
}

impl JointsName {
    fn joints(self) -> Joints {
        match self {
            Self::Mortar => Joints::Mortar,
            Self::Close => Joints::Close,
            Self::Open => Joints::Open,
        }
    }
}

//! Whatever the content of a file, it is a drawing or refused; a drawing is imported or refused, and what is imported is a scene
//! that reads back.

#![no_main]

use libfuzzer_sys::fuzz_target;

use masonry_drawing::{Drawing, DrawingFormat};
use masonry_import::{ImportOptions, import};

fuzz_target!(|content: &[u8]| {
    for format in [DrawingFormat::Dxf, DrawingFormat::Svg, DrawingFormat::Obj, DrawingFormat::Json] {
        let Ok(drawing) = Drawing::read(content, format) else { continue };
        let Ok(imported) = import(&drawing, &ImportOptions::default()) else { continue };
        assert!(!imported.picture().contains("NaN"));
        imported.to_toml().expect("what was imported is written");
    }
});

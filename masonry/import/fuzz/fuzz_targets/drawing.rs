//! Whatever the content of a file, it is a drawing or refused; a drawing is imported or refused, and what is imported is a scene
//! that reads back.

#![no_main]

use libfuzzer_sys::fuzz_target;

use masonry_drawing::{Drawing, Format};
use masonry_import::{Options, import};

fuzz_target!(|content: &[u8]| {
    for format in [Format::Dxf, Format::Svg, Format::Obj, Format::Json] {
        let Ok(drawing) = Drawing::read(content, format) else { continue };
        let Ok(imported) = import(&drawing, &Options::default()) else { continue };
        assert!(!imported.picture().contains("NaN"));
        imported.to_toml().expect("what was imported is written");
    }
});

//! The square panel, phase by phase: what each stage of the pipeline costs.
//!
//! `cargo bench --bench panel`. The first line of every group is a dense factorisation of the order
//! of the general problem, against which the phases can be read on any machine.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use faer::Mat;
use masonry::forms::reduction::Reduction;
use masonry::forms::{DenseForm, FormKind};
use masonry::method::Request;
use masonry::method::lemke::Pivots;
use masonry::model::Model;
use masonry::plan::Plan;
use masonry::recover::recover;
use masonry::scene::{self, Scene};
use masonry::system::System;
use masonry::verify::checks::Checks;
use masonry_report::svg;

fn panel(c: &mut Criterion) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/panel_square.toml");
    let scene = Scene::read(&path).expect("the scene is part of the repository");
    let model = Model::from_scene(&scene).expect("the scene is sound");
    let system = System::new(&model).expect("the blocks are sound");
    let reduction = Reduction::new(&system, None).expect("no block is free");
    let request = Request { form: scene::Form::Mixed, ..Request::new(1e-10) };
    let solve = || {
        let pivots = Pivots { system: &system, reduction: &reduction, start: None };
        pivots.solve(&request, &mut |_| ControlFlow::Continue(())).expect("the problem is finite")
    };
    let rows = solve().rows.expect("the panel stands");
    let state = recover(&model, &system, &reduction, &rows, true);
    let order = Plan::of(&scene, &model).order;
    let yardstick = Mat::from_fn(order, order, |i, j| f64::from(u8::from(i == j)) + wave(i, j));

    let mut group = c.benchmark_group("panel_square");
    group.sample_size(10).warm_up_time(Duration::from_secs(1));
    group.measurement_time(Duration::from_secs(5));
    group.bench_function("yardstick: dense LU of the order", |b| {
        b.iter(|| black_box(yardstick.partial_piv_lu()));
    });
    group.bench_function("model", |b| b.iter(|| black_box(Model::from_scene(&scene))));
    group.bench_function("plan", |b| b.iter(|| black_box(Plan::of(&scene, &model))));
    group.bench_function("system", |b| b.iter(|| black_box(System::new(&model))));
    group.bench_function("reduction", |b| b.iter(|| black_box(Reduction::new(&system, None))));
    for kind in [FormKind::Coulomb, FormKind::Mixed] {
        let name = format!("form, {}", kind.name());
        group.bench_function(name, |b| {
            b.iter(|| black_box(DenseForm::new(kind, &system, &reduction)));
        });
    }
    group.bench_function("solve, mixed form", |b| b.iter(|| black_box(solve())));
    group.bench_function("recovery", |b| {
        b.iter(|| black_box(recover(&model, &system, &reduction, &rows, true)));
    });
    group.bench_function("checks", |b| b.iter(|| black_box(Checks::of(&model, &state))));
    group.bench_function("picture of principal stresses", |b| {
        b.iter(|| black_box(svg::principal_stresses(&scene.title, &model, &state, None)));
    });
    group.finish();
}

fn wave(i: usize, j: usize) -> f64 {
    ((17 * i + 31 * j) as f64).sin()
}

criterion_group!(benches, panel);
criterion_main!(benches);

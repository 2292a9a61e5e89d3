//! Nothing to see, in every way ([PLAN-1], [RAY-2]).

use crate::common::{LAYERS, Stage, ball, orthographic, perspective, plain};
use crate::stability::{Case, Theme};
use drypoint::reference::ray::Renderer;
use drypoint::scene::backdrop::Backdrop;
use drypoint::scene::glam::DVec3;
use drypoint::scene::inputs::{Inputs, ObjectData};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::plan::Plan;
use drypoint::scene::shot::{Shot, VolumeFacts};
use drypoint::scene::space::{Grid, SpaceError};
use drypoint::scene::tables::{Background, Camera, Contours, Kappa, Length, Number, TransferKind, VolumeSource};
use drypoint::scene::tables::{Scene, Transfer};
use drypoint::scene::transfer::Function;
use drypoint::scene::view::View;
use drypoint::scene::volume::Volume;
use std::sync::Arc;

pub(crate) static THEME: Theme = Theme::new(
    "Empty everything",
    &[
        Case {
            name: "clear functions, boxes beside, behind and before `near`: over a background",
            breaks: "means over nothing are 0/0; a veil over the background",
            done: "C + (1 − 0)·B; a mean over nothing is 0, a depth of nothing ∞",
            of: "numbers of picture and layers that are not those of the background or of nothing; 7 scenes",
            bound: 0.0,
            why: "no sample has weight",
            measure: || nothing(Number::F64),
        },
        Case {
            name: "the same: work",
            breaks: "work for what cannot be seen",
            done: "bricks that show nothing are left out [RAY-2]",
            of: "samples, gradients, Hessians and lookups, without the scenes whose style alone is clear",
            bound: 0.0,
            why: "no brick is visible, no ray meets the box",
            measure: || work(Number::F64),
        },
        Case {
            name: "both in f32",
            breaks: "as above",
            done: "as above",
            of: "numbers that are not those of the background or of nothing, and work",
            bound: 0.0,
            why: "as above",
            measure: || nothing(Number::F32) + work(Number::F32),
        },
        Case {
            name: "axes without voxels, functions without nodes",
            breaks: "indices into nothing",
            done: "errors of their own types",
            of: "of them, those that were taken",
            bound: 0.0,
            why: "there is no field and no function",
            measure: refused,
        },
    ],
);

#[test]
fn empty_everything() {
    THEME.hold();
}

/// Scenes that show nothing, and whether no sample at all is to be looked at.
fn scenes() -> Vec<(Stage, bool)> {
    let contours = Some(Contours { kappa: Kappa::Exact, ..Contours::default() });
    let of = |alpha_u: f64, alpha_d: f64| {
        let clear = plain("s", [0.5, 0.5, 0.5, alpha_d]);
        Stage::styled(ball(12, 4.0), vec![clear], &[(-9.0, "s", alpha_u), (9.0, "s", alpha_u)])
            .layers(&LAYERS)
            .with(|s| s.contours = contours.clone())
    };
    let seen = of(0.5, 1.0);
    let looking = |camera: Camera| seen.with(|s| s.camera = camera);
    let away = Camera {
        eye: Some(DVec3::splat(-30.0)),
        direction: DVec3::NEG_ONE,
        direction_given: true,
        ..perspective(40.0)
    };
    let beside = Camera { target: Some(DVec3::new(5.0, 5.0, 1e6)), direction: DVec3::Y, ..orthographic(Some(10.0)) };
    let before_near = Camera { direction: DVec3::Y, near: Some(Length::World(1e9)), ..perspective(40.0) };
    let one_node = Stage::regular(ball(12, 4.0), &[(0.0, [1.0; 3], 0.0)]).layers(&LAYERS);
    vec![
        (of(0.0, 1.0), true),
        (of(0.5, 0.0), false),
        (of(1.0, 0.0), false),
        (one_node, true),
        (looking(away), true),
        (looking(beside), true),
        (looking(before_near), true),
    ]
}

fn nothing(number: Number) -> f64 {
    let mut wrong = 0;
    for (shot, _) in scenes() {
        let shot = shot.in_number(number);
        for background in [[0.0; 4], [0.2, 0.4, 0.6, 0.5], [1.0; 4]] {
            let [r, g, b, a] = background;
            let shown = shot.with(|s| s.picture.background = Background::Color(background)).render();
            wrong += shown.pixels().iter().filter(|p| **p != [r * a, g * a, b * a, a]).count();
            for layer in
                shown.picture.layers.iter().filter(|l| ![LayerKind::Beauty, LayerKind::Counts].contains(&l.kind))
            {
                // The mean depth, too, is that of nothing.
                let empty = if [LayerKind::Z, LayerKind::Depth].contains(&layer.kind) { f64::INFINITY } else { 0.0 };
                wrong += layer.channels.iter().flatten().filter(|v| **v != empty).count();
            }
        }
    }
    wrong as f64
}

fn work(number: Number) -> f64 {
    let counts = scenes().into_iter().map(|(shot, none)| {
        let c = shot.in_number(number).render().counts;
        if none { c.samples + c.gradients + c.hessians + c.style_lookups } else { 0 }
    });
    counts.sum::<u64>() as f64
}

fn refused() -> f64 {
    let mut taken = 0;
    for (axis, dims) in [[0, 4, 4], [4, 0, 4], [4, 4, 0]].into_iter().enumerate() {
        let made = Grid::with_spacing(dims, [1.0; 3]);
        taken += usize::from(made != Err(SpaceError::EmptyAxis { axis }));
    }
    let ball = ball(4, 1.0);
    for (nodes, rows) in [(Some(Vec::new()), None), (None, Some(Vec::new()))] {
        for kind in [TransferKind::Regular, TransferKind::Style] {
            let mut scene = Scene::for_volume(VolumeSource::File { path: "test".into(), raw: None });
            scene.transfer = Some(Transfer { nodes: nodes.clone(), rows: rows.clone(), ..Transfer::automatic(kind) });
            taken += usize::from(made(&scene, &ball).is_ok());
        }
    }
    taken as f64
}

/// Makes a scene of a function alone ready.
fn made(scene: &Scene, volume: &Volume) -> Result<(), ()> {
    let function = Function::new(scene.transfer.as_ref().ok_or(())?, volume.range(), volume, &|_| None);
    let (function, plan) = (function.map_err(|_| ())?.ok_or(())?, Plan::new(scene));
    let view = View::new(&scene.camera, volume.grid(), scene.picture.size).map_err(|_| ())?;
    let facts = VolumeFacts { grid: volume.grid(), is_integer: false };
    let shot = Shot::resolve(scene, &plan, facts, Arc::new(function), view).map_err(|_| ())?;
    Renderer::new(&shot, Inputs::of(ObjectData::of(volume), Backdrop::None)).map(drop).map_err(|_| ())
}

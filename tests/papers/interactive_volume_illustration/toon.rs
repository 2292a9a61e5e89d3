//! Tones, silhouettes and view-dependent opacity on a ball whose normals are known (4.4, [HATCH-15]).

use crate::common::{Stage, orthographic, perspective, quadratic_ball};
use drypoint::scene::glam::DVec3;
use drypoint::scene::tables::{
    GradientEstimator, Iso, Kernel, Length, LightDirection, Number, Shading, ShadingModel, SilhouetteShading, Surface,
    SurfaceLook, Tone, ToonShading,
};
use std::f64::consts::PI;

/// Of the ball, in voxels.
const RADIUS: f64 = 8.0;
/// Of the picture of an orthographic view.
const HEIGHT: f64 = 18.0;

/// The ball in a kernel that reproduces it: normals are right to rounding.
fn ball(nodes: &[(f64, [f64; 3], f64)], pixels: usize) -> Stage {
    Stage::regular(quadratic_ball(24, RADIUS), nodes).with(|s| {
        s.sampling.kernel = Kernel::Bspline5;
        s.sampling.gradient = GradientEstimator::Analytic;
        s.camera = orthographic(Some(HEIGHT));
        s.camera.direction = DVec3::new(0.3, 0.9, -0.2);
        s.picture.size = [pixels; 2];
    })
}

/// Its surface alone.
fn surface(surface: Surface, pixels: usize) -> Stage {
    let mut shot = ball(&[], pixels);
    shot.scene.transfer = None;
    shot.scene.surface = Some(Surface { iso: Iso::Value(0.0), ..surface });
    shot
}

/// Where each pixel's ray meets the ball: the pixel, its N and V in eye space.
fn met(shot: &Stage) -> Vec<(usize, DVec3, DVec3)> {
    let view = shot.view();
    let centre = view.to_eye(shot.volume.grid().centre());
    let [width, height] = shot.scene.picture.size;
    let meet = |t: usize| {
        let ray = view.ray((t % width) as f64 + 0.5, (t / width) as f64 + 0.5);
        let origin = view.to_eye(ray.origin) - centre;
        let along = origin.dot(ray.v);
        let root = along * along - (origin.length_squared() - RADIUS * RADIUS);
        // V looks back along the ray, so the nearer root is the larger one along it.
        (root > 0.0).then(|| (t, (origin - ray.v * (along - root.sqrt())) / RADIUS, ray.v))
    };
    (0..width * height).filter_map(meet).collect()
}

/// The tone that a table gives x = L·N + offset, and how far x is from a step.
fn tone(toon: &ToonShading, x: f64) -> ([f64; 3], f64) {
    let i = toon.tones.iter().skip(1).filter(|tone| x > tone.at).count();
    let margin = toon.tones.iter().skip(1).map(|tone| (x - tone.at).abs()).fold(f64::INFINITY, f64::min);
    let [r, g, b, _] = toon.tones[i].color;
    ([r, g, b], margin)
}

fn lights() -> [LightDirection; 4] {
    [
        LightDirection::Head,
        LightDirection::Eye(DVec3::new(-2.0, 3.0, 1.5)),
        LightDirection::Eye(DVec3::new(2.0, 3.0, 1.5)),
        LightDirection::World(DVec3::new(0.5, -0.6, 0.9)),
    ]
}

fn towards(light: LightDirection, shot: &Stage) -> DVec3 {
    match light {
        LightDirection::Head => DVec3::Z,
        LightDirection::Eye(d) => d.normalize(),
        LightDirection::World(d) => shot.view().direction_to_eye(d.normalize()),
    }
}

fn two(offset: f64) -> ToonShading {
    ToonShading { offset, ..ToonShading::default() }
}

fn many() -> ToonShading {
    let tone = |at, r| Tone { at, color: [r, 0.5, 0.25, 1.0] };
    ToonShading { offset: 0.1, tones: vec![tone(0.9, 0.125), tone(-0.4, 0.25), tone(0.1, 0.5), tone(0.8, 1.0)] }
}

/// Offset 0 ends the light at 60° from it and ½ at 90°, whatever the light, the camera and the number type; n tones by
/// table; silhouettes are multiplied onto the tone. A surface shows its normals to rounding: f64 is given 10⁻⁹ about a
/// step, f32, of 2⁻²⁴ and some hundred operations, 10⁻³.
#[test]
fn terminators_of_a_surface() {
    let color = [0.8, 0.4, 0.2, 1.0];
    for (number, near) in [(Number::F64, 1e-9), (Number::F32, 1e-3)] {
        for light in lights() {
            for toon in [two(0.0), two(0.5), many()] {
                for silhouette in [None, Some(SilhouetteShading { offset: 0.3 })] {
                    for camera in [orthographic(Some(HEIGHT)), perspective(70.0)] {
                        let toon = toon.clone();
                        let look = SurfaceLook::Toon;
                        let of = Surface { look, color, toon: Some(toon.clone()), silhouette, ..Surface::default() };
                        let shot = surface(of, 31).with(|s| {
                            s.light = light;
                            s.sampling.number = number;
                            s.camera = drypoint::scene::tables::Camera { direction: s.camera.direction, ..camera };
                        });
                        let l = towards(light, &shot);
                        let shown = shot.render();
                        let pixels = shown.pixels();
                        let mut seen = 0;
                        for (t, n, v) in met(&shot) {
                            let (tone, margin) = tone(&toon, n.dot(l) + toon.offset);
                            let squared = n.dot(v) * n.dot(v);
                            let edge = silhouette.map_or(1.0, |s| (squared + s.offset - 0.5).abs());
                            if margin < near || edge < near || n.dot(v) < 0.02 {
                                continue;
                            }
                            let black = silhouette.is_some_and(|s| squared + s.offset <= 0.5);
                            for c in 0..3 {
                                let wanted = if black { 0.0 } else { color[c] * tone[c] };
                                // f32 rounds each factor and the product.
                                let off = (pixels[t][c] - wanted).abs();
                                assert!(off <= if number == Number::F64 { 0.0 } else { 2e-7 }, "{light:?} {t}: {off}");
                            }
                            seen += 1;
                        }
                        assert!(seen > 60, "{seen}");
                        // One normal for each ray that meets it.
                        let hit = pixels.iter().filter(|p| p[3] > 0.0).count() as u64;
                        let counts = &shown.counts;
                        assert_eq!((counts.gradients, counts.hessians, counts.style_lookups), (hit, 0, 0));
                    }
                }
            }
        }
    }
}

/// The same as an opaque function, whose first sample is up to a step of 0.005 behind the surface, where the normal has
/// turned by 0.005/8.
#[test]
fn terminators_of_a_function() {
    let color = [0.8, 0.4, 0.2];
    for light in lights() {
        for toon in [two(0.0), two(0.5), many()] {
            let shot = ball(&[(0.0, color, 0.0), (0.0, color, 1.0)], 31).with(|s| {
                s.sampling.step = Length::World(0.005);
                s.shading = Some(Shading {
                    model: ShadingModel::Toon,
                    toon: Some(toon.clone()),
                    silhouette: Some(SilhouetteShading::default()),
                    light: Some(light),
                    ..Shading::default()
                });
            });
            let l = towards(light, &shot);
            let shown = shot.render();
            let pixels = shown.pixels();
            let mut seen = 0;
            for (t, n, v) in met(&shot) {
                let (tone, margin) = tone(&toon, n.dot(l) + toon.offset);
                let squared = n.dot(v) * n.dot(v);
                if margin < 0.002 || (squared - 0.05).abs() < 0.01 || n.dot(v) < 0.1 {
                    continue;
                }
                let wanted = [0, 1, 2].map(|c: usize| if squared <= 0.05 { 0.0 } else { color[c] * tone[c] });
                assert_eq!(pixels[t], [wanted[0], wanted[1], wanted[2], 1.0], "{light:?} {t}");
                seen += 1;
            }
            assert!(seen > 350, "{seen}");
            // One visible sample a ray, and one gradient each.
            let hit = pixels.iter().filter(|p| p[3] > 0.0).count() as u64;
            assert_eq!((shown.counts.gradients, shown.counts.hessians, shown.counts.style_lookups), (hit, 0, 0));
        }
    }
}

/// Of an orthographic disc of radius R pixels the share ½ − offset is black: the ring outside ρ = R√(½ + offset). Pixels
/// are counted by their centres: those of a disc are off by at most the pixels within √½ of its edge, 2√2·πρ of them.
/// Chords of less than ¼ voxel, where N·V < 1/64, can be missed by this kernel: the share 2⁻¹² of the disc.
#[test]
fn the_black_share_of_a_disc() {
    let pixels = 201;
    for offset in [0.45, 0.25, 0.0, -0.4] {
        let silhouette = Some(SilhouetteShading { offset });
        let white = surface(Surface { silhouette, ..Surface::default() }, pixels);
        let shown = white.render().pixels();
        let r = RADIUS * pixels as f64 / HEIGHT;
        let area = PI * r * r;
        let black = shown.iter().filter(|p| **p == [0.0, 0.0, 0.0, 1.0]).count() as f64;
        let inner = r * (0.5f64 + offset).sqrt();
        let bound = 2.0 * 2f64.sqrt() * PI * (r + inner) + area / 4096.0;
        assert!((black - (0.5 - offset) * area).abs() <= bound, "{offset}: {black} of {area}");
        // Pixel by pixel, but for rounding at the edge.
        for (t, n, v) in met(&white) {
            let squared = n.dot(v) * n.dot(v);
            if (squared + offset - 0.5).abs() > 1e-9 && n.dot(v) > 0.016 {
                let grey = if squared + offset > 0.5 { 1.0 } else { 0.0 };
                assert_eq!(shown[t], [grey, grey, grey, 1.0], "{offset} {t}");
            }
        }
    }
}

/// Silhouettes on Blinn–Phong: what is not black is as without.
#[test]
fn silhouettes_go_over_any_model() {
    let color = [0.8, 0.4, 0.2];
    let silhouette = Some(SilhouetteShading { offset: 0.4 });
    let phong = ball(&[(0.0, color, 0.0), (0.0, color, 1.0)], 31).with(|s| s.shading = Some(Shading::default()));
    let drawn = phong.with(|s| s.shading = Some(Shading { silhouette, ..Shading::default() }));
    let lit = surface(Surface { look: SurfaceLook::Phong, ..Surface::default() }, 31);
    let rimmed = lit.with(|s| s.surface = s.surface.clone().map(|of| Surface { silhouette, ..of }));
    for (without, with) in [(phong, drawn), (lit, rimmed)] {
        let pairs: Vec<_> = without.render().pixels().into_iter().zip(with.render().pixels()).collect();
        let black = pairs.iter().filter(|(_, b)| *b == [0.0, 0.0, 0.0, 1.0]).count();
        assert!((20..200).contains(&black), "{black}");
        assert!(pairs.iter().all(|(a, b)| a == b || (*b == [0.0, 0.0, 0.0, 1.0] && a[3] == 1.0)));
    }
}

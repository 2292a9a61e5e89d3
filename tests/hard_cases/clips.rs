//! Clip planes in closed form ([RAY-8]): boxes, balls and iso-surfaces that are cut open.

use crate::common::{Stage, ball, in_a_texture, on, orthographic, perspective, quadratic_ball, style};
use drypoint::job::Job;
use drypoint::marking::Marking;
use drypoint::reference::field::{Field, Reconstruction, Rung};
use drypoint::reference::interactive_volume_illustration::outlines;
use drypoint::reference::number::Vec3;
use drypoint::reference::ray::lattice::IndexRay;
use drypoint::reference::surface::IsoSurface;
use drypoint::scene::clip::ClipPlane;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::glam::{DMat3, DVec2, DVec3};
use drypoint::scene::marks::Marks;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::shot::Clipping;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Clip, ClipSpace, Contours, Halo, HaloKind, Iso, Kappa, Length, Outside, Shading, Surface, SurfaceLook,
};
use std::collections::BTreeSet;

fn plane(point: DVec3, normal: DVec3) -> Clip {
    Clip { point: Some(point), normal: Some(normal), ..Clip::default() }
}

/// A sheared grid.
fn sheared() -> Grid {
    let axes = DMat3::from_cols(DVec3::new(1.0, 0.2, 0.0), DVec3::new(-0.3, 0.9, 0.1), DVec3::new(0.2, 0.4, 2.0));
    Grid::new([12, 14, 7], axes, DVec3::new(5.0, -3.0, 9.0)).unwrap()
}

/// A homogeneous box that oblique planes cut has 1 − (1 − α₀)^n, n the samples of a ray that are on the kept side of all
/// of them, counted one by one.
#[test]
fn a_homogeneous_box_has_the_opacity_of_its_samples() {
    let (alpha, step) = (0.03, 0.37);
    for (i, grid) in [Grid::with_spacing([12, 11, 13], [1.0; 3]).unwrap(), sheared()].into_iter().enumerate() {
        let middle = grid.centre();
        let index = grid.to_index(middle);
        let clips = [
            plane(middle + DVec3::new(0.3, 0.1, 0.2), DVec3::new(0.4, -1.0, 0.7)),
            Clip { space: ClipSpace::Index, ..plane(index + DVec3::new(2.0, 0.0, 0.0), DVec3::new(1.0, 0.1, 0.0)) },
        ];
        let stage = Stage::regular(on(grid, |_| 3.0), &[(0.0, [0.5, 0.25, 1.0], alpha)]).step(step).with(|s| {
            s.clips = clips.to_vec();
            s.camera = if i == 0 { orthographic(None) } else { perspective(40.0) };
            s.camera.direction = DVec3::new(0.7, 0.6, -0.2);
            s.picture.size = [23, 19];
        });
        let (grid, shot) = (stage.volume.grid(), stage.resolved(stage.view()));
        let ends = grid.index_box().map(Vec3::from_glam);
        let (mut cut, pixels) = (0, stage.render().pixels());
        for (t, pixel) in pixels.into_iter().enumerate() {
            let pixel_ray = shot.view.ray((t % 23) as f64 + 0.5, (t / 23) as f64 + 0.5);
            let ray = IndexRay::<f64>::new(&pixel_ray, &shot.view, &shot.lattice, grid);
            let [first, last] = ray.inside(ends);
            // Kept, by the planes as the scene has them.
            let is_kept = |k: &i64| {
                let at = ray.position(*k).to_glam();
                let beyond = [grid.to_world(at), at].into_iter().zip(&clips);
                beyond.map(|(p, c)| c.normal.unwrap().dot(p - c.point.unwrap())).all(|beyond| beyond <= 0.0)
            };
            let n = (first..=last).filter(is_kept).count();
            cut += usize::from((n as i64) < last - first + 1);
            let expected = 1.0 - (1.0 - alpha).powf(n as f64 * ray.step / step);
            assert!((pixel[3] - expected).abs() < 1e-13, "{i} {t}: {} {expected}", pixel[3]);
        }
        assert!(cut > 100, "{cut}");
    }
}

/// A cap on a linear field has the colour of the place where the ray meets the plane, and its depth, at any step.
#[test]
fn a_cap_on_a_linear_field_is_exact_at_any_step() {
    let grid = sheared();
    let slope = DVec3::new(0.4, -0.3, 0.2);
    let middle = grid.centre();
    let value = |p: DVec3| 5.0 + slope.dot(p - middle);
    let volume = on(grid.clone(), value);
    let [low, high] = volume.range();
    let ends = [[0.1, 0.9, 0.2], [0.8, 0.05, 0.6]];
    let nodes = [(low, ends[0], 1.0), (high, ends[1], 1.0)];
    let normal = DVec3::new(0.3, -1.0, 0.5).normalize();
    let point = middle + DVec3::new(0.2, 0.3, -0.1);
    let [lo, hi] = grid.index_box();
    for step in [0.23, 0.9, 2.1] {
        let stage = Stage::regular(volume.clone(), &nodes).step(step).layers(&[LayerKind::Depth]).with(|s| {
            s.camera = perspective(35.0);
            s.camera.direction = DVec3::new(0.2, 1.0, 0.1);
            s.picture.size = [31, 29];
            s.clips = vec![plane(point, normal)];
        });
        let (view, shown) = (stage.view(), stage.render());
        let depths = shown.one_of_depth();
        let mut on_plane = 0;
        for (t, pixel) in shown.pixels().into_iter().enumerate() {
            let ray = view.ray((t % 31) as f64 + 0.5, (t / 31) as f64 + 0.5);
            let crossing = (point - ray.origin).dot(normal) / ray.along.dot(normal);
            // A sample before the plane and one behind it are in the box.
            let is_inside = |depth: f64| {
                let at = grid.to_index(ray.origin + ray.along * depth);
                at.cmpge(lo).all() && at.cmple(hi).all()
            };
            if ![crossing - step, crossing + step].into_iter().all(is_inside) {
                continue;
            }
            let share = (value(ray.origin + ray.along * crossing) - low) / (high - low);
            let expected = [0, 1, 2].map(|c| ends[0][c] + share * (ends[1][c] - ends[0][c]));
            assert!((0..3).all(|c| (pixel[c] - expected[c]).abs() < 1e-12), "{step} {t}: {pixel:?} {expected:?}");
            assert!((depths[t] - crossing).abs() < 1e-11, "{step} {t}: {} {crossing}", depths[t]);
            on_plane += 1;
        }
        assert!(on_plane > 60, "{step}: {on_plane}");
    }
}

/// An opaque ball of radius R cut in the middle by a plane that faces the eye: a disc of area πR² that shows the cap, or
/// the ball's own colour under the plane's normal.
#[test]
fn a_ball_cut_in_the_middle_shows_a_disc() {
    let (n, radius) = (33, 12.0);
    let facing = DVec3::new(0.3, -0.8, 0.2).normalize();
    let nodes = [(0.0, [0.2, 0.4, 0.6], 0.0), (0.0, [0.2, 0.4, 0.6], 1.0)];
    let lit = Shading { ambient: 0.25, diffuse: 0.5, specular: 0.0, ..Shading::default() };
    let cut = |clip: Clip| {
        Stage::regular(ball(n, radius), &nodes).layers(&[LayerKind::Normal, LayerKind::Z]).with(|s| {
            s.camera = orthographic(Some(30.0));
            s.camera.direction = -facing;
            s.sampling.step = Length::World(0.25);
            s.shading = Some(lit.clone());
            s.picture.size = [120, 120];
            s.clips = vec![clip];
        })
    };
    let middle = plane(DVec3::splat(16.0), facing);
    let (own, capped) =
        (cut(middle.clone()).render(), cut(Clip { cap: Some([0.9, 0.1, 0.0, 1.0]), ..middle }).render());
    let normals = own.layer::<3>(LayerKind::Normal);
    let depths = own.one(LayerKind::Z);
    let (mut disc, mut rim) = (0, 0);
    for (i, pixel) in own.pixels().into_iter().enumerate() {
        if pixel[3] == 0.0 {
            continue;
        }
        // On the plane through depth 0.
        if depths[i] < 0.1 {
            assert!(depths[i].abs() < 1e-12, "{}", depths[i]);
            assert!((DVec3::from_array(normals[i]) - DVec3::Z).length() < 1e-14, "{:?}", normals[i]);
            // ambient + diffuse under a light at the eye.
            let expected = [0.2, 0.4, 0.6].map(|c| 0.75 * c);
            assert!((0..3).all(|c| (pixel[c] - expected[c]).abs() < 1e-14), "{pixel:?}");
            assert_eq!(capped.pixels()[i], [0.9, 0.1, 0.0, 1.0]);
            disc += 1;
        } else {
            assert_eq!(capped.pixels()[i], pixel);
            rim += 1;
        }
    }
    let area = f64::from(disc) / 16.0;
    let expected = std::f64::consts::PI * radius * radius;
    // A circle's area by pixels of a quarter, and a rim of half-sampled depth behind it.
    assert!((area / expected - 1.0).abs() < 0.01, "{area} {expected}");
    assert!(rim < disc / 40, "{rim} {disc}");
    // From the other side nothing is to be seen of the cut: no bit changes where a ray ends before it.
    let behind = |clips: Vec<Clip>| {
        cut(plane(DVec3::ZERO, facing)).with(|s| {
            s.camera.direction = facing;
            s.clips = clips;
        })
    };
    let middle = plane(DVec3::splat(16.0), facing);
    let [left, whole] = [vec![middle], vec![]].map(|clips| behind(clips).render());
    let depths = whole.one(LayerKind::Z);
    let pairs = left.pixels().into_iter().zip(whole.pixels()).zip(depths);
    let before: Vec<bool> = pairs.filter(|(_, depth)| *depth < 0.0).map(|((left, whole), _)| left == whole).collect();
    assert!(before.len() > 7000 && before.iter().all(|same| *same), "{}", before.len());
}

/// The cap's own opacity multiplies that of the sample, and a style is looked up at the plane's normal. A cut has no
/// contour, and the samples behind it the κ that they have without the plane.
#[test]
fn caps_and_contours() {
    let grid = || Grid::with_spacing([9, 9, 9], [1.0; 3]).unwrap();
    let (alpha, step) = (0.2, 0.5);
    let ramp = style("ramp", 9, |x, y| [0.5 + 0.5 * x, 0.5 + 0.5 * y, 0.3, 0.75]);
    let facing = DVec3::new(0.0, -1.0, 0.4).normalize();
    let stage = |clip: Clip| {
        let mut stage = Stage::regular(on(grid(), |_| 3.0), &[(0.0, [0.0; 3], alpha)]).step(step).with(|s| {
            s.camera = orthographic(Some(4.0));
            s.camera.direction = DVec3::Y;
            s.picture.size = [3, 3];
            s.clips = vec![clip];
        });
        stage.styles = vec![ramp.clone()];
        stage
    };
    let clip = plane(DVec3::new(4.0, 3.3, 4.0), facing);
    let without = stage(clip.clone()).render().pixels();
    for (cap, [r, g, b, opacity]) in [
        (Clip { cap: Some([0.25, 0.5, 1.0, 0.5]), ..clip.clone() }, [0.25, 0.5, 1.0, 0.5]),
        (Clip { style: Some("ramp".into()), ..clip }, {
            // N in eye space: right is x, up is z.
            in_a_texture([0.5, 0.5 + 0.5 * facing.z, 0.3, 0.75])
        }),
    ] {
        for (capped, own) in stage(cap).render().pixels().into_iter().zip(&without) {
            // The first sample has α·opacity in place of α; all else is black.
            let expected = [r, g, b].map(|c| c * alpha * opacity);
            let behind = 1.0 - (1.0 - own[3]) / (1.0 - alpha) * (1.0 - alpha * opacity);
            assert!((0..3).all(|c| (capped[c] - expected[c]).abs() < 2e-3 * expected[c]), "{capped:?} {expected:?}");
            assert!((capped[3] - behind).abs() < 1e-13, "{} {behind}", capped[3]);
        }
    }
}

/// κ is 0 on a cut. A sample behind it looks back at the field's own normal there, so its κ is that without the plane.
#[test]
fn a_cut_has_no_curvature_and_changes_none_behind_it() {
    // Opaque from ρ = 4 on, whose front is at y = 4. Samples lie at y = 4¼, 4¾, …
    let solid = (36.0 - 16.0) / 12.0;
    for kappa in [Kappa::Ray, Kappa::Exact] {
        let stage = |clips: Vec<Clip>| {
            let styles = vec![style("plain", 1, |_, _| [1.0; 4])];
            let nodes = [(solid, "plain", 0.0), (solid, "plain", 1.0)];
            Stage::styled(quadratic_ball(17, 6.0), styles, &nodes)
                .layers(&[LayerKind::FirstCurvatureAlongView, LayerKind::Depth])
                .with(|s| {
                    s.camera = orthographic(Some(9.0));
                    s.camera.direction = DVec3::Y;
                    s.picture.size = [48, 48];
                    s.sampling.step = Length::World(0.5);
                    s.contours = Some(Contours { kappa, ..Contours::default() });
                    s.clips = clips;
                })
        };
        let cut = stage(vec![plane(DVec3::new(8.0, 4.2, 8.0), DVec3::NEG_Y)]).render();
        let whole = stage(vec![]).render();
        let kappas = [&cut, &whole].map(|shown| shown.one(LayerKind::FirstCurvatureAlongView));
        let [firsts, expected] = [&cut, &whole].map(|shown| shown.layer::<3>(LayerKind::Depth));
        let (mut on_cut, mut next, mut farther) = (0, 0, 0);
        for (i, ([first, ..], [expected, ..])) in firsts.into_iter().zip(expected).enumerate() {
            // Depth 0 is y = 8.
            let y = 8.0 + first;
            if y < 4.25 {
                assert!((y - 4.2).abs() < 1e-12, "{y}");
                assert_eq!(kappas[0][i], 0.0);
                assert!(kappas[1][i] != 0.0);
                on_cut += 1;
            } else if first == expected && y.is_finite() {
                assert_eq!(kappas[0][i].to_bits(), kappas[1][i].to_bits());
                assert!(kappas[0][i] != 0.0);
                (next, farther) = (next + usize::from(y == 4.75), farther + usize::from(y > 4.75));
            }
        }
        assert!(on_cut > 40 && next > 50 && farther > 50, "{kappa:?} {on_cut} {next} {farther}");
    }
}

/// An iso-surface that a plane cuts is hit on the plane, to rounding, with the plane's normal; elsewhere it is as it was.
#[test]
fn a_cut_iso_surface_is_hit_on_the_plane() {
    let (radius, middle) = (6.0, DVec3::splat(8.0));
    let normal = DVec3::new(0.3, -1.0, 0.2).normalize();
    let point = middle + normal * 2.0;
    for (outside, sign) in [(Outside::Low, 1.0), (Outside::High, -1.0)] {
        for perspective_view in [false, true] {
            let volume = ball(17, radius);
            let volume = on(volume.grid().clone(), |p| sign * (radius - (p - middle).length()));
            let stage = |clips: Vec<Clip>| {
                let stage = Stage::regular(volume.clone(), &[]).layers(&[LayerKind::Depth, LayerKind::Normal]);
                stage.with(|s| {
                    s.transfer = None;
                    s.surface = Some(Surface { iso: Iso::Value(0.0), look: SurfaceLook::Phong, ..Surface::default() });
                    s.volume.outside = outside;
                    s.camera = if perspective_view { perspective(30.0) } else { orthographic(Some(15.0)) };
                    s.camera.direction = DVec3::Y;
                    s.picture.size = [31, 29];
                    s.clips = clips;
                })
            };
            let cut = stage(vec![plane(point, normal)]);
            let (view, [left, whole]) = (cut.view(), [cut.render(), stage(vec![]).render()]);
            let expected = view.direction_to_eye(normal);
            let (mut on_plane, mut behind) = (0, 0);
            let normals = left.layer::<3>(LayerKind::Normal);
            for (t, depth) in left.one_of_depth().into_iter().enumerate() {
                let ray = view.ray((t % 31) as f64 + 0.5, (t / 31) as f64 + 0.5);
                let crossing = (point - ray.origin).dot(normal) / ray.along.dot(normal);
                let place = ray.origin + ray.along * crossing;
                // A trilinear ball lies within the sphere by less than 1/8R.
                let inside = radius - (place - middle).length();
                if inside > 0.05 {
                    assert!((depth - crossing).abs() < 1e-12 * crossing.abs().max(1.0), "{depth} {crossing}");
                    assert!((DVec3::from_array(normals[t]) - expected).length() < 1e-14, "{:?}", normals[t]);
                    on_plane += 1;
                } else if inside < -0.05 && depth.is_finite() {
                    let hit = ray.origin + ray.along * depth;
                    assert!((hit - point).dot(normal) <= 1e-9);
                    assert!(((hit - middle).length() - radius).abs() < 0.05);
                    // The same place as without the plane, or the first one behind it.
                    behind += usize::from(whole.one_of_depth()[t] == depth);
                }
            }
            assert!(on_plane > 100 && behind > 10, "{on_plane} {behind}");
            // A cap of half an opacity lies over the surface's own colour.
            let capped = stage(vec![Clip { cap: Some([1.0, 0.0, 0.0, 0.5]), ..plane(point, normal) }]).render();
            let at = 15 + 31 * 14;
            let (own, mixed) = (left.pixels()[at], capped.pixels()[at]);
            let expected = [0, 1, 2].map(|c| 0.5 * own[c] + 0.5 * [1.0, 0.0, 0.0][c]);
            assert!((0..3).all(|c| (mixed[c] - expected[c]).abs() < 1e-14), "{mixed:?} {expected:?}");
        }
    }
}

impl crate::common::Shown {
    /// The depth of each pixel where half of it is reached.
    fn one_of_depth(&self) -> Vec<f64> {
        self.layer::<3>(LayerKind::Depth).into_iter().map(|[_, half, _]| half).collect()
    }
}

/// Samples that are cut away seed no halo.
#[test]
fn what_is_cut_away_seeds_nothing() {
    let stage = |clips: Vec<Clip>, halos: Vec<Halo>| {
        Stage::regular(ball(17, 6.0), &[(0.0, [1.0; 3], 0.0), (0.0, [1.0; 3], 0.5)]).with(|s| {
            s.camera.direction = DVec3::Y;
            s.clips = clips;
            s.halos = halos;
        })
    };
    let halo = || {
        let mut halo = Halo { name: "halo".into(), kind: HaloKind::Emissive, ..Halo::default() };
        halo.spread.passes = 1;
        vec![halo]
    };
    let all = vec![plane(DVec3::splat(-1.0), DVec3::Y)];
    let nothing = stage(all, halo()).render();
    assert_eq!((nothing.covered(), nothing.counts.halo_samples), (0, 0));
    let half = vec![plane(DVec3::splat(8.0), DVec3::X)];
    let seeds = [stage(vec![], halo()), stage(half, halo())].map(|stage| stage.render());
    assert!(seeds[0].counts.halo_samples > seeds[1].counts.halo_samples && seeds[1].counts.halo_samples > 0);
    // The left half of the picture has the same halo up to the reach of the other half.
    let columns = |shown: &crate::common::Shown| -> Vec<[f64; 4]> {
        shown.pixels().chunks(16).flat_map(|row| row[..5].to_vec()).collect()
    };
    assert_eq!(columns(&seeds[0]), columns(&seeds[1]));
}

/// Outlines end on the planes to 10⁻⁹ and lie on the kept side. The section is a circle on the plane, and the cut hides
/// what lies behind it.
#[test]
fn outlines_end_on_planes_and_the_cut_hides() {
    let (radius, middle) = (9.0, DVec3::splat(12.0));
    let volume = quadratic_ball(25, radius);
    let field = Field::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
    let facing = DVec3::new(0.2, -1.0, 0.3).normalize();
    let along = DVec3::new(1.0, 0.3, 0.1).normalize();
    let stage = Stage::regular(volume.clone(), &[(0.0, [1.0; 3], 1.0)]).with(|s| {
        s.camera.direction = DVec3::Y;
        s.clips = vec![plane(middle + facing * 3.0, facing), plane(middle + along * 4.0, along)];
    });
    let clip = Clipping::new(&stage.scene, volume.grid()).planes;
    let (view, planes) = (stage.view(), &clip.0);
    let whole = IsoSurface::new(&field, 0.0);
    let surface = whole.clone().clipped(&clip);
    let all = |beyond: f64| {
        planes.iter().map(|plane| plane.beyond_in_world(middle + facing * beyond)).fold(f64::MIN, f64::max)
    };
    assert!(all(2.9) < 0.0 && all(3.1) > 0.0);
    let found = outlines(&surface, &view);
    let distance = |plane: &ClipPlane, at: DVec3| plane.beyond_in_world(at);
    let (mut on_section, mut ends) = ([0, 0], 0);
    for stroke in &found.strokes {
        for vertex in &stroke.vertices {
            assert!(planes.iter().all(|plane| distance(plane, vertex.world) < 1e-9));
            assert!(((vertex.world - middle).length() - radius).abs() < 0.05, "{}", vertex.world);
        }
        for (count, plane) in on_section.iter_mut().zip(planes) {
            let is_on = stroke.vertices.iter().all(|vertex| distance(plane, vertex.world).abs() < 1e-9);
            *count += usize::from(is_on && stroke.vertices.len() > 4);
        }
        if !stroke.closed {
            for end in [stroke.vertices.first().unwrap(), stroke.vertices.last().unwrap()] {
                assert!(planes.iter().any(|plane| distance(plane, end.world).abs() < 1e-9), "{}", end.world);
                ends += 1;
            }
        }
    }
    assert!(on_section.iter().all(|n| *n >= 1) && ends >= 4, "{on_section:?} {ends}");
    // In front of the cut, on it, and behind it; and behind the sphere where nothing is left in front.
    let sees = |at: DVec3| !surface.hides(at, &view, 0.1);
    let on_cut = middle + facing * 3.0;
    assert!(sees(on_cut + facing * 0.1) && !sees(on_cut - facing * 0.1));
    let before = middle - DVec3::Y * 8.0;
    assert!(sees(before) && whole.hides(before, &view, 0.1));
    let beside = middle + DVec3::new(6.0, 12.0, 0.0);
    assert!(sees(beside) && whole.hides(beside, &view, 0.1), "{beside}");
}

/// The dots and lines of a scene of a phantom of 32 voxels, seen along y.
fn marks(phantom: &str, rest: &str) -> Marks {
    let volume = format!("phantom = {{ name = {phantom:?}, size = 32 }}");
    let head = "\n[camera]\n\
                projection = \"orthographic\"\ndirection = [0, 1, 0]\n[picture]\nsize = [300, 300]\n";
    let text = format!("drypoint = 1\n[volume]\n{volume}{head}{rest}");
    let scene = parse(&text, "scene.toml".as_ref(), &Overrides::default());
    let job = Job::load(scene.unwrap_or_else(|faults| panic!("{faults}"))).unwrap_or_else(|f| panic!("{f}"));
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ()).unwrap();
    marking.frames(&mut counts).unwrap().draw(&job.view().unwrap(), &mut counts).unwrap()
}

const OBLIQUE: &str = "[[clip]]\npoint = [17, 15, 16]\nnormal = [1, -1, 0.5]\n";

/// The distance of a place beyond the plane of [`OBLIQUE`].
fn beyond_oblique(at: DVec3) -> f64 {
    DVec3::new(1.0, -1.0, 0.5).normalize().dot(at - DVec3::new(17.0, 15.0, 16.0))
}

/// Dots on the side that is cut away are left out; the others are as they were.
#[test]
fn dots_on_the_kept_side_stay() {
    let dots = |rest: &str| -> Vec<DVec3> {
        let layers = marks("sphere", rest).layers;
        layers.iter().flat_map(|layer| layer.dots.iter().map(|dot| dot.world)).collect()
    };
    let whole = dots("[stipples]\n");
    let left = dots(&format!("[stipples]\n{OBLIQUE}"));
    let expected: Vec<DVec3> = whole.iter().copied().filter(|at| beyond_oblique(*at) <= 0.0).collect();
    assert_eq!(left, expected);
    assert!(left.len() > 200 && whole.len() > left.len() + 200, "{} {}", left.len(), whole.len());
    // Chosen on the page, none is on the other side either.
    let page = dots(&format!("[stipples]\neven = \"page\"\n{OBLIQUE}"));
    assert!(page.len() > 100 && page.iter().all(|at| beyond_oblique(*at) <= 0.0));
    // The half sphere of radius 9.6 behind a cut that faces the eye is hidden by the cut, but for its rim.
    let facing = "[[clip]]\npoint = [15.5, 15.5, 15.5]\nnormal = [0, -1, 0]\n";
    let hidden = dots(&format!("[stipples]\nhide_behind = \"auto\"\n{facing}"));
    let transparent = dots(&format!("[stipples]\n{facing}"));
    let aside = |at: &DVec3| (DVec2::new(at.x, at.z) - DVec2::splat(15.5)).length();
    let covered = |dots: &[DVec3]| dots.iter().filter(|at| aside(at) < 7.5).count();
    assert!(covered(&transparent) > 400 && covered(&hidden) == 0, "{} {}", covered(&transparent), covered(&hidden));
    // Beside the cut, and too far from the sphere for a foot on it, nothing hides.
    let beside = |dots: &[DVec3]| dots.iter().filter(|at| aside(at) > 12.0).count();
    assert!(beside(&hidden) > 100 && beside(&hidden) == beside(&transparent));
}

/// Strokes end on the plane to 10⁻⁹, and their other vertices are as they were.
#[test]
fn strokes_end_on_planes() {
    let hatching = "[hatching]\nhidden = \"drawn\"\nspacing = \"random\"\nseeds = \"dense\"\nseed = 3\n";
    let vertices = |marks: &Marks| -> Vec<Vec<DVec3>> {
        let lines = marks.layers.iter().flat_map(|layer| &layer.lines);
        lines.map(|line| line.vertices.iter().map(|vertex| vertex.world).collect()).collect()
    };
    let whole: BTreeSet<[u64; 3]> = vertices(&marks("ellipsoid", hatching))
        .into_iter()
        .flatten()
        .map(|at| at.to_array().map(f64::to_bits))
        .collect();
    let left = vertices(&marks("ellipsoid", &format!("{hatching}{OBLIQUE}")));
    let (mut ends, mut kept) = (0, 0);
    for line in &left {
        for (i, at) in line.iter().enumerate() {
            assert!(beyond_oblique(*at) < 1e-9, "{at}");
            let is_end = i == 0 || i + 1 == line.len();
            if whole.contains(&at.to_array().map(f64::to_bits)) {
                kept += 1;
            } else {
                assert!(is_end && beyond_oblique(*at).abs() < 1e-9, "{i} of {}: {at}", line.len());
                ends += 1;
            }
        }
    }
    assert!(ends > 20 && kept > 500, "{ends} {kept}");
}

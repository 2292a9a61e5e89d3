//! Lines of boxes and arrows among volume and geometry ([VS-8], [VS-12]).

use super::{SHELLS, job_of, pixels, scene_of};
use drypoint::scene::fragments::{Fragment, Fragments};

/// A point of an opaque line has the colour of the pixel in which the renderer itself draws that line, to the bit.
#[test]
fn a_point_of_a_line_looks_as_in_the_picture() {
    let haze = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 20, color = \"#3060c0\", opacity = 0 }, { at = 255, color = \"#c09030\", opacity = 0.2 }]\n";
    let surface = "[surface]\niso = 128\nlook = \"phong\"\n";
    let object = "[[object]]\nvalue = [[100, 0], [140, 1]]\nmove = [3, 0, 2]\nghosting = 0.5\n";
    let encoded = "[camera]\nprojection = \"orthographic\"\n";
    for rest in [haze.to_string(), format!("{haze}{surface}"), format!("{haze}{object}"), format!("{haze}{encoded}")] {
        let job = job_of(&scene_of(SHELLS, &rest));
        let mut renderer = job.renderer().unwrap();
        let view = job.view().unwrap();
        let centre = -view.to_eye(job.volume.grid().centre()).z;
        let [width, height] = view.size;
        for depth in [centre - 4.3, centre, centre + 5.1] {
            let rgb = [0.8, 0.1, 0.3];
            let all: Vec<_> = (0..width * height).map(|ray| (ray, Fragment { depth, rgb, opacity: 1.0 })).collect();
            renderer.merge(Some(Fragments::new(view.size, 1, &all)));
            let (picture, _) = renderer.again(&|_| ());
            renderer.merge(None);
            let mut dimmed = 0;
            for (i, pixel) in pixels(&picture).into_iter().enumerate() {
                let at = [(i % width) as f64 + 0.5, (i / width) as f64 + 0.5];
                let seen = renderer.line_point(at, depth, rgb);
                assert!((0.0..=1.0).contains(&seen.visible));
                if seen.visible > 0.0 {
                    let rgb = [pixel[0], pixel[1], pixel[2]];
                    assert_eq!((seen.rgb, pixel[3]), (rgb, 1.0), "{at:?}, {depth}: {rest}");
                    dimmed += usize::from((0.05..0.95).contains(&seen.visible));
                }
            }
            assert!(dimmed > 10 || depth < centre, "{dimmed} at {depth}: {rest}");
        }
    }
}

/// Behind a homogeneous slab of the thickness L a line's share is (1 − α)^(L/Δ₀); before it the line is clear, and a line
/// behind the opaque surface is not seen.
#[test]
fn a_line_fades_by_the_law_of_absorption() {
    let volume = "phantom = { name = \"constant\", size = 17 }";
    let rest = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"white\", opacity = 0.1 }, { at = 2, color = \"white\", opacity = 0.1 }]\n\
                [camera]\ndirection = [0, 0, -1]\nprojection = \"orthographic\"\n[sampling]\nstep = 0.25\n";
    let job = job_of(&scene_of(volume, rest));
    let renderer = job.renderer().unwrap();
    let view = job.view().unwrap();
    let near = -view.to_eye(glam_at(16.0)).z;
    let length = job.shot().unwrap().objects[0].reference_length;
    for thickness in [-1.0f64, 0.0, 1.0, 5.5, 12.0] {
        let seen = renderer.line_point([12.0, 10.0], near + thickness, [0.0; 3]);
        let law = |thickness: f64| 0.9f64.powf(thickness.max(0.0) / length);
        // Samples stand for steps about them: the slab begins up to a step later.
        let [most, least] = [law(thickness - 0.25), law(thickness + 0.25)];
        assert!((least..=most).contains(&seen.visible), "{thickness}: {} not in {least} … {most}", seen.visible);
    }
}

fn glam_at(z: f64) -> drypoint::scene::glam::DVec3 {
    drypoint::scene::glam::DVec3::new(8.0, 8.0, z)
}

//! Objects at their edges ([VS-2] … [VS-4], [VS-7]).

use crate::stability::{Case, Theme};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::picture::Picture;
use std::path::Path;

pub(crate) static THEME: Theme = Theme::new(
    "Objects",
    &[
        Case {
            name: "f_S = ½ everywhere, all looks of opacity 0.9",
            breaks: "an opacity of two halves that add to more than either",
            done: "min and max [VS-3]",
            of: "the largest difference to a picture of min(½, α)",
            bound: 1e-12,
            why: "every set has min(½, α), and their union is the maximum",
            measure: half_selected,
        },
        Case {
            name: "a membership of 0 everywhere, moved and cut free",
            breaks: "a box of nothing: a motion about no centre, a cut of everything",
            done: "no box; the grid's centre [VS-2]",
            of: "numbers that differ from those of no object",
            bound: 0.0,
            why: "a selection without a box is met by no ray",
            measure: nothing_selected,
        },
        Case {
            name: "the whole volume moved a million voxels away",
            breaks: "planes and boxes that far away; a second look-up at every sample",
            done: "samples of a part lie in its own box [VS-2]",
            of: "the largest difference to the ghost alone",
            bound: 1e-12,
            why: "nothing of the selection is on the picture's rays",
            measure: far_away,
        },
        Case {
            name: "a selection mirrored onto itself, then by a matrix",
            breaks: "normals that a negative determinant turns inside out",
            done: "normals are those of the moved field's gradient [VS-2]",
            of: "the largest difference of a channel",
            bound: 1e-9,
            why: "positions are rounded once more",
            measure: mirrored,
        },
        Case {
            name: "two opacities of 0 where two objects meet",
            breaks: "a mean colour of 0/0",
            done: "transparent [VS-4]",
            of: "channels that are not finite",
            bound: 0.0,
            why: "a set without members is left out",
            measure: transparent_intersection,
        },
        Case {
            name: "a background of e = 0 under ghosting factors of ½ and 1",
            breaks: "opacities below 0",
            done: "max(0, 1 − γ(2 − e)) [VS-7]",
            of: "the largest difference of a channel between both",
            bound: 0.0,
            why: "1 − ½·2 = 0",
            measure: faded_twice,
        },
        Case {
            name: "halos about a membership of 0 everywhere, of all parts and of the background",
            breaks: "seeds of a box of nothing; a cutaway of everything",
            done: "a set without members seeds nothing [VS-2]",
            of: "numbers that differ from those of no object, intensities with them",
            bound: 0.0,
            why: "a selection without a box is met by no ray",
            measure: halos_of_nothing,
        },
        Case {
            name: "halos of a selection a million voxels away",
            breaks: "seeds in planes and boxes that far away",
            done: "a set seeds in its own box [VS-2]",
            of: "the largest difference of a channel to the ghost alone, and intensities of the selection's own halo",
            bound: 1e-12,
            why: "nothing of the selection is on the picture's rays, nor on those of the guard band",
            measure: halos_far_away,
        },
        Case {
            name: "halos of a selection mirrored onto itself, then by a matrix",
            breaks: "normals that a negative determinant turns inside out: seeds by direction on the other side",
            done: "s of the moved field's normal [VS-2]",
            of: "the largest difference of a channel; floor 0",
            bound: 1e-9,
            why: "positions are rounded once more",
            measure: halos_of_a_mirror,
        },
    ],
);

#[test]
fn objects() {
    THEME.hold();
}

/// A lit body on a small picture, with more in its scene.
fn scene(opacity: f64, more: &str) -> String {
    format!(
        "drypoint = 1\n[volume]\nphantom = {{ name = \"ellipsoid\", size = 20 }}\n\
         [picture]\nsize = [24, 20]\nsamples = 1\nbackground = \"none\"\n\
         [transfer]\nkind = \"regular\"\n\
         nodes = [{{ at = 100, color = \"#c08040\", opacity = 0 }}, {{ at = 130, color = \"#4080c0\", opacity = {opacity} }}]\n\
         [shading]\n{more}"
    )
}

fn channels(opacity: f64, more: &str) -> Vec<f64> {
    channels_of(&scene(opacity, more))
}

/// The channels of a scene's picture.
fn channels_of(text: &str) -> Vec<f64> {
    let scene = parse(text, Path::new("scene.toml"), &Overrides::default());
    let job = Job::load(scene.unwrap_or_else(|faults| panic!("{faults}"))).unwrap_or_else(|f| panic!("{f}"));
    let (picture, _): (Picture, _) = job.renderer().unwrap_or_else(|failure| panic!("{failure}")).again(&|_| ());
    let all: Vec<f64> = picture.layers.into_iter().flat_map(|layer| layer.channels).flatten().collect();
    assert!(all.iter().filter(|x| **x > 0.0).count() > 60);
    all
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn half_selected() -> f64 {
    // 0.9·(v − 100)/30 is ½ at this value.
    let least = format!("at = {}", 100.0 + 30.0 * (0.5 / 0.9));
    let capped = channels_of(&scene(0.5, "").replace("at = 130", &least));
    let half = channels(0.9, "[[object]]\nvalue = [[0, 0.5]]\n");
    let alphas = |all: &[f64]| all[all.len() / 4 * 3..].to_vec();
    assert!(largest_difference(&alphas(&half), &alphas(&channels(0.9, ""))) > 0.01);
    largest_difference(&alphas(&half), &alphas(&capped))
}

fn nothing_selected() -> f64 {
    let plain = channels(0.3, "");
    let object =
        "[[object]]\nvalue = [[0, 0]]\nmove = [4, 0, 0]\nrotate = { angle = 30 }\nghosting = 1\nfunnel = \"3 px\"\n";
    let with = channels(0.3, object);
    plain.iter().zip(&with).filter(|(a, b)| a.to_bits() != b.to_bits()).count() as f64
}

fn far_away() -> f64 {
    let camera = "[camera]\n[combine]\nfuzzy = \"product\"\n";
    largest_difference(&channels(0.3, camera), &channels(0.3, &format!("{camera}[[object]]\nmove = [1e6, 0, 0]\n")))
}

fn mirrored() -> f64 {
    let clear = "[object.ghost.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }]\n";
    let plain = channels(0.3, "");
    // About the centre, (9.5, 9.5, 9.5).
    let matrix = "matrix = [[1, 0, 0, 0], [0, -1, 0, 19], [0, 0, 1, 0], [0, 0, 0, 1]]\n";
    let both = ["scale = [1, 1, -1]\n", matrix].map(|motion| channels(0.3, &format!("[[object]]\n{motion}{clear}")));
    both.iter().map(|picture| largest_difference(&plain, picture)).fold(0.0, f64::max)
}

fn transparent_intersection() -> f64 {
    let clear = "[object.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }]\n\
                 [object.ghost.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }]\n";
    let object = format!(
        "[[object]]\nname = \"half\"\nvalue = [[0, 0.5]]\nmove = [3, 0, 0]\n{clear}[[intersection]]\nobject = \"half\"\n\
         [[intersection]]\nobject = \"half\"\nwith = \"background\"\nopacity = \"out\"\n"
    );
    channels(0.3, &object).iter().filter(|x| !x.is_finite()).count() as f64
}

fn faded_twice() -> f64 {
    let object = |gamma: &str| {
        let small = "value = [[150, 0], [160, 1]]\n";
        channels(0.3, &format!("[[object]]\n{small}ghosting = {gamma}\n"))
    };
    let plain = channels(0.3, "");
    assert!(largest_difference(&plain, &object("0.5")) > 0.01);
    largest_difference(&object("0.5"), &object("1"))
}

/// A halo from one side about each of the parts that are named; none: about all.
fn halos(parts: &[&str]) -> String {
    let halo = |part: &&str| {
        let object = if part.is_empty() { String::new() } else { format!("object = \"{part}\"\n") };
        format!(
            "[[halo]]\nname = \"about {part}\"\n{object}floor = 0\nexponents = [0.5, 3]\n\
             seed = {{ value = \"opacity\", direction = {{ toward = 60, width = 90 }} }}\n"
        )
    };
    parts.iter().map(halo).collect()
}

/// The channels of a scene with layers of its halos.
fn channels_with_halos(parts: &[&str], more: &str) -> Vec<f64> {
    let layers: Vec<String> = (0..parts.len()).map(|i| format!("\"halo{i}\"")).collect();
    let layers = format!("samples = 1\nlayers = [\"beauty\", {}]\n", layers.join(", "));
    let text = scene(0.6, &format!("{}{more}", halos(parts))).replace("samples = 1\n", &layers);
    channels_of(&text)
}

/// The channels of the last halo.
fn last(channels: &[f64]) -> &[f64] {
    &channels[channels.len() - 480..]
}

fn halos_of_nothing() -> f64 {
    let object =
        "[[object]]\nvalue = [[0, 0]]\nmove = [4, 0, 0]\nrotate = { angle = 30 }\nghosting = 1\nfunnel = \"3 px\"\n";
    let plain = channels_with_halos(&["", "background"], "");
    let with = channels_with_halos(&["", "background"], object);
    assert!(last(&plain).iter().filter(|h| **h > 0.05).count() > 20);
    plain.iter().zip(&with).filter(|(a, b)| a.to_bits() != b.to_bits()).count() as f64
}

fn halos_far_away() -> f64 {
    let product = "[camera]\n[combine]\nfuzzy = \"product\"\n";
    let object = "[[object]]\nname = \"all\"\nmove = [1e6, 0, 0]\n";
    let plain = channels_with_halos(&[""], product);
    assert!(last(&plain).iter().filter(|h| **h > 0.05).count() > 20);
    let with = channels_with_halos(&[""], &format!("{product}{object}"));
    let own = channels_with_halos(&["all"], &format!("{product}{object}"));
    let most = last(&own).iter().copied().fold(0.0, f64::max);
    largest_difference(&plain, &with).max(most)
}

fn halos_of_a_mirror() -> f64 {
    let clear = "[object.ghost.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }]\n";
    let matrix = "matrix = [[1, 0, 0, 0], [0, -1, 0, 19], [0, 0, 1, 0], [0, 0, 0, 1]]\n";
    let plain = channels_with_halos(&[""], "");
    assert!(last(&plain).iter().filter(|h| **h > 0.05).count() > 20);
    let both = ["scale = [1, 1, -1]\n", matrix]
        .map(|motion| channels_with_halos(&[""], &format!("[[object]]\nname = \"all\"\n{motion}{clear}")));
    both.iter().map(|picture| largest_difference(&plain, picture)).fold(0.0, f64::max)
}

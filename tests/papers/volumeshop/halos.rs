//! Halos beside objects ([VS-2]): s = max over sets of min(μ of the selection set, s of the set's own sample).

use super::motions::VOLUME;
use super::{LIT, SHELLS, difference, drawn, layer, scene_of, seen};
use drypoint::scene::picture::{LayerKind, Picture};

/// A scene with halos, of which layers show the first `layers`.
fn with_layers(volume: &str, rest: &str, layers: usize) -> String {
    let names: Vec<String> = (0..layers).map(|i| format!("\"halo{i}\"")).collect();
    let layers = format!("samples = 1\nlayers = [\"beauty\", {}]\n", names.join(", "));
    scene_of(volume, rest).replace("samples = 1\n", &layers)
}

/// The intensities of a halo.
fn intensities(picture: &Picture, halo: usize) -> Vec<f64> {
    layer(picture, LayerKind::Halo(halo))[0].clone()
}

/// The intensities of the only halo of a scene.
fn one(rest: &str) -> Vec<f64> {
    intensities(&drawn(&with_layers(SHELLS, rest, 1)).0, 0)
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

/// A halo whose intensities are its seeds, and whose seeds are h_v wherever there is a normal.
fn flat(seed: &str) -> String {
    format!(
        "[[halo]]\nfloor = 0\nexponents = [0, 0]\nseed.value = {seed}\nspread = {{ from = \"seeds\", passes = 0 }}\n"
    )
}

/// A halo of each kind, by opacity, by curvature, and by direction and place.
const THREE: &str = "[[halo]]\nname = \"dark\"\nprofile = [{ at = 0, color = \"black\", opacity = 0 }, { at = 0.2, color = \"black\" }]\n\
    [[halo]]\nname = \"glow\"\nkind = \"emissive\"\nseed = { value = \"opacity\", by = \"curvature\", thickness = \"2 voxels\" }\n\
    profile = [{ at = 0, color = \"red\", opacity = 0 }, { at = 0.2, color = \"red\" }]\n\
    [[halo]]\nname = \"side\"\nexponents = [0.25, 2]\n\
    seed = { value = [[60, 0], [120, 1]], direction = { toward = 45, width = 150 }, focus = { at = [[10, 12, 16]], inner = 12, falloff = 12 } }\n";

/// f_S ≡ 0 and f_S ≡ 1 with equal looks equal the picture without a selection, with its halos and their intensities.
#[test]
fn nothing_and_everything_selected_have_the_same_halos() {
    let styles = "[transfer]\nnodes = [{ at = 20, style = \"wax\", opacity = 0 }, { at = 255, style = \"metal\", opacity = 0.5 }]\n[contours]\n";
    let clip = "[[clip]]\npoint = [16, 20, 16]\nnormal = [0, 1, 0]\n";
    for (look, kernel, clip) in [(LIT, "trilinear", ""), (styles, "bspline", ""), (LIT, "bspline", clip)] {
        let rest = format!("{look}[sampling]\nkernel = \"{kernel}\"\n{clip}");
        let (none, _) = drawn(&scene_of(SHELLS, &rest));
        let (plain, counts) = drawn(&with_layers(SHELLS, &format!("{rest}{THREE}"), 3));
        let change = difference(&none, &plain);
        assert!(change > 0.05 && counts.halo_samples > 1000, "{kernel}: {change}, {}", counts.halo_samples);
        for halo in 0..3 {
            let shown = intensities(&plain, halo).iter().filter(|h| **h > 0.05).count();
            assert!(shown > 20, "{kernel} {clip} {halo}: {shown}");
        }
        for fuzzy in ["zadeh", "product"] {
            for object in ["value = [[0, 0]]", "value = [[0, 1]]", "", "value = [[0, 0]]\nmove = [3, 0, 0]"] {
                let objects = format!("[combine]\nfuzzy = \"{fuzzy}\"\n[[object]]\n{object}\n");
                let (picture, _) = drawn(&with_layers(SHELLS, &format!("{rest}{THREE}{objects}"), 3));
                let off = (0..3)
                    .map(|halo| largest_difference(&intensities(&plain, halo), &intensities(&picture, halo)))
                    .fold(difference(&plain, &picture), f64::max);
                assert!(off < 1e-12, "{kernel} {fuzzy} {object}: {off:e}");
            }
        }
    }
}

/// With nothing selected a halo of the background is a halo, and does its work.
#[test]
fn a_halo_of_the_background_alone() {
    let of = |part: &str| format!("[[halo]]\n{part}exponents = [0.5, 2]\n");
    let (plain, counts) = drawn(&with_layers(SHELLS, &format!("{LIT}{}", of("")), 1));
    let objects = "[[object]]\nname = \"none\"\nvalue = [[0, 0]]\nmove = [3, 0, 0]\n";
    let (picture, of_picture) =
        drawn(&with_layers(SHELLS, &format!("{LIT}{}{objects}", of("object = \"background\"\n")), 1));
    assert_eq!(plain, picture);
    assert_eq!((counts.halo_samples, counts.gradients), (of_picture.halo_samples, of_picture.gradients));
    for part in ["none", "none ghost"] {
        let (picture, counts) =
            drawn(&with_layers(SHELLS, &format!("{LIT}{}{objects}", of(&format!("object = \"{part}\"\n"))), 1));
        assert_eq!((counts.halo_samples, counts.halo_passes), (0, 0));
        assert!(intensities(&picture, 0).iter().all(|h| *h == 0.0));
    }
}

/// A part that no halo takes is not looked up for seeds, and pieces of the background share one look-up.
#[test]
fn only_parts_that_seed_are_asked() {
    let counted = |halo: &str, objects: &str| drawn(&scene_of(SHELLS, &format!("{LIT}[[halo]]\n{halo}{objects}"))).1;
    let piece = "[[object]]\nname = \"core\"\nvalue = [[190, 0], [200, 1]]\n";
    let plain = counted("", "").halo_samples;
    assert!(plain > 1000);
    assert_eq!(counted("object = \"background\"\n", piece).halo_samples, plain);
    let moved = format!("{piece}move = [40, 0, 0]\n");
    assert_eq!(counted("object = \"background\"\n", &moved).halo_samples, plain);
    let core = counted("object = \"core\"\n", piece).halo_samples;
    assert!(0 < core && core < plain / 2, "{core} of {plain}");
}

/// Bricks that can seed nothing are passed over, which no bit shows.
#[test]
fn skipped_bricks_show_nowhere() {
    let volume = "phantom = { name = \"tube-tree\", size = 40 }";
    let objects = "[[object]]\nname = \"all\"\nmove = [6, 2, 0]\nrotate = { angle = 20 }\nghosting = 0.3\n";
    let with = |skip: &str| {
        let text = format!("{LIT}{THREE}{objects}[sampling]\nskip_empty = {skip}\n");
        drawn(&with_layers(volume, &text.replace("at = 20", "at = 100"), 3))
    };
    let ((skipped, few), (whole, all)) = (with("true"), with("false"));
    assert_eq!(skipped, whole);
    assert!((0..3).all(|halo| intensities(&whole, halo).iter().any(|h| *h > 0.05)));
    assert!(0 < few.halo_samples && few.halo_samples < all.halo_samples, "{}", few.halo_samples);
}

/// Everything is selected, and its ghost and the background seed nothing.
#[test]
fn a_moved_selection_has_the_halo_of_a_moved_camera() {
    let halos = |part: &str, focus: &str| {
        format!(
            "[[halo]]\nname = \"a\"\n{part}floor = 0\nexponents = [0.25, 2]\n\
             [[halo]]\nname = \"b\"\n{part}kind = \"emissive\"\nopacity = 0.4\nfloor = 0\n\
             seed = {{ value = \"opacity\", by = \"curvature\", thickness = \"2 voxels\", direction = {{ toward = 30, width = 90 }} }}\n\
             [[halo]]\nname = \"c\"\n{part}floor = 0\nexponents = [0.25, 1]\n\
             seed = {{ value = \"opacity\", focus = {{ at = [{focus}], inner = 5, falloff = 9 }} }}\n"
        )
    };
    let clear = "[object.ghost.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }]\n";
    let look = "[transfer]\nkind = \"regular\"\n\
        nodes = [{ at = 60, color = \"#c08040\", opacity = 0 }, { at = 200, color = \"#4080c0\", opacity = 0.4 }]\n[shading]\n";
    let contours = ["[contours]\n", "[contours]\nkappa = \"exact\"\n[sampling]\nkernel = \"bspline\"\n"];
    let about = "center = [14, 15, 15]\n";
    let here = "eye = [-30, 5, 20]\nup = [0, 0, 1]\ntarget = [14, 15, 15]\n";
    // The focus stays in the world, so the moved camera has it at T(p).
    let focus = "[14, 10, 15]";
    for (motion, back, focus_back) in [
        (
            "move = [2, 3, -1]\n".to_string(),
            "eye = [-32, 2, 21]\nup = [0, 0, 1]\ntarget = [12, 12, 16]\n",
            "[12, 7, 16]",
        ),
        (
            format!("rotate = {{ axis = [0, 0, 2], angle = 90 }}\n{about}"),
            "eye = [4, 59, 20]\nup = [0, 0, 1]\ntarget = [14, 15, 15]\n",
            "[9, 15, 15]",
        ),
    ] {
        for contours in contours {
            let plain = format!("{look}{contours}[camera]\n{back}{}", halos("", focus_back));
            let (plain, _) = drawn(&with_layers(VOLUME, &plain, 3));
            // Of all parts by opacity, and of the selection alone.
            for part in ["", "object = \"all\"\n"] {
                let object = format!("[[object]]\nname = \"all\"\n{motion}{clear}");
                let moved = format!("{look}{contours}[camera]\n{here}{}{object}", halos(part, focus));
                let (picture, _) = drawn(&with_layers(VOLUME, &moved, 3));
                let off = (0..3)
                    .map(|halo| largest_difference(&intensities(&plain, halo), &intensities(&picture, halo)))
                    .fold(difference(&plain, &picture), f64::max);
                assert!(seen(&plain) > 10.0 && off < 1e-9, "{motion} {part}: {off:e}");
                assert!((0..3).all(|halo| intensities(&plain, halo).iter().filter(|h| **h > 0.1).count() > 20));
            }
        }
    }
}

/// f_S = ½ and ¾ everywhere, not moved: each set seeds by at most its share.
#[test]
fn shares_bound_seeds_by_hand() {
    let opacity =
        |alpha: f64| format!("kind = \"regular\"\nnodes = [{{ at = 0, color = \"red\", opacity = {alpha} }}]\n");
    let with = |f: f64, part: &str, halo: &str| {
        let part = if part.is_empty() { String::new() } else { format!("object = \"{part}\"\n") };
        one(&format!(
            "[transfer]\n{}{}[[object]]\nname = \"part\"\nvalue = [[0, {f}]]\n[object.transfer]\n{}",
            opacity(0.002),
            halo.replace("[[halo]]\n", &format!("[[halo]]\n{part}")),
            opacity(0.009)
        ))
    };
    let is = |shown: Vec<f64>, expected: f64| {
        let (most, some) = (shown.iter().copied().fold(0.0, f64::max), shown.iter().filter(|h| **h > 0.0).count());
        assert!(most == expected && shown.iter().all(|h| *h == 0.0 || *h == expected), "{most}, not {expected}");
        assert!(some > 100, "{some}");
    };
    for (f, h, [all, background, part]) in [
        (0.5, 0.8, [0.5, 0.5, 0.5]),
        (0.5, 0.3, [0.3, 0.3, 0.3]),
        (0.75, 0.8, [0.75, 0.25, 0.75]),
        (0.25, 0.8, [0.75, 0.75, 0.25]),
    ] {
        let halo = flat(&format!("[[0, {h}]]"));
        is(with(f, "", &halo), all);
        is(with(f, "background", &halo), background);
        is(with(f, "part", &halo), part);
    }
    // By the opacity of each set's own function, whatever is seen of it.
    let halo = flat("\"opacity\"");
    is(with(0.5, "", &halo), 0.009);
    is(with(0.5, "background", &halo), 0.002);
    is(with(0.5, "part", &halo), 0.009);
    is(with(0.003, "", &halo), 0.003);
    // Below the floor a seed of a small share is none.
    let floored = flat("[[0, 0.8]]").replace("floor = 0\n", "floor = 0.25\n");
    is(with(0.25, "part", &floored), 0.25);
    assert!(with(0.2, "part", &floored).iter().all(|h| *h == 0.0));
}

/// Two whole selections with product operators share what is there: ½ each, and nothing is left of the background.
#[test]
fn product_operators_share_seeds() {
    let objects = "[[object]]\nname = \"a\"\nvalue = [[0, 1]]\n[[object]]\nname = \"b\"\nvalue = [[0, 1]]\n";
    let with = |fuzzy: &str, part: &str| {
        let halo = flat("[[0, 0.8]]").replace("[[halo]]\n", &format!("[[halo]]\nobject = \"{part}\"\n"));
        let faint = LIT.replace("opacity = 0.4", "opacity = 0.001");
        let shown = one(&format!("{faint}{halo}[combine]\nfuzzy = \"{fuzzy}\"\n{objects}"));
        shown.into_iter().fold(0.0, f64::max)
    };
    assert_eq!(["a", "b", "background"].map(|part| with("product", part)), [0.5, 0.5, 0.0]);
    assert_eq!(["a", "b", "background"].map(|part| with("zadeh", part)), [0.8, 0.8, 0.0]);
}

/// A background before the far side of a box, behind which nothing is left of it: ghosting factors fade its seeds.
fn cut_open(gamma: f64, halo: &str, rest: &str) -> Vec<f64> {
    // A selection that is next to nothing, with a box all the same.
    let object = format!("[[object]]\nvalue = [[190, 0], [200, 1e-12]]\nghosting = {gamma}\n");
    let clip = "[[clip]]\npoint = [16, 16, 16]\nnormal = [0, 0, 1]\n";
    let camera = "[camera]\nprojection = \"orthographic\"\ndirection = [0, 0, 1]\nup = [0, 1, 0]\n";
    one(&format!("{halo}{clip}{camera}{object}{rest}"))
}

/// Regular functions have e = 0: seeds before d fade by 1 − 2γ, and γ = 1 leaves none.
#[test]
fn cutaways_fade_seeds_by_hand() {
    let faint = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0.001 }]\n";
    let halo = flat("[[0, 0.8]]").replace("[[halo]]\n", "[[halo]]\nobject = \"background\"\n");
    let plain = cut_open(0.0, &halo, faint);
    let gone = cut_open(1.0, &halo, faint);
    let cut: Vec<bool> = plain.iter().zip(&gone).map(|(plain, gone)| *plain > 0.0 && *gone == 0.0).collect();
    // The box of the inner ball, and the same picture about it.
    let (columns, rows) = (0..480).filter(|&i| cut[i]).map(|i| (i % 24, i / 24)).unzip::<_, _, Vec<_>, Vec<_>>();
    let side = |places: &[usize]| places.iter().max().unwrap() - places.iter().min().unwrap() + 1;
    assert_eq!(columns.len(), side(&columns) * side(&rows));
    assert!(columns.len() >= 16 && plain.iter().filter(|h| **h == 0.8).count() > columns.len() + 60);
    for (gamma, factor) in [(0.0, 1.0), (0.125, 0.75), (0.25, 0.5), (0.5, 0.0), (1.0, 0.0)] {
        let faded = cut_open(gamma, &halo, faint);
        for (i, h) in faded.iter().enumerate() {
            let expected = if cut[i] { plain[i] * factor } else { plain[i] };
            assert!((h - expected).abs() < 1e-15, "{gamma} {i}: {h}, not {expected}");
        }
    }
}

/// A lighting function without s_α has e = |N|: seeds fade by max(0, 1 − γ(2 − |N|)), which grows with |N|. A halo of h·|g|
/// shows the largest |N| on each ray.
#[test]
fn enhanced_places_keep_their_seeds() {
    let faint = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0.00001 }]\n\
        [shading]\nmodel = \"lighting-function\"\npreset = \"gradient\"\n";
    let halo = |a: f64| {
        flat("[[0, 0.8]]")
            .replace("[0, 0]", &format!("[{a}, 0]"))
            .replace("[[halo]]\n", "[[halo]]\nobject = \"background\"\n")
    };
    let magnitudes = cut_open(0.0, &halo(1.0), faint);
    let (plain, gamma) = (cut_open(0.0, &halo(0.0), faint), 0.55);
    let faded = cut_open(gamma, &halo(0.0), faint);
    let mut cut = 0;
    for i in 0..480 {
        let expected = 0.8 * (1.0 - gamma * (2.0 - magnitudes[i] / 0.8)).max(0.0);
        let is_cut = (faded[i] - expected).abs() < 1e-12 && plain[i] > 0.0;
        assert!(is_cut || faded[i] == plain[i], "{i}: {} of {}, {expected}", faded[i], plain[i]);
        cut += usize::from(is_cut && expected > 0.05 && expected < 0.79);
    }
    assert!(cut >= 12, "{cut}");
}

/// A ghost seeds where the selection was, as the selection would if it were not moved.
#[test]
fn a_ghost_seeds_at_its_original_place() {
    let with = |part: &str, motion: &str| {
        let halo = format!("[[halo]]\nobject = \"{part}\"\nexponents = [0.5, 2]\nseed.value = [[0, 1]]\n");
        let faint = LIT.replace("opacity = 0.4", "opacity = 0.01");
        one(&format!("{faint}{halo}[camera]\n[[object]]\nname = \"core\"\nvalue = [[150, 0], [200, 1]]\n{motion}"))
    };
    let here = with("core", "");
    assert!(here.iter().filter(|h| **h > 0.05).count() > 20);
    assert_eq!(with("core ghost", "move = [3, 1, 0]\n"), here);
    assert_ne!(with("core", "move = [3, 1, 0]\n"), here);
    assert!(with("core", "move = [1000, 0, 0]\n").iter().all(|h| *h == 0.0));
}

/// A volume of bytes, 16 voxels a side: the distance to two rods along y, at x = 4 and x = 11, or which of them is nearer.
fn rods(path: &std::path::Path, of_labels: bool) {
    let voxel = |i: usize| {
        let [x, z] = [i % 16, i / 256].map(|at| at as f64);
        let distance = |to: f64| (x - to).hypot(z - 7.5);
        let nearer = 1 + u8::from(distance(11.0) < distance(4.0));
        if of_labels { nearer } else { (200.0 - 30.0 * distance(4.0).min(distance(11.0))).max(0.0) as u8 }
    };
    let header = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 16 16 16\nspacings: 1 1 1\nencoding: raw\n\n";
    std::fs::write(path, [header.as_bytes(), &(0..4096).map(voxel).collect::<Vec<u8>>()].concat()).unwrap();
}

/// Labels and their names are those of the data that seed; data without labels have none to seed by.
#[test]
fn labels_are_those_of_the_data() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| format!("{:?}", folder.path().join(name).display().to_string());
    rods(&folder.path().join("rods.nrrd"), false);
    rods(&folder.path().join("labels.nrrd"), true);
    std::fs::write(folder.path().join("names.csv"), "1,left\n2,right\n").unwrap();
    let data = path("rods.nrrd");
    let labels = format!("labels = {}\nlabel_names = {}\n", path("labels.nrrd"), path("names.csv"));
    let look = "kind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }, { at = 200, color = \"red\", opacity = 0.01 }]\n";
    let camera = "[camera]\nprojection = \"orthographic\"\ndirection = [0.2, 0.4, 1]\n";
    let halo = |part: &str, label: &str| {
        format!(
            "{camera}[[halo]]\n{part}exponents = [0.5, 2]\nseed.value = [[60, 0], [150, 1]]\nseed.labels = [{label}]\n\
             spread.passes = 2\n"
        )
    };
    let of = |volume: &str, rest: &str| intensities(&drawn(&with_layers(volume, rest, 1)).0, 0);
    let alone =
        |label: &str| of(&format!("file = {data}\n{labels}"), &format!("[transfer]\n{look}{}", halo("", label)));
    let (left, right) = (alone("\"left\""), alone("2"));
    assert!(largest_difference(&left, &right) > 0.2);
    // The same data as an object's beside a constant volume without labels.
    let clear = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }]\n";
    let beside = |own: &str, halo: &str| {
        let object = format!("[[object]]\nname = \"rods\"\nvolume = {data}\n{own}[object.transfer]\n{look}");
        of("phantom = { name = \"constant\", size = 16 }", &format!("{clear}{halo}{object}"))
    };
    let part = "object = \"rods\"\n";
    assert_eq!([beside(&labels, &halo(part, "1")), beside(&labels, &halo(part, "\"right\""))], [left, right]);
    // A name that the object's table does not have is told at its key; a scene without labels, too.
    let faults = |volume: &str, own: &str, halo: &str| {
        let object = format!("[[object]]\nname = \"rods\"\nvolume = {data}\n{own}[object.transfer]\n{look}");
        let text = with_layers(volume, &format!("{clear}{halo}{object}"), 1);
        match drypoint::scene::file::parse(&text, std::path::Path::new("s.toml"), &Default::default()) {
            Err(faults) => faults.to_string(),
            Ok(scene) => drypoint::job::Job::load(scene).err().map_or(String::new(), |failures| failures.to_string()),
        }
    };
    let constant = "phantom = { name = \"constant\", size = 16 }";
    let told = faults(constant, &labels, &halo(part, "\"rihgt\""));
    assert!(told.contains("rihgt") && told.contains("halo[0].seed.labels[0]") && told.contains("right"), "{told}");
    let told = faults(constant, "", &halo(part, "1"));
    assert!(told.contains("halo[0].seed.labels") && told.contains("object[0].labels = "), "{told}");
    // A halo of all parts takes labels of the main volume; the object's data have none.
    let main = format!("file = {data}\n{labels}");
    assert_eq!(faults(&main, "", &halo("", "\"left\"")), "");
    let all = |own: &str| {
        let object =
            format!("[[object]]\nname = \"rods\"\nvolume = {data}\nmove = [0, 0, 1]\n{own}[object.transfer]\n{look}");
        of(&main, &format!("[transfer]\n{look}{}{object}", halo("", "\"left\"")))
    };
    assert_eq!(all(""), alone("\"left\""));
    assert_ne!(all(&labels), alone("\"left\""));
}

/// The largest of several sets does not depend on the order of their tables.
#[test]
fn the_order_of_objects_does_not_matter() {
    let objects = [
        "[[object]]\nname = \"a\"\nvalue = [[100, 0], [200, 0.6]]\nmove = [2, 1, 0]\n",
        "[[object]]\nname = \"b\"\nvalue = [[60, 0.7], [220, 0]]\nscale = 1.25\n",
        "[[object]]\nname = \"c\"\nvalue = [[150, 0], [255, 0.9]]\n",
    ];
    let faint = LIT.replace("opacity = 0.4", "opacity = 0.001");
    let with = |order: [usize; 3]| {
        let halo = flat("[[20, 0], [255, 1]]").replace("[0, 0]", "[0.5, 2]");
        one(&format!("{faint}{halo}{}", order.map(|i| objects[i]).concat()))
    };
    let first = with([0, 1, 2]);
    assert!(first.iter().filter(|h| **h > 0.05).count() > 40);
    assert_eq!(with([2, 0, 1]), first);
    assert_eq!(with([1, 0, 2]), first);
}

/// Seeds beyond the frame are cut as in a larger picture, also by a funnel whose object lies there.
#[test]
fn a_crop_with_a_funnel_is_the_picture_of_the_crop() {
    let picture = |size: [usize; 2], height: usize| {
        let camera = format!("[camera]\nprojection = \"orthographic\"\nheight = {height}\ndirection = [0.2, 1, 0.3]\n");
        let object = "[[object]]\nname = \"core\"\nvalue = [[180, 0], [200, 1]]\nmove = [9, 0, 0]\nghosting = 1\nfunnel = \"2 px\"\n";
        let halo = "[[halo]]\nexponents = [0.25, 2]\nspread.passes = 3\n";
        let text = with_layers(SHELLS, &format!("{LIT}{camera}{halo}{object}"), 1);
        drawn(&text.replace("size = [24, 20]", &format!("size = [{}, {}]", size[0], size[1]))).0
    };
    let (whole, crop) = (picture([48, 48], 48), picture([16, 12], 12));
    for (large, small) in whole.layers.iter().zip(&crop.layers) {
        for (large, small) in large.channels.iter().zip(&small.channels) {
            let cut: Vec<f64> = (18..30).flat_map(|y| large[y * 48 + 16..y * 48 + 32].iter().copied()).collect();
            assert!(cut == *small && small.iter().any(|v| *v != small[0]));
        }
    }
}

/// Threads, bands and tiles show nowhere, and the memory of objects on rays is foretold.
#[test]
fn bands_show_nowhere() {
    let object = "[[object]]\nvalue = [[100, 0], [200, 0.6]]\nmove = [2, 1, 0]\nghosting = 0.5\ncut = \"object\"\n";
    let text = with_layers(SHELLS, &format!("{LIT}{THREE}{object}"), 3).replace("[24, 20]", "[24, 90]");
    let scene = drypoint::scene::file::parse(&text, std::path::Path::new("s"), &Default::default());
    let job = drypoint::job::Job::load(scene.unwrap_or_else(|faults| panic!("{faults}"))).unwrap();
    let (whole, counts) = job.renderer().unwrap().again(&|_| ());
    let bands = job.renderer().unwrap().with_band(1).with_tiles(4);
    let foretold = job.renderer().unwrap().bytes_of_halos();
    let found: u64 = ["halos", "rays", "seed_rays"].iter().map(|buffer| counts.bytes[*buffer]).sum();
    assert!(found <= foretold, "{found} {foretold}");
    assert_eq!(whole, bands.again(&|_| ()).0);
}

//! Which scene needs what, and why.

use super::*;
use crate::file::{Overrides, Place, parse};
use crate::tables::root::ROOT;
use Quantity::{Gradient, GradientMagnitudeRange, Hessian, PreviousNormal, Value};

fn plan(rest: &str) -> Plan {
    let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{rest}");
    let scene = parse(&text, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|f| panic!("{f}"));
    Plan::new(&scene)
}

fn quantities(plan: &Plan) -> Vec<Quantity> {
    let mut all: Vec<Quantity> = plan.needs.iter().map(|need| need.quantity).collect();
    all.dedup();
    all
}

const REGULAR: &str = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, color = \"red\" }]\n";
const PLAIN: &str = "[transfer]\ntransparency = \"plain\"\nnodes = [{ at = 1, style = \"wax\" }]\n";
const OVER: &str = "[transfer]\nkind = \"regular\"\nrows = [{ at = 1, nodes = [{ at = 1, color = \"red\" }] }]\n";
const ILLUSTRATIVE: &str = "[transfer]\nnodes = [{ at = 1, style = \"wax\" }]\n";

#[test]
fn a_scene_needs_what_its_effects_need_and_no_more() {
    let cases: &[(&str, &str, &[Quantity])] = &[
        (REGULAR, "", &[Value]),
        (REGULAR, "[shading]\n", &[Value, Gradient]),
        // A lighting function reads |g| where it enhances opacities, and for all that is known of a picture.
        (REGULAR, "[shading]\nmodel = \"lighting-function\"\n", &[Value, Gradient]),
        (REGULAR, "[shading]\nmodel = \"lighting-function\"\npreset = \"tone\"\n", &[Value, Gradient]),
        (
            REGULAR,
            "[shading]\nmodel = \"lighting-function\"\npreset = \"gradient\"\n",
            &[Value, Gradient, GradientMagnitudeRange],
        ),
        (
            REGULAR,
            "[shading]\nmodel = \"lighting-function\"\ntable = \"t.png\"\n",
            &[Value, Gradient, GradientMagnitudeRange],
        ),
        (REGULAR, "[shading]\npreset = \"gradient\"\n", &[Value, Gradient]),
        (PLAIN, "", &[Value, Gradient]),
        (PLAIN, "[shading]\n", &[Value, Gradient]),
        (PLAIN, "[contours]\n", &[Value, Gradient, PreviousNormal]),
        (PLAIN, "[contours]\nkappa = \"exact\"\n", &[Value, Gradient, Hessian]),
        (PLAIN, "[contours]\nkappa = \"none\"\n", &[Value, Gradient]),
        (ILLUSTRATIVE, "", &[Value, Gradient, GradientMagnitudeRange]),
        (PLAIN, "[contours]\nkappa = \"none\"\nfade = [0, 1]\n", &[Value, Gradient, GradientMagnitudeRange]),
        // Contours of a regular function compute nothing, whatever they ask for.
        (REGULAR, "[contours]\nkappa = \"exact\"\nfade = [0, 1]\n", &[Value]),
        // Layers ask for themselves.
        (REGULAR, "[picture]\nlayers = [\"beauty\", \"Z\", \"depth\", \"first\", \"counts\"]\n", &[Value]),
        (REGULAR, "[picture]\nlayers = [\"normal\"]\n", &[Value, Gradient]),
        (REGULAR, "[picture]\nlayers = [\"gradient\"]\n", &[Value, Gradient]),
        (REGULAR, "[picture]\nlayers = [\"curvature.KV\"]\n", &[Value, Gradient, PreviousNormal]),
        (REGULAR, "[picture]\nlayers = [\"curvature\"]\n", &[Value, Gradient, PreviousNormal, Hessian]),
        (REGULAR, "[picture]\nlayers = [\"curvature\"]\n[contours]\nkappa = \"exact\"\n", &[Value, Gradient, Hessian]),
        (PLAIN, "[picture]\nlayers = [\"curvature.KV\"]\n[contours]\nkappa = \"exact\"\n", &[Value, Gradient, Hessian]),
        // Mip-maps have the κ of the contours, or else the one along the ray; a bias of 0 needs nothing.
        (PLAIN, "[style_mipmaps]\n", &[Value, Gradient, PreviousNormal, GradientMagnitudeRange]),
        (PLAIN, "[style_mipmaps]\ngradient_bias = 0\n", &[Value, Gradient, PreviousNormal]),
        (PLAIN, "[style_mipmaps]\ncurvature_bias = 0\n", &[Value, Gradient, GradientMagnitudeRange]),
        (PLAIN, "[style_mipmaps]\ncurvature_bias = 0\ngradient_bias = 0\n", &[Value, Gradient]),
        (
            PLAIN,
            "[style_mipmaps]\n[contours]\nkappa = \"exact\"\n",
            &[Value, Gradient, Hessian, GradientMagnitudeRange],
        ),
        (PLAIN, "[style_mipmaps]\n[contours]\nkappa = \"none\"\n", &[Value, Gradient, GradientMagnitudeRange]),
        (REGULAR, "[style_mipmaps]\n", &[Value]),
        // A function over two quantities needs what they are made of, shaded or not.
        ("OVER", "[\"value\", \"gradient-magnitude\"]", &[Value, Gradient]),
        ("OVER", "[\"k1\", { distance = [0, 0, 0] }]", &[Value, Gradient, Hessian, Quantity::Distance]),
        ("OVER", "[\"value\", \"kv\"]", &[Value, Gradient, PreviousNormal]),
        ("OVER", "[\"value\", \"kv\"]\n[contours]\nkappa = \"exact\"", &[Value, Gradient, Hessian]),
        ("OVER", "[\"value\", \"kv\"]\n[contours]\nkappa = \"none\"", &[Value, Gradient, PreviousNormal]),
        ("OVER", "[\"value\", { volume = \"b.nrrd\" }]", &[Value, Quantity::FurtherVolume]),
        ("OVER", "[\"value\", { distance = [0, 0, 0] }]", &[Value, Quantity::Distance]),
    ];
    for (transfer, rest, expected) in cases {
        let (transfer, rest) = match *transfer {
            "OVER" => (OVER, &format!("over = {rest}\n")),
            transfer => (transfer, &(*rest).to_owned()),
        };
        assert_eq!(quantities(&plan(&format!("{transfer}{rest}"))), *expected, "{transfer}{rest}");
    }
}

#[test]
fn what_only_first_samples_need_is_asked_there_alone() {
    let needs = |rest: &str| -> Vec<(Quantity, Samples)> {
        plan(rest).needs.iter().map(|need| (need.quantity, need.samples)).collect()
    };
    let layers = |names: &str| format!("{REGULAR}[picture]\nlayers = [{names}]\n");
    let (every, first) = (Samples::Visible, Samples::First);
    assert_eq!(needs(&layers("\"first.normal\"")), [(Value, every), (Gradient, first)]);
    assert_eq!(
        needs(&layers("\"first.curvature\"")),
        [(Value, every), (Gradient, first), (PreviousNormal, first), (Hessian, first)]
    );
    assert_eq!(
        needs(&format!("{}[contours]\nkappa = \"exact\"\n", layers("\"first.curvature.KV\""))),
        [(Value, every), (Gradient, first), (Hessian, first)]
    );
    // What every sample needs anyway is made of what every sample needs.
    assert_eq!(
        needs(&layers("\"first.curvature\", \"normal\"")),
        [(Value, every), (Gradient, every), (PreviousNormal, first), (Hessian, first)]
    );
    let plan = plan(&layers("\"first.normal\""));
    assert!(plan.needs_at_first(Gradient) && !plan.needs(Gradient) && !plan.needs_at_first(Hessian));
    assert!(plan.to_string().contains("layer first.normal           gradient      one gradient a ray "), "{plan}");
}

#[test]
fn what_a_scene_leaves_to_the_volume_is_settled_by_it() {
    let text = format!("drypoint = 1\n[volume]\nfile = \"a\"\n{PLAIN}[contours]\nkappa = \"exact\"\n[sampling]\n");
    for (hessian, integers, floats) in [("auto", true, false), ("gaussian", true, true), ("central", false, false)] {
        let text = format!("{text}scale = 2\nhessian = \"{hessian}\"\n");
        let scene = parse(&text, "s.toml".as_ref(), &Overrides::default()).unwrap();
        for (integer, smooths) in [(true, integers), (false, floats)] {
            let mut plan = Plan::new(&scene);
            plan.settle(&scene, integer);
            assert_eq!(plan.has_pass(Pass::SmoothedCoefficients), smooths, "{hessian} {integer}");
            assert_eq!(plan.idle_keys.iter().any(|idle| idle.key == "sampling.scale"), !smooths, "{hessian} {integer}");
        }
    }
}

#[test]
fn gradient_magnitudes_are_measured_as_the_unit_says() {
    let over = format!("{OVER}over = [\"value\", \"gradient-magnitude\"]\n");
    let normalized = plan(&format!("{over}unit = \"normalized\"\n"));
    assert!(normalized.needs(GradientMagnitudeRange) && normalized.has_pass(Pass::GradientRange));
    assert!(!plan(&over).needs(GradientMagnitudeRange) && !plan(&over).has_pass(Pass::GradientRange));
    let told: Vec<String> =
        plan(&over).to_string().lines().map(|l| l.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    let line = "function over gradient-magnitude gradient one gradient a visible sample transfer.over (line 7)";
    assert!(told.iter().any(|l| l == line), "{told:?}");
}

#[test]
fn a_range_of_gradients_that_is_given_is_not_computed() {
    let fixed = plan(&format!("gradient_range = [0, 60]\n{ILLUSTRATIVE}"));
    assert!(fixed.needs(GradientMagnitudeRange) && !fixed.has_pass(Pass::GradientRange));
    assert!(plan(ILLUSTRATIVE).has_pass(Pass::GradientRange));
    assert!(!plan(PLAIN).has_pass(Pass::GradientRange));
}

#[test]
fn passes_are_those_that_are_called_for() {
    let passes = |rest: &str| plan(rest).passes.iter().map(|need| need.pass).collect::<Vec<_>>();
    assert_eq!(passes(REGULAR), [Pass::Bricks, Pass::Rays, Pass::Refinement]);
    assert_eq!(passes(&format!("{REGULAR}[picture]\nsamples = 1\n[sampling]\nskip_empty = false\n")), [Pass::Rays]);
    let automatic = [Pass::GradientRange, Pass::AutomaticTransfer, Pass::Rays, Pass::Refinement];
    assert_eq!(passes("[sampling]\nskip_empty = false\n"), automatic);
    for (kernel, prefiltered) in
        [("trilinear", false), ("bspline", true), ("bspline5", true), ("bspline-smooth", false), ("catmull-rom", false)]
    {
        let plan = plan(&format!("[sampling]\nkernel = \"{kernel}\"\n"));
        assert_eq!(plan.has_pass(Pass::Coefficients), prefiltered, "{kernel}");
    }
    let exact = "[contours]\nkappa = \"exact\"\n[sampling]\nhessian =";
    for (hessian, smoothed) in [("auto", true), ("gaussian", true), ("central", false)] {
        assert_eq!(plan(&format!("{exact} \"{hessian}\"\n")).has_pass(Pass::SmoothedCoefficients), smoothed);
    }
    assert!(!plan("[sampling]\nhessian = \"gaussian\"\n").has_pass(Pass::SmoothedCoefficients));
    for (rule, hessian, smoothed) in [("raw", "auto", true), ("raw", "central", false), ("scaled", "gaussian", false)] {
        let strokes = format!("[hatching]\ndirections = {{ rule = \"{rule}\" }}\n[sampling]\nkernel = \"bspline\"\n");
        let plan = plan(&format!("{strokes}hessian = \"{hessian}\"\n"));
        assert_eq!(plan.has_pass(Pass::SmoothedCoefficients), smoothed, "{rule} {hessian}");
        assert!(plan.has_pass(Pass::Coefficients) && !plan.has_pass(Pass::Rays));
    }
    assert!(plan(&format!("{PLAIN}[style_mipmaps]\n")).has_pass(Pass::StyleMipmaps));
    assert!(![PLAIN, &format!("{REGULAR}[style_mipmaps]\n")].iter().any(|s| plan(s).has_pass(Pass::StyleMipmaps)));
}

#[test]
fn edges_are_refined_where_a_layer_shows_it_and_pixels_need_not_have_equal_rays() {
    let refines = |rest: &str| plan(&format!("{REGULAR}{rest}")).has_pass(Pass::Refinement);
    assert!(refines("") && refines("[picture]\nlayers = [\"Z\", \"normal\"]\n"));
    assert!(refines("[[halo]]\nopacity = 0\n"), "a halo that is not seen");
    assert!(refines("[style_mipmaps]\n"), "a regular function has no styles");
    assert!(!plan(&format!("{PLAIN}[style_mipmaps]\n")).has_pass(Pass::Refinement));
    for none in ["[picture]\nsamples = 2\n", "[picture]\nlayers = [\"Z\", \"counts\"]\n", "[[halo]]\n"] {
        assert!(!refines(none), "{none}");
        let (head, rest) = none.split_once('\n').unwrap();
        let picture = if head == "[picture]" {
            format!("{head}\ncontrast = 0.1\n{rest}")
        } else {
            format!("[picture]\ncontrast = 0.1\n{none}")
        };
        let idle = plan(&format!("{REGULAR}{picture}")).idle_keys;
        assert_eq!(idle.iter().map(|idle| &*idle.key).collect::<Vec<_>>(), ["picture.contrast"], "{none}");
    }
}

#[test]
fn every_need_names_the_line_that_asked() {
    let plan = plan(&format!("{ILLUSTRATIVE}[contours]\nkappa = \"exact\"\n"));
    let line = |quantity| {
        let need = plan.needs.iter().find(|need| need.quantity == quantity).unwrap();
        (need.effect.as_str(), need.key.as_str(), need.place.as_ref().and_then(Place::line))
    };
    assert_eq!(line(Hessian), ("contours", "contours.kappa", Some(7)));
    // A default is asked for by the table that has it.
    assert_eq!(line(Gradient), ("styles", "transfer.kind", Some(4)));
    assert_eq!(line(GradientMagnitudeRange), ("illustrative transparency", "transfer.transparency", Some(4)));
}

/// The description of a key lists every quantity that the key can call for.
#[test]
fn every_need_is_one_that_the_description_of_its_key_lists() {
    let listed: Vec<(String, &[Quantity])> = ROOT
        .section()
        .keys
        .into_iter()
        .flat_map(|table| {
            let keys = table.shape.section().map_or(Vec::new(), |section| section.keys);
            let keys = keys.into_iter().map(move |key| (format!("{}.{}", table.name, key.name), key.needs));
            std::iter::once((table.name.to_owned(), table.needs)).chain(keys)
        })
        .collect();
    let everything =
        "[contours]\nfade = [0, 1]\n[style_mipmaps]\n[picture]\nlayers = [\"normal\", \"gradient\", \"curvature\"]\n";
    let firsts = "[picture]\nlayers = [\"first.normal\", \"first.curvature\"]\n[transfer]\nkind = \"regular\"\n";
    let exact = "[style_mipmaps]\n[contours]\nkappa = \"exact\"\n";
    let halos = "[[halo]]\nseed.by = \"curvature\"\n[transfer]\nkind = \"regular\"\n";
    for rest in [everything, firsts, exact, halos, "[shading]\n[transfer]\nkind = \"regular\"\n"] {
        for need in plan(rest).needs {
            let key = need.key.split('[').next().unwrap();
            let (_, needs) = listed.iter().find(|(name, _)| name == key).unwrap_or_else(|| panic!("{key}"));
            assert!(needs.contains(&need.quantity), "{key} does not list {:?}", need.quantity);
        }
    }
}

#[test]
fn keys_without_effect_are_listed_not_refused() {
    let idle = |rest: &str| {
        plan(rest).idle_keys.into_iter().map(|idle| (idle.key, idle.place.line().unwrap())).collect::<Vec<_>>()
    };
    let keys = |rest: &str| idle(rest).into_iter().map(|(key, _)| key).collect::<Vec<_>>();
    assert_eq!(idle("[camera]\nprojection = \"orthographic\"\nfov = 30\n"), [("camera.fov".into(), 6)]);
    assert_eq!(keys("[camera]\nheight = 3\n"), ["camera.height"]);
    assert_eq!(keys("[camera]\neye = [1, 2, 3]\ntarget = [0, 0, 0]\ndirection = [1, 0, 0]\n"), ["camera.target"]);
    assert!(keys("[camera]\neye = [1, 2, 3]\ntarget = [0, 0, 0]\n").is_empty());
    assert_eq!(keys(&format!("{REGULAR}[contours]\n")), ["contours"]);
    assert_eq!(keys(&format!("{REGULAR}transparency = \"plain\"\n[styles]\n")), ["transfer.transparency", "styles"]);
    assert_eq!(keys("[contours]\nthreshold = 0.3\n"), ["contours.threshold"]);
    assert_eq!(keys("[contours]\nkappa = \"none\"\nthickness = 1\n"), ["contours.thickness"]);
    assert_eq!(keys("[contours]\nsign_flip = \"literal\"\n"), ["contours.sign_flip"]);
    assert!(keys("[sampling]\nnormal = \"facing\"\n[contours]\nsign_flip = \"literal\"\n").is_empty());
    assert_eq!(keys("[shading]\n"), ["shading"]);
    assert_eq!(keys(&format!("{REGULAR}[style_mipmaps]\n")), ["style_mipmaps"]);
    let constant = "[contours]\nkappa = \"none\"\n[style_mipmaps]\ncurvature_bias =";
    assert_eq!(keys(&format!("{constant} 1\n")), ["style_mipmaps.curvature_bias"]);
    assert!(keys(&format!("{constant} 0\n")).is_empty());
    assert_eq!(keys(&format!("{REGULAR}[shading]\nspecular = 0\nshininess = 9\n")), ["shading.shininess"]);
    // Keys of [shading] act under one model, and constants in the presets that are made of them.
    const ALL: &str = "ambient = 0.1\ndiffuse = 0.1\nspecular = 0.1\nshininess = 9\ncontour = \"printed\"\n\
        divisor_floor = 0.1\n[shading.toon]\n";
    let of_model = |model: &str| {
        let keys = keys(&format!("{REGULAR}[shading]\nmodel = {model}\n{ALL}"));
        keys.iter().map(|key| key.trim_start_matches("shading.").to_owned()).collect::<Vec<_>>()
    };
    let function = |more: &str| of_model(&format!("\"lighting-function\"\n{more}"));
    assert_eq!(of_model("\"phong\""), ["contour", "divisor_floor", "toon"]);
    assert_eq!(of_model("\"toon\""), ["ambient", "diffuse", "specular", "shininess", "contour", "divisor_floor"]);
    assert_eq!(function(""), ["contour", "divisor_floor", "toon"]);
    assert_eq!(function("preset = \"metal-contours\""), ["toon"]);
    assert_eq!(function("preset = \"cartoon-contours\""), ["specular", "shininess", "toon"]);
    assert_eq!(function("preset = \"gradient\""), ["contour", "toon"]);
    assert_eq!(function("preset = \"tone\""), ["ambient", "diffuse", "contour", "divisor_floor", "toon"]);
    assert_eq!(function("table = \"t.png\""), ["ambient", "diffuse", "specular", "shininess", "contour", "toon"]);
    let surface = "[surface]\nlook = \"phong\"\n[shading]\nmodel = \"lighting-function\"\npreset = \"tone\"\n";
    assert_eq!(keys(surface), ["shading.model", "shading.preset"]);
    assert_eq!(
        keys(&format!("gradient_range = \"max\"\noutside = \"high\"\nrange = [0, 1]\n{REGULAR}")),
        ["volume.gradient_range", "volume.outside", "volume.range"].map(String::from).into_iter().collect::<Vec<_>>()
    );
    assert_eq!(
        keys(&format!(
            "{REGULAR}[sampling]\ngradient = \"sobel\"\nhessian = \"central\"\nscale = 1\nnormal = \"facing\"\n"
        )),
        ["sampling.gradient", "sampling.hessian", "sampling.scale", "sampling.normal"]
    );
    assert_eq!(keys("[sampling]\nscale = 1\n"), ["sampling.scale"]);
    // Strokes by the paper's rule read the field's Hessians, those by the default one have their own.
    let strokes = "[hatching]\ndirections = { rule =";
    let smooth = "}\n[sampling]\nhessian = \"gaussian\"\nscale = 1\ngradient = \"sobel\"\nkernel = \"bspline\"\n";
    for (rule, idle) in [("raw", &[][..]), ("scaled", &["sampling.hessian", "sampling.scale"])] {
        for volume in ["", REGULAR] {
            assert_eq!(keys(&format!("{volume}{strokes} \"{rule}\" {smooth}")), idle, "{rule} {volume}");
        }
    }
    assert_eq!(
        keys(&format!("{strokes} \"raw\" }}\n[sampling]\nhessian = \"central\"\nscale = 1\n")),
        ["sampling.scale"]
    );
    assert_eq!(keys("[picture]\ndpi = 72\n"), ["picture.dpi"]);
    assert!(keys("[picture]\ndpi = 72\nwidth = \"9 mm\"\nheight = \"9 mm\"\n").is_empty());
    assert_eq!(keys(&format!("{ILLUSTRATIVE}[styles]\nmine = \"m.png\"\nwax = \"w.png\"\n")), ["styles.mine"]);
    assert_eq!(keys("[transfer]\nunit = \"normalized\"\n"), ["transfer.unit"]);
}

const PENS: &str =
    "[[pen]]\nname = \"a\"\ntone = \"a.csv\"\n[[pen]]\nname = \"b\"\n[[pen]]\nname = \"c\"\ntone = \"c.csv\"\n";

#[test]
fn hooks_run_for_each_item_of_a_list_of_tables() {
    let idle = |rest: &str| {
        let idle = plan(&format!("{PENS}{rest}")).idle_keys.into_iter();
        idle.map(|idle| (idle.key, idle.place.line().unwrap())).collect::<Vec<_>>()
    };
    let (first, third) = (("pen[0].tone".to_owned(), 6), ("pen[2].tone".to_owned(), 11));
    assert_eq!(idle("[stipples]\npen = \"c\"\n"), std::slice::from_ref(&first));
    assert_eq!(idle("[stipples]\npen = \"a\"\n"), std::slice::from_ref(&third));
    assert_eq!(idle(""), [first, third]);
    assert_eq!(plan(PENS).to_string().lines().last().unwrap().split(':').next(), Some("  pen[2].tone (line 11)"));
}

#[test]
fn what_an_item_needs_has_its_number_and_its_place() {
    let text = format!("drypoint = 1\n[volume]\nfile = \"a\"\n{PENS}");
    let scene = parse(&text, "s.toml".as_ref(), &[("pen.1.width", "1 mm")].into_iter().collect()).unwrap();
    let (at, _) = rules(&scene).find(|(at, _)| at.item == Some(1)).unwrap();
    assert_eq!(at.key, "pen[1]");
    let drawn = Drawn { volume: true, points: true, strokes: true };
    let mut asks = Asks { scene: &scene, drawn, at: at.clone(), needs: Vec::new(), passes: Vec::new() };
    for key in ["width", "color"] {
        asks.need(Hessian, "pens", &at.inner(key));
        asks.pass(Pass::Gaps, "pens", &at.inner(key));
    }
    asks.close();
    let found: Vec<_> = asks.needs.iter().map(|n| (n.quantity, n.item, &*n.key, n.place.clone())).collect();
    let set = Some(Place::Set("pen.1.width=1 mm".into()));
    let default = Some(Place::File { line: 7, column: 1 });
    let needs = [Hessian, Hessian, Gradient, Value];
    let keys = ["width", "color", "width", "width"].map(|key| format!("pen[1].{key}"));
    for ((found, quantity), key) in found.iter().zip(needs).zip(&keys) {
        let place = if key.ends_with("width") { &set } else { &default };
        assert_eq!(*found, (quantity, Some(1), &**key, place.clone()));
    }
    assert_eq!(found.len(), needs.len());
    assert!(asks.passes.iter().all(|pass| pass.item == Some(1)));
}

#[test]
fn steps_longer_than_a_voxel_are_warned_of() {
    let mut plan = plan("");
    plan.warn_step(1.0, 1.0);
    assert!(plan.warnings.is_empty());
    plan.warn_step(1.25, 1.0);
    assert_eq!(
        plan.warnings,
        ["samples are up to 1.2500 apart along a ray, further than a voxel (1.0000): structures between them are \
          missed; make sampling.step smaller"]
    );
}

#[test]
fn outlines_along_a_gradient_that_jumps_are_warned_of() {
    let warnings = |sampling: &str| plan(&format!("[outlines]\niso = 1\n[sampling]\n{sampling}\n")).warnings;
    assert_eq!(
        warnings("gradient = \"analytic\""),
        [
            "sampling.gradient = \"analytic\" jumps at the faces of cells with sampling.kernel = \"trilinear\": outlines \
          are broken there; another gradient or kernel closes them"
        ]
    );
    for closed in ["", "gradient = \"sobel\"", "gradient = \"analytic\"\nkernel = \"catmull-rom\""] {
        assert!(warnings(closed).is_empty(), "{closed}");
    }
    assert!(plan("[surface]\niso = 1\n[sampling]\ngradient = \"analytic\"\n").warnings.is_empty());
}

#[test]
fn a_person_reads_effect_need_price_and_reason() {
    let text = "drypoint = 1\n[volume]\nfile = \"a\"\nrange = [0, 1]\n[transfer]\nkind = \"regular\"\nnodes = [{ at = \
                1, color = \"red\" }]\n";
    let settings = [("shading.ambient", "0.1")].into_iter().collect();
    let mut plan = Plan::new(&parse(text, "s.toml".as_ref(), &settings).unwrap());
    plan.warnings.push("a warning".into());
    let expected = "\
effect                       needs          adds                                                                    because of
transfer function            value          one reconstruction a sample                                             transfer (line 5)
shading                      gradient       one gradient a visible sample                                           shading (--set)
skipping what shows nothing  brick ranges   one look at each voxel                                                  sampling.skip_empty (default)
picture                      rays           samples² rays a pixel; \"auto\": one, or four everywhere                  picture.samples (default)
antialiasing                 rays at edges  four rays a pixel that differs from a neighbour, four more if 5 differ  picture.samples (default)

without effect
  volume.range (line 4): only transfer.unit = \"normalized\" is measured in it

warnings
  a warning
";
    assert_eq!(plan.to_string(), expected);
}

#[test]
fn every_file_that_says_the_same_scene_has_the_same_summary() {
    let scene = parse(
        "drypoint = 1\n[volume]\nfile = \"a\"\n[shading]\n[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, color = \
         \"red\" }]\n",
        "s.toml".as_ref(),
        &Default::default(),
    )
    .unwrap();
    let full = parse(&crate::file::write_full(&scene), "full.toml".as_ref(), &Default::default()).unwrap();
    assert_ne!(Plan::new(&full).to_string(), Plan::new(&scene).to_string(), "places differ");
    assert_eq!(Plan::new(&full).summary(), Plan::new(&scene).summary());
    assert_eq!(
        Plan::new(&scene).summary(),
        "transfer function: value, because of transfer\nshading: gradient, because of shading\nskipping what shows \
         nothing: brick ranges, because of sampling.skip_empty\npicture: rays, because of picture.samples\nantialiasing: \
         rays at edges, because of picture.samples\n"
    );
}

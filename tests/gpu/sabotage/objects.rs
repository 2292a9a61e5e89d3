//! Faults that are planted in objects: each parts the pictures. Formulas of sets, of ghosting and of presets have tables.

use crate::double::load;
use crate::gpu;
use crate::objects::{Files, covering, shells};
use drypoint::gpu::{GpuJob, Precision};
use drypoint::scene::picture::Picture;

/// The largest difference of two pictures.
fn apart(a: &Picture, b: &Picture) -> f64 {
    let numbers =
        |picture: &Picture| picture.layers.iter().flat_map(|layer| layer.channels.concat()).collect::<Vec<_>>();
    numbers(a).iter().zip(numbers(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn faults_of_objects_are_noticed() {
    let Some(gpu) = gpu() else { return };
    if !gpu.has_double() {
        return println!("skipped: {} has no f64", gpu.name());
    }
    let files = Files::new();
    let motion = "move = [2, -1, 1]\nrotate = { axis = [1, 2, 0.5], angle = 30 }\nscale = [0.9, 1.2, 0.8]\n";
    let meetings = "[[intersection]]\nobject = \"a\"\nwith = \"ghost\"\ncolor = \"#ff4010c0\"\n\
                    dabs = [{ at = [110, 90], width = [30, 50], color = \"#20ff40c0\" }]\n\
                    [[intersection]]\nobject = \"a\"\nwith = \"background\"\nopacity = \"over\"\nswap = true\n";
    let scenes = [
        (
            shells(&(files.soft(motion) + meetings)),
            vec![
                // Selections and their samples.
                ("- first_member_of_selection_0())", "- first_member_of_selection_0() - vec3<real>(1.0, 0.0, 0.0))"),
                ("vec2(max(left.x, selection_range_0.x), min(left.y, selection_range_0.y));", "left;"),
                ("moved_x_0() * g.x + moved_y_0() * g.y", "moved_x_0() * g.y + moved_y_0() * g.x"),
                // Meetings.
                ("let wins = found[s].mu >= found[o].mu;", "let wins = found[s].mu < found[o].mu;"),
                ("(value_of_object(o), value_of_object(s))", "(value_of_object(s), value_of_object(o))"),
                // Runs of samples.
                ("return Span(min(span.end, range.x - 1), span.is_mixed);", "return Span(span.end, span.is_mixed);"),
            ],
        ),
        (
            shells(&files.soft("ghosting = 0.4\nfunnel = \"1.5 px\"\ncut = \"object\"")),
            vec![
                ("min(2.0 * map.x, 1.0)", "min(map.x, 1.0)"),
                ("for (var k = part_range_0.y; k", "for (var k = part_range_0.y - 4; k"),
            ],
        ),
        (
            shells(
                &(files.soft("move = [2, 3, 1]\nghosting = 0.6\nfunnel = \"2 px\"")
                    + &files.own("move = [3, 0, 0]")
                    + "[[halo]]\nseed.focus = { at = [[16, 10, 12]], inner = 4, falloff = 12 }\n"),
            ),
            vec![
                ("min(weight, seeds_of_set[halo] * factor)", "seeds_of_set[halo] * factor"),
                ("join_seeds(weight, factor);", "join_seeds(weight, 1.0);"),
                ("seeds_of_set[halo] = 0.0;", ""),
                ("    sow_part_1(k, selection_share(2));\n", ""),
                ("sow_beside_0(k)", "sow_beside_2(k)"),
                ("clamp(pixel + FUNNEL_MARGIN, vec2(0)", "clamp(pixel, vec2(0)"),
            ],
        ),
        (
            covering(&files),
            vec![
                ("mu * (opacities.x / sum)", "mu * (opacities.y / sum)"),
                ("mu_of_objects[o] += mu - of_selection;", ""),
                ("mu_of_objects[i] += sets[i].mu;", ""),
                ("        mu_of_objects[i] = 0.0;\n", ""),
                ("    fractions_k = k;\n", ""),
                ("select(real(0.0), real(1.0), object == 0);\n}", "real(0.0);\n}"),
            ],
        ),
    ];
    let mut unseen = Vec::new();
    for (scene, faults) in scenes {
        let job = load(&scene);
        let (truth, _) = job.renderer().unwrap().frame(&|_| ());
        let on_gpu = GpuJob::new(&job, &gpu, Precision::Double).unwrap_or_else(|failure| panic!("{failure}"));
        let draw = |edit: &dyn Fn(String) -> String| {
            let mut renderer = on_gpu.edited(edit).unwrap_or_else(|failure| panic!("{failure}"));
            apart(&truth, &renderer.frame(&|_| ()).unwrap_or_else(|error| panic!("{error}")))
        };
        let without = draw(&|text| text);
        assert!(without < 1e-9, "{without:e}");
        for (old, new) in faults {
            let found = draw(&|text: String| {
                assert_eq!(text.matches(old).count(), 1, "{old}");
                text.replace(old, new)
            });
            println!("{found:.1e} by {old}");
            if found < 1e-4 {
                unseen.push((old, found));
            }
        }
    }
    assert!(unseen.is_empty(), "{unseen:?}");
}

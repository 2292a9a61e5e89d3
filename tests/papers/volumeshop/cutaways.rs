//! Cutaways and ghosting ([VS-7]).

use super::{LIT, SHELLS, difference, drawn, layer, pixels, scene_of, seen};
use drypoint::scene::picture::LayerKind;

/// A selection of the inner values, of hardly any opacity itself, with the background before it faded.
fn faded(look: &str, more: &str) -> String {
    let object = "[[object]]\nvalue = [[190, 0], [200, 1]]\n";
    let clear = "[object.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 1e-9 }]\n";
    scene_of(SHELLS, &format!("{look}{object}{more}{clear}"))
}

const STYLED: &str = "[transfer]\nnodes = [{ at = 20, style = \"wax\", opacity = 0 }, { at = 120, style = \"wax\", opacity = 0.5 }]\n[contours]\n";

/// The background's transmittance rises with γ in every pixel, by either cut, with and without a funnel.
#[test]
fn transmittance_rises_with_ghosting() {
    for look in [LIT, STYLED] {
        for cut in ["cut = \"bounds\"\n", "cut = \"object\"\n", "funnel = \"2 px\"\n"] {
            let at = |gamma: f64| pixels(&drawn(&faded(look, &format!("ghosting = {gamma}\n{cut}"))).0);
            let mut before = at(0.0);
            let (first, mut sum) = (before.clone(), 0.0);
            for gamma in [0.2, 0.4, 0.6, 0.8, 1.0] {
                let now = at(gamma);
                assert!(now.iter().zip(&before).all(|(now, before)| now[3] <= before[3] + 1e-6), "{cut} {gamma}");
                before = now;
            }
            sum += before.iter().zip(&first).map(|(now, first)| first[3] - now[3]).sum::<f64>();
            assert!(sum > 0.01, "{cut}: {sum}");
        }
    }
}

/// γ = 1 leaves no background sample before d: the first visible sample lies at the far side of the object's box.
#[test]
fn a_full_cutaway_shows_nothing_before_the_far_side() {
    // Seen along z the box of the selection, a ball about the middle, ends at one depth.
    let camera = "[camera]\nprojection = \"orthographic\"\ndirection = [0, 0, 1]\nup = [0, 1, 0]\n";
    let clear = faded(LIT, "ghosting = 1\n").replace("opacity = 1e-9", "opacity = 0");
    let text = clear.replace("samples = 1\n", "samples = 1\nlayers = [\"beauty\", \"depth\"]\n");
    let (picture, _) = drawn(&(text.clone() + camera));
    let (plain, _) = drawn(&(text.replace("ghosting = 1\n", "") + camera));
    let first = |picture: &_| layer(picture, LayerKind::Depth)[0].clone();
    let (cut, whole) = (first(&picture), first(&plain));
    let behind: Vec<f64> = cut.iter().zip(&whole).filter(|(cut, whole)| cut != whole).map(|(cut, _)| *cut).collect();
    let nearest = behind.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(behind.len() > 12, "{}", behind.len());
    // All cut rays see nothing before the same plane, and some begin at it.
    assert!(behind.iter().all(|depth| *depth >= nearest) && behind.iter().filter(|d| **d < nearest + 0.6).count() > 4);
    assert!(whole.iter().zip(&cut).all(|(whole, cut)| *whole == *cut || *whole < nearest));
    assert!(seen(&picture) < seen(&plain) && difference(&picture, &plain) > 0.05);
}

/// A funnel cuts about the object, less and less; a hard cut does not.
#[test]
fn a_funnel_reaches_beyond_the_object() {
    let count = |more: &str| {
        let (plain, cut) =
            (drawn(&faded(LIT, "")).0, drawn(&faded(LIT, &format!("ghosting = 1\ncut = \"object\"\n{more}"))).0);
        pixels(&plain).iter().zip(&pixels(&cut)).filter(|(plain, cut)| plain != cut).count()
    };
    let (hard, soft, softer) = (count(""), count("funnel = \"1 px\"\n"), count("funnel = \"2 px\"\n"));
    assert!(hard > 8 && soft > hard + 20 && softer > soft, "{hard} {soft} {softer}");
}

//! Objects in fields of one value, where every pixel is known by hand ([VS-3], [VS-4]).

use super::{drawn, pixels, scene_of};

/// A block of one value, seen along z, its moved copy beside it, half over it.
///
/// The volume reaches from 0 to 31 on each axis; the selection is all of it, moved by 16 along x. The camera shows x from 0
/// to 48 on 24 pixels.
fn picture(of_objects: &str) -> Vec<[f64; 4]> {
    let text = format!(
        "[camera]\nprojection = \"orthographic\"\nheight = 40\ndirection = [0, 0, 1]\nup = [0, 1, 0]\ntarget = [24, 16, 16]\n\
         [sampling]\nreference_length = 31\n\
         [transfer]\nkind = \"regular\"\nnodes = [{{ at = 0, color = \"#ffffff\", opacity = 0.5 }}]\n\
         [[object]]\nname = \"block\"\nmove = [16, 0, 0]\n{of_objects}"
    );
    let (picture, _) = drawn(&scene_of("phantom = { name = \"constant\", size = 32 }", &text));
    // One row through the middle. Looking along +z with y up, +x lies to the left.
    (0..24).rev().map(|x| pixels(&picture)[10 * 24 + x]).collect()
}

/// Colours of the selection, its ghost and their intersection: red, green, blue.
const LOOKS: &str = "[object.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0.5 }]\n\
    [object.ghost.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"lime\", opacity = 0.25 }]\n";

/// The straight colour of a pixel, and its opacity.
fn straight([r, g, b, a]: [f64; 4]) -> ([f64; 3], f64) {
    ([r, g, b].map(|c| c / a), a)
}

fn near((rgb, alpha): ([f64; 3], f64), (expected, opacity): ([f64; 3], f64)) {
    let off = (0..3).map(|c| (rgb[c] - expected[c]).abs()).fold((alpha - opacity).abs(), f64::max);
    assert!(off < 1e-12, "{rgb:?} {alpha}, not {expected:?} {opacity}");
}

/// Pixels at x = 5, in the ghost alone; at x = 25, in both; at x = 39, in the selection alone.
fn three(of_objects: &str) -> [([f64; 3], f64); 3] {
    let row = picture(&format!("{of_objects}{LOOKS}"));
    [2, 12, 19].map(|x| straight(row[x]))
}

/// 62 samples a ray, each of the opacity that gives α over the block's 31.
#[test]
fn selection_and_ghost_share_by_membership() {
    let [ghost, both, selection] = three("");
    near(ghost, ([0.0, 1.0, 0.0], 0.25));
    near(selection, ([1.0, 0.0, 0.0], 0.5));
    // Eq. 4: ½ red and ¼ green over ¾. Eq. 5: max(½, ¼).
    near(both, ([2.0 / 3.0, 1.0 / 3.0, 0.0], 0.5));
}

/// Per reference length, so the operators act on whole opacities: ½ + ¼ − ⅛.
#[test]
fn product_operators_add() {
    let [ghost, both, selection] = three("[object.ghost]\n").map(|pixel| pixel);
    near(ghost, ([0.0, 1.0, 0.0], 0.25));
    near(selection, ([1.0, 0.0, 0.0], 0.5));
    near(both, ([2.0 / 3.0, 1.0 / 3.0, 0.0], 0.5));
    let row = picture(&format!("{LOOKS}[combine]\nfuzzy = \"product\"\n"));
    near(straight(row[12]), ([2.0 / 3.0, 1.0 / 3.0, 0.0], 0.625));
}

/// An intersection has its own colour, and both sets are reduced by it (eq. 7).
#[test]
fn an_intersection_by_hand() {
    let with = |table: &str| {
        let row = picture(&format!("{LOOKS}[[intersection]]\nobject = \"block\"\n{table}"));
        straight(row[12])
    };
    // V = max(½, ¼) = ½ = μ of the intersection; S becomes min(½, ½), G min(¼, ½). α = ½.
    // Colour (½ red + ¼ green + ½ blue)/1¼.
    near(with("color = \"blue\"\n"), ([0.4, 0.2, 0.4], 0.5));
    // "in": ⅛. S min(½, ⅞), G min(¼, ⅞): (½ red + ¼ green + ⅛ blue)/⅞.
    near(with("color = \"blue\"\nopacity = \"in\"\n"), ([4.0 / 7.0, 2.0 / 7.0, 1.0 / 7.0], 0.5));
    // "out" a(1 − b) = ⅜; exchanged b(1 − a) = ⅛.
    near(with("color = \"blue\"\nopacity = \"out\"\n"), ([4.0 / 9.0, 2.0 / 9.0, 3.0 / 9.0], 0.5));
    near(with("color = \"blue\"\nopacity = \"out\"\nswap = true\n"), ([4.0 / 7.0, 2.0 / 7.0, 1.0 / 7.0], 0.5));
    // The mean colour (½ red + ¼ green)/¾ by ¾, and ¼ of each that is left.
    near(with("opacity = \"plus\"\n"), ([0.6, 0.4, 0.0], 0.75));
    // A translucent colour: max · ½ = ¼. S min(½, ¾), G min(¼, ¾).
    near(with("color = \"#0000ff80\"\n"), {
        let v = 0.5 * 128.0 / 255.0;
        let sum = 0.75 + v;
        ([0.5 / sum, 0.25 / sum, v / sum], 0.5)
    });
}

/// Dabs on a function about (100, 100), the value of both sets.
#[test]
fn dabs_by_hand() {
    let row = |table: &str| picture(&format!("{LOOKS}[[intersection]]\nobject = \"block\"\n{table}"));
    let (blue, in_blue) = ("color = \"blue\"\n", "color = \"blue\"\nopacity = \"in\"\n");
    // One width away along one value w = e^(−½), over "in", ⅛.
    let w = 0.606_530_659_712_633_4;
    let expected = |w: f64| {
        // α' = w + ⅛(1 − w), above ¼: S min(½, 1 − α'), G ¼. A white dab has the share w/α' of the intersection's colour.
        let v = w + 0.125 * (1.0 - w);
        let s = f64::min(0.5, 1.0 - v);
        let sum = s + 0.25 + v;
        ([(s + w) / sum, (0.25 + w) / sum, v / sum], v.max(s))
    };
    for at in ["[100, 110]", "[100, 90]", "[110, 100]"] {
        let dab = format!("dabs = [{{ at = {at}, width = 10, color = \"#ffffff\" }}]\n");
        near(straight(row(&format!("{in_blue}{dab}"))[12]), expected(w));
    }
    // Each value has a width of its own: here the distance is 5/10 and 6/20, the square 0.34.
    let dab = "dabs = [{ at = [105, 94], width = [10, 20], color = \"#ffffff80\" }]\n";
    let w = 128.0 / 255.0 * (-0.17f64).exp();
    near(straight(row(&format!("{in_blue}{dab}"))[12]), expected(w));
    // An opaque dab of endless width is the function, also where the colour leaves it transparent.
    for color in [blue, in_blue, "", "color = \"#0000ff00\"\n"] {
        let painted = row(&format!("{color}dabs = [{{ at = [0, 0], width = 1e300, color = \"yellow\" }}]\n"));
        near(straight(painted[12]), ([1.0, 1.0, 0.0], 1.0));
        // No dab makes an intersection where there is none.
        let plain = row(color);
        assert_eq!((painted[2], painted[19]), (plain[2], plain[19]));
        // A dab of opacity 0 changes no bit.
        let clear = row(&format!("{color}dabs = [{{ at = [100, 100], width = 5, color = \"#ff000000\" }}]\n"));
        assert_eq!(clear, plain);
    }
    // The last dab is on top.
    let both =
        "dabs = [{ at = [0, 0], width = 1e300, color = \"red\" }, { at = [0, 0], width = 1e300, color = \"lime\" }]\n";
    near(straight(row(both)[12]), ([0.0, 1.0, 0.0], 1.0));
}

/// A background that is left beside a soft selection: f = ¼ everywhere.
#[test]
fn a_soft_selection_and_the_background() {
    let row = picture(&format!("value = [[0, 0.25]]\n{LOOKS}"));
    // At x = 5: ghost min(¼, ¼), background min(¾, ½): (¼ green + ½ white)/¾.
    near(straight(row[2]), ([2.0 / 3.0, 1.0, 2.0 / 3.0], 0.5));
    // Product: ghost 1/16, background ⅜, together 7/16.
    let row = picture(&format!("value = [[0, 0.25]]\n{LOOKS}[combine]\nfuzzy = \"product\"\n"));
    near(straight(row[2]), ([6.0 / 7.0, 1.0, 6.0 / 7.0], 0.4375));
}

//! Selections that change nothing ([VS-3]).

use super::{LIT, SHELLS, difference, drawn, scene_of, seen};

/// Looks of the picture: lit colours, and styles with contours and illustrative transparency.
const LOOKS: [&str; 2] = [
    LIT,
    "[transfer]\nnodes = [{ at = 20, style = \"wax\", opacity = 0 }, { at = 255, style = \"metal\", opacity = 0.5 }]\n[contours]\n",
];

/// f_S ≡ 0 and f_S ≡ 1 with equal looks equal the picture without a selection, whatever the operators.
#[test]
fn nothing_and_everything_selected_are_the_picture_itself() {
    for (look, kernel) in LOOKS.into_iter().zip(["trilinear", "bspline"]) {
        let rest = format!("{look}[sampling]\nkernel = \"{kernel}\"\n");
        let (plain, _) = drawn(&scene_of(SHELLS, &rest));
        assert!(seen(&plain) > 20.0);
        for fuzzy in ["zadeh", "product"] {
            for object in ["value = [[0, 0]]", "value = [[0, 1]]", "", "value = [[0, 0]]\nmove = [3, 0, 0]"] {
                let text = format!("{rest}[combine]\nfuzzy = \"{fuzzy}\"\n[[object]]\n{object}\n");
                let (picture, _) = drawn(&scene_of(SHELLS, &text));
                let off = difference(&plain, &picture);
                assert!(off < 1e-12, "{fuzzy} {object}: {off:e}");
            }
        }
    }
}

/// With product operators the selection sets sum to 1: with the moved selection outside of the picture, the background and the
/// ghosts are the picture for every f_S. Zadeh's leave a slit where f_S passes ½.
#[test]
fn product_leaves_no_slit() {
    let soft = "value = [[60, 0], [180, 1]]\nmove = [1000, 0, 0]\n";
    let two = format!("[[object]]\n{soft}[[object]]\nvalue = [[0, 0.25], [255, 0.75]]\nmove = [0, 2000, 0]\n");
    for look in LOOKS {
        let (plain, _) = drawn(&scene_of(SHELLS, look));
        let with = |fuzzy: &str, objects: &str| {
            let text = format!("{look}[camera]\n[combine]\nfuzzy = \"{fuzzy}\"\n{objects}");
            difference(&plain, &drawn(&scene_of(SHELLS, &text)).0)
        };
        let one = format!("[[object]]\n{soft}");
        assert!(with("product", &one) < 1e-12 && with("product", &two) < 1e-12);
    }
    // What is at most half opaque everywhere has no slit either.
    let dense = LIT.replace("opacity = 0.4", "opacity = 0.99").replace("at = 20", "at = 150");
    let object = "[camera]\n[[object]]\nvalue = [[190, 0], [240, 1]]\nmove = [1000, 0, 0]\n";
    let [plain, zadeh] = ["", object].map(|object| drawn(&scene_of(SHELLS, &format!("{dense}{object}"))).0);
    assert!(difference(&plain, &zadeh) > 1e-4, "{}", difference(&plain, &zadeh));
}

/// A ghosting factor of 0 is no cutaway, bit for bit, and so is a funnel of 0.
#[test]
fn factors_of_nothing_keep_every_bit() {
    let object = |more: &str| {
        let text = format!("{LIT}[[object]]\nvalue = [[150, 0], [200, 1]]\nmove = [6, 2, 0]\n{more}");
        drawn(&scene_of(SHELLS, &text))
    };
    let (plain, counts) = object("");
    assert!(seen(&plain) > 20.0);
    let (faded, of_faded) = object("ghosting = 0\nghosting_of_ghost = 0\ncut = \"object\"\nfunnel = \"2 px\"\n");
    assert_eq!((difference(&plain, &faded), counts.samples), (0.0, of_faded.samples));
    let cut = "ghosting = 0.7\ncut = \"object\"\n";
    assert_eq!(difference(&object(cut).0, &object(&format!("{cut}funnel = \"0 px\"\n")).0), 0.0);
}

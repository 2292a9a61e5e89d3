//! The panel of the transfer function.

use super::{SCENE, Window, difference, drag, pixels, press, settle, text, viewer, wait_for, window, window_in};
use drypoint::scene::tables::{Over, RowAt};
use drypoint_viewer::app::Backend;
use eframe::egui::{Key, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::kittest::Queryable;

/// The place of a node in the plot.
fn place(window: &Window, key: &str) -> Pos2 {
    window.get_by_label(key).rect().center()
}

#[test]
fn a_node_is_dragged_over_the_histogram() {
    let Some(mut window) = window(SCENE, Backend::Card) else { return };
    let first = pixels(&window);
    // Between both nodes lie 30 values and 0.9 of opacity.
    let [clear, whole] = [0, 1].map(|i| place(&window, &format!("transfer.nodes[{i}]")));
    let to = whole + (whole - clear) * Vec2::new(1.0, -0.6 / 0.9);
    drag(&mut window, PointerButton::Primary, whole, to, Modifiers::NONE);
    settle(&mut window);
    let changed = text(&window);
    assert!(!changed.contains("at = 150") && changed.contains("# the surface"), "{changed}");
    let scene = viewer(&window).session.scene.clone().unwrap();
    let node = &scene.transfer.as_ref().unwrap().nodes.as_ref().unwrap()[1];
    assert!((node.at - 180.0).abs() < 3.0 && (node.opacity - 0.3).abs() < 0.03, "{node:?}");
    assert!(difference(&first, &pixels(&window)) > 0.05);
    press(&mut window, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(&window), SCENE);
}

/// A scene of the ring with styles.
fn styles() -> String {
    let styles = SCENE.replace("regular", "style").replace("color = \"#804020\"", "style = \"wax\"");
    styles.replace("color = \"#ffcc88\"", "style = \"glass\"").replace("\n[shading]\n", "")
}

/// A node that is selected takes the style that is clicked.
#[test]
fn a_style_is_chosen_by_its_sphere() {
    let styles = styles();
    let Some(mut window) = window(&styles, Backend::Reference) else { return };
    let first = pixels(&window);
    window.get_by_label("the style bone").click();
    window.run_steps(2);
    assert_eq!(text(&window), styles, "no node is selected");
    window.get_by_label("node 1").click();
    window.run_steps(2);
    window.get_by_label("the style bone").click();
    settle(&mut window);
    assert_eq!(text(&window), styles.replace("glass", "bone"));
    assert!(difference(&first, &pixels(&window)) > 0.05);
}

/// A style is dragged to a node of the plot, or to the line of a node.
#[test]
fn a_style_is_dragged_to_a_node() {
    let styles = styles();
    let Some(mut window) = window(&styles, Backend::Reference) else { return };
    let sphere = window.get_by_label("the style bone").rect().center();
    let node = place(&window, "transfer.nodes[1]");
    drag(&mut window, PointerButton::Primary, sphere, node, Modifiers::NONE);
    settle(&mut window);
    assert_eq!(text(&window), styles.replace("glass", "bone"));
    let line = window.get_by_label("wax").rect().center();
    drag(&mut window, PointerButton::Primary, sphere, line, Modifiers::NONE);
    settle(&mut window);
    assert_eq!(text(&window), styles.replace("glass", "bone").replace("wax", "bone"));
    // A drag that ends elsewhere changes nothing.
    let (before, beside) = (text(&window), window.get_by_label("Picture").rect().center());
    drag(&mut window, PointerButton::Primary, sphere, beside, Modifiers::NONE);
    assert_eq!(text(&window), before);
}

/// A function over the value gets a second quantity, whose rows are dragged upwards, and loses it again.
#[test]
fn a_function_gets_a_second_quantity() {
    let Some(mut window) = window(SCENE, Backend::Reference) else { return };
    let first = pixels(&window);
    window.get_by_label("Over a second quantity").click();
    window.run_steps(3);
    window.get_by_label("gradient-magnitude").click();
    let is_over_two =
        |window: &Window| text(window).contains("over = [\"value\", \"gradient-magnitude\"]").then_some(());
    wait_for(&mut window, "no second quantity", is_over_two);
    settle(&mut window);
    // Flat places are clear, and the surface is as it was.
    assert!(difference(&first, &pixels(&window)) > 0.0);
    let rows = |window: &Window| {
        let transfer = viewer(window).session.scene.clone().unwrap().transfer.clone().unwrap();
        assert!(matches!(transfer.over, Over::Two(_)) && transfer.nodes.is_none());
        let up = |row: &drypoint::scene::tables::Row| match row.at {
            RowAt::Number(at) => (at, row.nodes.iter().map(|node| [node.at, node.opacity]).collect::<Vec<_>>()),
            _ => unreachable!("rows of numbers"),
        };
        transfer.rows.unwrap().iter().map(up).collect::<Vec<_>>()
    };
    let lifted = rows(&window);
    let [(lowest, clear), (highest, whole)] = &lifted[..] else { panic!("{lifted:?}") };
    assert!(lowest < highest && clear == &[[120.0, 0.0], [150.0, 0.0]] && whole == &[[120.0, 0.0], [150.0, 0.9]]);
    // A drag moves the node across, and its row upwards.
    let (before, node) = (text(&window), place(&window, "transfer.rows[1].nodes[1]"));
    let low = place(&window, "transfer.rows[0].nodes[1]");
    let across = node.x - place(&window, "transfer.rows[1].nodes[0]").x;
    let to = Pos2::new(node.x + across, (node.y + low.y) / 2.0);
    drag(&mut window, PointerButton::Primary, node, to, Modifiers::NONE);
    settle(&mut window);
    let moved = rows(&window);
    let middle = (lowest + highest) / 2.0;
    assert!((moved[1].0 - middle).abs() < 0.05 * (highest - lowest), "{moved:?}");
    assert!((moved[1].1[1][0] - 180.0).abs() < 5.0 && moved[1].1[0] == whole[0] && moved[0] == lifted[0], "{moved:?}");
    press(&mut window, Key::Z, Modifiers::COMMAND);
    settle(&mut window);
    assert_eq!(text(&window), before);
    window.get_by_label("Add a row").click();
    settle(&mut window);
    let three = rows(&window);
    assert!(three.len() == 3 && lowest < &three[1].0 && &three[1].0 < highest && three[1].1 == *whole, "{three:?}");
    window.get_by_label("Over the value alone").click();
    settle(&mut window);
    let back = viewer(&window).session.scene.clone().unwrap().transfer.clone().unwrap();
    let nodes: Vec<[f64; 2]> = back.nodes.unwrap().iter().map(|node| [node.at, node.opacity]).collect();
    assert!(back.over == Over::Value && &nodes == whole);
}

/// A look takes the place of the scene's, and its picture is that of the volume. An own one is kept and taken back.
#[test]
fn a_look_is_taken_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let Some(mut window) = window_in(SCENE, Backend::Reference, Some(folder.path())) else { return };
    let first = viewer(&window).session.scene.clone().unwrap();
    window.get_by_label("Looks").click();
    window.run_steps(3);
    window.get_by_label("Name of the look").focus();
    window.step();
    window.event(eframe::egui::Event::Text("mine".into()));
    window.run_steps(3);
    window.get_by_label("Keep this look").click();
    wait_for(&mut window, "no picture", |window| window.query_by_label("the look mine").map(|_| ()));
    wait_for(&mut window, "no picture", |window| window.query_by_label("the look style").map(|_| ()));
    window.get_by_label("the look style").click();
    settle(&mut window);
    assert!(
        text(&window).starts_with("# A ring.\ndrypoint = 1\npreset = \"style\"\n\n[volume]\n"),
        "{}",
        text(&window)
    );
    assert!(!text(&window).contains("nodes"));
    window.get_by_label("the look mine").click();
    settle(&mut window);
    assert_eq!(*viewer(&window).session.scene.clone().unwrap(), *first);
    // Both are changes that can be undone.
    press(&mut window, Key::Z, Modifiers::COMMAND);
    press(&mut window, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(&window), SCENE);
}

//! Answers that come late: about a document, a pixel or a camera that is no longer in the window.

use super::{SCENE, Window, settle, text, viewer, wait_for, window};
use drypoint::job::Job;
use drypoint::picking::pick_pixel;
use drypoint_viewer::app::Backend;
use drypoint_viewer::document::Document;
use drypoint_viewer::session::Session;
use std::time::Duration;

/// Time in which a thread answers any question about the ring.
const LONG: Duration = Duration::from_millis(700);

fn session(window: &mut Window) -> &mut Session {
    &mut window.state_mut().as_mut().unwrap().session
}

/// A scene that was being prepared when another document was opened is not taken for that document's.
#[test]
fn a_second_document_has_nothing_of_the_first() {
    let Some(mut window) = window(SCENE, Backend::Reference) else { return };
    let other = SCENE.replace("size = 24", "size = 20").replace("0.9", "0.8");
    let faulty = other.replace("samples = 1", "samples = -1");
    for (document, is_faulty) in [(other, false), (faulty, true)] {
        session(&mut window).set(&"transfer.nodes[0].at".into(), 121);
        window.step();
        // The answers about the first document wait in the window.
        std::thread::sleep(LONG);
        session(&mut window).take(Document::untitled(document, "other.toml".into()));
        for _ in 0..40 {
            window.step();
            let session = session(&mut window);
            let prepared = session.prepared.as_ref().map(|scene| scene.volume.clone());
            assert!(prepared.is_none_or(|volume| volume == session.scene.as_ref().unwrap().volume));
            assert!(session.data().is_none_or(|data| data.volume.dims() == [20; 3]));
            assert!(!is_faulty || session.pose().is_none() && session.shown.is_none() && session.boxes.is_empty());
            std::thread::sleep(Duration::from_millis(5));
        }
        settle(&mut window);
        assert_eq!(viewer(&window).session.failures.is_some(), is_faulty);
        session(&mut window).take(Document::untitled(SCENE.into(), "ring.toml".into()));
        settle(&mut window);
    }
    // The same volume is not read again.
    let data = viewer(&window).session.data().cloned().unwrap();
    session(&mut window).take(Document::untitled(SCENE.replace("0.9", "0.7"), "other.toml".into()));
    settle(&mut window);
    assert!(std::sync::Arc::ptr_eq(&data, viewer(&window).session.data().unwrap()));
}

/// The cross-hair goes to the last click, although the answer about the one before comes later than that click.
#[test]
fn the_last_of_two_clicks_is_answered() {
    let Some(mut window) = window(SCENE, Backend::Reference) else { return };
    let job = Job::load(Document::untitled(text(&window), "ring.toml".into()).scene().unwrap()).unwrap();
    let renderer = job.renderer().unwrap();
    let seen = |pixel| pick_pixel(&renderer, pixel).map(|picked| picked.world);
    let on_the_ring: Vec<_> = (0..96).map(|x| [x, 36]).filter(|pixel| seen(*pixel).is_some()).collect();
    let [first, last] = [on_the_ring[2], on_the_ring[on_the_ring.len() - 3]];
    session(&mut window).ask_pixel(first, true);
    std::thread::sleep(LONG);
    session(&mut window).ask_pixel(last, true);
    let cross = wait_for(&mut window, "no place", |window| viewer(window).session.cross);
    assert!(Some(cross) == seen(last) && Some(cross) != seen(first), "{cross}");
}

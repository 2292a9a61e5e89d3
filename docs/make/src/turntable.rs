//! `docs/pictures/turn.gif`: the scene that `drypoint` draws by itself, turned once.

use crate::files::in_docs;
use drypoint::drawing::{Drawing, write_animation};
use drypoint::job::Job;
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::load;

/// The settings beside the scene's own.
const OVER: [(&str, &str); 3] = [("picture.size", "[280, 280]"), ("orbit.frames", "36"), ("orbit.fps", "12")];

/// The most bytes of the animation.
const LARGEST: u64 = 1_500_000;

/// Draws the frames and writes the animation.
///
/// # Errors
/// Errors of the renderer and of the system, and a file that is too large for a page.
pub(crate) fn write() -> Result<(), String> {
    let scene =
        load(&in_docs("../data/scenes/default.toml"), &OVER.into_iter().collect()).map_err(|e| e.to_string())?;
    let job = Job::load(scene).map_err(|e| e.to_string())?;
    let mut counts = Counts::default();
    let draw = |counts: &mut Counts| {
        let marking = Marking::new(&job, counts, &|_| ())?;
        let mut drawing = Drawing::new(&job, &marking, counts)?;
        let path = in_docs("pictures/turn.gif");
        write_animation(&job, drawing.frames(), &path, |i| Ok(drawing.frame(i, &|_| ())?.0))?;
        Ok::<_, drypoint::Failure>(path)
    };
    let path = draw(&mut counts).map_err(|e| e.to_string())?;
    let bytes = std::fs::metadata(&path).map_err(|e| e.to_string())?.len();
    if bytes > LARGEST {
        return Err(format!("{} has {bytes} bytes, more than {LARGEST}", path.display()));
    }
    println!("docs/pictures/turn.gif ({} kB)", bytes.div_ceil(1000));
    Ok(())
}

//! Combination of objects ([VS-2] … [VS-4], [VS-7]): functions of the picture's shader that call those of its parts.

use super::funnel;
use crate::Precision;
use crate::field::Scales;
use crate::module::{Module, module};
use crate::number::{BILINEAR, ELEMENTARY, NUMBER};
use crate::shader::{Constant, Data, Shader, write_function};
use drypoint_scene::intersection_picture::IntersectionPicture;
use drypoint_scene::shot::{
    Combination, Cut, Cutaway, Dab, Fuzzy, Intersection, IntersectionOpacity, IntersectionPaint, Lighting, Material,
    Shot, Transparency,
};
use std::fmt::Write;

/// A selection or a ghost that can show something.
pub(crate) struct DrawnPart {
    /// Index of the part in the shot.
    pub(crate) part: usize,
    /// Whether it is taken from the picture's volume, and drawn there.
    pub(crate) takes: bool,
    /// Whether its samples seed halos.
    pub(crate) seeds: bool,
    /// Whether it is a ghost.
    pub(crate) is_ghost: bool,
    /// The powers of two of its numbers.
    pub(crate) scales: Scales,
}

impl DrawnPart {
    /// Index of the part among the shader's objects. The background comes first.
    fn object(&self) -> usize {
        self.part + 1
    }

    /// An expression for the membership of its selection set (eqs. 1, 2).
    fn weight(&self) -> String {
        let part = self.part;
        if self.takes { format!("selection_share({})", self.object()) } else { format!("part_membership_{part}(k)") }
    }
}

/// The suffix of a part's names.
pub(crate) fn suffix(part: usize) -> String {
    format!("_{part}")
}

/// The name of the first sample behind a cutaway.
pub(crate) fn cut_end(cutaway: usize) -> String {
    format!("cut_ends[{cutaway}]")
}

/// Adds the combination of parts, whose shaders are attached after it.
pub(crate) fn add(
    shader: &mut Shader,
    combination: &Combination,
    pictures: &[Option<&IntersectionPicture>],
    parts: &[DrawnPart],
    (shot, scales): (&Shot, &Scales),
    precision: Precision,
) {
    shader.add(&[NUMBER, module!("fuzzy"), module!("shares"), module!("sets")]);
    shader.add(&[module!("object_ray"), module!("object_ray_background")]);
    shader.constant("PRODUCT", Constant::Bool(combination.fuzzy == Fuzzy::Product));
    shader.stages.begin_part.push("aim_objects");
    let cutaways: Vec<_> = super::cutaways(combination).collect();
    if cutaways.is_empty() {
        shader.add(&[module!("object_ray_uncut")]);
    } else {
        shader.add(&[module!("ghosting"), module!("object_ray_cutaways"), enhancement(&shot.objects[0].material)]);
    }
    for (i, cutaway) in cutaways.iter().enumerate() {
        shader.block.number(format!("ghosting_{i}"), cutaway.ghosting);
    }
    if cutaways.iter().any(|cutaway| cutaway.funnel > 0.0) {
        funnel::add(shader, shot, precision);
    }
    let halos = shot.halos.list.len();
    if halos == 0 {
        shader.add(&[module!("note_sample")]);
    }
    let objects = combination.parts.len() + 1;
    let sets = objects + combination.intersections.len();
    let mut text = format!("\nconst OBJECTS = {objects};\nconst SETS = {sets};\n");
    rays(&mut text, parts, &cutaways);
    sets_of_parts(&mut text, parts);
    meetings(&mut text, shader, combination, pictures, parts, scales);
    if halos > 0 {
        seeds_together(&mut text, halos, parts);
    }
    shader.stages.objects = Some(text);
}

/// The enhancement of a material, which protects samples from ghosting.
fn enhancement(material: &Material) -> Module {
    match material {
        Material::Style(style) if style.transparency == Transparency::Illustrative => module!("ghosting_of_style"),
        Material::Regular(lit) if matches!(lit.lighting, Lighting::Function(_)) => module!("ghosting_of_lighting"),
        Material::Style(_) | Material::Regular(_) => module!("ghosting_of_any"),
    }
}

/// Writes the calls that aim the rays of parts and find the samples at which each can show something.
fn rays(text: &mut String, parts: &[DrawnPart], cutaways: &[&Cutaway]) {
    let (mut aims, mut run, mut spans) = (Vec::new(), vec!["var run = own;".to_owned()], Vec::new());
    let (mut ends, mut planes) = (Vec::new(), Vec::new());
    spans.push("var span = Span(last, false);".to_owned());
    for DrawnPart { part, takes, .. } in parts {
        aims.push(format!("aim_part_{part}(at.x, at.y);"));
        run.push(format!("run = hull(run, part_range_{part});"));
        spans.push(format!("span = span_within(span, k, part_range_{part});"));
        spans.extend(takes.then(|| format!("span = span_within(span, k, selection_range_{part});")));
    }
    for (i, cutaway) in cutaways.iter().enumerate() {
        spans.push(format!("span = span_within(span, k, vec2(NO_SAMPLE, {} - 1));", cut_end(i)));
        let mut end = match cutaway.cut {
            Cut::Bounds => format!("far_side_{}()", cutaway.part),
            Cut::Object => format!("last_member_{}()", cutaway.part),
        };
        if cutaway.funnel > 0.0 {
            let funnel = planes.len();
            planes.push((funnel, end.clone()));
            end = format!("funnel_end({funnel}, {end})");
        }
        ends.push(format!("{} = cut_end({end});", cut_end(i)));
    }
    write_function(text, "aim_parts(at: vec2<real>)", aims, None);
    write_function(text, "run_of_parts(own: vec2<i32>) -> vec2<i32>", run, Some("run"));
    write_function(text, "span_from(k: i32, last: i32) -> Span", spans, Some("span"));
    write_function(text, "end_cutaways()", ends, None);
    if !planes.is_empty() {
        write_switch(text, "funnel_plane(funnel: i32) -> real", "funnel", planes, "-NOT_MET");
    }
    if !cutaways.is_empty() {
        let _ = writeln!(text, "\nconst CUTAWAYS = {};", cutaways.len());
        let each = (0..cutaways.len()).map(|i| (i, format!("params.ghosting_{i}")));
        write_switch(text, "ghosting_of(cutaway: i32) -> real", "cutaway", each, "0.0");
    }
}

/// Appends a function that returns an expression for each case.
fn write_switch(
    text: &mut String,
    head: &str,
    on: &str,
    cases: impl IntoIterator<Item = (usize, String)>,
    default: &str,
) {
    let cases = cases.into_iter().map(|(case, result)| format!("    case {case}: {{ return {result}; }}"));
    let end = [format!("    default: {{ return {default}; }}"), "}".to_owned()];
    write_function(text, head, std::iter::once(format!("switch {on} {{")).chain(cases).chain(end), None);
}

/// Writes the calls that find the sets of parts and select the largest set. If several are equal, selections come
/// first, then ghosts, then the background, each kind in its order.
fn sets_of_parts(text: &mut String, parts: &[DrawnPart]) {
    let takes = parts.iter().filter(|drawn| drawn.takes);
    let takes = takes.map(|drawn| format!("memberships[{}] = part_takes_{}(k);", drawn.object(), drawn.part));
    write_function(text, "take_selections(k: i32)", takes, None);
    let find = |drawn: &DrawnPart| {
        let (object, part, weight) = (drawn.object(), drawn.part, drawn.weight());
        format!("keep_found({object}, part_set_{part}(k, {weight}), {});", drawn.takes)
    };
    write_function(text, "find_parts(k: i32)", parts.iter().map(find), None);
    let of = |is_ghost: bool| parts.iter().rev().filter(move |drawn| drawn.is_ghost == is_ghost);
    let larger = |drawn: &DrawnPart| format!("if (take_if_largest({0})) {{ object = {0}; }}", drawn.object());
    let larger = of(true).chain(of(false)).map(larger);
    let larger = std::iter::once("var object = 0;".to_owned()).chain(larger);
    write_function(text, "largest_object() -> i32", larger, Some("object"));
    let seen = parts
        .iter()
        .map(|drawn| (drawn.object(), format!("seen_part_{}(found[{}], shaded)", drawn.part, drawn.object())));
    let background = "Together(shaded, here, found[0].a)";
    write_switch(text, "seen_object(object: i32, shaded: Shaded) -> Together", "object", seen, background);
}

/// Writes the combined seeds of `halos` halos at a sample ([VS-2]).
fn seeds_together(text: &mut String, halos: usize, parts: &[DrawnPart]) {
    let _ = write!(
        text,
        "\n// s of each halo, of one set and of all.\n\
         var<private> seeds_of_set: array<real, {halos}>;\n\
         var<private> seeds_together: array<real, {halos}>;\n"
    );
    let mut calls = vec!["find_shares(k);".to_owned(), "sow_background(k, shares.background);".to_owned()];
    calls.extend(parts.iter().filter(|drawn| drawn.seeds).map(|drawn| match drawn.takes {
        true => format!("sow_part_{}(k, {});", drawn.part, drawn.weight()),
        false => format!("sow_beside_{}(k);", drawn.part),
    }));
    write_function(text, "sow_objects(k: i32)", calls, None);
}

/// Writes the calls that find intersections and read objects for them, then those that find fractions for layers.
fn meetings(
    text: &mut String,
    shader: &mut Shader,
    combination: &Combination,
    pictures: &[Option<&IntersectionPicture>],
    parts: &[DrawnPart],
    scales: &Scales,
) {
    let scales_of = |part: usize| parts.iter().find(|drawn| drawn.part == part).map(|drawn| drawn.scales);
    let (mut calls, mut paints, mut tables) = (Vec::new(), Vec::new(), Vec::new());
    let covers = shader.stages.covering > 0;
    for (i, intersection) in combination.intersections.iter().enumerate() {
        let Intersection { selection, ghost, opacity, swap, .. } = intersection;
        let of_other = ghost.map_or(Some(*scales), scales_of);
        let (Some(of_selection), Some(of_other)) = (scales_of(*selection), of_other) else { continue };
        let preset = match opacity {
            IntersectionOpacity::Max => 0,
            IntersectionOpacity::Over => 1,
            IntersectionOpacity::In => 2,
            IntersectionOpacity::Out => 3,
            IntersectionOpacity::Atop => 4,
            IntersectionOpacity::Xor => 5,
            IntersectionOpacity::Plus => 6,
        };
        let [selection, other] = [selection + 1, ghost.map_or(0, |ghost| ghost + 1)];
        calls.push(format!("meet({i}, {selection}, {other}, {preset}, {swap});"));
        if covers {
            calls.push(format!("deal_meeting({selection}, {other}, sets[OBJECTS + {i}].mu, met_opacities);"));
        }
        let scales = [&of_other, &of_selection];
        let color = paint(shader, (i, intersection), pictures.get(i).copied().flatten(), scales, &mut tables);
        paints.push((i, under_dabs(shader, color, intersection, scales, &mut tables)));
    }
    if !tables.is_empty() {
        shader.add(&[BILINEAR, module!("intersections_picture")]);
        shader.bind(25, "the pictures and dabs of intersections", Data::Reals(tables));
    }
    if !calls.is_empty() {
        shader.add(&[module!("intersections"), module!("object_ray_meeting")]);
        calls.push("take_out_of_selections();".to_owned());
        let head = "painted_meeting(i: i32, own: Shaded, other: Shaded, opacity: real, values: vec2<real>) -> Shaded";
        write_switch(text, head, "i", paints, "Shaded()");
        for (head, of_part, of_background) in [
            ("unlit_object(object: i32, a: Attributes) -> Shaded", "unlit_part_@(a)", "unlit_background(a)"),
            (
                "light_object(object: i32, a: Attributes, plain: Shaded) -> Shaded",
                "light_part_@(a, plain)",
                "light_background(a, plain)",
            ),
            ("value_of_object(object: i32) -> real", "part_sample_@.s", "here.s"),
        ] {
            let each = parts.iter().map(|drawn| (drawn.object(), of_part.replace('@', &drawn.part.to_string())));
            write_switch(text, head, "object", each, of_background);
        }
    }
    if covers {
        shader.add(&[module!("sets_fractions")]);
        shader.stages.begin_ray.push("forget_fractions");
        calls.push("find_fractions(k);".to_owned());
    }
    write_function(text, "meet_objects(k: i32)", calls, None);
}

/// An expression for the unlit colour and opacity of an intersection. `scales` are those of the value at p and of that at T p.
fn paint(
    shader: &mut Shader,
    (i, intersection): (usize, &Intersection),
    picture: Option<&IntersectionPicture>,
    scales: [&Scales; 2],
    tables: &mut Vec<f64>,
) -> String {
    let block = &mut shader.block;
    match (&intersection.color, picture) {
        (IntersectionPaint::Color(rgb, opacity), _) => {
            for (name, value) in ["r", "g", "b", "a"].into_iter().zip([rgb[0], rgb[1], rgb[2], *opacity]) {
                block.number(format!("meeting_{name}_{i}"), value);
            }
            let [r, g, b] = ["r", "g", "b"].map(|name| format!("params.meeting_{name}_{i}"));
            format!("of_color(vec3<real>({r}, {g}, {b}), params.meeting_a_{i}, opacity)")
        }
        (IntersectionPaint::Picture(ranges), Some(picture)) => {
            let mut shares = Vec::new();
            for (axis, (range, scales)) in ranges.iter().zip(scales).enumerate() {
                let [low, high] = range.map(|end| scales.value(end));
                block.number(format!("meeting_low_{axis}_{i}"), low);
                block.number(format!("meeting_width_{axis}_{i}"), high - low);
                let range = format!("params.meeting_low_{axis}_{i}, params.meeting_width_{axis}_{i}");
                shares.push(format!("share_of_range(values[{axis}], {range})"));
            }
            let ([width, height], first) = (picture.size, tables.len() / 4);
            tables.extend(picture.pixels.as_flattened());
            let at = format!("intersection_at({first}, {width}, {height}, {}, {})", shares[0], shares[1]);
            let alpha = if picture.has_opacity { format!("{at}.a") } else { "opacity".into() };
            format!("Shaded({at}.rgb, {alpha})")
        }
        // Where both are transparent there is no intersection.
        (IntersectionPaint::Mean | IntersectionPaint::Picture(_), _) => "mean_color(own, other, opacity)".into(),
    }
}

/// An expression for a colour and opacity under the dabs of an intersection.
fn under_dabs(
    shader: &mut Shader,
    color: String,
    intersection: &Intersection,
    scales: [&Scales; 2],
    tables: &mut Vec<f64>,
) -> String {
    if intersection.dabs.is_empty() {
        return color;
    }
    shader.add(&[ELEMENTARY, module!("intersections_dabs")]);
    // f32 has room for every place, so that no quotient in the shader is 0/0 or ∞/∞.
    let most = f64::from(f32::MAX);
    let first = tables.len() / 4;
    for Dab { at, width, color } in &intersection.dabs {
        tables.extend([0, 1].map(|i| scales[i].value(at[i]).clamp(-most, most)));
        tables.extend([0, 1].map(|i| scales[i].difference(width[i]).clamp(f64::from(f32::MIN_POSITIVE), most)));
        tables.extend(color);
    }
    format!("painted_by_all({color}, {first}, {}, values)", intersection.dabs.len())
}

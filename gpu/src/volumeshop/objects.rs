//! Objects together ([VS-2] … [VS-4], [VS-7]): functions of the picture's shader that call those of its parts.

use super::funnel;
use crate::Precision;
use crate::field::Scales;
use crate::module::{Module, module};
use crate::number::{BILINEAR, ELEMENTARY, NUMBER};
use crate::shader::{Data, Shader};
use drypoint_scene::intersection_picture::IntersectionPicture;
use drypoint_scene::shot::{
    Combination, Cut, Cutaway, Dab, Fuzzy, Intersection, IntersectionOpacity, IntersectionPaint, Lighting, Material,
    Shot, Transparency,
};
use std::fmt::Write;

/// A selection or a ghost that can show something.
pub(crate) struct DrawnPart {
    /// Its place among the shot's parts.
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
    /// An expression for the membership of its selection set (eqs. 1, 2).
    fn weight(&self) -> String {
        let part = self.part;
        if self.takes { format!("taken_{part} * share") } else { format!("part_membership_{part}(k)") }
    }
}

/// The end of a part's names.
pub(crate) fn suffix(part: usize) -> String {
    format!("_{part}")
}

/// The name of the first sample that a cutaway leaves.
pub(crate) fn cut_end(cutaway: usize) -> String {
    format!("cut_end_{cutaway}")
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
    shader.add(&[NUMBER, module!("sets"), module!("background")]);
    shader.add(&[match combination.fuzzy {
        Fuzzy::Zadeh => module!("zadeh"),
        Fuzzy::Product => module!("product"),
    }]);
    shader.stages.begin_part.push("aim_objects");
    let cutaways: Vec<_> = super::cutaways(combination).collect();
    if !cutaways.is_empty() {
        shader.add(&[module!("ghosting"), enhancement(&shot.objects[0].material)]);
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
    let mut text = rays(parts, &cutaways);
    text += &ghosts(cutaways.len());
    text += &together(shader, combination, pictures, parts, scales);
    if halos > 0 {
        text += &seeds_together(halos, parts);
    }
    shader.stages.objects = Some(text);
}

/// The enhancement of a material, which ghosting spares.
fn enhancement(material: &Material) -> Module {
    match material {
        Material::Style(style) if style.transparency == Transparency::Illustrative => module!("enhancement_of_style"),
        Material::Regular(lit) if matches!(lit.lighting, Lighting::Function(_)) => module!("enhancement_of_lighting"),
        Material::Style(_) | Material::Regular(_) => module!("enhancement_none"),
    }
}

/// The rays of parts, and the samples at which each can show something.
fn rays(parts: &[DrawnPart], cutaways: &[&Cutaway]) -> String {
    let (mut aims, mut run, mut spans, mut cuts) = (String::new(), String::new(), String::new(), String::new());
    let (mut variables, mut planes, mut funnels) = (String::new(), String::new(), 0);
    for DrawnPart { part, takes, .. } in parts {
        let _ = writeln!(aims, "    aim_part_{part}(at.x, at.y);");
        let _ = writeln!(run, "    run = hull(run, part_range_{part});");
        let _ = writeln!(spans, "    span = span_within(span, k, part_range_{part});");
        if *takes {
            let _ = writeln!(spans, "    span = span_within(span, k, selection_range_{part});");
        }
    }
    for (i, cutaway) in cutaways.iter().enumerate() {
        let _ = writeln!(variables, "var<private> cut_end_{i}: i32;");
        let _ = writeln!(spans, "    span = span_within(span, k, vec2(NO_SAMPLE, cut_end_{i} - 1));");
        let plane = match cutaway.cut {
            Cut::Bounds => format!("far_side_{}()", cutaway.part),
            Cut::Object => format!("last_member_{}()", cutaway.part),
        };
        let mut end = plane.clone();
        if cutaway.funnel > 0.0 {
            let _ = writeln!(planes, "        case {funnels}: {{ return {plane}; }}");
            end = format!("funnel_end({funnels}, {plane})");
            funnels += 1;
        }
        let _ = writeln!(cuts, "    cut_end_{i} = i32(ceil({end}));");
    }
    let mut text = format!(
        "\n// The first samples that cutaways leave ([VS-7]).\n{variables}\n\
         fn aim_parts(at: vec2<real>) {{\n{aims}}}\n\n\
         fn run_of_parts(own: vec2<i32>) -> vec2<i32> {{\n    var run = own;\n{run}    return run;\n}}\n\n\
         fn span_from(k: i32, last: i32) -> Span {{\n    var span = Span(last, false);\n{spans}    return span;\n}}\n\n\
         fn end_cutaways() {{\n{cuts}}}\n"
    );
    if funnels > 0 {
        let _ = write!(
            text,
            "\nfn funnel_plane(funnel: i32) -> real {{\n    switch funnel {{\n{planes}        \
             default: {{ return -NOT_MET; }}\n    }}\n}}\n"
        );
    }
    text
}

/// The ghosting of the background by a number of cutaways.
fn ghosts(cutaways: usize) -> String {
    let (mut gone, mut factors, mut any) = (String::new(), String::new(), Vec::new());
    for i in 0..cutaways {
        let _ = writeln!(gone, "    if (k < cut_end_{i} && params.ghosting_{i} >= 1.0) {{ return true; }}");
        let factor = format!("factor *= ghosting_factor(params.ghosting_{i}, e);");
        let _ = writeln!(factors, "        if (k < cut_end_{i}) {{ {factor} }}");
        any.push(format!("k < cut_end_{i}"));
    }
    let is_before = if cutaways > 0 { any.join(" || ") } else { "false".into() };
    if cutaways > 0 {
        factors = format!("    if (is_before_cut(k)) {{\n        let e = enhancement(own_ray, a);\n{factors}    }}\n");
    }
    format!(
        "\nfn is_before_cut(k: i32) -> bool {{\n    return {is_before};\n}}\n\
         \nfn is_ghosted_away(k: i32) -> bool {{\n{gone}    return false;\n}}\n\n\
         fn ghosted(k: i32, a: Attributes) -> real {{\n    var factor = real(1.0);\n{factors}    return factor;\n}}\n"
    )
}

/// The sets at a sample together (eqs. 1 to 7).
fn together(
    shader: &mut Shader,
    combination: &Combination,
    pictures: &[Option<&IntersectionPicture>],
    parts: &[DrawnPart],
    scales: &Scales,
) -> String {
    let mut text = String::from("\nfn together(k: i32) -> Together {\n    var taken = real(0.0);\n");
    let line = |text: &mut String, line: String| {
        let _ = writeln!(text, "    {line}");
    };
    // Eq. 1: what selections take, and what is left.
    for DrawnPart { part, .. } in parts.iter().filter(|drawn| drawn.takes) {
        line(&mut text, format!("let taken_{part} = part_takes_{part}(k);"));
        line(&mut text, format!("taken = taken_with(taken, taken_{part});"));
    }
    // Eqs. 2 and 3.
    line(&mut text, "let share = share_of_each(taken);".into());
    line(&mut text, "let set_b = background_set(k, share_of_background(taken));".into());
    line(&mut text, "var mu_b = set_b.mu;".into());
    for drawn in parts {
        let part = drawn.part;
        line(&mut text, format!("let set_{part} = part_set_{part}(k, {});", drawn.weight()));
        line(&mut text, format!("var mu_{part} = set_{part}.mu;"));
    }
    // Eqs. 6 and 7: intersections, taken out of the sets that meet.
    let met = meetings(shader, combination, pictures, parts, scales);
    text += &met.text;
    // Eqs. 4 and 5.
    line(&mut text, "var sets = with_shared(Sets(), set_b.rgb, mu_b);".into());
    for DrawnPart { part, .. } in parts.iter().filter(|drawn| drawn.takes) {
        line(&mut text, format!("sets = with_shared(sets, set_{part}.rgb, mu_{part});"));
    }
    line(&mut text, "sets.union_mu = min(sets.shared_mu, 1.0);".into());
    for DrawnPart { part, .. } in parts.iter().filter(|drawn| !drawn.takes) {
        line(&mut text, format!("sets = with_other(sets, set_{part}.rgb, mu_{part});"));
    }
    for i in met.drawn {
        line(&mut text, format!("sets = with_other(sets, meeting_{i}.rgb, meeting_{i}.alpha);"));
    }
    line(&mut text, "let shaded = combined(sets);".into());
    // The set that counts for most; of equals a selection, then a ghost, each the first.
    line(&mut text, "var most = set_b.mu;".into());
    line(&mut text, "var seen = Together(shaded, here, set_b.a);".into());
    for is_ghost in [true, false] {
        for DrawnPart { part, .. } in parts.iter().rev().filter(|drawn| drawn.is_ghost == is_ghost) {
            let seen = format!("most = set_{part}.mu; seen = seen_part_{part}(set_{part}, shaded);");
            line(&mut text, format!("if (set_{part}.mu > 0.0 && set_{part}.mu >= most) {{ {seen} }}"));
        }
    }
    text + "    return seen;\n}\n"
}

/// The seeds of so many halos at a sample, of all sets together ([VS-2]).
fn seeds_together(halos: usize, parts: &[DrawnPart]) -> String {
    let mut lines = String::from("    var taken = real(0.0);\n");
    for DrawnPart { part, .. } in parts.iter().filter(|drawn| drawn.takes) {
        let _ = writeln!(lines, "    let taken_{part} = part_takes_{part}(k);");
        let _ = writeln!(lines, "    taken = taken_with(taken, taken_{part});");
    }
    lines += "    sow_background(k, share_of_background(taken));\n    let share = share_of_each(taken);\n";
    for drawn in parts.iter().filter(|drawn| drawn.seeds) {
        let part = drawn.part;
        let _ = match drawn.takes {
            true => writeln!(lines, "    sow_part_{part}(k, {});", drawn.weight()),
            false => writeln!(lines, "    sow_beside_{part}(k);"),
        };
    }
    format!(
        "\n// s of each halo, of one set and of all.\n\
         var<private> seeds_of_set: array<real, {halos}>;\n\
         var<private> seeds_together: array<real, {halos}>;\n\n\
         fn sow_objects(k: i32) {{\n{lines}}}\n"
    )
}

/// Lines that find the sets of intersections, and which of these there are.
struct Meetings {
    text: String,
    drawn: Vec<usize>,
}

fn meetings(
    shader: &mut Shader,
    combination: &Combination,
    pictures: &[Option<&IntersectionPicture>],
    parts: &[DrawnPart],
    scales: &Scales,
) -> Meetings {
    let scales_of = |part: usize| parts.iter().find(|drawn| drawn.part == part).map(|drawn| drawn.scales);
    let (mut text, mut drawn, mut taken) = (String::new(), Vec::new(), Vec::new());
    let mut tables = Vec::new();
    for (i, intersection) in combination.intersections.iter().enumerate() {
        let s = intersection.selection;
        let of_other = intersection.ghost.map_or(Some(*scales), scales_of);
        let (Some(of_selection), Some(of_other)) = (scales_of(s), of_other) else { continue };
        if !taken.contains(&s) {
            let _ = writeln!(text, "    var taken_out_{s} = real(0.0);");
            taken.push(s);
        }
        let picture = pictures.get(i).copied().flatten();
        let scales = [&of_other, &of_selection];
        let color = paint(shader, (i, intersection), picture, scales, &mut tables);
        let color = under_dabs(color, intersection, scales, &mut tables);
        text += &meeting(i, intersection, &color);
        drawn.push(i);
    }
    for s in taken {
        let _ = writeln!(text, "    if (taken_out_{s} > 0.0) {{ mu_{s} = without(mu_{s}, taken_out_{s}); }}");
    }
    if !drawn.is_empty() {
        shader.add(&[module!("meeting")]);
    }
    if !tables.is_empty() {
        shader.add(&[BILINEAR, ELEMENTARY, module!("intersection_picture"), module!("dabs")]);
        shader.bind(25, "the pictures and dabs of intersections", Data::Reals(tables));
    }
    Meetings { text, drawn }
}

/// The lines of an intersection, whose unlit colour and opacity an expression says.
fn meeting(i: usize, intersection: &Intersection, color: &str) -> String {
    let s = intersection.selection;
    let (o, unlit, light) = match intersection.ghost {
        Some(ghost) => (ghost.to_string(), format!("unlit_part_{ghost}"), format!("light_part_{ghost}")),
        None => ("b".into(), "unlit_background".into(), "light_background".into()),
    };
    let preset = match intersection.opacity {
        IntersectionOpacity::Max => 0,
        IntersectionOpacity::Over => 1,
        IntersectionOpacity::In => 2,
        IntersectionOpacity::Out => 3,
        IntersectionOpacity::Atop => 4,
        IntersectionOpacity::Xor => 5,
        IntersectionOpacity::Plus => 6,
    };
    let [a, b] = if intersection.swap { ["other", "own"] } else { ["own", "other"] };
    format!(
        "    var meeting_{i} = Shaded();\n\
         \x20   if (both(set_{o}.mu, set_{s}.mu) > 0.0) {{\n\
         \x20       let wins = set_{s}.mu >= set_{o}.mu;\n\
         \x20       var a = set_{o}.a;\n\
         \x20       if (wins) {{ a = set_{s}.a; }}\n\
         \x20       let own = unlit_part_{s}(a);\n\
         \x20       var other = {unlit}(a);\n\
         \x20       other.alpha *= set_{o}.faded;\n\
         \x20       let preset = opacity_of_both({preset}, {a}.alpha, {b}.alpha);\n\
         \x20       var lit = {color};\n\
         \x20       if (wins) {{ lit = light_part_{s}(a, lit); }} else {{ lit = {light}(a, lit); }}\n\
         \x20       meeting_{i} = Shaded(lit.rgb, both(both(set_{o}.weight, set_{s}.weight), lit.alpha));\n\
         \x20   }}\n\
         \x20   if (meeting_{i}.alpha > 0.0) {{\n\
         \x20       taken_out_{s} = either(taken_out_{s}, meeting_{i}.alpha);\n\
         \x20       mu_{o} = without(mu_{o}, meeting_{i}.alpha);\n\
         \x20   }}\n"
    )
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
            format!("Shaded(vec3<real>({r}, {g}, {b}), preset * params.meeting_a_{i})")
        }
        (IntersectionPaint::Picture(ranges), Some(picture)) => {
            let mut shares = Vec::new();
            for (axis, ((range, scales), value)) in ranges.iter().zip(scales).zip(values(intersection)).enumerate() {
                let [low, high] = range.map(|end| scales.value(end));
                block.number(format!("meeting_low_{axis}_{i}"), low);
                block.number(format!("meeting_width_{axis}_{i}"), high - low);
                shares.push(format!("({value} - params.meeting_low_{axis}_{i}) / params.meeting_width_{axis}_{i}"));
            }
            let ([width, height], first) = (picture.size, tables.len() / 4);
            tables.extend(picture.pixels.as_flattened());
            let at = format!("intersection_at({first}, {width}, {height}, {}, {})", shares[0], shares[1]);
            let alpha = if picture.has_opacity { format!("{at}.a") } else { "preset".into() };
            format!("Shaded({at}.rgb, {alpha})")
        }
        // Where both are transparent there is no intersection.
        (IntersectionPaint::Mean | IntersectionPaint::Picture(_), _) => "mean_color(own, other, preset)".into(),
    }
}

/// Expressions for the value at p and that at T p.
fn values(intersection: &Intersection) -> [String; 2] {
    let here = intersection.ghost.map_or("here.s".to_owned(), |ghost| format!("part_sample_{ghost}.s"));
    [here, format!("part_sample_{}.s", intersection.selection)]
}

/// An expression for a colour and opacity under the dabs of an intersection.
fn under_dabs(color: String, intersection: &Intersection, scales: [&Scales; 2], tables: &mut Vec<f64>) -> String {
    if intersection.dabs.is_empty() {
        return color;
    }
    // f32 has room for every place, so that no quotient in the shader is 0/0 or ∞/∞.
    let most = f64::from(f32::MAX);
    let first = tables.len() / 4;
    for Dab { at, width, color } in &intersection.dabs {
        tables.extend([0, 1].map(|i| scales[i].value(at[i]).clamp(-most, most)));
        tables.extend([0, 1].map(|i| scales[i].difference(width[i]).clamp(f64::from(f32::MIN_POSITIVE), most)));
        tables.extend(color);
    }
    let [here, there] = values(intersection);
    format!("painted_by_all({color}, {first}, {}, vec2<real>({here}, {there}))", intersection.dabs.len())
}

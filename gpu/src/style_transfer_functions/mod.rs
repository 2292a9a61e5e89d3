//! Bruckner and Gröller, Style Transfer Functions for Illustrative Volume Rendering, Computer Graphics Forum 26(3), 2007.

use crate::module::{Module, module};
use crate::number::{BILINEAR, COLOR, ELEMENTARY};
use crate::ray::EYE_NORMAL;
use crate::shader::{Data, Shader};
use drypoint_scene::math;
use drypoint_scene::shot::{Clipping, ContourParams, Kappa, Mix, Shot, SphereFrame, StyleParams, Transparency, Turn};
use drypoint_scene::style::Style;

/// Adds κ along the ray ([STF-5]).
pub(crate) fn add_curvature_along_ray(shader: &mut Shader, turn: Turn) {
    let of_turn = match turn {
        Turn::OfNormals => module!("curvature_along_ray_of_normals"),
        Turn::OfLines => module!("curvature_along_ray_of_lines"),
    };
    shader.add(&[ELEMENTARY, of_turn, module!("curvature_along_ray")]);
    shader.stages.begin_ray.push("forget_normal");
    shader.stages.measured.push("measure_along_ray");
}

/// Adds a function of styles. `of_node` is the index function, and `between` finds the styles and the opacity of a
/// sample. The spheres themselves are added separately.
pub(crate) fn add(
    shader: &mut Shader,
    shot: &Shot,
    params: &StyleParams,
    of_node: &[usize],
    voxel: f64,
    between: Module,
) {
    match params.level_of_detail {
        None => shader.add(&[module!("mipmaps_none")]),
        Some(level) => {
            shader.add(&[ELEMENTARY, module!("mipmaps")]);
            let block = &mut shader.block;
            block.number("curvature_bias", level.curvature_bias);
            block.number("gradient_bias", level.gradient_bias);
            block.number("assumed_turn", level.turn);
            block.number("mip_voxel", voxel);
            block.number("rays_in_voxel", voxel * shot.rays_across as f64 / shot.view.pixel);
        }
    }
    // Which styles, and their mix.
    if of_node.iter().enumerate().all(|(k, &j)| k == j) {
        shader.add(&[module!("lookup_index_same")]);
    } else {
        shader.add(&[module!("lookup_index")]);
        shader.bind(3, "the styles of nodes", Data::Words(of_node.iter().map(|&j| j as u32).collect()));
    }
    match params.mix {
        Mix::Premultiplied => shader.add(&[module!("lookup_mix_premultiplied")]),
        Mix::Printed => shader.add(&[ELEMENTARY, COLOR, module!("lookup_mix_printed")]),
    }
    shader.add(&[module!("lookup"), between]);
    // The normal that is looked up, and the opacity.
    shader.add(&[EYE_NORMAL]);
    add_frame(shader, params.frame);
    match &params.contour {
        None => shader.add(&[module!("contour_none")]),
        Some(contour) => add_contour(shader, contour),
    }
    shader.add(&[match params.transparency {
        Transparency::Plain => module!("transparency_plain"),
        Transparency::Illustrative => module!("transparency_illustrative"),
    }]);
    shader.add(&[module!("style")]);
    shader.stages.unlit.push("shade_style");
}

/// The styles of a place between the nodes of a function over the value.
pub(crate) const OVER_VALUE: Module = module!("lookup_over_value");

/// Adds the frame of the lit sphere ([STF-1]).
fn add_frame(shader: &mut Shader, frame: SphereFrame) {
    shader.add(&[match frame {
        SphereFrame::Eye => module!("frame_eye"),
        SphereFrame::View => module!("frame_view"),
    }]);
}

/// Adds the texels of the function's styles ([STF-1]), those of the styles of caps ([RAY-8]), and those of the function's
/// mip-maps ([STF-10]), after what shades cuts.
pub(crate) fn add_spheres(shader: &mut Shader, clipping: &Clipping, styles: [&[Style]; 2], with_levels: bool) {
    let [of_function, of_caps] = styles;
    if of_function.is_empty() && of_caps.is_empty() {
        return;
    }
    let mut texels: Vec<[f32; 4]> = Vec::new();
    let mut add = |side: usize, of: &[[f64; 4]]| {
        let first = texels.len() as u32;
        texels.extend(of.iter().map(|texel| texel.map(|c| c as f32)));
        [first, side as u32, 0, 0]
    };
    let all = of_function.iter().chain(of_caps);
    let mut maps: Vec<[u32; 4]> = all.clone().map(|style| add(style.side, &style.texels)).collect();
    if with_levels {
        let mut lambdas: Vec<f64> = all.map(|style| math::log2(style.side as f64)).collect();
        for (j, style) in of_function.iter().enumerate() {
            let levels = style.mip_levels();
            [maps[j][2], maps[j][3]] = [maps.len() as u32, levels.len() as u32];
            for level in levels {
                maps.push(add(level.side, &level.texels));
                lambdas.push(level.lambda);
            }
        }
        shader.bind(12, "the levels of mip-maps", Data::Reals(lambdas));
    }
    shader.add(&[BILINEAR, module!("sphere_map")]);
    shader.bind(10, "the styles", Data::Texels(texels));
    shader.bind(11, "the list of styles", Data::Words(maps.into_flattened()));
    if !of_caps.is_empty() {
        shader.add(&[ELEMENTARY, COLOR, EYE_NORMAL]);
        add_frame(shader, clipping.frame);
        shader.add(&[module!("cut_style")]);
        shader.stages.cut.push("show_styled_cap");
    }
}

/// Adds contours ([STF-7], [STF-8]).
fn add_contour(shader: &mut Shader, contour: &ContourParams) {
    shader.add(&[module!("contour")]);
    match contour.kappa {
        Kappa::Ray | Kappa::Exact => {
            shader.add(&[module!("contour_by_curvature")]);
            shader.block.number("contour_thickness", contour.thickness);
        }
        Kappa::None { threshold } => {
            shader.add(&[module!("contour_constant")]);
            shader.block.number("contour_constant", threshold);
        }
    }
    match contour.fade {
        None => shader.add(&[module!("contour_no_fade")]),
        Some([low, high]) => {
            shader.add(&[module!("contour_fade")]);
            shader.block.number("fade_low", low);
            shader.block.number("fade_width", high - low);
        }
    }
}

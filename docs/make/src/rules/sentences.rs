//! What each rule says, in a sentence of our own.

/// Rules of one subject: the letters of their tags, the subject, and a sentence for each number.
pub(super) struct Family {
    pub(super) letters: &'static str,
    pub(super) subject: &'static str,
    pub(super) rules: &'static [(u32, &'static str)],
}

/// Every family, in the order of the page; a line a rule.
#[rustfmt::skip]
pub(super) const FAMILIES: [Family; 17] = [
    Family {
        letters: "SPACE",
        subject: "Spaces",
        rules: &[
            (1, "Index space has voxel centres at whole numbers; the field exists in the box between the outermost centres and nowhere else, and along an axis of one voxel it is constant."),
            (2, "World space is the file's own: axis directions times spacings, plus the origin; axes that do not span space are an error."),
            (3, "Eye space is right-handed with x to the right and y up; the camera looks along −z, and v points from a sample towards the eye."),
            (4, "Gradients and Hessians are those of the world, so spacing and shear bend no normal; squares are taken after scaling by a power of two, so none overflows."),
            (5, "Lengths in a scene are in world units, in voxels (the smallest spacing), or on the page in px and mm."),
        ],
    },
    Family {
        letters: "NORM",
        subject: "Normals",
        rules: &[
            (1, "Shading uses the outward normal, against the gradient where values fall outwards; a switch flips it towards the eye or takes the gradient's own side, and a sample without a normal takes v."),
        ],
    },
    Family {
        letters: "VAL",
        subject: "Values, colours, opacities",
        rules: &[
            (1, "Transfer functions are over the values that the file means, after slope and intercept; a normalized value is its place in the volume's range or in one that the scene gives."),
            (2, "|g| is the norm of the gradient brought to [0, 1] by a given range, or by a quantile of the norms over all voxels that have a normal and touch no masked one."),
            (3, "Colours are composited linear, premultiplied, front to back; a scene says them in sRGB, and only a PNG encodes them, once, on the way out; compositing encoded values is a switch."),
            (4, "Opacities are per reference length and are corrected to the distance between samples on the ray as the last step of all, exactly at 0 and 1."),
        ],
    },
    Family {
        letters: "REC",
        subject: "Reconstruction",
        rules: &[
            (1, "Values come from one of five kernels, trilinear to quintic B-spline, with cells and borders such that constants come out exactly and linear fields up to the border."),
            (2, "Gradients come from central differences, the kernel's own derivative, Sobel's operator or a linear regression; at borders differences are one-sided."),
            (3, "Hessians come from the kernel, from differences, or from a Gaussian-smoothed grid, which is the automatic choice for files of integers."),
            (4, "Every estimator reproduces the polynomials that it should, up to the border and on sheared grids, to a stated multiple of rounding."),
        ],
    },
    Family {
        letters: "CUR",
        subject: "Curvature",
        rules: &[
            (1, "Principal curvatures are those of the level set by gradient and Hessian of one field, ordered by value, positive on a ball that is bright inside."),
            (2, "κ_v is the normal curvature in the direction of the view projected into the tangent plane; seen straight on, the mean curvature."),
            (3, "Angles are taken by atan2 of cross and dot product, never by acos; a root's argument is clamped once, where its formula is."),
        ],
    },
    Family {
        letters: "RAY",
        subject: "Rays and camera",
        rules: &[
            (1, "Samples lie on planes (or shells) at eye depths (k + ½)Δ that belong to the camera alone; a position is a function of pixel and k, formed in index space."),
            (2, "Leaving out empty bricks changes no bit; a ray that ends early is wrong by at most ε of the largest colour."),
            (3, "The picture does not depend on the number of threads or the order of tiles."),
            (4, "Randomness is Philox4x32-10 counted by place and draw: the same scene has the same numbers everywhere."),
            (5, "What the camera looks at by default, from how far and with which height, follows from the box of the volume."),
            (6, "One ray goes through the centre of each pixel, or of each of n×n equal parts of it, whose results are averaged."),
        ],
    },
    Family {
        letters: "PREC",
        subject: "Precision",
        rules: &[
            (1, "The reference computes in f64 from the stored voxels to the picture; what f32 loses is measured."),
            (2, "A voxel that is not finite is counted, filled from the nearest valid one and masked; samples whose cell touches it are transparent."),
            (3, "A gradient that is no more than the rounding of the data gives no normal: N = v, no contour, κ = 0, and such samples are counted."),
            (4, "The same bits on every machine: basic operations, one module of transcendental functions, nothing fused, sums in a fixed order."),
        ],
    },
    Family {
        letters: "PLAN",
        subject: "Only what the scene calls for",
        rules: &[
            (1, "A scene becomes a plan, the list of what samples and passes need; what is not in it is neither computed nor allocated."),
            (2, "A render counts what it did, and tests hold the counts."),
            (3, "The plan is printed for a person: effect, need, price, and the line that asked."),
        ],
    },
    Family {
        letters: "STF",
        subject: "Style transfer functions (Bruckner and Gröller 2007)",
        rules: &[
            (1, "A style is a square picture of a sphere, looked up at the eye-space normal's x and y; texels outside the disk are never read."),
            (2, "Styles are extracted from pictures: a circle, an ellipse or an outline is resampled to a disk."),
            (3, "Nodes over the values carry styles and opacities; between two nodes both styles are looked up and mixed."),
            (4, "A function may be over two quantities out of an open list, on a grid of nodes or in rows of their own."),
            (5, "κ_v along the ray is the angle between a sample's normal and the previous one's, over their distance; it needs no Hessian."),
            (6, "κ_v is taken along the ray, exactly from the Hessian, or replaced by a constant threshold."),
            (7, "A sample is on a contour of thickness T where |N·v| ≤ √(Tκ(2 − Tκ)), with Tκ clamped to [0, 1]; a fade by |g| can weaken it."),
            (8, "On a contour the lookup is pushed outwards, so that a style's rim becomes the line."),
            (9, "Illustrative transparency raises α_u to a power that falls where the surface turns away or the gradient is strong."),
            (10, "Styles have mip-maps of their disk alone; the level follows from projected voxel, curvature and |g|."),
            (11, "A regular function with Blinn–Phong shading is there to compare with, with the same opacities and steps."),
            (12, "Styles are files and a theme is a set of them by name; exchanging the theme changes no other line."),
            (13, "Labels are a second volume, read at the nearest voxel or by the heaviest of the eight around, never interpolated between ids."),
        ],
    },
    Family {
        letters: "SCN",
        subject: "Scene files",
        rules: &[
            (1, "A table is an effect: without it the effect does not exist and costs nothing."),
            (2, "Numbers are world units, texts carry their unit; colours are sRGB; paths are relative to the scene file, those of the command line to the working directory."),
            (3, "Every key has a default that suits a first picture, and the scene with all of them filled in is a scene."),
            (4, "All faults are told at once, with file, line, column, key, what was expected and the nearest name; keys without effect are listed, not refused."),
        ],
    },
    Family {
        letters: "IO",
        subject: "Files",
        rules: &[
            (1, "Volumes are read from NRRD, NIfTI, MetaImage and raw files; what a header claims is checked against the file before anything is allocated."),
            (2, "Pictures are PNG or EXR and say program, scene and plan but no date: the same scene gives the same bytes."),
            (3, "Scene files are TOML with a version, a JSON Schema and no unknown keys; every example in the docs is read by a test."),
            (4, "Phantoms have known values, gradients, Hessians and curvatures, in any size, spacing and type."),
            (5, "Presets and tables of other programs are read into our types, and what could not be carried over is named."),
            (6, "An EXR holds named layers whose meaning in a translucent volume is written down: means weighted by what a sample contributes, depths of planes, what is first."),
            (7, "Points and lines go to SVG and PDF in millimetres, a layer a pen."),
        ],
    },
    Family {
        letters: "HALO",
        subject: "Volumetric halos (Bruckner and Gröller 2007), not built yet",
        rules: &[
            (1, "Any number of halos is composited plane by plane, each with its own table."),
            (4, "A halo's seeds are spread as an image, by their gradient or as they are."),
            (12, "A pixel picks the first visible structure along its ray."),
        ],
    },
    Family {
        letters: "VS",
        subject: "VolumeShop (Bruckner and Gröller 2005), not built yet",
        rules: &[
            (2, "A scene can hold several objects, each with its own volume, selection, motion and function."),
            (3, "Objects are combined by fuzzy sets: colours by membership, opacities by its operators."),
            (4, "Where two objects meet, a function over both values may decide."),
            (5, "Lighting may come from a table over N·L and N·Ĥ."),
            (6, "Selections are painted onto the volume by strokes."),
            (8, "Boxes, arrows and fans say what was moved where."),
            (10, "Labels stand around the picture and are tied to their anchors; an orbit turns the camera."),
            (11, "A scene without its volume is a template; its nodes are in values, normalized, or percentiles."),
            (12, "Opaque meshes are intersected with the volume."),
        ],
    },
    Family {
        letters: "STIP",
        subject: "Stippling (Lu et al. 2002)",
        rules: &[
            (1, "Gradient and smoothed value come at once from a weighted linear fit to the 3×3×3 voxels around (Neumann and others, 2000)."),
            (2, "Where a voxel's projection is smaller than 5×5 pixels, boxes of voxels stand in their place."),
            (3, "A voxel has as many points as its projection has pixels, times a constant (equation 1)."),
            (4, "Voxels whose gradient is above a threshold get random points, relaxed and in an order of which every prefix is evenly spread, across voxels too; they may be snapped onto the edge, and a face may be thinned to one layer."),
            (5, "Of a voxel's list as many points are drawn as the product of the factors says (equations 2 and 3); the next one fades in, or whole ones are spread by blue noise."),
            (6, "Dots are as large as the gradient says (equation 4); a pen has one size and keeps the ink."),
            (7, "More points on boundaries (equation 5)."),
            (8, "More points on silhouettes (equation 6)."),
            (9, "Fewer and smaller points of a volume farther away (equation 7, its fraction the other way up)."),
            (10, "Fewer and smaller points in the far parts of the volume (equation 8)."),
            (11, "Transparency by the gradient (equation 9)."),
            (12, "Fewer points where light falls, none on what faces away (equation 10)."),
            (13, "Silhouette curves are segments through voxels whose normal lies across the view."),
            (14, "The paper's figures are presets."),
            (15, "Points can be hidden behind an iso-surface."),
            (16, "Lists of points and strokes are data that can be saved and drawn again."),
            (17, "Tone is coverage, and pens are measured for it."),
            (18, "How even points are is measured: nearest neighbours and spectrum, beside white noise and a repeated tile."),
            (19, "For a still picture dots can be chosen evenly on the page."),
        ],
    },
    Family {
        letters: "HATCH",
        subject: "Curvature hatching, toon shading, silhouettes and opaque surfaces (Nagy et al. 2002); surfaces and toon shading are built",
        rules: &[
            (1, "Strokes follow the principal directions of a surface."),
            (7, "What lies on a surface is asked for a fixed length in front of it."),
            (14, "Strokes can stand on, in or without a rendered surface."),
            (15, "Toon shading, silhouettes and view-dependent opacity."),
            (17, "The paper's figures are presets."),
            (18, "Outlines are strokes where a surface turns away."),
        ],
    },
    Family {
        letters: "GPU",
        subject: "A second renderer, not built yet",
        rules: &[
            (1, "The GPU draws the same scene by the same formulas, and both are compared effect by effect."),
            (2, "Its tolerances are derived for each effect, and decisions near their threshold are counted apart."),
            (3, "It runs on any adapter, and says what to install where there is none."),
            (4, "Shaders hold only what the plan has."),
            (5, "A picture of any other renderer can be compared by the same command; that is built."),
            (6, "The reference can compute by another renderer's conventions."),
            (7, "The mask of voxels that are not finite is made by the host."),
        ],
    },
    Family {
        letters: "COST",
        subject: "What accuracy costs",
        rules: &[
            (1, "Every knob of a scene can be swept, error against time."),
            (2, "The error is against the truth where that is known, else against the finest setting."),
            (3, "Times are medians of several runs with their spread."),
        ],
    },
];

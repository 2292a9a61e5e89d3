//! `[[mesh]]`: opaque meshes beside the volume ([VS-12]).

use super::object::{Factors, Matrix, Motion, ROTATION};
use crate::color::{Rgba, opaque};
use crate::document::declare::table;
use crate::document::describe::{Instead, Table};
use crate::document::fault::Problem;
use crate::document::kind::{Bounds, Colors, Numbers, PathTo, Rule, TableOf};
use std::path::PathBuf;

table! {
    /// One table `[[mesh]]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct MeshTable {
        /// A file of triangles or polygons, PLY, STL or OBJ, in the world units of the volume.
        ///
        /// The path is resolved like that of the volume.
        file: PathBuf = PathBuf::new(), key("VS-12", PathTo { what: "a mesh" }).required();
        /// The colour of the mesh.
        ///
        /// Linear, opaque. The default is CSS silver.
        color: Rgba = opaque([192.0; 3]), key("VS-12", Colors);
        /// The place of the mesh in the world.
        motion: Motion = Motion::NONE;
        /// The way that the mesh is moved.
        shift: key("VS-12", WAY,
            |m| m.motion.matrix.is_none().then(|| m.motion.shift.to_array()),
            |m, v| m.motion.shift = v.into()).named("move");
        /// Factor by which the mesh is scaled about `center`, or one for each world axis; negative reflects.
        scale: key("VS-12", Factors,
            |m| m.motion.matrix.is_none().then(|| m.motion.scale.to_array()),
            |m, v| m.motion.scale = v.into());
        /// Rotation of the mesh about `center`, after it was scaled.
        rotate: key("VS-12", TableOf(&ROTATION), |m| m.motion.rotation, |m, v| m.motion.rotation = Some(v))
            .absent("no rotation");
        /// The point about which the mesh is scaled and rotated.
        center: key("VS-12", POINT,
            |m| m.motion.center.map(|c| c.to_array()),
            |m, v| m.motion.center = Some(v.into())).absent("the centre of the mesh's box");
        /// The motion as an affine matrix by rows, the last [0, 0, 0, 1]; in place of the other four.
        matrix: key("VS-12", Matrix, |m| m.motion.matrix, |m, v| m.motion.matrix = Some(v))
            .absent("`move`, `scale`, `rotate` and `center`");
    }
}

const POINT: Numbers<3> = Numbers { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free };
const WAY: Numbers<3> = Numbers { what: "a way [x, y, z] in world units", bounds: Bounds::ANY, rule: Rule::Free };

/// The description of a table `[[mesh]]`.
pub(crate) static TABLE: Table<MeshTable> = Table {
    instead: &[Instead { one: "matrix", others: &["move", "scale", "rotate", "center"] }],
    check: |mesh, check| {
        if mesh.color[3] != 1.0 && check.sound(&["color"]) {
            let what = "the colour of a mesh has an opacity, and meshes are opaque".into();
            check.fault_in("color", Problem::Contradiction { what, remedy: "write it as \"#rrggbb\"".into() });
        }
        mesh.motion.check("the mesh", check);
    },
    ..MeshTable::description(
        "a mesh",
        "An opaque mesh of triangles: what lies behind it is not seen, and the volume before it covers it. It is lit with \
         the constants of [shading] or their defaults.",
    )
};

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse};
    use crate::plan::{Pass, Plan};
    use crate::quantity::Quantity;
    use crate::tables::Scene;
    use std::path::Path;

    fn scene(rest: &str) -> Result<Scene, String> {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{rest}");
        parse(&text, Path::new("in/scene.toml"), &Overrides::default()).map_err(|faults| faults.to_string())
    }

    #[test]
    fn a_mesh_stands_beside_the_volume() {
        let meshes = scene("[[mesh]]\nfile = \"plate.ply\"\n[[mesh]]\nfile = \"a.stl\"\nmove = [1, 2, 3]\n").unwrap();
        let c = 0.5271151257058131;
        assert_eq!(
            (meshes.meshes[0].file.as_path(), meshes.meshes[0].color),
            (Path::new("in/plate.ply"), [c, c, c, 1.0])
        );
        assert!(!meshes.meshes[0].motion.is_moved() && meshes.meshes[1].motion.is_moved());
        // The volume is drawn as without a mesh.
        assert!(meshes.transfer.is_some());
        let plan = Plan::new(&meshes);
        assert!(plan.needs(Quantity::Mesh) && !plan.needs(Quantity::Surface) && plan.has_pass(Pass::Rays));
        // With dots alone beside it there are rays for the mesh.
        let dots = scene("[stipples]\n[[mesh]]\nfile = \"plate.ply\"\n").unwrap();
        assert!(dots.transfer.is_none() && Plan::new(&dots).has_pass(Pass::Rays));
        assert!(!Plan::of_marks(&dots).needs(Quantity::Mesh));
        let without = Plan::new(&scene("").unwrap());
        assert!(!without.needs(Quantity::Mesh));
    }

    #[test]
    fn faults_of_a_mesh_are_told() {
        let fault = |rest: &str| scene(&format!("[[mesh]]\n{rest}")).unwrap_err();
        assert!(fault("color = \"red\"\n").starts_with("mesh[0].file is missing\n"));
        let file = "file = \"a.ply\"\n";
        let text = fault(&format!("{file}color = \"#ff000080\"\n"));
        assert!(text.starts_with("the colour of a mesh has an opacity, and meshes are opaque\n"), "{text}");
        let text = fault(&format!("{file}matrix = [[1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n"));
        assert!(text.starts_with("the motion of the mesh is singular"), "{text}");
        let text = fault(&format!(
            "{file}move = [0, 0, 1]\nmatrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n"
        ));
        assert!(text.starts_with("a mesh has both matrix and move\n"), "{text}");
    }
}

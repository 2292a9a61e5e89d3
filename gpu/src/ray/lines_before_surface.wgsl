// Lines beyond an iso-surface or a mesh are not seen ([HATCH-14] d).
// Glue: Ends of rays.

fn end_lines_at_surface(ray: Ray) {
    while (next_line < end_line && !(fragments[end_line - 1].t < hit)) {
        end_line--;
    }
}

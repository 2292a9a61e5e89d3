// The angle between the lines that normals span: one that was flipped towards the eye has not turned ([STF-5]).

fn turn_cosine(cosine: real) -> real {
    return abs(cosine);
}

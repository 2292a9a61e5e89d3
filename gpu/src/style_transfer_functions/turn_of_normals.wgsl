// The angle between normals ([STF-5]).

fn turn_cosine(cosine: real) -> real {
    return cosine;
}

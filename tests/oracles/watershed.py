"""Basins of small reliefs by scikit-image's watershed, an independent priority flood by (value, insertion order).

scipy.ndimage.watershed_ift is no oracle for it: it floods over differences of neighbours, and its neighbours go on from the
end of a row to the next row.

    pip install numpy scikit-image
    python3 watershed.py > watershed.json
"""

import json

import numpy as np
from skimage.segmentation import watershed

rng = np.random.default_rng(2005)
cases = []
for dims, values in [((7, 6, 5), None), ((9, 8, 7), None), ((16, 3, 5), None), ((7, 6, 5), 6), ((9, 8, 7), 20), ((1, 12, 9), 4)]:
    count = int(np.prod(dims))
    # Without equal values, or with so many different ones.
    relief = rng.permutation(count) if values is None else rng.integers(0, values, count)
    walls = np.zeros(count, bool) if len(cases) % 2 == 0 else rng.random(count) < 0.2
    # Markers of different heights: scikit-image does not keep the order of equal ones.
    seeds = np.zeros(4, int)
    while len(np.unique(relief[seeds])) < 4:
        seeds = np.sort(rng.choice(np.flatnonzero(~walls), 4, replace=False))
    markers = np.zeros(count, np.int32)
    markers[seeds] = np.arange(1, 5)
    # x is fastest: the last axis here.
    shape = dims[::-1]
    basins = watershed(relief.reshape(shape), markers.reshape(shape), connectivity=1, mask=~walls.reshape(shape))
    cases.append({
        "dims": dims,
        "relief": relief.tolist(),
        "walls": np.flatnonzero(walls).tolist(),
        "markers": seeds.tolist(),
        "basins": basins.ravel().tolist(),
    })
print("[\n" + ",\n".join(json.dumps(case, separators=(",", ":")) for case in cases) + "\n]")

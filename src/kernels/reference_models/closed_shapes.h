#pragma once
#include "model/triangle_soup.h"

namespace strataflow {

/// Shapes without a map, sealed, sharing points, one patch per entity; `edge_m` is the length of their edges, metres.

/// Three spheres about one centre, of radius 70, 90 and 100 m: a core, a shell of 20 m and one of 10 m (pellerin2014
/// §4.1 X15). Entities Inner, Middle (horizons) and Outer (boundary), each a divided icosahedron.
TriangleSoup nested_spheres(double edge_m);

/// One smooth closed surface, a ball of 100 m with dents and bulges (pellerin2014 §4.1 X16). Entity Skin.
TriangleSoup smooth_closed_surface(double edge_m);

/// A ring about the z axis: a circle of radius 30 m led around one of radius 70 m. Entity Skin.
TriangleSoup torus(double edge_m);

/// A plate of 1000 × 800 × 20 m (pellerin2014 §4.1 X11). Entities Top, Bottom, North, South, East, West.
TriangleSoup slab(double edge_m);

/// A plate of 1000 × 800 m, 60 m thick in the west, closing to a line in the east (pellerin2014 §4.1 X11). Entities
/// Top, Bottom, North, South, West.
TriangleSoup wedge(double edge_m);

}  // namespace strataflow

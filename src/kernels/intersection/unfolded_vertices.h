#pragma once
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// Per point: 1 when the triangles around it surely meet each other in the point and its edges only, decided exactly.
/// So it is when they form one fan, open or closed, in which consecutive ones share an edge and run around it alike,
/// and when along some axis all are seen from the same side, turning around the point once at most: then no two of
/// them cover one place of the view except on a shared edge. Almost every vertex of a surface passes, which spares the
/// test of its pairs of neighbours. 0 says nothing. Points are welded.
std::vector<char> find_unfolded_vertices(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles);

}  // namespace strataflow

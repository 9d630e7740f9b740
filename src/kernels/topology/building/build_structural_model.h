#pragma once
#include "base/result.h"
#include "model/built_model.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Builds the boundary representation of a set of conforming triangulated surfaces from geometry alone
/// (pellerin2014 §2.1, euler1999 §2.2): bit-identical points are welded, surfaces split and oriented, lines and
/// corners found (the minimal ones), sides sorted radially and linked into frontiers and regions with exact
/// predicates. What a file says about its own topology (borders, stones, regions, orientation) only names regions and
/// layers, and is compared with the result.
/// Identical triangles of different entities become one, on a surface that names all of them (`coincident_surfaces`).
/// Never stops at a flaw: triangles with a repeated vertex and repeated triangles of one entity are dropped and
/// reported, the rest is judged by check_validity. Fails with invalid_input when there is no triangle at all, with
/// unsupported when there are more than 32-bit indices can count.
Result<BuiltModel> build_structural_model(const TriangleSoup& soup);

}  // namespace strataflow

#pragma once
#include "base/result.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// The plan of a classic pillar grid (coudert2024 S7): a smooth field for I and one for J, each constant on its lines
/// (assign_pillar_lines), by one linear least-squares solve each; cut at the values of the lines, and so often between
/// them that edges come near `problem.edge_length_m`. Traces become chains of edges, up to the next pillar where they
/// die; no point inside is singular. Quads go I by I, then J. Curves that are no faults are not followed. Fails with
/// what assign_pillar_lines fails with, and with unsupported where cells would turn over, naming the faults nearby.
Result<QuadMesh> pillar_plan(const FeatureMesh& problem);

}  // namespace strataflow

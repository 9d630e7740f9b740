#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/scars/erase_nodes.h"
#include "kernels/scars/pair_borders.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// What is known about a cut that is to be undone. Everything may be empty.
struct ScarMarks {
  std::vector<EdgePlace> split_edges;  ///< the split lines to heal; empty: wherever border edges of an entity coincide
  std::vector<char> inserted_by_cut;   ///< per point; empty: every node of a healed line counts as inserted
  std::vector<std::array<std::uint32_t, 2>> original_edge;  ///< per point: ends of the edge it was put on, or no_index
};

struct RemoveScarsOptions {
  ErasureOptions erasure;
  bool keep_original_nodes = true;  ///< nodes on the line that the cut did not insert stay
};

struct ScarReport {
  std::uint64_t sewn_edges = 0;
  std::vector<RefusedLip> refused_lips;  ///< half-edges of the input
  ErasureReport erasure;                 ///< nodes are points of the input
};

struct HealedSoup {
  TriangleSoup soup;
  std::vector<std::uint32_t> source;  ///< per point: the point of the input it is
  ScarReport report;
};

/// Undoes the splitting of surfaces along lines (euler1999 §2.5): sews lips that lie in about one plane, then erases
/// the nodes of the seams, and, where `inserted_by_cut` is given without `split_edges`, every inserted node inside its
/// patch. Never deletes a node that is on a border, or whose position other triangles use. Points that nothing uses
/// any more go; records about them too.
/// Fails with invalid_input on triangles with a repeated point or marks of the wrong length.
Result<HealedSoup> remove_scars(const TriangleSoup& soup, const ScarMarks& marks = {},
                                const RemoveScarsOptions& options = {});

}  // namespace strataflow

#include "kernels/adapters/tetgen/call_tetgen.h"

#include <tetgen.h>

#include <new>

namespace strataflow {

namespace {

constexpr std::int32_t out_of_memory = 1, bad_input = 10;

/// Fills `input` with arrays that its destructor frees.
void fill(tetgenio& input, const TetgenRequest& request) {
  input.numberofpoints = static_cast<int>(request.points.size());
  input.pointlist = new REAL[3 * request.points.size()];
  for (std::size_t i = 0; i < request.points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      input.pointlist[3 * i + static_cast<std::size_t>(axis)] = request.points[i][axis];
  input.numberoffacets = static_cast<int>(request.facets.size());
  input.facetlist = new tetgenio::facet[request.facets.size()];
  input.facetmarkerlist = new int[request.facets.size()];
  for (std::size_t i = 0; i < request.facets.size(); ++i) {
    tetgenio::facet& facet = input.facetlist[i];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist->numberofvertices = 3;
    facet.polygonlist->vertexlist = new int[3];
    for (int k = 0; k < 3; ++k)
      facet.polygonlist->vertexlist[k] = static_cast<int>(request.facets[i][static_cast<std::size_t>(k)]);
    input.facetmarkerlist[i] = static_cast<int>(i) + 1;
  }
}

TetgenResponse copied(const tetgenio& output) {
  TetgenResponse response;
  response.points.resize(static_cast<std::size_t>(output.numberofpoints));
  for (std::size_t i = 0; i < response.points.size(); ++i)
    response.points[i] = {output.pointlist[3 * i], output.pointlist[3 * i + 1], output.pointlist[3 * i + 2]};
  response.tets.resize(static_cast<std::size_t>(output.numberoftetrahedra));
  for (std::size_t i = 0; i < response.tets.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      response.tets[i][k] = static_cast<std::uint32_t>(output.tetrahedronlist[4 * i + k]);
  if (output.trifacemarkerlist == nullptr) return response;
  for (std::size_t i = 0; i < static_cast<std::size_t>(output.numberoftrifaces); ++i) {
    if (output.trifacemarkerlist[i] <= 0) continue;
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = static_cast<std::uint32_t>(output.trifacelist[3 * i + k]);
    response.subfaces.push_back(triangle);
    response.subface_facet.push_back(static_cast<std::uint32_t>(output.trifacemarkerlist[i] - 1));
  }
  return response;
}

}  // namespace

TetgenResponse call_tetgen(const TetgenRequest& request) {
  TetgenResponse response;
  try {
    tetgenbehavior behavior;
    std::string switches = request.switches;
    if (!behavior.parse_commandline(switches.data())) {
      response.error = bad_input;
      return response;
    }
    tetgenio input, output;
    fill(input, request);
    tetrahedralize(&behavior, &input, &output);
    return copied(output);
  } catch (int error) {
    response.error = error;
  } catch (const std::bad_alloc&) {
    response.error = out_of_memory;
  }
  return response;
}

}  // namespace strataflow

// Parts of a GuardedMesh as meshes of their own, to be worked on at the same time. A step in a part touches triangles
// strictly inside its block of space and looks at what its new triangles' boxes overlap, which is in that block, too:
// in the part itself or among the surroundings, which stay what they are. So steps in one part never see those in
// another, and what the guards found true of each part is true of the whole.
#include <algorithm>

#include "kernels/remeshing/guarded/guarded_mesh.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

constexpr std::size_t box_grain = 2048;
/// A mesh of which more than one in so many triangles are dead or new is numbered anew.
constexpr std::uint32_t renumbered_share = 16;

}  // namespace

bool GuardedMesh::leaves_block() {
  const FloatBox& block = origin_->box;
  for (const Added& added : added_)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(added.box.low[axis] > block.low[axis] && added.box.high[axis] < block.high[axis])) {
        ++steps_;  // where the sides of blocks are elsewhere the step is to be tried again
        for (const Removed& r : removed_) changed_at_[r.triangle] = steps_;
        return true;
      }
  return false;
}

GuardedMesh::BlockCut GuardedMesh::cut_into_blocks(const BlockOptions& options) const {
  std::vector<FloatBox> boxes(triangle_count());
  parallel_ranges(boxes.size(), box_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) boxes[t] = box_of(triangles_[t]);
  });
  std::vector<std::uint32_t> alive;
  for (std::uint32_t t = 0; t < triangle_count(); ++t)
    if (is_alive(t)) alive.push_back(t);
  BlockCut cut{cut_space(boxes, std::move(alive), options.most_triangles, options.share), {}, {}, {}};
  cut.block_of.assign(points_.size(), no_index);
  cut.number.assign(points_.size(), no_index);
  cut.vertices.resize(cut.blocks.size());
  for (std::uint32_t b = 0; b < cut.blocks.size(); ++b)
    for (const std::uint32_t t : cut.blocks[b].inside)
      for (const std::uint32_t v : triangles_[t]) cut.block_of[v] = b;
  for (const SpaceBlock& block : cut.blocks)
    for (const std::uint32_t t : block.across)
      for (const std::uint32_t v : triangles_[t]) cut.block_of[v] = no_index;
  for (std::uint32_t v = 0; v < points_.size(); ++v)
    if (const std::uint32_t b = cut.block_of[v]; b != no_index) {
      cut.number[v] = static_cast<std::uint32_t>(cut.vertices[b].size());
      cut.vertices[b].push_back(v);
    }
  return cut;
}

GuardedMesh::GuardedMesh(const GuardedMesh& whole, const BlockCut& cut, std::size_t block)
    : inputs_(whole.inputs_),
      options_(whole.options_),
      cos_turn_(whole.cos_turn_),
      frame_(whole.frame_),
      origin_(Origin{cut.blocks[block].box, cut.vertices[block], cut.blocks[block].inside, {}}),
      steps_(whole.steps_),
      line_edges_(whole.line_edges_),
      is_stopped_(whole.is_stopped_) {
  Origin& origin = *origin_;
  origin.own_vertices = static_cast<std::uint32_t>(origin.vertices.size());
  origin.own_triangles = static_cast<std::uint32_t>(origin.triangles.size());
  origin.triangles.insert(origin.triangles.end(), cut.blocks[block].across.begin(), cut.blocks[block].across.end());
  std::vector<std::uint32_t> around;
  for (const std::uint32_t t : origin.triangles)
    for (const std::uint32_t v : whole.triangles_[t])
      if (cut.block_of[v] != block) around.push_back(v);
  around = sorted_unique(std::move(around));
  origin.vertices.insert(origin.vertices.end(), around.begin(), around.end());
  const auto number = [&](std::uint32_t v) {  // no_index for what is not here
    if (v == no_index) return no_index;
    if (cut.block_of[v] == block) return cut.number[v];
    const auto found = std::lower_bound(around.begin(), around.end(), v);
    return found != around.end() && *found == v
               ? origin.own_vertices + static_cast<std::uint32_t>(found - around.begin())
               : no_index;
  };
  for (const std::uint32_t v : origin.vertices) {
    points_.push_back(whole.points_[v]);
    kind_.push_back(whole.kind_[v]);
    is_fixed_.push_back(whole.is_fixed_[v] != 0 || cut.block_of[v] != block);
    owner_.push_back(whole.owner_[v]);
    arc_m_.push_back(whole.arc_m_[v]);
    size_m_.push_back(whole.size_m_[v]);
    before_.push_back(number(whole.before_[v]));
    after_.push_back(number(whole.after_[v]));
    place_.push_back(whole.place_[v]);
  }
  for (const std::uint32_t t : origin.triangles) {
    const Triangle& c = whole.triangles_[t];
    triangles_.push_back({number(c[0]), number(c[1]), number(c[2])});
    surface_of_.push_back(whole.surface_of_[t]);
    source_.push_back(whole.source_[t]);
    changed_at_.push_back(whole.changed_at_[t]);
    std::uint32_t last = no_index;
    first_sample_.push_back(no_index);
    if (is_held(static_cast<std::uint32_t>(first_sample_.size() - 1))) continue;
    for (std::uint32_t s = whole.first_sample_[t]; s != no_index; s = whole.next_sample_[s]) {
      const auto here = static_cast<std::uint32_t>(samples_.size());
      (last == no_index ? first_sample_.back() : next_sample_[last]) = here;
      last = here;
      samples_.push_back(whole.samples_[s]);
      next_sample_.push_back(no_index);
      origin.samples.push_back(s);
    }
  }
  removed_mark_.assign(triangles_.size(), 0);
  seen_mark_.assign(triangles_.size(), 0);
  vertex_mark_.assign(points_.size(), 0);
  link_all();
}

void GuardedMesh::give_back(GuardedMesh& whole, std::uint32_t first_vertex, std::uint32_t first_triangle) const {
  const Origin& origin = *origin_;
  const auto vertex = [&](std::uint32_t v) { return origin.number_outside(v, first_vertex); };
  for (std::uint32_t v = 0; v < vertex_count(); ++v) {
    const std::uint32_t there = vertex(v);
    if (v >= origin.own_vertices && v < origin.vertices.size()) continue;
    whole.points_[there] = points_[v];
    whole.kind_[there] = kind_[v];
    whole.is_fixed_[there] = is_fixed_[v];
    whole.owner_[there] = owner_[v];
    whole.arc_m_[there] = arc_m_[v];
    whole.size_m_[there] = size_m_[v];
    whole.before_[there] = vertex(before_[v]);
    whole.after_[there] = vertex(after_[v]);
    whole.place_[there] = place_[v];
  }
  for (std::uint32_t t = 0; t < triangle_count(); ++t) {
    if (is_held(t)) continue;
    const std::uint32_t there = t < origin.triangles.size()
                                    ? origin.triangles[t]
                                    : first_triangle + t - static_cast<std::uint32_t>(origin.triangles.size());
    whole.surface_of_[there] = surface_of_[t];
    if (!is_alive(t)) continue;
    const Triangle& c = triangles_[t];
    whole.triangles_[there] = {vertex(c[0]), vertex(c[1]), vertex(c[2])};
    whole.source_[there] = source_[t];
    whole.changed_at_[there] = changed_at_[t];
    std::uint32_t* link = &whole.first_sample_[there];
    for (std::uint32_t s = first_sample_[t]; s != no_index; s = next_sample_[s]) {
      *link = origin.samples[s];
      link = &whole.next_sample_[origin.samples[s]];
    }
    *link = no_index;
  }
}

void GuardedMesh::take_back(const BlockCut& cut, const std::vector<std::optional<GuardedMesh>>& parts) {
  const std::vector<std::uint32_t> line_edges = line_edges_;
  std::vector<std::uint32_t> first_vertex, first_triangle;
  const std::uint32_t old_triangles = triangle_count();
  auto vertices = static_cast<std::uint32_t>(points_.size()), triangles = old_triangles;
  for (const std::optional<GuardedMesh>& part : parts) {
    const Origin& origin = *part->origin_;
    first_vertex.push_back(vertices);
    first_triangle.push_back(triangles);
    vertices += part->vertex_count() - static_cast<std::uint32_t>(origin.vertices.size());
    triangles += part->triangle_count() - static_cast<std::uint32_t>(origin.triangles.size());
    steps_ = std::max(steps_, part->steps_);
    is_stopped_ |= part->is_stopped_;
    for (std::size_t k = 0; k < verdict_count; ++k) verdicts_[k] += part->verdicts_[k];
    for (std::size_t i = 0; i < line_edges.size(); ++i) line_edges_[i] += part->line_edges_[i] - line_edges[i];
  }
  points_.resize(vertices);
  kind_.resize(vertices);
  is_fixed_.resize(vertices);
  owner_.resize(vertices);
  arc_m_.resize(vertices);
  size_m_.resize(vertices);
  before_.resize(vertices);
  after_.resize(vertices);
  place_.resize(vertices);
  triangles_.resize(triangles);
  surface_of_.resize(triangles);
  source_.resize(triangles);
  first_sample_.resize(triangles);
  changed_at_.resize(triangles);
  parallel_ranges(parts.size(), 1,
                  [&](std::size_t b, std::size_t) { parts[b]->give_back(*this, first_vertex[b], first_triangle[b]); });
  // The neighbours of line vertices at the sides: what one part changed the others still know as it was.
  const std::vector<std::uint32_t> before = before_, after = after_;
  for (std::size_t b = 0; b < parts.size(); ++b) {
    const GuardedMesh& part = *parts[b];
    const Origin& origin = *part.origin_;
    const auto link = [&](std::uint32_t& there, std::uint32_t was, std::uint32_t v) {
      const std::uint32_t now = origin.number_outside(v, first_vertex[b]);
      if (v != no_index && now != was) there = now;
    };
    for (std::uint32_t v = origin.own_vertices; v < origin.vertices.size(); ++v) {
      const std::uint32_t w = origin.vertices[v];
      link(before_[w], before[w], part.before_[v]);
      link(after_[w], after[w], part.after_[v]);
    }
  }
  ++steps_;
  for (const SpaceBlock& block : cut.blocks)
    for (const std::uint32_t t : block.across) changed_at_[t] = steps_;
  free_.clear();
  for (std::uint32_t t = triangles; t-- > 0;)
    if (!is_alive(t)) free_.push_back(t);
  removed_mark_.resize(triangles);
  seen_mark_.resize(triangles);
  vertex_mark_.resize(vertices);
  is_grid_filled_ = false;
  link_all();
  if (free_.size() + (triangles - old_triangles) > triangles / renumbered_share) renumber();
}

}  // namespace strataflow

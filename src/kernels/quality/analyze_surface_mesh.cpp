#include "kernels/quality/analyze_surface_mesh.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "kernels/topology/building/edge_table.h"

namespace strataflow {

namespace {

/// Where several features coincide, all of them: "F1=H2".
std::string name_of(const StructuralModel& model, const Surface& surface) {
  std::vector<std::string> names;
  for (const std::uint32_t entity : surface.all_entities) names.push_back(model.entities[entity].name);
  std::sort(names.begin(), names.end());
  std::string name;
  for (const std::string& one : names) name += (name.empty() ? "" : "=") + one;
  return name;
}

}  // namespace

SurfaceMeshReport analyze_surface_mesh(const StructuralModel& model) {
  SurfaceMeshReport report;
  report.corners = model.corners.size();
  report.lines = model.lines.size();
  report.surfaces = model.surfaces.size();
  report.regions = model.regions.size();
  report.vertices = model.points.size();
  report.diagonal_m = model.box.diagonal_m();
  report.triangles = analyze_triangles(model.points, model.triangles);
  const EdgeTable table = build_edge_table(model.points.size(), model.triangles);
  for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
    const std::size_t valence = table.around(e).size();
    if (valence >= report.edge_valences.size()) report.edge_valences.resize(valence + 1, 0);
    ++report.edge_valences[valence];
  }

  std::vector<std::string> surface_names;
  for (const Surface& surface : model.surfaces) surface_names.push_back(name_of(model, surface));
  std::map<std::pair<std::uint32_t, std::string>, Contact> contacts;
  for (const Line& line : model.lines) {
    std::vector<std::string> around;
    for (const std::uint32_t surface : line.surfaces) around.push_back(surface_names[surface]);
    std::sort(around.begin(), around.end());
    std::string name;
    for (const std::string& one : around) name += (name.empty() ? "" : " | ") + one;
    const auto valence = static_cast<std::uint32_t>(line.surfaces.size());
    Contact& contact = contacts[{valence, name}];
    contact.name = name;
    contact.valence = valence;
    ++contact.lines;
    const std::size_t count = line.vertices.size(), edges = line.is_closed() ? count : count - 1;
    contact.edges += edges;
    for (std::size_t i = 0; i < edges; ++i)
      contact.length_m += length(model.points[line.vertices[(i + 1) % count]] - model.points[line.vertices[i]]);
  }
  for (auto& [key, contact] : contacts) report.contacts.push_back(std::move(contact));
  return report;
}

std::vector<Change> contact_changes(const SurfaceMeshReport& before, const SurfaceMeshReport& after) {
  const auto key = [](const Contact& contact) { return std::tie(contact.valence, contact.name); };
  const auto told = [](const Contact& contact) {
    return contact.name + (contact.valence == 1 ? " (free border)" : "");
  };
  std::vector<Change> changes;
  auto a = before.contacts.begin();
  auto b = after.contacts.begin();
  while (a != before.contacts.end() || b != after.contacts.end()) {
    if (b == after.contacts.end() || (a != before.contacts.end() && key(*a) < key(*b))) {
      changes.push_back({"contact_lost", told(*a), std::to_string(a->lines) + " lines before"});
      ++a;
    } else if (a == before.contacts.end() || key(*b) < key(*a)) {
      changes.push_back({"contact_created", told(*b), std::to_string(b->lines) + " lines after"});
      ++b;
    } else {
      if (a->lines != b->lines)
        changes.push_back({"contact_lines_changed", told(*a),
                           std::to_string(a->lines) + " lines before, " + std::to_string(b->lines) + " after"});
      ++a;
      ++b;
    }
  }
  return changes;
}

}  // namespace strataflow

#include "io/simulator/write_grdecl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "io/simulator/grdecl_text.h"
#include "model/box3.h"

namespace strataflow {

namespace {
/// A box of one cell in I and J, and of layers, on whose one side a fault lies.
struct FaultRecord {
  std::uint32_t fault, face, i, j, first_k, last_k;
};

std::vector<FaultRecord> fault_records(const SimulationGrid& grid) {
  std::vector<FaultRecord> records;
  for (const FaultFace& face : grid.fault_faces) {
    const auto [i, j, k] = grid.grid.indices(face.cell);
    records.push_back({face.fault, static_cast<std::uint32_t>(face.face), i, j, k, k});
  }
  const auto column = [](const FaultRecord& r) { return std::tuple{r.fault, r.face, r.j, r.i}; };
  std::sort(records.begin(), records.end(), [&](const FaultRecord& a, const FaultRecord& b) {
    return std::tuple{column(a), a.first_k} < std::tuple{column(b), b.first_k};
  });
  std::vector<FaultRecord> merged;
  for (const FaultRecord& record : records) {
    if (!merged.empty() && column(merged.back()) == column(record) && merged.back().last_k + 1 == record.first_k)
      merged.back().last_k = record.last_k;
    else
      merged.push_back(record);
  }
  return merged;
}

std::vector<std::string> fault_names(const SimulationGrid& grid) {
  std::vector<std::string> names;
  for (const FaultTransmissibility& fault : grid.faults) names.push_back(fault.fault);
  return simulator_names(names, 'F');
}

void append_words(std::string& text, std::initializer_list<std::uint64_t> numbers) {
  for (const std::uint64_t number : numbers) {
    text += ' ';
    append_number(text, number);
  }
}

/// Digits after the point that make 1e-9 of the size of what is written.
int decimals_for(double size) {
  return size > 0 ? std::clamp(static_cast<int>(std::ceil(9 - std::log10(size))), 0, 15) : 6;
}

template <class Value>
void append_property(std::string& text, const char* keyword, const SimulationGrid& grid, Value&& value) {
  GrdeclValues values(text, keyword);
  for (const std::int32_t region : grid.cell_region)
    values.add_number(region < 0 ? 0.0 : value(grid.rock[static_cast<std::size_t>(region)]));
}
}  // namespace

std::vector<std::string> simulator_names(const std::vector<std::string>& names, char first_letter) {
  std::vector<std::string> simple;
  std::set<std::string> taken;
  for (std::size_t n = 0; n < names.size(); ++n) {
    std::string name;
    for (const char c : names[n]) {
      const bool is_lower = c >= 'a' && c <= 'z';
      const bool is_plain = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
      name += is_lower ? static_cast<char>(c - 'a' + 'A') : is_plain ? c : '_';
    }
    const bool starts_well = !name.empty() && name[0] >= 'A' && name[0] <= 'Z';
    if (!starts_well || name.size() > 8 || taken.count(name)) {
      std::size_t number = n + 1;
      do name = first_letter + std::to_string(number++);
      while (taken.count(name) || std::find(names.begin(), names.end(), name) != names.end());
    }
    taken.insert(name);
    simple.push_back(name);
  }
  return simple;
}

std::size_t fault_record_count(const SimulationGrid& grid) { return fault_records(grid).size(); }

std::string write_grdecl(const SimulationGrid& simulation) {
  const CornerPointGrid& grid = simulation.grid;
  Box3 box;
  for (const Vec3& point : grid.pillars) box.take(point);
  const int decimals = decimals_for(box.diagonal_m());

  std::string text = "-- corner-point grid, layout " + simulation.report.layout + ", metres, depth down\n";
  text += "SPECGRID\n";
  append_words(text, {grid.size[0], grid.size[1], grid.size[2], 1});
  text += " F /\n\n";
  {
    GrdeclValues values(text, "COORD");
    for (const Vec3& point : grid.pillars) {
      const Vec3 world = point + grid.local_origin;
      values.add_rounded(world.x, decimals);
      values.add_rounded(world.y, decimals);
      values.add_rounded(-world.z, decimals);
    }
  }
  {
    GrdeclValues values(text, "ZCORN");
    for (const double z : grid.corner_z) values.add_rounded(-(z + grid.local_origin.z), decimals);
  }
  {
    GrdeclValues values(text, "ACTNUM");
    for (const std::uint8_t is_active : grid.is_active) values.add_number(int{is_active});
  }
  append_property(text, "PORO", simulation, [](const RegionRock& rock) { return rock.porosity; });
  for (const char* keyword : {"PERMX", "PERMY"})
    append_property(text, keyword, simulation, [](const RegionRock& rock) { return rock.permeability_lateral_md; });
  append_property(text, "PERMZ", simulation, [](const RegionRock& rock) { return rock.permeability_vertical_md; });

  const auto names = fault_names(simulation);
  const auto records = fault_records(simulation);
  if (!records.empty()) {
    text += "-- sides of cells on faults, between neighbours by index\nFAULTS\n";
    for (const FaultRecord& r : records) {
      text += " '" + names[r.fault] + "'";
      append_words(text, {r.i + 1, r.i + 1, r.j + 1, r.j + 1, r.first_k + 1, r.last_k + 1});
      text += r.face == static_cast<std::uint32_t>(CellFace::i_high)   ? " 'X' /\n"
              : r.face == static_cast<std::uint32_t>(CellFace::j_high) ? " 'Y' /\n"
              : r.face == static_cast<std::uint32_t>(CellFace::i_low)  ? " 'X-' /\n"
                                                                       : " 'Y-' /\n";
    }
    text += "/\n\nMULTFLT\n";
    for (std::size_t f = 0; f < names.size(); ++f) {
      if (std::none_of(records.begin(), records.end(), [&](const FaultRecord& r) { return r.fault == f; })) continue;
      text += " '" + names[f] + "' ";
      append_number(text, simulation.faults[f].multiplier);
      text += " / -- " + simulation.faults[f].fault + "\n";
    }
    text += "/\n\n";
  }
  if (simulation.report.dead_cells > 0)
    text += "-- cells without height do not part those above and below\nPINCH\n/\n\n";
  if (!simulation.connections.empty()) {
    text += "-- cells that touch without being neighbours by index";
    if (simulation.report.fault_connections > 0) text += "; multipliers of faults are in the transmissibilities";
    text += "\nNNC\n";
    for (const CellConnection& c : simulation.connections) {
      const auto p = grid.indices(c.cell_0), q = grid.indices(c.cell_1);
      append_words(text, {p[0] + 1, p[1] + 1, p[2] + 1, q[0] + 1, q[1] + 1, q[2] + 1});
      text += ' ';
      append_number(text, c.transmissibility);
      text += " /\n";
    }
    text += "/\n";
  }
  return text;
}

std::string write_region_numbers(const SimulationGrid& grid) {
  std::string text;
  for (std::size_t r = 0; r < grid.rock.size(); ++r)
    text +=
        "-- " + std::to_string(r + 1) + ": " + (grid.rock[r].region.empty() ? "region" : grid.rock[r].region) + "\n";
  for (const char* keyword : {"FIPNUM", "SATNUM"}) {
    GrdeclValues values(text, keyword);
    for (const std::int32_t region : grid.cell_region) values.add_number(std::max(region, 0) + 1);
  }
  return text;
}

}  // namespace strataflow

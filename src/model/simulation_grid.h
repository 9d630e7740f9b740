#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/id.h"
#include "model/corner_point_grid.h"

namespace strataflow {

/// Rock of one region. Lateral means through the sides of cells, vertical through their tops and bottoms.
struct RegionRock {
  std::string region;
  double porosity = 0.2;
  double permeability_lateral_md = 100;
  double permeability_vertical_md = 10;
  template <class A>
  void archive(A& a) {
    a(region, porosity, permeability_lateral_md, permeability_vertical_md);
  }
};

/// What crosses a fault, relative to what would without it.
struct FaultTransmissibility {
  std::string fault;
  double multiplier = 1;
  template <class A>
  void archive(A& a) {
    a(fault, multiplier);
  }
};

/// Two cells that touch and are no neighbours by index: a non-neighbour connection (NNC).
struct CellConnection {
  std::uint32_t cell_0 = 0, cell_1 = 0;  ///< of the corner-point grid, cell_0 < cell_1
  std::uint32_t fault = no_index;        ///< index into SimulationGrid::faults when they touch across one
  std::uint32_t is_vertical = 0;         ///< 1: one above the other
  double area_m2 = 0;                    ///< where they touch
  double transmissibility = 0;           ///< cP·rm³/(day·bar), the fault's multiplier included
  static constexpr bool is_flat = true;
};

enum class CellFace : std::uint32_t { i_low, i_high, j_low, j_high };

/// A side of a cell that lies on a fault and faces neighbours by index.
struct FaultFace {
  std::uint32_t fault = 0, cell = 0;
  CellFace face = CellFace::i_high;
  static constexpr bool is_flat = true;
};

/// What became of the columns of a plan mesh on their way into an index space.
struct SimulationGridReport {
  std::string layout;               ///< native, blocks, unstructured
  std::string reason;               ///< why it is not native
  std::uint32_t blocks = 0;         ///< rectangles of columns (and layers) that share pillars
  std::uint32_t split_columns = 0;  ///< columns in several pieces, for straight pillars or fewer places
  std::uint32_t active_cells = 0;
  std::uint32_t dead_cells = 0;
  double occupancy_ratio = 0;             ///< columns with cells in all columns of the index box
  double largest_deviation_m = 0;         ///< of a corner from its straight pillar
  double largest_volume_error_ratio = 0;  ///< of a cell, relative to its own volume
  double volume_error_ratio = 0;          ///< of all together
  std::uint64_t index_contacts = 0;       ///< touching pairs that are neighbours by index
  std::uint64_t lateral_connections = 0, vertical_connections = 0, fault_connections = 0;  ///< NNCs, each in one
  template <class A>
  void archive(A& a) {
    a(layout, reason, blocks, split_columns, active_cells, dead_cells, occupancy_ratio, largest_deviation_m,
      largest_volume_error_ratio, volume_error_ratio, index_contacts, lateral_connections, vertical_connections,
      fault_connections);
  }
};

/// A corner-point grid with all a flow simulator needs to know of it (coudert2024 S22).
struct SimulationGrid {
  CornerPointGrid grid;
  std::vector<std::uint32_t> hex_of_cell;  ///< per cell of the grid: the hexahedron it is, or no_index
  std::vector<std::int32_t> cell_region;   ///< per cell of the grid: index into `rock`, −1 where there is no cell
  std::vector<RegionRock> rock;
  std::vector<FaultTransmissibility> faults;
  std::vector<FaultFace> fault_faces;       ///< ascending by fault, face, cell
  std::vector<CellConnection> connections;  ///< ascending by cell_0, cell_1
  SimulationGridReport report;
  template <class A>
  void archive(A& a) {
    a(grid, hex_of_cell, cell_region, rock, faults, fault_faces, connections, report);
  }
};

/// A well of a deck: where it is in the grid and what it does.
struct SimulationWell {
  std::string name;
  bool is_injector = false;
  double rate_t_per_year = 0;  ///< injected; 0: as much as the pressure lets
  double pressure_bar = 0;     ///< in the well at its top cell: most for an injector, least for a producer
  std::vector<std::array<std::uint32_t, 3>> cells;  ///< I, J, K of each perforated cell, from the top
  template <class A>
  void archive(A& a) {
    a(name, is_injector, rate_t_per_year, pressure_bar, cells);
  }
};

}  // namespace strataflow

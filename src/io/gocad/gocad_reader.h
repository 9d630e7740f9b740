#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/result.h"
#include "io/gocad/gocad_header.h"
#include "io/gocad/gocad_vertices.h"
#include "io/text/text_scanner.h"
#include "model/input_data.h"

namespace strataflow {

/// One pass over a GOCAD text. A method that returns false has left the reason in `failure_`. The methods are spread
/// over read_gocad.cpp (the file and the records all objects share) and one source per kind of object.
class GocadReader {
 public:
  GocadReader(std::string_view text, const std::string& file_name)
      : scanner_(text, file_name),
        file_name_(file_name),
        file_stem_(file_name),
        text_size_(text.size()),
        surface_values_(soup().properties, text.size()) {
    file_stem_.remove_prefix(file_stem_.find_last_of('/') + 1);  // npos + 1 is 0
    for (const std::string_view ending : {".gz", "."}) {
      const std::size_t dot = file_stem_.rfind(ending);
      if (dot != std::string_view::npos && dot > 0) file_stem_ = file_stem_.substr(0, dot);
    }
  }

  Result<InputData> read() {
    if (!read_objects()) return *failure_;
    return std::move(data_);
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffu;

  TriangleSoup& soup() { return data_.surfaces; }

  // ---- failures and warnings
  bool fail(Failure failure) {
    failure_ = std::move(failure);
    return false;
  }
  bool malformed(const std::string& what, const std::string& remedy) { return fail(scanner_.malformed(what, remedy)); }
  bool truncated(const std::string& kind) {
    return fail({FailureCode::malformed_file,
                 scanner_.where() + ": the file ends inside " + kind + " '" + shown(header_.name) + "' (no END)",
                 "the file seems truncated: export it again"});
  }
  void warn(const char* warning_kind, std::string what) { data_.warnings.push_back({warning_kind, std::move(what)}); }
  /// A line that is not geometry of the object at hand.
  bool read_other_line(std::string_view word) {
    if (word == "GOCAD")
      return malformed("a new object starts, but '" + shown(header_.name) + "' has no END", "add END before this line");
    const Result<void> done = read_gocad_header_line(scanner_, word, header_, data_.warnings);
    return done ? true : fail(done.failure());
  }

  // ---- objects
  bool read_objects();
  bool read_model();
  bool read_surface();
  bool read_lines();
  bool read_point_set();
  bool read_well();
  bool read_solid();
  bool skip_object(const std::string& kind);
  bool open_group();
  bool finish_file();

  // ---- records
  bool read_position(Vec3& position);
  bool read_vertex(GocadVertexKind kind, std::vector<Vec3>& points, GocadPropertyStore* values,
                   bool atoms_are_copies = false);
  bool read_vertex_reference(std::uint32_t& point);
  bool read_triangle(Triangle& triangle);
  bool read_id_list(std::vector<std::int64_t>& ids);
  bool read_model_surface_row();
  bool read_model_region();
  bool read_model_layer();
  void close_line(std::vector<Vec3>& points, std::vector<std::uint32_t>& vertices,
                  std::vector<std::array<std::uint32_t, 2>>& segments);
  void orient_cells(std::size_t first_cell);

  std::uint32_t entity_named(std::string_view name);
  std::uint32_t open_patch();
  /// The object's name, or the file's without folder and ending when it has none.
  std::string_view object_name() const { return header_.name.empty() ? file_stem_ : std::string_view(header_.name); }

  TextScanner scanner_;
  const std::string& file_name_;
  std::string_view file_stem_;
  std::size_t text_size_;
  InputData data_;
  std::optional<Failure> failure_;
  std::size_t objects_read_ = 0;
  std::vector<std::string> objects_skipped_;
  std::size_t open_groups_ = 0;

  GocadHeader header_;
  GocadVertexIds ids_;
  GocadPropertyStore surface_values_;

  /// A row of the TFACE table: its number, its entity, the line it stands on.
  struct ModelRow {
    std::uint32_t patch;
    std::size_t line;
  };
  bool has_model_ = false;
  bool model_is_depth_ = false;
  std::unordered_map<std::string, std::uint32_t> entity_index_;  // these three are looked up, never iterated
  std::unordered_map<std::int64_t, std::uint32_t> patch_of_row_;
  std::unordered_map<std::int64_t, std::uint32_t> region_of_number_;
  /// The rows of one entity in table order; its TFACEs come in the same order and take one each.
  struct ModelRows {
    std::vector<ModelRow> rows;
    std::size_t taken = 0;
  };
  std::vector<ModelRows> rows_of_entity_;
  std::vector<std::uint8_t> role_is_sure_;  ///< per entity: said by something better than "none"
};

}  // namespace strataflow

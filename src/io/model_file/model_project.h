#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/digest.h"
#include "base/result.h"
#include "io/model_file/model_records.h"

namespace strataflow {

/// A native model file (.sfm) while it is worked on: every object of a StructuralModel is a section with a permanent
/// id, a length and a checksum; objects refer to each other by id (lemelinaire1992 §2.18, rules H1–H8).
///
/// Any subset of the objects can be loaded, in any order; each is loaded once, with the parts it is made of. What is
/// not loaded stays in the file untouched and keeps its links. Ids come from a counter that never goes back: it is
/// written to the old file before anything else, and at opening the largest id seen counts too.
///
/// File: start (magic, format, byte order) · two copies of the counter, each with a checksum · directory (id, kind,
/// length, checksum per section; sorted by id) and its checksum · sections in that order.
class ModelProject {
 public:
  /// A project with nothing in it.
  ModelProject() = default;

  /// Reads the directory of `file`, no section but the root. Fails with unreadable_file, malformed_file, unsupported.
  static Result<ModelProject> open(const std::filesystem::path& file);

  /// Writes the project to `file`: sections that were not loaded are copied, so the same project always gives the same
  /// bytes. Fails with write_failed, also when `file` was opened here and another program has saved it since.
  Result<void> save(const std::filesystem::path& file);

  /// The largest id given so far.
  PermanentId counter() const { return counter_; }
  /// All objects of a kind, loaded or not, ascending.
  std::vector<PermanentId> ids(RecordKind kind) const;

  /// Loads objects with the parts they are made of, recursively: a layer has regions, a region frontiers, a frontier
  /// surfaces, a surface an entity and lines, a line corners, all of them points. Fails with malformed_file, naming the
  /// section and the id, for a damaged section or a reference to an object that is not there.
  Result<void> load(std::span<const PermanentId> wanted);
  Result<void> load_all();

  /// A loaded object; null when it is not loaded, not there, or of another kind.
  template <class Stored>
  const Stored* find(PermanentId id) const {
    const auto section = sections_.find(id);
    return section == sections_.end() || !section->second.record ? nullptr
                                                                 : std::get_if<Stored>(&*section->second.record);
  }

  /// A new object gets the next id. It is part of the model once the root (StoredModel) lists it.
  PermanentId add(Record record);
  /// Saves an object again: its id, and with it every link to it, stays. It must be there and of the same kind.
  void replace(PermanentId id, Record record);
  /// Takes an object out of the model. Its id is never given again; what refers to it cannot be loaded any more.
  void remove(PermanentId id);

  /// The project now holds `model`: objects whose id `ids` knows keep it, those with 0 get one (put into `ids`), all
  /// others are removed. Fails with invalid_input when triangles are not grouped by surface or an index is wrong.
  Result<void> set_model(const StructuralModel& model, ModelIds& ids);

  /// The model made of what is loaded, in the order of the whole; `ids` gets the ids of its objects. Links to objects
  /// that are not loaded are left out (regions: universe). Fails with malformed_file.
  Result<StructuralModel> model(ModelIds* ids = nullptr) const;

  /// The failure of a file that is not as it should be.
  static Failure malformed(std::string what);

 private:
  struct Section {
    RecordKind kind = RecordKind::model;
    std::uint64_t position = 0;  ///< in the file; meaningless once `record` is present
    std::uint64_t bytes = 0;
    Digest checksum;
    std::optional<Record> record;
  };

  const StoredModel* root() const;
  std::string name_of(PermanentId id) const;
  /// The checked bytes of a section in the file.
  Result<std::vector<std::byte>> read_section(PermanentId id, const Section& section) const;
  /// Loads one section, checks its references, and appends the parts it is made of to `parts`.
  Result<void> load_section(PermanentId id, std::vector<PermanentId>& parts);
  /// 0: `id` is free for a new object, which gets the next one.
  void store(PermanentId& id, Record record);

  std::filesystem::path file_;  ///< where sections that are not loaded are; empty for a new project
  Digest directory_checksum_;   ///< of that file when it was opened or saved here
  PermanentId counter_ = 0;
  std::map<PermanentId, Section> sections_;
};

}  // namespace strataflow

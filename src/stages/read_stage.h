#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "base/digest.h"
#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/geology.h"
#include "model/input_data.h"

namespace strataflow {

/// What a job says about one input file.
struct ReadOptions {
  std::optional<std::string> name;  ///< overrides the name of the one thing the file holds
  std::optional<std::string> role;  ///< a word of Role; overrides what the file says its contents are
  bool sticks = false;              ///< the lines are sticks of one fault
  bool traces = false;              ///< of the surfaces, their upper borders are wanted
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(name, OptionField{.name = "name", .description = "Overrides the name the file carries"});
    visit(role, OptionField{.name = "role",
                            .description = "Overrides what the file says its surfaces, lines or points are",
                            .words = role_words()});
    visit(sticks, OptionField{.name = "sticks",
                              .description = "The lines are sticks of one fault: their first points become its trace"});
    visit(traces, OptionField{.name = "traces",
                              .description = "The upper borders of the surfaces are taken in their place, as traces"});
  }
};

/// Makes one trace of sticks and traces of surfaces, gives everything in `data` that role, and the one thing in it (or
/// all its traces) that name. Fails with invalid_options when a name is to be given to several things, or there are no
/// lines or surfaces to make traces of.
Result<void> rename_input(InputData& data, const ReadOptions& options);

/// Reads one input file. Its key holds the file's content and name, not its folder.
struct Read {
  static constexpr std::string_view name = "read";
  static constexpr int version = 2;
  ReadOptions options;
  std::filesystem::path file;  ///< absolute

  Result<Digest> external_digest() const;
  std::string external_identity() const { return file.string(); }
  Result<InputData> operator()(StageContext& context) const;
};

}  // namespace strataflow

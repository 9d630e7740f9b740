#include "batch/diff_runs.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/atomic_file.h"

namespace strataflow {

namespace {

struct StageLine {
  std::string node;
  std::string facts;  ///< stage, version, status, digest
};

Result<std::vector<StageLine>> read_stages(const std::filesystem::path& run) {
  const std::filesystem::path file = run / "report.json";
  const Result<std::string> text = read_file(file);
  if (!text) return Failure{text.failure().code, text.failure().what, "name a run folder: it holds a report.json"};
  const Failure malformed{FailureCode::malformed_file, file.string() + ": not a report of strataflow",
                          "run the job again"};
  const nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains("stages") || !json["stages"].is_array()) return malformed;
  std::vector<StageLine> stages;
  for (const nlohmann::json& stage : json["stages"]) {
    StageLine line;
    for (const char* key : {"node", "stage", "version", "status", "digest"}) {
      if (!stage.is_object() || !stage.contains(key)) return malformed;
      const nlohmann::json& value = stage[key];
      const std::string word = value.is_string() ? value.get<std::string>() : value.dump();
      if (line.node.empty())
        line.node = word;
      else
        line.facts += (line.facts.empty() ? "" : ", ") + std::string(key) + " " + word;
    }
    stages.push_back(std::move(line));
  }
  return stages;
}

}  // namespace

Result<std::optional<std::string>> first_difference(const std::filesystem::path& run_a,
                                                    const std::filesystem::path& run_b) {
  const Result<std::vector<StageLine>> a = read_stages(run_a);
  if (!a) return a.failure();
  const Result<std::vector<StageLine>> b = read_stages(run_b);
  if (!b) return b.failure();
  for (std::size_t i = 0; i < std::max(a->size(), b->size()); ++i) {
    if (i >= a->size()) return std::optional("stage " + (*b)[i].node + " is only in " + run_b.string());
    if (i >= b->size()) return std::optional("stage " + (*a)[i].node + " is only in " + run_a.string());
    const StageLine &in_a = (*a)[i], &in_b = (*b)[i];
    if (in_a.node != in_b.node)
      return std::optional("stage " + in_a.node + " in one run is " + in_b.node + " in the other");
    if (in_a.facts != in_b.facts)
      return std::optional("first difference: " + in_a.node + "\n  " + run_a.string() + ": " + in_a.facts + "\n  " +
                           run_b.string() + ": " + in_b.facts);
  }
  return std::optional<std::string>();
}

}  // namespace strataflow

#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/cancellation.h"
#include "base/failure.h"

namespace strataflow {

// The commands of the program, one file each. Every command returns the exit code (interface.md §1): 0 all well,
// 1 the work failed or the thing is invalid, 2 wrong usage or job file, 70 our bug.

struct RunArguments {
  std::vector<std::filesystem::path> jobs;
  std::optional<std::filesystem::path> out;
  int threads = 0;
  std::vector<std::string> settings;
  std::string stop_after;
  std::optional<std::filesystem::path> cache;
  bool no_cache = false;
  std::string executor = "tbb";   ///< tbb, serial, shuffled:SEED
  std::string progress = "auto";  ///< auto, plain, none
  bool quiet = false;
};
int run_command(const RunArguments& arguments, const CancellationToken& cancellation);

struct CheckArguments {
  std::vector<std::filesystem::path> files;
  bool json = false;
  std::optional<std::filesystem::path> repair;
};
int check_command(const CheckArguments& arguments);

struct GraphArguments {
  std::filesystem::path job;
  std::string format = "dot";  ///< dot, mermaid, json
  std::vector<std::string> settings;
};
int graph_command(const GraphArguments& arguments);

struct StagesArguments {
  bool json = false;
  bool markdown = false;
};
int stages_command(const StagesArguments& arguments);

struct QualityArguments {
  std::vector<std::filesystem::path> files;
  bool json = false;
  bool patch_test = false;
};
int quality_command(const QualityArguments& arguments);

struct DiffArguments {
  std::filesystem::path run_a;
  std::filesystem::path run_b;
};
int diff_command(const DiffArguments& arguments);

struct ConvertArguments {
  std::filesystem::path in;
  std::filesystem::path out;
};
int convert_command(const ConvertArguments& arguments);

struct GenerateArguments {
  std::string name;
  std::optional<std::filesystem::path> out;
  std::optional<double> resolution_m;
  std::optional<double> raw_ratio;
};
int generate_command(const GenerateArguments& arguments);

}  // namespace strataflow

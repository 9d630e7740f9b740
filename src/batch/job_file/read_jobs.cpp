#include <algorithm>
#include <set>
#include <system_error>

#include "base/atomic_file.h"
#include "batch/job_file/job.h"
#include "batch/job_file/job_file.h"
#include "batch/job_file/sweep.h"
#include "batch/options/closest_word.h"
#include "batch/options/option_reader.h"
#include "kernels/reference_models/generate_reference_model.h"

namespace strataflow {

namespace {

using Problems = std::vector<Failure>;

void add(Problems& problems, const std::string& origin, const std::string& what, std::string remedy) {
  problems.push_back({FailureCode::invalid_options, origin + ": " + what, std::move(remedy)});
}

bool contains(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The table of that name; complains about a value that is none.
const JobValue* section(const JobValue& root, std::string_view name, Problems& problems) {
  const JobValue* found = root.find(name);
  if (!found || found->table()) return found;
  add(problems, found->origin, "'" + std::string(name) + "' must be a table, but it is " + std::string(found->kind()),
      "write [" + std::string(name) + "] and its keys below");
  return nullptr;
}

template <class Options>
void read_section(const JobValue& root, std::string_view name, Options& options, Problems& problems) {
  OptionReader reader(section(root, name, problems), std::string(name), problems);
  options.visit_fields(reader);
  reader.finish();
}

/// Where a key of a section was written, or the section, or the file.
std::string origin_of(const JobValue& root, std::string_view section_name, std::string_view key) {
  const JobValue* table = root.find(section_name);
  if (const JobValue* value = table ? table->find(key) : nullptr) return value->origin;
  return table ? table->origin : root.origin;
}

bool is_folder_name(const std::string& name) {
  const auto is_plain = [](char c) {
    return static_cast<unsigned char>(c) >= ' ' && c != '/' && c != '\\' && c != 0x7f;
  };
  return !name.empty() && name.size() <= 200 && name[0] != '.' && std::all_of(name.begin(), name.end(), is_plain);
}

void check_input(const Job& job, const JobInput& input, Problems& problems) {
  if (input.file.has_value() == input.model.has_value())
    return add(problems, input.origin,
               input.file ? "an input has either 'file' or 'model', not both" : "an input needs 'file' or 'model'",
               "write file = \"name.ml\", or model = \"A1\" for a reference model");
  if (input.model) {
    if (std::find(reference_model_names().begin(), reference_model_names().end(), *input.model) ==
        reference_model_names().end())
      add(problems, input.origin, "unknown reference model '" + *input.model + "'",
          suggestion(*input.model, reference_model_names()));
    if (input.name || input.role || input.sticks || input.traces)
      add(problems, input.origin,
          "name, role, sticks and traces are for files: a reference model names its own surfaces",
          "remove them");
    return;
  }
  if (input.resolution_m || input.raw_ratio)
    add(problems, input.origin, "resolution_m and raw_ratio are for reference models, not for files", "remove them");
  std::error_code ignored;
  const auto status = std::filesystem::status(job.input_path(input), ignored);
  if (!std::filesystem::exists(status))
    add(problems, input.origin, "input file '" + *input.file + "' does not exist",
        "relative paths start at " + job.folder.string());
  else if (std::filesystem::is_directory(status))
    add(problems, input.origin, "input file '" + *input.file + "' is a folder",
        "name a file in it, one [[input]] each");
}

void read_inputs(const JobValue& root, Job& job, Problems& problems) {
  const JobValue* found = root.find("input");
  const JobValue::Array* items = found ? found->array() : nullptr;
  if (!items || items->empty())
    return add(problems, found ? found->origin : root.origin, "the job has no [[input]]",
               "add [[input]] with file = \"…\" or model = \"A1\"");
  for (const JobValue& item : *items) {
    if (!item.table()) {
      add(problems, item.origin, "an input must be a table", "write [[input]] and its keys below");
      continue;
    }
    const std::size_t before = problems.size();
    JobInput& input = job.inputs.emplace_back();
    input.origin = item.origin;
    OptionReader reader(&item, "input", problems);
    input.visit_fields(reader);
    reader.finish();
    if (problems.size() == before) check_input(job, input, problems);
  }
}

void check_remesh(const JobValue& root, const RemeshStageOptions& remesh, bool makes_surfaces, Problems& problems) {
  const SiteOptions& sites = remesh.sites;
  if (sites.sites && sites.target_edge_length_m)
    add(problems, origin_of(root, "remesh", "sites"), "[remesh] has both sites and target_edge_length_m", "keep one");
  if ((sites.density == "property") != sites.density_property.has_value())
    add(problems, origin_of(root, "remesh", "density"),
        "density = \"property\" and density_property come together or not at all",
        "name a property of the input's points in density_property, with density = \"property\"");
  if (!makes_surfaces) return;
  if (remesh.preserve == "resolution" && remesh.method == "steps")
    add(problems, origin_of(root, "remesh", "method"), "steps keep all: preserve = \"resolution\" takes cells",
        "remove method, or write method = \"cells\"");
  if (sites.density != "uniform" && !remesh.uses_cells())
    add(problems, origin_of(root, "remesh", "density"), "steps follow edge lengths, not densities",
        "use entity_edge_length_m, or method = \"cells\"");
  if (remesh.preserve == "all" && remesh.d_resolution_m)
    add(problems, origin_of(root, "remesh", "d_resolution_m"),
        "d_resolution_m merges what preserve = \"all\" is to keep", "remove one of them");
}

void check_hexes(const JobValue& root, const Job& job, Problems& problems) {
  if (job.hex.method == "conforming") return;
  const auto contradicts = [&](const char* section, const char* key, const std::string& what) {
    add(problems, origin_of(root, section, key), what + " is for hex.method = \"conforming\"",
        std::string("remove ") + section + "." + key + ", or method = \"" + job.hex.method + "\"");
  };
  if (!job.hex.refinement.refine_edge_m.empty()) contradicts("hex", "refine_edge_m", "a refined plan");
  if (job.hex.plan.follow_horizon_lines) contradicts("hex", "follow_horizon_lines", "following lines of horizons");
  if (!job.quad.problem.plan.fault_thickness_m.empty()) contradicts("quad", "fault_thickness_m", "a fault with a thickness");
}

void check_products(const JobValue& root, const Job& job, Problems& problems) {
  const std::string origin = origin_of(root, "output", "products");
  if (job.output.products.empty())
    add(problems, origin, "output.products is empty", "for instance products = [\"model\", \"tets\"]");
  std::set<std::string> seen;
  for (const std::string& product : job.output.products)
    if (!seen.insert(product).second)
      add(problems, origin, "product '" + product + "' is named twice", "name it once");
  if (job.output.from == "model" && job.makes("hybrid"))
    add(problems, origin_of(root, "output", "from"), "hybrid meshes are always built on the remeshed surfaces",
        "write from = \"surfaces\", or remove it");
  if (job.writes("obj") && !job.makes("model") && !job.makes("surfaces"))
    add(problems, origin_of(root, "output", "formats"),
        "format 'obj' is for the products 'model' and 'surfaces', which this job does not make",
        "remove it from formats, or add a product");
  if (job.makes("hexes")) check_hexes(root, job, problems);
  check_remesh(root, job.remesh, job.makes("surfaces") || job.output.from == "surfaces", problems);
  if (job.writes("grdecl") && !job.makes("hexes"))
    add(problems, origin_of(root, "output", "formats"),
        "format 'grdecl' is for the product 'hexes', which this job does not make", "remove it from formats");
}

/// One combination of the sweep, as a job.
Job read_job(const JobValue& root, const std::string& file_name, const std::filesystem::path& folder,
             const std::string& name_suffix, Problems& problems) {
  Job job;
  job.file_name = file_name;
  job.folder = folder;
  job.header.name = std::filesystem::path(file_name).stem().string();
  read_section(root, "job", job.header, problems);
  job.header.name += name_suffix;
  if (!is_folder_name(job.header.name))
    add(problems, origin_of(root, "job", "name"),
        "job.name " + OptionPrinter::literal(job.header.name) + " cannot name a folder",
        "use at most 200 letters, digits, '-' and '_'");
  read_inputs(root, job, problems);
  read_section(root, "output", job.output, problems);
  job.visit_sections([&](std::string_view name, auto& options) { read_section(root, name, options, problems); });
  // Values of the wrong kind have been complained about; contradictions are looked for among the others only.
  if (problems.empty()) check_products(root, job, problems);
  return job;
}

void check_section_names(const JobValue& root, Problems& problems) {
  std::vector<std::string_view> known = {"job", "input", "output", "sweep"};
  Job().visit_sections([&](std::string_view name, auto&) { known.push_back(name); });
  for (const auto& [name, value] : *root.table())
    if (std::find(known.begin(), known.end(), name) == known.end())
      add(problems, value.origin,
          (value.table() ? "unknown section [" : "unknown key '") + name + (value.table() ? "]" : "'"),
          suggestion(name, known));
}

void apply_settings(JobValue& root, const std::vector<std::string>& settings, Problems& problems) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::string key = setting.substr(0, equals);
    const std::size_t dot = key.find('.');
    if (equals == std::string::npos || dot == 0 || dot == std::string::npos || dot + 1 == key.size() ||
        !root.set(key, parse_setting_value(std::string_view(setting).substr(equals + 1), setting)))
      problems.push_back({FailureCode::invalid_usage, "--set " + setting + ": not of the form SECTION.KEY=VALUE",
                          "for instance --set tetrahedralize.radius_edge_ratio=1.4"});
  }
}

}  // namespace

bool Job::makes(std::string_view product) const { return contains(output.products, product); }
bool Job::writes(std::string_view format) const { return contains(output.formats, format); }

std::filesystem::path Job::input_path(const JobInput& input) const {
  return (folder / input.file.value_or("")).lexically_normal();
}

Result<std::vector<Job>> read_jobs_from_text(std::string_view text, const std::string& file_name,
                                             const std::filesystem::path& folder,
                                             const std::vector<std::string>& settings) {
  Result<JobValue> root = parse_job_text(text, file_name);
  if (!root) return root.failure();
  Problems problems;
  apply_settings(*root, settings, problems);
  check_section_names(*root, problems);
  const std::vector<SweepMember> members = expand_sweep(*root, problems);
  std::vector<Job> jobs;
  for (const SweepMember& member : members) {
    jobs.push_back(read_job(member.root, file_name, folder, member.name_suffix, problems));
    if (!problems.empty()) break;  // the other members would repeat them
  }
  if (const std::optional<Failure> failure = combined(problems)) return *failure;
  return jobs;
}

Result<std::vector<Job>> read_jobs(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  const Result<std::string> text = read_file(file);
  if (!text) return text.failure();
  std::error_code ignored;
  return read_jobs_from_text(*text, file.string(),
                             std::filesystem::absolute(file, ignored).parent_path().lexically_normal(), settings);
}

}  // namespace strataflow

#include "batch/job_file/sweep.h"

#include <cctype>
#include <set>

namespace strataflow {

namespace {

constexpr std::size_t most_members = 10'000;  // a mistyped sweep should not fill the disk

/// The value, fit for a folder name.
std::string name_part(const JobValue& value) {
  std::string text = value.text() ? *value.text() : value.literal();
  if (text.size() > 40) text.resize(40);
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '+') c = '_';
  return text;
}

/// [sweep] remesh.sites = […] makes nested tables, "remesh.sites" = […] one key with a dot: both mean the same.
void flatten(const JobValue& table, const std::string& prefix, JobValue::Table& out) {
  for (const auto& [key, value] : *table.table()) {
    if (value.table())
      flatten(value, prefix + key + ".", out);
    else
      out.emplace_back(prefix + key, value);
  }
}

}  // namespace

std::vector<SweepMember> expand_sweep(const JobValue& root, std::vector<Failure>& problems) {
  std::vector<SweepMember> members(1);
  JobValue::Table kept;
  for (const auto& entry : *root.table())
    if (entry.first != "sweep") kept.push_back(entry);
  members[0].root = JobValue{root.origin, kept};
  const JobValue* sweep = root.find("sweep");
  if (!sweep) return members;

  const auto complain = [&](const std::string& origin, const std::string& what) {
    problems.push_back({FailureCode::invalid_options, origin + ": " + what,
                        "for instance [sweep] with \"tetrahedralize.radius_edge_ratio\" = [1.4, 2.0]"});
  };
  if (!sweep->table()) {
    complain(sweep->origin, "'sweep' must be a table of lists");
    return members;
  }
  JobValue::Table axes;
  flatten(*sweep, "", axes);
  for (const auto& [key, values] : axes) {
    const JobValue::Array* items = values.array();
    const bool names_option = key.find('.') != std::string::npos && !key.starts_with("input.") && key != "job.name";
    if (!items || items->empty() || !names_option) {
      complain(values.origin, !names_option ? "'" + key + "' cannot be swept"
                                            : "sweep of '" + key + "' must be a list of at least one value");
      continue;
    }
    if (members.size() * items->size() > most_members) {
      complain(values.origin, "the sweep has more than " + std::to_string(most_members) + " combinations");
      return members;
    }
    std::vector<SweepMember> grown;
    for (const SweepMember& member : members)
      for (const JobValue& item : *items) {
        SweepMember& next = grown.emplace_back(member);
        if (!next.root.set(key, item)) complain(values.origin, "'" + key + "' is not a key of a section");
        next.name_suffix += "_" + key + "=" + name_part(item);
      }
    members = std::move(grown);
  }
  std::set<std::string> names;
  for (SweepMember& member : members) {
    const std::string name = member.name_suffix;
    for (int n = 2; !names.insert(member.name_suffix).second; ++n) member.name_suffix = name + "_" + std::to_string(n);
  }
  return members;
}

}  // namespace strataflow

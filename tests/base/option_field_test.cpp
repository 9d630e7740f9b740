#include "base/option_field.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

struct SampleOptions {
  double edge_m = 50;
  bool keep = true;
  std::int64_t sites = 10;
  std::string mode = "a\"b";
  std::optional<double> limit;
  std::vector<std::string> names{"F1", "F2"};
  std::map<std::string, double> sizes{{"Top", 1e-7}};
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(edge_m, OptionField{.name = "edge_m", .description = ""});
    visit(keep, OptionField{.name = "keep", .description = ""});
    visit(sites, OptionField{.name = "sites", .description = ""});
    visit(mode, OptionField{.name = "mode", .description = ""});
    visit(limit, OptionField{.name = "limit", .description = ""});
    visit(names, OptionField{.name = "names", .description = ""});
    visit(sizes, OptionField{.name = "sizes", .description = ""});
  }
};

TEST(OptionField, prints_as_toml_and_leaves_the_absent_out) {
  EXPECT_EQ(printed_options(SampleOptions{}),
            "edge_m = 50.0\nkeep = true\nsites = 10\nmode = \"a\\\"b\"\nnames = [\"F1\", \"F2\"]\nsizes = { \"Top\" = 1e-07 }\n");
}

TEST(OptionField, every_field_changes_the_text) {
  SampleOptions other;
  other.limit = 0.5;
  EXPECT_NE(printed_options(other), printed_options(SampleOptions{}));
}

}  // namespace
}  // namespace strataflow

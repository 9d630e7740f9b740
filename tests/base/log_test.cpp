#include "base/log.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

TEST(RunLog, keeps_lines_in_order_with_their_levels) {
  RunLog log;
  log.line(LogLevel::info, "read A1");
  log.line(LogLevel::warning, "leak: H2 stops short {of} F3");
  log.line(LogLevel::error, "no region");
  EXPECT_EQ(log.text(), "read A1\n    warning: leak: H2 stops short {of} F3\n    error: no region\n");
}

TEST(RunLog, is_empty_at_first_and_two_do_not_mix) {
  RunLog one, other;
  one.line(LogLevel::info, "one");
  EXPECT_EQ(one.text(), "one\n");
  EXPECT_EQ(other.text(), "");
}

}  // namespace
}  // namespace strataflow

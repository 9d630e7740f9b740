#include "graph/stage_store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>

#include "base/archive.h"
#include "base/atomic_file.h"
#include "graph/number_stages.h"

namespace strataflow {
namespace {

namespace fs = std::filesystem;
using namespace support;

/// A store in a folder that goes away with the test.
class StageStoreTest : public testing::Test {
 protected:
  StageStoreTest()
      : folder_(fs::temp_directory_path() / ("strataflow_store_" + std::to_string(::getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
  }
  ~StageStoreTest() override { fs::remove_all(folder_); }

  std::unique_ptr<StageStore> open(std::uint64_t limit_bytes = StageStore::default_limit_bytes) const {
    auto store = StageStore::open(folder_, limit_bytes);
    EXPECT_TRUE(store) << describe(store.failure());
    return *std::move(store);
  }
  std::vector<fs::path> entries() const {
    std::vector<fs::path> files;
    for (const auto& item : fs::recursive_directory_iterator(folder_))
      if (item.is_regular_file() && item.path().extension() != ".part") files.push_back(item.path());
    std::sort(files.begin(), files.end());
    return files;
  }
  fs::path entry_of(StageStore& store, const StageGraph& graph, std::uint32_t id) const {
    // The entry whose payload digest is the node's.
    const Digest digest = *run_graph(graph, serial()).nodes[id].digest;
    for (const fs::path& file : entries()) {
      const std::string hex = file.parent_path().parent_path().filename().string() +
                              file.parent_path().filename().string() + file.filename().string();
      const Digest key{std::stoull(hex.substr(0, 16), nullptr, 16), std::stoull(hex.substr(16), nullptr, 16)};
      if (const auto stored = store.find(key); stored && stored->digest == digest) return file;
    }
    ADD_FAILURE() << "node " << id << " is not in the store";
    return {};
  }
  static RunOptions with(StageStore& store, RunOptions options = serial()) {
    options.store = &store;
    return options;
  }
  static int stages_run_by(const std::function<void()>& work) {
    const int before = stages_run;
    work();
    return stages_run - before;
  }

  fs::path folder_;
};

std::vector<std::byte> bytes_of(std::string_view text) { return archived(std::string(text)); }

void flip_bit(const fs::path& file, std::size_t position, int bit) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(position));
  const int byte = stream.get();
  stream.seekp(static_cast<std::streamoff>(position));
  stream.put(static_cast<char>(byte ^ (1 << bit)));
}

TEST_F(StageStoreTest, what_was_saved_is_found_with_its_warnings) {
  const auto store = open();
  const Digest key = digest_of("key");
  const auto payload = bytes_of("payload");
  EXPECT_FALSE(store->find(key));
  ASSERT_TRUE(store->save(key, digest_of(payload), {{"sliver", "line 3"}}, payload));
  const auto found = store->find(key);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->digest, digest_of(payload));
  ASSERT_EQ(found->warnings.size(), 1u);
  EXPECT_EQ(found->warnings[0].what, "line 3");
  EXPECT_EQ(store->load(key, *found), payload);
  EXPECT_TRUE(fs::is_empty(folder_ / "parts"));
}

TEST_F(StageStoreTest, an_entry_with_any_bit_flipped_is_dropped) {
  const auto store = open();
  const Digest key = digest_of("key");
  const auto payload = bytes_of("payload");
  const auto save = [&] { ASSERT_TRUE(store->save(key, digest_of(payload), {{"kind", "what"}}, payload)); };
  save();
  const std::size_t size = fs::file_size(store->entry_file(key));
  for (std::size_t position = 0; position < size; ++position) {
    save();
    flip_bit(store->entry_file(key), position, static_cast<int>(position % 8));
    const auto found = store->find(key);
    EXPECT_FALSE(found && store->load(key, *found)) << "byte " << position;
    EXPECT_FALSE(fs::exists(store->entry_file(key))) << "byte " << position;
  }
}

TEST_F(StageStoreTest, a_truncated_or_lengthened_entry_is_dropped_when_it_is_met) {
  const auto store = open();
  const Digest key = digest_of("key");
  const auto payload = bytes_of("payload");
  const auto save = [&] { ASSERT_TRUE(store->save(key, digest_of(payload), {}, payload)); };
  save();
  const std::size_t size = fs::file_size(store->entry_file(key));
  for (std::size_t length = 0; length <= size + 1; ++length) {
    if (length == size) continue;
    save();
    fs::resize_file(store->entry_file(key), length);
    EXPECT_FALSE(store->find(key)) << length << " bytes";
    EXPECT_FALSE(fs::exists(store->entry_file(key))) << length << " bytes";
  }
}

TEST_F(StageStoreTest, an_entry_under_a_foreign_key_is_dropped) {
  const auto store = open();
  const auto payload = bytes_of("payload");
  ASSERT_TRUE(store->save(digest_of("a"), digest_of(payload), {}, payload));
  const Digest other = digest_of("b");
  fs::create_directories(store->entry_file(other).parent_path());
  fs::copy_file(store->entry_file(digest_of("a")), store->entry_file(other));
  EXPECT_FALSE(store->find(other));
}

TEST_F(StageStoreTest, the_entry_used_longest_ago_goes_first) {
  const std::vector<std::byte> payload(1000);
  const auto store = open(3500);
  const std::vector<std::string> names = {"a", "b", "c", "d"};
  const auto now = fs::file_time_type::clock::now();
  for (std::size_t i = 0; i < names.size(); ++i) {
    ASSERT_TRUE(store->save(digest_of(names[i]), digest_of(payload), {}, payload));
    fs::last_write_time(store->entry_file(digest_of(names[i])), now - std::chrono::hours(10 - i));
  }
  ASSERT_TRUE(store->find(digest_of("a")));  // marks it as used now
  EXPECT_EQ(store->evict(), 1u);
  EXPECT_TRUE(store->find(digest_of("a")));
  EXPECT_FALSE(store->find(digest_of("b")));
  EXPECT_TRUE(store->find(digest_of("c")));
  EXPECT_EQ(store->evict(), 0u);
}

TEST_F(StageStoreTest, eviction_leaves_files_alone_that_are_not_entries) {
  const auto store = open(0);
  fs::create_directories(folder_ / "ab" / "cd");
  std::ofstream(folder_ / "thesis.txt") << "mine";
  std::ofstream(folder_ / "ab" / "cd" / "notes") << "mine";
  ASSERT_TRUE(store->save(digest_of("a"), digest_of(""), {}, {}));
  EXPECT_EQ(store->evict(), 1u);
  EXPECT_TRUE(fs::exists(folder_ / "thesis.txt"));
  EXPECT_TRUE(fs::exists(folder_ / "ab" / "cd" / "notes"));
}

TEST_F(StageStoreTest, opening_removes_what_dead_processes_left_and_keeps_what_live_ones_write) {
  (void)open();
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  const auto make = [&](pid_t owner) {
    const fs::path part = folder_ / "parts" / ("00ff." + std::to_string(owner) + ".0.part");
    std::ofstream(part) << "half";
    return part;
  };
  const fs::path dead = make(child);
  const fs::path live = make(::getpid());
  const fs::path forgotten = make(1);
  fs::last_write_time(forgotten, fs::file_time_type::clock::now() - std::chrono::hours(25));
  (void)open();
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(live));
  EXPECT_FALSE(fs::exists(forgotten));
}

TEST_F(StageStoreTest, a_folder_that_cannot_be_made_is_a_failure) {
  std::ofstream(folder_.string()) << "a file";
  const auto store = StageStore::open(folder_);
  ASSERT_FALSE(store);
  EXPECT_EQ(store.failure().code, FailureCode::write_failed);
}

TEST_F(StageStoreTest, a_warm_run_runs_nothing_and_reports_the_same) {
  const StageGraph graph = diamond();
  const auto expected = facts(run_graph(graph, serial()));
  const auto store = open();
  EXPECT_EQ(stages_run_by([&] { EXPECT_EQ(facts(run_graph(graph, with(*store))), expected); }), 4);
  RunOutcome warm;
  EXPECT_EQ(stages_run_by([&] { warm = run_graph(graph, with(*store, on_threads(2))); }), 0);
  EXPECT_EQ(facts(warm), expected);
  for (const NodeTiming& timing : warm.timings) EXPECT_TRUE(timing.is_cached);
}

TEST_F(StageStoreTest, a_changed_option_runs_only_what_follows_from_it) {
  const auto store = open();
  const auto graph_with = [](double factor) {
    StageGraph graph;
    const auto drawn = graph.add("draw", DrawNumbers{});
    const auto scaled = graph.add("scale", ScaleNumbers{{.factor = factor}}, drawn);
    const auto sorted = graph.add("sort", SortNumbers{}, drawn);
    graph.add("dot", DotNumbers{}, scaled, sorted);
    return graph;
  };
  EXPECT_EQ(stages_run_by([&] { run_graph(graph_with(2), with(*store)); }), 4);
  EXPECT_EQ(stages_run_by([&] { run_graph(graph_with(3), with(*store)); }), 2);
}

TEST_F(StageStoreTest, payloads_of_inner_nodes_are_not_read_in_a_warm_run) {
  const StageGraph graph = diamond();
  const auto store = open();
  const auto expected = facts(run_graph(graph, with(*store)));
  const fs::path inner = entry_of(*store, graph, 0);
  flip_bit(inner, fs::file_size(inner) - 1, 0);
  EXPECT_EQ(stages_run_by([&] { EXPECT_EQ(facts(run_graph(graph, with(*store))), expected); }), 0);
  EXPECT_TRUE(fs::exists(inner)) << "the damage went unnoticed because nobody read it";
}

TEST_F(StageStoreTest, a_damaged_payload_is_made_again_when_somebody_needs_it) {
  const StageGraph graph = diamond();
  const auto expected = facts(run_graph(graph, serial()));
  for (const RunOptions& options : {serial(), on_threads(2), on_threads(8), shuffled(3)}) {
    fs::remove_all(folder_);
    const auto store = open();
    run_graph(graph, with(*store));
    const fs::path draw = entry_of(*store, graph, 0);
    const fs::path scale = entry_of(*store, graph, 1);
    fs::remove(entry_of(*store, graph, 2));
    fs::remove(entry_of(*store, graph, 3));
    for (const fs::path& file : {draw, scale}) flip_bit(file, fs::file_size(file) - 1, 0);
    // dot needs scale, sort and scale need draw: all four run, draw once only.
    EXPECT_EQ(stages_run_by([&] { EXPECT_EQ(facts(run_graph(graph, with(*store, options))), expected); }), 4);
    EXPECT_EQ(stages_run_by([&] { EXPECT_EQ(facts(run_graph(graph, with(*store, options))), expected); }), 0);
  }
}

TEST_F(StageStoreTest, a_wanted_output_is_read_from_the_store) {
  StageGraph graph;
  const auto drawn = graph.add("draw", DrawNumbers{{.count = 10}});
  const auto store = open();
  RunOptions options = with(*store);
  options.wanted = {drawn.node()};
  const auto cold = run_graph(graph, options).output(drawn)->values;
  EXPECT_EQ(stages_run_by([&] { EXPECT_EQ(run_graph(graph, options).output(drawn)->values, cold); }), 0);
}

TEST_F(StageStoreTest, entries_that_vanish_during_a_run_are_made_again) {
  const StageGraph graph = wide(4);
  const auto expected = facts(run_graph(graph, serial()));
  const auto store = open(0);  // everything is evicted after each run
  for (int run = 0; run < 3; ++run) {
    EXPECT_EQ(facts(run_graph(graph, with(*store))), expected);
    EXPECT_TRUE(entries().empty());
  }
}

struct ReadText {
  static constexpr std::string_view name = "read_text";
  static constexpr int version = 1;
  NoOptions options;
  fs::path file;
  Result<Digest> external_digest() const {
    const auto content = read_file(file);
    if (!content) return content.failure();
    return digest_of(*content);
  }
  std::string external_identity() const { return file.string(); }
  Result<std::string> operator()(StageContext&) const {
    ++stages_run;
    return read_file(file);
  }
};

TEST_F(StageStoreTest, the_content_of_files_is_part_of_the_key_and_their_path_is_not) {
  const auto store = open();
  const auto read = [&](const char* name) {
    StageGraph graph;
    const auto text = graph.add("read", ReadText{{}, folder_ / name});
    RunOptions options = with(*store);
    options.wanted = {text.node()};
    const RunOutcome outcome = run_graph(graph, options);
    return outcome.is_ok() ? *outcome.output(text) : describe(*outcome.nodes[0].failure);
  };
  std::ofstream(folder_ / "a") << "one";
  EXPECT_EQ(stages_run_by([&] { EXPECT_EQ(read("a"), "one"); }), 1);
  fs::copy_file(folder_ / "a", folder_ / "b");
  EXPECT_EQ(stages_run_by([&] { EXPECT_EQ(read("b"), "one"); }), 0);
  std::ofstream(folder_ / "a") << "two";
  EXPECT_EQ(stages_run_by([&] { EXPECT_EQ(read("a"), "two"); }), 1);
  EXPECT_NE(read("missing").find("missing: No such file"), std::string::npos);
}

TEST_F(StageStoreTest, failures_are_not_stored) {
  StageGraph graph;
  graph.add("refuse", RefuseNumbers{}, graph.add("draw", DrawNumbers{}));
  const auto store = open();
  const auto expected = facts(run_graph(graph, with(*store)));
  EXPECT_EQ(facts(run_graph(graph, with(*store))), expected);
  EXPECT_EQ(entries().size(), 1u);
}

/// Runs `work` in a child process, which exits with what it returns.
pid_t start(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  return child;
}

TEST_F(StageStoreTest, a_run_killed_at_any_moment_resumes_to_the_same_digests) {
  const StageGraph graph = wide(10, 40000);
  const auto expected = facts(run_graph(graph, serial()));
  int killed = 0;
  for (int delay_ms = 1; delay_ms < 60; delay_ms += 4) {
    if (delay_ms % 3 == 0) fs::remove_all(folder_);
    const pid_t child = start([&] {
      for (;;) {
        const auto store = StageStore::open(folder_);
        run_graph(graph, with(**store));
        // Empty it, so that there is always something to write.
        for (const fs::path& file : entries()) fs::remove(file);
      }
      return 0;
    });
    ::usleep(static_cast<useconds_t>(delay_ms) * 1000);
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    killed += WIFSIGNALED(status);
    const auto store = open();
    EXPECT_TRUE(fs::is_empty(folder_ / "parts"));
    EXPECT_EQ(facts(run_graph(graph, with(*store))), expected) << "killed after " << delay_ms << " ms";
    EXPECT_EQ(stages_run_by([&] { run_graph(graph, with(*store)); }), 0);
  }
  EXPECT_EQ(killed, 15);
}

TEST_F(StageStoreTest, processes_share_a_store_while_it_evicts) {
  const StageGraph graph = wide(6, 20000);
  const auto expected = facts(run_graph(graph, serial()));
  std::vector<pid_t> children;
  for (int i = 0; i < 3; ++i)
    children.push_back(start([&, i] {
      for (int run = 0; run < 15; ++run) {
        const auto store = StageStore::open(folder_, i == 0 ? 500'000 : StageStore::default_limit_bytes);
        if (!store || facts(run_graph(graph, with(**store))) != expected) return 1;
      }
      return 0;
    }));
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
}

}  // namespace
}  // namespace strataflow

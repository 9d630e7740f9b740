#include "io/model_file/model_project.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "base/archive.h"
#include "base/atomic_file.h"
#include "io/two_tetrahedra.h"

// lemelinaire1992 §2.18: rules H1–H8, test T17.
namespace strataflow {
namespace {

namespace fs = std::filesystem;
using support::two_tetrahedra;

class ModelProjectTest : public testing::Test {
 protected:
  ~ModelProjectTest() override { fs::remove(file_); }

  ModelProject open() const {
    auto project = ModelProject::open(file_);
    EXPECT_TRUE(project) << describe(project.failure());
    return *std::move(project);
  }
  /// Saves the two tetrahedra and returns their ids.
  ModelIds save_two_tetrahedra() {
    ModelProject project;
    ModelIds ids;
    EXPECT_TRUE(project.set_model(two_tetrahedra(), ids));
    EXPECT_TRUE(project.save(file_));
    return ids;
  }
  std::string bytes() const { return *read_file(file_); }

  fs::path file_ = fs::temp_directory_path() / ("strataflow_" + std::to_string(::getpid()) + "_project.sfm");
};

StoredEntity entity(const char* name) { return {{name, Role::fault}}; }

std::vector<PermanentId> all_ids(const ModelProject& project) {
  std::vector<PermanentId> all;
  for (std::uint32_t kind = 1; kind <= 9; ++kind)
    for (const PermanentId id : project.ids(static_cast<RecordKind>(kind))) all.push_back(id);
  std::sort(all.begin(), all.end());
  return all;
}

// H1
TEST_F(ModelProjectTest, ids_are_unique_and_never_zero) {
  save_two_tetrahedra();
  const auto all = all_ids(open());
  EXPECT_EQ(all.size(), 1u + 1 + 2 + 2 + 2 + 3 + 3 + 2 + 1);
  EXPECT_EQ(std::set<PermanentId>(all.begin(), all.end()).size(), all.size());
  EXPECT_GT(all.front(), 0u);
}

// T17: one program saves A at address 948; the next, without A, saves B at the same address; both load afterwards.
TEST_F(ModelProjectTest, two_objects_that_had_the_same_address_in_two_programs_are_two_objects) {
  ModelProject first;
  const PermanentId a = first.add(entity("A"));
  ASSERT_TRUE(first.save(file_));

  ModelProject second = open();
  EXPECT_EQ(second.find<StoredEntity>(a), nullptr) << "A is not loaded";
  const PermanentId b = second.add(entity("B"));
  ASSERT_TRUE(second.save(file_));

  ModelProject third = open();
  ASSERT_NE(a, b);
  ASSERT_TRUE(third.load(std::vector{b, a}));
  EXPECT_EQ(third.find<StoredEntity>(a)->entity.name, "A");
  EXPECT_EQ(third.find<StoredEntity>(b)->entity.name, "B");
}

// H5, T17: A and B share an item; whoever comes first brings it, whoever comes second finds it.
TEST_F(ModelProjectTest, a_shared_part_is_loaded_once_whoever_comes_first) {
  const ModelIds ids = save_two_tetrahedra();
  const PermanentId item = ids.corners[0];
  for (const bool a_first : {true, false}) {
    ModelProject project = open();
    ASSERT_TRUE(project.load(std::vector{ids.lines[a_first ? 0 : 1]}));
    const StoredCorner* shared = project.find<StoredCorner>(item);
    ASSERT_NE(shared, nullptr);
    ASSERT_TRUE(project.load(std::vector{ids.lines[a_first ? 1 : 0]}));
    EXPECT_EQ(project.find<StoredCorner>(item), shared);
    ModelIds loaded;
    const auto model = project.model(&loaded);
    ASSERT_TRUE(model);
    EXPECT_EQ(loaded.lines, ids.lines);
    EXPECT_EQ(model->corners.size(), 2u);
    EXPECT_EQ(model->lines[0].corners[0], model->lines[1].corners[1]);
  }
}

// H4
TEST_F(ModelProjectTest, every_order_of_loading_gives_the_same_model) {
  const ModelIds ids = save_two_tetrahedra();
  std::vector<PermanentId> order = {ids.layers[0],    ids.surfaces[2], ids.lines[0],
                                    ids.frontiers[2], ids.regions[1],  ids.entities[1]};
  std::sort(order.begin(), order.end());
  const auto expected = archived(two_tetrahedra());
  int permutations = 0;
  do {
    ModelProject project = open();
    for (const PermanentId id : order) ASSERT_TRUE(project.load(std::vector{id}));
    ASSERT_EQ(archived(*project.model()), expected);
    ++permutations;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(permutations, 720);
}

// H3
TEST_F(ModelProjectTest, saving_what_was_loaded_gives_the_same_bytes) {
  const ModelIds ids = save_two_tetrahedra();
  const std::string before = bytes();
  ModelProject nothing_loaded = open();
  ASSERT_TRUE(nothing_loaded.save(file_));
  EXPECT_EQ(bytes(), before);
  ModelProject some_loaded = open();
  ASSERT_TRUE(some_loaded.load(std::vector{ids.surfaces[1]}));
  ASSERT_TRUE(some_loaded.save(file_));
  EXPECT_EQ(bytes(), before);
  ModelProject all_loaded = open();
  ASSERT_TRUE(all_loaded.load_all());
  ModelIds same;
  const StructuralModel model = *all_loaded.model(&same);
  EXPECT_EQ(same, ids);
  ASSERT_TRUE(all_loaded.set_model(model, same));
  ASSERT_TRUE(all_loaded.save(file_));
  EXPECT_EQ(bytes(), before);
}

TEST_F(ModelProjectTest, a_surface_alone_comes_with_its_parts_and_without_what_it_touches) {
  const ModelIds ids = save_two_tetrahedra();
  ModelProject project = open();
  ASSERT_TRUE(project.load(std::vector{ids.surfaces[2]}));
  ModelIds loaded;
  const auto model = project.model(&loaded);
  ASSERT_TRUE(model) << describe(model.failure());
  EXPECT_EQ(loaded.surfaces, std::vector{ids.surfaces[2]});
  EXPECT_EQ(loaded.lines, ids.lines);
  EXPECT_EQ(loaded.corners, ids.corners);
  EXPECT_EQ(loaded.entities, std::vector{ids.entities[1]});
  EXPECT_TRUE(model->regions.empty());
  EXPECT_EQ(model->triangles, (std::vector<Triangle>{{1, 0, 4}, {2, 1, 4}, {0, 2, 4}}));
  EXPECT_EQ(model->surfaces[0].region_minus, universe);
  EXPECT_EQ(model->lines[0].surfaces, std::vector<std::uint32_t>{0});
  EXPECT_FALSE(model->is_sealed);
}

// "Incremental: re-saving one object reuses ids, so links from what is not loaded stay valid."
TEST_F(ModelProjectTest, saving_one_object_again_keeps_its_id_and_every_link_to_it) {
  const ModelIds ids = save_two_tetrahedra();
  ModelProject project = open();
  ASSERT_TRUE(project.load(std::vector{ids.entities[0]}));
  project.replace(ids.entities[0], entity("F1 renamed"));
  ASSERT_TRUE(project.save(file_));

  ModelProject again = open();
  ASSERT_TRUE(again.load_all());
  ModelIds after;
  const auto model = again.model(&after);
  ASSERT_TRUE(model);
  EXPECT_EQ(after, ids);
  StructuralModel expected = two_tetrahedra();
  expected.entities[0].name = "F1 renamed";
  EXPECT_EQ(archived(*model), archived(expected));
}

// H8, T17: an object is freed, a new one takes its place in memory and in the lists.
TEST_F(ModelProjectTest, a_new_object_never_inherits_the_id_of_a_freed_one) {
  ModelIds ids = save_two_tetrahedra();
  ModelProject project = open();
  ASSERT_TRUE(project.load_all());
  const PermanentId last = project.counter();
  StructuralModel model = *project.model();
  const PermanentId freed = ids.layers[0];
  model.layers[0] = {"shale", {1}};
  ids.layers[0] = 0;
  ASSERT_TRUE(project.set_model(model, ids));
  EXPECT_GT(ids.layers[0], last);
  EXPECT_EQ(project.find<StoredLayer>(freed), nullptr);
  ASSERT_TRUE(project.save(file_));
  EXPECT_EQ(open().ids(RecordKind::layer), ids.layers);

  // The object with the largest id is freed and the program ends: its id is still not given again.
  ModelProject later = open();
  later.remove(ids.layers[0]);
  ASSERT_TRUE(later.save(file_));
  EXPECT_GT(open().add(StoredLayer{}), ids.layers[0]);
}

TEST_F(ModelProjectTest, ids_that_do_not_fit_the_model_are_refused) {
  ModelIds ids = save_two_tetrahedra();
  ModelProject project = open();
  ASSERT_TRUE(project.load_all());
  ModelIds wrong = ids;
  std::swap(wrong.lines[0], wrong.surfaces[0]);
  EXPECT_EQ(project.set_model(two_tetrahedra(), wrong).failure().code, FailureCode::invalid_input);
  wrong = ids;
  wrong.lines[1] = wrong.lines[0];
  EXPECT_FALSE(project.set_model(two_tetrahedra(), wrong));
  wrong = ids;
  wrong.layers.push_back(0);
  EXPECT_FALSE(project.set_model(two_tetrahedra(), wrong));
  EXPECT_TRUE(project.set_model(two_tetrahedra(), ids));
}

// H6
TEST_F(ModelProjectTest, a_reference_to_nothing_is_named) {
  const ModelIds ids = save_two_tetrahedra();
  ModelProject project = open();
  project.remove(ids.surfaces[1]);
  ASSERT_TRUE(project.save(file_));
  const auto loaded = open().load(std::vector{ids.lines[1]});
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.failure().what, file_.string() + ": section " + std::to_string(ids.lines[1]) +
                                       " (line) refers to surface " + std::to_string(ids.surfaces[1]) +
                                       ", which is not there");
}

TEST_F(ModelProjectTest, a_reference_of_the_wrong_kind_is_named) {
  const ModelIds ids = save_two_tetrahedra();
  ModelProject project = open();
  ASSERT_TRUE(project.load_all());
  project.replace(ids.layers[0], StoredLayer{"sand", {ids.lines[0]}});
  ASSERT_TRUE(project.save(file_));
  const auto loaded = open().load(ids.layers);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.failure().what, file_.string() + ": section " + std::to_string(ids.layers[0]) +
                                       " (layer) refers to " + std::to_string(ids.lines[0]) +
                                       " as a region, which is a line");
}

TEST_F(ModelProjectTest, a_side_or_a_role_that_does_not_exist_is_named) {
  const ModelIds ids = save_two_tetrahedra();
  ModelProject project = open();
  ASSERT_TRUE(project.load_all());
  StoredFrontier frontier = *project.find<StoredFrontier>(ids.frontiers[0]);
  StoredFrontier damaged = frontier;
  damaged.is_positive[0] = 7;
  project.replace(ids.frontiers[0], damaged);
  ASSERT_FALSE(project.model());
  EXPECT_EQ(project.model().failure().what,
            file_.string() + ": section " + std::to_string(ids.frontiers[0]) + " (frontier) contradicts itself");
  project.replace(ids.frontiers[0], frontier);
  project.replace(ids.entities[0], StoredEntity{{"F1", static_cast<Role>(200)}});
  ASSERT_FALSE(project.model());
  EXPECT_EQ(project.model().failure().what, file_.string() + ": section " + std::to_string(ids.entities[0]) +
                                                " (entity) has a role that does not exist");
}

TEST_F(ModelProjectTest, a_pipe_is_refused_and_not_waited_for) {
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  const auto project = ModelProject::open(file_);
  ASSERT_FALSE(project);
  EXPECT_EQ(project.failure().code, FailureCode::unreadable_file);
}

TEST_F(ModelProjectTest, an_id_nobody_has_cannot_be_loaded) {
  save_two_tetrahedra();
  EXPECT_EQ(open().load(std::vector<PermanentId>{4711}).failure().code, FailureCode::invalid_input);
}

// H7, T17: killed between the counter and the file. The counter is ahead, the objects are the old ones.
TEST_F(ModelProjectTest, ids_given_before_a_crash_are_not_given_again) {
  save_two_tetrahedra();
  const std::string before = bytes();
  ModelProject project = open();
  const PermanentId lost = project.add(entity("lost"));
  ASSERT_TRUE(project.save(file_));
  const std::string after = bytes();
  // What the disk holds when the process dies after the first write: the old file with one new copy of the counter.
  std::ofstream(file_, std::ios::binary) << before.substr(0, 16) << after.substr(16, 16) << before.substr(32);
  ModelProject resumed = open();
  EXPECT_EQ(resumed.ids(RecordKind::entity).size(), 2u);
  EXPECT_GT(resumed.add(entity("new")), lost);
  ASSERT_TRUE(resumed.load_all());
  // …or half-way through it.
  std::ofstream(file_, std::ios::binary) << before.substr(0, 16) << after.substr(16, 9) << before.substr(25);
  EXPECT_EQ(open().counter() + 1, lost);
}

TEST_F(ModelProjectTest, a_damaged_counter_falls_back_on_the_largest_id_seen) {
  const ModelIds ids = save_two_tetrahedra();
  std::string damaged = bytes();
  damaged[16] ^= 1;
  damaged[32] ^= 1;
  std::ofstream(file_, std::ios::binary) << damaged;
  EXPECT_EQ(open().counter(), ids.layers[0]);
}

TEST_F(ModelProjectTest, a_program_that_saves_over_anothers_work_is_stopped) {
  save_two_tetrahedra();
  ModelProject mine = open();
  ModelProject theirs = open();
  theirs.add(entity("theirs"));
  ASSERT_TRUE(theirs.save(file_));
  mine.add(entity("mine"));
  const std::string before = bytes();
  EXPECT_EQ(mine.save(file_).failure().code, FailureCode::write_failed);
  EXPECT_EQ(bytes(), before);
}

TEST_F(ModelProjectTest, a_process_killed_at_any_moment_leaves_a_whole_file_and_a_safe_counter) {
  save_two_tetrahedra();
  PermanentId last = 0;
  for (int round = 0; round < 20; ++round) {
    int pipe[2];
    ASSERT_EQ(::pipe(pipe), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      for (;;) {
        auto project = ModelProject::open(file_);
        const PermanentId id = project->add(entity("one of many"));
        if (!project->save(file_) || ::write(pipe[1], &id, sizeof id) != sizeof id) ::_exit(1);
      }
    }
    ::close(pipe[1]);
    ::usleep(1500u * static_cast<useconds_t>(round));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    for (PermanentId id = 0; ::read(pipe[0], &id, sizeof id) == sizeof id;) {
      EXPECT_GT(id, last) << "an id was given twice";
      last = id;
    }
    ::close(pipe[0]);
    ModelProject project = open();
    ASSERT_TRUE(project.load_all());
    EXPECT_GE(project.counter(), last);
    last = project.counter();
  }
  EXPECT_GT(last, 25u) << "the children hardly saved anything";
  for (const auto& item : fs::directory_iterator(file_.parent_path()))  // what the killed ones were writing
    if (item.path().filename().string().starts_with("." + file_.filename().string())) fs::remove(item.path());
}

}  // namespace
}  // namespace strataflow

/** @file
Whoever asks what a setting changes gets the same pairs, change and interval from a sweep, from a
sensitivity and from two sessions that are compared: 20 random questions. Grasps pinned at the base
are asked of the first two, grasps chosen again under the change of all three. */

#include <fcntl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "core/base/text/json.h"
#include "tests/sessions/test_folder.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {

/** As a number that a JSON may lack: -1000. */
double NumberOf(const Json& json) { return json.is_number() ? json.get<double>() : -1000.0; }

struct Said {
  int pairs = 0, objects = 0, other_grasp = 0, left_out = 0;
  double change = 0.0, low = 0.0, high = 0.0;
  std::string no_interval;
};

void ExpectSameWords(const Said& a, const Said& b) {
  EXPECT_EQ(a.pairs, b.pairs);
  EXPECT_EQ(a.objects, b.objects);
  EXPECT_EQ(a.other_grasp, b.other_grasp);
  EXPECT_EQ(a.left_out, b.left_out);
  EXPECT_NEAR(a.change, b.change, 1e-12);
  EXPECT_NEAR(a.low, b.low, 1e-12);
  EXPECT_NEAR(a.high, b.high, 1e-12);
  EXPECT_EQ(a.no_interval, b.no_interval);
}

int CountOf(const Json& row, const char* key) { return row.at(key).get<int>(); }
std::string TextOf(const Json& row, const char* key) {
  return row.at(key).is_string() ? row.at(key).get<std::string>() : "";
}

Said FromSweep(const Json& summary) {
  for (const Json& row : summary.at("effects")) {
    if (TextOf(row, "measure") != "success") continue;
    return {CountOf(row, "draws"),    CountOf(row, "objects"),    CountOf(row, "other_grasp"),
            CountOf(row, "left_out"), NumberOf(row.at("change")), NumberOf(row.at("low")),
            NumberOf(row.at("high")), TextOf(row, "no_interval")};
  }
  ADD_FAILURE() << "a sweep without its effect";
  return {};
}

/** Of a sensitivity and of a comparison. */
Said FromChange(const Json& row) {
  const int lost = CountOf(row, "success_before_only"), won = CountOf(row, "success_after_only");
  const int pairs = CountOf(row, "success_both") + lost + won + CountOf(row, "success_neither");
  return {pairs,
          CountOf(row, "objects"),
          CountOf(row, "other_grasp"),
          CountOf(row, "left_out"),
          static_cast<double>(won - lost) / pairs,
          NumberOf(row.at("rate_change_low")),
          NumberOf(row.at("rate_change_high")),
          TextOf(row, "no_interval")};
}

class Asker {
 public:
  explicit Asker(const TestFolder& folder) : folder_(folder) {}

  Json Ask(const std::vector<std::string>& command) const {
    const std::string file = (folder_.path() / "answer.json").string();
    const int status = WaitFor(Start(command, [&file] {
      ::dup2(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
      ::dup2(::open("/dev/null", O_WRONLY), 2);
    }));
    EXPECT_EQ(status, 0) << command.front();
    return Json::parse(ReadFile(file));
  }
  std::string Name(const std::string& name) const { return (folder_.path() / name).string(); }

 private:
  const TestFolder& folder_;
};

struct Question {
  std::vector<std::string> options;
  std::string key, level;
};

Question Draw(unsigned seed) {
  std::mt19937 random(seed);
  const auto pick = [&](const std::vector<std::string>& list) {
    return list[random() % list.size()];
  };
  std::vector<std::string> objects = {"pencil",     "golf_ball",  "cup",       "eraser",
                                      "light_bulb", "can",        "tea_light", "paper_ball",
                                      "sharpener",  "tissue_pack"};
  std::string named;
  const size_t count = 3 + random() % 5;
  for (size_t i = 0; i < count; ++i) {
    std::swap(objects[i], objects[i + random() % (objects.size() - i)]);
    named += (i > 0 ? "," : "") + objects[i];
  }
  const std::vector<std::array<std::string, 2>> levels = {
      {"model.friction_scale", "0.5"}, {"model.friction_scale", "0.7"},
      {"model.mass_scale", "3"},       {"model.drive_torque_scale", "0.5"},
      {"model.mass_scale", "0.5"},     {"model.pad_stiffness_scale", "0.5"}};
  const auto& level = levels[random() % levels.size()];
  // The type by geometry is chosen again under every condition and in every session. Types by
  // rehearsal are not: a session takes the stored ones, whatever its settings are.
  return {{"--hand", pick({"tum", "shadow"}), "--object", named, "--grasp", "predicted", "--trials",
           "2", "--seed", std::to_string(seed)},
          level[0],
          level[1]};
}

std::vector<std::string> Join(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(OneChangeSlow, TwentyQuestionsHaveOneAnswerEach) {
  int num_changed = 0, num_other_grasp = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TestFolder folder("change_" + std::to_string(seed));
    const Asker asker(folder);
    const Question question = Draw(seed);
    SCOPED_TRACE(question.options[1] + " " + question.options[3] + " " + question.key + "=" +
                 question.level);
    const std::string setting = question.key + "=" + question.level;
    const auto sweep = Join(Join({"sweep"}, question.options),
                            {"--factor", question.key + "=1," + question.level, "--json", "--out"});
    const auto run = Join(Join({"run"}, question.options), {"--json", "--out"});
    const std::string before = asker.Name("before"), after = asker.Name("after");
    asker.Ask(Join(run, {before}));
    asker.Ask(Join(run, {after, "--set", setting}));
    const std::vector<std::string> sensitivity = {"sensitivity", before, "--set", setting,
                                                  "--json"};
    const Said pinned = FromSweep(asker.Ask(Join(sweep, {asker.Name("sweep")})));
    ExpectSameWords(pinned, FromChange(asker.Ask(sensitivity).at("changes").at(0)));
    EXPECT_EQ(pinned.other_grasp, 0);
    const Said free =
        FromSweep(asker.Ask(Join(sweep, {asker.Name("free"), "--grasp-per-condition"})));
    const Json changes = asker.Ask(Join(sensitivity, {"--grasp-per-condition"})).at("changes");
    ASSERT_EQ(changes.size(), 2u);
    ExpectSameWords(free, FromChange(changes.at(1)));
    ExpectSameWords(
        free, FromChange(asker.Ask({"compare", before, after, "--json"}).at("changes").at(0)));
    num_changed += pinned.change != 0.0;
    num_other_grasp += free.other_grasp > 0;
  }
  // Questions that nothing answers prove nothing.
  EXPECT_GE(num_changed, 5);
  EXPECT_GE(num_other_grasp, 2);
  std::printf("%d of 20 questions with a change, %d with another grasp\n", num_changed,
              num_other_grasp);
}

}  // namespace
}  // namespace graspbench

/** @file
Figures over 100 studies a case, each of files, as ../../../human_study/ACCURACY.md has them. */

#include <gtest/gtest.h>

#include <cctype>
#include <cstdio>

#include "tests/human_study/protocol/protocol_study.h"

namespace graspbench::protocol {
namespace {

/** 10 persons of 20 trials: 1,000 contacts a case. */
struct Behaviour {
  const char* name;
  void (*change)(Conditions& conditions);
};
const Behaviour kBehaviours[] = {
    {"ordinary", [](Conditions&) {}},
    {"push 5 mm", [](Conditions& c) { c.push = 5e-3; }},
    {"push 15 mm", [](Conditions& c) { c.push = 15e-3; }},
    {"push 5 mm at once", [](Conditions& c) { c.push = 5e-3, c.is_push_at_once = true; }},
    {"push 15 mm at once", [](Conditions& c) { c.push = 15e-3, c.is_push_at_once = true; }},
    {"turn 15 deg", [](Conditions& c) { c.turn = 0.262; }},
    {"soft touch", [](Conditions& c) { c.min_touch_speed = 5e-3, c.max_touch_speed = 20e-3; }},
    {"tremor 0.4 mm", [](Conditions& c) { c.tremor = 0.4e-3; }},
};

/** All digits of a generator have one skin, and how skins differ is stated: coverage has no upper
bound here. */
void CheckContacts(const Behaviour& behaviour, bool has_shape, const std::string& seed,
                   ReachMaker make_reach) {
  StudyPlan plan;
  plan.seed = seed + ", " + behaviour.name;
  plan.make_reach = make_reach;
  plan.num_people = 10;
  plan.trials_per_person = 20;
  plan.has_shape = has_shape;
  behaviour.change(plan.conditions);
  const Accuracy a = CompareWithTruth(RunPlan(plan));
  std::printf(
      "%-20s %s kept %3d of %3d, contacts %4d, bias %5.1f ms, SD %4.1f ms, coverage %.3f, "
      "silent %d\n",
      behaviour.name, has_shape ? "shape   " : "no shape", a.num_kept, a.num_trials, a.num_contacts,
      1e3 * a.bias, 1e3 * a.sd, a.coverage, a.num_silent);
  std::fflush(stdout);
  EXPECT_GE(a.coverage, 0.9) << behaviour.name << " " << has_shape;
  EXPECT_LE(a.num_silent, a.num_contacts / 50) << behaviour.name << " " << has_shape;
}

TEST(EverydaySlow, ContactsAreCoveredOrNotUsableHoweverPeopleMove) {
  for (const bool has_shape : {true, false}) {
    for (const Behaviour& behaviour : kBehaviours) {
      CheckContacts(behaviour, has_shape, "report", MakeEverydayReach);
    }
  }
}

// What is stated of contacts was not chosen on these.
TEST(EverydaySlow, ContactsOfAStrangerAreCovered) {
  for (const bool has_shape : {true, false}) {
    CheckContacts(kBehaviours[0], has_shape, "stranger's report", MakeStrangerReach);
  }
}

// Objects that go where forces push them, by stiff skin and by soft pads: 200 contacts each.
TEST(EverydaySlow, ContactsWithObjectsThatArePushedAreCovered) {
  for (const bool has_shape : {true, false}) {
    for (const double pad_depth : {0.0, 0.5e-3}) {
      for (const double push : {0.0, 5e-3, 15e-3}) {
        StudyPlan plan;
        plan.seed = "pushed " + std::to_string(push) + " " + std::to_string(pad_depth);
        plan.make_reach = MakePushedReach;
        plan.has_shape = has_shape;
        plan.conditions.push = push;
        plan.conditions.pad_depth = pad_depth;
        const Accuracy a = CompareWithTruth(RunPlan(plan));
        std::printf(
            "push %2.0f mm, pad %.1f mm %s kept %d of %d, contacts %d, bias %.1f ms, SD %.1f ms, "
            "coverage %.3f, silent %d\n",
            1e3 * push, 1e3 * pad_depth, has_shape ? "shape   " : "no shape", a.num_kept,
            a.num_trials, a.num_contacts, 1e3 * a.bias, 1e3 * a.sd, a.coverage, a.num_silent);
        std::fflush(stdout);
        EXPECT_GE(a.coverage, 0.90) << push << " " << pad_depth << " " << has_shape;
        EXPECT_LE(50 * a.num_silent, a.num_contacts) << push << " " << pad_depth;
      }
    }
  }
}

constexpr int kNumStudies = 100;

void Print(const NamedPlan& named, const Verdicts& verdicts) {
  std::printf("%-40s more %3d less %3d not decided %3d no difference %3d none %d\n",
              named.name.c_str(), verdicts.num_more, verdicts.num_less, verdicts.num_not_decided,
              verdicts.num_no_difference, verdicts.num_none);
  std::fflush(stdout);
}

/** On seeds of their own, by a stranger's generator, which has families of profiles of its own. */
std::vector<NamedPlan> MadeByStranger(const std::vector<NamedPlan>& plans) {
  std::vector<NamedPlan> made;
  for (NamedPlan named : plans) {
    if (named.plan.conditions.family != SpeedProfile::Family::kWarped) continue;
    named.plan.seed = "stranger, " + named.plan.seed;
    named.plan.make_reach = MakeStrangerReach;
    made.push_back(named);
  }
  return made;
}

TEST(EverydaySlow, IndependentDigitsAreCalledMoreSimultaneousInTenPerCentAtMost) {
  for (const NamedPlan& named : ListIndependentPeople()) {
    const Verdicts verdicts = CountVerdictsOfEvents(named.plan, kNumStudies);
    Print(named, verdicts);
    EXPECT_LE(verdicts.num_more, kNumStudies / 10) << named.name;
    EXPECT_EQ(verdicts.num_none, 0) << named.name;
  }
}

TEST(EverydaySlow, DigitsThatShareADelayAreFoundInNinetyPerCent) {
  for (const NamedPlan& named : ListCoordinatedPeople()) {
    const Verdicts verdicts = CountVerdictsOfEvents(named.plan, kNumStudies);
    Print(named, verdicts);
    EXPECT_GE(verdicts.num_more, kNumStudies * 9 / 10) << named.name;
  }
}

/** One case by itself: each takes a minute of processor time. */
class IndependentPeople : public ::testing::TestWithParam<NamedPlan> {};
class CoordinatedPeople : public ::testing::TestWithParam<NamedPlan> {};

TEST_P(IndependentPeople, AreCalledMoreSimultaneousInTenPerCentAtMost) {
  const Verdicts verdicts = CountVerdicts(GetParam().plan, kNumStudies);
  Print(GetParam(), verdicts);
  EXPECT_LE(verdicts.num_more, kNumStudies / 10);
  EXPECT_EQ(verdicts.num_none, 0);
}

TEST_P(CoordinatedPeople, AreFoundInNinetyPerCent) {
  const Verdicts verdicts = CountVerdicts(GetParam().plan, kNumStudies);
  Print(GetParam(), verdicts);
  EXPECT_GE(verdicts.num_more, kNumStudies * 9 / 10);
}

std::string NameOfCase(const ::testing::TestParamInfo<NamedPlan>& info) {
  std::string name;
  for (const char c : info.param.name) {
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Everyday, IndependentPeople, ::testing::ValuesIn(ListIndependentPeople()),
                         NameOfCase);
INSTANTIATE_TEST_SUITE_P(Stranger, IndependentPeople,
                         ::testing::ValuesIn(MadeByStranger(ListIndependentPeople())), NameOfCase);
INSTANTIATE_TEST_SUITE_P(Everyday, CoordinatedPeople, ::testing::ValuesIn(ListCoordinatedPeople()),
                         NameOfCase);
INSTANTIATE_TEST_SUITE_P(Stranger, CoordinatedPeople,
                         ::testing::ValuesIn(MadeByStranger(ListCoordinatedPeople())), NameOfCase);

}  // namespace
}  // namespace graspbench::protocol

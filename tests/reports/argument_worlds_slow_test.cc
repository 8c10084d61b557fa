#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "tests/reports/argument_worlds.h"

namespace graspbench {
namespace {

constexpr int kNumWorlds = 100;
constexpr uint64_t kFirstSeed = 1000;  // seen: pairs of (d) were doubled after a first count

struct Named {
  int shown = 0, refuted = 0, open = 0;
};

Named CountNames(int claim, Truth truth, const WorldSize& size) {
  Named named;
  for (int i = 0; i < kNumWorlds; ++i) {
    const ArgumentVerdict verdict = NameWorld(claim, truth, size, kFirstSeed + i);
    ++(verdict == ArgumentVerdict::kShown     ? named.shown
       : verdict == ArgumentVerdict::kRefuted ? named.refuted
                                              : named.open);
  }
  return named;
}

class ArgumentWorlds : public testing::TestWithParam<int> {
 protected:
  int claim() const { return GetParam(); }
  const char* id() const { return kArgumentQuestions[claim()].id; }
};
INSTANTIATE_TEST_SUITE_P(Claims, ArgumentWorlds, testing::Range(0, kNumArgumentClaims));

TEST_P(ArgumentWorlds, AHundredOfEachTruthGetTheirName) {
  for (const Truth truth : {Truth::kTrue, Truth::kFalse, Truth::kAbsent}) {
    const Named named = CountNames(claim(), truth, SizeOf(truth));
    const char* const name = truth == Truth::kTrue    ? "true"
                             : truth == Truth::kFalse ? "false"
                                                      : "absent";
    std::printf("(%s) %s: shown %d, refuted %d, not decided %d\n", id(), name, named.shown,
                named.refuted, named.open);
    const int right = truth == Truth::kTrue    ? named.shown
                      : truth == Truth::kFalse ? named.refuted
                                               : named.open;
    EXPECT_GE(right, 95) << name;
    EXPECT_TRUE(truth != Truth::kAbsent || named.refuted == 0);
  }
}

// Effects between none and what the evidence resolves: from which size on they are decided. An
// effect of at least twice the smallest effect of interest is hardly ever refuted.
TEST_P(ArgumentWorlds, SmallEffectsAreDecidedFromTheirFloorOn) {
  struct Size {
    const char* name;
    double WorldSize::*effect;
    std::vector<double> values;
    double clear;  ///< twice the smallest effect of interest
  };
  const std::vector<Size> sizes = {
      {"shared SD [s]", &WorldSize::shared_sd, {0.01, 0.02, 0.03}, 0.03},
      {"", nullptr, {}, 0.0},  // a map's effects are drawn by its own generator
      {"share of lateness taken away", &WorldSize::taken_away, {0.1, 0.2, 0.3}, 0.3},
      {"gain of stability", &WorldSize::gain, {1.03, 1.06, 1.1}, 1.1},
      {"change of success", &WorldSize::success, {0.02, 0.04, 0.06}, 0.04}};
  const Size& size = sizes[static_cast<size_t>(claim())];
  for (const double value : size.values) {
    WorldSize planted = SizeOf(Truth::kFalse);
    planted.*size.effect = value;
    const Named named = CountNames(claim(), Truth::kTrue, planted);
    std::printf("(%s) %s %.2f: shown %d, refuted %d, not decided %d\n", id(), size.name, value,
                named.shown, named.refuted, named.open);
    EXPECT_TRUE(value < size.clear || named.refuted <= 5) << value;
  }
}

// What cannot be gained is not missing: nearly all succeed before, and a claim of more success is
// refuted only where the optimised grasps lose.
TEST(CeilingWorlds, AHundredWithoutEffectAreNotDecidedAndAHundredThatLoseAreRefuted) {
  WorldSize none = SizeOf(Truth::kFalse), loss = none;
  none.is_at_ceiling = loss.is_at_ceiling = true;
  loss.success = -0.1;
  const Named at_ceiling = CountNames(4, Truth::kFalse, none);
  const Named lost = CountNames(4, Truth::kFalse, loss);
  std::printf("(e) ceiling: shown %d, refuted %d, not decided %d; lost: refuted %d\n",
              at_ceiling.shown, at_ceiling.refuted, at_ceiling.open, lost.refuted);
  EXPECT_GE(at_ceiling.open, 95);
  EXPECT_GE(lost.refuted, 95);
}

}  // namespace
}  // namespace graspbench

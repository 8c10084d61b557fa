#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "datasets/analysis/conditions/threshold_summary.h"

namespace graspbench {
namespace {

using Held = std::set<int>;  // places with which a draw holds

GripThreshold Find(const Held& held) {
  return FindGripThreshold([&](int place) { return held.count(place) > 0; });
}

Held HeldFrom(int first, int last = kMostGripPlace) {
  Held held;
  for (int place = first; place <= last; ++place) held.insert(place);
  return held;
}

int CountTrials(const GripThreshold& found) {
  return static_cast<int>(found.failed.size() + found.succeeded.size());
}

TEST(GripThreshold, ScalesAreLogarithmic) {
  const ThresholdScale& margin = kThresholdScales[0];
  const ThresholdScale& force = kThresholdScales[1];
  EXPECT_DOUBLE_EQ(CalcGripAt(margin, 0), 1.0);
  EXPECT_DOUBLE_EQ(CalcGripAt(margin, 4), 2.0);
  EXPECT_DOUBLE_EQ(CalcGripAt(margin, 16), 16.0);
  EXPECT_DOUBLE_EQ(CalcGripAt(force, 0), 0.1);
  EXPECT_NEAR(CalcGripAt(force, 16), 12.8, 1e-12);
}

TEST(GripThreshold, FindsEveryThresholdOfAMonotoneDraw) {
  for (int truth = 0; truth <= kMostGripPlace; ++truth) {
    const GripThreshold found = Find(HeldFrom(truth));
    EXPECT_LE(CountTrials(found), kMostThresholdTrials);
    EXPECT_TRUE(found.is_monotone) << truth;
    EXPECT_EQ(found.place, truth);
    EXPECT_EQ(found.is_below_range, truth == 0);
    EXPECT_FALSE(found.next);
  }
}

TEST(GripThreshold, SaysThatNoGripHolds) {
  const GripThreshold never = Find({});
  EXPECT_FALSE(never.place);
  EXPECT_LE(CountTrials(never), kMostThresholdTrials);
}

// Nothing above the largest place is asked, and every threshold below it is found all the same.
TEST(GripThreshold, AsksNothingAboveTheLargestPlace) {
  for (int most = 0; most < kMostGripPlace; ++most) {
    for (int truth = 0; truth <= most + 1; ++truth) {
      const GripThreshold found = FindGripThreshold(
          [&](int place) {
            EXPECT_LE(place, most);
            return place >= truth;
          },
          most);
      EXPECT_LE(CountTrials(found), kMostThresholdTrials);
      EXPECT_EQ(found.place.has_value(), truth <= most) << truth << " of " << most;
      if (found.place) {
        EXPECT_EQ(*found.place, truth) << most;
      }
      EXPECT_TRUE(found.is_monotone);
    }
  }
}

// Held from 3 to 8 and from 13 on: bisection goes to the lower end and names the draw.
TEST(GripThreshold, NamesADrawThatFailsAgainAbove) {
  Held held = HeldFrom(3, 8);
  held.merge(HeldFrom(13));
  const GripThreshold found = Find(held);
  EXPECT_FALSE(found.is_monotone);
  EXPECT_EQ(found.place, 3);
}

// Squeezed out by every strong grip.
TEST(GripThreshold, FindsAGripThatIsNotTooStrong) {
  for (int last = 2; last < kMostGripPlace; ++last) {
    for (int first = 0; first <= last; ++first) {
      const Held held = HeldFrom(first, last);
      const GripThreshold found = Find(held);
      EXPECT_LE(CountTrials(found), kMostThresholdTrials);
      const bool can_be_found = std::any_of(
          held.begin(), held.end(), [](int k) { return k == 2 || k == 4 || k == 8 || k == 12; });
      EXPECT_EQ(found.place.has_value(), can_be_found) << first << " to " << last;
      if (!can_be_found) continue;
      EXPECT_TRUE(held.count(*found.place));
      EXPECT_FALSE(found.is_monotone);
      if (last < 12) {
        EXPECT_EQ(*found.place, first) << "to " << last;
      }
    }
  }
}

// Answer by answer, as trials that run one after the other, the same is found.
TEST(GripThreshold, SaysWhatMustBeAskedNext) {
  for (int truth = 0; truth <= kMostGripPlace; ++truth) {
    Held known;
    int num_asked = 0;
    GripThreshold found;
    do {
      found = FindGripThreshold([&](int place) {
        return known.count(place) > 0 ? std::optional<bool>(place >= truth) : std::nullopt;
      });
      if (!found.next) break;
      EXPECT_FALSE(found.place);
      EXPECT_TRUE(known.insert(*found.next).second) << "asked again";
    } while (++num_asked <= kMostThresholdTrials);
    EXPECT_EQ(found.place, truth);
  }
}

}  // namespace
}  // namespace graspbench

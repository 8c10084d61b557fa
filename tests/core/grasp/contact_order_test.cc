#include "core/grasp/contact_order.h"

#include <gtest/gtest.h>

#include <limits>

namespace graspbench {
namespace {

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

TEST(ContactOrder, NeighboursWithinTheirUncertaintyAreTied) {
  // 10 ms against 1.96 * 5 ms; 9 ms against 1.96 * 4.24 ms.
  const ContactOrder order = FindContactOrder({{"TH", true, 1.000},
                                               {"FF", false, 0.990},
                                               {"MF", false, 1.050},
                                               {"RF", false, kNever},
                                               {"LF", false, 1.059}},
                                              {0.004, 0.003, 0.003, 0.0, 0.003});
  EXPECT_EQ(order.Format(), "FF<TH<MF<LF");
  EXPECT_EQ(order.num_ties, 0);
  EXPECT_EQ(order.FindRank("FF"), 1);
  EXPECT_EQ(order.FindRank("LF"), 4);
  EXPECT_EQ(order.FindRank("RF"), 0);

  const ContactOrder tied = FindContactOrder(
      {{"TH", true, 1.000}, {"FF", false, 0.990}, {"MF", false, 2.0}}, {0.006, 0.003, 0.003});
  EXPECT_EQ(tied.Format(), "FF=TH<MF");
  EXPECT_EQ(tied.num_ties, 1);
  EXPECT_EQ(tied.FindRank("TH"), 1);
  EXPECT_EQ(tied.FindRank("MF"), 2);
}

TEST(ContactOrder, ExactTimesAreTiedWhenEqualAndOfNothingThereIsNone) {
  EXPECT_EQ(FindContactOrder({{"TH", true, 1.0}, {"FF", false, 1.0}}, {0.0, 0.0}).Format(),
            "TH=FF");
  EXPECT_EQ(FindContactOrder({{"TH", true, 1.0 + 1e-15}, {"FF", false, 1.0}}, {0.0, 0.0}).Format(),
            "FF<TH");
  EXPECT_EQ(FindContactOrder({{"TH", true, kNever}}, {kNever}).Format(), "");
  EXPECT_TRUE(FindContactOrder({}, {}).groups.empty());
}

}  // namespace
}  // namespace graspbench

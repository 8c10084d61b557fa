#include "datasets/analysis/hand_differences.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

const std::vector<std::string> kSixObjects = {"can", "cup", "ball", "cube", "box", "mug"};

/** Two draws of each object; "mine" fails in the first of each, the others never. */
Session MakeHands(const std::vector<std::string>& hands, const std::vector<std::string>& objects) {
  Session session = MakeSession(hands, objects, "g3", 2);
  for (TrialRecord& record : session.records) {
    const bool fails = record.plan.hand == "mine" && record.plan.trial == 0;
    if (fails) record.result.outcome = Outcome::kNoContact;
  }
  return session;
}

std::string DescribeOnly(const std::vector<HandDifference>& differences) {
  if (differences.size() != 1) return "expected one difference";
  return DescribeHandDifference(differences[0], "My hand", "TUM");
}

// Each object changes by -1/2, so that the interval is Newcombe's: Wilson's of 6 of 12 and of 12 of
// 12 are 0.254 to 0.746 and 0.757 to 1, their correlation is 0, and -0.5 - 0.246 = -0.746, -0.5 +
// sqrt(0.246^2 + 0.243^2) = -0.154. Of the 64 assignments of signs 2 are as extreme.
TEST(HandDifferences, AreOfTheSameDraws) {
  const Session session = MakeHands({"mine", "tum"}, kSixObjects);
  EXPECT_EQ(DescribeOnly(CompareHands(session, {"mine", "tum"})),
            "My hand minus TUM, 12 pairs of 6 objects: -50.0 points (-74.6 to -15.4), p 0.0312, "
            "significant");
  EXPECT_EQ(DescribeOnly(CompareHands(session, {"tum", "mine"})),
            "My hand minus TUM, 12 pairs of 6 objects: 50.0 points (15.4 to 74.6), p 0.0312, "
            "significant");
}

TEST(HandDifferences, OfThreeHandsAreAdjustedAfterHolm) {
  const Session session = MakeHands({"mine", "tum", "shadow"}, kSixObjects);
  const auto differences = CompareHands(session, {"mine", "tum", "shadow"});
  ASSERT_EQ(differences.size(), 3u);
  EXPECT_DOUBLE_EQ(differences[0].p, 2 * 0.03125);
  EXPECT_DOUBLE_EQ(differences[1].p, 2 * 0.03125);
  EXPECT_EQ(differences[2].hand, "tum");
  EXPECT_EQ(differences[2].other, "shadow");
  EXPECT_TRUE(std::isnan(differences[2].p));
  EXPECT_EQ(DescribeHandDifference(differences[2], "TUM", "Shadow"),
            "TUM minus Shadow, 12 pairs of 6 objects: success not testable: all 24 trials succeed");
}

TEST(HandDifferences, CountPairsThatAreMissing) {
  Session session = MakeHands({"mine", "tum"}, kSixObjects);
  session.records.pop_back();
  session.records.erase(session.records.begin());  // of another draw
  const std::string text = DescribeOnly(CompareHands(session, {"mine", "tum"}));
  EXPECT_EQ(text.find("My hand minus TUM, 10 of 12 pairs of 6 objects: -50.0 points ("), 0u)
      << text;
  EXPECT_TRUE(CompareHands(session, {"mine"}).empty());
}

TEST(HandDifferences, OfFewObjectsAreNotTestable) {
  const Session session = MakeHands({"mine", "tum"}, {"can", "cup", "ball", "cube", "box"});
  EXPECT_EQ(DescribeOnly(CompareHands(session, {"mine", "tum"})),
            "My hand minus TUM, 10 pairs of 5 objects: -50.0 points (-76.3 to -11.7), not testable "
            "with fewer than 6 objects");
  Session apart = session;  // the hands have no object in common
  for (size_t i = 0; i < apart.plan.size(); ++i) {
    if (apart.plan[i].hand != "tum") continue;
    apart.plan[i].object = apart.records[i].plan.object = "pen";
    apart.plan[i].trial = apart.records[i].plan.trial = static_cast<int>(i);
  }
  EXPECT_TRUE(CompareHands(apart, {"mine", "tum"}).empty());
}

TEST(HandDifferences, AreWrittenWithNullForWhatIsMissing) {
  const Session session = MakeSession({"mine", "tum"}, {"can"}, "g3", 2);
  const Json json = ToJson(CompareHands(session, {"mine", "tum"}));
  EXPECT_EQ(FormatJson(json),
            "[{\"hand\":\"mine\",\"other\":\"tum\",\"pairs\":2,\"planned_pairs\":2,\"objects\":1,"
            "\"rate_difference\":0.0,\"rate_difference_low\":null,\"rate_difference_high\":null,"
            "\"p\":null}]");
}

}  // namespace
}  // namespace graspbench

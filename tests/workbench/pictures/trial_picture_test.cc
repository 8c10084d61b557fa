#include "workbench/pictures/trial_picture.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/hand/load_hand.h"

namespace graspbench {

namespace {

/** Instants of 0.1 s up to lift-off, in which the trial ended. */
TracedTrial MakeTraced() {
  TracedTrial traced;
  traced.result.outcome = Outcome::kSlippedInLiftOff;
  traced.result.reason = "it stayed behind";
  const Phase phases[] = {Phase::kPlacing, Phase::kPlacing,       Phase::kClosure,
                          Phase::kClosure, Phase::kStabilisation, Phase::kLiftOff};
  for (const Phase phase : phases) {
    TraceInstant instant;
    instant.time = 0.1 * static_cast<double>(traced.trace.size());
    instant.phase = phase;
    traced.trace.push_back(instant);
  }
  return traced;
}

std::string FindMessage(const TracedTrial& traced, const std::string& name) {
  try {
    FindNamedInstant(traced, name);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(TrialPicture, InstantsHaveNamesAndTimes) {
  const TracedTrial traced = MakeTraced();
  const auto find = [&](const char* name) {
    return &FindNamedInstant(traced, name) - traced.trace.data();
  };
  EXPECT_EQ(find("pre-grasp"), 1) << "at the object";
  EXPECT_EQ(find("pregrasp"), 1);
  EXPECT_EQ(find("0s"), 0);
  EXPECT_EQ(find("placing"), 1);
  EXPECT_EQ(find("Closure"), 3);
  EXPECT_EQ(find("closed"), 4);
  EXPECT_EQ(find("lift-off"), 5);
  EXPECT_EQ(find("0.21s"), 2);
  EXPECT_EQ(find(".3"), 3);
  EXPECT_EQ(find(""), 4) << "the end of stabilisation";
  TracedTrial early = traced;
  early.trace.resize(3);
  EXPECT_EQ(&FindNamedInstant(early, ""), &early.trace.back());
}

TEST(TrialPicture, WhatWasNotReachedIsSaid) {
  const TracedTrial traced = MakeTraced();
  EXPECT_NE(FindMessage(traced, "hold").find("ended before its hold: slipped in lift-off"),
            std::string::npos);
  EXPECT_NE(FindMessage(traced, "0.6s").find("ended at 0.500 s"), std::string::npos);
  EXPECT_NE(FindMessage(traced, "clsed").find("did you mean \"closed\""), std::string::npos);
  EXPECT_NE(FindMessage(traced, "done").find("is not an instant"), std::string::npos);
  EXPECT_NE(FindMessage(TracedTrial(), "hold").find("could not begin"), std::string::npos);
}

TEST(TrialPicture, SizesAreTwoNumbers) {
  EXPECT_EQ(ParsePictureSize("640x480").width, 640);
  EXPECT_EQ(ParsePictureSize("640x480").height, 480);
  for (const char* text : {"", "640", "640x", "x480", "640x480x3", "0x480", "640x-1", "9999x10",
                           "640 x 480 ", "axb", "99999999999x3"}) {
    EXPECT_THROW(ParsePictureSize(text), Error) << text;
  }
}

/** The share of a panel that is not background. */
double CalcCover(const Image& image, int column, int row) {
  const int side = image.width / 3;
  int covered = 0;
  for (int y = row * side; y < (row + 1) * side; ++y) {
    for (int x = column * side; x < (column + 1) * side; ++x) {
      const uint8_t* pixel = &image.rgb[static_cast<size_t>(3 * (y * image.width + x))];
      covered += pixel[0] != 237 || pixel[1] != 238 || pixel[2] != 240;
    }
  }
  return static_cast<double>(covered) / (side * side);
}

// Pictures and contact shapes of a hand of the project cover each other, so both panels are filled
// alike and their union little more.
TEST(HandPictureTest, WhatTouchesIsWhereTheHandIsSeen) {
  const Image image = DrawHand(std::make_shared<const Hand>(LoadHand("tum")), {true, false});
  ASSERT_EQ(image.width * 2, image.height * 3);
  for (int row = 0; row < 2; ++row) {
    const double seen = CalcCover(image, 0, row), both = CalcCover(image, 1, row),
                 touched = CalcCover(image, 2, row);
    EXPECT_GT(seen, 0.05);
    EXPECT_GT(touched, 0.05);
    EXPECT_LT(both, 1.5 * std::max(seen, touched));
    EXPECT_GE(both, std::max(seen, touched));
    EXPECT_LT(both, 0.98);
  }
}

/** Whether the rim of a panel is all background. */
bool HasFreeRim(const Image& image, int column, int row) {
  const int side = image.width / 3;
  for (int k = 0; k < side; ++k) {
    for (const auto& [x, y] : {std::pair{k, 0}, {k, side - 1}, {0, k}, {side - 1, k}}) {
      const int at = 3 * ((row * side + y) * image.width + column * side + x);
      if (image.rgb[static_cast<size_t>(at)] != 237) return false;
    }
  }
  return true;
}

// The Shadow Hand has a forearm.
TEST(HandPictureTest, TheWholeHandIsInThePicture) {
  for (const char* id : {"tum", "shadow"}) {
    const Image image = DrawHand(std::make_shared<const Hand>(LoadHand(id)), {true, false});
    for (int panel = 0; panel < 6; ++panel) {
      EXPECT_TRUE(HasFreeRim(image, panel % 3, panel / 3)) << id << ", panel " << panel;
    }
  }
}

}  // namespace

}  // namespace graspbench

#pragma once
/** @file
Things that are not in the catalogue, with the type of grasp that suits each by the words of the
method alone: "large, roundish or heavy = power; thin or small = two finger precision; in between =
all finger precision". Sizes are standards or what shops sell. Types and reasons were written before
the rule of SuggestGraspType was tried on any of them, and are not to be changed by what it says. */

namespace graspbench {

enum class HeldOutShape { kBox, kBall, kStanding, kLying };  ///< the last two are cylinders

struct HeldOutThing {
  const char* name;
  HeldOutShape shape;
  double length_mm, width_mm, height_mm;  ///< of a cylinder its bounding box, as it rests
  double mass_g;
  int type;  ///< 1 all finger precision, 2 two finger precision, 3 power
  const char* reason;
};

inline constexpr HeldOutThing kHeldOutThings[] = {
    {"table tennis ball", HeldOutShape::kBall, 40, 40, 40, 2.7, 1, "round, between"},
    {"squash ball", HeldOutShape::kBall, 40, 40, 40, 24, 1, "round, between"},
    {"billiard ball", HeldOutShape::kBall, 57.2, 57.2, 57.2, 170, 3, "round and heavy"},
    {"baseball", HeldOutShape::kBall, 74, 74, 74, 145, 3, "large and round"},
    {"orange", HeldOutShape::kBall, 75, 75, 75, 180, 3, "large and round"},
    {"marble", HeldOutShape::kBall, 16, 16, 16, 5, 2, "small"},
    {"cherry tomato", HeldOutShape::kBall, 25, 25, 25, 10, 2, "small"},
    {"ice hockey puck", HeldOutShape::kStanding, 76, 76, 25, 165, 3, "large, round, heavy"},
    {"tuna can", HeldOutShape::kStanding, 85, 85, 35, 200, 3, "large, round, heavy"},
    {"toilet roll", HeldOutShape::kStanding, 110, 110, 100, 100, 3, "large and round"},
    {"yoghurt cup", HeldOutShape::kStanding, 75, 75, 80, 160, 3, "large and round"},
    {"drinking glass", HeldOutShape::kStanding, 70, 70, 120, 300, 3, "large, round, heavy"},
    {"spray can", HeldOutShape::kStanding, 52, 52, 190, 250, 3, "round and heavy"},
    {"jar lid", HeldOutShape::kStanding, 70, 70, 15, 20, 3, "large and round"},
    {"salt shaker", HeldOutShape::kStanding, 40, 40, 80, 150, 1, "between"},
    {"film canister", HeldOutShape::kStanding, 32, 32, 50, 10, 1, "between"},
    {"wine cork", HeldOutShape::kStanding, 24, 24, 45, 4, 2, "small"},
    {"coin of two euros", HeldOutShape::kStanding, 25.75, 25.75, 2.2, 8.5, 2, "small and thin"},
    {"compact disc", HeldOutShape::kStanding, 120, 120, 1.2, 16, 2, "thin"},
    {"battery AA", HeldOutShape::kLying, 50.5, 14.5, 14.5, 23, 2, "small"},
    {"battery D", HeldOutShape::kLying, 61.5, 34.2, 34.2, 140, 1, "between"},
    {"lipstick", HeldOutShape::kLying, 72, 19, 19, 25, 2, "thin"},
    {"glue stick", HeldOutShape::kLying, 110, 26, 26, 40, 1, "between"},
    {"candle", HeldOutShape::kLying, 200, 22, 22, 75, 2, "thin"},
    {"chopstick", HeldOutShape::kLying, 230, 7, 7, 8, 2, "thin"},
    {"screw M10", HeldOutShape::kLying, 60, 10, 10, 35, 2, "small and thin"},
    {"piece of broomstick", HeldOutShape::kLying, 300, 28, 28, 110, 1, "between"},
    {"playing die", HeldOutShape::kBox, 16, 16, 16, 5, 2, "small"},
    {"brick of a toy, 2 x 4", HeldOutShape::kBox, 31.8, 15.8, 11.4, 2.5, 2, "small"},
    {"domino", HeldOutShape::kBox, 48, 24, 8, 10, 2, "small and thin"},
    {"memory stick", HeldOutShape::kBox, 58, 19, 9, 10, 2, "small and thin"},
    {"toothbrush", HeldOutShape::kBox, 190, 14, 16, 18, 2, "thin"},
    {"ruler", HeldOutShape::kBox, 310, 30, 3, 20, 2, "thin"},
    {"pack of cigarettes", HeldOutShape::kBox, 88, 55, 22, 25, 1, "neither roundish nor heavy"},
    {"deck of cards", HeldOutShape::kBox, 92, 64, 18, 95, 1, "neither roundish nor heavy"},
    {"audio cassette", HeldOutShape::kBox, 109, 69, 16, 75, 1, "neither roundish nor heavy"},
    {"bar of soap", HeldOutShape::kBox, 90, 55, 30, 100, 1, "between"},
    {"mobile phone", HeldOutShape::kBox, 147, 71, 8, 175, 1, "neither roundish nor small"},
    {"stapler", HeldOutShape::kBox, 130, 35, 55, 200, 1, "between"},
    {"packet of butter", HeldOutShape::kBox, 100, 65, 40, 250, 3, "large and heavy"},
    {"puzzle cube", HeldOutShape::kBox, 57, 57, 57, 100, 3, "large, as long as wide and high"},
    {"tea box", HeldOutShape::kBox, 140, 75, 70, 100, 3, "large"},
    {"paperback", HeldOutShape::kBox, 178, 110, 25, 250, 3, "large and heavy"},
};

/** Scanned ones, where they are present (GRASPBENCH_DATA). */
struct HeldOutScan {
  const char* folder;
  int type;
  const char* reason;
};

inline constexpr HeldOutScan kHeldOutScans[] = {
    {"002_master_chef_can", 3, "large, round, heavy"},
    {"003_cracker_box", 3, "large and heavy"},
    {"005_tomato_soup_can", 3, "round and heavy"},
    {"011_banana", 1, "between"},
    {"016_pear", 3, "large and roundish"},
    {"021_bleach_cleanser", 3, "large and heavy"},
    {"048_hammer", 3, "large and heavy"},
    {"065-d_cups", 3, "large and round"},
};

}  // namespace graspbench

#include "workbench/pictures/scene_film.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

size_t CountFrames(const std::string& webp) {
  size_t count = 0;  // chunks of the container
  for (size_t at = webp.find("ANMF"); at != webp.npos; at = webp.find("ANMF", at + 4)) ++count;
  return count;
}

TEST(SceneFilm, HasAPictureForEveryInstantAndItsMarks) {
  const auto hand = std::make_shared<const Hand>(LoadHand("tum"));
  const auto object = LoadObject("golf_ball", FieldUse::kLater);
  const auto make_film = [&](bool is_marked) {
    SceneFilm film(hand, object);
    for (int i = 0; i < 3; ++i) {
      film.Add(0.1 * i, Eigen::VectorXd::Zero(hand->num_joints()),
               MakePose(Eigen::Vector3d(0.0, 0.0, 0.3 + 0.01 * i)), Pose::Identity());
      ContactMark mark;
      mark.force_W = Eigen::Vector3d::UnitX();
      mark.mu = 0.5;
      if (is_marked) film.Mark({mark}, 0.04);
    }
    return film;
  };
  size_t told = 0;
  const auto tell = [&told](size_t num_drawn) {
    told = num_drawn;
    return true;
  };
  const std::string bytes = make_film(false).Encode(SceneView(), 64, 48, tell);
  EXPECT_EQ(told, 3u);
  EXPECT_EQ(CountFrames(bytes), 3u);
  EXPECT_NE(bytes, make_film(true).Encode(SceneView(), 64, 48, tell)) << "marks are seen";
  EXPECT_EQ(bytes, make_film(false).Encode(SceneView(), 64, 48, tell));
  EXPECT_EQ(make_film(false).Encode(SceneView(), 64, 48, [](size_t) { return false; }), "");
}

}  // namespace
}  // namespace graspbench

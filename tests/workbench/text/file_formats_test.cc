#include "workbench/text/file_formats.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/yaml.h"
#include "core/grasp/grasp_file.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "core/hand/tactile_yaml.h"
#include "datasets/pipeline/pipeline_file.h"
#include "datasets/plan/session_config.h"
#include "objects/object_file.h"
#include "workbench/text/new_files.h"

namespace graspbench {
namespace {

const FileKeys& FindKeys(const std::string& name) {
  for (const FileFormat& format : ListFileFormats()) {
    if (format.name == name) return format.keys;
  }
  throw Error(ErrorKind::kNotFound, name);
}

// The reader asks for exactly the keys that have a row, with the defaults that stand there.
void ExpectSameKeys(const FileKeys& read, const FileKeys& rows) {
  for (const FileKey& key : read) {
    const FileKey* row = FindFileKey(rows, key.key);
    ASSERT_NE(row, nullptr) << key.key << " is read and has no row";
    EXPECT_EQ(row->fallback, key.fallback) << key.key;
  }
  for (const FileKey& row : rows) {
    EXPECT_NE(FindFileKey(read, row.key), nullptr) << row.key << " has a row and is not read";
  }
}

TEST(FileFormatsTest, EveryKeyHasAMeaning) {
  ASSERT_EQ(ListFileFormats().size(), 9u);
  for (const FileFormat& format : ListFileFormats()) {
    EXPECT_FALSE(format.keys.empty()) << format.name;
    for (const FileKey& key : format.keys) EXPECT_NE(key.meaning, "") << format.name << key.key;
  }
}

TEST(FileFormatsTest, EverySettingOfRunIsExplained) {
  for (const std::string& key : ListConfigKeys(SessionConfig())) {
    const std::string text = ExplainFileKey(key);
    EXPECT_EQ(text.find(key + "\n  "), 0u) << text;
    EXPECT_NE(text.find("\n  default "), text.npos) << text;
    EXPECT_NE(text.find("session.yaml"), text.npos) << text;
    EXPECT_NE(text.find("graspbench run --set " + key + "=VALUE\n"), text.npos) << text;
  }
}

TEST(FileFormatsTest, ASettingIsExplainedWithUnitRangeDefaultAndPlace) {
  EXPECT_EQ(ExplainFileKey("sim.step_s"),
            "sim.step_s\n"
            "  time step of the physics\n"
            "  unit     s\n"
            "  range    0.0001 to 0.01\n"
            "  default  0.002\n"
            "  set in   session.yaml, sweep.yaml, profile.yaml\n"
            "  or by    graspbench run --set sim.step_s=VALUE\n");
  // A number without unit.
  const std::string scale = ExplainFileKey("model.friction_scale");
  EXPECT_NE(scale.find("  unit     none\n  range    0 to 10\n  default  1.0\n"), scale.npos)
      << scale;
  // A key of another file is set there only.
  const std::string mass = ExplainFileKey("mass_kg");
  EXPECT_NE(mass.find("object.yaml"), mass.npos) << mass;
  EXPECT_EQ(mass.find("--set"), mass.npos) << mass;
  EXPECT_EQ(ExplainFileKey("model.friction_scal"), "");
}

TEST(FileFormatsTest, AMisspeltSettingOrItsLastPartSuggestsItsName) {
  const std::string suggestion = "; did you mean \"model.friction_scale\"?";
  EXPECT_EQ(SuggestFileKeys("model.frction_scale", {"run"}), suggestion);
  EXPECT_EQ(SuggestFileKeys("friction_scale", {"run"}), suggestion);
  EXPECT_EQ(SuggestFileKeys("rum", {"run"}), "; did you mean \"run\"?");
}

TEST(FileFormatsTest, ObjectsAreReadByTheirRows) {
  KeyRecorder recorder;
  EXPECT_THROW(ParseObjectFile("best_grasp: {}\n", "object.yaml"), Error);
  ExpectSameKeys(recorder.keys(), FindKeys("object.yaml"));
}

TEST(FileFormatsTest, HandsAreReadByTheirRows) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "hand_read_by_its_rows";
  std::filesystem::create_directories(folder);
  const std::vector<NewFile> files = MakeNewFiles("hand");
  const std::string yaml = files[1].second +
                           "coupling: {rule: even, joints: {}}\nmimic: [{}]\nsurfaces: "
                           "[{}]\nframes: [{}]\npads: [{}]\ncamera: {}\n";
  KeyRecorder recorder;
  Diagnostics problems;
  ParseHand(files[0].second, yaml, folder, problems);
  Diagnostics sliding;
  ParseHand(files[0].second, "drives: [{stiffness_n_per_m: 1}]\n", folder, sliding);
  for (const NewFile& file : files) WriteFile(folder / file.first, file.second);
  std::string with_closing = files[1].second;
  with_closing.insert(with_closing.find("    pre_deg:"), "    closing: {TH: {}}\n");
  WriteFile(folder / files[1].first, with_closing);
  LoadStandardGrasps(LoadHand(folder.string()));
  ExpectSameKeys(recorder.keys(), FindKeys("hand.yaml"));
}

TEST(FileFormatsTest, TactileElementsAreReadByTheirRows) {
  KeyRecorder recorder;
  Diagnostics problems;
  ParseTactile("surfaces: [{elements: [{}]}]\n", "tactile.yaml", Hand(), problems);
  ExpectSameKeys(recorder.keys(), FindKeys("tactile.yaml"));
}

TEST(FileFormatsTest, GraspsAreReadByTheirRows) {
  const Hand hand = LoadHand("tum");
  KeyRecorder recorder;
  EXPECT_THROW(
      ParseGraspFile("digits: [TH]\nclosing: {TH: {}}\nplacement: {}\n", "grasp.yaml", {&hand}),
      Error);
  ExpectSameKeys(recorder.keys(), FindKeys("grasp.yaml"));
}

TEST(FileFormatsTest, PipelinesAreReadByTheirRows) {
  KeyRecorder recorder;
  EXPECT_THROW(ParsePipeline("stages: {a: {}}\n", "pipeline.yaml", {}), Error);
  ExpectSameKeys(recorder.keys(), FindKeys("pipeline.yaml"));
}

}  // namespace
}  // namespace graspbench

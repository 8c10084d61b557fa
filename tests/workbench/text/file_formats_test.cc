#include "workbench/text/file_formats.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/arm/load_arm.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/yaml.h"
#include "core/grasp/grasp_file.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "core/hand/tactile.h"
#include "datasets/benchmark/benchmark_file.h"
#include "datasets/pipeline/pipeline_file.h"
#include "human_study/recording/importers/table_mapping.h"
#include "objects/object_file.h"
#include "workbench/experiments/policies/policy_server.h"
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

TEST(FileFormatsTest, EveryKeyAndColumnHasAMeaning) {
  for (const FileFormat& format : ListFileFormats()) {
    EXPECT_FALSE(format.keys.empty()) << format.name;
    for (const FileKey& key : format.keys) EXPECT_NE(key.meaning, "") << format.name << key.key;
  }
  for (const TableFormat& table : ListTableFormats()) {
    EXPECT_FALSE(table.columns.empty()) << table.name;
    for (const TableColumn& column : table.columns) {
      EXPECT_NE(column.type, "") << table.name << column.name;
      EXPECT_NE(column.meaning, "") << table.name << " " << column.name;
    }
  }
}

TEST(FileFormatsTest, ANameFitsTheWordInCapitals) {
  const TableColumn column = {"open_without_DIGIT_m", "number", "m", ""};
  EXPECT_TRUE(IsNameOf(column, "open_without_DIGIT_m"));
  EXPECT_TRUE(IsNameOf(column, "open_without_TH_m"));
  EXPECT_FALSE(IsNameOf(column, "open_without_m"));
  EXPECT_FALSE(IsNameOf({"JOINT_rad", "number", "rad", ""}, "draw_yaw_rad"));
  EXPECT_FALSE(IsNameOf({"gft_s", "number", "s", ""}, "gct_s"));
}

TEST(FileFormatsTest, ObjectsAreReadByTheirRows) {
  KeyRecorder recorder;
  EXPECT_THROW(ParseObjectFile("best_grasp: {}\ncompressible: {}\n", "object.yaml"), Error);
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

TEST(FileFormatsTest, ArmsAreReadByTheirRows) {
  KeyRecorder recorder;
  Diagnostics problems;
  ParseArm("joints: [{}]\ncapsules: [{}]\n", "arm", problems);
  ExpectSameKeys(recorder.keys(), FindKeys("arm.yaml"));
}

TEST(FileFormatsTest, GraspsAreReadByTheirRows) {
  const Hand hand = LoadHand("tum");
  KeyRecorder recorder;
  EXPECT_THROW(ParseGraspFile("digits: [TH]\nclosing: {TH: {}}\nplacement: {}\ncourse: {}\n",
                              "grasp.yaml", {&hand}),
               Error);
  ExpectSameKeys(recorder.keys(), FindKeys("grasp.yaml"));
}

TEST(FileFormatsTest, PolicyServersAreReadByTheirRows) {
  const std::string path = (std::filesystem::path(testing::TempDir()) / "rows.yaml").string();
  WriteFile(path, "observation: {a: {}}\nactions: {}\n");
  KeyRecorder recorder;
  EXPECT_THROW(LoadPolicyServer(path), Error);
  ExpectSameKeys(recorder.keys(), FindKeys("policy.yaml"));
}

TEST(FileFormatsTest, MappingsAreReadByTheirRows) {
  const std::string path = (std::filesystem::path(testing::TempDir()) / "columns.yaml").string();
  WriteFile(path, "rate_hz: 100\npoints: {tip: [a, b, c]}\n");
  KeyRecorder recorder;
  LoadTableMapping(path);
  FileKeys read = recorder.keys();
  for (const char* key : {"channels", "glove"}) read.push_back({key, "", ""});  // looked for first
  ExpectSameKeys(read, FindKeys("columns.yaml"));
}

TEST(FileFormatsTest, PipelinesAreReadByTheirRows) {
  KeyRecorder recorder;
  EXPECT_THROW(ParsePipeline("stages: {a: {}}\n", "pipeline.yaml", {}), Error);
  ExpectSameKeys(recorder.keys(), FindKeys("pipeline.yaml"));
}

TEST(FileFormatsTest, BenchmarksAreReadByTheirRows) {
  KeyRecorder recorder;
  EXPECT_THROW(ParseBenchmark("about: a\n", "benchmark.yaml"), Error);
  ExpectSameKeys(recorder.keys(), FindKeys("benchmark.yaml"));
}

const FileFormat kFormat = {
    "pot.yaml",
    "a pot",
    {{"name", kRequired, "what a person calls it"},
     {"lid", "false", KeyType::kBoolean, "true of one with a lid"},
     {"handles", "", KeyType::kList, "list of its handles"},
     {"handles.width_m", kRequired, "across the fist", kAboveZero, 0.5},
     {"handles.bolt_m", kRequired, KeyType::kNumberOfSome, "of handles that are bolted on"},
     {"parts", "", KeyType::kMap, "a map: the name of a part, and what it is"},
     {"parts.mass_kg", kRequired, "of the part without its bolts", 0.001},
     {"grips.ID.tilt_deg", "0", "turn of the hand"}}};

TEST(FileSchemaTest, NestsListsMapsAndNames) {
  const Json schema = MakeFileSchema(kFormat);
  EXPECT_EQ(schema["required"], Json::array({"name"}));
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["properties"]["lid"]["type"], "boolean");
  const Json& handles = schema["properties"]["handles"];
  EXPECT_EQ(handles["type"], "array");
  const Json& width = handles["items"]["properties"]["width_m"]["anyOf"][0];
  EXPECT_EQ(width["exclusiveMinimum"], 0);
  EXPECT_EQ(width["maximum"], 0.5);
  const Json& part = schema["properties"]["parts"]["additionalProperties"];
  EXPECT_EQ(part["required"], Json::array({"mass_kg"}));
  EXPECT_EQ(part["properties"]["mass_kg"]["anyOf"][0]["minimum"], 0.001);
  const Json& grip = schema["properties"]["grips"]["additionalProperties"];
  EXPECT_TRUE(grip["properties"].contains("tilt_deg"));
}

TEST(FileSchemaTest, NeedsOfAnEntryWhatAllEntriesNeed) {
  const Json schema = MakeFileSchema(kFormat);
  // "bolt_m" is needed of some: the reader knows of which.
  EXPECT_EQ(schema["properties"]["handles"]["items"]["required"], Json::array({"width_m"}));
  EXPECT_EQ(schema["properties"]["handles"]["description"], "list of its handles");
}

}  // namespace
}  // namespace graspbench

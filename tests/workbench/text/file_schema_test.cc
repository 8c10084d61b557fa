#include "workbench/text/file_schema.h"

#include <gtest/gtest.h>

#include <string>

namespace graspbench {
namespace {

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

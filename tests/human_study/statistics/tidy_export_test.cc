#include "human_study/statistics/tidy_export.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/text/json.h"
#include "tests/human_study/faults.h"

namespace graspbench {
namespace {

MeasureTable MakeAwkwardTable() {
  MeasureTable table;
  table.measure = "grasp_forming_time_s";
  table.unit = "s";
  table.description = "last first touch minus first";
  table.factors = {{"object", {"cup, \"blue\"", "box"}, {}, "what was grasped"},
                   {"width", {"30 mm", "60 mm"}, {0.03, 0.06}, ""}};
  table.rows = {{"P1", "1", {"box", "60 mm"}, 0.1},
                {"P 2", "2", {"cup, \"blue\"", "30 mm"}, std::nan("")}};
  return table;
}

TEST(TidyExport, OneRowATrialAndMeasure) {
  MeasureTable second = MakeAwkwardTable();
  second.measure = "grasp_forming_ratio";
  second.unit = "";
  second.rows.resize(1);
  second.rows[0].value = 1e-20;
  const TidyExport files = FormatTidyExport({MakeAwkwardTable(), second});
  EXPECT_EQ(files.csv,
            "person,trial,object,width,width_number,measure,value\n"
            "P1,1,box,60 mm,0.06,grasp_forming_time_s,0.1\n"
            "P 2,2,\"cup, \"\"blue\"\"\",30 mm,0.03,grasp_forming_time_s,\n"
            "P1,1,box,60 mm,0.06,grasp_forming_ratio,1e-20\n");
  const Json dictionary = Json::parse(files.dictionary);
  ASSERT_EQ(dictionary["fields"].size(), 7u);  // one entry a column
  EXPECT_EQ(dictionary["fields"][2]["description"], "what was grasped");
  EXPECT_EQ(dictionary["fields"][3]["constraints"]["enum"],
            (std::vector<std::string>{"30 mm", "60 mm"}));
  EXPECT_FALSE(dictionary["fields"][4].contains("constraints"));
  EXPECT_EQ(dictionary["measures"][0]["unit"], "s");
  EXPECT_EQ(dictionary["measures"][1]["name"], "grasp_forming_ratio");
  ExpectHolds(files.r_script, "factors <- c(\"object\", \"width\")\n");
  ExpectHolds(files.r_script, "\"object\" = c(\"cup, \\\"blue\\\"\", \"box\")");
}

void ExpectError(const std::vector<MeasureTable>& measures, const std::string& message) {
  try {
    FormatTidyExport(measures);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kFormat);
    EXPECT_EQ(error.what(), message);
  }
}

TEST(TidyExport, SaysWhatDoesNotFit) {
  ExpectError({}, "no measure to export");
  MeasureTable table = MakeAwkwardTable();
  table.factors[0].name = "value";
  ExpectError({table}, "tidy.csv would have two columns \"value\"; rename the factor");
  table.factors[0].name = "width_number";
  ExpectError({table}, "tidy.csv would have two columns \"width_number\"; rename the factor");
  table = MakeAwkwardTable();
  table.measure = "other";
  table.factors[1].numbers = {};
  ExpectError({MakeAwkwardTable(), table},
              "measures \"grasp_forming_time_s\" and \"other\" have different factors; "
              "export them apart");
  table = MakeAwkwardTable();
  table.rows[0].levels[0] = "bowl";
  ExpectError({table},
              "measure \"grasp_forming_time_s\": person \"P1\", trial \"1\": \"bowl\" is not a "
              "level of factor \"object\"");
}

}  // namespace
}  // namespace graspbench

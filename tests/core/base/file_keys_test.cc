#include "core/base/file_keys.h"

#include <gtest/gtest.h>

#include "core/base/config.h"
#include "core/base/text/yaml.h"

namespace graspbench {
namespace {

TEST(FileKeysTest, TheEndOfAKeyNamesItsUnit) {
  EXPECT_EQ(FindUnit("mass_kg"), "kg");
  EXPECT_EQ(FindUnit("density_kg_per_m3"), "kg/m3");
  EXPECT_EQ(FindUnit("drives.stiffness_nm_per_rad"), "N m/rad");
  EXPECT_EQ(FindUnit("drives.stiffness_n_per_m"), "N/m");
  EXPECT_EQ(FindUnit("drives.force_limit_n"), "N");
  EXPECT_EQ(FindUnit("movement.speed_threshold_m_per_s"), "m/s");
  EXPECT_EQ(FindUnit("slide_accuracy_mm"), "mm");
  EXPECT_EQ(FindUnit("camera.blur_px"), "px");
  EXPECT_EQ(FindUnit("camera.noise_grey_levels"), "grey levels");
  EXPECT_EQ(FindUnit("pad_offsets_m.thumb"), "m");
  EXPECT_EQ(FindUnit("friction_static"), "");
  EXPECT_EQ(FindUnit("_m"), "");
}

TEST(FileKeysTest, RangesAreWrittenAsTheyAreChecked) {
  const FileKey any = {"a", "", ""}, both = {"a", "", "", 0.5, 2},
                positive = {"a", "", "", kAboveZero}, share = {"a", "", "", kAboveZero, 1},
                least = {"a", "", "", 3};
  EXPECT_EQ(FormatRange(any), "");
  EXPECT_EQ(FormatRange(both), "0.5 to 2");
  EXPECT_EQ(FormatRange(positive), "above 0");
  EXPECT_EQ(FormatRange(share), "above 0, at most 1");
  EXPECT_EQ(FormatRange(least), "at least 3");
  EXPECT_TRUE(IsInRange(both, 0.5) && IsInRange(both, 2.0) && IsInRange(positive, 1e-300));
  EXPECT_FALSE(IsInRange(both, 2.1) || IsInRange(positive, 0.0) || IsInRange(any, std::nan("")));
}

TEST(FileKeysTest, AReaderChecksTheRangesOfItsRows) {
  const FileKeys keys = {{"a", "1", "number", 0, 5},
                         {"part.b_m", kRequired, "three", -1, 1},
                         {"part.c", "", "several", 0, 1}};
  Diagnostics problems;
  const YAML::Node root = ParseYaml("a: 7\npart:\n  b_m: [0, 2, 0]\n  c: [1, -1]\n", "f", problems);
  YamlMap map(root, "f", "thing", problems, &keys);
  double a = 1.0;
  Eigen::Vector3d b;
  std::vector<double> c;
  KeyRecorder recorder;
  map.Read("a", a, Needed::kNo);
  YamlMap part(map.Child("part"), "f", "part", problems, &keys, "part.");
  part.Read("b_m", b);
  part.Read("c", c, Needed::kNo);
  EXPECT_EQ(problems.Format(),
            "f:1: error: thing, a: 7 is out of range; expected 0 to 5\n"
            "f:3: error: part, b_m: 2 is out of range; expected -1 to 1\n"
            "f:4: error: part, c: -1 is out of range; expected 0 to 1");
  ASSERT_EQ(recorder.keys().size(), 4u);
  EXPECT_EQ(recorder.keys()[0].fallback, "1");
  EXPECT_EQ(recorder.keys()[1].key, "part");
  EXPECT_EQ(recorder.keys()[2].key, "part.b_m");
  EXPECT_EQ(recorder.keys()[2].fallback, kRequired);
}

struct Pair {
  double known = 2.0, unset = std::nan("");
  std::vector<double> list = {1.0, 2.0};

  template <class V>
  void Visit(V&& v) {
    v("known", known, {"k", 0, 5});
    v("unset", unset, {"u", 0, 5});
    v("list", list, {"l", 0, 5});
  }
};

TEST(FileKeysTest, ConfigurationsBringTheirDefaults) {
  const FileKeys rows = DescribeConfig(Pair());
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].key + rows[1].key + rows[2].key, "knownunsetlist");
  EXPECT_EQ(rows[0].fallback, "2.0");
  EXPECT_EQ(rows[1].fallback, "");
  EXPECT_EQ(rows[2].fallback, "[1.0, 2.0]");

  Pair pair;
  EXPECT_TRUE(FindOutOfRange(pair, rows).empty());  // what is not given is not out of range
  pair.known = std::nan("");
  pair.unset = -1.0;
  pair.list = {1.0, 6.0};
  const auto found = FindOutOfRange(pair, rows);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].second, "nan is out of range; expected 0 to 5");
  EXPECT_EQ(found[1].second, "-1 is out of range; expected 0 to 5");
  EXPECT_EQ(found[2].second, "6 is out of range; expected 0 to 5");
}

}  // namespace
}  // namespace graspbench

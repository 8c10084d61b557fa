#include "datasets/benchmark/benchmark_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "core/base/config.h"
#include "tests/datasets/benchmark/tiny_benchmark.h"
#include "tests/datasets/find_error.h"

namespace graspbench {
namespace {

// Its objects are of no catalogue, and of one seed, which held-out draws change.
TEST(BenchmarkFileTest, HeldOutDrawsOfUnseenObjectsHaveOtherObjects) {
  const Benchmark unseen = LoadBenchmark("graspbench-unseen/1");
  EXPECT_EQ(unseen.objects.size(), 24u);
  const SessionConfig held_out = MakeHeldOut(unseen.session, 4711);
  EXPECT_EQ(held_out.seed, 4711);
  EXPECT_EQ(unseen.session.objects[0], "synthetic_1_g1_0");
  EXPECT_EQ(held_out.objects[0], "synthetic_4711_g1_0");
  const SessionInputs inputs = LoadHeldOut(unseen, 4711);
  for (size_t i = 0; i < inputs.objects.size(); ++i) {
    EXPECT_NE(inputs.objects[i]->content_hash, unseen.objects[i].second);
  }
  EXPECT_EQ(MakeHeldOut(MakeTinyBenchmark().session, 7).objects,
            (std::vector<std::string>{"golf_ball", "tea_light"}));
}

// A released benchmark stays: a change of a hand, an object or the physics needs a new version.
TEST(BenchmarkFileTest, TheProgramIsThatOfEveryShippedBenchmark) {
  ASSERT_FALSE(ListBenchmarks().empty());
  for (const std::string& name : ListBenchmarks()) {
    const Benchmark benchmark = LoadBenchmark(name);
    EXPECT_EQ(benchmark.name, name);
    EXPECT_EQ(LoadBenchmark(NameBenchmarkFile(name)).sha256, benchmark.sha256);
    EXPECT_EQ(FindError([&] { LoadPinned(benchmark); }), "");
  }
}

TEST(BenchmarkFileTest, TheDefaultHasTheSettingsAndObjectsOfTheBenchmarkPreset) {
  const Benchmark benchmark = LoadBenchmark(kDefaultBenchmark);
  SessionConfig preset = LoadPreset("benchmark");
  EXPECT_EQ(benchmark.objects.size(), 21u);
  preset.objects = benchmark.session.objects;
  EXPECT_TRUE(HaveEqualValues(benchmark.session, preset));
}

TEST(BenchmarkFileTest, AnotherHandObjectOrPhysicsIsNamed) {
  const Benchmark tiny = MakeTinyBenchmark();
  const SessionInputs inputs = LoadPinned(tiny);
  Benchmark other = tiny;
  other.objects[1].second = "0123456789abcdef";
  EXPECT_TRUE(Throws(
      [&] { CheckPins(other, inputs); }, ErrorKind::kVersion,
      "object tea_light: hash " + tiny.objects[1].second + " here, pinned 0123456789abcdef"));
  other = tiny;
  other.hands[0].first = "shadow";
  EXPECT_TRUE(
      Throws([&] { CheckPins(other, inputs); }, ErrorKind::kVersion,
             "hand tum: hash " + tiny.hands[0].second + " here, not one of the benchmark's"));
  other = tiny;
  other.physics += 1;
  EXPECT_TRUE(Throws([&] { CheckPins(other, inputs); }, ErrorKind::kVersion,
                     "is of physics version " + std::to_string(other.physics)));
}

TEST(BenchmarkFileTest, OnlyOpenSettingsMayDiffer) {
  const Benchmark tiny = MakeTinyBenchmark();
  SessionConfig config = tiny.session;
  config.grasps = {"g1"};
  config.strategy.grip = "posture";
  EXPECT_EQ(FindError([&] { CheckSettings(tiny, config); }), "");
  config.seed = 2;
  config.hands = {"tum", "shadow"};
  config.objects = {"golf_ball"};
  config.sim.step = 0.001;
  config.conditions = {{"a", {"model.mass_scale=2.0"}}};
  config.arm.model = "/elsewhere/arm";
  const std::string text = FindError([&] { CheckSettings(tiny, config); });
  for (const char* part : {"hands: \"shadow\"", "seed: 1 and 2", "sim.step_s: 0.002 and 0.001",
                           "objects: [\"golf_ball\",\"tea_light\"] and [\"golf_ball\"]",
                           "arm.model: \"/elsewhere/arm\". Known: pa10, puma560", "conditions"}) {
    EXPECT_TRUE(Has(text, part));
  }
}

TEST(BenchmarkFileTest, EveryFaultIsNamed) {
  const auto find = [](const std::string& text) {
    return FindError([&] { ParseBenchmark(text, "b.yaml"); });
  };
  EXPECT_EQ(find(MakeTinyText()), "");
  EXPECT_TRUE(Has(find(MakeTinyText("colour: red\n")), "unknown key \"colour\""));
  EXPECT_TRUE(Has(find(MakeTinyText("commitment: abc\n")), "expected 64 hexadecimal digits"));
  const std::string text = find(
      "name: a\nphysics: 0\nopen: [grasp]\nhands: {tum: 12}\nobjects: [can]\n"
      "session: {hands: [tum], trials: 0}\n");
  for (const char* part : {"physics", "no setting \"grasp\"; did you mean \"grasps\"",
                           "\"tum\": expected each id once", "expected a map of ids", "trials"}) {
    EXPECT_TRUE(Has(text, part));
  }
  EXPECT_TRUE(
      Throws([] { LoadBenchmark("graspbench-21/9"); }, ErrorKind::kNotFound, "graspbench-21/1"));
}

TEST(BenchmarkFileTest, ItsHashIsOfWhatItSaysAndNotOfItsLayout) {
  const std::string text = MakeTinyText();
  const std::string sha256 = ParseBenchmark(text, "b.yaml").sha256;
  EXPECT_EQ(ParseBenchmark("# a comment\n" + text, "c.yaml").sha256, sha256);
  EXPECT_NE(
      ParseBenchmark(MakeTinyText("commitment: " + std::string(64, '0') + "\n"), "b.yaml").sha256,
      sha256);
}

TEST(BenchmarkFileTest, ACommitmentHas64HexadecimalDigitsInEitherCase) {
  const std::string digits = "49ac969b9923d926e47d4da71f644c3aa2dd25da8d1506ddeb603d8a587076df";
  std::string upper = digits;
  std::transform(upper.begin(), upper.end(), upper.begin(), ::toupper);
  EXPECT_EQ(ReadCommitment(digits), digits);
  EXPECT_EQ(ReadCommitment(upper), digits);
  const auto parse = [](const std::string& text) {
    return ParseBenchmark(MakeTinyText("commitment: " + text + "\n"), "b.yaml");
  };
  EXPECT_EQ(parse(upper).commitment, digits);
  EXPECT_EQ(parse(upper).sha256, parse(digits).sha256);
  for (const std::string& wrong : {std::string("00"), digits.substr(1) + "g", digits + "0"}) {
    EXPECT_TRUE(Throws([&] { ReadCommitment(wrong); }, ErrorKind::kUsage,
                       "\"" + wrong + "\" is no SHA-256; expected 64 hexadecimal digits"));
  }
}

// printf 'tiny/1 7 a nonce of letters' | sha256sum
TEST(BenchmarkFileTest, ACommitmentIsTheSha256OfNameSeedAndNonce) {
  EXPECT_EQ(CalcCommitment("tiny/1", 7, "a nonce of letters"),
            "49ac969b9923d926e47d4da71f644c3aa2dd25da8d1506ddeb603d8a587076df");
}

}  // namespace
}  // namespace graspbench

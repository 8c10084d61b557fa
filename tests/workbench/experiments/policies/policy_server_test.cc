// What policy.yaml maps, by hand; pictures as PIL resizes them.

#include "workbench/experiments/policies/policy_server.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/sessions/test_folder.h"
#include "workbench/experiments/policies/resize_picture.h"

namespace graspbench {
namespace {

using Names = std::vector<std::string>;

PackedValue MakeNames(const Names& names) {
  PackedValue::List list;
  for (const std::string& name : names) list.push_back({name});
  return {list};
}

PackedValue MakeFacts() {
  return {PackedValue::Map{{"object", {std::string("can")}},
                           {"joints", MakeNames({"a", "b", "c"})},
                           {"driven", MakeNames({"a", "c"})}}};
}

PolicyValues MakeObservation() {
  return {{"time", {{}, {0.5}}},
          {"joint_positions", {{3}, {1, 2, 3}}},
          {"targets", {{2}, {0.25, 0.75}}},
          {"camera", {{1, 2, 3}, {10, 20, 30, 40, 50, 60.4}}}};
}

PolicyServer MakeMapped() {
  PolicyServer server;
  server.source = "policy.yaml";
  server.is_mapped = true;
  return server;
}

PackedValue Ask(const PolicyServer& server) {
  return ParseMessagePack(ServerExchange(server, MakeFacts()).FormatQuestion(MakeObservation()));
}

PolicyAction Read(const PolicyServer& server, const PackedValue& answer) {
  MessagePackWriter writer;
  writer.Value(answer);
  return ServerExchange(server, MakeFacts()).ReadAnswer(MakeObservation(), writer.bytes());
}

PackedValue MakeRows(std::vector<size_t> shape, std::vector<double> values) {
  return {PackedValue::Map{{"actions", {PackedArray{std::move(shape), std::move(values)}}},
                           {"server_timing", {PackedValue::Map{{"infer_ms", {1.0}}}}}}};
}

std::vector<double> ListNumbers(const PackedValue* value) {
  return value ? ReadPackedArray(*value, "value").values : std::vector<double>();
}

TEST(PolicyServer, PutsObservationsUnderTheServersKeys) {
  PolicyServer server = MakeMapped();
  server.observation = {{"observation/state", "", {"joint_positions"}, {"c", "a"}, "", {}, ""},
                        {"prompt", "", {}, {}, "", {}, "grasp the {object}"},
                        {"cam", "images", {"camera"}, {}, "", {}, ""},
                        {"two", "", {"time", "targets"}, {}, "float64", {}, ""}};
  const PackedValue question = Ask(server);
  EXPECT_EQ(ListNumbers(question.Find("observation/state")), (std::vector<double>{3, 1}));
  EXPECT_EQ(ListNumbers(question.Find("two")), (std::vector<double>{0.5, 0.25, 0.75}));
  EXPECT_EQ(*question.Find("prompt")->text(), "grasp the can");
  const PackedValue* picture = question.Find("images")->Find("cam");
  EXPECT_EQ(ListNumbers(picture), (std::vector<double>{10, 20, 30, 40, 50, 60}));
  EXPECT_EQ(std::get<PackedArray>(picture->value).shape, (std::vector<size_t>{1, 2, 3}));
}

TEST(PolicyServer, AnAddressAloneKeepsTheNamesAndGivesTheFactsOnce) {
  PolicyServer server;
  ServerExchange exchange(server, MakeFacts());
  const auto ask = [&] { return ParseMessagePack(exchange.FormatQuestion(MakeObservation())); };
  const PackedValue first = ask();
  EXPECT_EQ(*first.Find("reset")->Find("object")->text(), "can");
  EXPECT_EQ(ListNumbers(first.Find("targets")), (std::vector<double>{0.25, 0.75}));
  EXPECT_EQ(std::get<PackedArray>(first.Find("camera")->value).values.back(), 60.0) << "bytes";
  EXPECT_EQ(ask().Find("reset"), nullptr);
  EXPECT_TRUE(Read(server, {PackedValue::Map{{"done", {true}}, {"policy_timing", {1.0}}}}).is_done);
  EXPECT_EQ(Read(server, MakeRows({2, 2}, {1, 2, 3, 4})).rows(1, 0), 3.0);
}

TEST(PolicyServer, ReadsColumnsByName) {
  PolicyServer server = MakeMapped();
  server.actions.columns = {"c", "-", "done"};
  PolicyAction action = Read(server, MakeRows({2, 3}, {0.5, 9, 0, 0.6, 9, 1}));
  EXPECT_FALSE(action.is_done);  // the second row says it: the next answer comes before
  ASSERT_EQ(action.rows.rows(), 1);
  EXPECT_EQ(action.rows(0, 0), 0.25);  // no column: as it was asked for last
  EXPECT_EQ(action.rows(0, 1), 0.5);
  action = Read(server, MakeRows({3}, {0.5, 9, 1}));
  EXPECT_TRUE(action.is_done);
  server.actions.are_increments = true;
  EXPECT_EQ(Read(server, MakeRows({3}, {0.5, 9, 0})).rows(0, 0), 0.0);
}

TEST(PolicyServer, ColumnsMoveTheHandAndHold) {
  PolicyServer server = MakeMapped();
  server.actions.columns = {"hand.vz", "c", "hold"};
  PolicyAction action = Read(server, MakeRows({2, 3}, {0.1, 0.5, 0, 0.2, 0.6, 1}));
  ASSERT_EQ(action.twists.rows(), 1);  // the second row holds: the next answer comes before
  EXPECT_EQ(action.twists(0, 2), 0.1);
  EXPECT_EQ(action.twists.cwiseAbs().sum(), 0.1);
  EXPECT_EQ(action.rows(0, 1), 0.5);
  EXPECT_FALSE(action.hold);
  action = Read(server, MakeRows({3}, {0.0, 0.5, 1}));
  EXPECT_EQ(action.hold, GripMode::kMargin);
  server.actions.columns = ListPoseColumns();
  action = Read(server, MakeRows({7}, {0.1, 0.2, 0.3, 0.0, 0.0, 0.0, 1.0}));
  ASSERT_EQ(action.poses.size(), 1u);
  EXPECT_EQ(action.poses[0].translation().z(), 0.3);
  EXPECT_EQ(action.rows.rows(), 0);  // the digits stay
}

TEST(PolicyServer, IsCheckedBeforeATrial) {
  Hand hand;
  hand.id = "two";
  hand.joints.resize(3);
  for (int j = 0; j < 3; ++j) hand.joints[static_cast<size_t>(j)].name = std::string(1, "abc"[j]);
  hand.joints[1].coupled_to = 0;
  const auto find_fault = [&](const PolicyServer& server, const std::string& moves) {
    PolicyConfig policy;
    policy.moves = moves;
    try {
      CheckPolicyServer(server, hand, policy);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  PolicyServer server = MakeMapped();
  EXPECT_EQ(find_fault(server, "digits"), "");
  EXPECT_NE(find_fault(server, "hand-and-digits").find("no column moves the hand"),
            std::string::npos);
  EXPECT_NE(find_fault(server, "digits-until-touch").find("no column is hold"), std::string::npos);
  server.actions.columns = {"hand.vx", "a", "hold"};
  EXPECT_EQ(find_fault(server, "hand-and-digits"), "");
  EXPECT_EQ(find_fault(server, "digits-until-touch"), "");
  server.actions.columns = {"a", "b"};  // follows joint a
  EXPECT_NE(find_fault(server, "digits").find("actions, columns: the hand two has no joint \"b\""),
            std::string::npos);
  server.actions.columns = {};
  server.observation = {{"x", "", {"joint_positions"}, {"d"}, "", {}, ""}};
  EXPECT_NE(find_fault(server, "digits").find("observation, x, joints: the hand two has no joint"),
            std::string::npos);
}

TEST(PolicyServer, WrongAnswersAreFaults) {
  const PolicyServer server = MakeMapped();
  const std::pair<PackedValue, std::string> cases[] = {
      {MakeRows({1, 3}, {1, 2, 3}), "has the shape (1, 3); expected one row or more of 2"},
      {MakeRows({1, 1, 2}, {1, 2}), "has the shape"},
      {MakeRows({2}, {1, std::nan("")}), "holds NaN"},
      {{PackedValue::Map{{"action", {1.0}}}}, "has no actions"},
      {{PackedValue::Map{{"actions", {std::string("left")}}}}, "no array of numbers"},
      {{1.0}, "has no actions"}};
  for (const auto& [answer, reason] : cases) {
    try {
      Read(server, answer);
      ADD_FAILURE() << reason;
    } catch (const PolicyFault& fault) {
      EXPECT_NE(std::string(fault.what()).find(reason), std::string::npos) << fault.what();
    }
  }
  EXPECT_THROW(ServerExchange(server, MakeFacts()).ReadAnswer(MakeObservation(), "\xc1"),
               PolicyFault);
}

TEST(PolicyServer, WhatTheTrialDoesNotGiveIsNoOutcome) {
  const ServerValue values[] = {{"x", "", {"taxels"}, {}, "", {}, ""},
                                {"x", "", {"joint_positions"}, {"d"}, "", {}, ""},
                                {"x", "", {"time"}, {}, "", {8, 8}, ""},
                                {"x", "", {}, {}, "", {}, "grasp {it}"}};
  for (const ServerValue& value : values) {
    PolicyServer server = MakeMapped();
    server.observation = {value};
    try {
      Ask(server);
      ADD_FAILURE();
    } catch (const PolicyLost& error) {
      EXPECT_EQ(std::string(error.what()).find("policy.yaml: observation, x"), 0u) << error.what();
    }
  }
}

PolicyServer Load(const std::string& text) {
  const TestFolder folder("policy_server");
  const std::string path = (folder.path() / "policy.yaml").string();
  std::ofstream(path) << text;
  return LoadPolicyServer(path);
}

TEST(PolicyServer, ReadsAFile) {
  const PolicyServer server = Load(
      "server: ws://localhost:8000\n"
      "observation:\n"
      "  observation/state: {from: joint_positions, dtype: float64}\n"
      "  cam: {from: [time, targets], under: images}\n"
      "  prompt: {text: hold it}\n"
      "actions: {as: increments, columns: [FFJ3, done]}\n");
  EXPECT_EQ(server.address.host, "localhost");
  EXPECT_EQ(server.address.port, "8000");
  ASSERT_EQ(server.observation.size(), 3u);
  EXPECT_EQ(server.observation[1].under, "images");
  EXPECT_EQ(server.observation[1].from, (Names{"time", "targets"}));
  EXPECT_TRUE(server.actions.are_increments);
  EXPECT_EQ(server.actions.columns, (Names{"FFJ3", "done"}));
}

TEST(PolicyServer, ReportsAllThatIsWrongInAFile) {
  try {
    Load(
        "server: http://here\n"
        "observation:\n"
        "  a: {from: joint_position}\n"
        "  b: {from: time, text: x}\n"
        "  c: {from: time, dtype: int3, size: [0, 3]}\n"
        "  d: {fron: time}\n"
        "  e: {from: time, dtype: uint8}\n"
        "actions: {as: angles, columns: [hand.x, a, a]}\n");
    ADD_FAILURE();
  } catch (const Error& error) {
    const std::string text = error.what();
    for (const char* part :
         {"policy.yaml:1", "did you mean \"joint_positions\"", "either from or text", "\"int3\"",
          "[height, width]", "did you mean \"from\"", "uint8 is the type of a picture",
          "targets or increments", "more than once",
          "a pose of the hand needs all of hand.x, hand.y"}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
  }
}

TEST(PolicyServer, KnowsItsAddresses) {
  for (const char* text : {"ws://127.0.0.1:8000", "ws://[::1]:80/infer", "wss://a", "dir/p.yaml"}) {
    EXPECT_TRUE(IsPolicyServer(text)) << text;
  }
  for (const char* text : {"python3 p.py", "python3 p.py c.yaml", "./serve", ".yaml"}) {
    EXPECT_FALSE(IsPolicyServer(text)) << text;
  }
  const ServerAddress address = LoadPolicyServer("ws://[::1]:81/infer").address;
  EXPECT_EQ(address.host + " " + address.port + " " + address.path, "::1 81 /infer");
  EXPECT_EQ(LoadPolicyServer("ws://a").address.port, "80");
  for (const char* text :
       {"wss://a:1", "ws://", "ws://:8000", "ws://a:b", "ws://a:99999", "ws://a b", "ws://u@a"}) {
    EXPECT_THROW(LoadPolicyServer(text), Error) << text;
  }
}

TEST(ResizePicture, KeepsTheWholePictureInTheMiddle) {
  // 2 x 4 of one colour in 4 x 4: half the height, rows of black above and below.
  BytePicture picture = {2, 4, std::vector<uint8_t>(24, 200)};
  const BytePicture same = ResizeWithPadding(picture, 4, 4);
  for (size_t i = 0; i < same.rgb.size(); ++i) {
    const size_t row = i / 12;
    EXPECT_EQ(same.rgb[i], row == 1 || row == 2 ? 200 : 0) << i;
  }
  // A row of 4 in 2: weights 3/8, 3/8, 1/8 and what stands beyond the edge left out (3, 3, 1 of 7).
  picture = {1, 4, {0, 0, 0, 70, 70, 70, 140, 140, 140, 210, 210, 210}};
  const BytePicture half = ResizeWithPadding(picture, 1, 2);
  EXPECT_EQ(half.rgb[0], 50);   // (3 x 0 + 3 x 70 + 140) / 7
  EXPECT_EQ(half.rgb[3], 160);  // (70 + 3 x 140 + 3 x 210) / 7
}

// Of PIL 9.4, resize(.., BILINEAR), pasted as openpi's resize_with_pad does: the red channel, and
// the sum of all.
TEST(ResizePicture, GivesTheBytesOfPil) {
  BytePicture picture = {5, 7, {}};
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 7; ++column) {
      for (int colour = 0; colour < 3; ++colour) {
        picture.rgb.push_back(static_cast<uint8_t>((37 * row + 91 * column + 53 * colour) % 256));
      }
    }
  }
  const auto list_red = [](const BytePicture& resized, size_t row) {
    std::vector<int> values;
    for (size_t i = 0; i < resized.width; ++i) {
      values.push_back(resized.rgb[3 * (row * resized.width + i)]);
    }
    return values;
  };
  const auto sum_up = [](const BytePicture& resized) {
    int sum = 0;
    for (const uint8_t value : resized.rgb) sum += value;
    return sum;
  };
  const BytePicture small = ResizeWithPadding(picture, 4, 4);
  EXPECT_EQ(list_red(small, 0), (std::vector<int>{0, 0, 0, 0}));
  EXPECT_EQ(list_red(small, 1), (std::vector<int>{81, 118, 124, 115}));
  EXPECT_EQ(list_red(small, 2), (std::vector<int>{147, 101, 121, 111}));
  EXPECT_EQ(sum_up(small), 3114);
  const BytePicture large = ResizeWithPadding(picture, 9, 12);
  EXPECT_EQ(list_red(large, 0),
            (std::vector<int>{0, 34, 87, 140, 161, 65, 44, 97, 150, 192, 96, 34}));
  EXPECT_EQ(list_red(large, 4),
            (std::vector<int>{86, 120, 173, 88, 23, 76, 130, 183, 118, 33, 86, 120}));
  EXPECT_EQ(list_red(large, 8), std::vector<int>(12, 0));
  EXPECT_EQ(sum_up(large), 37380);
}

}  // namespace
}  // namespace graspbench

#include "core/quality/contacts_json.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/files/files.h"

namespace graspbench {
namespace {

std::string FindMessage(const std::string& text) {
  try {
    ParseQualityRequest(text, "c.json");
  } catch (const Error& error) {
    EXPECT_EQ(ExitCodeOf(error.kind()), kExitBadInput);
    return error.what();
  }
  return "";
}

/** A file of two good contacts, the second with `changed` in place of its mu. */
std::string WithSecondContact(const std::string& changed) {
  return "{\"contacts\": [{\"p_m\": [0.03, 0, 0], \"n\": [-1, 0, 0], \"mu\": 0.5},\n"
         "{\"p_m\": [-0.03, 0, 0], \"n\": [1, 0, 0], " +
         changed + "}], \"torque_scale_m\": 0.05}";
}

TEST(ContactsJson, ReadsEverything) {
  const QualityRequest request = ParseQualityRequest(
      R"({"contacts": [
        {"p_m": [0.03, 0, 0.01], "n": [-1, 0, 0], "mu": 0.5, "torsion_m": 0.002, "t": [0, 1, 0]},
        {"p_m": [-0.03, 0, 0], "n": [1, 0, 0], "mu": 0}],
        "edges": 12, "torque_scale_m": 0.05, "reference_m": [0, 0, 0.1], "convention": "graspit"})",
      "c.json");
  ASSERT_EQ(request.contacts.size(), 2u);
  EXPECT_EQ(request.contacts[0].p_OC, Eigen::Vector3d(0.03, 0.0, 0.01));
  EXPECT_EQ(request.contacts[0].nhat_O, Eigen::Vector3d(-1.0, 0.0, 0.0));
  EXPECT_EQ(request.contacts[0].mu, 0.5);
  EXPECT_EQ(request.contacts[0].torsion, 0.002);
  EXPECT_EQ(request.contacts[0].first_edge_O, Eigen::Vector3d(0.0, 1.0, 0.0));
  EXPECT_EQ(request.contacts[1].torsion, 0.0);
  EXPECT_FALSE(request.contacts[1].first_edge_O.has_value());
  EXPECT_EQ(request.num_edges, 12);
  EXPECT_EQ(request.torque_scale, 0.05);
  EXPECT_EQ(request.p_OR, Eigen::Vector3d(0.0, 0.0, 0.1));
  EXPECT_EQ(request.convention.id, "graspit");
}

TEST(ContactsJson, MissingPartsHaveDefaults) {
  const QualityRequest request = ParseQualityRequest(WithSecondContact("\"mu\": 0.5"), "c.json");
  EXPECT_EQ(request.convention.id, "ferrari-canny");
  EXPECT_FALSE(request.num_edges.has_value());
  EXPECT_EQ(request.p_OR, Eigen::Vector3d::Zero());
}

TEST(ContactsJson, NamesTheContact) {
  const std::pair<const char*, const char*> cases[] = {
      {"\"mu\": -0.5", "the friction coefficient is -0.5; expected 0 to 100"},
      {"\"mu\": NaN", "mu: expected a finite number"},
      {"\"mu\": -Infinity", "mu: expected a finite number"},
      {"\"mu\": \"0.5\"", "mu: expected a finite number"},
      {"\"mu\": 0.5, \"t\": [0, NaN, 1]", "t: expected three finite numbers in brackets"},
      {"\"mu\": 0.5, \"t\": [2, 0, 0]",
       "the direction of the first cone edge is zero or along the normal; expected a tangent"},
      {"\"torsion_m\": 0.1", "the key \"mu\" is missing"},
      {"\"mu\": 0.5, \"torsion\": 0.1",
       "unknown key \"torsion\"; did you mean \"torsion_m\"? Known: p_m, n, mu, torsion_m, t"}};
  for (const auto& [changed, problem] : cases) {
    EXPECT_EQ(FindMessage(WithSecondContact(changed)),
              "c.json is not a usable set of contacts:\nc.json: error: contacts[1]: " +
                  std::string(problem));
  }
}

TEST(ContactsJson, TellsAllProblemsAtOnce) {
  EXPECT_EQ(FindMessage(R"({"contacts": [1, {"p_m": [1, 2], "mu": 0.5}], "edges": 7.5,
                            "torque_scale_m": "1", "convention": "simx", "colour": "red"})"),
            "c.json is not a usable set of contacts:\n"
            "c.json: error: contacts[0]: expected an object with the keys p_m, n, mu\n"
            "c.json: error: contacts[1]: p_m: expected three finite numbers in brackets\n"
            "c.json: error: contacts[1]: the key \"n\" is missing\n"
            "c.json: error: edges: expected a whole number\n"
            "c.json: error: torque_scale_m: expected a finite number\n"
            "c.json: error: convention: no quality convention \"simx\"; did you mean \"simox\"? "
            "Known: ferrari-canny, graspit, simox, dexgraspbench, dex-net, frogger\n"
            "c.json: error: unknown key \"colour\". Known: contacts, edges, torque_scale_m, "
            "reference_m, convention");
}

TEST(ContactsJson, RefusesWhatIsNoSetOfContacts) {
  EXPECT_EQ(FindMessage("[]"), "c.json: expected an object {\"contacts\": [...], ...}");
  EXPECT_EQ(FindMessage("{\"contacts\": [")
                .rfind("c.json is not valid JSON: parse error at line 1, column 15: ", 0),
            0u);
  EXPECT_NE(FindMessage("").find("c.json is not valid JSON: "), std::string::npos);
  EXPECT_NE(FindMessage(WithSecondContact("\"mu\": 1e999")).find("not valid JSON"),
            std::string::npos);
  EXPECT_NE(FindMessage("{\"contacts\": {}}").find("contacts: expected a list in brackets"),
            std::string::npos);
}

// The word is replaced outside strings only.
TEST(ContactsJson, NaNInsideAStringStays) {
  EXPECT_NE(FindMessage(R"({"\"NaN": 1, "contacts": []})").find("unknown key \"\"NaN\""),
            std::string::npos);
}

TEST(ContactsJson, FuzzFindsAreRefusedOrComputed) {
  const std::filesystem::path cases = "tests/fuzz/cases/contacts_json";
  int num_cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FindDataRoot() / cases)) {
    ++num_cases;
    try {
      CalcGraspQuality(ParseQualityRequest(ReadFile(entry.path()), "case"));
    } catch (const Error& error) {
      EXPECT_EQ(ExitCodeOf(error.kind()), kExitBadInput) << entry.path() << error.what();
    }
  }
  EXPECT_GE(num_cases, 5);
}

}  // namespace
}  // namespace graspbench

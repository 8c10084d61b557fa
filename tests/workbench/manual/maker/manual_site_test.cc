#include "workbench/manual/maker/manual_site.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <set>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "workbench/program.h"
#include "workbench/terminal/command_line.h"
#include "workbench/text/file_formats.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class ManualSiteTest : public testing::Test {
 protected:
  ManualSiteTest() {
    AddCommands(program_);
    fs::create_directories(folder_);
    fs::copy(FindDataRoot() / "workbench" / "manual", folder_ / "source",
             fs::copy_options::recursive);
  }
  ~ManualSiteTest() override {
    std::error_code status;
    fs::remove_all(folder_, status);
  }
  void Write() { WriteManual(program_, folder_ / "source", folder_ / "out"); }
  void Append(const std::string& page, const std::string& text) {
    const fs::path file = folder_ / "source" / "pages" / page;
    WriteFile(file, ReadFile(file) + text);
  }
  std::string Complain() {
    try {
      Write();
    } catch (const Error& error) {
      return error.what();
    }
    return "no complaint";
  }

  Command program_;
  fs::path folder_ = fs::path(testing::TempDir()) / ("manual_site_" + std::to_string(::getpid()));
};

TEST_F(ManualSiteTest, EveryPageIsFoundFromTheContentsAndAsksNoNetwork) {
  Write();
  const std::string index = ReadFile(folder_ / "out" / "index.html");
  for (const ManualPage& page : ListManualPages()) {
    EXPECT_NE(index.find("href=\"" + page.id + ".html\""), index.npos) << page.id;
    const std::string text = ReadFile(folder_ / "out" / (page.id + ".html"));
    EXPECT_NE(text.find("default-src 'none'"), text.npos) << page.id;
    EXPECT_EQ(text.find("src=\"http"), text.npos) << page.id;
    EXPECT_EQ(text.find("<link"), text.npos) << page.id;
  }
}

void AddOptionNames(const Command& command, std::set<std::string>& names) {
  for (const auto& each : command.subcommands()) {
    for (const auto& option : each->options()) names.insert(option->name());
    AddOptionNames(*each, names);
  }
}

// What has a name is found by it: an option, a key or a column without a row and an anchor of its
// name, a heading that is there twice, or a row without meaning cannot be.
TEST_F(ManualSiteTest, EveryOptionKeyAndColumnStandsOnItsPage) {
  Write();
  std::map<std::string, std::set<std::string>> names;
  AddOptionNames(program_, names["options"]);
  names["options"].erase("--help");
  for (const FileFormat& format : ListFileFormats()) {
    for (const FileKey& key : format.keys) names["keys"].insert(key.key);
  }
  for (const TableFormat& table : ListTableFormats()) {
    for (const TableColumn& column : table.columns) names["columns"].insert(column.name);
  }
  EXPECT_GT(names["options"].size(), 90u);
  EXPECT_GT(names["keys"].size(), 300u);
  EXPECT_GT(names["columns"].size(), 200u);
  const std::string index = ReadFile(folder_ / "out" / "index.html");
  for (const auto& [id, rows] : names) {
    const std::string page = ReadFile(folder_ / "out" / (id + ".html"));
    for (const std::string& name : rows) {
      EXPECT_NE(page.find("<tr id=\"" + name + "\">"), page.npos) << id << " " << name;
      EXPECT_NE(index.find("\"" + id + ".html#" + name + "\""), index.npos) << id << " " << name;
    }
    EXPECT_EQ(page.find("</code></td><td class=\"prose\"></td>"), page.npos) << id;
    std::set<std::string> anchors;
    for (size_t at = page.find(" id=\""); at != page.npos; at = page.find(" id=\"", at + 1)) {
      const std::string anchor = page.substr(at + 5, page.find('"', at + 5) - at - 5);
      EXPECT_TRUE(anchors.insert(anchor).second) << id << " " << anchor;
    }
  }
}

TEST_F(ManualSiteTest, LinksThatLeadNowhereAreNamed) {
  const std::pair<const char*, const char*> cases[] = {
      {"[x](glossary.md#no-such-heading)",
       "limits.html: the link \"glossary.html#no-such-heading\" leads to no heading"},
      {"[x](nowhere.md)", "\"nowhere.md\" leads to no page"}};
  for (const auto& [link, fault] : cases) {
    Append("limits.md", "\n" + std::string(link) + "\n");
    EXPECT_NE(Complain().find(fault), std::string::npos) << Complain();
  }
}

TEST_F(ManualSiteTest, OutcomesAndExitCodesStandInTables) {
  const std::string page = MakeReference("outcomes", program_);
  EXPECT_NE(page.find("| dropped while holding | `DH` |"), page.npos);
  EXPECT_EQ(page.find("not run"), page.npos);
  EXPECT_NE(page.find("| 75 | "), page.npos);
}

TEST_F(ManualSiteTest, EveryPageOfTheFolderIsInTheContents) {
  for (const auto& entry : fs::directory_iterator(folder_ / "source" / "pages")) {
    const std::string id = entry.path().stem().string();
    const auto& pages = ListManualPages();
    EXPECT_TRUE(std::any_of(pages.begin(), pages.end(),
                            [&](const ManualPage& page) { return page.id == id; }))
        << id << ": add it to workbench/manual/contents.inc";
  }
}

}  // namespace
}  // namespace graspbench

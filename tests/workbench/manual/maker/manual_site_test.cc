#include "workbench/manual/maker/manual_site.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "workbench/program.h"
#include "workbench/terminal/command_line.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class ManualSiteTest : public testing::Test {
 protected:
  ManualSiteTest() {
    AddCommands(program_, exit_code_);
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

  ExitCode exit_code_ = kExitOk;
  Command program_;
  fs::path folder_ = fs::path(testing::TempDir()) / ("manual_site_" + std::to_string(::getpid()));
};

TEST_F(ManualSiteTest, EveryPageIsWrittenAndFoundFromTheContents) {
  Write();
  const std::string index = ReadFile(folder_ / "out" / "index.html");
  for (const ManualPage& page : ListManualPages()) {
    EXPECT_TRUE(fs::is_regular_file(folder_ / "out" / (page.id + ".html"))) << page.id;
    EXPECT_NE(index.find("href=\"" + page.id + ".html\""), index.npos) << page.id;
  }
}

TEST_F(ManualSiteTest, NoPageAsksTheNetwork) {
  Write();
  for (const auto& entry : fs::directory_iterator(folder_ / "out")) {
    const std::string page = ReadFile(entry.path());
    EXPECT_NE(page.find("default-src 'none'"), page.npos) << entry.path();
    EXPECT_EQ(page.find("src=\"http"), page.npos) << entry.path();
    EXPECT_EQ(page.find("<link"), page.npos) << entry.path();
  }
}

TEST_F(ManualSiteTest, LinksThatLeadNowhereAreNamed) {
  Append("limits.md", "\n[x](nowhere.md)\n");
  EXPECT_NE(Complain().find("\"nowhere.md\" leads to no page"), std::string::npos) << Complain();
}

TEST_F(ManualSiteTest, AnchorsThatLeadNowhereAreNamed) {
  Append("limits.md", "\n[x](glossary.md#no-such-heading)\n");
  EXPECT_EQ(Complain(),
            "limits.html: the link \"glossary.html#no-such-heading\" leads to no heading");
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

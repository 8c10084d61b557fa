#include "workbench/pictures/svg_to_pdf.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "core/base/error.h"
#include "core/base/files/files.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

/** A search path of one folder, in which a script takes the converter's place. */
class SvgToPdfTest : public testing::Test {
 protected:
  SvgToPdfTest()
      : top_(fs::path(testing::TempDir()) / ("svg_to_pdf_" + std::to_string(::getpid()))),
        path_(std::getenv("PATH")) {
    fs::remove_all(top_);
    fs::create_directories(top_);
    ::setenv("PATH", top_.c_str(), 1);
  }
  ~SvgToPdfTest() override {
    ::setenv("PATH", path_.c_str(), 1);
    fs::remove_all(top_);
  }
  void Install(const std::string& script) {
    const fs::path file = top_ / "rsvg-convert";
    WriteFile(file, "#!/bin/sh\n" + script + "\n");
    fs::permissions(file, fs::perms::owner_all);
  }

  fs::path top_;
  std::string path_;
};

TEST_F(SvgToPdfTest, IsMissedWhereItIsNotInstalled) {
  EXPECT_FALSE(HasPdfConverter());
  Install("exit 0");
  EXPECT_TRUE(HasPdfConverter());
}

TEST_F(SvgToPdfTest, IsGivenFormatAndFiles) {
  Install("echo \"$@\" > \"${2#--output=}\"");
  WriteFile(top_ / "a.svg", "<svg/>");
  ConvertSvgToPdf(top_ / "a.svg");
  EXPECT_EQ(ReadFile(top_ / "a.pdf"), "--format=pdf --output=" + (top_ / "a.pdf").string() + " " +
                                          (top_ / "a.svg").string() + "\n");
}

TEST_F(SvgToPdfTest, AFailureIsAnError) {
  Install("exit 3");
  EXPECT_THROW(ConvertSvgToPdf(top_ / "a.svg"), Error);
}

}  // namespace
}  // namespace graspbench

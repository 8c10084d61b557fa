#include "workbench/trial_files.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace graspbench {
namespace {

TEST(TrialFiles, AreFoundByOptionAndEnding) {
  for (const TrialFile& form : ListTrialFiles()) {
    EXPECT_EQ(&FindTrialFile(form.option, std::string("a") + form.ending), &form);
  }
  EXPECT_TRUE(FindTrialFile("--trace", "a.csv").needs_every_step);
}

TEST(TrialFiles, OfOtherEndingsAreRefusedWithThoseThereAre) {
  const auto find_message = [](const char* option, const char* file) -> std::string {
    try {
      FindTrialFile(option, file);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(find_message("--trace", "a.txt"),
            "--trace: \"a.txt\" does not end in .csv or .svg, the forms there are");
  EXPECT_EQ(find_message("--film", "a.gif"),
            "--film: \"a.gif\" does not end in .webp, the only form there is");
}

}  // namespace
}  // namespace graspbench

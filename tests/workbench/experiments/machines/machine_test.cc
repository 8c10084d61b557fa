#include "workbench/experiments/machines/machine.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/files/files.h"
#include "core/base/hash.h"

namespace graspbench {
namespace {

TEST(FindMachine, SaysWhatTheSystemSays) {
  const Machine machine = FindMachine();
  char host[256] = "";
  ASSERT_EQ(::gethostname(host, sizeof host - 1), 0);
  EXPECT_EQ(machine.host, host);
  EXPECT_EQ(machine.build, CalcHashHex(ReadFile("/proc/self/exe")));
  EXPECT_EQ(machine.c_library.rfind("glibc 2.", 0), 0u);
  EXPECT_NE(ReadFile("/proc/cpuinfo").find(machine.processor), std::string::npos);
  EXPECT_NE(machine.processor_flags, CalcHashHex(""));
  EXPECT_TRUE(machine == FindMachine());
}

}  // namespace
}  // namespace graspbench

#include "core/base/interned_name.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace graspbench {
namespace {

TEST(InternedNameTest, EqualTextsAreOneInEveryThread) {
  const InternedName name("TH");
  std::vector<const std::string*> places(4);
  std::vector<std::thread> threads;
  for (const std::string*& place : places) {
    threads.emplace_back([&place] {
      for (int i = 0; i < 1000; ++i) InternedName("name " + std::to_string(i));
      place = &InternedName(std::string("T") + "H").str();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::string* place : places) EXPECT_EQ(place, &name.str());
  EXPECT_EQ(name.str(), "TH");
  EXPECT_TRUE(name == "TH" && name == std::string("TH") && name == InternedName("TH"));
  EXPECT_FALSE(name == InternedName("FF"));
  EXPECT_TRUE(InternedName().empty());
}

}  // namespace
}  // namespace graspbench

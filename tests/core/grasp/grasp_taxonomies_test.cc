#include "core/grasp/grasp_taxonomies.h"

#include <gtest/gtest.h>

#include <string>

namespace graspbench {
namespace {

// Iberall's oppositions are what a finished grasp is looked at for; one taxonomy knows no pinch.
TEST(GraspTaxonomies, AreSevenOfFourTypesByYear) {
  const std::vector<GraspTaxonomy>& all = ListGraspTaxonomies();
  ASSERT_EQ(all.size(), 7u);
  int num_missing = 0;
  for (size_t k = 0; k < all.size(); ++k) {
    EXPECT_LE(all[k == 0 ? 0 : k - 1].year, all[k].year);
    for (const char* name : all[k].names) {
      ASSERT_NE(name, nullptr);
      num_missing += name == std::string("-");
    }
  }
  EXPECT_EQ(num_missing, 1);
  EXPECT_STREQ(all[1].names[3], "-");
  EXPECT_STREQ(all.back().names[2], "palm opposition");
  EXPECT_STREQ(all.back().names[3], "side opposition");
}

// A standard grasp has its type's name, but for the fifth, made for one object.
TEST(GraspTaxonomies, TypesAreNamedAsTheStandardGrasps) {
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (taxon.id == "g5") continue;
    EXPECT_EQ(taxon.name, NameOf(taxon.type));
    EXPECT_EQ(taxon.id.substr(1), std::string(CodeOf(taxon.type)).substr(1));
  }
}

}  // namespace
}  // namespace graspbench

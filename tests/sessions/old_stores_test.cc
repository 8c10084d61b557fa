/** @file
Results of earlier schemas, kept as they were written, a folder a kind in v4/ and so on of
tests/datasets/stores:
every later program verifies, exports and reports them. Whoever raises a schema keeps a new sample
beside the old ones. */

#include <gtest/gtest.h>

#include "core/base/text/json.h"
#include "datasets/journal/store_kind.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

const fs::path kStores = fs::path(GRASPBENCH_STORES_FOLDER);

std::vector<std::string> ListStores() {
  std::vector<std::string> names;
  for (const auto& schema : fs::directory_iterator(kStores)) {
    if (!schema.is_directory()) continue;
    for (const auto& store : fs::directory_iterator(schema)) {
      names.push_back(store.path().lexically_relative(kStores).string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

class OldStores : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("old_stores_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::copy(kStores / GetParam(), folder_, fs::copy_options::recursive);
    kind_ = fs::path(GetParam()).filename().string();
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);
  }
  static int Call(const std::vector<std::string>& arguments) { return WaitFor(Start(arguments)); }

  fs::path folder_;
  std::string kind_;
};
INSTANTIATE_TEST_SUITE_P(Kept, OldStores, testing::ValuesIn(ListStores()), [](const auto& store) {
  std::string name = store.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

TEST_P(OldStores, AreWholeAndOfTheirSchema) {
  EXPECT_EQ(Call({"verify", folder_}), 0);
  const StoreKind* kind = FindStoreKind(folder_);
  ASSERT_TRUE(kind);
  EXPECT_EQ(kind->name, kind_);
  const int schema = Json::parse(ReadFile(folder_ / kind->file)).at("schema").get<int>();
  EXPECT_EQ("v" + std::to_string(schema) + "/" + kind_, GetParam());
  EXPECT_GE(schema, kind->oldest_schema) << "it would be refused";
}

TEST_P(OldStores, AreExportedAndReported) {
  if (kind_ == "session") {
    fs::remove_all(folder_ / "export");
    ASSERT_EQ(Call({"export", folder_, "--records"}), 0);
    const std::string lines = ReadFile(folder_ / "export" / "records.jsonl");
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), CountLines(folder_ / "journal"));
  }
  if (kind_ == "session" || kind_ == "campaign") {
    fs::remove_all(folder_ / "report");
    ASSERT_EQ(Call({"report", folder_}), 0);
    EXPECT_GT(fs::file_size(folder_ / "report" / "index.html"), 10000u);
  }
  EXPECT_EQ(Call({"verify", folder_}), 0);
}

TEST(StoreSamples, ThereIsOneOfEverySchemaThatIsWritten) {
  for (const StoreKind* kind : {&kSessionStore, &kSceneStore, &kCampaignStore}) {
    EXPECT_TRUE(fs::exists(kStores / ("v" + std::to_string(kind->schema)) / kind->name))
        << kind->name << " has schema " << kind->schema << " and no sample";
  }
}

}  // namespace
}  // namespace graspbench

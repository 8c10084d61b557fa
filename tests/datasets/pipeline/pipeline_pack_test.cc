#include "datasets/pipeline/pipeline_pack.h"

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>

#include <random>

#include "core/base/files/files.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/pipeline/made_commands.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class PipelinePack : public testing::Test {
 protected:
  PipelinePack() {
    MakeFolder(top_ / "data" / "deep");
    MakeFolder(results_ / "a");
    WriteFile(top_ / "x.yaml", "x");
    WriteFile(top_ / "data" / "deep" / "1.csv", std::string(100000, '1'));
    WriteFile(results_ / "a" / "out.csv", "result");
    WriteFile(top_ / "p.yaml",
              "stages: {a: {command: make, inputs: {file: x.yaml}, "
              "files: [data, data/deep/1.csv]}}\n");
  }
  void Pack(const std::string& name) const {
    const Pipeline pipeline = LoadPipeline(top_ / "p.yaml", MakeCommands());
    GatherPack(pipeline, results_, {"make", {{"program", "1"}}, {}}, top_ / ("of_" + name));
    WritePack(top_ / ("of_" + name), top_ / name);
  }
  /** A tar file of libarchive's own. */
  void WriteTar(const std::string& entry_name, int type) const {
    archive* out = ::archive_write_new();
    ::archive_write_set_format_pax_restricted(out);
    ::archive_write_open_filename(out, (top_ / "foreign.tar").c_str());
    archive_entry* entry = ::archive_entry_new();
    ::archive_entry_set_pathname(entry, entry_name.c_str());
    ::archive_entry_set_filetype(entry, static_cast<unsigned>(type));
    if (type == AE_IFLNK) ::archive_entry_set_symlink(entry, "/etc/passwd");
    ::archive_entry_set_size(entry, type == AE_IFREG ? 1 : 0);
    ::archive_entry_set_perm(entry, 0644);
    ::archive_write_header(out, entry);
    if (type == AE_IFREG) ::archive_write_data(out, "x", 1);
    ::archive_entry_free(entry);
    ::archive_write_close(out);
    ::archive_write_free(out);
  }

  TemporaryFolder temporary_;
  fs::path top_ = temporary_.path(), results_ = top_ / "results";
};

TEST_F(PipelinePack, WhatIsPackedComesOutAgain) {
  Pack("p.tar");
  const Manifest manifest = Unpack(top_ / "p.tar", top_ / "out");
  EXPECT_EQ(FindPackedFile(top_ / "out", manifest), top_ / "out" / "pipeline" / "p.yaml");
  EXPECT_EQ(ReadFile(top_ / "out" / "pipeline" / "data" / "deep" / "1.csv"),
            std::string(100000, '1'));
  EXPECT_EQ(ReadFile(top_ / "out" / "results" / "a" / "out.csv"), "result");
  EXPECT_EQ(manifest.files.size(), 4u);
}

TEST_F(PipelinePack, TheSameContentsTheSameBytes) {
  Pack("p.tar");
  fs::last_write_time(results_ / "a" / "out.csv", fs::file_time_type::clock::now());
  fs::permissions(top_ / "x.yaml", fs::perms::owner_all);
  Pack("q.tar");
  EXPECT_EQ(ReadFile(top_ / "p.tar"), ReadFile(top_ / "q.tar"));
  EXPECT_EQ(ReadFile(top_ / "p.tar").find(top_.string()), std::string::npos);
}

// Every byte of a file counts; those of tar's own fields and padding need not.
TEST_F(PipelinePack, DamageIsNamedAndNothingIsWrittenElsewhere) {
  Pack("p.tar");
  const std::string whole = ReadFile(top_ / "p.tar");
  std::mt19937 random(2);
  int num_told = 0;
  for (int i = 0; i < 150; ++i) {
    std::string bytes = whole;
    if (i % 3 == 0) {
      bytes.resize(random() % (bytes.size() - 2000));  // what is behind is padding
    } else {
      bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
    }
    WriteFile(top_ / "bad.tar", bytes);
    fs::remove_all(top_ / "out");
    try {
      Unpack(top_ / "bad.tar", top_ / "out");
      EXPECT_NE(i % 3, 0) << "a cut file was taken";
      EXPECT_EQ(ReadFile(top_ / "out" / "results" / "a" / "out.csv"), "result");
    } catch (const Error& fault) {
      ++num_told;
      EXPECT_EQ(fault.kind(), ErrorKind::kFormat) << fault.what();
    }
  }
  EXPECT_GT(num_told, 130);
}

TEST_F(PipelinePack, BytesBehindItsEndAreTold) {
  Pack("p.tar");
  const std::string whole = ReadFile(top_ / "p.tar");
  for (const std::string& more :
       {std::string("x"), std::string(600, '\0') + "x", whole, std::string(200000, '\0') + whole}) {
    fs::remove_all(top_ / "out");
    WriteFile(top_ / "more.tar", whole + more);
    EXPECT_TRUE(Has(FindError([&] { Unpack(top_ / "more.tar", top_ / "out"); }),
                    "more.tar\" goes on behind its end"));
  }
  fs::remove_all(top_ / "out");
  WriteFile(top_ / "more.tar", whole + std::string(10240, '\0'));  // as tar itself fills up
  EXPECT_NO_THROW(Unpack(top_ / "more.tar", top_ / "out"));
}

TEST_F(PipelinePack, OnlyFilesBelowItsFolder) {
  for (const auto& [name, type] : {std::pair<const char*, int>{"../evil", AE_IFREG},
                                   {"/tmp/graspbench_evil", AE_IFREG},
                                   {"a/../../evil", AE_IFREG},
                                   {"link", AE_IFLNK},
                                   {"pipe", AE_IFIFO},
                                   {"good", AE_IFREG}}) {
    WriteTar(name, type);
    fs::remove_all(top_ / "out");
    EXPECT_THROW(Unpack(top_ / "foreign.tar", top_ / "out"), Error) << name;
  }
  EXPECT_FALSE(fs::exists(top_ / "evil"));
  EXPECT_FALSE(fs::exists("/tmp/graspbench_evil"));
  EXPECT_THROW(Unpack(top_ / "nowhere.tar", top_ / "out"), Error);
}

}  // namespace
}  // namespace graspbench

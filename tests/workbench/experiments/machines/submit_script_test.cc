#include "workbench/experiments/machines/submit_script.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.h"

namespace graspbench {
namespace {

SubmitRequest MakeRequest(const std::string& engine) {
  SubmitRequest request;
  request.folder = "/data/my pilot";
  request.program = "/opt/graspbench";
  request.engine = engine;
  request.num_shards = 7;
  return request;
}

std::string Refuse(const std::string& text) {
  try {
    ParseClusterConfig(text, "cluster.yaml");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kFormat);
    return error.what();
  }
  ADD_FAILURE() << text;
  return "";
}

TEST(MakeSubmitScript, IsShortAndHasShellAndFolderRight) {
  for (const std::string& engine : ListEngines()) {
    SubmitRequest request = MakeRequest(engine);
    request.cluster = ParseClusterConfig(
        "partition: long\naccount: me\ntime: 1:00:00\nmemory: 2G\n"
        "modules: [gcc/12, x]\noptions: [--qos=low]\n",
        "");
    for (const char* what : {"", "judge", "explain"}) {
      request.judge = what == std::string("judge");
      request.explain = what == std::string("explain");
      request.num_rounds = *what ? 1 : 2;
      const std::string script = MakeSubmitScript(request);
      EXPECT_LE(std::count(script.begin(), script.end(), '\n'), 30) << script;
      EXPECT_NE(script.find("\ncd '/data/my pilot' || exit"), std::string::npos) << script;
      EXPECT_NE(script.find("/opt/graspbench merge ."), std::string::npos) << script;
      EXPECT_NE(script.find("OPENBLAS_NUM_THREADS=1 LP_NUM_THREADS=0"), std::string::npos);
      const std::string round = *what ? std::string(" --") + what : "";
      EXPECT_NE(script.find("work ." + round + " --shard"), std::string::npos) << script;
    }
  }
  SubmitRequest request = MakeRequest("sge");
  EXPECT_THROW(MakeSubmitScript(request), Error);
}

TEST(MakeSubmitScript, TellsSlurmWhatASignalNeeds) {
  SubmitRequest request = MakeRequest("slurm");
  request.cluster.partition = "long";
  request.cluster.modules = {"gcc/12"};
  const std::string script = MakeSubmitScript(request);
  for (const char* line :
       {"\n#SBATCH --job-name=graspbench-work --array=1-7\n",
        "\n#SBATCH --requeue --signal=B:TERM@60\n", "\n#SBATCH --open-mode=append ",
        "\n#SBATCH --partition=long\n", "\nmodule load gcc/12\n",
        "\nexec /opt/graspbench work . --shard \"$SLURM_ARRAY_TASK_ID\"/7\n",
        "--dependency=afterany:"}) {
    EXPECT_NE(script.find(line), std::string::npos) << line << script;
  }
}

TEST(ParseClusterConfig, DefaultsAreEmpty) {
  EXPECT_EQ(ParseClusterConfig("", "").partition, "");
  EXPECT_TRUE(LoadClusterConfig("/nowhere/cluster.yaml").modules.empty());
}

// Values go into a script as they are: none may bring a line or a command of its own.
TEST(ParseClusterConfig, RefusesWithFileAndLine) {
  EXPECT_NE(Refuse("partition: a\nacount: b\n").find("cluster.yaml:2"), std::string::npos);
  EXPECT_NE(Refuse("partition: a\nacount: b\n").find("account"), std::string::npos);
  for (const char* text :
       {"partition: \"a\\nrm x\"", "partition: a b", "account: $(id)", "time: \"`id`\"",
        "memory: \"2G;id\"", "modules: [\"a;b\"]", "modules: [\"\"]", "options: [\"--x y\"]",
        "options: [x]", "partition: [a]", "- a", "modules: {a: b}", "partition: \"a"}) {
    EXPECT_NE(Refuse(text).find("cluster.yaml:1"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace graspbench

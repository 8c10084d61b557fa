#pragma once
/** @file
Preregistration of a study's choices: `graspbench study freeze study.yaml` writes
`<study>.freeze.json` beside study.yaml, and `study run` compares with it.

The file holds all settings, including defaults, the version of the program, the content of
objects.csv, the mapping and hypotheses.csv, and the present rows of trials.csv. Rows added later
are the data; changed or deleted rows are deviations. The study's title and the robot session are
not frozen. The file states how many of the recordings named in trials.csv already existed. It
contains its own SHA-256, to be registered elsewhere: the file alone cannot prove that it was not
rewritten. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

struct Study;

/** A choice that differs from the frozen one. */
struct Deviation {
  std::string what;    ///< "contact.cutoff_hz", "hypotheses.csv"
  std::string frozen;  ///< as JSON; for a table, what has changed
  std::string used;
};

struct FreezeCheck {
  std::string hash;        ///< SHA-256 of the frozen choices
  int num_recordings = 0;  ///< recordings that existed at the time of freezing
  std::vector<Deviation> deviations;
};

/** Returns the path beside study.yaml: "study.freeze.json". */
std::filesystem::path FindFreezePath(const std::filesystem::path& study_file);

/** Makes the text of this file. trials.csv may be missing.
@param recordings  folder of the recordings; empty: that of study.yaml.
@throws Error(kNotFound, kFormat) as LoadStudy. */
std::string MakeFreeze(const std::filesystem::path& study_file,
                       const std::filesystem::path& recordings = {});

/** Compares a study with the text of its freeze file. @param name  of the file, for messages.
@throws Error(kFormat) when the text is not a freeze file, or was changed since it was written. */
FreezeCheck CompareWithFreeze(const std::string& text, const std::string& name, const Study& study);

/** "Choices frozen before any recording (1a2b..): no deviation." Empty without a freeze. */
std::string DescribeFreeze(const Study& study);
/** Lists one line per deviation. */
std::vector<std::string> ListDeviations(const Study& study);

}  // namespace graspbench

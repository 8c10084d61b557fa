#pragma once
/** @file
The choices of a study, written down before its data: `graspbench study freeze study.yaml` makes
`<study>.freeze.json` beside study.yaml, `study run` compares.

Frozen are all settings, defaults included, the version of the program, what objects.csv, the
mapping and hypotheses.csv hold, and the rows that trials.csv has by then: rows that come later are
the data, rows that are changed or gone are deviations. Not frozen are the study's title and the
robot beside it. The file says how many of the recordings that trials.csv names were there already.
It carries its own SHA-256, which can be registered elsewhere: that no one wrote it again afterwards,
nobody can tell from the file alone. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

struct Study;

/** A choice that is not what was frozen. */
struct Deviation {
  std::string what;    ///< "contact.cutoff_hz", "hypotheses.csv"
  std::string frozen;  ///< as JSON; of a table what became of it
  std::string used;
};

struct FreezeCheck {
  std::string hash;        ///< SHA-256 of the frozen choices
  int num_recordings = 0;  ///< that were there when it was frozen
  std::vector<Deviation> deviations;
};

/** Beside study.yaml: "study.freeze.json". */
std::filesystem::path FindFreezePath(const std::filesystem::path& study_file);

/** The text to be written there. trials.csv may be missing.
@param recordings  their folder; empty: that of study.yaml.
@throws Error(kNotFound, kFormat) as LoadStudy. */
std::string MakeFreeze(const std::filesystem::path& study_file,
                       const std::filesystem::path& recordings = {});

/** @param text  of the file, whose name stands in messages.
@throws Error(kFormat) when it is none, or was changed since it was written. */
FreezeCheck CompareWithFreeze(const std::string& text, const std::string& name, const Study& study);

/** "Choices frozen before any recording (1a2b..): no deviation." Empty without a freeze. */
std::string DescribeFreeze(const Study& study);
/** A line for each deviation. */
std::vector<std::string> ListDeviations(const Study& study);

}  // namespace graspbench

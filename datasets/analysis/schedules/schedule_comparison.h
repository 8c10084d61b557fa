#pragma once
/** @file
People and robots side by side: when digits touch (touch_lags.h) under each schedule with which a
grasp may close on the same draws of the same object, and what each schedule costs.

    natural       as the grasp closes by itself
    simultaneous  each digit delayed so that in a trial without variation all touch together
    people-like   each digit delayed so that there it touches when people do: the median share of
                  people's closing time, of the closing time that the natural grasp has there

A schedule is a grasp of its own, "g3-people-like", in a session below `schedules/` of the one whose
grasps they are (workbench/experiments/schedule_session.h); a grasp without such an ending is
natural. What people did, and why a schedule is missing, stands in that session's
inputs/grasps/people.json.

The cost in threshold is the ratio of the draw's grip threshold to that of the natural schedule, the
median over draws with the interval of order statistics (threshold_summary.h). Where under both the
least grip of the scale holds, or none does, it is not known: such draws are counted and left out,
and where they are half of the draws or more there is no ratio. Where no grip held under one schedule
the ratio is infinite, or 0.

What a schedule costs says something of simultaneity only where it changes it: DescribeUnknown names
a simultaneous schedule under which GFT is not smaller over the draws. */

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/schedules/touch_lags.h"
#include "datasets/analysis/session_summary.h"

namespace graspbench {

inline constexpr char kNatural[] = "natural";
inline constexpr char kSimultaneous[] = "simultaneous";
inline constexpr char kPeopleLike[] = "people-like";
/** In the order of tables and pictures. */
inline constexpr const char* kSchedules[] = {kNatural, kSimultaneous, kPeopleLike};

/** "g3" and "people-like" of "g3-people-like"; of an id without a schedule itself and "natural". */
struct ScheduledGrasp {
  std::string grasp, schedule;
};
ScheduledGrasp SplitSchedule(const std::string& id);

/** One hand on one object with one grasp, and what people did there. */
struct PeopleOnObject {
  std::string hand, object, grasp;
  std::vector<std::string> digits;  ///< of the grasp, with which people's are paired
  Answer<TouchLags> people;         ///< of these digits
  /** By schedule, why there is none: "a digit does not touch". */
  std::map<std::string, std::string> missing;
};

/** inputs/grasps/people.json. */
struct PeopleFile {
  std::string study;  ///< as a person gave it; empty: none
  std::vector<PeopleOnObject> cells;

  /** Null: none. */
  const PeopleOnObject* Find(const std::string& hand, const std::string& object,
                             const std::string& grasp) const;
};
Json ToJson(const PeopleFile& people);
/** @param file  its name in messages. @throws Error(kFormat). */
PeopleFile PeopleFileFromJson(const Json& json, const std::string& file);

/** People's touches of the object with the grasp's digits.
@returns no answer, with the reason, also for an object that the study does not have. */
Answer<TouchLags> SummarisePeople(const std::vector<TrialTouches>& people,
                                  const std::string& object,
                                  const std::vector<std::string>& digits);

struct ScheduleRow {
  std::string schedule;  ///< one of kSchedules
  Answer<TouchLags> lags;
  Tally tally;
  double threshold = kUnset;              ///< median; infinite: no grip held in half of the draws
  std::string threshold_text = {};        ///< as FormatMedian says it; empty: none was looked for
  int num_pairs = 0;                      ///< draws with a threshold here and under natural
  int num_not_known = 0;                  ///< of these, whose ratio is not known
  double ratio = kUnset;                  ///< to natural's
  std::optional<Interval> interval = {};  ///< of the ratio, 95 %; none: too few draws
};

/** The schedules of one grasp of one hand on one object. */
struct ScheduleCell {
  PeopleOnObject of;  ///< without people where there is no PeopleFile
  std::vector<ScheduleRow> rows;
};

struct ScheduleComparison {
  std::string folder;  ///< of the session that they are from, in the session's folder
  std::string study;   ///< whose people are compared; empty: none
  const ThresholdScale* scale = nullptr;  ///< null: no thresholds are known
  std::vector<ScheduleCell> cells;        ///< in the order of the plan
};

/** Of a session of schedules, or of any other, whose grasps are natural. Grasps that the camera
chose take no part.
@param thresholds  of this session; the first scale counts. */
ScheduleComparison CompareSchedules(const Session& session, const PeopleFile& people,
                                    const std::vector<ThresholdSummary>& thresholds);

/** Why a schedule's ratio is not known, or tells nothing of simultaneity: one sentence each, that
begins with the schedule's name. */
std::vector<std::string> DescribeUnknown(const ScheduleCell& cell);

/** inputs/grasps/people.json of a session of schedules. @throws Error(kFormat, kIo). */
PeopleFile LoadPeopleFile(const std::filesystem::path& folder);

/** Those below `schedules/` of the session, in the order of their names. @throws as LoadSession. */
std::vector<ScheduleComparison> LoadSchedules(const Session& session);

/** {folder, study, scale, cells: [..]}; infinite and NaN are null. */
Json ToJson(const ScheduleComparison& comparison);

}  // namespace graspbench

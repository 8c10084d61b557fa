#pragma once
/** @file
A YAML file that names the columns of a plain table:

    unit: mm
    points:
      index: [indexXraw, indexYraw, indexZraw]
      thumb: [thumbXraw, thumbYraw, thumbZraw]
    time: globalTime        # optional; without it rate_hz is needed
    time_unit: ms           # s (default), ms or us
    rate_hz: 85             # optional; without it the inverse of the median interval
    trial: trialN           # optional; one file, many trials: --trial chooses
    occluded: fingersOccluded   # optional; a value other than 0 makes all points invalid
    channels: {touch: ft1}      # optional; forces or touch switches, at the rate of the rows
    heading: false              # optional; the table starts with numbers: columns are 1, 2, ..
    layout: freemocap           # optional; columns as a tool writes them, see TableLayout
    scale: 25                   # optional; a coordinate is so many of the unit
    glove: {hand: shadow, ..}   # optional; joint angles instead of points, see GloveMapping */

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/file_keys.h"
#include "core/base/text/delimited_text.h"
#include "human_study/recording/importers/importer.h"

namespace graspbench {

struct Hand;

/** Converts joint angles of a data glove to fingertip positions with the kinematics of a hand model
(core/hand). The model's bones replace the person's, so positions are only as accurate as the two
hands are similar.

A glove does not measure the position of the hand. A reach also needs the pose of the hand's root in
the laboratory, from a tracker on the back of the hand:

    glove:
      hand: shadow                     # a model's id, or a folder with hand.urdf and hand.yaml
      angle_unit: deg                  # deg (default) or rad
      joints: {FFJ3: index_mcp, ..}    # of the model, each with its column; others are straight
      base: [x, y, z]                  # columns: the model's root in the laboratory, in `unit`
      base_quaternion: [qx, qy, qz, qw]  # columns: laboratory from root

The points are `<digit>_tip`, the centre of the digit's pad, and `wrist`, the root. */
struct GloveMapping {
  std::string hand;
  bool is_in_degrees = true;
  std::vector<std::pair<std::string, std::string>> joints;  ///< joint of the model, column
  std::vector<std::string> base;                            ///< columns x, y, z
  std::vector<std::string> quaternion;                      ///< columns x, y, z, w

  bool IsNamed() const { return !hand.empty(); }
  /** Lists all columns: the joints', then base, then quaternion. */
  std::vector<std::string> ListColumns() const;
};

class GloveModel {
 public:
  /** @throws Error as LoadHand; Error(kFormat) for a joint that the model lacks or that is coupled
  to another, listing the valid ones. */
  explicit GloveModel(const GloveMapping& mapping);

  /** In the order of CalcPoints. */
  const std::vector<std::string>& labels() const { return labels_; }
  /** "12 of 24 joints are named, the others straight or coupled", and the hand model. */
  std::string Describe() const;
  /** Computes the points in the laboratory frame [unit of the base].
  @param cells  values of GloveMapping::ListColumns(). @param metres_per_unit  of the base.
  @returns empty when a number is missing or the quaternion is invalid. */
  std::vector<Eigen::Vector3d> CalcPoints(const std::vector<double>& cells,
                                          double metres_per_unit) const;

 private:
  std::shared_ptr<const Hand> hand_;
  std::vector<int> joints_;
  double factor_ = 1.0;  // [rad] per unit of angle
  std::vector<std::string> labels_;
};

struct TableMapping {
  struct Point {
    std::string label;
    std::vector<std::string> columns;  ///< x, y, z
  };
  std::vector<Point> points;
  std::string layout;  ///< a TableLayout's id; empty: none
  std::string unit;
  double scale = 1.0;
  std::string time;  ///< empty: none
  double seconds_per_time_unit = 1.0;
  double rate = 0.0;  ///< [Hz]; 0: not stated
  std::string trial;
  std::string occluded;
  std::vector<std::pair<std::string, std::string>> channels;  ///< label, column
  GloveMapping glove;
  bool has_heading = true;  ///< else columns are named by number, from 1
};

/** @throws Error(kNotFound, kFormat) with file and line of every problem. */
TableMapping LoadTableMapping(const std::filesystem::path& path);

/** The keys of a mapping file (columns.yaml). */
const FileKeys& ListMappingKeys();

/** Whether a first row has every column that the mapping names; false for a mapping with a layout
or without a heading. */
bool IsHeadingOf(const TableMapping& mapping, std::string_view heading);

/** Proposes a mapping from a table's heading and first rows. Three columns that differ by x, y and
z are a point. Units come from the names, else they are a guess that is marked as such.
@throws Error(kUsage) for a file that needs no mapping; Error(kFormat) when no point is found; as
LoadRecording. */
std::string ProposeMapping(const std::filesystem::path& table);
/** As ProposeMapping in process, for a stream at the start of the table. */
std::string FormatProposedMapping(std::istream& stream, const std::string& name);

struct TableTrial {
  std::string name;
  TableRows rows;
};

/** Finds the trials in a table, in the order of their first rows. A caller that reads many trials
passes each trial's rows on, so that the table is read twice, not once per trial. @throws as
LoadRecording. */
std::vector<TableTrial> FindTableTrials(const std::filesystem::path& table,
                                        const TableMapping& mapping);
/** As FindTableTrials in process, for a stream at the start of the table. */
std::vector<TableTrial> ListTableTrials(std::istream& stream, const std::string& name,
                                        const TableMapping& mapping);

/** Tables whose columns need no individual mapping, because a tool always writes them in the same
way (`layout`). Every point becomes three columns `<point>_x`, _y, _z.

  deeplabcut: three heading rows (scorer, bodyparts, coords), four with several individuals
    (scorer, individuals, bodyparts, coords: points are individual:bodypart); a column with the
    frame's number, then x, y, z of each body part. Lengths are counted in squares of the
    checkerboard that the cameras were calibrated with, so the mapping must say `scale`.
  freemocap: one heading row right_hand_wrist_x, right_hand_wrist_y, right_hand_wrist_z, ..; without
    times. Millimetres when the board's size was given in them.

Sources: DeepLabCut, docs/Overviewof3D.md and pose_estimation_3d; FreeMoCap's output_data folder. */
struct TableLayout {
  const char* id;
  const char* text;  ///< for messages
  bool needs_scale;  ///< its length unit is known only to the user
  /** Reads the heading rows and names every column; "" for columns that are not coordinates.
  @throws Error(kFormat) with the line that does not match the layout. */
  std::vector<std::string> (*read_names)(LineReader& reader, char delimiter);
};

const std::vector<TableLayout>& TableLayoutList();
/** Returns null for an unknown id. */
const TableLayout* FindTableLayout(const std::string& id);

/** Lists the points with all three columns, in order. @throws Error(kFormat) at the reader's line
when there is no point, or when one has only x and y. */
std::vector<std::string> FindLayoutPoints(const std::vector<std::string>& names,
                                          const LineReader& reader);

}  // namespace graspbench

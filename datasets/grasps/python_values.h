#pragma once
/** @file
Reads numbers and texts from a pickle, in whatever form the writer stored them: Python or numpy
numbers, lists, tuples, or arrays of any number type. Messages name the key. */

#include <cstdint>
#include <string>
#include <vector>

#include "datasets/grasps/pickle.h"

namespace graspbench {

/** Reads a file written by np.save (a header, then a pickle), or a plain pickle, which np.load also
accepts.
@throws Error(kFormat) for any other file, for plain arrays of numbers, and as ReadPickle. */
Pickle ReadNpy(std::string_view bytes, const std::string& file);

/** Numbers in rows. A single number has one row and one column; a list of numbers has one row. */
struct NumberTable {
  int64_t num_rows = 0;
  int64_t num_columns = 0;
  int num_dimensions = 0;       ///< 0: a number, 1: a row, 2: rows
  std::vector<double> numbers;  ///< row by row
  const double* row(int64_t index) const {
    return numbers.data() + static_cast<size_t>(index * num_columns);
  }
};

/** Returns the single value of a scalar or of an array without dimensions; else the value
itself. */
const PickleValue& Unwrap(const PickleValue& value);

/** Returns the value of a key in a dictionary; null if absent. The last one counts, as in
Python. */
const PickleValue* FindItem(const PickleValue& dict, std::string_view key);

/** @param where  location of the value: "grasps.npy: grasp_qpos".
@throws Error(kFormat) for anything but finite numbers in at most two dimensions, for empty rows,
and for a list of more than 16 million numbers. */
NumberTable ReadNumbers(const PickleValue& value, const std::string& where);

/** Reads one number. @throws Error(kFormat). */
double ReadNumber(const PickleValue& value, const std::string& where);

/** @throws Error(kFormat) when it is not a text. */
std::string ReadText(const PickleValue& value, const std::string& where);

/** Describes a value for messages: "a text", "a list", "an array of numpy (2 x 29)". */
std::string DescribeValue(const PickleValue& value);

}  // namespace graspbench

#pragma once
/** @file
Numbers and texts out of what a pickle holds, whichever way the writer kept them: a number of Python
or of numpy, a list or tuple, an array of any type of number. A message names the key. */

#include <cstdint>
#include <string>
#include <vector>

#include "datasets/grasps/pickle.h"

namespace graspbench {

/** A file that was written by np.save: a header, then a pickle; or a pickle alone, which np.load
takes as well.
@throws Error(kFormat) for any other file, for plain arrays of numbers, and as ReadPickle. */
Pickle ReadNpy(std::string_view bytes, const std::string& file);

/** Numbers in rows: of a number both sizes are 1, of a row of numbers num_rows is 1. */
struct NumberTable {
  int64_t num_rows = 0;
  int64_t num_columns = 0;
  int num_dimensions = 0;       ///< 0: a number, 1: a row, 2: rows
  std::vector<double> numbers;  ///< row by row
  const double* row(int64_t index) const {
    return numbers.data() + static_cast<size_t>(index * num_columns);
  }
};

/** An array without dimensions holds one value, so does a scalar: the value itself. */
const PickleValue& Unwrap(const PickleValue& value);

/** Value of a key of a dictionary; null where it is not there. The last one counts, as in Python. */
const PickleValue* FindItem(const PickleValue& dict, std::string_view key);

/** @param where  of the value: "grasps.npy: grasp_qpos".
@throws Error(kFormat) for anything else than finite numbers in at most two dimensions, for rows
without numbers, and for a list of more than 16 million numbers. */
NumberTable ReadNumbers(const PickleValue& value, const std::string& where);

/** One number. @throws Error(kFormat). */
double ReadNumber(const PickleValue& value, const std::string& where);

/** @throws Error(kFormat) when it is no text. */
std::string ReadText(const PickleValue& value, const std::string& where);

/** "a text", "a list", "an array of numpy (2 x 29)": what was found, for messages. */
std::string DescribeValue(const PickleValue& value);

}  // namespace graspbench

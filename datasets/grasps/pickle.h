#pragma once
/** @file
Reads a Python pickle without executing anything: plain values (None, bool, int, float, str, bytes,
list, tuple, dict) and numpy's arrays and scalars of numbers, texts and objects.

A pickle is a program for a stack machine. Of protocols 2 to 5, this reader runs the operations that
such values need. The only functions that it emulates are numpy's own for arrays (_reconstruct,
ndarray, dtype, scalar; _frombuffer of protocol 5) and _codecs.encode. It rejects any other name and
every operation that would create an object of a class. Sources: pickletools.py and
numpy/core/src/multiarray/methods.c (array_reduce, arraydescr_setstate). */

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace graspbench {

struct PickleValue {
  enum class Kind {
    kNone,
    kBool,     ///< number is 0 or 1
    kInteger,  ///< in number; rounded beyond 2^53
    kNumber,
    kText,   ///< UTF-8 in text
    kBytes,  ///< in text
    kList,
    kTuple,
    kDict,   ///< items: key, value, key, value, ..
    kArray,  ///< numpy array; a scalar has no dimensions
    kDtype,
    kName,  ///< "numpy dtype": a function or class that may be called
  };
  Kind kind = Kind::kNone;
  int depth = 0;  ///< nesting depth of its values
  double number = 0.0;
  std::string text;
  std::vector<const PickleValue*> items;  ///< also for an array of objects
  /** For an array or a dtype. */
  ///@{
  std::vector<int64_t> shape;
  char type = 'V';  ///< f, i, u, b, U, S, O; V: other types, not readable
  bool is_big_endian = false;
  int64_t element_size = 0;  ///< [bytes]
  bool is_fortran_order = false;
  const PickleValue* data = nullptr;  ///< bytes
  ///@}
};

/** The values of one pickle. They may be shared, and a list may contain itself. */
struct Pickle {
  std::deque<PickleValue> values;
  const PickleValue* root = nullptr;
};

/** @param first_byte  of the pickle in its file, for messages.
@throws Error(kFormat) with file and byte for a foreign name, an operation that no plain value
needs, a size beyond the end, an array whose shape and bytes disagree, more than 32 nested values or
more than 4 million values. */
Pickle ReadPickle(std::string_view bytes, const std::string& file, size_t first_byte = 0);

}  // namespace graspbench

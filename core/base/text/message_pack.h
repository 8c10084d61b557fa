#pragma once
/** @file
Values as MessagePack (msgpack.org, specification of 2017), restricted to what controllers of hands
use: nil, booleans, numbers, strings, bytes, lists and maps; no extension types. An array of numbers
is a map with the keys `__ndarray__` (true), `data` (raw bytes), `dtype` (as in numpy: "<f8") and
`shape`. Keys are written as bytes and read as bytes or strings. Such a map is read as an array; a
map with `__npgeneric__`, whose `data` are raw bytes or a number, is read as a scalar. */

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace graspbench {

/** Numbers with a shape, last index fastest; an empty shape is a single number. */
struct PackedArray {
  std::vector<size_t> shape;
  std::vector<double> values;
};

struct PackedValue {
  using List = std::vector<PackedValue>;
  using Map = std::vector<std::pair<std::string, PackedValue>>;  ///< keys: strings or bytes

  std::variant<std::monostate, bool, double, std::string, List, Map, PackedArray> value;

  /** Returns the value of a key; null if this is not a map or has no such key. */
  const PackedValue* Find(std::string_view key) const;
  const std::string* text() const { return std::get_if<std::string>(&value); }
};

/** Writes values in sequence; the values of a map or list follow its head. */
class MessagePackWriter {
 public:
  void Map(size_t num_pairs);
  void List(size_t num_items);
  void Text(std::string_view text);
  void Bool(bool value);
  void Integer(uint64_t value);
  void Number(double value);
  /** @pre the number of values matches the shape. */
  void Array(const double* values, const std::vector<size_t>& shape);
  void Array(const std::vector<double>& values) { Array(values.data(), {values.size()}); }
  /** @param data  little-endian content of an array of numpy's type `dtype`: "<f4", "|u1". */
  void RawArray(std::string_view data, const char* dtype, const std::vector<size_t>& shape);
  /** Writes a value as it was read; arrays become float64. */
  void Value(const PackedValue& value);
  void Texts(const std::vector<std::string>& texts);

  const std::string& bytes() const { return bytes_; }

 private:
  void Head(size_t count, uint8_t small, size_t most_small, uint8_t wide);
  void Bytes(std::string_view bytes);
  template <class T>
  void BigEndian(T value);

  std::string bytes_;
};

/** Parses one value that fills all of `bytes`. Supported arrays are little endian with dtype f4,
f8, i1 to i8, u1 to u8 or bool.
@throws Error(kFormat) with the fault and its byte offset. */
PackedValue ParseMessagePack(std::string_view bytes);

/** Converts a value to an array: an array, a number, a list of numbers, or a list of equally long
such lists.
@param name  name of the value for messages.
@throws Error(kFormat) for anything else. */
PackedArray ReadPackedArray(const PackedValue& value, const std::string& name);

}  // namespace graspbench

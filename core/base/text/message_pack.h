#pragma once
/** @file
Values as MessagePack (msgpack.org, specification of 2017), the part of it that controllers of hands
speak: nil, truth values, numbers, texts, bytes, lists, maps; no extension types. An array of numbers
is a map with the keys `__ndarray__` (true), `data` (raw bytes), `dtype` (numpy's, as "<f8") and
`shape`; keys are written as bytes and read as bytes or text. Such a map is read as an array, and one
with `__npgeneric__`, whose `data` are raw bytes or a number, as a scalar. */

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace graspbench {

/** Numbers with a shape, the last index fastest; an empty shape is a single number. */
struct PackedArray {
  std::vector<size_t> shape;
  std::vector<double> values;
};

struct PackedValue {
  using List = std::vector<PackedValue>;
  using Map = std::vector<std::pair<std::string, PackedValue>>;  ///< keys of text or bytes

  std::variant<std::monostate, bool, double, std::string, List, Map, PackedArray> value;

  /** That of a key of a map; null: it is none, or has no such key. */
  const PackedValue* Find(std::string_view key) const;
  const std::string* text() const { return std::get_if<std::string>(&value); }
};

/** Writes one value after the other; those of a map and of a list follow its head. */
class MessagePackWriter {
 public:
  void Map(size_t num_pairs);
  void List(size_t num_items);
  void Text(std::string_view text);
  void Bool(bool value);
  void Integer(uint64_t value);
  void Number(double value);
  /** @pre as many values as the shape has places. */
  void Array(const double* values, const std::vector<size_t>& shape);
  void Array(const std::vector<double>& values) { Array(values.data(), {values.size()}); }
  /** @param data  of an array of that type of numpy, little endian: "<f4", "|u1". */
  void RawArray(std::string_view data, const char* dtype, const std::vector<size_t>& shape);
  /** What was read, with arrays of float64. */
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

/** One value that fills all of `bytes`. Arrays of dtype f4, f8, i1 to i8, u1 to u8 and bool, little
endian, are read.
@throws Error(kFormat) saying what is wrong, and at which byte. */
PackedValue ParseMessagePack(std::string_view bytes);

/** An array, a number, or a list of numbers or of equally long such lists, as an array.
@throws Error(kFormat) for anything else. @param name  of the value, for the message. */
PackedArray ReadPackedArray(const PackedValue& value, const std::string& name);

}  // namespace graspbench
